// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves twins together, see Mirror_twins_3.h: each of a group of mirror images goes to the mirror image of where the
// first one goes, so that they stay twins. That mends cells which none of their vertices may leave alone: where sheets
// are very near to each other, all vertices have twins (Tournois 2009, sec. 3.2.2, moves one vertex at a time).

#ifndef WEFT_SPATIAL_OPTIMISE_MOVE_TWINS_3_H
#define WEFT_SPATIAL_OPTIMISE_MOVE_TWINS_3_H

#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/domain/project_on_location_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/Perturbation_judge_3.h>
#include <weft/spatial/restricted/Cell_ids_3.h>
#include <weft/spatial/restricted/Mesh_relocation_3.h>
#include <weft/spatial/restricted/Relocator_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace weft::internal {

/// Moves groups of twins at bad cells; `move_twins()` runs it.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Twin_mover_3
{
public:
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;

  /// \param share of the usual trials.
  Twin_mover_3(Restricted& mesh, Criteria_guard_3<Restricted>& guard, unsigned seed, double share,
               const std::function<bool()>& goes_on)
      : mesh_(mesh), guard_(guard), share_(share), judge_(mesh, guard), goes_on_(goes_on), random_(seed)
  {}

  /// \returns the number of moves that were kept.
  std::size_t run()
  {
    const std::size_t usual = least_trials + work / (1 + mesh_.triangulation().number_of_finite_cells());
    trials_left_ = static_cast<std::size_t>(share_ * static_cast<double>(usual));
    std::size_t moved = 0;
    for (int pass = 0; pass < most_passes; ++pass) {
      std::size_t in_pass = 0;
      for (const auto& bad : bad_cells()) {
        if (trials_left_ == 0 || !goes_on_()) return moved + in_pass;
        in_pass += mend(bad.second);
      }
      moved += in_pass;
      if (in_pass == 0) break;
    }
    return moved;
  }

private:
  struct Group
  {
    std::vector<int> ids;
    std::vector<std::size_t> parents; ///< of whom each is the image, by place
    double spacing = 0;               ///< from the first vertex to its nearest neighbour without the group
  };

  Vertex_handle vertex(int id) const { return mesh_.vertices()[static_cast<std::size_t>(id)]; }

  static double distance(const Point& p, const Point& q)
  {
    return std::sqrt(CGAL::to_double(CGAL::squared_distance(p, q)));
  }

  /// Cells that have vertices with twins and are worse than asked for, the worst first.
  std::vector<std::pair<double, Cell_ids_3>> bad_cells() const
  {
    std::vector<std::pair<double, Cell_ids_3>> bad;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0) continue;
      bool has_twins = false;
      for (int i = 0; i < 4; ++i) has_twins = has_twins || mesh_.is_fixed_with_twin(c->vertex(i));
      if (!has_twins) continue;
      const double x = judge_.measure(c);
      if (x > bound_) bad.push_back({-x, ids_of_cell(c)});
    }
    std::sort(bad.begin(), bad.end());
    return bad;
  }

  /// Tries groups of the vertices of a cell by turns, ever shorter moves.
  /// \returns the number of moves that were kept.
  std::size_t mend(const Cell_ids_3& ids)
  {
    std::vector<Group> groups;
    for (const int id : ids)
      if (mesh_.is_fixed_with_twin(vertex(id))) {
        Group group = group_of(id);
        if (!group.ids.empty()) groups.push_back(std::move(group));
      }
    for (int k = 0; k < most_trials && !groups.empty(); ++k) {
      const Cell_handle c = find_cell(mesh_, ids);
      if (c == Cell_handle() || !(judge_.measure(c) > bound_)) return 0;
      if (trials_left_ == 0 || !goes_on_()) return 0; // a trial takes long in a large mesh
      --trials_left_;
      const auto& group = groups[static_cast<std::size_t>(k) % groups.size()];
      const double reach = farthest * std::pow(0.9, static_cast<double>(k) / static_cast<double>(groups.size()));
      if (move(group, reach * group.spacing)) return 1;
    }
    return 0;
  }

  /// A vertex and its twins, the twins of these and so on; empty if one of them isn't to move.
  Group group_of(int id)
  {
    Group group{{id}, {0}, HUGE_VAL};
    for (std::size_t at = 0; at < group.ids.size(); ++at) {
      const Vertex_handle v = vertex(group.ids[at]);
      neighbours_.clear();
      mesh_.triangulation().finite_adjacent_vertices(v, std::back_inserter(neighbours_));
      double farthest_neighbour = 0;
      for (const Vertex_handle w : neighbours_)
        if (w->location().dimension >= 0)
          farthest_neighbour = (std::max)(farthest_neighbour, distance(v->point(), w->point()));
      mesh_.oracle().visit_mirror_images(
          v->point(), v->location(), farthest_neighbour, [&](const Point& image, const Vertex_location_3&) {
            for (const Vertex_handle w : neighbours_) {
              if (w->id() < 0 || !(distance(w->point(), image) < same * distance(v->point(), image))) continue;
              if (std::find(group.ids.begin(), group.ids.end(), w->id()) != group.ids.end()) continue;
              group.ids.push_back(w->id());
              group.parents.push_back(at);
            }
          });
      if (group.ids.size() > most_twins) return {};
    }
    for (const int member : group.ids)
      if (mesh_.is_fixed(vertex(member)) && !mesh_.is_fixed_with_twin(vertex(member))) return {};
    neighbours_.clear();
    mesh_.triangulation().finite_adjacent_vertices(vertex(id), std::back_inserter(neighbours_));
    for (const Vertex_handle w : neighbours_)
      if (w->id() >= 0 && std::find(group.ids.begin(), group.ids.end(), w->id()) == group.ids.end())
        group.spacing = (std::min)(group.spacing, distance(w->point(), vertex(id)->point()));
    return std::isfinite(group.spacing) ? group : Group();
  }

  /// Where a group goes if its first vertex goes to a point near `wanted`; nothing where an image fails.
  bool find_targets(const Group& group, const Point& wanted, std::vector<Point>& targets)
  {
    const Vertex_handle first = vertex(group.ids[0]);
    const std::optional<Point> p = project_on_location(mesh_.oracle(), wanted, first->location());
    if (!p) return false;
    targets.assign(1, *p);
    for (std::size_t k = 1; k < group.ids.size(); ++k) {
      const Vertex_handle parent = vertex(group.ids[group.parents[k]]), twin = vertex(group.ids[k]);
      const Point& from = targets[group.parents[k]];
      const double apart = distance(parent->point(), twin->point());
      std::optional<Point> nearest;
      mesh_.oracle().visit_mirror_images(
          from, parent->location(), 2 * apart + group.spacing, [&](const Point& image, const Vertex_location_3& at) {
            if (at != twin->location()) return;
            if (!nearest || distance(image, twin->point()) < distance(*nearest, twin->point())) nearest = image;
          });
      if (!nearest || !(distance(*nearest, twin->point()) < group.spacing)) return false;
      // Near a crease images lie on it. A twin that stays behind there is none any more, and cells between them are
      // flat.
      const double way = distance(from, parent->point());
      if (std::abs(distance(*nearest, twin->point()) - way) > as_far * way) return false;
      targets.push_back(*nearest);
    }
    return true;
  }

  /// One random move, taken back unless the worst cell around gets better and the guard accepts it.
  bool move(const Group& group, double reach)
  {
    const auto draw = [this] { return 2 * (static_cast<double>(random_()) / 4294967295.0) - 1; };
    const Point& origin = vertex(group.ids[0])->point();
    const double x = draw(), y = draw(), z = draw();
    std::vector<Point> targets, old;
    if (!find_targets(group, Point(origin.x() + reach * x, origin.y() + reach * y, origin.z() + reach * z), targets))
      return false;
    double before = -1, after = -1;
    for (const int id : group.ids) {
      old.push_back(vertex(id)->point());
      star_.clear();
      mesh_.triangulation().incident_cells(vertex(id), std::back_inserter(star_));
      for (const Cell_handle c : star_)
        if (c->subdomain() != 0) before = (std::max)(before, judge_.measure(c));
    }
    relocate(mesh_, group.ids, targets);
    for (const Cell_handle c : mesh_.new_cells())
      if (c->subdomain() != 0) after = (std::max)(after, judge_.measure(c));
    if (after < before - Perturbation_judge_3<Restricted>::least_gain && guard_.refusal() == Refusal_3::none)
      return true;
    relocate(mesh_, group.ids, old);
    return false;
  }

  static constexpr double same = 1e-6;     ///< part of the distance of twins
  static constexpr double as_far = 0.01;   ///< ways of twins differ by no more than this part
  static constexpr double farthest = 0.35; ///< of the first moves, in parts of the distance to neighbours
  static constexpr int most_passes = 8, most_trials = 40;
  static constexpr std::size_t most_twins = 8;
  static constexpr std::size_t least_trials = 200, work = 20000000; ///< a trial looks at all cells

  Restricted& mesh_;
  Criteria_guard_3<Restricted>& guard_;
  double share_;
  Perturbation_judge_3<Restricted> judge_;
  const std::function<bool()>& goes_on_;
  std::mt19937 random_;
  const double bound_ = cosine_of_degrees(20);
  std::size_t trials_left_ = 0;
  std::vector<Vertex_handle> neighbours_;
  std::vector<Cell_handle> star_;
};

/// Moves twins at cells that are worse than 20 degrees, or than what their wedge allows, as long as that betters them.
/// Linear in the size of the mesh for each trial, of which there are the fewer the larger the mesh is.
/// \param share of the usual trials.
/// \returns the number of moves that were kept.
template <class Restricted>
std::size_t move_twins(Restricted& mesh, Criteria_guard_3<Restricted>& guard, unsigned seed, double share,
                       const std::function<bool()>& goes_on)
{
  if (!mesh.oracle().has_mirror_images()) return 0;
  return Twin_mover_3<Restricted>(mesh, guard, seed, share, goes_on).run();
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_MOVE_TWINS_3_H
