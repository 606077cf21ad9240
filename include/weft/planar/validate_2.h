// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a planar mesh is what it claims to be: a triangulation of the plane (combinatorially, and by the orientation
// of its faces and hull), constrained Delaunay, conforming to the graph it was made from, with the right faces in the
// domain, and no larger than a sizing field allows. Exact predicates decide wherever the truth doesn't depend on
// rounding; the two checks that do depend on it say how. Every check walks the triangulation by itself, needs no
// assertions of CGAL and changes nothing, and each can be called alone.
//
// Works on any CGAL constrained triangulation whose faces have `is_in_domain()`.

#ifndef WEFT_PLANAR_VALIDATE_2_H
#define WEFT_PLANAR_VALIDATE_2_H

#include <weft/errors.h>
#include <weft/planar/insert_pslg.h>
#include <weft/planar/mark_domain.h>
#include <weft/planar/Pslg_2.h>
#include <weft/planar/quality_2.h>
#include <weft/planar/Triangulation_2.h>

#include <CGAL/enum.h>
#include <CGAL/number_utils.h>
#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace weft {

/// What can be wrong with a mesh.
enum class Fault_kind
{
  structure,   ///< vertices and faces don't refer to each other as in a triangulation of the sphere
  orientation, ///< a face is turned over or flat, or the convex hull isn't convex
  delaunay,    ///< an unconstrained edge isn't locally Delaunay
  conformity,  ///< constrained edges aren't the input's segments, or an input point is missing
  domain,      ///< the wrong faces are in the domain
  sizing       ///< a triangle or constrained edge is larger than the sizing field allows
};

/// Name of a kind of fault for people.
inline const char* name(Fault_kind kind)
{
  constexpr std::array<const char*, 6> names = {"structure",  "orientation", "delaunay",
                                                "conformity", "domain",      "sizing"};
  return names[static_cast<std::size_t>(kind)];
}

/// One thing that is wrong.
struct Fault_2
{
  Fault_kind kind;
  std::string text;                          ///< one line for a person, with the coordinates
  std::vector<std::array<double, 2>> points; ///< what is to blame: one point a vertex, two an edge, three a face
};

/// What the checks found.
struct Validity_2
{
  static constexpr std::size_t most_listed = 100; ///< faults of one kind; more are only counted

  std::vector<Fault_2> faults;         ///< in the order in which they were found
  std::array<std::size_t, 6> counts{}; ///< number of faults by kind, listed or not

  bool ok() const { return counts == std::array<std::size_t, 6>{}; }
  std::size_t count(Fault_kind kind) const { return counts[static_cast<std::size_t>(kind)]; }

  void add(Fault_kind kind, const std::string& what, std::vector<std::array<double, 2>> points = {})
  {
    if (++counts[static_cast<std::size_t>(kind)] > most_listed) return;
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    text << what << (points.empty() ? "" : " at");
    for (const auto& p : points) text << " (" << p[0] << ", " << p[1] << ")";
    faults.push_back({kind, text.str(), std::move(points)});
  }

  Validity_2& operator+=(const Validity_2& other)
  {
    faults.insert(faults.end(), other.faults.begin(), other.faults.end());
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += other.counts[i];
    return *this;
  }
};

/// One line a fault, or "valid".
inline std::ostream& operator<<(std::ostream& out, const Validity_2& validity)
{
  for (const Fault_2& fault : validity.faults) out << name(fault.kind) << ": " << fault.text << "\n";
  for (std::size_t i = 0; i < validity.counts.size(); ++i)
    if (validity.counts[i] > Validity_2::most_listed)
      out << name(static_cast<Fault_kind>(i)) << ": " << validity.counts[i] << " faults in all\n";
  return validity.ok() ? out << "valid\n" : out;
}

