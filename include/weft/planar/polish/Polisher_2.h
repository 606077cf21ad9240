// SPDX-License-Identifier: GPL-3.0-or-later
//
// Improves the worst triangles of a mesh by moving single vertices, in the plane or along their constraints: the
// "hill-climbing" step that Tournois 2009, sec. 2.5, leaves to future work. The cost of a triangle grows as its
// smallest angle falls and its largest rises, and jumps when an edge is too long for the sizing field. A move is
// accepted only if the worst cost of all triangles that it touches, after Delaunay flips, falls; so no move undoes
// what refinement achieved.

#ifndef WEFT_PLANAR_POLISH_POLISHER_2_H
#define WEFT_PLANAR_POLISH_POLISHER_2_H

#include <weft/internal/as_index.h>
#include <weft/internal/cold.h>
#include <weft/planar/polish/Star_cost_2.h>
#include <weft/planar/polish/triangle_cost_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/planar/working/Failure_memory.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft::internal {

/// Polishes a Working_mesh_2.
template <class Mesh>
class Polisher_2
{
public:
  using Triangulation = typename Mesh::Triangulation;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  static constexpr double oversize_cost = oversize_cost_2; ///< what an edge that is too long costs at least

  explicit Polisher_2(Mesh& mesh) : mesh_(mesh), star_(mesh) {}

  /// To be called when the mesh has changed otherwise than by this polisher.
  void reset()
  {
    hopeless_.assign(mesh_.vertices().size(), 0);
    hopeful_.clear();
    failures_.reserve(mesh_.vertices().size());
  }

  /// By the ids of its vertices: trials replace faces.
  using Triangle = std::array<int, 3>;

  /// The triangles whose cost exceeds a bound, worst first, equal ones in the order of the faces.
  WEFT_NOINLINE std::vector<Triangle> worst_triangles(double bound) const
  {
    std::vector<Triangle> result;
    for (const auto& [b, i] : worst_of(mesh_.faces(), bound)) {
      const Face_handle f = mesh_.faces()[i];
      result.push_back({f->vertex(0)->id(), f->vertex(1)->id(), f->vertex(2)->id()});
    }
    return result;
  }

