// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures of the slivers in a mesh, and of its dihedral angles, at every stage of optimisation (as figures 3.6, 3.8
// and 3.12 of Tournois 2009): refined; refined and smoothed by Lloyd's iteration; by Natural ODT; and by the
// whole of make_mesh_3(), perturbation last. The boundary is drawn as glass, cells with small dihedral angles in red
// inside. One SVG file.
//
//   sliver_pictures [--below DEG] [--target DEG] [--limit SECONDS] [--sweeps N] [--size L] [--approximation E]
//                   [--sharp-angle DEG] [--azimuth DEG] [--elevation DEG] [--output FILE.svg] FILE
//
// The surface is scaled to a longest side of 1. --below: angle of what counts as a sliver, 10 unless given. --target:
// of the perturbation, 20; --limit: wall time of make_mesh_3(), 60. --sweeps: of smoothing, 100. --azimuth,
// --elevation: of the view.

#include "../common/program.h"
#include "../common/table.h"
#include "../spatial/spatial_inputs.h"

#include <weft/errors.h>
#include <weft/IO/internal/Svg_canvas.h>
#include <weft/IO/write_angle_histogram_svg.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/optimise/smooth_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>
#include <vector>

using namespace benchmark;

namespace {

using Mesh = weft::Tetrahedral_mesh_3<Spatial_kernel>;
using Oracle = weft::Polyhedral_oracle_3<Spatial_kernel>;
using Restricted = weft::Restricted_delaunay_3<Oracle>;
using Point = Spatial_kernel::Point_3;
using weft::internal::Svg_canvas;

const double degree = std::acos(-1.) / 180;

/// Options by name, all of them numbers.
struct Arguments
{
  std::map<std::string, double> numbers{{"below", 10},      {"target", 20},  {"limit", 60},
                                        {"sweeps", 100},    {"size", 0.1},   {"approximation", 0.001},
                                        {"sharp-angle", 0}, {"azimuth", 30}, {"elevation", 15}};
  std::string output = "slivers.svg", file;

  double operator[](const std::string& name) const { return numbers.at(name); }
};

Arguments parse(int argc, char** argv)
{
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const std::string arg = argv[i], name = arg.substr(std::min<std::size_t>(2, arg.size()));
    if (arg.rfind("--", 0) != 0) {
      a.file = arg;
      continue;
    }
    if (i + 1 == argc) throw weft::Option_error(arg + " needs a value");
    const std::string value = argv[++i];
    char* end = nullptr;
    if (name == "output") {
      a.output = value;
    } else if (a.numbers.count(name) > 0) {
      a.numbers[name] = std::strtod(value.c_str(), &end);
      if (value.empty() || *end) throw weft::Option_error(arg + " needs a number, not " + value);
    } else {
      throw weft::Option_error("unknown option " + arg);
    }
  }
  if (a.file.empty()) throw weft::Option_error("needs a surface file");
  return a;
}

struct Stage_picture
{
  std::string name;
  Mesh mesh;
};

weft::Criteria_3<Spatial_kernel> criteria_of(const Arguments& a)
{
  weft::Criteria_3<Spatial_kernel> criteria;
  criteria.size = a["size"];
  criteria.approximation = a["approximation"];
  criteria.topology = a["sharp-angle"] > 0;
  return criteria;
}

std::vector<Stage_picture> make_stages(const Oracle& oracle, const Arguments& a)
{
  const auto criteria = criteria_of(a);
  const auto refined = [&] {
    return weft::make_mesh_3(oracle, criteria, weft::Mesh_options_3::refinement()).restricted;
  };
  weft::Smooth_options_3 smoothing;
  smoothing.keep_criteria = false;
  smoothing.max_sweeps = static_cast<int>(a["sweeps"]);
  std::vector<Stage_picture> stages;
  Restricted lloyd = refined();
  stages.push_back({"refined", weft::tetrahedral_mesh(lloyd)});
  weft::smooth_3(lloyd, criteria, smoothing, weft::Lloyd_3());
  stages.push_back({"and smoothed, Lloyd", weft::tetrahedral_mesh(lloyd)});
  Restricted mesh = refined();
  weft::smooth_3(mesh, criteria, smoothing);
  stages.push_back({"and smoothed, Natural ODT", weft::tetrahedral_mesh(mesh)});
  weft::Mesh_options_3 options;
  options.min_dihedral_angle = a["target"];
  options.time_limit = a["limit"];
  stages.push_back({"make_mesh_3 as it is: perturbed",
                    weft::tetrahedral_mesh(weft::make_mesh_3(oracle, criteria, options).restricted)});
  return stages;
}

