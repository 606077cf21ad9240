// SPDX-License-Identifier: GPL-3.0-or-later
//
// Alg. 2 of Tournois 2009 as it is printed, to compare with: batch refinement and Lloyd's iteration in turns, from
// nothing but the constraints. Each of its parts can be switched off alone. `make_mesh_2()` makes better meshes.

#ifndef WEFT_PLANAR_RUN_MESH_AS_PUBLISHED_2_H
#define WEFT_PLANAR_RUN_MESH_AS_PUBLISHED_2_H

#include <weft/errors.h>
#include <weft/internal/as_index.h>
#include <weft/planar/relax/Relaxer_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/planar/working/Working_mesh_2.h>
#include <weft/sizing/Uniform_sizing.h>

#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {

/// Parts of Alg. 2, all of them on.
struct As_published_options_2
{
  bool interleave = true;   ///< Lloyd's iteration after every batch; else only when sizes hold, and at the end
  bool lower_slowly = true; ///< each batch refines to largest ratio / sqrt(3), at least 1; else to 1 at once
  bool alter_edges = true;  ///< a split edge takes part of the need of its neighbours upon itself: 1/2 (r/2 - target)
  bool alter_triangles = true;                       ///< the same of a triangle: 1/3 (r / sqrt(3) - target)
  double move_ratio = 0.03, final_move_ratio = 0.01; ///< the stopping criteria S and S', in parts of a cell's size
  int quadrature = 10, final_quadrature = 100;       ///< quadrature triangles a cell
  double size_feedback = 0;                          ///< of Mesh_options_2, which isn't part of Alg. 2
  int max_sweeps = 1000, max_batches = 1000;         ///< of a relaxation; altogether
  std::size_t max_vertices = 5000000;

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    if (!(move_ratio > 0 && final_move_ratio > 0)) throw Option_error("move ratios must be positive");
    if (quadrature <= 0 || final_quadrature <= 0) throw Option_error("quadrature sizes must be positive");
    if (!(size_feedback >= 0 && size_feedback <= 8)) throw Option_error("size_feedback must lie in [0, 8]");
    if (max_sweeps < 0 || max_batches < 0) throw Option_error("iteration limits must not be negative");
  }
};

/// What `mesh_as_published_2()` did.
struct As_published_report_2
{
  std::size_t batches = 0, sweeps = 0;
  double largest_ratio = 0; ///< longest edge / size: Lloyd's iteration comes last and may raise it above 1
  bool sizes_held = false;  ///< before that
};

namespace internal {

/// \tparam Mesh a Working_mesh_2.
template <class Mesh>
class As_published_mesher_2
{
public:
  using Triangulation = typename Mesh::Triangulation;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  As_published_mesher_2(Mesh& mesh, const As_published_options_2& options)
      : mesh_(mesh), options_(options), relaxer_(mesh, options.size_feedback, 1)
  {}

  As_published_report_2 run()
  {
    do {
      while (refine())
        if (options_.interleave) relax(options_.move_ratio, options_.quadrature);
      report_.sizes_held = report_.largest_ratio <= 1;
      if (options_.interleave || has_relaxed_) break;
      relax(options_.move_ratio, options_.quadrature); // refine, optimise, and refine what that has made too long
      has_relaxed_ = true;
    } while (true);
    relax(options_.final_move_ratio, options_.final_quadrature);
    report_.largest_ratio = largest_ratio();
    return report_;
  }

private:
  struct Element
  {
    double ratio;
    Face_handle face;
    int edge; ///< -1: the triangle
  };

  bool is_first(Face_handle f, int i) const
  {
    return !f->neighbor(i)->is_in_domain() ||
           f->vertex(Triangulation::ccw(i))->id() < f->vertex(Triangulation::cw(i))->id();
  }

  double largest_ratio() const
  {
    double largest = 0;
    for (const Face_handle f : mesh_.faces()) largest = (std::max)(largest, mesh_.ratio(f));
    return largest;
  }

  /// One batch; whether anything was inserted.
  bool refine()
  {
    report_.largest_ratio = largest_ratio();
    if (report_.largest_ratio <= 1 || report_.batches >= static_cast<std::size_t>(options_.max_batches) ||
        mesh_.vertices().size() >= options_.max_vertices)
      return false;
    ++report_.batches;
    const double target = options_.lower_slowly ? (std::max)(report_.largest_ratio / std::sqrt(3.0), 1.0) : 1;
    // Ids of faces are scratch; vertices are remembered, since insertions destroy faces.
    const std::vector<std::array<Vertex_handle, 2>> edges = choose_edges(target);
    const std::vector<std::array<Vertex_handle, 3>> triangles = choose_triangles(target);
    std::size_t inserted = 0;
    for (const auto& [a, b] : edges) inserted += split_between(a, b);
    for (const auto& t : triangles) inserted += insert_circumcenter(t);
    mesh_.renumber();
    return inserted > 0;
  }

  /// Worst first; ties by number.
  template <class Elements>
  static void sort_by_ratio(Elements& elements)
  {
    std::stable_sort(elements.begin(), elements.end(), [](const auto& a, const auto& b) { return a.ratio > b.ratio; });
  }