  /// Whether a triangle is still there, and its face.
  WEFT_NOINLINE bool find(const Triangle& t, Face_handle& f) const
  {
    std::array<Vertex_handle, 3> v;
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] = mesh_.vertices()[as_index(t[i])];
      if (v[i] == Vertex_handle()) return false;
    }
    return mesh_.triangulation().is_face(v[0], v[1], v[2], f);
  }

  /// One pass over the triangles whose cost exceeds `bound`, worst first.
  /// \returns the number of vertices moved.
  std::size_t pass(double bound) { return pass(mesh_.faces(), bound); }

  /// Passes until one moves nothing.
  /// \param go_on callable without arguments, called before every pass; false stops.
  /// \returns the number of moves.
  template <class Go_on>
  std::size_t run(double bound, int most_passes, const Go_on& go_on)
  {
    reset();
    std::size_t moved = 0;
    for (int i = 0; i < most_passes && go_on(); ++i) {
      // Looking at all triangles again after each pass would take time for nothing.
      const std::size_t n = i == 0 ? pass(bound) : pass(faces_near(std::exchange(hopeful_, {})), bound);
      moved += n;
      if (n == 0) break;
    }
    return moved;
  }

  std::size_t flips() const { return flips_; }

  /// What a triangle costs: 0 while its angles lie within [50, 80] degrees, 1 at 37 or 94 degrees, without bound
  /// towards 0 and 180; far more with an edge that is too long. Small angles between two constraints don't count, they
  /// can't be mended; large ones do, a vertex more can divide them.
  double cost(Face_handle f) const
  {
    return triangle_cost_2(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point(), given_angles_2(f, 0),
                           mesh_.size(f));
  }

  /// Tries to move one vertex to a better place; flips afterwards. Returns whether it moved.
  bool improve(Vertex_handle v)
  {
    hopeless_.resize(mesh_.vertices().size(), 0);
    if (v->constraint() == fixed_vertex || mesh_.is_frozen(v) || hopeless_[as_index(v->id())]) return false;
    hopeless_[as_index(v->id())] = 1;
    const std::uint64_t key = key_of_star(v);
    if (failures_.contains(key)) return false;
    if (search_and_move(v)) {
      give_hope_around(v);
      return true;
    }
    failures_.add(key);
    return false;
  }

  /// What a search for a better place depends on: the vertex, its link, and what is constrained there.
  std::uint64_t key_of_star(Vertex_handle v) const
  {
    std::uint64_t key = scrambled(key_of_vertex(v) + static_cast<std::uint64_t>(v->constraint()));
    auto face = mesh_.triangulation().incident_faces(v);
    const auto done = face;
    do {
      const int i = face->index(v), a = Triangulation::ccw(i), b = Triangulation::cw(i);
      const auto flags = static_cast<std::uint64_t>(face->is_in_domain()) + 2 * face->is_constrained(i) +
                         4 * face->is_constrained(a) + 8 * face->is_constrained(b);
      // A sum, since the face at which the circulation begins may change; each face by its first vertex, since the
      // second is the next face's first.
      key += scrambled(key_of_vertex(face->vertex(a)) + flags);
    } while (++face != done);
    return key;
  }

  /// Sum of the costs of the triangles around a vertex.
  double cost_around(Vertex_handle v) const
  {
    double sum = 0;
    auto face = mesh_.triangulation().incident_faces(v);
    const auto done = face;
    do {
      if (face->is_in_domain()) sum += cost(face);
      const int edge = Triangulation::cw(face->index(v));
      if (!face->is_constrained(edge)) continue;
      const double ratio = mesh_.edge_ratio(face, edge);
      sum += oversize_2(ratio * ratio);
    } while (++face != done);
    return sum;
  }

  /// Makes a vertex worth another try.
  void give_hope(Vertex_handle v)
  {
    hopeless_.resize(mesh_.vertices().size(), 0);
    if (!std::exchange(hopeless_[as_index(v->id())], 0)) return;
    hopeful_.push_back(v);
  }

  /// Vertices near one that moved are worth another try.
  void give_hope_around(Vertex_handle v)
  {
    give_hope(v);
    auto neighbor = mesh_.triangulation().incident_vertices(v);
    const auto done = neighbor;
    do
      if (!mesh_.is_frame(neighbor)) give_hope(neighbor);
    while (++neighbor != done);
  }

