// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good a spatial mesh is: dihedral angles, shapes of cells and boundary facets, edges, volume and area (Tournois
// 2009, sec. 1.3.1.2 and 3.2.1.2). The radius-edge ratio of a cell is its circumradius over its shortest edge,
// sqrt(6)/4 at best; slivers hide from it, but not from the radius ratio, 3 inradius / circumradius, 1 at best.
//
// All measures are rounded. Angles come from the volume and the normals together, so that those of flat cells are 0 or
// 180 degrees to rounding and never NaN. Cells are measured in units of a power of two of about their size, so
// that no product over- or underflows.

#ifndef WEFT_SPATIAL_MESH_QUALITY_3_H
#define WEFT_SPATIAL_MESH_QUALITY_3_H

#include <weft/errors.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/parallel_for.h>
#include <weft/spatial/mesh/circumcenter_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace weft {

/// An angle and the element that has it.
struct Angle_extreme_3
{
  double degrees = std::numeric_limits<double>::quiet_NaN();
  std::size_t element = 0;               ///< index of the cell, or of the boundary facet
  std::array<std::size_t, 2> vertices{}; ///< ends of the edge of a dihedral angle; the apex, twice, of a facet's angle
};

/// Shape of the elements of a mesh. Lengths are in the input's units. Of no elements, all but counts and sums is NaN. A
/// flat cell counts with dihedral angles of 0 and 180 degrees, radius ratio 0 and an infinite radius-edge ratio.
struct Quality_3
{
  static constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  static constexpr std::size_t bins = 180; ///< of the histograms, one degree each

  std::size_t vertices = 0, cells = 0, facets = 0;
  double volume = 0;        ///< signed: cells that are turned over count negative
  double boundary_area = 0; ///< of the boundary facets; interfaces between subdomains count once

  Angle_extreme_3 smallest_dihedral, largest_dihedral;
  double mean_smallest_dihedral = nothing;            ///< degrees; mean over cells of the smallest of the six angles
  std::array<std::size_t, bins> dihedrals{};          ///< all dihedral angles, by whole degrees
  std::array<std::size_t, bins> smallest_dihedrals{}; ///< smallest dihedral angles of the cells, by whole degrees

  double largest_radius_edge_ratio = nothing, mean_radius_edge_ratio = nothing; ///< of cells; >= 0.612
  double smallest_radius_ratio = nothing, mean_radius_ratio = nothing;          ///< of cells; in [0, 1]
  double shortest_edge = nothing, longest_edge = nothing;                       ///< of cells

  Angle_extreme_3 smallest_facet_angle, largest_facet_angle;
  double largest_facet_ratio = nothing; ///< circumradius over shortest edge of boundary facets; >= 0.577

  /// Number of cells with a dihedral angle below so many whole degrees, at most 180.
  std::size_t cells_below(std::size_t degrees) const
  {
    std::size_t count = 0;
    for (std::size_t i = 0; i < (std::min)(degrees, bins); ++i) count += smallest_dihedrals[i];
    return count;
  }

  /// The dihedral angles as a histogram for pictures.
  /// \tparam Histogram has members `counts`, `smallest`, `largest` and a constructor (name, number of bins), for
  ///   instance Angle_histogram of IO/write_angle_histogram_svg.h.
  /// \param wanted_bins number of bins, a divisor of 180.
  /// \throws Option_error if it isn't one.
  template <class Histogram>
  Histogram histogram(const std::string& name, std::size_t wanted_bins = 90) const
  {
    if (wanted_bins == 0 || bins % wanted_bins != 0)
      throw Option_error("the number of bins of an angle histogram must divide 180");
    Histogram result(name, wanted_bins);
    for (std::size_t i = 0; i < bins; ++i) result.counts[i * wanted_bins / bins] += dihedrals[i];
    if (cells == 0) return result;
    result.smallest = smallest_dihedral.degrees;
    result.largest = largest_dihedral.degrees;
    return result;
  }
};

namespace internal {

constexpr double degrees_per_radian_3 = 180 / 3.14159265358979323846;

/// Corners of a simplex relative to the first one, in units of a power of two of about its size.
template <std::size_t N>
struct Scaled_simplex_3
{
  std::array<Xyz_3, N> corner{};
  int exponent = 0; ///< lengths are to be multiplied by 2^exponent

  template <class Points>
  Scaled_simplex_3(const Points& points, const std::array<std::size_t, N>& vertices)
  {
    const Xyz_3 origin = xyz(points[vertices[0]]);
    double extent = 0;
    for (std::size_t i = 1; i < N; ++i) {
      corner[i] = minus(xyz(points[vertices[i]]), origin);
      for (const double x : corner[i]) extent = (std::max)(extent, std::abs(x));
    }
    std::frexp(extent, &exponent);
    for (std::size_t i = 1; i < N; ++i)
      for (double& x : corner[i]) x = std::ldexp(x, -exponent);
  }

