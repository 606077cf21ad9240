// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first vertices of a mesh (Tournois 2009, sec. 3.2.1.3): feature vertices, points on creases, and seeds on patches
// that would else be overlooked.

#ifndef WEFT_SPATIAL_REFINE_BOUNDARY_SEEDER_3_H
#define WEFT_SPATIAL_REFINE_BOUNDARY_SEEDER_3_H

#include <weft/internal/boxes/Point_grid_3.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/domain/Boundary_distance_3.h>
#include <weft/spatial/domain/boundary_samples_3.h>
#include <weft/spatial/refine/Crease_divider_3.h>
#include <weft/spatial/refine/Mirror_twins_3.h>
#include <weft/spatial/refine/Refinement_policy_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Boundary_seeder_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Vertex_handle = typename Restricted::Vertex_handle;

  /// \param most_vertices of the mesh. Feature vertices and the fewest points that make a polygon of a crease are
  ///   inserted all the same.
  Boundary_seeder_3(Restricted& mesh, const Criteria_3<Kernel>& criteria, std::size_t most_vertices,
                    const Refinement_policy_3& policy = Refinement_policy_3())
      : mesh_(mesh),
        criteria_(criteria),
        most_vertices_(most_vertices),
        policy_(policy),
        has_twins_(policy.mirrors && mesh.oracle().has_mirror_images()),
        twins_(mesh)
  {}

  void insert_corners()
  {
    for (std::size_t i = 0; i < mesh_.oracle().number_of_corners(); ++i)
      mesh_.insert(mesh_.oracle().corner(i), {0, static_cast<int>(i)});
  }

  /// Cuts creases into equal parts where that takes fewer of them than halving would, cycles and loops with one feature
  /// vertex into three at least: the fewest that make a polygon.
  void insert_crease_seeds()
  {
    const auto& oracle = mesh_.oracle();
    if (has_twins_) {
      insert_crease_seeds_with_twins();
      return;
    }
    for (std::size_t c = 0; c < oracle.number_of_creases(); ++c) {
      const auto& points = mesh_.creases().points(c);
      const Crease_divider_3<Kernel> divider(points, criteria_,
                                             mesh_.incidence().patches_of_crease(static_cast<int>(c)));
      const std::size_t least = points.front() == points.back() ? 3 : 1,
                        parts = policy_.shapes_creases ? divider.parts(least) : least;
      for (std::size_t k = oracle.crease_is_closed(static_cast<int>(c)) ? 0 : 1; k < parts; ++k) {
        if (k >= least && !has_room()) break;
        mesh_.insert(divider.at(static_cast<double>(k) / static_cast<double>(parts)), {1, static_cast<int>(c)});
      }
    }
  }

  /// Up to n more points on every patch without a facet; returns how many there were.
  std::size_t seed_bare_patches(std::size_t n)
  {
    const auto& oracle = mesh_.oracle();
    std::vector<char> has_facet(static_cast<std::size_t>(oracle.number_of_patches()), false);
    for (const auto& f : mesh_.facets())
      if (f.cell != typename Restricted::Cell_handle()) has_facet[static_cast<std::size_t>(f.patch)] = true;
    seeded_.resize(has_facet.size(), 0);
    std::size_t inserted = 0;
    for (std::size_t p = 0; p < has_facet.size(); ++p) {
      if (has_facet[p] || seeded_[p] >= most_seeds || !oracle.is_expected(static_cast<int>(p))) continue;
      const auto seeds = oracle.patch_seeds(static_cast<int>(p), seeded_[p] + n);
      for (std::size_t k = seeded_[p]; k < seeds.size() && has_room(); ++k, ++inserted)
        insert_with_twins(seeds[k].point, {2, static_cast<int>(p)});
      seeded_[p] += n;
    }
    return inserted;
  }

  /// Inserts points of the boundary that no facet of their patch is near to; returns how many there were. Refinement
  /// sees a surface only where facets are, and goes on from there ring by ring: this takes it to where none are.
  std::size_t seed_missed()
  {
    const auto& oracle = mesh_.oracle();
    using Oracle = std::decay_t<decltype(oracle)>;
    if constexpr (Has_boundary_samples_3<Oracle>::value && Has_thickness_3<Oracle>::value) {
      if (!criteria_.approximation || !criteria_.approximation.is_constant()) return 0;
      const double approximation = criteria_.approximation.constant();
      Boundary_distance_3<Kernel> distance(static_cast<std::size_t>(oracle.number_of_patches()), 0);
      for (const auto& f : mesh_.facets()) {
        if (f.cell == typename Restricted::Cell_handle()) continue;
        // Seen from outside the cell that the facet belongs to.
        const int here = f.cell->subdomain(), there = f.cell->neighbor(f.index)->subdomain();
        const bool is_own = here != 0 && (there == 0 || here < there);
        const auto at = [&f](int i) {
          return f.cell->vertex(Restricted::Triangulation::vertex_triple_index(f.index, i))->point();
        };
        distance.add_facet(at(is_own ? 2 : 0), at(1), at(is_own ? 0 : 2), f.patch);
      }
      distance.build();
      std::vector<std::pair<Point, Vertex_location_3>> missed;
      Point_grid_3 chosen(0.25 * approximation);
      const auto bound = [approximation](const Point&, int) { return approximation; };
      visit_missed_samples(oracle, distance, spacing_of_missed * approximation, bound,
                           [&](const Point& p, int patch, const std::array<double, 3>& normal) {
                             if (mesh_.vertices().size() + missed.size() >= most_vertices_) return;
                             const double apart =
                                 (std::max)(0.25 * approximation, 0.8 * oracle.thickness(p, normal, 4 * approximation));
                             if (chosen.add(xyz(p), apart)) missed.push_back({p, {2, patch}});
                           });
      const std::size_t before = mesh_.vertices().size();
      for (const auto& [p, location] : missed) insert_with_twins(p, location); // one by one: some may be vertices
      return mesh_.vertices().size() - before;
    } else {
      return 0;
    }
  }

