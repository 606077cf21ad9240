// SPDX-License-Identifier: GPL-3.0-or-later
//
// Batch refinement (Tournois 2009, sec. 2.2.1). Elements whose sizing ratio exceeds a slowly decreasing target are
// refined worst first: constrained edges at their midpoints, triangles at their circumcenters. An element that is
// chosen takes part of its neighbors' need upon itself: their ratios are altered before they are looked at.
//
// Beyond the thesis: near the goal, where the target's steps would insert too many points at once, chosen elements
// share no vertex and a batch is small; the circumcenter of a blind triangle is never used. Where all triangles of a
// mesh are near the goal (after crystal seeding) a too long edge is the defect itself, and its midpoint is the better
// place.

#ifndef WEFT_PLANAR_REFINE_BATCH_REFINER_2_H
#define WEFT_PLANAR_REFINE_BATCH_REFINER_2_H

#include <weft/internal/as_index.h>
#include <weft/planar/triangulation/blind_triangle_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Refines a Working_mesh_2 in batches.
template <class Mesh>
class Batch_refiner_2
{
public:
  using Triangulation = typename Mesh::Triangulation;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  /// Below this largest ratio a batch is small and its elements are independent.
  static constexpr double near_goal = 1.6;

  /// While the largest ratio is above, elements up to this ratio are left to the small batches that follow. With 1 a
  /// single long edge has all elements refined that are hardly too long, too, which relaxation and polishing would have
  /// shortened.
  static constexpr double least_target = 1.2;

  /// \param min_angle smallest angle asked for, in degrees; 0 for none.
  Batch_refiner_2(Mesh& mesh, double min_angle) : mesh_(mesh) { set_min_angle(min_angle); }

  void set_min_angle(double degrees) { max_cosine_ = degrees > 0 ? std::cos(degrees * std::acos(-1.0) / 180) : 2; }

  /// Counts elements that violate a criterion and remembers them, worst first, for `refine()`. Frozen faces aren't
  /// looked at: they were good when they were frozen.
  std::size_t find_bad() { return find_bad(false); }

  /// The same, but looks at frozen faces, too, which flips may have made: thaws those that are too large.
  std::size_t find_bad_everywhere() { return find_bad(true); }

  /// Largest sizing ratio seen by the last of these.
  double largest_ratio() const { return largest_ratio_; }

  /// Triangles and constrained edges that `find_bad()` found too large.
  std::size_t oversized() const { return oversized_; }

  /// Triangles with angles below the bound.
  struct Sharp_triangles
  {
    std::size_t mendable = 0; ///< that the input doesn't force
    std::size_t given = 0;    ///< that it may, see `is_forced()`
  };

  Sharp_triangles count_sharp() const
  {
    Sharp_triangles result;
    if (max_cosine_ > 1) return result;
    for (const Face_handle f : mesh_.faces())
      if (is_sharp(f)) ++(is_forced(f) ? result.given : result.mendable);
    return result;
  }

  /// Inserts one batch of Steiner points for the elements that `find_bad()` found.
  /// \param most number of points at most.
  /// \returns the new vertices. The mesh must be renumbered afterwards.
  std::vector<Vertex_handle> refine(std::size_t most)
  {
    const bool near = largest_ratio_ < near_goal;
    choose(near ? 1 : (std::max)(largest_ratio_ / std::sqrt(3.0), least_target), near, most);
    std::vector<Vertex_handle> inserted;
    for (const Choice& c : chosen_)
      if (const Vertex_handle v = insert(c, near); v != Vertex_handle()) inserted.push_back(v);
    return inserted;
  }

  /// Whether a face has an angle below the bound that the input doesn't force on it.
  bool is_too_sharp(Face_handle f) const { return is_sharp(f) && !is_forced(f); }

  /// Whether a face has an angle below the bound.
  bool is_sharp(Face_handle f) const { return cosine(f, shortest_edge(f)) > max_cosine_; }

  /// Whether the input may force a sharp angle on a face: its shortest edge joins two constraints that meet at less
  /// than 60 degrees. Refining such faces would never end (Miller, Pav and Walkington, "When and why Delaunay
  /// refinement algorithms work", 2005).
  bool is_forced(Face_handle f) const
  {
    const int shortest = shortest_edge(f);
    const Vertex_handle a = f->vertex(Triangulation::ccw(shortest)), b = f->vertex(Triangulation::cw(shortest));
    if (is_input_angle(f, shortest)) return true;
    if (a->constraint() == free_vertex || b->constraint() == free_vertex) return false;
    return meet_sharply(a, b);
  }

  /// Whether both edges of the face at corner i are constrained.
  static bool is_input_angle(Face_handle f, int i)
  {
    return f->is_constrained(Triangulation::ccw(i)) && f->is_constrained(Triangulation::cw(i));
  }

private:
  static constexpr int whole_face = -1;
  using Key = std::array<double, 6>;

