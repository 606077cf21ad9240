// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes what the mesher did and how good the mesh is as JSON (RFC 8259), by nlohmann's library "JSON for Modern C++",
// which whoever includes this header has to have: the CMake target nlohmann_json::nlohmann_json. The text is valid
// whatever the values are: numbers that aren't finite become null, strings are escaped, and bytes in them that aren't
// UTF-8 become U+FFFD. Numbers have as many digits as it takes to read the same number again, in any locale.

#ifndef WEFT_IO_WRITE_REPORT_JSON_2_H
#define WEFT_IO_WRITE_REPORT_JSON_2_H

#include <weft/IO/internal/Text_writer.h>
#include <weft/planar/mesh/quality_2.h>
#include <weft/planar/run/Improve_options_2.h>
#include <weft/report.h>

#include <nlohmann/json.hpp>

#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

using Json = nlohmann::ordered_json; // members stay in the order in which they are added

/// The text, ended by a newline. Bytes that aren't UTF-8 become U+FFFD.
inline std::string json_text(const Json& json)
{
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// What each stage took, in order.
inline Json stages_json(const std::vector<std::pair<std::string, double>>& stage_seconds)
{
  Json stages = Json::array();
  for (const auto& [stage, seconds] : stage_seconds) stages.push_back({{"name", stage}, {"seconds", seconds}});
  return stages;
}

inline Json to_json(const Mesh_report_2& r)
{
  return {{"ok", r.ok()},
          {"stop_reason", name(r.stop_reason)},
          {"input_vertices", r.input_vertices},
          {"vertices", r.vertices},
          {"constraint_steiner", r.constraint_steiner},
          {"interior_steiner", r.interior_steiner},
          {"triangles", r.triangles},
          {"smallest_angle", r.smallest_angle},
          {"largest_angle", r.largest_angle},
          {"largest_ratio", r.largest_ratio},
          {"oversized", r.oversized},
          {"below_min_angle", r.below_min_angle},
          {"at_input_angle", r.at_input_angle},
          {"batches", r.batches},
          {"sweeps", r.sweeps},
          {"flips", r.flips},
          {"moves", r.moves},
          {"put_back", r.put_back},
          {"notes", r.notes},
          {"polished", r.polished},
          {"stages", stages_json(r.stage_seconds)}};
}

inline Json to_json(const Angle_extreme_2& angle)
{
  return {{"degrees", angle.degrees}, {"triangle", angle.triangle}, {"corners", angle.corners}};
}

inline Json to_json(const Quality_2& q)
{
  return {{"triangles", q.triangles},
          {"vertices", q.vertices},
          {"area", q.area},
          {"smallest_angle", to_json(q.smallest_angle)},
          {"largest_angle", to_json(q.largest_angle)},
          {"mean_smallest_angle", q.mean_smallest_angle},
          {"largest_aspect_ratio", q.largest_aspect_ratio},
          {"mean_aspect_ratio", q.mean_aspect_ratio},
          {"smallest_radius_ratio", q.smallest_radius_ratio},
          {"mean_radius_ratio", q.mean_radius_ratio},
          {"shortest_edge", q.shortest_edge},
          {"longest_edge", q.longest_edge},
          {"angle_histogram", {{"bin_degrees", 180 / q.angles.size()}, {"counts", q.angles}}}};
}

inline Json to_json(const Sizing_quality_2::Ratios& r)
{
  return {{"elements", r.elements}, {"oversized", r.oversized}, {"largest_ratio", r.largest}, {"mean_ratio", r.mean}};
}

inline Json to_json(const Sizing_quality_2& q)
{
  return {{"triangles", to_json(q.triangles)},
          {"constrained_edges", to_json(q.constrained_edges)},
          {"ideal_triangles", q.ideal_triangles},
          {"relative_count", q.relative_count()}};
}

inline std::string report_json(const Mesh_report_2& report, const Quality_2& quality)
{
  Json json = to_json(report);
  json["quality"] = to_json(quality);
  return json_text(json);
}

inline std::string report_json(const Mesh_report_2& report, const Quality_2& quality, const Sizing_quality_2& sizing)
{
  Json json = to_json(report);
  json["quality"] = to_json(quality);
  json["sizing"] = to_json(sizing);
  return json_text(json);
}

/// Adds what reports of improved meshes have in common: notes, stages, and the quality before and after.
template <class Report>
void add_course(Json& json, const Report& r, const Json& before, const Json& after)
{
  json["notes"] = Json::array();
  for (const std::string& note : r.notes) json["notes"].push_back({{"note", note}});
  json["stages"] = stages_json(r.stage_seconds);
  json["before"] = before;
  json["after"] = after;
}

inline std::string report_json(const Improve_report_2& r)
{
  Json json = {{"ok", r.ok()},
               {"stop_reason", name(r.stop_reason)},
               {"inverted_before", r.inverted_before},
               {"inverted_after", r.inverted_after},
               {"below_min_angle", r.below_min_angle},
               {"at_input_angle", r.at_input_angle},
               {"input_bound", r.input_bound},
               {"moves", r.moves},
               {"flips", r.flips}};
  add_course(json, r, to_json(r.before), to_json(r.after));
  return json_text(json);
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
