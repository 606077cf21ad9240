// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads surfaces, mends them and makes domains of them; writes what becomes of domains.

#include "../spatial/files.h"
#include "surface.h"

#include <weft/internal/counted.h>
#include <weft/IO/read_surface.h>
#include <weft/IO/write_angle_histogram_svg.h>
#include <weft/spatial/surface/compare_with_given_3.h>
#include <weft/spatial/surface/mended_complex_3.h>
#include <weft/spatial/surface/merge_surfaces_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace mesh_3_program {

namespace {

using Surfaces = std::vector<weft::Polygon_soup_3<K>>;

class Surface_domain : public Domain
{
public:
  /// \param given the surfaces before they were mended, if they were.
  explicit Surface_domain(weft::Piecewise_smooth_complex_3<K> surface, Surfaces given = {})
      : surface_(std::move(surface)), given_(std::move(given))
  {}

  double extent() const override
  {
    CGAL::Bbox_3 box;
    for (const auto& p : surface_.points) box += p.bbox();
    return diagonal(box);
  }
  double detail() const override { return 0; }
  std::vector<std::string> changes() const override { return surface_.changes; }
  std::shared_ptr<const Result> mesh(const Bounds& bounds, const weft::Mesh_options_3& options) const override
  {
    auto result = mesh_surface(surface_, bounds, options);
    double approximation = bounds.approximation;
    bool is_bounded = approximation > 0;
    for (const auto& [label, length] : bounds.approximation_of) {
      approximation = std::max(approximation, length);
      is_bounded = is_bounded && length > 0;
    }
    if (given_.empty() || !is_bounded || result->mesh.cells.empty()) return result;
    Result compared = *result;
    compared.report.given = weft::compare_with_given_3(given_, surface_, compared.mesh, 2 * approximation);
    return std::make_shared<const Result>(std::move(compared));
  }

private:
  weft::Piecewise_smooth_complex_3<K> surface_;
  Surfaces given_;
};

} // namespace

std::unique_ptr<Domain> read_surfaces(const std::vector<std::string>& filenames, const weft::Feature_options& features,
                                      const Mending& mending)
{
  Surfaces surfaces;
  for (const std::string& name : filenames) {
    weft::internal::ask_to_go_on(mending.options, "reading");
    surfaces.push_back(weft::IO::read_surface<K>(name));
  }
  if (mending.strict) return std::make_unique<Surface_domain>(weft::piecewise_smooth_complex(surfaces, features));
  auto complex = weft::mended_complex_3(surfaces, features, mending.options);
  if (complex.changes.empty()) surfaces.clear(); // the mesh is compared with the complex
  return std::make_unique<Surface_domain>(std::move(complex), std::move(surfaces));
}

std::function<double(const std::array<double, 3>&)> read_size_field(const std::string& filename)
{
  return [field = spatial_files::read_sizes(filename)](const std::array<double, 3>& p) {
    return field(K::Point_3(p[0], p[1], p[2]));
  };
}

// ---- Results

std::shared_ptr<const Result> make_result(weft::Tetrahedral_mesh_3<K> mesh, const weft::Mesh_report_3& report,
                                          weft::Mesh_names_3 names, std::optional<weft::Raised_mesh_3<K>> raised,
                                          std::optional<std::vector<weft::Voxel_component_3>> missing)
{
  const weft::Quality_3 quality = spatial_files::measure_quality(mesh);
  return std::make_shared<const Result>(
      Result{std::move(mesh), report, quality, std::move(names), std::move(missing), std::move(raised)});
}

std::string second_order(const Result& result)
{
  if (!result.raised) return {};
  std::ostringstream line;
  line << "second order: " << weft::internal::counted(result.raised->curved_edges, "curved edge", "curved edges")
       << ", " << result.raised->straightened_edges << " bent less than the boundary, smallest scaled Jacobian "
       << result.raised->smallest_scaled_jacobian;
  return line.str();
}

std::vector<std::string> left_out(const Result& result)
{
  std::vector<std::string> lines;
  if (!result.missing) return lines;
  for (const weft::Voxel_component_3& c : *result.missing) {
    std::ostringstream line;
    line << "left out: a component of label " << c.label << " with "
         << weft::internal::counted(c.voxels, "voxel", "voxels") << ", volume " << c.volume << ", at (" << c.center[0]
         << ", " << c.center[1] << ", " << c.center[2] << ")";
    lines.push_back(line.str());
  }
  return lines;
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

bool is_mesh_filename(const std::string& filename, int order)
{
  return order == 2 ? spatial_files::is_quadratic_mesh_filename(filename) : spatial_files::is_mesh_filename(filename);
}

void write_mesh(const std::string& filename, const Result& result)
{
  if (result.raised)
    spatial_files::write_mesh(filename, result.raised->mesh, result.names);
  else
    spatial_files::write_mesh(filename, result.mesh, result.names);
}

void write_report(const std::string& filename, const Result& result)
{
  if (result.missing)
    spatial_files::write_report(filename, result.report, result.quality, *result.missing);
  else
    spatial_files::write_report(filename, result.report, result.quality);
}

void write_histogram(const std::string& filename, const Result& result, const std::string& title)
{
  weft::IO::write_angle_histogram_svg(filename, result.quality.histogram<weft::Angle_histogram>("weft"), title);
}

} // namespace mesh_3_program
