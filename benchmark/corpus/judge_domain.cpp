// SPDX-License-Identifier: GPL-3.0-or-later
//
// Judges whether a tetrahedral mesh fills the solid that a surface bounds, without anything of weft but its reader of
// surfaces, and prints a JSON object.
//
//   judge_domain [--label N] SURFACE MESH.mesh PERCENT [VOLUME PIECES SHELLS EULER]
//
// --label N: of the mesh, the cells of subdomain N only.
// PERCENT: the approximation bound in parts of the diagonal of the surface's bounding box. What is known of the solid
// follows, or it is taken from the surface once equal points are one; pieces aren't known then.

#include "../../test/fixtures/domain_judge.h"
#include "../common/program.h"
#include "../common/table.h"

#include <weft/IO/read_surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Cuts a polygon, convex or not, into triangles: ears, seen along its normal. What has no ears becomes a fan.
void add_polygon(judge::Triangles& s, std::vector<std::size_t> polygon)
{
  judge::Vector normal{0, 0, 0};
  const auto of = [&s](std::size_t a, std::size_t b, std::size_t c) {
    return judge::cross(judge::minus(s.points[b], s.points[a]), judge::minus(s.points[c], s.points[a]));
  };
  for (std::size_t i = 2; i < polygon.size(); ++i)
    normal = judge::plus(normal, 1, of(polygon[0], polygon[i - 1], polygon[i]));
  const auto is_left = [&](std::size_t a, std::size_t b, std::size_t c) { return judge::dot(of(a, b, c), normal) > 0; };
  while (polygon.size() > 2) {
    const std::size_t n = polygon.size();
    std::size_t ear = 0;
    for (std::size_t i = 0; i < n && n > 3; ++i) {
      const std::size_t a = polygon[(i + n - 1) % n], b = polygon[i], c = polygon[(i + 1) % n];
      const bool is_empty = std::none_of(polygon.begin(), polygon.end(), [&](std::size_t v) {
        return v != a && v != b && v != c && is_left(a, b, v) && is_left(b, c, v) && is_left(c, a, v);
      });
      if (!is_left(a, b, c) || !is_empty) continue;
      ear = i;
      break;
    }
    const judge::Triangle t{polygon[(ear + n - 1) % n], polygon[ear], polygon[(ear + 1) % n]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) s.triangles.push_back(t);
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
  }
}

/// Equal points are one, and what has lost a corner by that is left out.
judge::Triangles read_surface(const std::string& filename)
{
  const auto soup = weft::IO::read_surface<K>(filename);
  judge::Triangles s;
  std::map<judge::Vector, std::size_t> numbers;
  std::vector<std::size_t> number;
  for (const auto& p : soup.points) {
    const judge::Vector at{p.x() + 0., p.y() + 0., p.z() + 0.};
    const auto [place, is_new] = numbers.emplace(at, s.points.size());
    if (is_new) s.points.push_back(at);
    number.push_back(place->second);
  }
  for (const auto& polygon : soup.polygons) {
    std::vector<std::size_t> corners;
    for (const std::size_t v : polygon) corners.push_back(number[v]);
    add_polygon(s, std::move(corners));
  }
  return s;
}

/// Vertices and tetrahedra of a Medit file, those with a label only, or all.
std::pair<std::vector<judge::Vector>, std::vector<judge::Cell>> read_mesh(const std::string& filename,
                                                                          std::optional<int> label)
{
  std::ifstream in(filename);
  std::vector<judge::Vector> points;
  std::vector<judge::Cell> cells;
  std::size_t n = 0;
  int tag = 0;
  for (std::string word; in >> word && word != "End";)
    if (word == "Vertices") {
      in >> n;
      for (std::size_t i = 0; i < n && in; ++i) {
        judge::Vector p;
        in >> p[0] >> p[1] >> p[2] >> tag;
        points.push_back(p);
      }
    } else if (word == "Tetrahedra") {
      in >> n;
      for (std::size_t i = 0; i < n && in; ++i) {
        judge::Cell c;
        in >> c[0] >> c[1] >> c[2] >> c[3] >> tag;
        for (std::size_t& v : c)
          if (v-- == 0 || v >= points.size()) throw weft::File_error(filename, 0, "names a vertex that it lacks");
        if (!label || tag == *label) cells.push_back(c);
      }
    }
  if (cells.empty()) throw weft::File_error(filename, 0, "has no tetrahedra");
  return {std::move(points), std::move(cells)};
}

