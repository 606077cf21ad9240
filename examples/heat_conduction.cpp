// SPDX-License-Identifier: GPL-3.0-or-later
//
// From an STL file to a finite element run: how warm a heat sink gets. Linear tetrahedra, Eigen's sparse solver, and a
// .vtu file with the temperatures for ParaView. doc/tutorial.md goes through it step by step.
//
//   heat_conduction [FILE.stl [SIZE]]       writes heat_conduction.vtu
//   heat_conduction --check [FILE.stl [SIZE]]  solves problems whose solution is known, too
//
// Lengths in millimetres, power in watts, temperatures in degrees Celsius.

//! [includes]
#include <weft/IO/read_surface.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Dense>
#include <Eigen/Sparse>
//! [includes]

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = weft::Tetrahedral_mesh_3<K>;

const double conductivity = 0.2; // of aluminium, W / (mm K)
const double transfer = 5e-5;    // from metal to moving air, W / (mm^2 K)
const double air = 20;           // degrees Celsius
const double power = 30;         // of what the base sits on, W

//! [mesh]
using Surface = weft::Polygon_soup_3<K>;

Mesh make_mesh(const Surface& surface, double size)
{
  const weft::Polyhedral_oracle_3<K> domain(surface, weft::Feature_options(60)); // creases from 60 degrees on
  weft::Criteria_3<K> criteria;
  criteria.size = size;
  criteria.approximation = 0.05 * size;
  const auto result = weft::make_mesh_3(domain, criteria);
  std::cout << result.report;
  return weft::tetrahedral_mesh(result.restricted);
}
//! [mesh]

Eigen::Vector3d coordinates(const Mesh& mesh, std::size_t v)
{
  return {mesh.points[v].x(), mesh.points[v].y(), mesh.points[v].z()};
}

//! [assemble]
/// A linear system while it is put together.
struct System
{
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load;

  void add(std::size_t i, std::size_t j, double value)
  {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  }
};

/// Adds conduction through all cells: the integrals of k grad(a) . grad(b), where a and b are the linear functions
/// that are 1 at one vertex and 0 at all others.
void add_conduction(const Mesh& mesh, double k, System& system)
{
  for (const auto& cell : mesh.cells) {
    Eigen::Matrix3d edges; // from the first vertex to the other three
    for (unsigned i = 0; i < 3; ++i) edges.col(i) = coordinates(mesh, cell[i + 1]) - coordinates(mesh, cell[0]);
    const double volume = edges.determinant() / 6;
    Eigen::Matrix<double, 4, 3> gradients;
    gradients.bottomRows<3>() = edges.inverse();
    gradients.row(0) = -gradients.bottomRows<3>().colwise().sum();
    const Eigen::Matrix4d local = k * volume * gradients * gradients.transpose();
    for (unsigned i = 0; i < 4; ++i)
      for (unsigned j = 0; j < 4; ++j) system.add(cell[i], cell[j], local(i, j));
  }
}
//! [assemble]

double area(const Mesh& mesh, const std::array<std::size_t, 3>& facet)
{
  const Eigen::Vector3d a = coordinates(mesh, facet[0]);
  return 0.5 * (coordinates(mesh, facet[1]) - a).cross(coordinates(mesh, facet[2]) - a).norm();
}

//! [boundary]
/// Which facets lie in the lowest plane, where the heat comes in.
std::vector<bool> find_base(const Mesh& mesh)
{
  double lowest = mesh.points.front().z();
  for (const auto& p : mesh.points) lowest = std::min(lowest, p.z());
  std::vector<bool> is_base;
  for (const auto& facet : mesh.facets)
    is_base.push_back(
        std::all_of(facet.begin(), facet.end(), [&](std::size_t v) { return mesh.points[v].z() == lowest; }));
  return is_base;
}

/// Adds heat that comes in through the base, spread evenly, and goes out to the air through all other facets, in
/// proportion to how much warmer than the air they are.
void add_boundary(const Mesh& mesh, const std::vector<bool>& is_base, System& system)
{
  double base = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    if (is_base[f]) base += area(mesh, mesh.facets[f]);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto& facet = mesh.facets[f];
    const double a = area(mesh, facet);
    for (const std::size_t v : facet) {
      system.load[static_cast<int>(v)] += a / 3 * (is_base[f] ? power / base : transfer * air);
      if (!is_base[f])
        for (const std::size_t w : facet) system.add(v, w, transfer * a / (v == w ? 6 : 12));
    }
  }
}
//! [boundary]

//! [solve]
/// \throws weft::Error if the matrix isn't positive definite.
Eigen::VectorXd solve(const System& system)
{
  Eigen::SparseMatrix<double> matrix(system.load.size(), system.load.size());
  matrix.setFromTriplets(system.entries.begin(), system.entries.end()); // sums up entries of the same place
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success || factors.vectorD().minCoeff() <= 0)
    throw weft::Error("the matrix isn't positive definite");
  return factors.solve(system.load);
}

Eigen::VectorXd solve_heat_sink(const Mesh& mesh, const std::vector<bool>& is_base)
{
  System system;
  system.load = Eigen::VectorXd::Zero(static_cast<int>(mesh.points.size()));
  add_conduction(mesh, conductivity, system);
  add_boundary(mesh, is_base, system);
  return solve(system);
}
//! [solve]

