// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes what the mesher did and how good the mesh is as JSON (RFC 8259). The text is valid whatever the values are:
// numbers that aren't finite become null, strings are escaped, and bytes in them that aren't UTF-8 become U+FFFD.

#ifndef WEFT_IO_WRITE_REPORT_JSON_2_H
#define WEFT_IO_WRITE_REPORT_JSON_2_H

#include <weft/IO/internal/Text_writer.h>
#include <weft/planar/mesh/quality_2.h>
#include <weft/planar/run/Improve_options_2.h>
#include <weft/report.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>

namespace weft {
namespace internal {

/// Length of the UTF-8 sequence at the start of a text that isn't empty, 0 if there is no valid one.
inline std::size_t utf8_length(std::string_view text)
{
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto follows = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xBF) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return follows(1) ? 2 : 0;
  // The second byte's range leaves out overlong forms, surrogates and what is beyond U+10FFFF.
  if (lead >= 0xE0 && lead <= 0xEF)
    return follows(1, lead == 0xE0 ? 0xA0 : 0x80, lead == 0xED ? 0x9F : 0xBF) && follows(2) ? 3 : 0;
  if (lead >= 0xF0 && lead <= 0xF4)
    return follows(1, lead == 0xF0 ? 0x90 : 0x80, lead == 0xF4 ? 0x8F : 0xBF) && follows(2) && follows(3) ? 4 : 0;
  return 0;
}

/// Builds a JSON text of nested objects and arrays, indented.
class Json_text
{
public:
  /// Opens the outermost object, or one that is an element of an array.
  Json_text& begin_object() { return begin("", '{', '}'); }
  Json_text& begin_object(std::string_view name) { return begin(name, '{', '}'); }
  Json_text& begin_array(std::string_view name) { return begin(name, '[', ']'); }
  Json_text& end()
  {
    const char closing = open_.back();
    open_.pop_back();
    if (!first_) new_line();
    first_ = false;
    text_ += closing;
    return *this;
  }

  /// A member of the innermost object.
  template <class Value>
  Json_text& member(std::string_view name, const Value& value)
  {
    start(name);
    append(value);
    return *this;
  }

  /// A member that is an array of numbers on one line.
  template <class Numbers>
  Json_text& numbers(std::string_view name, const Numbers& values)
  {
    start(name);
    append_list(values);
    return *this;
  }

  const std::string& text() const { return text_; }

private:
  Json_text& begin(std::string_view name, char opening, char closing)
  {
    start(name);
    text_ += opening;
    open_ += closing;
    first_ = true;
    return *this;
  }

  void start(std::string_view name)
  {
    if (!first_) text_ += ',';
    if (!open_.empty()) new_line();
    first_ = false;
    if (name.empty()) return;
    append(name);
    text_ += ": ";
  }

  void new_line() { text_.append(1, '\n').append(2 * open_.size(), ' '); }

  void append(bool value) { text_ += value ? "true" : "false"; }
  void append(const char* value) { append(std::string_view(value)); }

  template <class Number>
  std::enable_if_t<std::is_arithmetic_v<Number>> append(Number value)
  {
    if constexpr (std::is_floating_point_v<Number>)
      if (!std::isfinite(value)) {
        text_ += "null";
        return;
      }
    char digits[40];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }

  template <class Numbers>
  void append_list(const Numbers& values)
  {
    const char* separator = "[";
    for (const auto& value : values) {
      text_ += separator;
      if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
        append(value);
      else
        append_list(value);
      separator = ", ";
    }
    text_ += values.empty() ? "[]" : "]";
  }

  void append(const std::string& value) { append(std::string_view(value)); }
  void append(std::string_view value)
  {
    text_ += '"';
    while (!value.empty()) {
      const std::size_t length = utf8_length(value);
      if (length == 0)
        text_ += "\xEF\xBF\xBD";
      else if (length == 1)
        append_escaped(value.front());
      else
        text_ += value.substr(0, length);
      value.remove_prefix(length == 0 ? 1 : length);
    }
    text_ += '"';
  }

  void append_escaped(char c)
  {
    constexpr char hex[] = "0123456789abcdef";
    if (c == '"' || c == '\\')
      (text_ += '\\') += c;
    else if (static_cast<unsigned char>(c) < 0x20)
      ((text_ += "\\u00") += hex[c >> 4]) += hex[c & 15];
    else
      text_ += c;
  }

