// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a perturbed vertex would do to the mesh: the angles of the cells that it would make, judged by the conflict zone
// of a place before anything is inserted, and whether the boundary is still a surface and every criterion met after it
// was (Tournois 2009, sec. 3.2.2, Alg. 7).

#ifndef WEFT_SPATIAL_OPTIMISE_PERTURBATION_JUDGE_3_H
#define WEFT_SPATIAL_OPTIMISE_PERTURBATION_JUDGE_3_H

#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/criteria/forced_elements_3.h>
#include <weft/spatial/mesh/circumcenter_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/restricted/Mesh_without_vertex_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// The cosine of the small dihedral angle that a large one stands for: 152 degrees stand for 24, 140 for 32, 125 for
/// 42.
inline double stand_in_for_largest(double cosine)
{
  return 0.428 - 0.55 * cosine;
}

/// How much of a sliver a cell is: the cosine of its smallest dihedral angle, or what its largest one stands for if
/// that is more.
inline double sliver_measure(const Dihedral_cosines_3& cosines)
{
  return (std::max)(cosines.smallest, stand_in_for_largest(cosines.largest));
}

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Perturbation_judge_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Zone = typename Restricted::Zone;

  static constexpr double no_good = 3; ///< more than any sliver measure
  /// By how much a change has to better what it is to mend: else bettering by ever less goes on forever.
  static constexpr double least_gain = 1e-4;

  /// \param guard has to live as long as this object.
  /// \param target the smallest dihedral angle that is to be reached, in degrees.
  Perturbation_judge_3(const Restricted& mesh, Criteria_guard_3<Restricted>& guard, double target = wanted)
      : mesh_(&mesh), guard_(guard), wants_more_(target > wanted)
  {}

  /// From here on only smallest dihedral angles count, those between sheets like any other.
  void judge_by_smallest_alone() { by_smallest_alone_ = true, is_about_angles_ = false; }

  double measure(Cell_handle c) const { return measure(cosines(c)); }

  /// The extreme dihedral angles of a cell that has its circumcenter, as `relative()` has them.
  Dihedral_cosines_3 cosines(Cell_handle c) const
  {
    const Dihedral_cosines_3 x = cosines_of_cell(c);
    if (!may_be_forced(x)) return x;
    return relative(x, forcing_angle(*mesh_, c, largest_crease_angle));
  }

  /// Whether a cell between sheets at a small angle is to stay: none of its vertices may move.
  bool is_locked(Cell_handle c) const
  {
    for (int i = 0; i < 4; ++i)
      if (!mesh_->is_fixed(c->vertex(i))) return false;
    return is_about_angles_;
  }

  /// No move may make an angle smaller than the one with this cosine.
  void set_floor(double cosine) { floor_ = cosine; }
  double floor() const { return floor_; }

  /// \param location of the points that are judged next.
  void set_location(const Vertex_location_3& location) { location_ = location; }

  /// \param filling the cells that fill the place of a vertex that was taken away; none for an insertion.
  void set_filling(const std::vector<Cell_handle>& filling)
  {
    without_ = nullptr;
    filling_.clear();
    for (const Cell_handle c : filling) {
      Filler f{c, -1, -1, false, true};
      if (!Restricted::is_at_box(c)) {
        c->set_circumcenter(circumcenter_of_cell_3<Kernel>(c));
        const Dihedral_cosines_3 x = cosines(c);
        f = {c, measure(x), x.smallest, false, false};
      }
      filling_.push_back(f);
    }
  }

  /// The same for a vertex that is left out in thought only: zones are those that points would have then.
  /// \param without has to stay as it is until another filling is set.
  void set_filling(Mesh_without_vertex_3<Restricted>& without)
  {
    set_filling(without.filling());
    without_ = &without;
  }

  /// Finds the zone of a point; `near` is where to look from.
  bool find_zone(const Point& p, Cell_handle near)
  {
    if (without_) return without_->find_zone(p, zone_);
    return find_conflict_zone(mesh_->triangulation(), p, near, zone_) == Zone_result::found;
  }
  const Zone& zone() const { return zone_; }

  /// The worst measure of the cells that a vertex at the point of `zone()` would make, filling that stays included;
  /// `no_good` if it isn't less than `limit` or, where that is more, the worst of the cells unmade.
  double judge(double limit)
  {
    if (!without_) {
      ++stamp_;
      for (const Cell_handle c : zone_.cells) c->set_id(-stamp_);
    }
    const auto is_in_zone = [this](Cell_handle c) { return without_ ? without_->is_in_zone(c) : c->id() == -stamp_; };
    bool limit_is_final = false;
    double worst = -1;
    const auto exceeds = [&](const Dihedral_cosines_3& x) {
      worst = measure(x);
      if (x.smallest > floor_) return true;
      if (worst < limit) return false;
      if (!limit_is_final)
        limit = (std::max)(limit, worst_unmade() - least_gain); // seldom needed: candidates mostly fail
      limit_is_final = true;
      return worst >= limit;
    };
    for (Filler& f : filling_)
      if (!is_in_zone(f.cell) && f.measure > worst && is_inside(f) && exceeds(cosines(f.cell))) return no_good;
    for (const auto& facet : zone_.hull) {
      std::array<Point, 4> p;
      if (!corners(facet, p)) continue;
      Dihedral_cosines_3 x = cosines_of_extreme_dihedrals(p[0], p[1], p[2], p[3]);
      if (measure(x) <= worst) continue;
      const Point o = circumcenter_3<Kernel>(p[0], p[1], p[2], p[3]);
      if (may_be_forced(x))
        x = relative(x, forcing_angle(mesh_->oracle(), mesh_->incidence(), locations(facet),
                                      {{&p[0], &p[1], &p[2], &p[3]}}, o, largest_crease_angle));
      if (measure(x) <= worst || !is_inside(o)) continue;
      if (exceeds(x)) return no_good;
    }
    return worst;
  }

  /// The same for leaving the vertex out that was taken away.
  double judge_filling(double limit)
  {
    double worst = -1;
    for (Filler& f : filling_) {
      if (f.measure <= worst || !is_inside(f)) continue;
      worst = f.measure;
      if (worst >= limit || f.smallest > floor_) return no_good;
    }
    return worst;
  }

  /// Whether the cells that a vertex at the point of `zone()` would make meet the criteria.
  bool would_fit() const
  {
    return std::all_of(zone_.hull.begin(), zone_.hull.end(), [this](const auto& facet) {
      std::array<Point, 4> p;
      if (!corners(facet, p)) return true;
      const Point o = circumcenter_3<Kernel>(p[0], p[1], p[2], p[3]);
      return !guard_.measure().cell({&p[0], &p[1], &p[2], &p[3]}, o).is_bad() || !is_inside(o);
    });
  }

  /// Whether what changed last is as good as it was in all that refinement guarantees.
  bool is_acceptable(Perturb_report_3& report) { return is_acceptable(guard_.refusal(), report); }

  /// \param refusal what the guard has said.
  static bool is_acceptable(Refusal_3 refusal, Perturb_report_3& report)
  {
    switch (refusal) {
    case Refusal_3::none:
      return true;
    case Refusal_3::cell:
      return ++report.refused_cells, false;
    case Refusal_3::facet:
      return ++report.refused_facets, false;
    case Refusal_3::crease:
      return ++report.refused_creases, false;
    case Refusal_3::disk:
      return ++report.refused_disks, false;
    default:
      return ++report.refused_bare, false;
    }
  }

  /// To be called when a vertex number gets another meaning.
  void forget(int id) { guard_.forget(id); }

