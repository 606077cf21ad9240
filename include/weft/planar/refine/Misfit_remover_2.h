// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a mesh doesn't fit a sizing field, it is emptied: Steiner vertices inside are taken away where they are too
// close or too far apart, those on constraints are spaced anew. What fits is frozen, but for a few rings around the
// holes. Filling holes with a new lattice takes no more vertices than a new mesh has; thinning and refinement would.

#ifndef WEFT_PLANAR_REFINE_MISFIT_REMOVER_2_H
#define WEFT_PLANAR_REFINE_MISFIT_REMOVER_2_H

#include <weft/internal/as_index.h>
#include <weft/planar/graph/chains_of_mesh_2.h>
#include <weft/planar/refine/sample_constraints_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Empties parts of a Working_mesh_2 that was made with `Given::meshed`.
template <class Mesh>
class Misfit_remover_2
{
public:
  using Triangulation = typename Mesh::Triangulation;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  /// \param spacing of vertices on constraints that are spaced anew, in parts of the target edge length.
  Misfit_remover_2(Mesh& mesh, double spacing)
      : mesh_(mesh), spacing_(spacing), is_open_(mesh.vertices().size(), false), goes_(mesh.vertices().size(), false)
  {}

  /// Empties what doesn't fit, renumbers the mesh and freezes what stays far from that.
  /// \param sharp callable with a face of the domain, whether it is to be improved in any case.
  /// \param go_on callable without arguments; false stops.
  /// \returns whether all was done.
  template <class Sharp, class Go_on>
  bool run(std::size_t max_vertices, const Sharp& sharp, const Go_on& go_on)
  {
    measure();
    mark_misfits();
    const auto pieces = pieces_to_space();
    open_around();
    std::vector<Vertex_handle> moving; // what may move besides
    for (const Face_handle f : mesh_.faces())
      if (is_too_long(f) || sharp(f))
        for (int i = 0; i < 3; ++i) moving.push_back(f->vertex(i));
    std::vector<Vertex_handle> open;
    for (const Vertex_handle v : mesh_.vertices())
      if (is_open_[as_index(v->id())] && !goes_[as_index(v->id())]) open.push_back(v);
    moving.erase(std::remove_if(moving.begin(), moving.end(), [&](Vertex_handle v) { return goes(v); }), moving.end());
    bool done = true;
    for (const Vertex_handle v : std::vector<Vertex_handle>(mesh_.vertices())) {
      if (!goes(v) || v->constraint() != free_vertex) continue;
      done = done && go_on();
      if (done && mesh_.remove(v)) ++removed_;
    }
    for (const Piece& piece : pieces) done = done && space(piece, max_vertices, go_on);
    mesh_.renumber();
    is_open_.assign(mesh_.vertices().size(), false);
    for (const Vertex_handle v : open) is_open_[as_index(v->id())] = true;
    for (const Vertex_handle v : fresh_) is_open_[as_index(v->id())] = true;
    freeze(moving);
    return done;
  }

  /// Whether a face is part of a hole, or of its rim where that turns in.
  bool is_open(Face_handle f) const { return is_open(f->vertex(0)) && is_open(f->vertex(1)) && is_open(f->vertex(2)); }

  std::size_t removed() const { return removed_; }

private:
  // Spacing of a triangular lattice as dense as the vertices around, in parts of the target: over two rings, and over
  // more, where that of new meshes varies less. Holes begin outside of the bounds `far` and `wide`, and reach as far as
  // those of `near`.
  struct Bounds
  {
    double far_too_close, wide_too_close, near_too_close, piece_too_short;
  };
  static constexpr Bounds loose{0.62, 0.74, 0.77, 0.55};
  static constexpr Bounds tight{0.7, 0.8, 0.82, 0.7}; // where too many vertices have gathered in the whole mesh
  static constexpr double gathered = 0.82;            // spacing over the whole mesh
  static constexpr double far_too_wide = 1, wide_too_wide = 0.97, near_too_wide = 0.95;
  static constexpr double too_long = 1.12;      // of an edge in a hole
  static constexpr double piece_too_long = 1.7; // of an edge on a constraint, over the target; over the size it is 1
  static constexpr int wide_rings = 4;
  static constexpr int moving_rings = 3;

  struct Piece // of a chain, that is spaced anew
  {
    std::size_t chain;
    std::vector<Vertex_handle> vertices;
    std::vector<double> cuts; // along the chain
  };

  bool goes(Vertex_handle v) const { return goes_[as_index(v->id())]; }
  bool is_open(Vertex_handle v) const { return as_index(v->id()) < is_open_.size() && is_open_[as_index(v->id())]; }

  double target(Face_handle f) const
  {
    return (mesh_.target(f->vertex(0)) + mesh_.target(f->vertex(1)) + mesh_.target(f->vertex(2))) / 3;
  }

  bool is_too_long(Face_handle f) const
  {
    if (mesh_.ratio(f) > 1) return true;
    for (int i = 0; i < 3; ++i)
      if (f->is_constrained(i) && mesh_.edge_ratio(f, i) > 1) return true;
    return false;
  }

