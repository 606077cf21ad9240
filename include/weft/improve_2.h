// SPDX-License-Identifier: GPL-3.0-or-later
//
// START HERE with a planar triangle mesh that you have: `improve_2()` raises its smallest angles. The mesh becomes a
// constrained Delaunay mesh of the same domain and regions with about the same vertices. The boundary slides along
// itself, or every edge of it stays.
//
//   #include <weft/IO/read_triangle_mesh.h>
//   #include <weft/IO/write_mesh_2.h>
//
//   const auto input = weft::IO::read_triangle_mesh<K>("part.msh");
//   const auto [mesh, report] = weft::improve_2(input.mesh);
//   weft::IO::write_mesh_2("better.msh", mesh);

#ifndef WEFT_IMPROVE_2_H
#define WEFT_IMPROVE_2_H

#include <weft/errors.h>
#include <weft/internal/Answers.h>
#include <weft/internal/run/Run.h>
#include <weft/planar/mesh/quality_2.h>
#include <weft/planar/mesh/Scaled_triangle_2.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>
#include <weft/planar/run/Improve_options_2.h>
#include <weft/planar/run/Mesh_improver_2.h>
#include <weft/planar/run/require_structure_2.h>

#include <CGAL/Kernel/global_functions.h>

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {

/// Result of `improve_2()`.
template <class K>
struct Improve_result_2
{
  Triangle_mesh_2<K> mesh;
  Improve_report_2 report;
};

namespace internal {

/// What is returned after a complaint.
struct No_result_2
{
  int mesh = 0;
  Improve_report_2 report;
};

template <class K>
std::size_t count_inverted(const Triangle_mesh_2<K>& mesh)
{
  std::size_t n = 0;
  for (const auto& t : mesh.triangles)
    n += CGAL::orientation(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]) != CGAL::LEFT_TURN;
  return n;
}

/// The course of `improve_2()`.
template <class K>
class Optimisation_2
{
public:
  using Mesh = Triangle_mesh_2<K>;

  Optimisation_2(const Mesh& mesh, const Improve_options_2& options)
      : input_(mesh), options_(options), stays_(mesh.points.size(), false), run_(options.visitor, options.time_limit)
  {
    for (const std::size_t v : options.fixed_vertices) {
      if (v >= mesh.points.size()) throw Option_error("there is no vertex " + std::to_string(v) + " to be fixed");
      stays_[v] = true;
    }
    for (const std::size_t v : mesh.corners) stays_[v] = true;
    result_.report.before = measure_quality_2(mesh);
    result_.report.inverted_before = count_inverted(mesh);
  }

  Improve_result_2<K> run()
  {
    const Vertex_density_sizing_2<K> sizing = sizes_of_input();
    if (options_.boundary == Boundary_2::fixed) {
      attempt(sizing, outline_2(input_, stays_, 0, true), 0);
    } else {
      const double angle = options_.corner_angle > 0 ? options_.corner_angle : most_straight;
      const Outline_2 outline = outline_2(input_, stays_, angle, false);
      if (options_.corner_angle > 0 && options_.deviation > 0) attempt(sizing, outline, options_.deviation);
      if (!is_good()) attempt(sizing, outline, 0);
    }
    return finish();
  }

private:
  static constexpr double most_straight = 20; // degrees that chains turn at vertices where nothing is respaced
  // Longest edges against those of equilateral triangles of the same area, and how fast sizes may grow.
  static constexpr double longest_edge = 1.7, growth = 0.6;

  /// The vertices that aren't on the outline and may move.
  std::vector<typename K::Point_2> free_vertices() const
  {
    std::vector<char> is_free(input_.points.size(), true);
    for (const auto& e : input_.edges) is_free[e[0]] = is_free[e[1]] = false;
    std::vector<typename K::Point_2> result;
    for (std::size_t v = 0; v < is_free.size(); ++v)
      if (is_free[v] && !stays_[v]) result.push_back(input_.points[v]);
    return result;
  }

  /// Sizes of the constrained Delaunay triangulation of the input's vertices and outline, which is checked thereby.
  Vertex_density_sizing_2<K> sizes_of_input() const
  {
    Triangulated_outline_2<K> outline;
    outline.graph = outline_graph_2(
        input_, outline_2(input_, stays_, 0, true), stays_, [](const auto&) { return 1; }, 0);
    const std::size_t n = outline.graph.segments.size();
    std::size_t contradicting = n;
    try {
      contradicting = outline.triangulate();
    } catch (const Domain_error& error) {
      refuse_outline(outline.graph, error);
    }
    if (contradicting < n) {
      const auto& s = outline.graph.segments[contradicting];
      throw Domain_error("parts of the mesh lie on each other: " + ends_of(outline.graph, contradicting) +
                             " has other regions beside it than its triangles say",
                         {outline.graph.origin[s.source], outline.graph.origin[s.target]}, {contradicting});
    }
    const auto inside = free_vertices();
    outline.triangulation.insert(inside.begin(), inside.end());
    outline.mark();
    return {outline.triangulation, longest_edge, growth, options_.boundary == Boundary_2::fixed};
  }

  static std::string ends_of(const Outline_graph_2<K>& graph, std::size_t segment)
  {
    const auto& s = graph.segments[segment];
    return "the edge of the outline between vertices " + std::to_string(graph.origin[s.source]) + " and " +
           std::to_string(graph.origin[s.target]);
  }

  /// Says what is wrong with the outline in terms of the mesh.
  [[noreturn]] static void refuse_outline(const Outline_graph_2<K>& graph, const Domain_error& error)
  {
    const auto& edges = error.elements();
    if (edges.size() != 2) throw error;
    const auto &a = graph.segments[edges[0]], &b = graph.segments[edges[1]];
    throw Domain_error(ends_of(graph, edges[0]) + " crosses or overlaps that between vertices " +
                           std::to_string(graph.origin[b.source]) + " and " + std::to_string(graph.origin[b.target]),
                       {graph.origin[a.source], graph.origin[a.target], graph.origin[b.source], graph.origin[b.target]},
                       edges);
  }

  /// Improves with the outline as given, with relaxation first and, where that doesn't do, without.
  /// \param deviation of curves; where there are none to respace, this is left to another attempt.
  void attempt(const Vertex_density_sizing_2<K>& sizing, const Outline_2& chains, double deviation)
  {
    for (const bool relaxes : {true, false}) {
      Triangulated_outline_2<K> outline;
      outline.graph = outline_graph_2(
          input_, chains, stays_, [&](const auto& p) { return sizing.mean(p); }, deviation);
      if (deviation > 0 && outline.graph.respaced == 0) return;
      try {
        if (outline.triangulate() < outline.graph.segments.size()) return;
      } catch (const Domain_error&) {
        if (deviation > 0) return; // curves that came too close to others
        throw;
      }
      Mesh_improver_2<K> improver(outline, free_vertices(), sizing, options_, run_, report_);
      improver.run(relaxes);
      const auto sharp = improver.sharp_triangles();
      improver.finish();
      offer(outline, sharp.mendable, sharp.given);
      if (is_good() || run_.is_stopped()) return;
    }
  }

  /// Takes a mesh if it is better than what there is.
  void offer(const Triangulated_outline_2<K>& outline, std::size_t below_min_angle, std::size_t at_input_angle)
  {
    Mesh mesh = extract_mesh_2(outline, input_.corners);
    if (mesh.triangles.empty()) return;
    const Quality_2 quality = measure_quality_2(mesh);
    const std::size_t inverted = count_inverted(mesh);
    Improve_report_2& report = result_.report;
    if (is_worse(quality, inverted, report.before, report.inverted_before)) return;
    if (found_ &&
        (is_worse(quality, inverted, report.after, report.inverted_after) || below_min_angle > report.below_min_angle))
      return;
    found_ = true;
    result_.mesh = std::move(mesh);
    report.after = quality;
    report.inverted_after = inverted;
    report.input_bound = (std::min)(60.0, smallest_constraint_angle_2(outline.triangulation));
    report.below_min_angle = below_min_angle;
    report.at_input_angle = at_input_angle;
  }

  bool is_good() const { return found_ && result_.report.below_min_angle == 0; }

  /// Whether there are more inverted triangles, or as many and a smaller angle.
  static bool is_worse(const Quality_2& a, std::size_t inverted_in_a, const Quality_2& b, std::size_t inverted_in_b)
  {
    if (inverted_in_a != inverted_in_b) return inverted_in_a > inverted_in_b;
    constexpr double rounding = 1e-9; // angles of the outline stay up to that
    return a.smallest_angle.degrees < b.smallest_angle.degrees - rounding;
  }

  Improve_result_2<K> finish()
  {
    Improve_report_2& report = result_.report;
    report.moves = report_.moves + report_.polished;
    report.flips = report_.flips;
    run_.report(report);
    if (!found_) {
      report.notes.emplace_back("nothing better was found: the mesh is as it was");
      result_.mesh = input_;
      report.after = report.before;
      report.inverted_after = report.inverted_before;
      for (const auto& t : input_.triangles) report.below_min_angle += smallest_angle(t) < options_.min_angle;
    }
    if (report.stop_reason == Stop_reason::criteria_met && report.below_min_angle > 0)
      report.stop_reason = Stop_reason::exhausted;
    return std::move(result_);
  }

  double smallest_angle(const std::array<std::size_t, 3>& t) const
  {
    const Scaled_triangle_2 triangle(
        std::array<Xy_2, 3>{xy(input_.points[t[0]]), xy(input_.points[t[1]]), xy(input_.points[t[2]])});
    return (std::min)({triangle.angle(0), triangle.angle(1), triangle.angle(2)});
  }

  const Mesh& input_;
  const Improve_options_2& options_;
  std::vector<char> stays_; ///< by vertex
  Run run_;
  Mesh_report_2 report_;
  Improve_result_2<K> result_;
  bool found_ = false; ///< whether the result has a mesh
};

} // namespace internal