namespace internal {

/// How many units in the last place of the largest coordinate a vertex may lie off its segment, for being rounded.
constexpr double most_ulps_off_segment = 8;

inline double ulps_of(double coordinate, double ulps)
{
  return ulps * std::numeric_limits<double>::epsilon() * coordinate;
}

template <class Point>
double largest_coordinate(const Point& p)
{
  return (std::max)(std::abs(CGAL::to_double(p.x())), std::abs(CGAL::to_double(p.y())));
}

/// Finite corners of a face.
template <class Cdt>
std::vector<Xy_2> corners(const Cdt& cdt, typename Cdt::Face_handle face)
{
  std::vector<Xy_2> result;
  for (int i = 0; i < 3; ++i)
    if (!cdt.is_infinite(face->vertex(i))) result.push_back(xy(face->vertex(i)->point()));
  return result;
}

/// Ends of edge i of a face.
template <class Cdt>
std::vector<Xy_2> ends(const Cdt& cdt, typename Cdt::Face_handle face, int i)
{
  std::vector<Xy_2> result;
  for (const int k : {Cdt::ccw(i), Cdt::cw(i)})
    if (!cdt.is_infinite(face->vertex(k))) result.push_back(xy(face->vertex(k)->point()));
  return result;
}

/// Lexicographic order of coordinates.
template <class Cdt>
CGAL::Comparison_result compare_xy(const Cdt& cdt, const typename Cdt::Point& p, const typename Cdt::Point& q)
{
  const auto in_x = cdt.geom_traits().compare_x_2_object()(p, q);
  return in_x != CGAL::EQUAL ? in_x : cdt.geom_traits().compare_y_2_object()(p, q);
}

/// Checks the data structure alone: that it is a triangulated sphere. Doesn't trust any link before it has been seen to
/// lead to a face or vertex of the triangulation.
template <class Cdt>
class Structure_checker_2
{
public:
  using Vertex_handle = typename Cdt::Vertex_handle;
  using Face_handle = typename Cdt::Face_handle;

  explicit Structure_checker_2(const Cdt& cdt) : cdt_(cdt) {}

  Validity_2 check()
  {
    if (cdt_.dimension() != 2) {
      validity_.add(Fault_kind::structure, "the triangulation isn't two-dimensional");
      return validity_;
    }
    for (const Vertex_handle v : cdt_.all_vertex_handles()) {
      faces_at_[v] = 0;
      ++number_of_vertices_;
    }
    for (const Face_handle f : cdt_.all_face_handles()) {
      is_face_[f] = true;
      ++number_of_faces_;
    }
    for (const Face_handle f : cdt_.all_face_handles()) check_vertices(f);
    if (!validity_.ok()) return validity_;
    for (const Face_handle f : cdt_.all_face_handles()) check_neighbors(f);
    if (!validity_.ok()) return validity_;
    for (const Vertex_handle v : cdt_.all_vertex_handles()) check_star(v);
    if (validity_.ok()) check_sphere();
    return validity_;
  }

private:
  // The maps take null for a key of theirs.
  bool is_vertex(Vertex_handle v) const { return v != Vertex_handle() && faces_at_.is_defined(v); }
  bool is_face(Face_handle f) const { return f != Face_handle() && is_face_.is_defined(f); }

  void check_vertices(Face_handle f)
  {
    bool known = true;
    for (int i = 0; i < 3; ++i) known = known && is_vertex(f->vertex(i));
    if (!known) {
      validity_.add(Fault_kind::structure, "a face has a vertex that isn't one of the triangulation");
      return;
    }
    if (f->vertex(0) == f->vertex(1) || f->vertex(1) == f->vertex(2) || f->vertex(2) == f->vertex(0))
      validity_.add(Fault_kind::structure, "a face has the same vertex twice", corners(cdt_, f));
    for (int i = 0; i < 3; ++i) ++faces_at_[f->vertex(i)];
  }

