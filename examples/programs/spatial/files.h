// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the spatial programs read and write. Compiled once for all of them, readers apart from writers.

#ifndef WEFT_EXAMPLES_PROGRAMS_SPATIAL_FILES_H
#define WEFT_EXAMPLES_PROGRAMS_SPATIAL_FILES_H

#include <weft/report.h>
#include <weft/spatial/domain/Voxel_components_3.h>
#include <weft/spatial/local/Improve_options_3.h>
#include <weft/spatial/mesh/Element_soup_3.h>
#include <weft/spatial/mesh/Mesh_names_3.h>
#include <weft/spatial/mesh/Quadratic_mesh_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <functional>
#include <string>
#include <vector>

namespace spatial_files {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = weft::Tetrahedral_mesh_3<K>;

// These are the functions of weft::IO with similar names, and throw what those throw.

weft::Imported_mesh_3<K> read_mesh(const std::string& filename);
std::function<double(const K::Point_3&)> read_sizes(const std::string& filename);

bool is_mesh_filename(const std::string& filename);
bool is_quadratic_mesh_filename(const std::string& filename);
void write_mesh(const std::string& filename, const Mesh& mesh, const weft::Mesh_names_3& names = weft::Mesh_names_3());
void write_mesh(const std::string& filename, const weft::Quadratic_mesh_3<K>& mesh, const weft::Mesh_names_3& names);
weft::Quality_3 measure_quality(const Mesh& mesh);
void write_report(const std::string& filename, const weft::Mesh_report_3& report, const weft::Quality_3& quality);
void write_report(const std::string& filename, const weft::Mesh_report_3& report, const weft::Quality_3& quality,
                  const std::vector<weft::Voxel_component_3>& missing);
void write_report(const std::string& filename, const weft::Improve_report_3& report);

} // namespace spatial_files

#endif // WEFT_EXAMPLES_PROGRAMS_SPATIAL_FILES_H
