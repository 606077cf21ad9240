// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs Gmsh's frontal Delaunay mesher on an input: writes its geometry, calls the program, reads the mesh. Gmsh's size
// is a mean edge length, not a largest one, so the size is lowered until no edge is longer than asked for.

#ifndef WEFT_BENCHMARK_PLANAR_PLANAR_GMSH_H
#define WEFT_BENCHMARK_PLANAR_PLANAR_GMSH_H

#include "planar_inputs.h"
#include "planar_measure.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {

/// The connected parts of a graph that are simple loops, and the segments of the others.
struct Loops
{
  std::vector<std::vector<std::size_t>> loops; ///< segments in order
  std::vector<std::vector<Xy>> corners;        ///< of each loop, in order
  std::vector<std::size_t> open;               ///< segments of parts that have ends

  /// Empty if a part has both branches and loops, which takes a planar subdivision to describe.
  static std::optional<Loops> of(const Pslg& pslg)
  {
    std::vector<std::vector<std::size_t>> at(pslg.points.size());
    for (std::size_t s = 0; s < pslg.segments.size(); ++s)
      for (const std::size_t p : pslg.segments[s]) at[p].push_back(s);
    Loops result;
    std::vector<char> seen(pslg.segments.size(), 0);
    for (std::size_t s = 0; s < pslg.segments.size(); ++s) {
      if (seen[s]) continue;
      std::vector<std::size_t> part, stack{s};
      std::set<std::size_t> points;
      bool simple = true;
      for (seen[s] = 1; !stack.empty();) {
        const std::size_t t = stack.back();
        stack.pop_back();
        part.push_back(t);
        for (const std::size_t p : pslg.segments[t]) {
          points.insert(p);
          simple = simple && at[p].size() == 2;
          for (const std::size_t u : at[p])
            if (!seen[u]) {
              seen[u] = 1;
              stack.push_back(u);
            }
        }
      }
      if (simple)
        result.add_loop(pslg, at, s);
      else if (points.size() == part.size() + 1) // a tree
        result.open.insert(result.open.end(), part.begin(), part.end());
      else
        return std::nullopt;
    }
    return result;
  }

  /// Number of other loops around a loop.
  int depth(std::size_t loop) const
  {
    int n = 0;
    for (std::size_t other = 0; other < loops.size(); ++other) n += other != loop && encloses(other, corners[loop][0]);
    return n;
  }

  bool encloses(std::size_t loop, const Xy& p) const
  {
    bool inside = false;
    const auto& c = corners[loop];
    for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++)
      if ((c[i][1] > p[1]) != (c[j][1] > p[1]) &&
          p[0] < c[i][0] + (c[j][0] - c[i][0]) * (p[1] - c[i][1]) / (c[j][1] - c[i][1]))
        inside = !inside;
    return inside;
  }

private:
  void add_loop(const Pslg& pslg, const std::vector<std::vector<std::size_t>>& at, std::size_t first)
  {
    loops.emplace_back();
    corners.emplace_back();
    std::size_t s = first, p = pslg.segments[s][0];
    do {
      loops.back().push_back(s);
      corners.back().push_back({pslg.points[p].x(), pslg.points[p].y()});
      p = pslg.segments[s][pslg.segments[s][0] == p];
      s = at[p][at[p][0] == s];
    } while (s != first);
  }
};

/// Writes a .geo file of the domain by nesting parity.
/// \param size largest one; 0: left to Gmsh's caller.
inline void write_geo(const Pslg& pslg, const Loops& loops, double size, const std::string& filename)
{
  std::ofstream out(filename);
  out << std::setprecision(17);
  if (size > 0) out << "Mesh.MeshSizeMax = " << size << ";\n";
  out << "Mesh.MeshSizeExtendFromBoundary = 0;\nMesh.MeshSizeFromPoints = 0;\nMesh.SaveAll = 1;\n";
  for (std::size_t i = 0; i < pslg.points.size(); ++i)
    out << "Point(" << i + 1 << ") = {" << pslg.points[i].x() << ", " << pslg.points[i].y() << ", 0};\n";
  for (std::size_t i = 0; i < pslg.segments.size(); ++i)
    out << "Line(" << i + 1 << ") = {" << pslg.segments[i][0] + 1 << ", " << pslg.segments[i][1] + 1 << "};\n";
  std::vector<int> depth;
  for (std::size_t i = 0; i < loops.loops.size(); ++i) {
    depth.push_back(loops.depth(i));
    out << "Curve Loop(" << i + 1 << ") = {";
    std::size_t p = pslg.segments[loops.loops[i][0]][0];
    for (std::size_t k = 0; k < loops.loops[i].size(); ++k) {
      const std::size_t s = loops.loops[i][k];
      const bool forward = pslg.segments[s][0] == p;
      p = pslg.segments[s][forward];
      out << (k ? ", " : "") << (forward ? "" : "-") << s + 1;
    }
    out << "};\n";
  }
  for (std::size_t i = 0; i < loops.loops.size(); ++i) {
    if (depth[i] % 2) continue;
    out << "Plane Surface(" << i + 1 << ") = {" << i + 1;
    for (std::size_t j = 0; j < loops.loops.size(); ++j)
      if (depth[j] == depth[i] + 1 && loops.encloses(i, loops.corners[j][0])) out << ", " << j + 1;
    out << "};\n";
    for (const std::size_t s : loops.open) { // in the innermost loop around them
      const Point& p = pslg.points[pslg.segments[s][0]];
      int around = 0;
      for (std::size_t j = 0; j < loops.loops.size(); ++j) around += loops.encloses(j, {p.x(), p.y()});
      if (loops.encloses(i, {p.x(), p.y()}) && around == depth[i] + 1)
        out << "Curve{" << s + 1 << "} In Surface{" << i + 1 << "};\n";
    }
  }
}

