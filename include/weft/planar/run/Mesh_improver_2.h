// SPDX-License-Identifier: GPL-3.0-or-later
//
// Improves a planar mesh that somebody else made: its outline becomes a planar straight line graph, its vertices are
// put back into a constrained Delaunay triangulation of that, whatever the old triangles were, and then they are
// relaxed (Tournois 2009, sec. 2.2.2), polished, and where that isn't enough a few are inserted, removed and shaken.
// Sizes are those that the vertices have, read off the triangulation. `improve_2()` is the way to call it.

#ifndef WEFT_PLANAR_RUN_MESH_IMPROVER_2_H
#define WEFT_PLANAR_RUN_MESH_IMPROVER_2_H

#include <weft/internal/run/Run.h>
#include <weft/options.h>
#include <weft/planar/graph/insert_pslg.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>
#include <weft/planar/refine/Batch_refiner_2.h>
#include <weft/planar/refine/sample_constraints_2.h>
#include <weft/planar/run/Improve_options_2.h>
#include <weft/planar/run/Mesh_optimiser_2.h>
#include <weft/planar/run/outline_2.h>
#include <weft/planar/run/outline_graph_2.h>
#include <weft/planar/run/Vertex_density_sizing_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/planar/working/Working_mesh_2.h>

#include <CGAL/spatial_sort.h>
#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft::internal {

/// A graph with the triangulation that it was inserted into.
template <class K>
struct Triangulated_outline_2
{
  Outline_graph_2<K> graph;
  Mesh_triangulation_2<K> triangulation;
  Mesh_tags_2<K> tags;

  /// Inserts the points and segments of the graph, and marks the faces that are in a region.
  /// \returns the first segment whose sides contradict those of others, or the number of segments.
  /// \throws Domain_error as `insert_pslg()`.
  std::size_t triangulate()
  {
    tags = insert_pslg(triangulation, graph.pslg, {Crossings::refuse, 0}).tags;
    return mark();
  }

  std::size_t mark()
  {
    return visit_sides_2(triangulation, tags, graph, [](auto face, int side) { face->set_in_domain(side > 0); });
  }
};

/// One attempt at a mesh.
template <class K>
class Mesh_improver_2
{
public:
  using Cdt = Mesh_triangulation_2<K>;
  using Sizing = Vertex_density_sizing_2<K>;
  using Mesh = Working_mesh_2<Cdt, Sizing>;
  using Point = typename K::Point_2;
  using Vertex_handle = typename Mesh::Vertex_handle;

  /// \param outline triangulated and marked; its segments get their vertices back here.
  /// \param inside the vertices that are free to move anywhere.
  /// \param report gets the counts; its time limit and visitor see one run after the other.
  Mesh_improver_2(Triangulated_outline_2<K>& outline, std::vector<Point> inside, const Sizing& sizing,
                  const Improve_options_2& options, Run& run, Mesh_report_2& report)
      : outline_(outline),
        sizing_(sizing),
        inside_(inside.size()),
        mesh_(outline.triangulation, sizing),
        options_(options),
        run_(run),
        report_(report),
        refiner_(mesh_, options.min_angle),
        optimiser_(mesh_, size_feedback, options.threads, options.seed, report)
  {
    insert_vertices(std::move(inside));
    if (options.boundary == Boundary_2::fixed) mesh_.lock_constraints();
  }

  /// \param relaxes whether vertices are spread anew first.
  void run(bool relaxes)
  {
    const std::size_t n = mesh_.vertices().size();
    most_vertices_ =
        n + (std::max)(least_insertions, static_cast<std::size_t>(options_.growth * static_cast<double>(n)));
    if (relaxes) timed(Stage::relaxation, [this] { relax(); });
    allow_insertions((std::min)(least_insertions + n / 50, most_vertices_ - n));
    std::size_t fewest = count_sharp();
    for (int round = 0, idle = 0; round < most_rounds && idle < most_idle && !run_.is_stopped(); ++round) {
      timed(Stage::polishing, [this] { polish(); });
      timed(Stage::polishing, [this] { hop(); });
      sharp_ = count_sharp();
      if (sharp_ == 0) break;
      idle = sharp_ < fewest ? 0 : idle + 1;
      fewest = (std::min)(fewest, sharp_);
      timed(Stage::refinement, [this] { refine(); });
      allow_insertions(room());
    }
  }