  std::string text_, open_; // `open_`: what closes the objects and arrays that are open
  bool first_ = true;
};

inline void append_json(Json_text& json, const Mesh_report_2& r)
{
  json.member("ok", r.ok()).member("stop_reason", name(r.stop_reason));
  json.member("input_vertices", r.input_vertices).member("vertices", r.vertices);
  json.member("constraint_steiner", r.constraint_steiner).member("interior_steiner", r.interior_steiner);
  json.member("triangles", r.triangles);
  json.member("smallest_angle", r.smallest_angle).member("largest_angle", r.largest_angle);
  json.member("largest_ratio", r.largest_ratio).member("oversized", r.oversized);
  json.member("below_min_angle", r.below_min_angle).member("at_input_angle", r.at_input_angle);
  json.member("batches", r.batches).member("sweeps", r.sweeps).member("flips", r.flips);
  json.member("moves", r.moves).member("put_back", r.put_back).member("polished", r.polished);
  json.begin_array("notes");
  for (const std::string& note : r.notes) json.begin_object().member("note", note).end();
  json.end();
  json.begin_array("stages");
  for (const auto& [stage, seconds] : r.stage_seconds)
    json.begin_object().member("name", stage).member("seconds", seconds).end();
  json.end();
}

inline void append_json(Json_text& json, std::string_view name, const Angle_extreme_2& angle)
{
  json.begin_object(name).member("degrees", angle.degrees).member("triangle", angle.triangle);
  json.numbers("corners", angle.corners).end();
}

inline void append_json(Json_text& json, const Quality_2& q, std::string_view name = "quality")
{
  json.begin_object(name);
  json.member("triangles", q.triangles).member("vertices", q.vertices).member("area", q.area);
  append_json(json, "smallest_angle", q.smallest_angle);
  append_json(json, "largest_angle", q.largest_angle);
  json.member("mean_smallest_angle", q.mean_smallest_angle);
  json.member("largest_aspect_ratio", q.largest_aspect_ratio).member("mean_aspect_ratio", q.mean_aspect_ratio);
  json.member("smallest_radius_ratio", q.smallest_radius_ratio).member("mean_radius_ratio", q.mean_radius_ratio);
  json.member("shortest_edge", q.shortest_edge).member("longest_edge", q.longest_edge);
  json.begin_object("angle_histogram").member("bin_degrees", 180 / q.angles.size()).numbers("counts", q.angles).end();
  json.end();
}

inline void append_json(Json_text& json, std::string_view name, const Sizing_quality_2::Ratios& r)
{
  json.begin_object(name).member("elements", r.elements).member("oversized", r.oversized);
  json.member("largest_ratio", r.largest).member("mean_ratio", r.mean).end();
}

inline void append_json(Json_text& json, const Sizing_quality_2& q)
{
  json.begin_object("sizing");
  append_json(json, "triangles", q.triangles);
  append_json(json, "constrained_edges", q.constrained_edges);
  json.member("ideal_triangles", q.ideal_triangles).member("relative_count", q.relative_count()).end();
}

/// The report's members with one object for each of the measures, ended by a newline.
template <class... Measures>
std::string report_json(const Mesh_report_2& report, const Measures&... measures)
{
  Json_text json;
  json.begin_object();
  append_json(json, report);
  (append_json(json, measures), ...);
  json.end();
  return json.text() + "\n";
}

/// What reports of improved meshes have in common: notes, stages, and the quality before and after.
template <class Report>
void append_course(Json_text& json, const Report& r)
{
  json.begin_array("notes");
  for (const std::string& note : r.notes) json.begin_object().member("note", note).end();
  json.end().begin_array("stages");
  for (const auto& [stage, seconds] : r.stage_seconds)
    json.begin_object().member("name", stage).member("seconds", seconds).end();
  json.end();
  append_json(json, r.before, "before");
  append_json(json, r.after, "after");
}

inline std::string report_json(const Improve_report_2& r)
{
  Json_text json;
  json.begin_object().member("ok", r.ok()).member("stop_reason", name(r.stop_reason));
  json.member("inverted_before", r.inverted_before).member("inverted_after", r.inverted_after);
  json.member("below_min_angle", r.below_min_angle).member("at_input_angle", r.at_input_angle);
  json.member("input_bound", r.input_bound).member("moves", r.moves).member("flips", r.flips);
  append_course(json, r);
  json.end();
  return json.text() + "\n";
}

inline void write_text_file(const std::string& filename, const std::string& text)
{
  Text_writer out(filename);
  out << text;
  out.close();
}

} // namespace internal

namespace IO {

/// Writes one JSON object: the members of the report, and the quality of the mesh with its angle histogram as the
/// member "quality".
inline void write_report_json(std::ostream& out, const Mesh_report_2& report, const Quality_2& quality)
{
  out << internal::report_json(report, quality);
}

/// The same, and how well the mesh keeps to its sizing field as the member "sizing".
inline void write_report_json(std::ostream& out, const Mesh_report_2& report, const Quality_2& quality,
                              const Sizing_quality_2& sizing)
{
  out << internal::report_json(report, quality, sizing);
}

/// Writes the same object to a file.
/// \throws File_error if the file can't be written.
inline void write_report_json(const std::string& filename, const Mesh_report_2& report, const Quality_2& quality)
{
  internal::write_text_file(filename, internal::report_json(report, quality));
}

/// Writes the same object to a file.
/// \throws File_error if the file can't be written.
inline void write_report_json(const std::string& filename, const Mesh_report_2& report, const Quality_2& quality,
                              const Sizing_quality_2& sizing)
{
  internal::write_text_file(filename, internal::report_json(report, quality, sizing));
}

/// Writes what `improve_2()` did, with the quality of the mesh before and after as members "before" and "after".
/// \throws File_error if the file can't be written.
inline void write_report_json(const std::string& filename, const Improve_report_2& report)
{
  internal::write_text_file(filename, internal::report_json(report));
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_REPORT_JSON_2_H
