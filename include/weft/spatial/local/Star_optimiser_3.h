// SPDX-License-Identifier: GPL-3.0-or-later
//
// Optimisation-based smoothing (Freitag, Ollivier-Gooch, "Tetrahedral mesh improvement using swapping and smoothing",
// 1997): moves one vertex to where the worst cell of its star is best. The objective is a minimum of smooth functions;
// the step goes along the shortest vector in the convex hull of the gradients of the worst ones.

#ifndef WEFT_SPATIAL_LOCAL_STAR_OPTIMISER_3_H
#define WEFT_SPATIAL_LOCAL_STAR_OPTIMISER_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// How good a cell is: 1 - the cosine of its smallest dihedral angle, in (0, 0.67]; of an inverted or flat one its
/// volume in parts of the cube of its mean edge length, not above 0. Raising the least of these turns cells over first
/// and raises angles then. The orientation is exact.
template <class Point>
double cell_quality_3(const Point& a, const Point& b, const Point& c, const Point& d)
{
  if (CGAL::orientation(a, b, c, d) == CGAL::POSITIVE)
    return (std::max)(1 - cosine_of_smallest_dihedral(a, b, c, d), 1e-15); // angles that rounding takes for 0
  const Xyz_3 u = minus(xyz(b), xyz(a)), v = minus(xyz(c), xyz(a)), w = minus(xyz(d), xyz(a));
  const Xyz_3 vu = minus(v, u), wu = minus(w, u), wv = minus(w, v);
  const double squares = dot_product(u, u) + dot_product(v, v) + dot_product(w, w) + dot_product(vu, vu) +
                         dot_product(wu, wu) + dot_product(wv, wv);
  const double mean = std::sqrt(squares / 6);
  return (std::min)(0.0, dot_product(cross_product(u, v), w) / (6 * mean * mean * mean));
}

/// The same of vertices of a mesh.
template <class Mesh>
double cell_quality_3(const Mesh& mesh, const typename Mesh::Cell_vertices& v)
{
  return cell_quality_3(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
}

/// The quality of a cell whose smallest dihedral angle is that many degrees.
inline double quality_of_angle_3(double degrees)
{
  return 1 - std::cos(degrees * 3.14159265358979323846 / 180);
}

/// The smallest dihedral angle of a cell of that quality, in degrees; 0 for an inverted one.
inline double angle_of_quality_3(double quality)
{
  return std::acos((std::max)(-1.0, (std::min)(1.0, 1 - quality))) * 180 / 3.14159265358979323846;
}

/// Finds a better place for the vertex that a star of facets has in common.
/// \tparam K a CGAL kernel whose coordinates are doubles.
template <class K>
class Star_optimiser_3
{
public:
  using Point = typename K::Point_3;
  using Facet = std::array<Point, 3>; ///< counterclockwise seen from outside the star

  /// The worst quality of the cells that p makes with the facets.
  static double quality(const Point& p, const std::vector<Facet>& star)
  {
    double worst = HUGE_VAL;
    for (const Facet& f : star) worst = (std::min)(worst, quality(p, f));
    return worst;
  }

  static double quality(const Point& p, const Facet& f) { return cell_quality_3(p, f[0], f[1], f[2]); }

  /// Moves p to a place that isn't worse, and returns the worst quality there.
  /// \param enough goes no further once that is reached.
  double optimise(Point& p, const std::vector<Facet>& star, double enough = HUGE_VAL)
  {
    const double size = shortest_edge(p, star);
    double best = quality(p, star), step = 0.25 * size;
    for (int round = 0; round < most_rounds && best < enough; ++round) {
      collect_gradients(p, star, best, 1e-6 * size);
      const Vector direction = shortest_in_hull();
      const double length = norm(direction);
      if (!(length * size > 1e-7)) break;
      double gain = 0;
      Point place = p;
      for (int halving = 0; halving < most_halvings; ++halving, step /= 2) {
        const Point q = moved(p, direction, step / length);
        const double found = quality(q, star, best + gain);
        if (found > best + gain) {
          gain = found - best;
          place = q;
        } else if (gain > 0) {
          break; // it gets worse again
        }
      }
      if (!(gain > 1e-7)) break;
      p = place;
      best += gain;
      step = (std::min)(4 * step, 0.5 * size);
    }
    return best;
  }

private:
  using Vector = Xyz_3;

  static constexpr int most_rounds = 12, most_halvings = 10;
  static constexpr std::size_t most_gradients = 12;

  /// The same, but anything below `least` will do.
  static double quality(const Point& p, const std::vector<Facet>& star, double least)
  {
    double worst = HUGE_VAL;
    for (const Facet& f : star) {
      worst = (std::min)(worst, quality(p, f));
      if (worst <= least) break;
    }
    return worst;
  }

  static double shortest_edge(const Point& p, const std::vector<Facet>& star)
  {
    double shortest = HUGE_VAL;
    for (const Facet& f : star)
      for (const Point& q : f) shortest = (std::min)(shortest, CGAL::to_double(CGAL::squared_distance(p, q)));
    double side = HUGE_VAL; // p may be anywhere, even at another vertex
    for (const Facet& f : star) side = (std::min)(side, CGAL::to_double(CGAL::squared_distance(f[0], f[1])));
    return std::sqrt((std::max)(shortest, 0.01 * side));
  }

  static Point moved(const Point& p, const Vector& direction, double factor)
  {
    return Point(p.x() + factor * direction[0], p.y() + factor * direction[1], p.z() + factor * direction[2]);
  }

  /// By differences, of the cells that are about as bad as the worst.
  void collect_gradients(const Point& p, const std::vector<Facet>& star, double worst, double h)
  {
    active_.clear();
    const double bound = worst + 0.05 * std::abs(worst) + 1e-4;
    for (const Facet& f : star) {
      const double q = quality(p, f);
      if (q <= bound) active_.push_back({q, &f});
    }
    std::sort(active_.begin(), active_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    if (active_.size() > most_gradients) active_.resize(most_gradients);
    gradients_.clear();
    for (const auto& [q, f] : active_) {
      Vector g{};
      for (std::size_t k = 0; k < 3; ++k) {
        Vector unit{};
        unit[k] = 1;
        g[k] = (quality(moved(p, unit, h), *f) - quality(moved(p, unit, -h), *f)) / (2 * h);
      }
      gradients_.push_back(g);
    }
  }

  /// Nearest point of the gradients' convex hull to the origin, by Gilbert's algorithm.
  Vector shortest_in_hull() const
  {
    Vector x = gradients_.front();
    for (int i = 0; i < 30; ++i) {
      const Vector* lowest = &gradients_.front();
      for (const Vector& g : gradients_)
        if (dot_product(g, x) < dot_product(*lowest, x)) lowest = &g;
      const Vector d = minus(*lowest, x);
      const double square = dot_product(d, d), along = -dot_product(x, d);
      if (!(along > 1e-6 * dot_product(x, x))) break;
      const double t = (std::min)(1.0, along / square);
      for (std::size_t k = 0; k < 3; ++k) x[k] += t * d[k];
    }
    return x;
  }

  std::vector<std::pair<double, const Facet*>> active_;
  std::vector<Vector> gradients_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_LOCAL_STAR_OPTIMISER_3_H
