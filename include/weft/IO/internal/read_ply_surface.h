// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads surfaces from PLY files, text or binary of either byte order: the coordinates of the vertices and the corners
// of the faces and triangle strips, and colours of faces as groups; all other elements and properties are passed over.

#ifndef WEFT_IO_INTERNAL_READ_PLY_SURFACE_H
#define WEFT_IO_INTERNAL_READ_PLY_SURFACE_H

#include <weft/IO/internal/Group_collector.h>
#include <weft/IO/internal/Ply_reader.h>
#include <weft/spatial/surface/Polygon_soup_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace weft::internal {

/// Reads one vertex.
template <class Point>
Point read_ply_point(Ply_reader& in, const Ply_element& element)
{
  std::array<double, 3> coordinates{};
  for (const Ply_property& property : element.properties) {
    const std::size_t count = property.is_list ? in.count(property.count_type) : 1;
    for (std::size_t i = 0; i < count; ++i) {
      const double value = in.value(property.type);
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
        coordinates[static_cast<std::size_t>(property.name[0] - 'x')] = value;
    }
  }
  return Point(coordinates[0], coordinates[1], coordinates[2]);
}

/// Reads the corners of one face, and the name of its colour, if it has one.
inline std::vector<std::size_t> read_ply_face(Ply_reader& in, const Ply_element& element, std::string& colour)
{
  std::vector<std::size_t> corners;
  std::array<double, 3> components{};
  double unit = 0;
  for (const Ply_property& property : element.properties) {
    if (const auto component = component_of_colour(property.name); component && !property.is_list) {
      components[*component] = in.value(property.type);
      unit = property.type == Ply_type::float32 || property.type == Ply_type::float64 ? 1 : 255;
      continue;
    }
    const bool is_corners = property.name == "vertex_indices" || property.name == "vertex_index";
    const std::size_t count = property.is_list ? in.count(property.count_type) : 1;
    for (std::size_t i = 0; i < count; ++i) {
      const double value = in.value(property.type);
      if (!is_corners) continue;
      if (!(value >= 0 && value < 1e15) || value != std::floor(value)) in.fail("a corner of a face is no point");
      corners.push_back(static_cast<std::size_t>(value));
    }
  }
  colour = unit > 0 ? name_of_colour(components, unit) : "";
  return corners;
}

/// Adds the triangles of strips, each of which ends with -1: of three corners in a row, every second one backwards.
inline void add_ply_strips(Ply_reader& in, const Ply_element& element, std::vector<std::vector<std::size_t>>& triangles)
{
  for (const Ply_property& property : element.properties) {
    const bool is_corners = property.name == "vertex_indices" || property.name == "vertex_index";
    const std::size_t count = property.is_list ? in.count(property.count_type) : 1;
    std::vector<std::size_t> strip;
    for (std::size_t i = 0; i < count; ++i) {
      const double value = in.value(property.type);
      if (!is_corners) continue;
      if (value == -1) {
        strip.clear();
        continue;
      }
      if (!(value >= 0 && value < 1e15) || value != std::floor(value)) in.fail("a corner of a strip is no point");
      strip.push_back(static_cast<std::size_t>(value));
      const std::size_t n = strip.size();
      if (n < 3) continue;
      const std::size_t a = strip[n - 3], b = strip[n - 2], c = strip[n - 1];
      if (a == b || b == c || c == a) continue; // a turn of the strip
      if (n % 2 == 1)
        triangles.push_back({a, b, c});
      else
        triangles.push_back({b, a, c});
    }
  }
}

/// Reads a PLY file.
template <class K>
Polygon_soup_3<K> read_ply_surface(const std::string& filename)
{
  Ply_reader in(filename);
  Polygon_soup_3<K> soup;
  Group_collector colours;
  std::string colour;
  for (const Ply_element& element : in.elements()) {
    if (element.properties.empty() && element.count > 0) in.fail("element '" + element.name + "' has no properties");
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    for (std::size_t i = 0; i < element.count; ++i) {
      const std::size_t facets = soup.polygons.size();
      colour.clear();
      if (is_vertex)
        soup.points.push_back(read_ply_point<typename K::Point_3>(in, element));
      else if (is_face)
        soup.polygons.push_back(read_ply_face(in, element, colour));
      else if (element.name == "tristrips")
        add_ply_strips(in, element, soup.polygons);
      else
        read_ply_point<typename K::Point_3>(in, element); // passed over
      in.end_element();
      if (soup.polygons.size() > facets) colours.enter(colour);
      for (std::size_t f = facets; f < soup.polygons.size(); ++f) colours.add_facet();
    }
  }
  in.require_end();
  colours.finish(soup);
  for (std::size_t f = 0; f < soup.polygons.size(); ++f)
    for (const std::size_t v : soup.polygons[f])
      if (v >= soup.points.size())
        in.fail("facet " + std::to_string(f) + " refers to point " + std::to_string(v) + ", which doesn't exist");
  return soup;
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_READ_PLY_SURFACE_H