  struct Bad
  {
    double ratio;
    Key key;
    Face_handle face;
    int edge;
    bool operator<(const Bad& o) const
    {
      if (ratio != o.ratio) return ratio > o.ratio;
      if (key != o.key) return key < o.key; // ties go by coordinates
      return edge < o.edge;
    }
  };
  struct Choice // by vertices, since earlier insertions destroy faces
  {
    std::array<Vertex_handle, 3> vertex;
    int edge;
  };

  std::size_t find_bad(bool everywhere)
  {
    bad_.clear();
    largest_ratio_ = 0;
    oversized_ = 0;
    for (const Face_handle f : mesh_.faces()) {
      if (!everywhere && mesh_.is_frozen(f)) continue;
      for (int i = 0; i < 3; ++i)
        if (f->is_constrained(i) && represents_edge(f, i)) consider(mesh_.edge_ratio(f, i), f, i);
      if (!is_surely_good(f)) consider(mesh_.ratio(f), f, whole_face);
    }
    for (const Bad& b : bad_)
      for (int i = 0; everywhere && i < 3; ++i) mesh_.frozen().thaw(as_index(b.face->vertex(i)->id()));
    if (max_cosine_ < 1 && bad_.empty())
      for (const Face_handle f : mesh_.faces())
        if (!mesh_.is_frozen(f) && is_too_sharp(f)) bad_.push_back({0, key(f), f, whole_face});
    std::sort(bad_.begin(), bad_.end());
    return bad_.size();
  }

  static Key key(Face_handle f)
  {
    Key k;
    for (int i = 0; i < 3; ++i) {
      k[as_index(2 * i)] = CGAL::to_double(f->vertex(i)->point().x());
      k[as_index(2 * i + 1)] = CGAL::to_double(f->vertex(i)->point().y());
    }
    // Which vertex comes first is an accident of history.
    while (std::pair(k[2], k[3]) < std::pair(k[0], k[1]) || std::pair(k[4], k[5]) < std::pair(k[0], k[1]))
      std::rotate(k.begin(), k.begin() + 2, k.end());
    return k;
  }

  /// Whether an edge is to be looked at from this side: each is once, from a face of the domain.
  static bool represents_edge(Face_handle f, int i)
  {
    return !f->neighbor(i)->is_in_domain() ||
           f->vertex(Triangulation::ccw(i))->id() < f->vertex(Triangulation::cw(i))->id();
  }

  /// Certain that a face's ratio is neither bad nor the largest so far, up to rounding; spares most faces the roots
  /// and divisions.
  bool is_surely_good(Face_handle f) const
  {
    const double longest =
        (std::max)({mesh_.squared_length(f, 0), mesh_.squared_length(f, 1), mesh_.squared_length(f, 2)});
    const double size = mesh_.size(f) * (std::min)(largest_ratio_, 1.0) * (1 - 1e-12);
    return longest < size * size;
  }

  void consider(double ratio, Face_handle f, int edge)
  {
    largest_ratio_ = (std::max)(largest_ratio_, ratio);
    if (ratio <= 1) return;
    bad_.push_back({ratio, key(f), f, edge});
    ++oversized_;
  }

  /// Whether constraints through a and through b have a common end where they make less than 60 degrees.
  bool meet_sharply(Vertex_handle a, Vertex_handle b) const
  {
    for (const int i : chains_at(a))
      for (const int j : chains_at(b)) {
        const auto &p = mesh_.chains()[as_index(i)], &q = mesh_.chains()[as_index(j)];
        if (i == j) continue;
        for (const auto& [corner, end] : {std::pair(p.source, p.target), std::pair(p.target, p.source)}) {
          if (corner != q.source && corner != q.target) continue;
          const auto u = end->point() - corner->point(),
                     v = (corner == q.source ? q.target : q.source)->point() - corner->point();
          if (CGAL::to_double(u * v) > 0.5 * std::sqrt(CGAL::to_double(u * u) * CGAL::to_double(v * v))) return true;
        }
      }
    return false;
  }

  /// Chains through a vertex: its own, or those that end at it.
  std::vector<int> chains_at(Vertex_handle v) const
  {
    if (v->constraint() >= 0) return {v->constraint()};
    std::vector<int> result;
    auto edge = mesh_.triangulation().incident_edges(v);
    const auto done = edge;
    do
      if (mesh_.triangulation().is_constrained(*edge)) result.push_back(mesh_.chain_of(edge->first, edge->second));
    while (++edge != done);
    return result;
  }

  /// It lies opposite the smallest angle.
  int shortest_edge(Face_handle f) const
  {
    int shortest = 0;
    for (int i = 1; i < 3; ++i)
      if (mesh_.squared_length(f, i) < mesh_.squared_length(f, shortest)) shortest = i;
    return shortest;
  }

  double cosine(Face_handle f, int i) const
  {
    const double a = mesh_.squared_length(f, i), b = mesh_.squared_length(f, Triangulation::ccw(i)),
                 c = mesh_.squared_length(f, Triangulation::cw(i));
    return (b + c - a) / (2 * std::sqrt(b * c));
  }