  /// Areas in the metric of the targets, and numbers of triangles, around vertices.
  struct Room
  {
    double area = 0, count = 0;
  };

  /// Spreads sums at vertices to their neighbors.
  void spread(std::vector<Room>& rooms) const
  {
    std::vector<Room> sums = rooms;
    for (const auto& t : triangles_) // each edge from both sides
      for (std::size_t i = 0; i < 3; ++i)
        for (const std::size_t k : {(i + 1) % 3, (i + 2) % 3}) {
          sums[t[i]].area += 0.5 * rooms[t[k]].area;
          sums[t[i]].count += 0.5 * rooms[t[k]].count;
        }
    rooms = std::move(sums);
  }

  static double spacing(const Room& room)
  {
    return room.count > 0 ? std::sqrt(room.area / room.count * 4 / std::sqrt(3.0)) : ideal;
  }

  /// The spacing around each vertex.
  void measure()
  {
    std::vector<Room> rooms(mesh_.vertices().size());
    Room all;
    triangles_.reserve(mesh_.faces().size());
    for (const Face_handle f : mesh_.faces()) {
      triangles_.push_back({as_index(f->vertex(0)->id()), as_index(f->vertex(1)->id()), as_index(f->vertex(2)->id())});
      const double t = target(f), a = CGAL::to_double(mesh_.triangulation().triangle(f).area()) / (t * t);
      for (const std::size_t v : triangles_.back()) rooms[v].area += a, ++rooms[v].count;
      all.area += a, ++all.count;
    }
    bounds_ = spacing(all) < gathered ? tight : loose;
    spread(rooms);
    near_.reserve(rooms.size()), wide_.reserve(rooms.size());
    for (const Room& room : rooms) near_.push_back(spacing(room));
    for (int k = 0; k < wide_rings; ++k) spread(rooms);
    for (const Room& room : rooms) wide_.push_back(spacing(room));
  }

  /// What is far from fitting, and what is around it and doesn't fit well.
  void mark_misfits()
  {
    std::vector<Vertex_handle> queue;
    const auto mark = [&](Vertex_handle v) {
      char& goes = goes_[as_index(v->id())];
      if (goes) return;
      goes = true;
      queue.push_back(v);
    };
    for (std::size_t v = 0; v < near_.size(); ++v)
      if (near_[v] < bounds_.far_too_close || near_[v] > far_too_wide || wide_[v] < bounds_.wide_too_close ||
          wide_[v] > wide_too_wide)
        mark(mesh_.vertices()[v]);
    for (const Face_handle f : mesh_.faces())
      if (mesh_.ratio(f) > too_long)
        for (int i = 0; i < 3; ++i) mark(f->vertex(i));
    for (std::size_t k = 0; k < queue.size(); ++k)
      for_each_neighbor(queue[k], [&](Vertex_handle w) {
        const double s = near_[as_index(w->id())];
        if (s < bounds_.near_too_close || s > near_too_wide) mark(w);
      });
    for (const Vertex_handle v : mesh_.vertices()) {
      if (!goes(v) || v->constraint() == free_vertex) continue;
      is_open_[as_index(v->id())] = true; // whether it goes is for its chain to say
      goes_[as_index(v->id())] = false;
    }
  }

  /// The pieces of chains that have other numbers of edges than they should, or whose edges are too long.
  std::vector<Piece> pieces_to_space()
  {
    std::vector<Piece> pieces;
    const auto chains = chains_of_mesh(mesh_.triangulation());
    for (const auto& chain : chains) {
      std::vector<double> lengths;
      std::vector<char> is_long;
      for (std::size_t i = 1; i < chain.size(); ++i) {
        lengths.push_back(metric_length(chain[i - 1], chain[i]));
        is_long.push_back(lengths.back() > piece_too_long || is_too_long(chain[i - 1], chain[i]));
      }
      const auto is_off = [&](std::size_t i) { // with its neighbors, since single edges vary
        const std::size_t first = i > 0 ? i - 1 : 0, last = (std::min)(i + 2, lengths.size());
        double sum = 0;
        for (std::size_t k = first; k < last; ++k) sum += lengths[k];
        return is_long[i] || sum < bounds_.piece_too_short * static_cast<double>(last - first);
      };
      for (std::size_t i = 0; i < lengths.size();) {
        if (!is_off(i)) {
          ++i;
          continue;
        }
        std::size_t last = i + 1;
        while (last < lengths.size() && (is_off(last) || (last + 1 < lengths.size() && is_off(last + 1)))) ++last;
        // An edge more on both sides, so that there is something to share.
        const std::size_t from = i > 0 ? i - 1 : 0, to = (std::min)(last + 1, lengths.size());
        add_piece(chain, from, to, is_long, pieces);
        i = to;
      }
    }
    return pieces;
  }

