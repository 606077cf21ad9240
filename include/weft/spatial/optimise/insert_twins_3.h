// SPDX-License-Identifier: GPL-3.0-or-later
//
// Inserts twins together, see Mirror_twins_3.h, where moving them doesn't help: where a wedge begins at less width than
// vertices are apart along it, cells beside it are slender, though nothing but those vertices forces them. A vertex in
// the middle of an edge of such a cell, and its mirror images, make them shorter.

#ifndef WEFT_SPATIAL_OPTIMISE_INSERT_TWINS_3_H
#define WEFT_SPATIAL_OPTIMISE_INSERT_TWINS_3_H

#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/criteria/forced_elements_3.h>
#include <weft/spatial/domain/Acute_edges_3.h>
#include <weft/spatial/domain/project_on_location_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/Perturbation_judge_3.h>
#include <weft/spatial/restricted/Cell_ids_3.h>
#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/restricted/Vertex_transaction_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace weft::internal {

/// Inserts groups of twins at bad cells; `insert_twins()` runs it.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Twin_inserter_3
{
public:
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Zone = typename Restricted::Zone;

  /// \param most vertices of the mesh, up to which more may be inserted.
  Twin_inserter_3(Restricted& mesh, Criteria_guard_3<Restricted>& guard, std::size_t most,
                  const std::function<bool()>& goes_on)
      : mesh_(mesh), guard_(guard), most_(most), judge_(mesh, guard), goes_on_(goes_on)
  {}

  /// \returns the number of vertices inserted.
  std::size_t run()
  {
    const std::size_t before = mesh_.vertices().size();
    std::size_t trials_left = least_trials + work / (1 + mesh_.triangulation().number_of_finite_cells());
    for (int pass = 0; pass < most_passes; ++pass) {
      const std::size_t at_first = mesh_.vertices().size();
      for (const auto& bad : bad_cells()) {
        if (mesh_.vertices().size() >= most_ || trials_left == 0 || !goes_on_()) break;
        mend(bad.second, trials_left);
      }
      if (mesh_.vertices().size() == at_first) break;
    }
    return mesh_.vertices().size() - before;
  }

private:
  Vertex_handle vertex(int id) const { return mesh_.vertices()[static_cast<std::size_t>(id)]; }

  static double distance(const Point& p, const Point& q)
  {
    return std::sqrt(CGAL::to_double(CGAL::squared_distance(p, q)));
  }

  /// Cells beside twins that are worse than asked for though no small angle forces them; the worst first.
  std::vector<std::pair<double, Cell_ids_3>> bad_cells() const
  {
    std::vector<std::pair<double, Cell_ids_3>> bad;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0) continue;
      int twins = 0;
      for (int i = 0; i < 4; ++i) twins += mesh_.is_fixed_with_twin(c->vertex(i));
      if (twins < 2) continue;
      const double x = judge_.measure(c);
      if (!(x > bound_) || forcing_angle(mesh_, c) < largest_angle_with_twins) continue;
      bad.push_back({-x, ids_of_cell(c)});
    }
    std::sort(bad.begin(), bad.end());
    return bad;
  }

  /// Tries the edges between twins of a cell, the longest first.
  void mend(const Cell_ids_3& ids, std::size_t& trials_left)
  {
    if (find_cell(mesh_, ids) == Cell_handle()) return;
    std::vector<std::pair<double, std::array<int, 2>>> edges;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const Vertex_handle v = vertex(ids[i]), w = vertex(ids[j]);
        if (mesh_.is_fixed_with_twin(v) || mesh_.is_fixed_with_twin(w))
          edges.push_back({-distance(v->point(), w->point()), {{ids[i], ids[j]}}});
      }
    std::sort(edges.begin(), edges.end());
    for (const auto& [length, ends] : edges)
      for (const Vertex_location_3& at : common_locations(vertex(ends[0])->location(), vertex(ends[1])->location()))
        for (const double part : {0.5, 0.42, 0.58, 0.34, 0.66}) {
          const Point &a = vertex(ends[0])->point(), &b = vertex(ends[1])->point();
          const std::optional<Point> p = project_on_location(mesh_.oracle(), a + part * (b - a), at);
          if (!p || !find_group(*p, at, -length)) continue;
          if (trials_left == 0) return;
          --trials_left;
          if (betters() && insert_group()) return;
        }
  }

  /// The crease that both of two vertices lie on, or else the patches.
  std::vector<Vertex_location_3> common_locations(const Vertex_location_3& a, const Vertex_location_3& b) const
  {
    std::vector<Vertex_location_3> result;
    const Feature_incidence_3& incidence = mesh_.incidence();
    const auto lies_on = [&](const Vertex_location_3& at, int crease) {
      return at.dimension == 1 ? at.index == crease
                               : at.dimension == 0 && incidence.corner_is_on_crease(at.index, crease);
    };
    for (const auto& [one, other] : {std::make_pair(a, b), std::make_pair(b, a)})
      if (result.empty() && one.dimension == 1 && lies_on(other, one.index)) result.push_back(one);
    if (!result.empty()) return result;
    for (const auto& [one, other] : {std::make_pair(a, b), std::make_pair(b, a)}) {
      if (one.dimension == 2 && incidence.is_on_patch(other, one.index)) return {one};
      if (one.dimension != 1 || other.dimension > 1 || !result.empty()) continue;
      for (const int patch : incidence.patches_of_crease(one.index))
        if (incidence.is_on_patch(other, patch)) result.push_back({2, patch});
    }
    return result;
  }

  /// Finds a new vertex and its images, and how bad the cells are that they will replace; false if another vertex is
  /// too near.
  bool find_group(const Point& p, const Vertex_location_3& at, double length)
  {
    points_.clear();
    locations_.clear();
    worst_before_ = -1;
    double nearest = look_around(p);
    if (!(nearest > least_distance * length)) return false;
    std::vector<double> spacings{nearest};
    points_.push_back(p);
    locations_.push_back(at);
    for (std::size_t i = 0; i < points_.size() && points_.size() <= most_twins; ++i) {
      std::vector<std::pair<Point, Vertex_location_3>> images;
      mesh_.oracle().visit_mirror_images(points_[i], locations_[i], spacings[i],
                                         [&](const Point& image, const Vertex_location_3& where) {
                                           images.push_back({image, where});
                                         });
      const Point from = points_[i];
      for (const auto& [image, where] : images) {
        const double apart = distance(from, image);
        double next = HUGE_VAL;
        for (const Point& q : points_) next = (std::min)(next, distance(q, image));
        if (!(next > close * apart)) continue;
        nearest = look_around(image);
        if (!(nearest > close * apart)) continue;
        points_.push_back(image);
        locations_.push_back(where);
        spacings.push_back(nearest);
      }
    }
    return points_.size() <= most_twins;
  }

  /// The distance to the nearest vertex, 0 where a point can't be inserted; adds the cells of its zone to
  /// `worst_before_`.
  double look_around(const Point& p)
  {
    if (find_conflict_zone(mesh_.triangulation(), p, mesh_.vertices().back()->cell(), zone_) != Zone_result::found)
      return 0;
    double nearest = HUGE_VAL;
    for (const Cell_handle c : zone_.cells) {
      for (int i = 0; i < 4; ++i) nearest = (std::min)(nearest, distance(p, c->vertex(i)->point()));
      if (c->subdomain() != 0) worst_before_ = (std::max)(worst_before_, judge_.measure(c));
    }
    return nearest;
  }

  /// Whether what `find_group()` has found betters the worst cell, or leaves what the perturber mends, whatever becomes
  /// of the boundary.
  bool betters()
  {
    std::size_t n = 0;
    for (; n < points_.size(); ++n) {
      const Cell_handle near = mesh_.vertices().back()->cell();
      if (find_conflict_zone(mesh_.triangulation(), points_[n], near, zone_) != Zone_result::found) break;
      Vertex_transaction_3<Restricted>(mesh_, zone_, locations_[n]).commit();
    }
    double after = -1;
    for (std::size_t i = 0; i < n; ++i) {
      star_.clear();
      mesh_.triangulation().incident_cells(mesh_.vertices()[mesh_.vertices().size() - 1 - i],
                                           std::back_inserter(star_));
      for (const Cell_handle c : star_)
        if (c->subdomain() != 0) after = (std::max)(after, judge_.measure(c));
    }
    take_back(n);
    return n == points_.size() &&
           after < (std::max)(worst_before_ - Perturbation_judge_3<Restricted>::least_gain, mendable_);
  }

  /// Inserts it, all at once: so the guard sees all that is new. Takes it back unless the guard accepts it.
  bool insert_group()
  {
    mesh_.insert(points_, locations_);
    if (guard_.refusal() != Refusal_3::none) {
      take_back(points_.size());
      return false;
    }
    const std::size_t n = mesh_.vertices().size();
    for (std::size_t i = n - points_.size(); i < n && points_.size() > 1; ++i) mesh_.fix_with_twin(mesh_.vertices()[i]);
    return true;
  }

  void take_back(std::size_t n)
  {
    for (; n > 0; --n) {
      Vertex_transaction_3<Restricted> removal(mesh_, mesh_.vertices().back());
      removal.leave_out();
      removal.commit();
    }
  }

  static constexpr int most_passes = 6;
  static constexpr std::size_t most_twins = 8;
  static constexpr double least_distance = 0.25; ///< of a new vertex from others, in parts of its edge
  static constexpr double close = 0.25;          ///< as in Mirror_twins_3
  static constexpr std::size_t least_trials = 200, work = 5000000; ///< one that succeeds looks at all cells

  Restricted& mesh_;
  Criteria_guard_3<Restricted>& guard_;
  std::size_t most_; ///< vertices
  Perturbation_judge_3<Restricted> judge_;
  const std::function<bool()>& goes_on_;
  const double bound_ = cosine_of_degrees(20);
  const double mendable_ = cosine_of_degrees(16); ///< shorter edges leave the vertices around more room
  std::vector<Cell_handle> star_;
  std::vector<Point> points_; ///< of the group to be inserted
  std::vector<Vertex_location_3> locations_;
  double worst_before_ = -1;
  Zone zone_;
};

/// Inserts twins at cells that are worse than 20 degrees though no small angle forces them, as long as that betters
/// them or leaves what the perturber can mend. Linear in the size of the mesh for each trial, of which there are the
/// fewer the larger the mesh is.
/// \param most vertices of the mesh, up to which more may be inserted.
/// \returns the number of vertices inserted.
template <class Restricted>
std::size_t insert_twins(Restricted& mesh, Criteria_guard_3<Restricted>& guard, std::size_t most,
                         const std::function<bool()>& goes_on)
{
  if (!mesh.oracle().has_mirror_images()) return 0;
  return Twin_inserter_3<Restricted>(mesh, guard, most, goes_on).run();
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_INSERT_TWINS_3_H
