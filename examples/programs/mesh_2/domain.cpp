// SPDX-License-Identifier: GPL-3.0-or-later

#include "domain.h"

#include "sizing.h"

#include <weft/IO/read_pslg.h>
#include <weft/IO/write_mesh_2.h>
#include <weft/IO/write_report_json_2.h>
#include <weft/planar/graph/insert_pslg.h>
#include <weft/planar/triangulation/Bounded_voronoi_diagram_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace mesh_2_program {

namespace {

/// The graph as the triangulation has it: segments meet at their ends only, as the local feature size wants it.
Pslg graph_of(const Cdt& cdt)
{
  Pslg graph;
  std::map<K::Point_2, std::size_t> number;
  for (const auto vertex : cdt.finite_vertex_handles()) {
    number.emplace(vertex->point(), graph.points.size());
    graph.points.push_back(vertex->point());
  }
  for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge)
    graph.segments.push_back({number.at(edge->first->vertex(Cdt::ccw(edge->second))->point()),
                              number.at(edge->first->vertex(Cdt::cw(edge->second))->point())});
  return graph;
}

/// A polygon without repeated corners, as there are where vertices are cocircular.
std::vector<K::Point_2> without_repetitions(std::vector<K::Point_2> polygon)
{
  polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
  while (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
  return polygon;
}

void draw_voronoi(const std::string& filename, const Cdt& cdt, const std::string& title)
{
  const weft::Bounded_voronoi_diagram_2<Cdt> diagram(cdt);
  std::vector<std::vector<K::Point_2>> cells;
  std::vector<K::Point_2> sites;
  for (const auto& cell : diagram.cells()) {
    sites.push_back(cell.site->point());
    for (const auto& polygon : cell.polygons) cells.push_back(without_repetitions(polygon));
  }
  std::vector<std::array<K::Point_2, 2>> walls;
  for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge)
    if (edge->first->is_in_domain() || edge->first->neighbor(edge->second)->is_in_domain())
      walls.push_back(
          {edge->first->vertex(Cdt::ccw(edge->second))->point(), edge->first->vertex(Cdt::cw(edge->second))->point()});
  weft::IO::write_voronoi_svg(filename, cells, sites, walls, title);
}

class Triangulated_domain : public Domain
{
public:
  Triangulated_domain(const Pslg& pslg, const Input_options& given)
  {
    CGAL::Bbox_2 box;
    for (const K::Point_2& p : pslg.points) box += p.bbox();
    const double width = box.xmax() - box.xmin(), height = box.ymax() - box.ymin();
    diagonal_ = std::hypot(width, height);
    weft::Pslg_options options;
    if (given.split_crossings) options.crossings = weft::Crossings::split;
    if (given.tolerance) options.tolerance = given.tolerance->in(diagonal_) / std::max(width, height);
    auto inserted = weft::insert_pslg(cdt_, pslg, options);
    tags_ = std::move(inserted.tags);
    notes_ = std::move(inserted.changes.notes);
    warnings_ = weft::mark_domain(cdt_, pslg).warnings;
    notes_.insert(notes_.end(), warnings_.begin(), warnings_.end());
  }

  const std::vector<std::string>& warnings() const override { return warnings_; }

  weft::Mesh_report_2 mesh(const Sizes& sizes, const weft::Mesh_options_2& options, bool keeps_input) override
  {
    sizing_ = sizing(sizes);
    if (keeps_input) input_ = cdt_;
    weft::Mesh_report_2 report = sizing_->make_mesh(cdt_, options);
    report.notes = notes_;
    return report;
  }

  weft::Angle_histogram angles() const override
  {
    return weft::measure_quality_2(cdt_).histogram<weft::Angle_histogram>("weft");
  }
  weft::Angle_histogram reference_angles(const std::function<bool(std::size_t)>& go_on) const override
  {
    Cdt reference = input_;
    const std::string name = "CGAL's Delaunay refinement";
    if (!sizing_->refine_by_cgal(reference, go_on)) return weft::Angle_histogram(name);
    return weft::measure_quality_2(reference).histogram<weft::Angle_histogram>(name);
  }

  void write_mesh(const std::string& filename) const override { weft::IO::write_mesh_2(filename, cdt_, tags_); }
  void draw_voronoi(const std::string& filename, const std::string& title) const override
  {
    mesh_2_program::draw_voronoi(filename, cdt_, title);
  }
  void write_report(const std::string& filename, const weft::Mesh_report_2& report) const override
  {
    weft::IO::write_report_json(filename, report, weft::measure_quality_2(cdt_), sizing_->measure(cdt_));
  }

private:
  std::unique_ptr<Sizing> sizing(const Sizes& sizes) const
  {
    if (sizes.lfs > 0) return lfs_sizing(graph_of(cdt_), sizes.lfs, sizes.min_size.in(diagonal_));
    const bool has_areas =
        std::any_of(tags_.regions.begin(), tags_.regions.end(), [](const auto& region) { return region.max_area > 0; });
    const double size = sizes.size.in(diagonal_);
    if (!sizes.field.empty()) return field_sizing(sizes.field, sizes.gradation, sizes.is_bounded ? size : HUGE_VAL);
    if (sizes.size_of_mark.empty() && !has_areas) return uniform_sizing(size);
    std::map<int, double> size_of_mark;
    for (const auto& [mark, length] : sizes.size_of_mark) size_of_mark[mark] = length.in(diagonal_);
    return region_sizing(cdt_, tags_, size, size_of_mark);
  }

  Cdt cdt_, input_;
  weft::Mesh_tags_2<K> tags_;
  std::vector<std::string> notes_, warnings_;
  double diagonal_ = 0;
  std::unique_ptr<Sizing> sizing_;
};

} // namespace

bool is_mesh_filename(const std::string& filename)
{
  return weft::IO::is_mesh_filename(filename);
}

std::unique_ptr<Domain> read_domain(const std::string& filename, const Input_options& options)
{
  return std::make_unique<Triangulated_domain>(weft::IO::read_pslg<K>(filename), options);
}

} // namespace mesh_2_program
