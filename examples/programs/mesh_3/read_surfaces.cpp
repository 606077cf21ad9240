// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface.h"

#include <weft/IO/read_surface.h>
#include <weft/spatial/merge_surfaces_3.h>

#include <CGAL/Bbox_3.h>

#include <utility>

namespace mesh_3_program {

namespace {

class Surface_domain : public Domain
{
public:
  explicit Surface_domain(weft::Piecewise_smooth_complex_3<K> surface) : surface_(std::move(surface)) {}

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
    return mesh_surface(surface_, bounds, options);
  }

private:
  weft::Piecewise_smooth_complex_3<K> surface_;
};

} // namespace

std::unique_ptr<Domain> read_surfaces(const std::vector<std::string>& filenames, const weft::Feature_options& features,
                                      bool is_to_be_repaired)
{
  using Repair = weft::Polygon_soup_3<K>::Repair;
  std::vector<weft::Polygon_soup_3<K>> surfaces;
  for (const std::string& name : filenames) surfaces.push_back(weft::IO::read_surface<K>(name));
  return std::make_unique<Surface_domain>(
      weft::piecewise_smooth_complex(surfaces, features, is_to_be_repaired ? Repair(repair) : Repair()));
}

} // namespace mesh_3_program