  void check_neighbors(Face_handle f)
  {
    for (int i = 0; i < 3; ++i) {
      const Face_handle n = f->neighbor(i);
      if (!is_face(n)) {
        validity_.add(Fault_kind::structure, "an edge has no face on its other side", ends(cdt_, f, i));
        continue;
      }
      int j = 0;
      while (j < 3 && (n->neighbor(j) != f || n->vertex(Cdt::ccw(j)) != f->vertex(Cdt::cw(i)) ||
                       n->vertex(Cdt::cw(j)) != f->vertex(Cdt::ccw(i))))
        ++j;
      if (j == 3)
        validity_.add(Fault_kind::structure, "two neighboring faces don't share their edge", ends(cdt_, f, i));
      else if (f->is_constrained(i) != n->is_constrained(j))
        validity_.add(Fault_kind::structure, "an edge is constrained on one side only", ends(cdt_, f, i));
    }
  }

  /// All faces at a vertex must form one cycle around it. Neighbors are known to agree, so turning comes back.
  void check_star(Vertex_handle v)
  {
    const Face_handle start = v->face();
    int turned = 0;
    if (is_face(start) && start->has_vertex(v)) {
      Face_handle f = start;
      do {
        f = f->neighbor(Cdt::ccw(f->index(v)));
        ++turned;
      } while (f != start);
    }
    if (turned == faces_at_[v]) return;
    std::vector<Xy_2> point;
    if (!cdt_.is_infinite(v)) point.push_back(xy(v->point()));
    validity_.add(Fault_kind::structure, turned == 0 ? "a vertex doesn't know its face" : "a vertex has several stars",
                  point);
  }

  /// Connected, without boundary and with Euler's number 2.
  void check_sphere()
  {
    std::size_t reached = 0;
    if (number_of_faces_ + 4 != 2 * number_of_vertices_)
      validity_.add(Fault_kind::structure, "the numbers of vertices and faces aren't those of a planar triangulation");
    std::vector<Face_handle> stack(1, cdt_.infinite_face());
    is_face_[stack[0]] = false; // from here on: not reached yet
    while (!stack.empty()) {
      const Face_handle f = stack.back();
      stack.pop_back();
      ++reached;
      for (int i = 0; i < 3; ++i) {
        if (!is_face_[f->neighbor(i)]) continue;
        is_face_[f->neighbor(i)] = false;
        stack.push_back(f->neighbor(i));
      }
    }
    if (reached != number_of_faces_)
      validity_.add(Fault_kind::structure, "the triangulation falls into several pieces");
  }

  const Cdt& cdt_;
  Validity_2 validity_;
  std::size_t number_of_vertices_ = 0, number_of_faces_ = 0; // with the one at infinity and those around it
  CGAL::Unique_hash_map<Vertex_handle, int> faces_at_{0};
  CGAL::Unique_hash_map<Face_handle, bool> is_face_{false};
};

/// The hull must turn left or go straight on at every vertex. Locally, one that winds around twice does so, too; but it
/// has two lexicographically smallest vertices.
template <class Cdt>
void check_hull(const Cdt& cdt, Validity_2& validity)
{
  std::size_t local_minima = 0;
  auto face = cdt.incident_faces(cdt.infinite_vertex());
  const auto done = face;
  do {
    // Counterclockwise along the hull: before, here, after.
    const int i = face->index(cdt.infinite_vertex());
    const auto next = face->neighbor(Cdt::cw(i));
    const auto &before = face->vertex(Cdt::cw(i))->point(), &here = face->vertex(Cdt::ccw(i))->point(),
               &after = next->vertex(Cdt::ccw(next->index(cdt.infinite_vertex())))->point();
    const auto turn = cdt.geom_traits().orientation_2_object()(before, here, after);
    const auto from = compare_xy(cdt, before, here), to = compare_xy(cdt, here, after);
    if (turn == CGAL::RIGHT_TURN || (turn == CGAL::COLLINEAR && from != to))
      validity.add(Fault_kind::orientation, "the convex hull isn't convex", {xy(here)});
    local_minima += from == CGAL::LARGER && to == CGAL::SMALLER;
  } while (++face != done);
  if (local_minima != 1)
    validity.add(Fault_kind::orientation, "the convex hull doesn't wind around the triangulation once");
}

/// Constrained edges as chains between input points and forks, and the segments matched with them.
template <class Cdt, class K>
class Conformity_checker_2
{
public:
  using Point = typename Cdt::Point;
  using Vertex_handle = typename Cdt::Vertex_handle;