// ---- Drawing

/// Sees a mesh from far away.
class Camera
{
public:
  Camera(const Arguments& a)
      : cos_azimuth_(std::cos(a["azimuth"] * degree)),
        sin_azimuth_(std::sin(a["azimuth"] * degree)),
        cos_elevation_(std::cos(a["elevation"] * degree)),
        sin_elevation_(std::sin(a["elevation"] * degree))
  {}

  /// To the right, up, and towards the viewer; the y axis points up.
  std::array<double, 3> operator()(const Point& p) const
  {
    const double x = cos_azimuth_ * p.x() + sin_azimuth_ * p.z(), z = cos_azimuth_ * p.z() - sin_azimuth_ * p.x();
    return {x, cos_elevation_ * p.y() - sin_elevation_ * z, cos_elevation_ * z + sin_elevation_ * p.y()};
  }

private:
  double cos_azimuth_, sin_azimuth_, cos_elevation_, sin_elevation_;
};

struct Drawn_triangle
{
  std::array<std::array<double, 3>, 3> corners;

  double depth() const { return corners[0][2] + corners[1][2] + corners[2][2]; }
  bool faces_viewer() const { return area() > 0; }
  double area() const
  {
    const auto &a = corners[0], &b = corners[1], &c = corners[2];
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
};

class Drawing
{
public:
  Drawing(const std::string& filename, const std::string& title, const std::vector<Stage_picture>& stages,
          const Arguments& a)
      : camera_(a), below_(a["below"])
  {
    for (const Point& p : stages[0].mesh.points)
      for (std::size_t k = 0; k < 2; ++k) {
        low_[k] = std::min(low_[k], camera_(p)[k]);
        high_[k] = std::max(high_[k], camera_(p)[k]);
      }
    const double n = static_cast<double>(stages.size());
    Svg_canvas canvas(filename, n * pitch + 20, body_top + body_height() + histogram_height + 130);
    canvas.text(20, 34, 20, "start", title, "font-weight=\"bold\"");
    most_ = most_common(stages);
    for (std::size_t i = 0; i < stages.size(); ++i) draw(canvas, stages[i], 10 + pitch * static_cast<double>(i));
    canvas.close();
  }

private:
  static constexpr double pitch = 350, width = 330, body_top = 100, histogram_height = 150;

  double scale() const { return width / (high_[0] - low_[0]); }
  double body_height() const { return scale() * (high_[1] - low_[1]); }

  static weft::Angle_histogram histogram(const Stage_picture& stage)
  {
    return weft::measure_quality_3(stage.mesh).histogram<weft::Angle_histogram>(stage.name, 60);
  }

  static double most_common(const std::vector<Stage_picture>& stages)
  {
    double most = 0;
    for (const Stage_picture& s : stages)
      for (const double share : weft::internal::shares(histogram(s))) most = std::max(most, share);
    return most;
  }

