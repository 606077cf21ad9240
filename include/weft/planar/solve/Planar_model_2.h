// SPDX-License-Identifier: GPL-3.0-or-later
//
// A planar mesh while its energy is minimised.

#ifndef WEFT_PLANAR_SOLVE_PLANAR_MODEL_2_H
#define WEFT_PLANAR_SOLVE_PLANAR_MODEL_2_H

#include <weft/energy/coordinates.h>
#include <weft/energy/cvt_terms_2.h>
#include <weft/energy/odt_terms.h>
#include <weft/energy/quadrature_rules.h>
#include <weft/energy/Simplices.h>
#include <weft/internal/as_index.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/solve/cvt_jacobian_blocks.h>
#include <weft/solve/odt_jacobian_blocks.h>
#include <weft/solve/Solver_options.h>

#include <CGAL/number_utils.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Model of Energy_descent over a Working_mesh_2. Sizes of the ODT energy are those at the vertices in the beginning,
/// which vertices take along; the density of the CVT energy is that of the sizing field.
template <class Mesh>
class Planar_model_2
{
public:
  using Vector = Coordinates<2>;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;

  Planar_model_2(Mesh& mesh, const Solver_options& options) : mesh_(mesh), options_(options)
  {
    if (options.energy == Energy::odt && !mesh.is_uniform())
      for (const Vertex_handle v : mesh.vertices()) sizes_.push_back(mesh.target(v));
    for (const auto& chain : mesh.chains()) {
      Vector along = difference(xy(chain.target), xy(chain.source));
      const double length = std::sqrt(dot(along, along));
      directions_.push_back({along[0] / length, along[1] / length});
    }
  }

  const Simplices<2>& simplices() const { return simplices_; } ///< as `terms()` has seen them last

  std::vector<Vector> positions() const
  {
    std::vector<Vector> result;
    result.reserve(mesh_.vertices().size());
    for (const Vertex_handle v : mesh_.vertices()) result.push_back(xy(v));
    return result;
  }

  bool is_free(std::size_t i) const
  {
    const int constraint = mesh_.vertices()[i]->constraint();
    return constraint == free_vertex || (constraint >= 0 && options_.move_boundary);
  }

  Vector to_tangent(std::size_t i, const Vector& v) const
  {
    const int constraint = mesh_.vertices()[i]->constraint();
    if (constraint < 0) return v;
    const Vector& along = directions_[as_index(constraint)];
    return moved(Vector{0, 0}, dot(along, v), along);
  }

  /// Those on constraints go to the nearest point of the line through its ends.
  void move(const std::vector<std::size_t>& points, const std::vector<Vector>& targets)
  {
    std::vector<Vertex_handle> vertices;
    std::vector<Point> places;
    for (const std::size_t i : points) {
      const Vertex_handle v = mesh_.vertices()[i];
      Vector p = targets[i];
      if (v->constraint() >= 0) {
        const Vector source = xy(mesh_.chains()[as_index(v->constraint())].source);
        p = moved(source, 1, to_tangent(i, difference(p, source)));
      }
      vertices.push_back(v);
      places.emplace_back(p[0], p[1]);
    }
    relocate(vertices, places);
  }

  void move_back(const std::vector<std::size_t>& points, const std::vector<Vector>& old)
  {
    std::vector<Vertex_handle> vertices;
    std::vector<Point> places;
    for (const std::size_t i : points) {
      vertices.push_back(mesh_.vertices()[i]);
      places.emplace_back(old[i][0], old[i][1]);
    }
    relocate(vertices, places);
  }

  /// The ODT energy is normalised where sizes vary.
  Energy_terms<2> terms(bool with_weights)
  {
    load();
    Energy_terms<2> result = terms_of_mesh(with_weights);
    if (!sizes_.empty()) factor_ = normalise(simplices_, result);
    return result;
  }

  /// As of the last `terms()`.
  std::vector<Jacobian_block<2>> newton_system() const
  {
    const Energy_terms<2> now = terms_of_mesh(false);
    if (options_.energy == Energy::cvt)
      return mesh_.is_uniform() ? cvt_jacobian_blocks(simplices_, now, Constant_density())
                                : cvt_jacobian_blocks(simplices_, now, density());
    auto blocks = odt_jacobian_blocks(simplices_, now);
    scale_blocks(blocks, factor_);
    return blocks;
  }

private:
  static Vector xy(Vertex_handle v) { return {CGAL::to_double(v->point().x()), CGAL::to_double(v->point().y())}; }

  Energy_terms<2> terms_of_mesh(bool with_weights) const
  {
    if (options_.energy == Energy::odt) return odt_terms(simplices_, with_weights);
    if (mesh_.is_uniform()) return cvt_terms(simplices_, Constant_density(), with_weights);
    return cvt_terms(simplices_, density(), with_weights);
  }

  auto density() const
  {
    return [this](const Vector& x) {
      const double size = CGAL::to_double(mesh_.size(Point(x[0], x[1])));
      return 1 / (size * size * size * size);
    };
  }

  void relocate(const std::vector<Vertex_handle>& vertices, const std::vector<Point>& places)
  {
    mesh_.relocator().move(vertices, places);
    for (const Vertex_handle v : vertices) mesh_.update_target(v);
  }

  /// Flips keep the list of faces, so that the numbers of triangles are the same in each sweep.
  void load()
  {
    const auto& faces = mesh_.faces();
    simplices_.points = positions();
    simplices_.sizes = sizes_;
    simplices_.simplices.resize(faces.size());
    simplices_.neighbors.resize(faces.size());
    for (const auto f : mesh_.triangulation().all_face_handles()) f->set_id(-1);
    for (std::size_t t = 0; t < faces.size(); ++t) faces[t]->set_id(static_cast<int>(t));
    for (std::size_t t = 0; t < faces.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const int next = faces[t]->is_constrained(i) ? -1 : faces[t]->neighbor(i)->id();
        simplices_.simplices[t][as_index(i)] = static_cast<Simplices<2>::Number>(faces[t]->vertex(i)->id());
        simplices_.neighbors[t][as_index(i)] = static_cast<Simplices<2>::Number>(next);
      }
  }

  Mesh& mesh_;
  const Solver_options& options_;
  std::vector<double> sizes_;      ///< by vertex; empty: uniform
  std::vector<Vector> directions_; ///< of the chains, unit vectors
  Simplices<2> simplices_;
  double factor_ = 1; ///< of the energy, when it was last normalised
};

} // namespace weft::internal

#endif // WEFT_PLANAR_SOLVE_PLANAR_MODEL_2_H