private:
  /// Faces whose cost exceeds a bound, by their costs with a minus and their numbers.
  WEFT_NOINLINE std::vector<std::pair<double, std::size_t>> worst_of(const std::vector<Face_handle>& faces,
                                                                     double bound) const
  {
    std::vector<std::pair<double, std::size_t>> worst;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (mesh_.is_frozen(faces[i])) continue;
      if (const double b = cost(faces[i]); b > bound) worst.emplace_back(-b, i);
    }
    std::sort(worst.begin(), worst.end());
    return worst;
  }

  std::size_t pass(const std::vector<Face_handle>& faces, double bound)
  {
    const auto worst = worst_of(faces, bound);
    hopeless_.resize(mesh_.vertices().size(), 0);
    std::size_t moved = 0;
    for (const auto& [b, i] : worst) {
      const Face_handle f = faces[i];
      std::array<Vertex_handle, 6> around;
      std::size_t n = 0;
      for (int k = 0; k < 3; ++k) around[n++] = f->vertex(k);
      for (int k = 0; k < 3; ++k)
        if (!f->is_constrained(k)) around[n++] = f->neighbor(k)->vertex(f->neighbor(k)->index(f));
      for (std::size_t k = 0; k < n; ++k) moved += improve(around[k]);
    }
    return moved;
  }

  /// The faces of the domain whose pass tries one of the vertices, once each.
  std::vector<Face_handle> faces_near(const std::vector<Vertex_handle>& vertices) const
  {
    const auto for_faces = [&](const auto& function) {
      for (const Vertex_handle v : vertices) {
        auto face = mesh_.triangulation().incident_faces(v);
        const auto done = face;
        do {
          function(Face_handle(face));
          if (const int i = face->index(v); !face->is_constrained(i)) function(face->neighbor(i));
        } while (++face != done);
      }
    };
    std::vector<Face_handle> faces;
    for_faces([](Face_handle f) { f->set_id(0); });
    for_faces([&](Face_handle f) {
      if (f->id() == 0 && f->is_in_domain()) faces.push_back(f);
      f->set_id(1); // listed
    });
    return faces;
  }

  static std::uint64_t key_of_vertex(Vertex_handle v)
  {
    return key_of_point(CGAL::to_double(v->point().x()), CGAL::to_double(v->point().y()));
  }

  bool search_and_move(Vertex_handle v)
  {
    if (!star_.load(v)) return false;
    const Point old = v->point();
    double cost = star_.rank(CGAL::to_double(old.x()), CGAL::to_double(old.y()));
    const double before = cost;
    if (cost < negligible) return false;
    const Point best = v->constraint() >= 0 ? search_on_constraint(v, cost) : search(v, cost);
    if (best == old || !mesh_.relocator().move_within_star(v, best, flips_)) return false;
    mesh_.update_target(v);
    if (cost_around(v) <= before) return true;
    // The flips made it worse than had been promised: go back. Flips on the way back restore the old edges, up to
    // cocircular ones.
    mesh_.relocator().move_within_star(v, old, flips_);
    mesh_.update_target(v);
    return false;
  }

  static constexpr double negligible = 0.1;

  /// Compass search in eight directions with halved steps; lowers `lowest`.
  Point search(Vertex_handle v, double& lowest) const
  {
    static const double d = std::sqrt(0.5);
    static const std::array<std::array<double, 2>, 8> directions{
        {{1, 0}, {d, d}, {0, 1}, {-d, d}, {-1, 0}, {-d, -d}, {0, -1}, {d, -d}}};
    return compass(v, directions, lowest);
  }

  Point search_on_constraint(Vertex_handle v, double& lowest) const
  {
    const auto& chain = mesh_.chains()[as_index(v->constraint())];
    const double dx = CGAL::to_double(chain.target->point().x() - chain.source->point().x()),
                 dy = CGAL::to_double(chain.target->point().y() - chain.source->point().y()),
                 l = std::sqrt(dx * dx + dy * dy);
    const std::array<std::array<double, 2>, 2> directions{{{dx / l, dy / l}, {-dx / l, -dy / l}}};
    const Point best = compass(v, directions, lowest);
    if (best == v->point()) return best;
    // Many small steps would drift off the line.
    const double sx = CGAL::to_double(chain.source->point().x()), sy = CGAL::to_double(chain.source->point().y());
    const double f = ((CGAL::to_double(best.x()) - sx) * dx + (CGAL::to_double(best.y()) - sy) * dy) / (l * l);
    return Point(sx + f * dx, sy + f * dy);
  }

  template <std::size_t N>
  Point compass(Vertex_handle v, const std::array<std::array<double, 2>, N>& directions, double& lowest) const
  {
    // Smaller steps and gains are left to later visits: they cost time and gain little.
    constexpr int halvings = 3;
    constexpr double gain = 0.95;
    double x = CGAL::to_double(v->point().x()), y = CGAL::to_double(v->point().y());
    double step = 0.1 * mesh_.target(v);
    std::size_t at = 0;     // the direction that was good last is tried first
    std::size_t failed = 0; // directions in a row
    for (int k = 0; k < halvings;) {
      const double new_x = x + step * directions[at][0], new_y = y + step * directions[at][1];
      const double c = star_.at(new_x, new_y, gain * lowest);
      if (c < gain * lowest) {
        lowest = c;
        x = new_x, y = new_y;
        failed = 0;
        continue;
      }
      at = (at + 1) % N;
      if (++failed < N) continue;
      failed = 0;
      step *= 0.5;
      ++k;
    }
    return Point(x, y);
  }

  Mesh& mesh_;
  Star_cost_2<Mesh> star_;             // of the vertex at hand
  std::vector<char> hopeless_;         // by vertex id: tried in vain, and nothing near it has changed since
  std::vector<Vertex_handle> hopeful_; // given hope since the last pass began
  Failure_memory failures_;            // stars whose vertex found no better place
  std::size_t flips_ = 0;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_POLISH_POLISHER_2_H
