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
#include <filesystem>
#include <map>
#include <sstream>
#include <utility>

namespace mesh_3_program {

namespace {

using Surfaces = std::vector<weft::Polygon_soup_3<K>>;

class Surface_domain : public Domain
{
public:
  /// \param is_named_by_files whether names are those of files; otherwise users are told which they are.
  /// \param given the surfaces before they were mended, if they were.
  Surface_domain(weft::Piecewise_smooth_complex_3<K> surface, bool is_named_by_files, Surfaces given = {})
      : surface_(std::move(surface)), is_named_by_files_(is_named_by_files), given_(std::move(given))
  {}

  double extent() const override
  {
    CGAL::Bbox_3 box;
    for (const auto& p : surface_.points) box += p.bbox();
    return diagonal(box);
  }
  double detail() const override { return 0; }
  std::vector<std::string> changes() const override
  {
    std::vector<std::string> lines = surface_.changes;
    if (!is_named_by_files_)
      for (const auto& [subdomain, name] : names())
        lines.push_back("subdomain " + std::to_string(subdomain) + " is \"" + name + '"');
    return lines;
  }
  std::shared_ptr<const Result> mesh(const Bounds& bounds, const weft::Mesh_options_3& options) const override
  {
    Bounds named = bounds;
    for (const auto& [subdomain, name] : names()) named.name_of.try_emplace(subdomain, name);
    auto result = mesh_surface(surface_, named, options);
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
  /// Of subdomains that there are.
  std::map<int, std::string> names() const
  {
    std::map<int, std::string> names;
    for (const auto& [behind, before] : surface_.sides)
      for (const int subdomain : {behind, before})
        if (const auto i = static_cast<std::size_t>(subdomain);
            i > 0 && i <= surface_.names.size() && !surface_.names[i - 1].empty())
          names[subdomain] = surface_.names[i - 1];
    return names;
  }

  weft::Piecewise_smooth_complex_3<K> surface_;
  bool is_named_by_files_;
  Surfaces given_;
};

} // namespace

std::unique_ptr<Domain> read_surfaces(const std::vector<std::string>& filenames, const weft::Feature_options& features,
                                      const Mending& mending)
{
  Surfaces surfaces;
  const bool is_named_by_files = filenames.size() > 1;
  for (const std::string& name : filenames) {
    weft::internal::ask_to_go_on(mending.options, "reading");
    surfaces.push_back(weft::IO::read_surface<K>(name));
    if (is_named_by_files) surfaces.back().name = std::filesystem::path(name).stem().string();
  }
  if (mending.strict)
    return std::make_unique<Surface_domain>(weft::piecewise_smooth_complex(surfaces, features), is_named_by_files);
  auto complex = weft::mended_complex_3(surfaces, features, mending.options);
  if (complex.changes.empty()) surfaces.clear(); // the mesh is compared with the complex
  return std::make_unique<Surface_domain>(std::move(complex), is_named_by_files, std::move(surfaces));
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
