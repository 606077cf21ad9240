// SPDX-License-Identifier: GPL-3.0-or-later
//
// Better cells between twins, see Mirror_twins_3.h. Two triangles that are mirror images of each other are the ends of
// a prism whose vertices lie on a sphere but for what `off_symmetry()` of the oracle has added, which decides about the
// diagonals of the prism. Other random shifts, far below any tolerance, turn diagonals: what sliver exudation does with
// weights (Cheng, Dey, Edelsbrunner, Facello, Teng, "Sliver exudation", 2000).

#ifndef WEFT_SPATIAL_OPTIMISE_TURN_DIAGONALS_3_H
#define WEFT_SPATIAL_OPTIMISE_TURN_DIAGONALS_3_H

#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/Perturbation_judge_3.h>
#include <weft/spatial/restricted/Vertex_transaction_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <random>
#include <vector>

namespace weft::internal {

/// Shifts twins at bad cells at random, each a few times, and keeps what betters the worst cell around it.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
void turn_diagonals(Restricted& mesh, Criteria_guard_3<Restricted>& guard, unsigned seed)
{
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Point = typename Restricted::Point;
  using Judge = Perturbation_judge_3<Restricted>;
  if (!mesh.oracle().has_mirror_images()) return;
  constexpr int most_passes = 6, trials = 24, most_shifts = 4; // of a vertex
  const CGAL::Bbox_3 b = mesh.oracle().bbox();
  const double step = 1e-11 * (std::max)({std::abs(b.xmin()), std::abs(b.xmax()), std::abs(b.ymin()),
                                          std::abs(b.ymax()), std::abs(b.zmin()), std::abs(b.zmax())});
  const double bound = cosine_of_degrees(25);
  Judge judge(mesh, guard);
  Perturb_report_3 report;
  std::mt19937 random(seed);
  std::vector<int> shifts(mesh.vertices().size(), 0);
  for (int pass = 0; pass < most_passes; ++pass) {
    std::map<int, double> candidates; // by vertex
    for (const Cell_handle c : mesh.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0) continue;
      const double x = judge.measure(c);
      if (x <= bound) continue;
      for (int i = 0; i < 4; ++i)
        if (mesh.is_fixed_with_twin(c->vertex(i))) candidates[c->vertex(i)->id()] = x;
    }
    std::size_t turned = 0;
    for (const auto& candidate : candidates) {
      const auto id = static_cast<std::size_t>(candidate.first);
      const Vertex_handle v = mesh.vertices()[id];
      if (shifts[id] == most_shifts) continue;
      std::vector<Cell_handle> star;
      mesh.triangulation().incident_cells(v, std::back_inserter(star));
      double worst = -1, nearest = HUGE_VAL, nearest_along = HUGE_VAL;
      Vertex_handle twin, next; // next: of the same crease
      for (const Cell_handle c : star) {
        if (c->subdomain() != 0) worst = (std::max)(worst, judge.measure(c));
        for (int i = 0; i < 4; ++i) {
          const Vertex_handle w = c->vertex(i);
          const double d = CGAL::to_double(CGAL::squared_distance(v->point(), w->point()));
          if (w == v) continue;
          if (d < nearest) nearest = d, twin = w;
          if (v->location().dimension == 1 && w->location() == v->location() && d < nearest_along)
            nearest_along = d, next = w;
        }
      }
      if (worst <= bound) continue;
      // Where a crease has twins on both sides, a shift towards one of them lifts it out of the plane of the others.
      std::vector<typename Restricted::Kernel::Vector_3> ways{(twin->point() - v->point()) / std::sqrt(nearest)};
      if (next != Vertex_handle()) ways.push_back((next->point() - v->point()) / std::sqrt(nearest_along));
      const Vertex_location_3 location = v->location();
      judge.set_location(location);
      Vertex_transaction_3<Restricted> change(mesh, v);
      judge.set_filling(change.filling());
      Cell_handle near = change.filling().front();
      bool kept = false;
      for (int k = 0; k < trials && !kept; ++k) {
        const double shift = step * (2 * (static_cast<double>(random()) / 4294967295.0) - 1);
        const Point p = change.origin() + shift * ways[static_cast<std::size_t>(k) % ways.size()];
        if (!judge.find_zone(p, near)) continue;
        if (judge.judge(worst - Judge::least_gain) >= worst - Judge::least_gain) continue;
        change.place(judge.zone());
        if (judge.is_acceptable(report)) {
          change.commit();
          kept = true;
          break;
        }
        change.take_out_again();
        judge.set_filling(change.filling());
        near = change.filling().front();
      }
      if (!kept) {
        change.roll_back();
        continue;
      }
      ++shifts[id];
      ++turned;
    }
    if (turned == 0) break;
  }
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_TURN_DIAGONALS_3_H
