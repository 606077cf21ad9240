// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the boundary of a mesh and the surface are from each other, element by element. The approximation criterion
// is about one point of a facet or crease edge, and alone lets that distance drift away while vertices move.

#ifndef WEFT_SPATIAL_CRITERIA_DEVIATION_3_H
#define WEFT_SPATIAL_CRITERIA_DEVIATION_3_H

#include <weft/internal/boxes/nearest_point_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <utility>
#include <vector>

namespace weft::internal {

/// Squared distances between a facet and the surface.
struct Squared_deviation_3
{
  double depth = 0;  ///< from the facet to the surface
  double height = 0; ///< from salient points of the surface to the boundary of the mesh

  void raise_to(const Squared_deviation_3& other)
  {
    depth = (std::max)(depth, other.depth);
    height = (std::max)(height, other.height);
  }
};

/// Measures boundary facets and crease edges against the surface.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Deviation_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Cell_handle = typename Restricted::Cell_handle;
  using Facet = typename Restricted::Restricted_facet;
  using Crease_edge = typename Restricted::Crease_edge;

  /// \param mesh has to live as long as this object.
  explicit Deviation_3(const Restricted& mesh) : mesh_(&mesh) {}

  Squared_deviation_3 of(const Facet& f) const { return {depth(f), height(f, 0, new_era())}; }

  /// The same but 0 where they aren't beyond a bound, which is much cheaper to tell.
  /// \param era see `new_era()`.
  Squared_deviation_3 beyond(const Squared_deviation_3& bound, const Facet& f, std::uint64_t era) const
  {
    return {depth_beyond(bound.depth, f), height_beyond(bound.height, f, era)};
  }
  double depth_beyond(double bound, const Facet& f) const
  {
    const bool is_deep = !for_each_sample(f, [&](const Point& p) { return mesh_->oracle().is_within(p, bound); });
    return is_deep ? depth(f) : 0;
  }
  double height_beyond(double bound, const Facet& f, std::uint64_t era) const { return height(f, bound, era); }

  /// A number that there was never before. What is found about salient points is known for later facets that come with
  /// the same number, which one thread asks for, one after the other, while the mesh stays as it is.
  static std::uint64_t new_era()
  {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
  }

  /// Squared distance of the farthest corner of a crease from the edge that stands for it there: those corners to both
  /// sides of its Steiner point whose projections lie between the ends of the edge.
  double of(const Crease_edge& e) const
  {
    const auto& points = mesh_->creases().points(static_cast<std::size_t>(e.steiner_crease));
    const auto& a = e.source->point();
    const auto ab = e.target->point() - a;
    const double length = CGAL::to_double(ab.squared_length());
    double farthest = 0;
    const auto visit = [&](std::size_t i) {
      const auto ap = points[i] - a;
      const double t = CGAL::to_double(ap * ab) / length;
      if (!(t > 0 && t < 1)) return false;
      farthest = (std::max)(farthest, CGAL::to_double((ap - t * ab).squared_length()));
      return true;
    };
    const auto middle = static_cast<std::size_t>(e.position);
    for (std::size_t i = middle + 1; i < points.size() && visit(i);) ++i;
    for (std::size_t i = middle + 1; i-- > 0 && visit(i);) {
    }
    return farthest;
  }

private:
  /// Calls `visit(point)` for a few points of a facet until it returns false; whether it never did.
  template <class Visit>
  static bool for_each_sample(const Facet& f, const Visit& visit)
  {
    const Point& a = corner(f, 1);
    const auto ab = corner(f, 2) - a, ac = corner(f, 3) - a;
    for (const auto& [s, t] : samples)
      if (!visit(a + s * ab + t * ac)) return false;
    return true;
  }

  /// Of these points, the farthest from the surface.
  double depth(const Facet& f) const
  {
    double deepest = 0;
    for_each_sample(f, [&](const Point& p) {
      deepest = (std::max)(deepest, CGAL::to_double(CGAL::squared_distance(p, mesh_->oracle().closest(p).point)));
      return true;
    });
    return deepest;
  }

