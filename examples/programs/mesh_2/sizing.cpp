// SPDX-License-Identifier: GPL-3.0-or-later

#include "sizing.h"

#include "../../cgal_refinement.h"

#include <weft/IO/read_sizing_2.h>
#include <weft/make_mesh_2.h>
#include <weft/planar/sizing/Lfs_sizing_2.h>
#include <weft/planar/sizing/Region_sizing_2.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace mesh_2_program {

namespace {

/// A sizing field that isn't the same everywhere. One type for all such fields: the mesher is compiled once for them,
/// and a call costs next to nothing beside what a field computes.
using Varying_field = std::function<double(const K::Point_2&)>;

/// A sizing field of any type.
template <class Field>
class Sizing_by : public Sizing
{
public:
  explicit Sizing_by(Field field) : field_(std::move(field)) {}

  weft::Mesh_report_2 make_mesh(Cdt& cdt, const weft::Mesh_options_2& options) const override
  {
    return weft::make_mesh_2(cdt, field_, options);
  }
  weft::Sizing_quality_2 measure(const Cdt& cdt) const override { return weft::measure_sizing_2(cdt, field_); }
  bool refine_by_cgal(Cdt& cdt, const std::function<bool(std::size_t)>& go_on) const override
  {
    return ::refine_by_cgal(cdt, field_, go_on);
  }

private:
  Field field_;
};

} // namespace

std::unique_ptr<Sizing> uniform_sizing(double size)
{
  return std::make_unique<Sizing_by<weft::Uniform_sizing<>>>(weft::Uniform_sizing<>(size));
}

std::unique_ptr<Sizing> lfs_sizing(const Pslg& graph, double k, double min_size)
{
  return std::make_unique<Sizing_by<Varying_field>>(weft::Lfs_sizing_2<K>(graph, k, min_size));
}

std::unique_ptr<Sizing> region_sizing(const Cdt& cdt, const weft::Mesh_tags_2<K>& tags, double size,
                                      const std::map<int, double>& size_of_mark)
{
  return std::make_unique<Sizing_by<Varying_field>>(weft::Region_sizing_2<Cdt>(cdt, tags, size, size_of_mark));
}

std::unique_ptr<Sizing> field_sizing(const std::string& filename, double gradation, double size)
{
  auto background = weft::IO::read_sizing_2<K>(filename);
  background.limit_gradient(gradation);
  return std::make_unique<Sizing_by<Varying_field>>(
      [background, size](const K::Point_2& p) { return std::min(size, background(p)); });
}

} // namespace mesh_2_program