  double edge(std::size_t i, std::size_t j) const { return norm(minus(corner[j], corner[i])); }
  double unscaled(double scaled, int dimension = 1) const { return std::ldexp(scaled, dimension * exponent); }
};

/// Measures of one cell; lengths in its own units.
struct Cell_measures_3
{
  /// Edge k joins the first two corners of `edges[k]`; the other two are opposite to the facets beside it.
  static constexpr std::array<std::array<std::size_t, 4>, 6> edges = {
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};

  std::array<double, 6> dihedral; ///< degrees
  double six_volumes;             ///< signed
  double shortest = std::numeric_limits<double>::max(), longest = 0;
  double circumradius, radius_ratio;

  explicit Cell_measures_3(const Scaled_simplex_3<4>& cell)
  {
    const auto& p = cell.corner;
    six_volumes = dot_product(p[1], cross_product(p[2], p[3]));
    // Facet normals of twice the area, all pointing out of a positively oriented cell.
    const std::array<Xyz_3, 4> normal = {cross_product(minus(p[2], p[1]), minus(p[3], p[1])), cross_product(p[3], p[2]),
                                         cross_product(p[1], p[3]), cross_product(p[2], p[1])};
    for (std::size_t k = 0; k < 6; ++k) {
      const auto& [i, j, a, b] = edges[k];
      const double edge = cell.edge(i, j);
      shortest = (std::min)(shortest, edge);
      longest = (std::max)(longest, edge);
      // |n_a x n_b| = 6 volume * edge. Subtracting from 0 gives +0, never -0, where a normal vanishes.
      dihedral[k] =
          degrees_per_radian_3 * std::atan2(std::abs(six_volumes) * edge, 0 - dot_product(normal[a], normal[b]));
    }
    measure_radii(p, normal);
  }

private:
  void measure_radii(const std::array<Xyz_3, 4>& p, const std::array<Xyz_3, 4>& normal)
  {
    circumradius = std::numeric_limits<double>::infinity();
    radius_ratio = 0;
    if (six_volumes == 0) return;
    const double a = dot_product(p[1], p[1]), b = dot_product(p[2], p[2]), c = dot_product(p[3], p[3]);
    Xyz_3 sum;
    for (std::size_t i = 0; i < 3; ++i) sum[i] = a * normal[1][i] + b * normal[2][i] + c * normal[3][i];
    circumradius = norm(sum) / (2 * std::abs(six_volumes));
    double twice_area = 0;
    for (const Xyz_3& n : normal) twice_area += norm(n);
    radius_ratio = (std::min)(1., 3 * std::abs(six_volumes) / twice_area / circumradius);
  }
};

/// Circumradius over shortest edge of a cell; exactly computed and then rounded where the cell is so flat that doubles
/// lose its volume.
template <class K, class Points>
double radius_edge_ratio(const Points& points, const std::array<std::size_t, 4>& vertices,
                         const Scaled_simplex_3<4>& cell, const Cell_measures_3& measures)
{
  const double longest = measures.longest;
  if (std::abs(measures.six_volumes) > 1e-9 * longest * longest * longest)
    return measures.circumradius / measures.shortest;
  const auto &a = points[vertices[0]], &b = points[vertices[1]], &c = points[vertices[2]], &d = points[vertices[3]];
  if (typename K::Orientation_3()(a, b, c, d) == CGAL::ZERO) return std::numeric_limits<double>::infinity();
  return norm(minus(xyz(exact_circumcenter_3<K>(a, b, c, d)), xyz(a))) / cell.unscaled(measures.shortest);
}

/// Measures of one triangle; lengths in its own units.
struct Facet_measures_3
{
  std::array<double, 3> angle; ///< degrees, at its corners
  double twice_area, ratio;    ///< circumradius / shortest edge

  explicit Facet_measures_3(const Scaled_simplex_3<3>& facet)
  {
    const auto& p = facet.corner;
    twice_area = norm(cross_product(p[1], p[2]));
    double product = 1, shortest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < 3; ++i) {
      const Xyz_3 u = minus(p[(i + 1) % 3], p[i]), v = minus(p[(i + 2) % 3], p[i]);
      angle[i] = degrees_per_radian_3 * std::atan2(twice_area, dot_product(u, v));
      product *= norm(u);
      shortest = (std::min)(shortest, norm(u));
    }
    ratio = twice_area > 0 ? product / (2 * twice_area * shortest) : std::numeric_limits<double>::infinity();
  }
};

/// Takes an angle over if it is a new extreme. The comparisons are also false while there is none yet.
inline void update_extremes(Angle_extreme_3& smallest, Angle_extreme_3& largest, const Angle_extreme_3& angle)
{
  if (!(angle.degrees >= smallest.degrees)) smallest = angle;
  if (!(angle.degrees <= largest.degrees)) largest = angle;
}

inline std::size_t degree_bin(double degrees)
{
  return (std::min)(static_cast<std::size_t>(degrees), Quality_3::bins - 1);
}

