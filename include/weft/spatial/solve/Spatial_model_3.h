// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tetrahedral mesh while its energy is minimised.

#ifndef WEFT_SPATIAL_SOLVE_SPATIAL_MODEL_3_H
#define WEFT_SPATIAL_SOLVE_SPATIAL_MODEL_3_H

#include <weft/energy/coordinates.h>
#include <weft/energy/cvt_terms_3.h>
#include <weft/energy/odt_terms.h>
#include <weft/energy/quadrature_rules.h>
#include <weft/energy/Simplices.h>
#include <weft/internal/as_index.h>
#include <weft/solve/cvt_jacobian_blocks.h>
#include <weft/solve/odt_jacobian_blocks.h>
#include <weft/solve/Solver_options.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/domain/project_on_location_3.h>
#include <weft/spatial/optimise/Dynamic_sizing_3.h>
#include <weft/spatial/optimise/Move_shortener_3.h>
#include <weft/spatial/optimise/Smooth_options_3.h>
#include <weft/spatial/restricted/Mesh_relocation_3.h>

#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace weft::internal {

/// Model of Energy_descent over a Restricted_delaunay_3: points are its vertices, by id. Sizes are those that the mesh
/// has in the beginning, which vertices take along.
template <class Restricted>
class Spatial_model_3
{
public:
  using Vector = Coordinates<3>;
  using Point = typename Restricted::Point;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Cell_handle = typename Restricted::Cell_handle;

  /// \param guard of the criteria to keep; null where none are.
  Spatial_model_3(Restricted& mesh, const Criteria_guard_3<Restricted>* guard, const Smooth_options_3& smoothing,
                  const Solver_options& options, Smooth_report_3& report)
      : mesh_(mesh), guard_(guard), options_(options), report_(report)
  {
    if (!smoothing.uniform) {
      Dynamic_sizing_3<Restricted> sizing(smoothing.lipschitz);
      sizing.update(mesh);
      for (const Vertex_handle v : mesh.vertices()) sizes_.push_back(sizing(v));
    }
    find_tangents();
  }

  const Simplices<3>& simplices() const { return simplices_; } ///< as `terms()` has seen them last

  std::vector<Vector> positions() const
  {
    std::vector<Vector> result;
    result.reserve(mesh_.vertices().size());
    for (const Vertex_handle v : mesh_.vertices()) result.push_back(xyz(v->point()));
    return result;
  }

  bool is_free(std::size_t i) const
  {
    const Vertex_handle v = mesh_.vertices()[i];
    const int dimension = v->location().dimension;
    return !mesh_.is_fixed(v) && (dimension == 3 || (options_.move_boundary && tangents_[i].is_known));
  }

  Vector to_tangent(std::size_t i, const Vector& v) const
  {
    const int dimension = mesh_.vertices()[i]->location().dimension;
    if (dimension == 3) return v;
    const Vector& n = tangents_[i].vector;
    const Vector along = moved(Vector{0, 0, 0}, dot(n, v), n);
    return dimension == 1 ? along : difference(v, along);
  }

  void move(const std::vector<std::size_t>& points, const std::vector<Vector>& targets)
  {
    std::vector<int> ids;
    std::vector<Point> old, places;
    for (const std::size_t i : points) {
      const Vertex_handle v = mesh_.vertices()[i];
      const Point wanted(targets[i][0], targets[i][1], targets[i][2]);
      if (wanted == v->point()) continue;
      const std::optional<Point> p = project_on_location(mesh_.oracle(), wanted, v->location());
      if (!p || (v->location().dimension == 3 && mesh_.oracle().subdomain(*p) != v->location().index)) continue;
      ids.push_back(static_cast<int>(i));
      old.push_back(v->point());
      places.push_back(*p);
    }
    std::vector<std::size_t> stayed;
    report_.relocations += relocate(mesh_, ids, places, &stayed);
    if (guard_) {
      std::vector<double> parts(ids.size(), 1);
      for (const std::size_t i : stayed) parts[i] = 0;
      Move_shortener_3<Restricted>(mesh_, *guard_, report_).take_back(ids, old, places, parts);
    }
    find_tangents();
  }

  void move_back(const std::vector<std::size_t>& points, const std::vector<Vector>& old)
  {
    std::vector<int> ids;
    std::vector<Point> places;
    for (const std::size_t i : points) {
      const Point p(old[i][0], old[i][1], old[i][2]);
      if (p == mesh_.vertices()[i]->point()) continue;
      ids.push_back(static_cast<int>(i));
      places.push_back(p);
    }
    if (ids.empty()) return;
    report_.relocations.add_times(relocate(mesh_, ids, places));
    find_tangents();
  }

