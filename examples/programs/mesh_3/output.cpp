// SPDX-License-Identifier: GPL-3.0-or-later

#include "result.h"

#include <weft/IO/report_json_3.h>
#include <weft/IO/svg_histogram.h>
#include <weft/IO/write_mesh_3.h>

#include <utility>

namespace mesh_3_program {

std::shared_ptr<const Result> make_result(weft::Tetrahedral_mesh_3<K> mesh, const weft::Mesh_report_3& report)
{
  const weft::Quality_3 quality = weft::measure_quality_3(mesh);
  return std::make_shared<const Result>(Result{std::move(mesh), report, quality});
}

const weft::Mesh_report_3& report(const Result& result)
{
  return result.report;
}

bool is_empty(const Result& result)
{
  return result.mesh.cells.empty();
}

double smallest_dihedral(const Result& result)
{
  return result.quality.smallest_dihedral.degrees;
}

bool is_mesh_filename(const std::string& filename)
{
  return weft::IO::is_mesh_3_filename(filename);
}

void write_mesh(const std::string& filename, const Result& result)
{
  weft::IO::write_mesh_3(filename, result.mesh);
}

void write_report(const std::string& filename, const Result& result)
{
  weft::IO::write_report_json(filename, result.report, result.quality);
}

void write_histogram(const std::string& filename, const Result& result, const std::string& title)
{
  weft::IO::write_angle_histogram_svg(filename, result.quality.histogram<weft::Angle_histogram>("weft"), title);
}

} // namespace mesh_3_program