/// Improves a planar mesh.
///
/// The result is constrained Delaunay, has no inverted triangles, and never a smaller angle than the input. Vertices of
/// the outline that stay come first, in the order that they had. Tags of regions and edges are kept.
/// \param mesh from a reader, `triangle_mesh_2()` or `assemble_mesh_2()`; triangles may be slivers, not Delaunay, or
///   inverted.
/// \throws Option_error for options out of range; Domain_error if the arrays aren't a mesh, edges of the outline cross
/// or overlap, or parts of the
///   mesh lie on each other, with the vertices to blame.
template <class K>
Improve_result_2<K> improve_2(const Triangle_mesh_2<K>& mesh, const Improve_options_2& options = Improve_options_2())
{
  options.check();
  internal::require_structure(mesh);
  return internal::Optimisation_2<K>(mesh, options).run();
}

/// \cond
// An overload that only says what is wrong.
template <class Mesh, std::enable_if_t<!internal::Is_triangle_mesh_2<Mesh>::value, int> = 0>
internal::No_result_2 improve_2(const Mesh&, const Improve_options_2& = Improve_options_2())
{
  static_assert(internal::never_v<Mesh>, "weft: improve_2() takes a weft::Triangle_mesh_2<K>: triangle_mesh_2() makes "
                                         "one of a triangulation, assemble_mesh_2() of arrays");
  return {};
}
/// \endcond

} // namespace weft

#endif // WEFT_IMPROVE_2_H