  /// The other way round: of the salient points of the surface near the facet and of some points of its ridges, the
  /// farthest from the facet and from those around it; 0 if that isn't beyond the bound. With ends of attracting folds
  /// alone, whole runs raise the distance unseen.
  double height(const Facet& f, double bound, std::uint64_t era) const
  {
    double highest = bound;
    const Measured_triangle_3 triangle = measured(f);
    thread_local std::vector<Measured_triangle_3> around;
    around.clear();
    const auto look = [&](const Point& p) {
      Near_point& known = what_is_known(p, era);
      if (known.bound <= highest) return;
      if (const double own = triangle.squared_distance(xyz(p)); own > highest) {
        if (around.empty())
          for (int i = 1; i <= 3; ++i) list_star(f.cell->vertex((f.index + i) & 3), around);
        const double distance =
            is_within(p, highest, around) ? 0 : squared_distance_from_around(p, highest, own, f.cell, known);
        if (distance > highest) {
          highest = distance;
          return;
        }
      }
      known.bound = highest;
    };
    const double squared_reach = 1.2 * 1.2 * f.squared_radius; // tips stick out of surface Delaunay balls
    mesh_->oracle().visit_salient_points(f.steiner, squared_reach, f.patch, [&](const Point& p, bool) { look(p); });
    mesh_->oracle().visit_ridges(f.steiner, squared_reach, f.patch, [&](const Point& p, const Point& q, bool) {
      // The distance from a facet is convex along a segment.
      if (triangle.squared_distance(xyz(p)) <= highest && triangle.squared_distance(xyz(q)) <= highest) return;
      for (const double t : along_ridges) {
        const Point r = p + t * (q - p);
        if (CGAL::squared_distance(r, f.steiner) < squared_reach) look(r);
      }
    });
    return highest > bound ? highest : 0;
  }

  // ---- what is known of salient points

  /// The facets around look at the same points: to find a near facet once is enough, as long as the mesh stays, and so
  /// is to have looked all around in vain.
  struct Near_point
  {
    Point point;
    std::uint64_t era = 0;
    double bound;  ///< squared, within which a facet was found; else infinite
    double around; ///< squared distance from all facets around; negative unless measured
  };

  /// Of a point: what was found in this era.
  static Near_point& what_is_known(const Point& p, std::uint64_t era)
  {
    thread_local std::vector<Near_point> all(std::size_t(1) << known_bits); // by a hash of the point
    Near_point& known = all[slot(p)];
    if (known.era != era || known.point != p) known = {p, era, HUGE_VAL, -1};
    return known;
  }