template <class K>
void measure_cells(const Tetrahedral_mesh_3<K>& mesh, int threads, Quality_3& quality)
{
  struct Measured
  {
    Scaled_simplex_3<4> cell;
    Cell_measures_3 measures;
  };
  constexpr std::size_t block_size = 8192; // cells that are measured together, to be added up one after the other
  std::vector<std::optional<Measured>> block(threads > 1 ? (std::min)(block_size, mesh.cells.size()) : 1);
  double smallest_sum = 0, edge_ratio_sum = 0, ratio_sum = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& vertices = mesh.cells[c];
    if (c % block.size() == 0)
      parallel_for((std::min)(block.size(), mesh.cells.size() - c), threads,
                   [&](std::size_t k) {
                     const Scaled_simplex_3<4> cell(mesh.points, mesh.cells[c + k]);
                     block[k].emplace(Measured{cell, Cell_measures_3(cell)});
                   },
                   64);
    const auto& [cell, measures] = *block[c % block.size()];
    double smallest = 180;
    for (std::size_t k = 0; k < 6; ++k) {
      const double angle = measures.dihedral[k];
      const auto& edge = Cell_measures_3::edges[k];
      ++quality.dihedrals[degree_bin(angle)];
      smallest = (std::min)(smallest, angle);
      update_extremes(quality.smallest_dihedral, quality.largest_dihedral,
                      {angle, c, {vertices[edge[0]], vertices[edge[1]]}});
    }
    ++quality.smallest_dihedrals[degree_bin(smallest)];
    const double edge_ratio = radius_edge_ratio<K>(mesh.points, vertices, cell, measures);
    // fmin and fmax pass over the NaN that stands for "none yet".
    quality.largest_radius_edge_ratio = std::fmax(quality.largest_radius_edge_ratio, edge_ratio);
    quality.smallest_radius_ratio = std::fmin(quality.smallest_radius_ratio, measures.radius_ratio);
    quality.shortest_edge = std::fmin(quality.shortest_edge, cell.unscaled(measures.shortest));
    quality.longest_edge = std::fmax(quality.longest_edge, cell.unscaled(measures.longest));
    quality.volume += cell.unscaled(measures.six_volumes, 3) / 6;
    smallest_sum += smallest;
    edge_ratio_sum += edge_ratio;
    ratio_sum += measures.radius_ratio;
  }
  const double n = static_cast<double>(mesh.cells.size());
  quality.mean_smallest_dihedral = smallest_sum / n; // 0 / 0: nothing
  quality.mean_radius_edge_ratio = edge_ratio_sum / n;
  quality.mean_radius_ratio = ratio_sum / n;
}

template <class K>
void measure_facets(const Tetrahedral_mesh_3<K>& mesh, Quality_3& quality)
{
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const Scaled_simplex_3<3> facet(mesh.points, mesh.facets[f]);
    const Facet_measures_3 measures(facet);
    for (std::size_t i = 0; i < 3; ++i)
      update_extremes(quality.smallest_facet_angle, quality.largest_facet_angle,
                      {measures.angle[i], f, {mesh.facets[f][i], mesh.facets[f][i]}});
    quality.largest_facet_ratio = std::fmax(quality.largest_facet_ratio, measures.ratio);
    quality.boundary_area += facet.unscaled(measures.twice_area, 2) / 2;
  }
}

} // namespace internal

/// Measures the shape of all cells and boundary facets. Linear time.
/// \param threads to use; the result is the same for any number.
template <class K>
Quality_3 measure_quality_3(const Tetrahedral_mesh_3<K>& mesh, int threads = 1)
{
  Quality_3 quality;
  quality.vertices = mesh.points.size();
  quality.cells = mesh.cells.size();
  quality.facets = mesh.facets.size();
  internal::measure_cells(mesh, threads, quality);
  internal::measure_facets(mesh, quality);
  return quality;
}

/// A few lines for a person.
inline std::ostream& operator<<(std::ostream& out, const Quality_3& q)
{
  out << q.cells << " cells, " << q.vertices << " vertices, " << q.facets << " boundary facets, volume " << q.volume
      << ", boundary area " << q.boundary_area << "\n";
  if (q.cells == 0) return out;
  return out << "dihedral angles " << q.smallest_dihedral.degrees << " (cell " << q.smallest_dihedral.element << ") to "
             << q.largest_dihedral.degrees << " degrees (cell " << q.largest_dihedral.element << "), mean smallest "
             << q.mean_smallest_dihedral << "; cells below 5, 10, 15 degrees: " << q.cells_below(5) << ", "
             << q.cells_below(10) << ", " << q.cells_below(15) << "\n"
             << "circumradius / shortest edge " << q.largest_radius_edge_ratio << " at most, "
             << q.mean_radius_edge_ratio << " on average (0.612 at best)\n"
             << "3 inradius / circumradius " << q.smallest_radius_ratio << " at least, " << q.mean_radius_ratio
             << " on average (1 at best)\n"
             << "angles of boundary facets " << q.smallest_facet_angle.degrees << " to "
             << q.largest_facet_angle.degrees << " degrees, circumradius / shortest edge " << q.largest_facet_ratio
             << " at most\n"
             << "edges " << q.shortest_edge << " to " << q.longest_edge << "\n";
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_QUALITY_3_H