  Conformity_checker_2(const Cdt& cdt, const Pslg_2<K>& pslg) : cdt_(cdt), pslg_(pslg) {}

  Validity_2 check()
  {
    number_vertices();
    find_input_points();
    link_constrained_edges();
    find_chains();
    for (std::size_t s = 0; s < pslg_.segments.size(); ++s) match(s);
    for (const Chain& chain : chains_)
      if (!chain.used) refuse(chain.vertices, "constrained edges aren't part of any input segment");
    return validity_;
  }

private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  struct Chain
  {
    std::vector<std::size_t> vertices;
    bool used = false;
  };
  struct Chain_end // a chain as seen from one of its ends
  {
    std::size_t other_end, chain;
    bool reversed;
    bool operator<(const Chain_end& o) const
    {
      return std::tie(other_end, chain, reversed) < std::tie(o.other_end, o.chain, o.reversed);
    }
  };

  /// Vertices are numbered by coordinates, so they can be found by them.
  void number_vertices()
  {
    for (const Vertex_handle v : cdt_.finite_vertex_handles()) vertices_.push_back(v);
    std::sort(vertices_.begin(), vertices_.end(), [this](Vertex_handle v, Vertex_handle w) {
      return compare_xy(cdt_, v->point(), w->point()) == CGAL::SMALLER;
    });
    number_.clear(none);
    for (std::size_t i = 0; i < vertices_.size(); ++i) number_[vertices_[i]] = i;
    neighbors_.resize(vertices_.size());
    is_junction_.resize(vertices_.size(), 0);
    ends_at_.resize(vertices_.size());
  }

  void find_input_points()
  {
    for (std::size_t i = 0; i < pslg_.points.size(); ++i) {
      const Point& p = pslg_.points[i];
      const auto place =
          std::lower_bound(vertices_.begin(), vertices_.end(), p, [this](Vertex_handle v, const Point& q) {
            return compare_xy(cdt_, v->point(), q) == CGAL::SMALLER;
          });
      const bool found = place != vertices_.end() && compare_xy(cdt_, (*place)->point(), p) == CGAL::EQUAL;
      vertex_of_.push_back(found ? static_cast<std::size_t>(place - vertices_.begin()) : none);
      if (found)
        is_junction_[vertex_of_.back()] = 1;
      else
        validity_.add(Fault_kind::conformity, "input point " + std::to_string(i) + " isn't a vertex", {xy(p)});
    }
  }

  void link_constrained_edges()
  {
    for (auto edge = cdt_.constrained_edges_begin(); edge != cdt_.constrained_edges_end(); ++edge) {
      const std::size_t a = number_[edge->first->vertex(Cdt::ccw(edge->second))],
                        b = number_[edge->first->vertex(Cdt::cw(edge->second))];
      neighbors_[a].push_back(b);
      neighbors_[b].push_back(a);
    }
    for (std::size_t v = 0; v < neighbors_.size(); ++v)
      if (neighbors_[v].size() != 2) is_junction_[v] = 1;
  }

  void find_chains()
  {
    std::vector<char> reached(vertices_.size(), 0);
    for (std::size_t v = 0; v < vertices_.size(); ++v)
      if (is_junction_[v])
        for (const std::size_t w : neighbors_[v]) add_chain(v, w, reached);
    // What is left are closed loops without an input point. Their smallest vertex stands for a junction.
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      if (is_junction_[v] || reached[v]) continue;
      is_junction_[v] = 1;
      for (const std::size_t w : neighbors_[v]) add_chain(v, w, reached);
    }
    for (auto& list : ends_at_) std::sort(list.begin(), list.end());
  }