  /// Triangles below the angle asked for, whatever the reason.
  typename Batch_refiner_2<Mesh>::Sharp_triangles sharp_triangles() const { return refiner_.count_sharp(); }

  /// Takes the frame away; afterwards the triangulation is the mesh.
  void finish() { mesh_.finish(); }

private:
  static constexpr double size_feedback = 3; // as make_mesh_2() has it
  static constexpr double move_ratio = 0.01;
  static constexpr int quadrature = 10, most_sweeps = 12;
  static constexpr std::size_t least_insertions = Mesh_optimiser_2<Mesh>::least_insertions;
  static constexpr int most_rounds = 8, most_idle = 2, most_batches = 30;
  static constexpr double refined_angle = 28;

  template <class Function>
  void timed(Stage stage, const Function& function)
  {
    run_.timed(stage, function);
  }

  bool go_on() { return run_.go_on(mesh_.vertices().size(), sharp_); }
  // For algorithms that ask whether to go on. From one place, so that what they are compiled for is one type.
  auto asked()
  {
    return [this] { return go_on(); };
  }

  std::size_t count_sharp() const { return refiner_.count_sharp().mendable; }

  // ---- vertices

  /// On their segments first, then inside; what doesn't lie in the domain is left out.
  void insert_vertices(std::vector<Point> inside)
  {
    std::map<std::pair<Point, Point>, std::size_t> segment_between;
    const auto& graph = outline_.graph;
    for (std::size_t s = 0; s < graph.segments.size(); ++s)
      segment_between[std::minmax(graph.pslg.points[graph.segments[s].source],
                                  graph.pslg.points[graph.segments[s].target])] = s;
    for (const auto& chain : mesh_.chains()) {
      const auto at = segment_between.find(std::minmax(chain.source->point(), chain.target->point()));
      if (at != segment_between.end())
        insert_cuts(mesh_, chain, cuts(chain, graph.segments[at->second].between), [] { return true; });
    }
    CGAL::spatial_sort(inside.begin(), inside.end(), mesh_.triangulation().geom_traits());
    auto hint = mesh_.triangulation().infinite_face();
    for (const Point& p : inside)
      if (const Vertex_handle v = mesh_.insert_inside(p, hint); v != Vertex_handle()) hint = v->face();
    mesh_.renumber();
  }

  /// Where the points of a segment lie along its chain, in increasing order; others, where they leave gaps that are far
  /// too long for the sizes there.
  std::vector<double> cuts(const typename Mesh::Chain& chain, const std::vector<Point>& points) const
  {
    constexpr double longest_gap = 2, wanted = 0.9;
    const auto along = chain.target->point() - chain.source->point();
    const double length2 = CGAL::to_double(along * along);
    std::vector<double> result;
    for (const Point& p : points) result.push_back(CGAL::to_double((p - chain.source->point()) * along) / length2);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    if (options_.boundary == Boundary_2::fixed) return result;
    double before = 0;
    for (std::size_t i = 0; i <= result.size(); ++i) {
      const double t = i < result.size() ? result[i] : 1;
      const double size = sizing_.mean(chain.source->point() + (0.5 * (before + t)) * along);
      if ((t - before) * std::sqrt(length2) > longest_gap * size)
        return equal_metric_parts(
            chain.source->point(), chain.target->point(), [this](const Point& p) { return sizing_.mean(p); }, wanted,
            3 * mesh_.input_vertices() + 3 * inside_);
      before = t;
    }
    return result;
  }

  // ---- improvement

  /// Vertices that may still be added.
  std::size_t room() const { return most_vertices_ - (std::min)(mesh_.vertices().size(), most_vertices_); }

  void allow_insertions(std::size_t most)
  {
    insertions_ = most;
    optimiser_.allow_insertions(most);
  }

  /// Delaunay refinement of the sharpest triangles; only angles well below those that optimisation reaches are worth
  /// it.
  void refine()
  {
    refiner_.set_min_angle((std::min)(options_.min_angle, refined_angle));
    for (int batch = 0; batch < most_batches && room() > 0 && go_on(); ++batch) {
      if (refiner_.find_bad() == 0) break;
      const bool none = refiner_.refine(room()).empty();
      mesh_.renumber();
      if (none) break;
      polish_angles();
    }
    refiner_.set_min_angle(options_.min_angle);
  }

