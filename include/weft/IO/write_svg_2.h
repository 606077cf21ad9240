// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures as SVG files: a mesh coloured by the smallest angle of its triangles, the cells of a Voronoi diagram
// coloured by their number of sides, and (in write_angle_histogram_svg.h) the distribution of a mesh's angles.

#ifndef WEFT_IO_WRITE_SVG_2_H
#define WEFT_IO_WRITE_SVG_2_H

#include <weft/internal/cold.h>
#include <weft/IO/internal/Indexed_mesh_2.h>
#include <weft/IO/internal/Svg_canvas.h>
#include <weft/IO/write_angle_histogram_svg.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace weft {
namespace internal {

/// The three angles of a triangle in degrees, from points scaled so that no product overflows.
inline std::array<double, 3> angles(const Indexed_mesh_2& mesh, const Indexed_mesh_2::Triangle& triangle)
{
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &p = mesh.points[triangle.vertices[i]], &q = mesh.points[triangle.vertices[(i + 1) % 3]],
               &r = mesh.points[triangle.vertices[(i + 2) % 3]];
    double u[2] = {q[0] - p[0], q[1] - p[1]}, v[2] = {r[0] - p[0], r[1] - p[1]};
    for (double* w : {u, v}) {
      const double length = std::hypot(w[0], w[1]);
      w[0] /= length, w[1] /= length;
    }
    result[i] = std::atan2(std::abs(u[0] * v[1] - u[1] * v[0]), u[0] * v[0] + u[1] * v[1]) * 57.29577951308232;
  }
  return result;
}

inline Svg_frame frame_of(const std::vector<std::array<double, 2>>& points)
{
  Svg_frame frame;
  for (const auto& p : points) frame.include(p[0], p[1]);
  return frame;
}

/// Width of a thin line that leaves `n` elements on a drawing of the given size distinct.
inline double thin_stroke(const Svg_frame& frame, std::size_t n)
{
  const double element = std::sqrt(frame.width() * frame.height() / static_cast<double>(std::max<std::size_t>(n, 1)));
  return std::clamp(0.035 * element, 0.02, 1.2);
}

/// Colour bar from 0 to 60 degrees with a caption.
WEFT_COLD inline void draw_angle_legend(Svg_canvas& canvas, double left, double top, double width,
                                        const std::string& caption)
{
  constexpr int steps = 120;
  for (int i = 0; i < steps; ++i) // half a unit of overlap hides seams
    canvas.rectangle(left + i * width / steps, top, width / steps + (i + 1 < steps ? 0.5 : 0), 14,
                     "fill=\"" + colour((i + 0.5) / steps) + "\"");
  for (int degrees = 0; degrees <= 60; degrees += 10) {
    const double x = left + degrees * width / 60;
    canvas.line(x, top + 14, x, top + 19, Svg_canvas::stroke("#222222", 1));
    canvas.text(x, top + 34, 14, "middle", std::to_string(degrees) + "°");
  }
  canvas.text(left + width / 2, top - 8, 15, "middle", caption);
}

/// Triangles, one path per colour: far smaller files than one element each.
WEFT_COLD inline void draw_triangles(Svg_canvas& canvas, const Svg_frame& frame, const Indexed_mesh_2& mesh,
                                     double stroke)
{
  constexpr int shades = 120;
  std::map<int, std::vector<std::size_t>> of_shade;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto a = angles(mesh, mesh.triangles[t]);
    const double smallest = *std::min_element(a.begin(), a.end());
    of_shade[std::clamp(static_cast<int>(smallest / 60 * shades), 0, shades - 1)].push_back(t);
  }
  for (const auto& [shade, triangles] : of_shade) {
    canvas.begin_path("fill=\"" + colour((shade + 0.5) / shades) + "\" " + Svg_canvas::stroke("#34434f", stroke));
    for (const std::size_t t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto& p = mesh.points[mesh.triangles[t].vertices[i]];
        i == 0 ? canvas.move_to(frame.x(p[0]), frame.y(p[1])) : canvas.line_to(frame.x(p[0]), frame.y(p[1]));
      }
      canvas.close_loop();
    }
    canvas.end_path();
  }
}

/// One line about the mesh for below the picture.
WEFT_COLD inline std::string mesh_caption(const Indexed_mesh_2& mesh)
{
  double smallest = 180, largest = 0;
  for (const auto& triangle : mesh.triangles)
    for (const double a : angles(mesh, triangle)) smallest = std::min(smallest, a), largest = std::max(largest, a);
  std::string text =
      std::to_string(mesh.points.size()) + " vertices, " + std::to_string(mesh.triangles.size()) + " triangles";
  if (!mesh.triangles.empty()) text += ", angles from " + one_decimal(smallest) + "° to " + one_decimal(largest) + "°";
  return text;
}

/// Fill of a Voronoi cell by its number of sides: six is plain.
inline std::string cell_colour(std::size_t sides)
{
  switch (sides) {
  case 6:
    return "#f3f1e9";
  case 5:
    return "#9ecbe6";
  case 7:
    return "#f7b879";
  default:
    return sides < 5 ? "#3f7fb5" : "#c8553d";
  }
}

WEFT_COLD inline void draw_cell_legend(Svg_canvas& canvas, double left, double top)
{
  const std::array<const char*, 5> labels = {"≤ 4 sides", "5", "6", "7", "≥ 8"};
  double x = left;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    canvas.rectangle(x, top, 26, 16, "fill=\"" + cell_colour(i + 4) + "\" " + Svg_canvas::stroke("#34434f", 0.8));
    canvas.text(x + 33, top + 13, 15, "start", labels[i]);
    x += i == 0 ? 125 : 75;
  }
}

} // namespace internal

