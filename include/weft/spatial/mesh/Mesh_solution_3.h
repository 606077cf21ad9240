// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers on a spatial mesh by their names, as solvers make them and files carry them.

#ifndef WEFT_SPATIAL_MESH_MESH_SOLUTION_3_H
#define WEFT_SPATIAL_MESH_MESH_SOLUTION_3_H

#include <map>
#include <string>
#include <vector>

namespace weft {

/// Values at the vertices and in the cells of a Tetrahedral_mesh_3, in its order.
struct Mesh_solution_3
{
  std::map<std::string, std::vector<double>> at_vertices, in_cells;
};

} // namespace weft

#endif // WEFT_SPATIAL_MESH_MESH_SOLUTION_3_H
