// SPDX-License-Identifier: GPL-3.0-or-later
//
// Refinement beside acute edges of the input, where it wouldn't end by itself: vertices come in mirrored pairs, and
// small elements are left as they are unless sizes or distances ask for more. See Acute_edges_3.h.

#ifndef WEFT_SPATIAL_REFINE_ACUTE_REFINEMENT_3_H
#define WEFT_SPATIAL_REFINE_ACUTE_REFINEMENT_3_H

#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/domain/Acute_edges_3.h>
#include <weft/spatial/refine/Bad_elements_list_3.h>
#include <weft/spatial/refine/Steiner_batch_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Acute_refinement_3
{
public:
  using Point = typename Restricted::Point;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Surface_hit = typename Restricted::Surface_hit;
  using Restricted_facet = typename Restricted::Restricted_facet;
  using Crease_edge = typename Restricted::Crease_edge;
  using Measure = Badness_measure_3<Restricted>;

  Acute_refinement_3(const Restricted& mesh, const Measure& measure, Steiner_batch_3<Restricted>& batch)
      : mesh_(mesh), measure_(measure), batch_(batch)
  {}

  /// To be told of every new facet.
  void add_facet(int record)
  {
    const Restricted_facet& f = mesh_.facets()[static_cast<std::size_t>(record)];
    if (is_mixed_up(f)) mixed_up_.push_back({record, f.version});
  }

  /// To be told of every new batch.
  void begin_batch() { left_ = 0; }

  /// From now on leaves small elements at all acute edges, not only where twins don't end refinement.
  void leave_knife_edges() { leaves_knife_edges_ = true; }

  /// Whether to leave an element as it is if that isn't needed: a small one beside an acute edge.
  bool is_left(const Point& center, double squared_radius)
  {
    const double least = acute_floor_ * measure_.size(center);
    if (!(squared_radius < least * least)) return false;
    const double angle = mesh_.oracle().acute_angle_at(center, std::sqrt(squared_radius));
    const bool left = angle < 180 && (leaves_knife_edges_ || angle >= largest_angle_with_twins);
    left_ += left;
    return left;
  }

  /// Smaller elements mend what is left at angles that aren't very acute, and only multiply it at others. To be called
  /// when nothing else can be done; returns whether it is worth going on: while little is left, or much less than
  /// before, and less than ever within a few steps. The same few can be left at any scale: facets at a corner with an
  /// angle below that of the facet shape.
  bool lower_floor()
  {
    const auto most =
        (std::max)(static_cast<std::size_t>(0.7 * static_cast<double>(left_before_)), mesh_.vertices().size() / 50);
    if (left_ < least_left_) {
      least_left_ = left_;
      steps_left_ = most_steps;
    }
    if (left_ == 0 || left_ > most || acute_floor_ < least_acute_floor || steps_left_-- == 0) return false;
    left_before_ = left_;
    acute_floor_ /= 2;
    return true;
  }

  /// Chooses the Steiner point of a crease edge, unless the edge is left.
  Choice_3 choose(const Crease_edge& e, bool needed)
  {
    if (!needed && is_left(e.steiner, e.squared_radius)) return Choice_3::later;
    return batch_.choose(e);
  }

  /// Beside acute edges, vertices come in mirrored pairs as far as they have to: then every point of a side has the
  /// nearest vertex on its own side, however near the other is, and facets don't mix them up.
  void choose_mirror_images()
  {
    std::size_t n = 0;
    for (const Facet_id_3& id : mixed_up_)
      if (const Restricted_facet* f = find_facet(mesh_, id); f && choose_mirror_image(*f) != Choice_3::impossible)
        mixed_up_[n++] = id;
    mixed_up_.resize(n);
  }

private:
  /// Whether a facet belongs to one side of an acute edge and has a vertex on the other, and which one.
  int vertex_across(const Restricted_facet& f, Surface_hit& image) const
  {
    const double radius = std::sqrt(f.squared_radius);
    for (int i = 1; i <= 3; ++i) {
      const Vertex_handle v = Measure::vertex(f, i);
      if (v->location().dimension == 2 && mesh_.oracle().mirror_at_acute_edge(v->point(), f.steiner, radius, image) &&
          CGAL::to_double(CGAL::squared_distance(image.point, f.steiner)) < 0.99 * f.squared_radius)
        return i;
    }
    return 0;
  }

  bool is_mixed_up(const Restricted_facet& f) const
  {
    Surface_hit image;
    return vertex_across(f, image) != 0;
  }

  Choice_3 choose_mirror_image(const Restricted_facet& f)
  {
    Surface_hit image;
    const int across = vertex_across(f, image);
    if (across == 0) return Choice_3::impossible;
    const Zone_result result = batch_.find_near(image.point, f);
    if (result != Zone_result::found) return batch_.failure(result);
    const double apart = CGAL::to_double(CGAL::squared_distance(Measure::vertex(f, across)->point(), image.point));
    // Pairs that all but exist; this leaves the fewest bad elements beside knife edges.
    if (batch_.chooser().nearest_in(batch_.zone()) < (std::max)(batch_.squared_topology_floor(), 0.15 * 0.15 * apart))
      return Choice_3::impossible;
    if (const Crease_edge* e = batch_.encroached_edge()) return choose(*e, false);
    return batch_.accept({2, image.patch});
  }

  static constexpr double least_acute_floor = 1e-4;
  static constexpr int most_steps = 3;

  const Restricted& mesh_;
  const Measure& measure_;
  Steiner_batch_3<Restricted>& batch_;
  std::vector<Facet_id_3> mixed_up_; ///< facets that have a vertex across an acute edge
  bool leaves_knife_edges_ = false;
  double acute_floor_ = 0.125;                     ///< part of the size down to which elements there are refined
  std::size_t least_left_ = std::size_t(1) << 40;  ///< smallest value of the following before a lowering
  int steps_left_ = most_steps;                    ///< lowerings until that has to get smaller
  std::size_t left_ = 0;                           ///< elements that the batch has left because of it
  std::size_t left_before_ = std::size_t(1) << 40; ///< the same before it was lowered last
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_ACUTE_REFINEMENT_3_H