private:
  double measure(const Dihedral_cosines_3& x) const { return by_smallest_alone_ ? x.smallest : sliver_measure(x); }

  bool may_be_forced(const Dihedral_cosines_3& x) const { return is_about_angles_ && x.smallest > wanted_cosine_; }

  /// The dihedral angles of a cell that fills the wedge at an edge of the input in proportion to those wanted there:
  /// the perturber leaves a cell alone that has a good part of the angle. A large angle counts as a small one does,
  /// which it doesn't come with there. Where more is wanted, a cell with room for it is measured as it is from there
  /// on: a mesh would never get better than its wedges otherwise.
  Dihedral_cosines_3 relative(const Dihedral_cosines_3& x, double forcing_angle) const
  {
    if (forcing_angle > largest_forcing_angle) return x;
    const double attainable = (std::max)((std::min)(part_of_angle * forcing_angle, wanted), least_part * forcing_angle);
    const double degrees = degrees_of_cosine(x.smallest);
    if (wants_more_ && degrees >= attainable && attainable >= wanted) return x;
    const double acute = degrees >= attainable ? -1. : cosine_of_degrees(degrees * wanted / attainable);
    return {(std::max)(acute, stand_in_for_largest(x.largest)), x.largest};
  }

  std::array<Vertex_location_3, 4> locations(const typename Restricted::Facet& facet) const
  {
    std::array<Vertex_location_3, 4> result;
    for (int k = 0; k < 4; ++k)
      result[static_cast<std::size_t>(k)] = k == facet.second ? location_ : facet.first->vertex(k)->location();
    const auto i = static_cast<std::size_t>(facet.second);
    std::swap(result[(i + 1) % 4], result[(i + 2) % 4]); // in the order of corners()
    return result;
  }

  static constexpr double wanted = 20; ///< degrees: what is asked for where nothing forces less
  /// Parts of the angle of an edge: what is attained beside it, and what is asked for where that is more than `wanted`.
  static constexpr double part_of_angle = 0.8, least_part = 0.62;
  static constexpr double largest_forcing_angle = 40; ///< degrees
  /// Cells at creases that meet at more than that can have the angle that is wanted elsewhere.
  static constexpr double largest_crease_angle = 15;

  /// A cell that fills the place of a vertex taken away.
  struct Filler
  {
    Cell_handle cell;
    double measure, smallest;
    bool inside, labelled; ///< the oracle is asked when it matters
  };

  bool is_inside(const Point& p) const { return mesh_->oracle().subdomain(p) != 0; }

  bool is_inside(Filler& f) const
  {
    if (!f.labelled) f.inside = is_inside(f.cell->circumcenter());
    f.labelled = true;
    return f.inside;
  }

  double worst_unmade() const
  {
    double worst = -1;
    for (const Cell_handle c : zone_.cells)
      if (c->is_classified() && c->subdomain() != 0) worst = (std::max)(worst, measure(c));
    return worst;
  }

  /// The cell that the point of the zone would make with a facet of its hull; false for one at the box.
  bool corners(const typename Restricted::Facet& facet, std::array<Point, 4>& p) const
  {
    const auto& [c, i] = facet;
    for (int k = 0; k < 4; ++k) {
      if (k != i && c->vertex(k)->location().dimension < 0) return false;
      p[static_cast<std::size_t>(k)] = k == i ? zone_.point : c->vertex(k)->point();
    }
    std::swap(p[static_cast<std::size_t>((i + 1) % 4)], p[static_cast<std::size_t>((i + 2) % 4)]); // on the other side
    return true;
  }

  const Restricted* mesh_;
  Criteria_guard_3<Restricted>& guard_;
  bool by_smallest_alone_ = false;
  bool wants_more_; ///< than what is wanted by default
  bool is_about_angles_ = mesh_->oracle().has_mirror_images();
  double wanted_cosine_ = cosine_of_degrees(least_part * largest_forcing_angle);
  Vertex_location_3 location_{3, 0};
  std::vector<Filler> filling_;
  Mesh_without_vertex_3<Restricted>* without_ = nullptr; ///< null where the vertex is out
  Zone zone_;
  double floor_ = 1;
  int stamp_ = 1;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_PERTURBATION_JUDGE_3_H