  void draw(Svg_canvas& canvas, const Stage_picture& stage, double left) const
  {
    const weft::Quality_3 q = weft::measure_quality_3(stage.mesh);
    const auto slivers = static_cast<double>(q.cells_below(static_cast<std::size_t>(below_)));
    canvas.text(left + 10, 62, 16, "start", stage.name);
    canvas.text(left + 10, 84, 14, "start",
                text(slivers, 0) + " of " + text(static_cast<double>(stage.mesh.cells.size()), 0) + " cells below " +
                    text(below_, 0) + "°");
    draw_body(canvas, stage.mesh, left);
    weft::internal::Histogram_axes axes;
    axes.left = left + 10, axes.width = width - 20;
    axes.top = body_top + body_height() + 50, axes.height = histogram_height;
    axes.most = most_;
    weft::internal::draw_bars(canvas, axes, histogram(stage), "#3168a8", 0, 1);
    canvas.line(axes.left, axes.y(0), axes.left + axes.width, axes.y(0), Svg_canvas::stroke("#222222", 1));
    for (int angle = 0; angle <= 180; angle += 30)
      canvas.text(axes.x(angle), axes.y(0) + 20, 13, "middle", text(angle, 0) + "°");
    canvas.text(left + width / 2, axes.y(0) + 44, 14, "middle",
                "dihedral angles " + text(q.smallest_dihedral.degrees, 1) + "° to " +
                    text(q.largest_dihedral.degrees, 1) + "°");
  }

  /// Slivers first, then the facets of the boundary that face the viewer, as glass: far ones before near ones.
  void draw_body(Svg_canvas& canvas, const Mesh& mesh, double left) const
  {
    std::vector<Drawn_triangle> slivers, glass;
    for (const auto& f : mesh.facets) add(mesh, f[0], f[1], f[2], glass);
    const double cosine = std::cos(below_ * degree);
    for (const auto& c : mesh.cells) {
      const auto& p = mesh.points;
      if (weft::internal::cosine_of_smallest_dihedral(p[c[0]], p[c[1]], p[c[2]], p[c[3]]) <= cosine) continue;
      add(mesh, c[1], c[2], c[3], slivers);
      add(mesh, c[0], c[3], c[2], slivers);
      add(mesh, c[0], c[1], c[3], slivers);
      add(mesh, c[0], c[2], c[1], slivers);
    }
    draw_triangles(canvas, glass, left, "fill=\"#f3f5f7\" stroke=\"#9aa4ae\" stroke-width=\"0.35\"");
    draw_triangles(canvas, slivers, left,
                   "fill=\"#d7301f\" fill-opacity=\"0.75\" stroke=\"#7f0000\" stroke-width=\"0.3\"");
  }

  void add(const Mesh& mesh, std::size_t a, std::size_t b, std::size_t c, std::vector<Drawn_triangle>& to) const
  {
    const Drawn_triangle t{{camera_(mesh.points[a]), camera_(mesh.points[b]), camera_(mesh.points[c])}};
    if (t.faces_viewer()) to.push_back(t);
  }

  void draw_triangles(Svg_canvas& canvas, std::vector<Drawn_triangle>& triangles, double left,
                      const std::string& attributes) const
  {
    std::stable_sort(triangles.begin(), triangles.end(),
                     [](const Drawn_triangle& a, const Drawn_triangle& b) { return a.depth() < b.depth(); });
    for (const Drawn_triangle& t : triangles) {
      canvas.begin_path(attributes);
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = left + scale() * (t.corners[k][0] - low_[0]),
                     y = body_top + scale() * (high_[1] - t.corners[k][1]);
        k == 0 ? canvas.move_to(x, y) : canvas.line_to(x, y);
      }
      canvas.close_loop();
      canvas.end_path();
    }
  }

  Camera camera_;
  double below_, most_ = 1;
  std::array<double, 2> low_{HUGE_VAL, HUGE_VAL}, high_{-HUGE_VAL, -HUGE_VAL};
};

void run(const Arguments& a)
{
  const Spatial_input input = read_input(a.file, a["sharp-angle"]);
  const Oracle oracle(input.complex);
  const std::vector<Stage_picture> stages = make_stages(oracle, a);
  Drawing(a.output, input.name + ": cells below " + text(a["below"], 0) + "° and dihedral angles", stages, a);
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("sliver_pictures", [&] { run(parse(argc, argv)); });
}