  void add_piece(const std::vector<Vertex_handle>& chain, std::size_t from, std::size_t to,
                 const std::vector<char>& is_long, std::vector<Piece>& pieces)
  {
    const Vertex_handle a = chain[from], b = chain[to];
    auto cuts = equal_metric_parts(
        a->point(), b->point(), [this](const Point& p) { return mesh_.target(p); }, spacing_, most_cuts);
    const auto first = is_long.begin() + static_cast<std::ptrdiff_t>(from),
               last = is_long.begin() + static_cast<std::ptrdiff_t>(to);
    if (cuts.size() + 1 == to - from && std::find(first, last, true) == last) return;
    Piece piece;
    piece.chain = as_index(a->constraint() >= 0   ? a->constraint()
                           : b->constraint() >= 0 ? b->constraint()
                           : to - from == 1       ? chain_of_edge(a, b)
                                                  : chain[from + 1]->constraint());
    piece.vertices.assign(chain.begin() + static_cast<std::ptrdiff_t>(from),
                          chain.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    const double s = parameter(piece.chain, a), t = parameter(piece.chain, b);
    for (double& cut : cuts) cut = s + cut * (t - s);
    piece.cuts = std::move(cuts);
    for (std::size_t i = 1; i + 1 < piece.vertices.size(); ++i) goes_[as_index(piece.vertices[i]->id())] = true;
    is_open_[as_index(a->id())] = is_open_[as_index(b->id())] = true;
    pieces.push_back(std::move(piece));
  }

  int chain_of_edge(Vertex_handle a, Vertex_handle b) const
  {
    Face_handle f;
    int i;
    mesh_.triangulation().is_edge(a, b, f, i);
    return mesh_.chain_of(f, i);
  }

  /// Where a vertex lies along its chain, 0 at its source.
  double parameter(std::size_t chain, Vertex_handle v) const
  {
    const auto& ends = mesh_.chains()[chain];
    if (v == ends.source) return 0;
    if (v == ends.target) return 1;
    const auto along = ends.target->point() - ends.source->point();
    return CGAL::to_double((v->point() - ends.source->point()) * along) / CGAL::to_double(along * along);
  }

  double length(Vertex_handle a, Vertex_handle b) const
  {
    return std::sqrt(CGAL::to_double(CGAL::squared_distance(a->point(), b->point())));
  }
  double metric_length(Vertex_handle a, Vertex_handle b) const
  {
    return 2 * length(a, b) / (mesh_.target(a) + mesh_.target(b));
  }
  bool is_too_long(Vertex_handle a, Vertex_handle b) const
  {
    return length(a, b) > mesh_.size(CGAL::midpoint(a->point(), b->point()));
  }

  template <class Visit>
  void for_each_neighbor(Vertex_handle v, const Visit& visit) const
  {
    auto neighbor = mesh_.triangulation().incident_vertices(v);
    const auto done = neighbor;
    do
      if (!mesh_.is_frame(neighbor)) visit(Vertex_handle(neighbor));
    while (++neighbor != done);
  }

  /// Opens the vertices around those that go.
  void open_around()
  {
    for (const Vertex_handle v : mesh_.vertices())
      if (goes(v)) for_each_neighbor(v, [&](Vertex_handle w) { is_open_[as_index(w->id())] = true; });
  }

  /// Spaces the vertices of a piece anew.
  template <class Go_on>
  bool space(const Piece& piece, std::size_t max_vertices, const Go_on& go_on)
  {
    const auto& v = piece.vertices;
    for (std::size_t i = 1; i + 1 < v.size(); ++i) {
      if (mesh_.remove_from_constraint(v[i]))
        ++removed_;
      else
        fresh_.push_back(v[i]); // rounding forbids it
    }
    if (mesh_.triangulation().number_of_vertices() + piece.cuts.size() > max_vertices) return false;
    return insert_cuts(mesh_, mesh_.chains()[piece.chain], v.front(), v.back(), piece.cuts, go_on,
                       [this](Vertex_handle w) { fresh_.push_back(w); });
  }

  /// Freezes what is more than some rings away from holes and what else is to move.
  void freeze(const std::vector<Vertex_handle>& moving)
  {
    std::vector<char> frozen(mesh_.vertices().size(), true);
    std::vector<Vertex_handle> ring;
    const auto thaw = [&](Vertex_handle v) {
      if (!std::exchange(frozen[as_index(v->id())], false)) return;
      ring.push_back(v);
    };
    for (const Vertex_handle v : mesh_.vertices())
      if (is_open(v)) thaw(v);
    for (const Vertex_handle v : moving) thaw(v);
    for (int k = 0; k < moving_rings; ++k)
      for (const Vertex_handle v : std::exchange(ring, {})) for_each_neighbor(v, thaw);
    mesh_.frozen().assign(std::move(frozen));
  }

  static constexpr double ideal = 0.85; // spacing of vertices that aren't in the domain
  static constexpr std::size_t most_cuts = 100000000;

  Mesh& mesh_;
  double spacing_;
  Bounds bounds_ = loose;
  std::vector<std::array<std::size_t, 3>> triangles_; // vertices of faces before anything goes
  std::vector<double> near_, wide_;                   // spacings, by vertex
  std::vector<char> is_open_;                         // by vertex: at a hole
  std::vector<char> goes_;                            // by vertex
  std::vector<Vertex_handle> fresh_;                  // on constraints
  std::size_t removed_ = 0;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_REFINE_MISFIT_REMOVER_2_H