  /// Normalised: which flat cells on a curved boundary belong to the restricted triangulation changes with every sweep,
  /// and their share of the energy would hide what moves achieve.
  Energy_terms<3> terms(bool with_weights)
  {
    load();
    Energy_terms<3> result = terms_of_mesh(with_weights);
    factor_ = normalise(simplices_, result);
    return result;
  }

  /// As of the last `terms()`.
  std::vector<Jacobian_block<3>> newton_system() const
  {
    const Energy_terms<3> now = terms_of_mesh(false);
    auto blocks = options_.energy == Energy::odt ? odt_jacobian_blocks(simplices_, now)
                                                 : cvt_jacobian_blocks(simplices_, now, Constant_density());
    scale_blocks(blocks, factor_);
    return blocks;
  }

private:
  /// The unit normal of a patch, or the direction of a crease.
  struct Tangent
  {
    Vector vector{};
    bool is_known = false;
  };

  static Vector xyz(const Point& p) { return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())}; }

  Energy_terms<3> terms_of_mesh(bool with_weights) const
  {
    if (options_.energy == Energy::odt) return odt_terms(simplices_, with_weights);
    return cvt_terms(simplices_, Constant_density(), with_weights);
  }

  /// From the facets and crease edges around: the surface may have folds, of which an oracle knows one side at a time.
  void find_tangents()
  {
    tangents_.assign(mesh_.vertices().size(), Tangent());
    const auto at = [this](Vertex_handle v) -> Tangent& { return tangents_[as_index(v->id())]; };
    for (const auto& f : mesh_.facets()) {
      if (f.cell == Cell_handle()) continue;
      std::array<Vertex_handle, 3> v{f.cell->vertex((f.index + 1) & 3), f.cell->vertex((f.index + 2) & 3),
                                     f.cell->vertex((f.index + 3) & 3)};
      if (f.index % 2 == 1) std::swap(v[1], v[2]);
      const Vector p = xyz(v[0]->point());
      Vector normal = cross(difference(xyz(v[1]->point()), p), difference(xyz(v[2]->point()), p));
      if (f.cell->subdomain() < f.cell->neighbor(f.index)->subdomain()) normal = {-normal[0], -normal[1], -normal[2]};
      for (const Vertex_handle w : v)
        if (w->id() >= 0 && w->location().dimension == 2) add_to(at(w).vector, 1, normal);
    }
    for (const auto& e : mesh_.creases().edges())
      for (const auto& [v, w] : {std::pair(e.source, e.target), std::pair(e.target, e.source)}) {
        if (v->location().dimension != 1) continue;
        Vector way = difference(xyz(w->point()), xyz(v->point()));
        if (dot(way, at(v).vector) < 0) way = {-way[0], -way[1], -way[2]};
        add_to(at(v).vector, 1, way);
      }
    for (Tangent& t : tangents_) {
      const double length = std::sqrt(dot(t.vector, t.vector));
      t.is_known = length > 0;
      if (t.is_known) t.vector = moved(Vector{0, 0, 0}, 1 / length, t.vector);
    }
  }

  void load()
  {
    simplices_.points = positions();
    simplices_.sizes = sizes_;
    simplices_.simplices.clear();
    simplices_.neighbors.clear();
    int n = 0;
    for (const Cell_handle c : mesh_.triangulation().all_cell_handles())
      c->set_id(!mesh_.triangulation().is_infinite(c) && c->subdomain() != 0 ? n++ : -1);
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->id() < 0) continue;
      simplices_.simplices.emplace_back();
      simplices_.neighbors.emplace_back();
      for (int i = 0; i < 4; ++i) {
        simplices_.simplices.back()[as_index(i)] = static_cast<Simplices<3>::Number>(c->vertex(i)->id());
        simplices_.neighbors.back()[as_index(i)] = static_cast<Simplices<3>::Number>(c->neighbor(i)->id());
      }
    }
  }

  Restricted& mesh_;
  const Criteria_guard_3<Restricted>* guard_;
  const Solver_options& options_;
  Smooth_report_3& report_;
  std::vector<double> sizes_; ///< by vertex; empty: uniform
  std::vector<Tangent> tangents_;
  Simplices<3> simplices_;
  double factor_ = 1; ///< of the energy, when it was last normalised
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_SOLVE_SPATIAL_MODEL_3_H