namespace IO {

/// Counts the angles of the faces in the domain.
/// \param name how the mesh is called in the picture.
template <class Cdt>
Angle_histogram angle_histogram(const Cdt& cdt, const std::string& name = "mesh", std::size_t bins = 60)
{
  const internal::Indexed_mesh_2 mesh = internal::indexed_mesh(cdt, {});
  Angle_histogram histogram(name, bins);
  for (const auto& triangle : mesh.triangles)
    for (const double angle : internal::angles(mesh, triangle)) histogram.add(angle);
  return histogram;
}

/// Draws the faces in the domain, each coloured by its smallest angle (0° to 60°), and constrained edges darker.
/// Lines get thinner with the number of triangles; y points up.
/// \param title printed above the mesh if not empty.
/// \throws File_error if the file can't be written.
template <class Cdt>
WEFT_COLD void write_svg(const std::string& filename, const Cdt& cdt, const std::string& title = "")
{
  const internal::Indexed_mesh_2 mesh = internal::indexed_mesh(cdt, {});
  internal::Svg_frame frame = internal::frame_of(mesh.points);
  if (mesh.points.empty()) frame.include(0, 0), frame.include(1, 0.1);
  const double legend_top = frame.height() + 2 * frame.margin + 30, width = std::max(frame.width(), 420.);
  const double shift = title.empty() ? 0 : 34, stroke = internal::thin_stroke(frame, mesh.triangles.size());

  internal::Svg_canvas canvas(filename, width + 2 * frame.margin, legend_top + 80 + shift);
  if (!title.empty()) canvas.text(frame.margin + width / 2, 30, 20, "middle", title);
  canvas.begin_group(0.5 * (width - frame.width()), shift);
  internal::draw_triangles(canvas, frame, mesh, stroke);
  canvas.begin_path("fill=\"none\" " + internal::Svg_canvas::stroke("#10161b", std::max(2.5 * stroke, 0.8)));
  for (const auto& edge : mesh.edges) {
    const auto &p = mesh.points[edge.vertices[0]], &q = mesh.points[edge.vertices[1]];
    canvas.move_to(frame.x(p[0]), frame.y(p[1]));
    canvas.line_to(frame.x(q[0]), frame.y(q[1]));
  }
  canvas.end_path();
  canvas.end_group();
  internal::draw_angle_legend(canvas, frame.margin + 0.5 * (width - 360), legend_top + shift, 360,
                              "smallest angle of each triangle");
  canvas.text(frame.margin + width / 2, legend_top + 62 + shift, 15, "middle", internal::mesh_caption(mesh));
  canvas.close();
}

/// Draws the cells of a Voronoi diagram, coloured by their number of sides.
/// \param cells the corners of each cell, in order.
/// \param sites drawn as dots; may be empty.
/// \param constraints drawn as heavy lines; may be empty.
/// \throws File_error if the file can't be written.
template <class Point>
WEFT_COLD void write_voronoi_svg(const std::string& filename, const std::vector<std::vector<Point>>& cells,
                                 const std::vector<Point>& sites = {},
                                 const std::vector<std::array<Point, 2>>& constraints = {},
                                 const std::string& title = "")
{
  internal::Svg_frame frame;
  const auto x = [&frame](const Point& p) { return frame.x(CGAL::to_double(p.x())); };
  const auto y = [&frame](const Point& p) { return frame.y(CGAL::to_double(p.y())); };
  const auto include = [&frame](const Point& p) { frame.include(CGAL::to_double(p.x()), CGAL::to_double(p.y())); };
  for (const auto& cell : cells) std::for_each(cell.begin(), cell.end(), include);
  std::for_each(sites.begin(), sites.end(), include);
  for (const auto& segment : constraints) std::for_each(segment.begin(), segment.end(), include);
  if (cells.empty() && sites.empty() && constraints.empty()) frame.include(0, 0), frame.include(1, 0.1);
  const double shift = title.empty() ? 0 : 34, width = std::max(frame.width(), 420.);
  const double stroke = 2 * internal::thin_stroke(frame, 2 * cells.size());

  internal::Svg_canvas canvas(filename, width + 2 * frame.margin, frame.height() + 2 * frame.margin + 40 + shift);
  if (!title.empty()) canvas.text(frame.margin + width / 2, 30, 20, "middle", title);
  canvas.begin_group(0.5 * (width - frame.width()), shift);
  std::map<std::string, std::vector<std::size_t>> of_colour;
  for (std::size_t c = 0; c < cells.size(); ++c) of_colour[internal::cell_colour(cells[c].size())].push_back(c);
  for (const auto& [fill, members] : of_colour) {
    canvas.begin_path("fill=\"" + fill + "\" " + internal::Svg_canvas::stroke("#34434f", stroke));
    for (const std::size_t c : members) {
      for (std::size_t i = 0; i < cells[c].size(); ++i)
        i == 0 ? canvas.move_to(x(cells[c][i]), y(cells[c][i])) : canvas.line_to(x(cells[c][i]), y(cells[c][i]));
      canvas.close_loop();
    }
    canvas.end_path();
  }
  canvas.begin_path("fill=\"none\" " + internal::Svg_canvas::stroke("#10161b", std::max(2 * stroke, 1.2)));
  for (const auto& [p, q] : constraints) canvas.move_to(x(p), y(p)), canvas.line_to(x(q), y(q));
  canvas.end_path();
  for (const auto& site : sites) canvas.circle(x(site), y(site), 1.6 * stroke);
  canvas.end_group();
  internal::draw_cell_legend(canvas, frame.margin + 0.5 * (width - 400),
                             frame.height() + 2 * frame.margin + 12 + shift);
  canvas.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_SVG_2_H
