// SPDX-License-Identifier: GPL-3.0-or-later

#include "files.h"

#include <weft/IO/write_mesh_3.h>
#include <weft/IO/write_report_json_3.h>

namespace spatial_files {

bool is_mesh_filename(const std::string& filename)
{
  return weft::IO::is_mesh_3_filename(filename);
}

bool is_quadratic_mesh_filename(const std::string& filename)
{
  return weft::IO::is_quadratic_mesh_3_filename(filename);
}

void write_mesh(const std::string& filename, const Mesh& mesh, const weft::Mesh_names_3& names)
{
  weft::IO::write_mesh_3(filename, mesh, names);
}

void write_mesh(const std::string& filename, const weft::Quadratic_mesh_3<K>& mesh, const weft::Mesh_names_3& names)
{
  weft::IO::write_mesh_3(filename, mesh, names);
}

weft::Quality_3 measure_quality(const Mesh& mesh)
{
  return weft::measure_quality_3(mesh);
}

void write_report(const std::string& filename, const weft::Mesh_report_3& report, const weft::Quality_3& quality)
{
  weft::IO::write_report_json(filename, report, quality);
}

void write_report(const std::string& filename, const weft::Mesh_report_3& report, const weft::Quality_3& quality,
                  const std::vector<weft::Voxel_component_3>& missing)
{
  weft::IO::write_report_json(filename, report, quality, missing);
}

void write_report(const std::string& filename, const weft::Improve_report_3& report)
{
  weft::IO::write_report_json(filename, report);
}

} // namespace spatial_files