  /// Adds the chain that starts with the edge from v to w, unless it is the other end's turn to do so.
  void add_chain(std::size_t v, std::size_t w, std::vector<char>& reached)
  {
    std::vector<std::size_t> chain = {v, w};
    while (!is_junction_[chain.back()]) {
      const std::size_t here = chain.back(), before = chain[chain.size() - 2];
      reached[here] = 1;
      chain.push_back(neighbors_[here][neighbors_[here][0] == before ? 1 : 0]);
    }
    const std::size_t last = chain.back(), before_last = chain[chain.size() - 2];
    if (std::pair(last, before_last) < std::pair(v, w)) return;
    ends_at_[v].push_back({last, chains_.size(), false});
    ends_at_[last].push_back({v, chains_.size(), true});
    chains_.push_back({std::move(chain)});
  }

  /// Follows an input segment from chain to chain. More than one is needed only where it passes through other input
  /// points or was split.
  void match(std::size_t s)
  {
    const std::string name = "input segment " + std::to_string(s);
    for (const std::size_t end : pslg_.segments[s])
      if (end >= vertex_of_.size()) {
        validity_.add(Fault_kind::conformity, name + " refers to a point that doesn't exist");
        return;
      }
    const std::size_t source = vertex_of_[pslg_.segments[s][0]], target = vertex_of_[pslg_.segments[s][1]];
    if (source == none || target == none) return; // has been said
    const Segment segment(*this, source, target);
    for (std::size_t here = source; here != target;) {
      const Chain_end* next = next_chain(segment, here);
      if (next == nullptr) {
        explain(segment, here, name);
        return;
      }
      chains_[next->chain].used = true;
      here = next->other_end;
    }
  }

  /// A segment between two vertices with all that is needed to see whether others lie on it.
  struct Segment
  {
    Segment(const Conformity_checker_2& checker, std::size_t source_, std::size_t target_)
        : source(source_),
          target(target_),
          a(checker.point(source_)),
          b(checker.point(target_)),
          origin(xy(a)),
          allowed(ulps_of((std::max)(largest_coordinate(a), largest_coordinate(b)), most_ulps_off_segment))
    {
      const Xy_2 end = xy(b);
      const double length = edge_length(end[0] - origin[0], end[1] - origin[1]);
      direction = {(end[0] - origin[0]) / length, (end[1] - origin[1]) / length};
    }

    bool is_near(const Point& p) const
    {
      const Xy_2 q = xy(p);
      return std::abs(direction[0] * (q[1] - origin[1]) - direction[1] * (q[0] - origin[0])) <= allowed;
    }
    /// Whether q comes after p in the direction of the segment; exact.
    bool in_order(const Point& p, const Point& q) const { return typename K::Angle_2()(p, q, a, b) == CGAL::ACUTE; }

    std::size_t source, target;
    const Point &a, &b;
    Xy_2 origin, direction;
    double allowed;
  };

  const Point& point(std::size_t v) const { return vertices_[v]->point(); }

  /// First vertex of a chain, entered from `here`, that lies off the segment, out of order or beyond its end, or
  /// `none`.
  std::size_t first_off(const Segment& segment, const Chain_end& end) const
  {
    const auto& chain = chains_[end.chain].vertices;
    for (std::size_t k = 1; k < chain.size(); ++k) {
      const std::size_t before = chain[end.reversed ? chain.size() - k : k - 1],
                        here = chain[end.reversed ? chain.size() - 1 - k : k];
      if (!segment.is_near(point(here)) || !segment.in_order(point(before), point(here)) ||
          (here != segment.target && !segment.in_order(point(here), segment.b)))
        return here;
    }
    return none;
  }