  /// Chooses elements with altered ratios above the target.
  void choose(double target, bool independent, std::size_t most)
  {
    chosen_.clear();
    std::vector<char> used(mesh_.vertices().size(), 0);
    for (const Face_handle f : mesh_.faces()) f->set_id(-1); // positions in `change`, for faces in need only
    std::vector<double> change(bad_.size(), 0);
    for (std::size_t k = 0; k < bad_.size(); ++k)
      if (bad_[k].edge == whole_face) bad_[k].face->set_id(static_cast<int>(k));
    for (std::size_t k = 0; k < bad_.size() && chosen_.size() < most; ++k) {
      const Bad& b = bad_[k];
      if (b.ratio > 0 && b.ratio + change[k] <= target) continue;
      const std::array<Vertex_handle, 3> v{b.face->vertex(0), b.face->vertex(1), b.face->vertex(2)};
      if (independent && (used[as_index(v[0]->id())] || used[as_index(v[1]->id())] || used[as_index(v[2]->id())]))
        continue;
      for (const Vertex_handle w : v)
        if (w->constraint() != fixed_vertex || independent) used[as_index(w->id())] = 1;
      chosen_.push_back({v, b.edge});
      if (b.edge != whole_face || b.ratio == 0) continue;
      for (int i = 0; i < 3; ++i)
        if (const int n = b.face->neighbor(i)->id(); n > static_cast<int>(k) && b.face->neighbor(i)->is_in_domain())
          change[as_index(n)] += (b.ratio / std::sqrt(3.0) - target) / 3;
    }
  }

  Vertex_handle insert(const Choice& c, bool near)
  {
    Triangulation& cdt = mesh_.triangulation();
    Face_handle f;
    if (c.edge != whole_face) {
      const Vertex_handle a = c.vertex[as_index(Triangulation::ccw(c.edge))],
                          b = c.vertex[as_index(Triangulation::cw(c.edge))];
      int i;
      return cdt.is_edge(a, b, f, i) && f->is_constrained(i) ? split(f, i) : Vertex_handle();
    }
    if (!cdt.is_face(c.vertex[0], c.vertex[1], c.vertex[2], f)) return Vertex_handle();
    int longest = 0;
    for (int i = 1; i < 3; ++i)
      if (mesh_.squared_length(f, i) > mesh_.squared_length(f, longest)) longest = i;
    if (f->is_constrained(longest)) return split(f, longest);
    if (near && mesh_.ratio(f) > 1) return mesh_.insert_inside(middle(f, longest), f);
    return insert_circumcenter(f, longest);
  }

  Point middle(Face_handle f, int i) const
  {
    return CGAL::midpoint(f->vertex(Triangulation::ccw(i))->point(), f->vertex(Triangulation::cw(i))->point());
  }

  Vertex_handle split(Face_handle f, int i) { return mesh_.insert_on_constraint(middle(f, i), f, i); }

  /// Inserts the circumcenter if the triangle sees it and it encroaches on no constraint near it, else splits the
  /// constraint in the way; refining what blinds a triangle needs fewer points in the end than a point on its near
  /// side.
  Vertex_handle insert_circumcenter(Face_handle f, int longest)
  {
    const Triangulation& cdt = mesh_.triangulation();
    const Point c = accurate_circumcenter<typename Triangulation::Geom_traits>(
        f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point());
    Face_handle here = f;
    // Walk towards the circumcenter; each step crosses the edge that separates it from the face.
    for (std::size_t steps = 0; steps < most_steps; ++steps) {
      int across = -1;
      for (int i = 0; i < 3 && across < 0; ++i)
        if (cdt.geom_traits().orientation_2_object()(here->vertex(Triangulation::ccw(i))->point(),
                                                     here->vertex(Triangulation::cw(i))->point(),
                                                     c) == CGAL::RIGHT_TURN)
          across = i;
      if (across < 0) break;
      if (here->is_constrained(across)) return split(here, across);
      here = here->neighbor(across);
    }
    for (int i = 0; i < 3; ++i)
      if (here->is_constrained(i) && encroaches(c, here, i)) return split(here, i);
    const Vertex_handle v = mesh_.insert_inside(c, here);
    return v != Vertex_handle() ? v : mesh_.insert_inside(middle(f, longest), f);
  }

  bool encroaches(const Point& p, Face_handle f, int i) const
  {
    return mesh_.triangulation().geom_traits().side_of_bounded_circle_2_object()(
               f->vertex(Triangulation::ccw(i))->point(), f->vertex(Triangulation::cw(i))->point(), p) ==
           CGAL::ON_BOUNDED_SIDE;
  }

  static constexpr std::size_t most_steps = 10000; // of a walk, in case rounding makes it circle

  Mesh& mesh_;
  double max_cosine_ = 2;
  double largest_ratio_ = 0;
  std::size_t oversized_ = 0;
  std::vector<Bad> bad_;
  std::vector<Choice> chosen_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_REFINE_BATCH_REFINER_2_H