//! [write]
/// Writes tetrahedra with one value at each vertex.
/// \throws weft::File_error if the file can't be written.
void write_result(const std::string& filename, const Mesh& mesh, const Eigen::VectorXd& temperature)
{
  std::ofstream out(filename);
  out.precision(10);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      << "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" << mesh.points.size() << "\" NumberOfCells=\""
      << mesh.cells.size() << "\">\n<PointData Scalars=\"temperature\">\n"
      << "<DataArray type=\"Float64\" Name=\"temperature\" format=\"ascii\">\n"
      << temperature << "\n</DataArray>\n</PointData>\n<Points>\n"
      << "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const auto& p : mesh.points) out << p << '\n';
  out << "</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const auto& c : mesh.cells) out << c[0] << ' ' << c[1] << ' ' << c[2] << ' ' << c[3] << '\n';
  out << "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t i = 1; i <= mesh.cells.size(); ++i) out << 4 * i << '\n';
  out << "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) out << "10\n"; // VTK_TETRA
  out << "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  if (!out.flush()) throw weft::File_error(filename, 0, "can't be written");
}
//! [write]

//! [check]
/// Heat that goes out to the air, less what comes in, in parts of that: zero but for rounding.
double imbalance(const Mesh& mesh, const std::vector<bool>& is_base, const Eigen::VectorXd& temperature)
{
  double out = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (const std::size_t v : mesh.facets[f])
      if (!is_base[f]) out += transfer * area(mesh, mesh.facets[f]) / 3 * (temperature[static_cast<int>(v)] - air);
  return std::abs(out - power) / power;
}

/// Solves Laplace's equation with the values of `exact` on the boundary.
/// \param exact a harmonic function, point -> value.
/// \returns the root mean square of the errors at vertices inside.
template <class Function>
double mean_error(const Mesh& mesh, const Function& exact)
{
  System whole;
  add_conduction(mesh, 1, whole);
  std::vector<int> number(mesh.points.size(), -1); // of the vertices inside, whose values aren't known
  int n = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.locations[v].dimension == 3) number[v] = n++;
  System inside;
  inside.load = Eigen::VectorXd::Zero(n);
  for (const auto& e : whole.entries) {
    const int row = number[static_cast<std::size_t>(e.row())], column = number[static_cast<std::size_t>(e.col())];
    if (row < 0) continue;
    if (column >= 0)
      inside.entries.emplace_back(row, column, e.value());
    else
      inside.load[row] -= e.value() * exact(coordinates(mesh, static_cast<std::size_t>(e.col())));
  }
  const Eigen::VectorXd values = solve(inside);
  double sum = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (number[v] >= 0) sum += std::pow(values[number[v]] - exact(coordinates(mesh, v)), 2);
  return std::sqrt(sum / n);
}
//! [check]

Surface unit_cube()
{
  Surface cube;
  for (int i = 0; i < 8; ++i) cube.points.emplace_back(i & 1, (i >> 1) & 1, i >> 2);
  cube.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return cube;
}

/// Whether all checks pass; prints what they find.
bool check(const Mesh& mesh, double heat_imbalance)
{
  const auto linear = [](const Eigen::Vector3d& p) { return 1 + 0.2 * p.x() - 0.5 * p.y() + 0.3 * p.z(); };
  const auto harmonic = [](const Eigen::Vector3d& p) { return std::exp(3 * p.x()) * std::sin(3 * p.y()); };
  const double linear_error = mean_error(mesh, linear);
  const double coarse = mean_error(make_mesh(unit_cube(), 0.2), harmonic),
               fine = mean_error(make_mesh(unit_cube(), 0.1), harmonic);
  std::cout << "heat out less heat in: " << heat_imbalance << " parts\nerror of a linear solution: " << linear_error
            << "\nerror of a harmonic one on a cube: " << coarse << ", with half the size " << fine << ", order "
            << std::log2(coarse / fine) << '\n';
  return heat_imbalance < 1e-9 && linear_error < 1e-9 && std::log2(coarse / fine) > 1.6;
}

//! [main]
int main(int argc, char** argv)
{
  const bool checks = argc > 1 && std::string(argv[1]) == "--check";
  const int first = checks ? 2 : 1;
  const std::string filename = argc > first ? argv[first] : "data/heat_sink.stl";
  const double size = argc > first + 1 ? std::atof(argv[first + 1]) : 2.5;
  try {
    const Mesh mesh = make_mesh(weft::IO::read_surface<K>(filename), size);
    const std::vector<bool> is_base = find_base(mesh);
    const Eigen::VectorXd temperature = solve_heat_sink(mesh, is_base);
    std::cout << "temperatures from " << temperature.minCoeff() << " to " << temperature.maxCoeff() << " degrees\n";
    write_result("heat_conduction.vtu", mesh, temperature);
    if (checks && !check(mesh, imbalance(mesh, is_base, temperature))) return EXIT_FAILURE;
  } catch (const weft::Error& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
//! [main]