  // What the optimiser does, as long as the run may go on.
  void relax() { optimiser_.relax(mesh_.vertices(), {move_ratio, quadrature, most_sweeps}, asked()); }
  void polish_angles() { optimiser_.polish_angles(asked()); }
  void polish() { optimiser_.polish(asked()); }
  void hop() { optimiser_.hop((std::min)(insertions_, room()), asked()); }

  Triangulated_outline_2<K>& outline_;
  const Sizing& sizing_;
  std::size_t inside_; ///< vertices that aren't on the outline
  Mesh mesh_;
  const Improve_options_2& options_;
  Run& run_;
  Mesh_report_2& report_;
  Batch_refiner_2<Mesh> refiner_;
  Mesh_optimiser_2<Mesh> optimiser_;
  std::size_t sharp_ = 0, most_vertices_ = 0, insertions_ = 0;
};

/// The mesh of a triangulated outline. Points of the graph that were vertices come first, in the order that they had.
template <class K>
Triangle_mesh_2<K> extract_mesh_2(const Triangulated_outline_2<K>& outline, const std::vector<std::size_t>& corners)
{
  using Cdt = Mesh_triangulation_2<K>;
  const Cdt& cdt = outline.triangulation;
  const auto& graph = outline.graph;
  struct Triangle
  {
    typename Cdt::Face_handle face;
    int side;
  };
  std::vector<Triangle> faces;
  CGAL::Unique_hash_map<typename Cdt::Vertex_handle, bool> is_used(false);
  visit_sides_2(cdt, outline.tags, graph, [&](auto face, int side) {
    if (side == 0) return;
    faces.push_back({face, side});
    for (int i = 0; i < 3; ++i) is_used[face->vertex(i)] = true;
  });
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::map<typename K::Point_2, std::size_t> origin;
  for (std::size_t i = 0; i < graph.origin.size(); ++i)
    if (graph.origin[i] != none) origin.emplace(graph.pslg.points[i], graph.origin[i]);
  std::vector<std::pair<std::size_t, typename Cdt::Vertex_handle>> order;
  for (const auto v : cdt.finite_vertex_handles()) {
    if (!is_used[v]) continue;
    const auto at = origin.find(v->point());
    order.emplace_back(at == origin.end() ? none : at->second, v);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Triangle_mesh_2<K> mesh;
  CGAL::Unique_hash_map<typename Cdt::Vertex_handle, std::size_t> number;
  std::map<std::size_t, std::size_t> place; // of vertices of the input
  for (const auto& [old, v] : order) {
    number[v] = mesh.points.size();
    if (old != none) place[old] = mesh.points.size();
    mesh.points.push_back(v->point());
  }
  for (const Triangle& t : faces) {
    mesh.triangles.push_back({number[t.face->vertex(0)], number[t.face->vertex(1)], number[t.face->vertex(2)]});
    mesh.regions.push_back(graph.outline.regions[static_cast<std::size_t>(t.side - 1)]);
  }
  struct Marked
  {
    std::size_t segment;
    std::array<std::size_t, 2> ends;
  };
  std::vector<Marked> edges;
  for (const auto& [edge, segment] : outline.tags.constraints.constrained_edges(cdt)) {
    const auto a = edge.first->vertex(Cdt::ccw(edge.second)), b = edge.first->vertex(Cdt::cw(edge.second));
    if (segment < 0 || !is_used[a] || !is_used[b]) continue;
    const auto& s = graph.segments[static_cast<std::size_t>(segment)];
    const bool forward =
        CGAL::to_double((b->point() - a->point()) * (graph.pslg.points[s.target] - graph.pslg.points[s.source])) > 0;
    edges.push_back({static_cast<std::size_t>(segment), {number[forward ? a : b], number[forward ? b : a]}});
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Marked& a, const Marked& b) { return a.segment < b.segment; });
  for (const Marked& e : edges) {
    mesh.edges.push_back(e.ends);
    mesh.edge_tags.push_back(graph.outline.chains[graph.segments[e.segment].chain].tag);
  }
  for (const std::size_t v : corners)
    if (const auto at = place.find(v); at != place.end()) mesh.corners.push_back(at->second);
  return mesh;
}

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_MESH_IMPROVER_2_H