  /// A chain from `here` that runs along the segment: one to its end if there is one, else one to a vertex exactly on
  /// it, else any.
  const Chain_end* next_chain(const Segment& segment, std::size_t here) const
  {
    const auto& list = ends_at_[here];
    const auto is_before = [](const Chain_end& end, std::size_t v) { return end.other_end < v; };
    auto end = std::lower_bound(list.begin(), list.end(), segment.target, is_before);
    for (; end != list.end() && end->other_end == segment.target; ++end)
      if (first_off(segment, *end) == none) return &*end;
    const Chain_end* best = nullptr;
    for (const Chain_end& candidate : list) {
      if (first_off(segment, candidate) != none) continue;
      if (cdt_.geom_traits().orientation_2_object()(segment.a, segment.b, point(candidate.other_end)) ==
          CGAL::COLLINEAR)
        return &candidate;
      if (best == nullptr) best = &candidate;
    }
    return best;
  }

  /// Says why a segment can't be followed beyond a vertex.
  void explain(const Segment& segment, std::size_t here, const std::string& name)
  {
    for (const Chain_end& end : ends_at_[here]) {
      if (end.other_end != segment.target || chains_[end.chain].used) continue;
      chains_[end.chain].used = true;
      validity_.add(Fault_kind::conformity, name + " has a vertex off its line or out of order",
                    {xy(point(first_off(segment, end)))});
      return;
    }
    validity_.add(Fault_kind::conformity, name + " isn't covered by constrained edges: it breaks off",
                  {xy(point(here))});
  }

  void refuse(const std::vector<std::size_t>& chain, const std::string& what)
  {
    validity_.add(Fault_kind::conformity, what, {xy(point(chain.front())), xy(point(chain[1]))});
  }

  const Cdt& cdt_;
  const Pslg_2<K>& pslg_;
  Validity_2 validity_;
  std::vector<Vertex_handle> vertices_;
  CGAL::Unique_hash_map<Vertex_handle, std::size_t> number_;
  std::vector<std::size_t> vertex_of_; // per input point
  std::vector<std::vector<std::size_t>> neighbors_;
  std::vector<char> is_junction_;
  std::vector<Chain> chains_;
  std::vector<std::vector<Chain_end>> ends_at_;
};

/// Faults of faces whose flag isn't that of their region.
template <class Cdt>
Validity_2 compare_flags(const Cdt& cdt, const Face_components<Cdt>& components, const std::vector<char>& in_domain)
{
  Validity_2 validity;
  for (const auto face : cdt.all_face_handles()) {
    const bool wanted = in_domain[components.number[face]];
    if (face->is_in_domain() != wanted)
      validity.add(Fault_kind::domain, wanted ? "a face isn't in the domain" : "a face is wrongly in the domain",
                   corners(cdt, face));
  }
  return validity;
}

template <class Cdt>
Validity_2 check_parity(const Cdt& cdt)
{
  const auto components = face_components(cdt);
  std::vector<char> in_domain;
  for (const int level : nesting_levels(cdt, components)) in_domain.push_back(level % 2 == 1);
  return compare_flags(cdt, components, in_domain);
}

template <class Cdt, class Points>
Validity_2 check_holes(const Cdt& cdt, const Points& holes)
{
  const auto components = face_components(cdt);
  std::vector<char> in_domain(components.count, 1);
  for (const auto& p : holes) in_domain[components.number[cdt.locate(p)]] = 0;
  in_domain[0] = 0;
  return compare_flags(cdt, components, in_domain);
}

struct Area
{
  double value, rounding; ///< in units of 4^exponent
};

/// Area of the domain, and a bound of its rounding error.
template <class Cdt>
Area domain_area(const Cdt& cdt, int exponent)
{
  Compensated_sum area, products;
  for (const auto face : cdt.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    const Scaled_triangle_2 triangle(face);
    const double longest = triangle.longest();
    area.add(std::ldexp(triangle.twice_area, 2 * (triangle.exponent - exponent) - 1));
    products.add(std::ldexp(longest * longest, 2 * (triangle.exponent - exponent)));
  }
  return {area.value(), ulps_of(products.value(), 4)};
}

