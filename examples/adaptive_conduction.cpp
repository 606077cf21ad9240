// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adaptation in a loop: heat conduction in an L-shaped solid, whose flux is singular along the inner edge. Solve,
// estimate the error of each cell (Zienkiewicz and Zhu, "A simple error estimator and adaptive procedure for practical
// engineering analysis", 1987), turn the estimate into sizes, adapt the mesh, and again.
//
//   adaptive_conduction [STEPS]          prints errors against unknowns
//   adaptive_conduction --check [STEPS]  fails if the error falls more slowly than with the power -1/3 + 0.03 of them

#include <weft/adapt_3.h>
#include <weft/sizing/Lipschitz_sizing_3.h>
#include <weft/spatial/mesh/transfer_3.h>
#include <weft/spatial/sizing/Background_sizing_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = weft::Tetrahedral_mesh_3<K>;
using Domain = weft::Polyhedral_oracle_3<K>;
using Vector = Eigen::Vector3d;

/// [-1, 1]^2 x [0, 1] without the quarter where x > 0 > y.
Domain l_shaped_solid()
{
  const double outline[6][2] = {{0, 0}, {1, 0}, {1, 1}, {-1, 1}, {-1, -1}, {0, -1}};
  std::vector<K::Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const double z : {0., 1.})
    for (const auto& p : outline) points.emplace_back(p[0], p[1], z);
  for (std::size_t i = 1; i + 1 < 6; ++i) {
    triangles.push_back({0, i + 1, i});
    triangles.push_back({6, 6 + i, 6 + i + 1});
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t j = (i + 1) % 6;
    triangles.push_back({i, j, 6 + j});
    triangles.push_back({i, 6 + j, 6 + i});
  }
  return Domain(weft::piecewise_smooth_complex(points, triangles, weft::Feature_options(60)));
}

/// The temperature, r^(2/3) sin(2/3 phi): harmonic, and 0 on the two faces at the inner edge.
double exact(const Vector& p)
{
  double phi = std::atan2(p.y(), p.x());
  if (phi < -1e-12) phi += 2 * std::acos(-1.0);
  return std::pow(std::hypot(p.x(), p.y()), 2. / 3) * std::sin(2. / 3 * phi);
}

Vector exact_gradient(const Vector& p)
{
  double phi = std::atan2(p.y(), p.x());
  if (phi < -1e-12) phi += 2 * std::acos(-1.0);
  const double along = 2. / 3 * std::pow(std::hypot(p.x(), p.y()), -1. / 3);
  return {-along * std::sin(phi / 3), along * std::cos(phi / 3), 0};
}

/// A cell with the gradients of its hat functions, one a row.
struct Cell
{
  std::array<Vector, 4> corners;
  Eigen::Matrix<double, 4, 3> gradients;
  double volume;

  Cell(const Mesh& mesh, std::size_t c)
  {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& p = mesh.points[mesh.cells[c][i]];
      corners[i] = {p.x(), p.y(), p.z()};
    }
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i) edges.row(i) = (corners[static_cast<std::size_t>(i) + 1] - corners[0]).transpose();
    volume = edges.determinant() / 6;
    gradients.bottomRows<3>() = edges.inverse().transpose();
    gradients.row(0) = -gradients.bottomRows<3>().colwise().sum();
  }

  Vector gradient(const Mesh& mesh, std::size_t c, const std::vector<double>& u) const
  {
    Vector sum = Vector::Zero();
    for (std::size_t i = 0; i < 4; ++i) sum += u[mesh.cells[c][i]] * gradients.row(static_cast<int>(i)).transpose();
    return sum;
  }
};

/// Linear elements; the exact temperature on the boundary.
/// \param u where iteration begins, as from the mesh before.
std::vector<double> solve(const Mesh& mesh, std::vector<double> u)
{
  std::vector<int> unknown(mesh.points.size(), -1);
  int n = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto& p = mesh.points[v];
    if (mesh.locations[v].dimension == 3)
      unknown[v] = n++;
    else
      u[v] = exact({p.x(), p.y(), p.z()});
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(n), begin(n);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell cell(mesh, c);
    const Eigen::Matrix4d local = cell.volume * cell.gradients * cell.gradients.transpose();
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const std::size_t v = mesh.cells[c][static_cast<std::size_t>(i)],
                          w = mesh.cells[c][static_cast<std::size_t>(j)];
        if (unknown[v] < 0) continue;
        if (unknown[w] < 0)
          load[unknown[v]] -= local(i, j) * u[w];
        else
          entries.emplace_back(unknown[v], unknown[w], local(i, j));
      }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  for (std::size_t v = 0; v < u.size(); ++v)
    if (unknown[v] >= 0) begin[unknown[v]] = u[v];
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(matrix);
  solver.setTolerance(1e-9);
  const Eigen::VectorXd result = solver.solveWithGuess(load, begin);
  for (std::size_t v = 0; v < u.size(); ++v)
    if (unknown[v] >= 0) u[v] = result[unknown[v]];
  return u;
}