private:
  /// The same where creases meet at small angles: the longest first, and of the others what twins have left.
  void insert_crease_seeds_with_twins()
  {
    const auto& oracle = mesh_.oracle();
    const std::size_t n = oracle.number_of_creases();
    std::vector<Crease_divider_3<Kernel>> dividers;
    std::vector<std::size_t> order;
    for (std::size_t c = 0; c < n; ++c) {
      dividers.emplace_back(mesh_.creases().points(c), criteria_,
                            mesh_.incidence().patches_of_crease(static_cast<int>(c)));
      order.push_back(c);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return dividers[a].length() > dividers[b].length(); });
    twins_on_crease_.assign(n, {});
    for (const std::size_t c : order) {
      const bool is_closed = oracle.crease_is_closed(static_cast<int>(c));
      const std::size_t least = dividers[c].is_loop() ? 3 : 1;
      const auto fractions = dividers[c].fractions(least, is_closed, twins_on_crease_[c]);
      std::size_t on_crease = twins_on_crease_[c].size() + !is_closed;
      for (const double fraction : fractions) {
        if (on_crease++ >= least && !has_room()) break;
        insert_with_twins(dividers[c].at(fraction), {1, static_cast<int>(c)});
      }
    }
    for (std::size_t i = 0; i < oracle.number_of_corners(); ++i) insert_twins(mesh_.vertices()[i]);
  }

  void insert_with_twins(const Point& p, const Vertex_location_3& location)
  {
    const Vertex_handle v = mesh_.insert(p, location);
    if (v != Vertex_handle() && has_twins_) insert_twins(v);
  }

  void insert_twins(Vertex_handle v)
  {
    double spacing = size_at(v->point());
    neighbours_.clear();
    mesh_.triangulation().finite_adjacent_vertices(v, std::back_inserter(neighbours_));
    for (const Vertex_handle w : neighbours_)
      spacing = (std::min)(spacing, std::sqrt(CGAL::to_double(CGAL::squared_distance(v->point(), w->point()))));
    twins_.add(v->point(), v->location(), spacing);
    const std::size_t room = most_vertices_ - (std::min)(most_vertices_, mesh_.vertices().size());
    twins_.insert(room, [this](const auto& zone, const Vertex_location_3& location) {
      mesh_.insert(zone.point, location);
      if (location.dimension == 1 && !twins_on_crease_.empty())
        twins_on_crease_[static_cast<std::size_t>(location.index)].push_back(zone.point);
    });
  }

  double size_at(const Point& p) const
  {
    return criteria_.size.is_constant() ? criteria_.size.constant() : criteria_.size(p);
  }

  bool has_room() const { return mesh_.vertices().size() < most_vertices_; }

  static constexpr std::size_t most_seeds = 40;  ///< of a patch
  static constexpr double spacing_of_missed = 4; ///< in approximation bounds: of the points looked at

  Restricted& mesh_;
  const Criteria_3<Kernel>& criteria_;
  std::size_t most_vertices_;
  Refinement_policy_3 policy_;
  bool has_twins_;
  std::vector<std::size_t> seeded_; ///< by patch, how many seeds it has been given
  Mirror_twins_3<Restricted> twins_;
  std::vector<std::vector<Point>> twins_on_crease_;
  std::vector<Vertex_handle> neighbours_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_BOUNDARY_SEEDER_3_H