/// The smallest and the largest dihedral angle in degrees, and the smallest of the cells that have a vertex inside.
std::array<double, 3> extreme_dihedrals(const std::vector<judge::Vector>& points, const std::vector<judge::Cell>& cells)
{
  long pieces = 0;
  std::vector<char> is_outside(points.size());
  for (const judge::Triangle& t : judge::boundary(points, cells, pieces).triangles)
    for (const std::size_t v : t) is_outside[v] = true;
  std::array<double, 3> result{180, 0, 180};
  for (const judge::Cell& c : cells) {
    double smallest = 180;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) { // about the edge of the other two
        const std::size_t k = i != 0 ? 0 : j != 1 ? 1 : 2;
        const std::size_t l = 6 - i - j - k;
        const judge::Vector axis = judge::minus(points[c[l]], points[c[k]]);
        const judge::Vector a = judge::cross(axis, judge::minus(points[c[i]], points[c[k]])),
                            b = judge::cross(axis, judge::minus(points[c[j]], points[c[k]]));
        const judge::Vector both = judge::cross(a, b);
        const double angle = std::atan2(std::sqrt(judge::dot(both, both)), judge::dot(a, b)) * 180 / std::acos(-1.);
        smallest = std::min(smallest, angle);
        result[1] = std::max(result[1], angle);
      }
    result[0] = std::min(result[0], smallest);
    if (std::any_of(c.begin(), c.end(), [&](std::size_t v) { return !is_outside[v]; }))
      result[2] = std::min(result[2], smallest);
  }
  return result;
}

double diagonal(const judge::Triangles& s)
{
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax_element(s.points.begin(), s.points.end(),
                                                 [k](const auto& p, const auto& q) { return p[k] < q[k]; });
    sum += ((*high)[k] - (*low)[k]) * ((*high)[k] - (*low)[k]);
  }
  return std::sqrt(sum);
}

void run(benchmark::Argument_reader arguments)
{
  std::vector<std::string> operands;
  std::optional<int> label;
  while (arguments.next())
    if (arguments.is("--label"))
      label = static_cast<int>(arguments.number());
    else
      operands.push_back(arguments.argument());
  if (operands.size() != 3 && operands.size() != 7)
    throw weft::Option_error("usage: judge_domain [--label N] SURFACE MESH.mesh PERCENT [VOLUME PIECES SHELLS EULER]");
  const judge::Triangles surface = read_surface(operands[0]);
  const auto [points, cells] = read_mesh(operands[1], label);
  const judge::Topology given = judge::topology(surface);
  judge::Expected expected{std::abs(judge::volume(surface)), 0, given.shells, given.euler};
  if (operands.size() == 7)
    expected = {std::stod(operands[3]), std::stol(operands[4]), std::stol(operands[5]), std::stol(operands[6])};
  const double approximation =
      diagonal(surface) * benchmark::Argument_reader::checked("PERCENT", operands[2], true) / 100;
  const judge::Verdict v = judge::verdict(points, cells, surface, expected, approximation);
  const auto yes = [](bool b) { return b ? "true" : "false"; };
  benchmark::Json_object result;
  result.add_raw("right", yes(v.is_right())).add_raw("volume_holds", yes(v.has_volume()));
  result.add_raw("topology_holds", yes(v.has_topology())).add_raw("surface_holds", yes(v.has_surface()));
  result.add_raw("manifold", yes(v.is_manifold()));
  result.add_raw("surface_is_manifold", yes(given.bad_edges == 0 && given.bad_vertices == 0));
  result.add("volume", v.found.volume).add("expected_volume", v.expected.volume);
  result.add("surface_to_mesh", v.surface_to_mesh).add("mesh_to_surface", v.mesh_to_surface);
  result.add("approximation", approximation).add("vertices", static_cast<double>(points.size()));
  result.add("cells", static_cast<double>(cells.size()));
  const auto [smallest, largest, inner] = extreme_dihedrals(points, cells);
  result.add("smallest_dihedral", smallest).add("largest_dihedral", largest).add("smallest_inner_dihedral", inner);
  result.add("why", judge::describe(v));
  std::cout << result.str() << "\n";
}

} // namespace

int main(int argc, char** argv)
{
  return benchmark::run_program("judge_domain", [&] { run({argc, argv}); });
}