/// Compares the area of the domain with that of the graph's own triangulation. Vertices on segments are rounded, so the
/// areas may differ by a strip along each segment.
template <class Cdt, class K>
void check_area(const Cdt& cdt, const Pslg_2<K>& pslg, Validity_2& validity)
{
  Mesh_triangulation_2<K> input;
  try {
    insert_pslg(input, pslg, {Crossings::split});
    mark_domain(input, pslg);
  } catch (const Domain_error& error) {
    validity.add(Fault_kind::domain, std::string("the input has no domain: ") + error.what());
    return;
  }
  double largest = 0;
  for (const auto& p : pslg.points) largest = (std::max)(largest, largest_coordinate(p));
  int exponent = 0;
  std::frexp(largest, &exponent);
  Compensated_sum length;
  for (const auto& [a, b] : pslg.segments) {
    const Xy_2 p = xy(pslg.points[a]), q = xy(pslg.points[b]);
    length.add(std::ldexp(edge_length(q[0] - p[0], q[1] - p[1]), -exponent));
  }
  const Area wanted = domain_area(input, exponent), found = domain_area(cdt, exponent);
  const double strip = 2 * ulps_of(length.value(), most_ulps_off_segment);
  if (std::abs(wanted.value - found.value) <= wanted.rounding + found.rounding + strip) return;
  std::ostringstream what;
  what.precision(std::numeric_limits<double>::max_digits10);
  what << "the area of the domain is " << std::ldexp(found.value, 2 * exponent) << ", that of the input "
       << std::ldexp(wanted.value, 2 * exponent);
  validity.add(Fault_kind::domain, what.str());
}

} // namespace internal

/// Checks that the triangulation is one of the sphere, with every vertex, face and neighbor knowing each other. Exact,
/// linear time.
template <class Cdt>
Validity_2 check_structure_2(const Cdt& cdt)
{
  return internal::Structure_checker_2<Cdt>(cdt).check();
}

/// Checks that all finite faces are counterclockwise, and that the hull is convex and winds around them once; so no two
/// faces overlap. Exact, linear time. The structure must be sound.
template <class Cdt>
Validity_2 check_orientation_2(const Cdt& cdt)
{
  Validity_2 validity;
  const auto orientation = cdt.geom_traits().orientation_2_object();
  for (const auto face : cdt.finite_face_handles())
    if (orientation(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point()) != CGAL::LEFT_TURN)
      validity.add(Fault_kind::orientation, "a face is turned over or flat", internal::corners(cdt, face));
  internal::check_hull(cdt, validity);
  return validity;
}

/// Checks that no unconstrained edge has the corner across it inside of the circle through a face beside it. Exact,
/// linear time. Structure and orientation must be sound.
template <class Cdt>
Validity_2 check_delaunay_2(const Cdt& cdt)
{
  Validity_2 validity;
  const auto side = cdt.geom_traits().side_of_oriented_circle_2_object();
  for (auto edge = cdt.finite_edges_begin(); edge != cdt.finite_edges_end(); ++edge) {
    const auto face = edge->first, neighbor = face->neighbor(edge->second);
    if (face->is_constrained(edge->second) || cdt.is_infinite(face) || cdt.is_infinite(neighbor)) continue;
    const auto& across = neighbor->vertex(neighbor->index(face))->point();
    if (side(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point(), across) ==
        CGAL::ON_POSITIVE_SIDE)
      validity.add(Fault_kind::delaunay, "an edge isn't locally Delaunay", internal::ends(cdt, face, edge->second));
  }
  return validity;
}

/// Checks that every input point is a vertex with exactly its coordinates, that every input segment is a chain of
/// constrained edges from end to end, and that there are no other constrained edges. Vertices within a chain must lie
/// within 8 units in the last place of the segment's largest coordinate from its line, for they are rounded, and in
/// order along it, which is exact. Segments may pass through input points, and crossing ones may have been split.
/// O(n log n) time, and per segment that passes through other points the number of constraints there more. The
/// structure must be sound.
template <class Cdt, class K>
Validity_2 check_conformity_2(const Cdt& cdt, const Pslg_2<K>& pslg)
{
  return internal::Conformity_checker_2<Cdt, K>(cdt, pslg).check();
}