/// The error in the H1 seminorm, by a rule of the second degree on each cell.
double true_error(const Mesh& mesh, const std::vector<double>& u)
{
  double sum = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell cell(mesh, c);
    const Vector gradient = cell.gradient(mesh, c, u);
    constexpr double a = 0.5854101966249685, b = 0.1381966011250105;
    for (std::size_t i = 0; i < 4; ++i) {
      Vector p = a * cell.corners[i];
      for (std::size_t j = 0; j < 4; ++j)
        if (j != i) p += b * cell.corners[j];
      sum += cell.volume / 4 * (gradient - exact_gradient(p)).squaredNorm();
    }
  }
  return std::sqrt(sum);
}

/// Squared estimates of the error on each cell: the gradient against means of it at the vertices.
std::vector<double> estimated_errors(const Mesh& mesh, const std::vector<double>& u)
{
  std::vector<Vector> mean(mesh.points.size(), Vector::Zero());
  std::vector<double> volume(mesh.points.size(), 0), result;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell cell(mesh, c);
    for (const std::size_t v : mesh.cells[c]) {
      mean[v] += cell.volume * cell.gradient(mesh, c, u);
      volume[v] += cell.volume;
    }
  }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell cell(mesh, c);
    Vector sum = Vector::Zero();
    double squares = 0;
    for (const std::size_t v : mesh.cells[c]) {
      const Vector difference = mean[v] / volume[v] - cell.gradient(mesh, c, u);
      sum += difference;
      squares += difference.squaredNorm();
    }
    result.push_back(cell.volume / 20 * (sum.squaredNorm() + squares));
  }
  return result;
}

/// Sizes at the vertices for which a mesh of about so many vertices has the least error: where the squared error of a
/// volume is c h^2, with h to the power 5 as 1 / c.
std::vector<double> wanted_sizes(const Mesh& mesh, const std::vector<double>& errors, double vertices)
{
  std::vector<double> sum(mesh.points.size(), 0), weight(mesh.points.size(), 0);
  double integral = 0;              // of sizes^-3, but for a factor
  constexpr double per_cube = 0.65; // volume of a cell whose longest edge is 1, times cells a vertex
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double volume = Cell(mesh, c).volume, density = errors[c] / std::pow(volume, 5. / 3);
    const double size = std::pow(density + 1e-12, -0.2);
    integral += volume / std::pow(size, 3);
    for (const std::size_t v : mesh.cells[c]) sum[v] += volume * size, weight[v] += volume;
  }
  const double factor = std::cbrt(integral / (per_cube * vertices));
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] *= factor / weight[v];
  return sum;
}

int main(int argc, char** argv)
{
  const bool check = argc > 1 && std::string(argv[1]) == "--check";
  const int steps = argc > (check ? 2 : 1) ? std::atoi(argv[argc - 1]) : 6;
  try {
    const Domain domain = l_shaped_solid();
    weft::Criteria_3<K> criteria;
    criteria.size = 0.4;
    Mesh mesh = weft::tetrahedral_mesh(weft::make_mesh_3(domain, criteria).restricted);
    std::vector<double> u(mesh.points.size(), 0), unknowns, error;
    double vertices = static_cast<double>(mesh.points.size());
    for (int step = 0;; ++step) {
      u = solve(mesh, u);
      const std::vector<double> errors = estimated_errors(mesh, u);
      double estimate = 0;
      for (const double e : errors) estimate += e;
      unknowns.push_back(static_cast<double>(mesh.points.size()));
      error.push_back(true_error(mesh, u));
      std::cout << mesh.points.size() << " vertices, error " << error.back() << ", estimated " << std::sqrt(estimate)
                << ", smallest dihedral angle " << weft::measure_quality_3(mesh).smallest_dihedral.degrees << "\n";
      if (step == steps) break;
      vertices *= 2;
      const weft::Background_sizing_3<K> wanted(mesh, wanted_sizes(mesh, errors, vertices));
      criteria.size = weft::Lipschitz_sizing_3<K>(wanted, domain.bbox(), 0.7);
      const Mesh adapted = weft::tetrahedral_mesh(weft::adapt_3(mesh, domain, criteria).restricted);
      u = weft::transfer_3(mesh, u, adapted);
      mesh = adapted;
    }
    const std::size_t last = error.size() - 1, first = last > 3 ? last - 3 : 0;
    const double rate = std::log(error[last] / error[first]) / std::log(unknowns[last] / unknowns[first]);
    std::cout << "the error falls with the power " << rate << " of the vertices\n";
    return check && !(rate < -1. / 3 + 0.03) ? EXIT_FAILURE : EXIT_SUCCESS;
  } catch (const weft::Error& e) {
    std::cerr << "adaptive_conduction: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
}
