// SPDX-License-Identifier: GPL-3.0-or-later
//
// What adaptation in the plane takes and gives beside a mesh made at once: a graded field that shrinks in a tenth of
// the domain, a uniform one that does, ten steps of a field that moves, and ten in which it grows everywhere by 4 %.
//
//   adaptation_2 [--triangles N]

#include "../common/program.h"
#include "../common/table.h"
#include "../common/user_time.h"
#include "planar_inputs.h"

#include <weft/adapt_2.h>
#include <weft/planar/graph/insert_pslg.h>
#include <weft/planar/mesh/quality_2.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

using namespace benchmark;

namespace {

using Cdt = weft::Mesh_triangulation_2<Kernel>;
using Field = std::function<double(const Point&)>;

Cdt triangulation_of(const Planar_input& input)
{
  Cdt cdt;
  weft::insert_pslg(cdt, input.pslg);
  weft::mark_domain_by_parity(cdt);
  return cdt;
}

/// The domain's bounding box, and what sizes have to be for so many triangles.
struct Scale
{
  CGAL::Bbox_2 box;
  double size;
};

Scale scale_of(const Planar_input& input, double triangles)
{
  const Cdt cdt = triangulation_of(input);
  Scale scale{{}, 0};
  double area = 0;
  for (const auto f : cdt.finite_face_handles()) {
    if (!f->is_in_domain()) continue;
    area += CGAL::area(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point());
    for (int i = 0; i < 3; ++i) scale.box += f->vertex(i)->point().bbox();
  }
  scale.size = std::sqrt(4 * area / std::sqrt(3.) / triangles);
  return scale;
}

/// From `inside` in a disk of that radius to `outside`, growing by half of the distance.
Field field_around(const Point& center, double radius, double inside, double outside)
{
  return [=](const Point& p) {
    const double away = std::sqrt(CGAL::squared_distance(p, center)) - radius;
    return std::min(outside, inside + 0.5 * std::max(0., away));
  };
}

/// The fields of each case, one after the other; the mesh is made for the first.
std::vector<std::pair<std::string, std::vector<Field>>> cases(const Scale& scale)
{
  const CGAL::Bbox_2& b = scale.box;
  const auto at = [&b](double x, double y) {
    return Point(b.xmin() + x * (b.xmax() - b.xmin()), b.ymin() + y * (b.ymax() - b.ymin()));
  };
  const double s = scale.size, extent = std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin());
  const Field graded = [=](const Point& p) {
    return s * (1 + 0.5 * std::sqrt(CGAL::squared_distance(p, at(0.3, 0.6))) / extent);
  };
  const Field spot = field_around(at(0.7, 0.4), 0.12 * extent, 0.7 * s, HUGE_VAL);
  const Field shrunk = [=](const Point& p) { return std::min(graded(p), spot(p)); };
  std::vector<Field> moving, growing;
  for (int k = 0; k <= 10; ++k) {
    moving.push_back(field_around(at(0.2 + 0.06 * k, 0.5), 0.05 * extent, s, 4 * s));
    growing.push_back([=](const Point& p) { return graded(p) * std::pow(1.04, k); });
  }
  return {{"graded, a tenth shrinks", {graded, shrunk}},
          {"uniform, a tenth shrinks",
           {[s](const Point&) { return s; }, field_around(at(0.7, 0.4), 0.12 * extent, 0.7 * s, s)}},
          {"ten steps of a field that moves", moving},
          {"ten times 4 % more everywhere", growing}};
}

/// Edges of the domain below 0.4 of the field, in percent.
double short_edges(const Cdt& cdt, const Field& field)
{
  std::size_t all = 0, count = 0;
  for (const auto& e : cdt.finite_edges()) {
    if (!e.first->is_in_domain() && !e.first->neighbor(e.second)->is_in_domain()) continue;
    const Point &p = e.first->vertex(Cdt::cw(e.second))->point(), &q = e.first->vertex(Cdt::ccw(e.second))->point();
    ++all;
    count += std::sqrt(CGAL::squared_distance(p, q)) < 0.4 * field(CGAL::midpoint(p, q));
  }
  return 100. * static_cast<double>(count) / static_cast<double>(all);
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("adaptation_2", [&] {
    double triangles = 20000;
    for (Argument_reader a(argc, argv); a.next();)
      if (a.is("--triangles"))
        triangles = a.positive();
      else
        a.operand();
    std::cout << markdown_head({"input", "case", "ok", "vertices, at once", "adapted / at once", "user s / at once",
                                "smallest angle, at once", "adapted", "short edges, at once, %", "adapted, %"});
    for (const Planar_input& input : planar_inputs())
      for (const auto& [name, fields] : cases(scale_of(input, triangles))) {
        Cdt cdt = triangulation_of(input), anew = triangulation_of(input);
        weft::make_mesh_2(cdt, fields.front());
        bool ok = true;
        double seconds = 0; // of the last step
        for (std::size_t k = 1; k < fields.size(); ++k) {
          const Stopwatch watch;
          ok = weft::adapt_2(cdt, fields[k]).ok() && ok;
          seconds = watch.seconds();
        }
        const Stopwatch watch;
        weft::make_mesh_2(anew, fields.back());
        const double at_once = watch.seconds();
        const auto before = weft::measure_quality_2(anew), after = weft::measure_quality_2(cdt);
        std::cout << markdown_row({input.name, name, ok ? "yes" : "no", std::to_string(before.vertices),
                                   text(static_cast<double>(after.vertices) / static_cast<double>(before.vertices), 3),
                                   text(seconds / at_once, 2), text(before.smallest_angle.degrees, 1),
                                   text(after.smallest_angle.degrees, 1), text(short_edges(anew, fields.back()), 2),
                                   text(short_edges(cdt, fields.back()), 2)});
      }
  });
}