  std::vector<std::array<Vertex_handle, 2>> choose_edges(double target) const
  {
    std::vector<Element> elements;
    std::vector<std::vector<std::size_t>> at(mesh_.vertices().size()); // edges at each vertex, by place
    for (const Face_handle f : mesh_.faces())
      for (int i = 0; i < 3; ++i)
        if (f->is_constrained(i) && is_first(f, i)) elements.push_back({mesh_.edge_ratio(f, i), f, i});
    sort_by_ratio(elements);
    const auto ends = [&](const Element& e) {
      return std::array<Vertex_handle, 2>{e.face->vertex(Triangulation::ccw(e.edge)),
                                          e.face->vertex(Triangulation::cw(e.edge))};
    };
    for (std::size_t k = 0; k < elements.size(); ++k)
      for (const Vertex_handle v : ends(elements[k])) at[as_index(v->id())].push_back(k);
    std::vector<std::array<Vertex_handle, 2>> chosen;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      if (elements[k].ratio <= target) continue;
      chosen.push_back(ends(elements[k]));
      if (!options_.alter_edges) continue;
      for (const Vertex_handle v : chosen.back())
        for (const std::size_t n : at[as_index(v->id())])
          if (n > k && v->constraint() >= 0) elements[n].ratio += (elements[k].ratio / 2 - target) / 2;
    }
    return chosen;
  }

  std::vector<std::array<Vertex_handle, 3>> choose_triangles(double target) const
  {
    std::vector<Element> elements;
    for (const Face_handle f : mesh_.faces()) elements.push_back({mesh_.ratio(f), f, -1});
    sort_by_ratio(elements);
    for (std::size_t k = 0; k < elements.size(); ++k) elements[k].face->set_id(static_cast<int>(k));
    std::vector<std::array<Vertex_handle, 3>> chosen;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      if (elements[k].ratio <= target) continue;
      const Face_handle f = elements[k].face;
      chosen.push_back({f->vertex(0), f->vertex(1), f->vertex(2)});
      for (int i = 0; options_.alter_triangles && i < 3; ++i) {
        const Face_handle n = f->neighbor(i);
        if (n->is_in_domain() && n->id() > static_cast<int>(k))
          elements[as_index(n->id())].ratio += (elements[k].ratio / std::sqrt(3.0) - target) / 3;
      }
    }
    return chosen;
  }

  bool split_between(Vertex_handle a, Vertex_handle b)
  {
    Face_handle f;
    int i;
    if (!mesh_.triangulation().is_edge(a, b, f, i) || !f->is_constrained(i)) return false;
    return mesh_.insert_on_constraint(CGAL::midpoint(a->point(), b->point()), f, i) != Vertex_handle();
  }

  /// The circumcenter; of a blind triangle, which doesn't see it, the constraint in between is split.
  bool insert_circumcenter(const std::array<Vertex_handle, 3>& t)
  {
    const Triangulation& cdt = mesh_.triangulation();
    const Point c = CGAL::circumcenter(t[0]->point(), t[1]->point(), t[2]->point());
    Face_handle here;
    if (!cdt.is_face(t[0], t[1], t[2], here)) return mesh_.insert_inside(c, t[0]->face()) != Vertex_handle();
    for (int steps = 0; steps < most_steps; ++steps) {
      int across = -1;
      for (int i = 0; i < 3 && across < 0; ++i)
        if (CGAL::orientation(here->vertex(Triangulation::ccw(i))->point(), here->vertex(Triangulation::cw(i))->point(),
                              c) == CGAL::RIGHT_TURN)
          across = i;
      if (across < 0) break;
      if (here->is_constrained(across))
        return split_between(here->vertex(Triangulation::ccw(across)), here->vertex(Triangulation::cw(across)));
      here = here->neighbor(across);
    }
    return mesh_.insert_inside(c, here) != Vertex_handle();
  }

  void relax(double move_ratio, int quadrature)
  {
    const auto outcome =
        relaxer_.run(mesh_.vertices(), {move_ratio, quadrature, options_.max_sweeps}, [] { return true; });
    report_.sweeps += outcome.sweeps;
  }

  static constexpr int most_steps = 10000; // of a walk, in case rounding makes it circle

  Mesh& mesh_;
  const As_published_options_2& options_;
  Relaxer_2<Mesh> relaxer_;
  As_published_report_2 report_;
  bool has_relaxed_ = false;
};

} // namespace internal

/// Meshes a domain by Alg. 2 of Tournois 2009. Parameters and validity are those of `make_mesh_2()`; sizes aren't
/// promised, as the last relaxation comes after refinement, and neither are angles. Without layers.
/// \throws Option_error for options out of range; Domain_error when there is no domain.
template <class Cdt, class Sizing>
As_published_report_2 mesh_as_published_2(Cdt& cdt, const Sizing& sizing,
                                          const As_published_options_2& options = As_published_options_2())
{
  if constexpr (std::is_arithmetic_v<Sizing>) {
    return mesh_as_published_2(cdt, Uniform_sizing<>(sizing), options);
  } else {
    options.check();
    using Mesh = internal::Working_mesh_2<Cdt, Sizing>;
    Mesh mesh(cdt, sizing);
    const As_published_report_2 report = internal::As_published_mesher_2<Mesh>(mesh, options).run();
    mesh.finish();
    return report;
  }
}

} // namespace weft

#endif // WEFT_PLANAR_RUN_MESH_AS_PUBLISHED_2_H