/// Reads the vertices, edges and triangles of a Medit file. Edges are constraints.
inline Flat_mesh read_medit(const std::string& filename)
{
  Flat_mesh mesh;
  std::ifstream in(filename);
  std::set<std::pair<int, int>> constraints;
  std::string word;
  std::vector<Xy> points;
  int dimension = 3;
  while (in >> word) {
    std::size_t n = 0;
    double z;
    int mark;
    if (word == "Dimension") {
      in >> dimension;
    } else if (word == "Vertices" && in >> n) {
      points.resize(n);
      for (Xy& p : points) {
        in >> p[0] >> p[1];
        if (dimension > 2) in >> z;
        in >> mark;
      }
    } else if (word == "Edges" && in >> n) {
      for (int a, b; n > 0 && in >> a >> b >> mark; --n) constraints.emplace(std::min(a, b) - 1, std::max(a, b) - 1);
    } else if (word == "Triangles" && in >> n) {
      mesh.triangles.resize(n);
      for (auto& t : mesh.triangles) {
        in >> t[0] >> t[1] >> t[2] >> mark;
        for (int& v : t) --v;
      }
    }
  }
  std::vector<int> index(points.size(), -1); // only vertices of triangles count
  for (auto& t : mesh.triangles) {
    mesh.constrained.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const int a = t[(i + 1) % 3], b = t[(i + 2) % 3];
      mesh.constrained.back()[i] = constraints.count({std::min(a, b), std::max(a, b)}) > 0;
    }
  }
  for (auto& t : mesh.triangles)
    for (int& v : t) {
      if (index[v] < 0) {
        index[v] = static_cast<int>(mesh.points.size());
        mesh.points.push_back(points[v]);
      }
      v = index[v];
    }
  return mesh;
}

struct Gmsh_result
{
  Measures measures;
  double seconds = 0; ///< CPU time that Gmsh reports for meshing curves and surfaces
  int runs = 0;
};

/// The CPU times in Gmsh's log.
inline double gmsh_seconds(const std::string& log)
{
  double sum = 0;
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find("CPU ");
    if (line.find("Done meshing") != std::string::npos && at != std::string::npos)
      sum += std::strtod(line.c_str() + at + 4, nullptr);
  }
  return sum;
}

/// \param folder where the files go.
/// \returns nothing if the input can't be described by loops, or Gmsh fails.
inline std::optional<Gmsh_result> run_gmsh(const std::string& program, const Pslg& pslg, double size,
                                           const std::string& folder)
{
  const std::optional<Loops> loops = Loops::of(pslg);
  if (!loops) return std::nullopt;
  constexpr int most_runs = 6;
  const std::string geo = folder + "/gmsh.geo", mesh = folder + "/gmsh.mesh", log = folder + "/gmsh.log";
  const std::string command =
      "'" + program + "' -2 -algo front2d -nt 1 -cpu -format mesh -o '" + mesh + "' '" + geo + "' > '" + log + "' 2>&1";
  Gmsh_result result;
  double asked = size;
  while (result.runs < most_runs) {
    write_geo(pslg, *loops, asked, geo);
    if (std::system(command.c_str()) != 0) return std::nullopt;
    ++result.runs;
    result.measures = measure(read_medit(mesh), [size](double, double) { return size; });
    result.seconds = gmsh_seconds(log);
    if (result.measures.triangles == 0) return std::nullopt;
    if (result.measures.oversize == 0) break;
    asked *= 0.998 / result.measures.largest_ratio;
  }
  return result;
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_PLANAR_PLANAR_GMSH_H