/// Checks that the faces in the domain are those that nesting parity puts there, see mark_domain.h. Exact, linear time.
/// The structure must be sound.
template <class Cdt>
Validity_2 check_domain_2(const Cdt& cdt)
{
  return internal::check_parity(cdt);
}

/// Checks that the faces in the domain are those that the graph describes, by its holes if it has any, else by nesting
/// parity; and that their area is that of the graph's own triangulation, up to the rounding of vertices on segments.
/// O(n log n) time. Structure and orientation must be sound.
template <class Cdt, class K>
Validity_2 check_domain_2(const Cdt& cdt, const Pslg_2<K>& pslg)
{
  Validity_2 validity;
  internal::check_area(cdt, pslg, validity);
  validity += pslg.holes.empty() ? internal::check_parity(cdt) : internal::check_holes(cdt, pslg.holes);
  return validity;
}

/// Checks that no sizing ratio of a triangle in the domain or of a constrained edge beside it, as in Sizing_quality_2,
/// exceeds a bound. Linear time.
/// \param sizing callable, point -> target edge length in the input's units.
/// \throws Option_error if the field returns anything but a positive finite number.
template <class Cdt, class Sizing>
Validity_2 check_sizing_2(const Cdt& cdt, const Sizing& sizing, double bound = 1)
{
  Validity_2 validity;
  const auto judge = [&](double ratio, const char* what, const auto& points) {
    if (!(ratio <= bound)) // so that NaN is a fault
      validity.add(Fault_kind::sizing, what + (" has sizing ratio " + std::to_string(ratio)), points());
  };
  for (const auto face : cdt.finite_face_handles())
    if (face->is_in_domain())
      judge(internal::sizing_ratio<typename Cdt::Point>(internal::Scaled_triangle_2(face), sizing), "a triangle",
            [&] { return internal::corners(cdt, face); });
  internal::for_each_constrained_edge(cdt, [&](auto face, int i) {
    judge(internal::sizing_ratio<Cdt>(face, i, sizing), "a constrained edge",
          [&] { return internal::ends(cdt, face, i); });
  });
  return validity;
}

/// Checks structure, orientation and Delaunay property. What needs a sound structure or orientation is left out where
/// that isn't found. Linear time.
template <class Cdt>
Validity_2 validate_2(const Cdt& cdt)
{
  Validity_2 validity = check_structure_2(cdt);
  if (!validity.ok()) return validity;
  validity += check_orientation_2(cdt);
  validity += check_delaunay_2(cdt);
  return validity;
}

/// Checks structure, orientation, Delaunay property, conformity and domain; O(n log n) time. The domain must have been
/// marked by mark_domain(), or in another way that comes to the same. What needs a sound structure or orientation is
/// left out where that isn't found.
template <class Cdt, class K>
Validity_2 validate_2(const Cdt& cdt, const Pslg_2<K>& pslg)
{
  Validity_2 validity = validate_2(cdt);
  if (validity.count(Fault_kind::structure) > 0) return validity;
  validity += check_conformity_2(cdt, pslg);
  if (validity.count(Fault_kind::orientation) == 0) validity += check_domain_2(cdt, pslg);
  return validity;
}

/// Checks everything: the above, and that the mesh keeps to a sizing field.
/// \throws Option_error if the field returns anything but a positive finite number.
template <class Cdt, class K, class Sizing>
Validity_2 validate_2(const Cdt& cdt, const Pslg_2<K>& pslg, const Sizing& sizing)
{
  Validity_2 validity = validate_2(cdt, pslg);
  if (validity.count(Fault_kind::structure) == 0) validity += check_sizing_2(cdt, sizing);
  return validity;
}

} // namespace weft

#endif // WEFT_PLANAR_VALIDATE_2_H
