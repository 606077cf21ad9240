// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Steiner points of one batch (Tournois 2009, sec. 3.2.1.4): points whose conflict zones are independent, since
// each zone is claimed once its point is accepted, and which are inserted together.

#ifndef WEFT_SPATIAL_REFINE_STEINER_BATCH_3_H
#define WEFT_SPATIAL_REFINE_STEINER_BATCH_3_H

#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/refine/crease_steiner_point_3.h>
#include <weft/spatial/refine/Mirror_twins_3.h>
#include <weft/spatial/refine/Refinement_policy_3.h>
#include <weft/spatial/refine/Steiner_chooser_3.h>
#include <weft/spatial/refine/Steiner_proposals_3.h>
#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/restricted/spatial_order_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// What came of the attempt to choose a Steiner point.
enum class Choice_3
{
  chosen,
  later,     ///< its zone touches another's, or the element is left as it is
  impossible ///< at the size floor, or out of its own zone by rounding
};

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Steiner_batch_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Zone = typename Restricted::Zone;
  using Restricted_facet = typename Restricted::Restricted_facet;
  using Crease_edge = typename Restricted::Crease_edge;
  using Measure = Badness_measure_3<Restricted>;
  using Chooser = Steiner_chooser_3<Restricted>;

  /// \param squared_floor no point is accepted closer than that to a vertex, but for the topology.
  Steiner_batch_3(Restricted& mesh, const Measure& measure, double squared_floor,
                  const Refinement_policy_3& policy = Refinement_policy_3())
      : mesh_(mesh),
        squared_floor_(squared_floor),
        policy_(policy),
        chooser_(mesh, measure, squared_floor),
        twins_(mesh),
        has_twins_(policy.mirrors && mesh.oracle().has_mirror_images())
  {}

  const Refinement_policy_3& policy() const { return policy_; }

  /// Begins a batch of at most `room` points.
  void begin(std::size_t room)
  {
    room_ = room;
    used_ = 0;
    number_ = ++mesh_.batches();
  }

  Chooser& chooser() { return chooser_; }
  const Chooser& chooser() const { return chooser_; }
  int number() const { return number_; }
  std::size_t size() const { return used_; }
  bool is_full() const { return used_ >= room_; }

  double squared_floor() const { return squared_floor_; }
  /// Where only the topology is at stake.
  double squared_topology_floor() const { return topology_floor * topology_floor * squared_floor_; }

  /// The zone found last, if its point hasn't been accepted.
  Zone& zone()
  {
    if (chosen_.size() == used_) chosen_.emplace_back();
    return chosen_[used_].zone;
  }

  Zone_result find(const Point& p, Cell_handle start)
  {
    ++candidates_;
    return find_conflict_zone(mesh_.triangulation(), p, start, number_, zone());
  }

  Zone_result find_near(const Point& p, const Restricted_facet& f)
  {
    ++candidates_;
    return chooser_.find(p, f, number_, zone());
  }

  /// What was found ahead.
  Zone_result take(typename Steiner_proposals_3<Restricted>::Proposal& proposal)
  {
    candidates_ += proposal.candidates;
    if (proposal.is_claimed(number_)) return Zone_result::claimed;
    std::swap(zone(), proposal.zone);
    return proposal.result;
  }

  /// The best point for a facet or cell.
  template <class Element>
  Zone_result find_best(const Element& element)
  {
    ++candidates_;
    return chooser_.choose(element, number_, zone());
  }

  /// The crease edge that the point of `zone()` encroaches upon, to be refined in its place, or null.
  const Crease_edge* encroached_edge()
  {
    const Crease_edge* e = chooser_.encroached_edge(zone());
    encroachments_ += e != nullptr;
    return e;
  }

  /// The same for facets.
  const Restricted_facet* encroached_facet()
  {
    const Restricted_facet* f = chooser_.encroached_facet(zone());
    encroachments_ += f != nullptr;
    return f;
  }

  /// Takes the point of `zone()` and claims the zone.
  Choice_3 accept(const Vertex_location_3& location)
  {
    if (used_ >= room_) return Choice_3::later;
    claim(chosen_[used_].zone, number_);
    chosen_[used_++].location = location;
    return Choice_3::chosen;
  }

  static Choice_3 failure(Zone_result result)
  {
    return result == Zone_result::claimed ? Choice_3::later : Choice_3::impossible;
  }

  /// The Steiner point of a crease edge.
  Choice_3 choose(const Crease_edge& e)
  {
    const Point p = policy_.shapes_creases ? crease_steiner_point(mesh_, e) : e.steiner;
    if (nearest_end(e, p) < squared_floor_) return Choice_3::impossible;
    const Zone_result result = find(p, mesh_.triangulation().locate(p, e.source->cell()));
    return result == Zone_result::found ? accept({1, e.steiner_crease}) : failure(result);
  }

  /// Inserts the points along a space-filling curve: cells made one after the other stand side by side in memory.
  /// \param before `before(cells)` is called with those that a point is about to replace.
  template <class Before>
  void insert(const Before& before)
  {
    std::vector<Point> points;
    for (std::size_t k = 0; k < used_; ++k) points.push_back(chosen_[k].zone.point);
    for (const std::size_t k : order_along_curve_3<Kernel>(points)) {
      if (has_twins_) twins_.add(points[k], chosen_[k].location, std::sqrt(chooser_.nearest_in(chosen_[k].zone)));
      before(chosen_[k].zone.cells);
      mesh_.insert(chosen_[k].zone, chosen_[k].location);
    }
    mesh_.update();
  }

  /// Inserts the twins of what was inserted last, see Mirror_twins_3.h, one by one.
  /// \param before as above.
  /// \param after called after each.
  template <class Before, class After>
  void insert_twins(const Before& before, const After& after)
  {
    if (!has_twins_) return;
    twins_.insert(room_ - used_, [&](const Zone& zone, const Vertex_location_3& location) {
      before(zone.cells);
      mesh_.insert(zone, location);
      mesh_.update();
      after();
    });
  }

  std::size_t candidates() const { return candidates_; }
  void add_candidates(std::size_t n) { candidates_ += n; }
  std::size_t encroachments() const { return encroachments_; }

private:
  struct Chosen
  {
    Zone zone;
    Vertex_location_3 location;
  };

  static double nearest_end(const Crease_edge& e, const Point& p)
  {
    return CGAL::to_double(
        (std::min)(CGAL::squared_distance(p, e.source->point()), CGAL::squared_distance(p, e.target->point())));
  }

  /// Part of the size floor down to which the topology is mended. At a sharp edge that nobody marked, whether the disks
  /// come out right is luck at every scale, so it takes a few more halvings than distances do.
  static constexpr double topology_floor = 0.1;

  Restricted& mesh_;
  double squared_floor_;
  Refinement_policy_3 policy_;
  Chooser chooser_;
  Mirror_twins_3<Restricted> twins_;
  bool has_twins_;
  std::vector<Chosen> chosen_; ///< the first `used_` are those of the batch
  std::size_t used_ = 0, room_ = 0;
  int number_ = 0;
  std::size_t candidates_ = 0, encroachments_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_STEINER_BATCH_3_H
