// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads numbers at the points of a mesh file, as solvers write them: point data of a .vtu, $NodeData of a Gmsh file in
// ASCII, or a Medit .sol, which also stands beside a .mesh of the same name.

#ifndef WEFT_IO_READ_SOLUTION_H
#define WEFT_IO_READ_SOLUTION_H

#include <weft/errors.h>
#include <weft/IO/internal/extension.h>
#include <weft/IO/internal/Line_reader.h>
#include <weft/IO/internal/Vtu_arrays.h>

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// The point array of a .vtu that is called so, or if the name is empty, `size` or the only one with a number a point.
inline std::vector<double> vtu_solution(const std::string& filename, const std::string& name)
{
  const Vtu_arrays arrays(filename);
  std::vector<std::string> fitting;
  for (const std::string& candidate : arrays.names("PointData"))
    if (candidate != "dimension" && candidate != "index") fitting.push_back(candidate); // what weft writes of points
  std::string chosen = name;
  if (chosen.empty() && arrays.has("PointData", "size")) chosen = "size";
  if (chosen.empty() && fitting.size() == 1) chosen = fitting.front();
  if (chosen.empty())
    throw File_error(filename, 0,
                     fitting.empty() ? "has no point data"
                                     : "has several arrays of point data, and none is called 'size'");
  auto values = arrays.numbers("PointData", chosen);
  if (values.size() != arrays.number_of_points())
    throw File_error(filename, 0, "the point data '" + chosen + "' isn't one number a point");
  return values;
}

/// $NodeData of a .msh, by the order of the nodes' numbers.
inline std::vector<double> gmsh_solution(const std::string& filename, const std::string& name)
{
  Line_reader in(filename);
  while (in.next_line()) {
    if (in.word("") != "$NodeData") continue;
    std::string called;
    in.require_line("the number of string tags");
    const long long strings = in.bounded_count("the number of string tags");
    for (long long i = 0; i < strings; ++i) {
      in.require_line("a string tag");
      std::string text;
      while (!in.at_end_of_line()) text += (text.empty() ? "" : " ") + std::string(in.word("a string tag"));
      if (i == 0) called = text.size() > 1 && text.front() == '"' ? text.substr(1, text.size() - 2) : text;
    }
    in.require_line("the number of real tags");
    const long long reals = in.bounded_count("the number of real tags");
    for (long long i = 0; i < reals; ++i) in.require_line("a real tag"), in.number("a real tag");
    in.require_line("the number of integer tags");
    const long long integers = in.bounded_count("the number of integer tags");
    long long components = 1, count = 0;
    for (long long i = 0; i < integers; ++i) {
      in.require_line("an integer tag");
      const long long value = in.integer("an integer tag");
      if (i == 1) components = value;
      if (i == 2) count = value;
    }
    if (!name.empty() && called != name) continue;
    if (components != 1) in.fail("the data '" + Line_reader::printable(called) + "' isn't one number a node");
    std::map<long long, double> values;
    for (long long i = 0; i < count; ++i) {
      in.require_line("a value");
      const long long node = in.integer("the number of a node");
      values[node] = in.number("a value");
    }
    std::vector<double> result;
    for (const auto& value : values) result.push_back(value.second);
    return result;
  }
  throw File_error(filename, 0, name.empty() ? "has no $NodeData" : "has no $NodeData called '" + name + "'");
}

/// The first solution at vertices of a .sol, which has to be a number each.
inline std::vector<double> medit_solution(const std::string& filename)
{
  Line_reader in(filename);
  while (in.next_line()) {
    while (!in.at_end_of_line()) {
      const std::string word(in.word(""));
      if (word != "SolAtVertices") continue;
      in.require_word("the number of vertices");
      const std::size_t n = in.count("the number of vertices", 2);
      in.require_word("the number of solutions");
      const long long solutions = in.bounded_count("the number of solutions");
      for (long long i = 0; i < solutions; ++i) {
        in.require_word("the type of a solution");
        if (in.integer("the type of a solution") != 1) in.fail("only solutions of one number a vertex can be read");
      }
      std::vector<double> result;
      for (std::size_t v = 0; v < n; ++v)
        for (long long i = 0; i < solutions; ++i) {
          in.require_word("a value");
          const double value = in.number("a value");
          if (i == 0) result.push_back(value);
        }
      return result;
    }
  }
  throw File_error(filename, 0, "has no 'SolAtVertices'");
}

} // namespace internal

namespace IO {

/// Reads one number for each point of a mesh file, in the file's order; of a .msh, in the order of its nodes' numbers.
/// \param name of the data, where the format has names; empty for that called `size`, or the only one; of a .msh the
///   first.
/// \throws File_error if the file is missing, malformed or doesn't have such data.
inline std::vector<double> read_solution(const std::string& filename, const std::string& name = std::string())
{
  const std::string type = weft::internal::extension(filename);
  if (type == "vtu") return weft::internal::vtu_solution(filename, name);
  if (type == "msh") return weft::internal::gmsh_solution(filename, name);
  if (type == "sol") return weft::internal::medit_solution(filename);
  if (type == "mesh") return weft::internal::medit_solution(filename.substr(0, filename.size() - 4) + "sol");
  throw File_error(filename, 0, "unknown extension; known are .vtu, .msh, .mesh and .sol");
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_SOLUTION_H