  static std::size_t slot(const Point& p)
  {
    std::uint64_t hash = 0;
    for (const double x : xyz(p)) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &x, sizeof bits);
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
    }
    return static_cast<std::size_t>(hash >> (64 - known_bits));
  }

  static const Point& corner(const Facet& f, int i) { return f.cell->vertex((f.index + i) & 3)->point(); }

  static Measured_triangle_3 measured(const Facet& f)
  {
    return {xyz(corner(f, 1)), xyz(corner(f, 2)), xyz(corner(f, 3))};
  }

  void list_star(Vertex_handle v, std::vector<Measured_triangle_3>& facets) const
  {
    mesh_->visit_facets_at(v, [&facets](const Facet& f) { facets.push_back(measured(f)); });
  }

  /// Whether one of some facets is within a bound; that one comes first from then on, as the next point is near to p.
  static bool is_within(const Point& p, double bound, std::vector<Measured_triangle_3>& facets)
  {
    const Xyz_3 x = xyz(p);
    const auto found = std::find_if(facets.begin(), facets.end(),
                                    [&](const Measured_triangle_3& f) { return f.squared_distance(x) <= bound; });
    if (found == facets.end()) return false;
    std::swap(*found, facets.front());
    return true;
  }

  /// From a facet, those at the vertices of the cell around p and at those beside the vertex nearest to it; 0 if that
  /// isn't beyond a bound. With only those beside the facet, points on the other side of a thin sheet seem to be far
  /// from a mesh of it, and hide what gets farther than any was before.
  /// \param own squared distance from the facet.
  /// \param near where to look from.
  double squared_distance_from_around(const Point& p, double bound, double own, Cell_handle near,
                                      Near_point& known) const
  {
    if (known.around < 0) {
      const double around = squared_distance_from_around(p, bound, near);
      if (around <= bound) return 0;
      known.around = around;
    }
    const double distance = (std::min)(known.around, own);
    return distance > bound ? distance : 0;
  }

  /// The same without the facet; if that is within the bound, some facet's that is.
  double squared_distance_from_around(const Point& p, double bound, Cell_handle near) const
  {
    const auto& tr = mesh_->triangulation();
    thread_local std::vector<Vertex_handle> vertices;
    const Xyz_3 x = xyz(p);
    double nearest = HUGE_VAL;
    const auto look = [&](Vertex_handle v) {
      mesh_->visit_facets_at(v,
                             [&](const Facet& g) { nearest = (std::min)(nearest, measured(g).squared_distance(x)); });
      return nearest <= bound;
    };
    const Cell_handle c = tr.locate(p, near);
    const auto squared = [&](int i) { return CGAL::to_double(CGAL::squared_distance(p, c->vertex(i)->point())); };
    int first = 0;
    for (int i = 1; i < 4; ++i)
      if (squared(i) < squared(first)) first = i;
    for (int i = 0; i < 4; ++i)
      if (look(c->vertex((first + i) & 3))) return nearest;
    const Vertex_handle v = nearest_vertex(p, c->vertex(first), vertices);
    if (!c->has_vertex(v) && look(v)) return nearest;
    for (const Vertex_handle w : vertices)
      if (!c->has_vertex(w) && look(w)) return nearest;
    return nearest;
  }

  /// The vertex nearest to a point, looked for from another, and its neighbours. CGAL's leaves marks in cells, which
  /// other threads would see.
  Vertex_handle nearest_vertex(const Point& p, Vertex_handle v, std::vector<Vertex_handle>& neighbours) const
  {
    const auto& tr = mesh_->triangulation();
    double least = CGAL::to_double(CGAL::squared_distance(p, v->point()));
    for (;;) {
      neighbours.clear();
      tr.adjacent_vertices_threadsafe(v, std::back_inserter(neighbours));
      neighbours.erase(std::remove(neighbours.begin(), neighbours.end(), tr.infinite_vertex()), neighbours.end());
      Vertex_handle nearer = v;
      for (const Vertex_handle w : neighbours)
        if (const double d = CGAL::to_double(CGAL::squared_distance(p, w->point())); d < least) least = d, nearer = w;
      if (nearer == v) return v;
      v = nearer;
    }
  }

  /// Barycentric coordinates. Fewer samples let smoothing raise the distance unseen.
  static constexpr double samples[][2] = {
      {1. / 3, 1. / 3}, {.6, .2},   {.2, .6},   {.2, .2},   {.44, .12},   {.12, .44},  {.44, .44}, {0.5, 0},
      {0.3, 0},         {0.7, 0},   {0.12, 0},  {0.88, 0},  {0, 0.5},     {0, 0.3},    {0, 0.7},   {0, 0.12},
      {0, 0.88},        {0.5, 0.5}, {0.3, 0.7}, {0.7, 0.3}, {0.12, 0.88}, {0.88, 0.12}};

  static constexpr double along_ridges[] = {1. / 6, 1. / 3, 1. / 2, 2. / 3, 5. / 6};

  const Restricted* mesh_;
  static constexpr unsigned known_bits = 13;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_DEVIATION_3_H
