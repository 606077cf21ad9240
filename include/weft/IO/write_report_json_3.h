// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes what the spatial mesher did and how good the mesh is as JSON, in the manner of write_report_json_2.h.

#ifndef WEFT_IO_WRITE_REPORT_JSON_3_H
#define WEFT_IO_WRITE_REPORT_JSON_3_H

#include <weft/IO/write_report_json_2.h>
#include <weft/report.h>
#include <weft/spatial/local/Improve_options_3.h>
#include <weft/spatial/mesh/quality_3.h>

#include <ostream>
#include <string>
#include <string_view>

namespace weft {
namespace internal {

inline void append_json(Json_text& json, std::string_view name, const Unsatisfied_3& u)
{
  json.begin_object(name).member("elements", u.elements).member("at_floor", u.at_floor);
  json.member("at_acute_edge", u.at_acute_edge);
  json.member("size", u.size).member("approximation", u.approximation).member("shape", u.shape);
  json.member("topology", u.topology).member("disk", u.disk).member("demand", u.demand).end();
}

inline void append_json(Json_text& json, const Mesh_report_3& r)
{
  json.member("ok", r.ok()).member("stop_reason", name(r.stop_reason)).member("manifold", r.manifold);
  json.member("vertices", r.vertices).member("corner_vertices", r.corner_vertices);
  json.member("crease_vertices", r.crease_vertices).member("patch_vertices", r.patch_vertices);
  json.member("interior_vertices", r.interior_vertices);
  json.member("cells", r.cells).member("facets", r.facets).member("crease_edges", r.crease_edges);
  json.member("smallest_dihedral", r.smallest_dihedral).member("largest_dihedral", r.largest_dihedral);
  json.member("largest_facet_shape", r.largest_facet_shape).member("largest_cell_shape", r.largest_cell_shape);
  json.member("refined_smallest_dihedral", r.refined_smallest_dihedral);
  json.member("smoothed_smallest_dihedral", r.smoothed_smallest_dihedral);
  json.member("creases_given_up", r.creases_given_up);
  json.member("coarsened", r.coarsened).member("smoothing_sweeps", r.smoothing_sweeps);
  json.member("smoothing_moves", r.smoothing_moves).member("smoothing_locked", r.smoothing_locked);
  json.member("smoothing_rejected", r.smoothing_rejected).member("moved_in_place", r.moved_in_place);
  json.member("moved_one_by_one", r.moved_one_by_one).member("moved_by_rebuilding", r.moved_by_rebuilding);
  json.member("perturbed", r.perturbed).member("perturb_insertions", r.perturb_insertions);
  append_json(json, "bad_edges", r.bad_edges);
  append_json(json, "bad_facets", r.bad_facets);
  append_json(json, "bad_cells", r.bad_cells);
  json.member("bad_vertices", r.bad_vertices).member("bare_patches", r.bare_patches);
  json.member("batches", r.batches).member("candidates", r.candidates).member("encroachments", r.encroachments);
  json.member("segment_queries", r.segment_queries).member("location_queries", r.location_queries);
  json.member("skipped_queries", r.skipped_queries);
  json.begin_array("stages");
  for (const auto& [stage, seconds] : r.stage_seconds)
    json.begin_object().member("name", stage).member("seconds", seconds).end();
  json.end();
}

inline void append_json(Json_text& json, std::string_view name, const Angle_extreme_3& angle, std::string_view element)
{
  json.begin_object(name).member("degrees", angle.degrees).member(element, angle.element);
  json.numbers("vertices", angle.vertices).end();
}

inline void append_json(Json_text& json, const Quality_3& q, std::string_view name = "quality")
{
  json.begin_object(name);
  json.member("cells", q.cells).member("vertices", q.vertices).member("facets", q.facets);
  json.member("volume", q.volume).member("boundary_area", q.boundary_area);
  append_json(json, "smallest_dihedral", q.smallest_dihedral, "cell");
  append_json(json, "largest_dihedral", q.largest_dihedral, "cell");
  json.member("mean_smallest_dihedral", q.mean_smallest_dihedral);
  json.begin_object("cells_below");
  for (const std::size_t degrees : {5u, 10u, 15u, 20u}) json.member(std::to_string(degrees), q.cells_below(degrees));
  json.end();
  json.member("largest_radius_edge_ratio", q.largest_radius_edge_ratio);
  json.member("mean_radius_edge_ratio", q.mean_radius_edge_ratio);
  json.member("smallest_radius_ratio", q.smallest_radius_ratio).member("mean_radius_ratio", q.mean_radius_ratio);
  json.member("shortest_edge", q.shortest_edge).member("longest_edge", q.longest_edge);
  append_json(json, "smallest_facet_angle", q.smallest_facet_angle, "facet");
  append_json(json, "largest_facet_angle", q.largest_facet_angle, "facet");
  json.member("largest_facet_ratio", q.largest_facet_ratio);
  json.begin_object("dihedral_histogram").member("bin_degrees", 180 / Quality_3::bins);
  json.numbers("counts", q.dihedrals).end();
  json.end();
}

inline std::string report_json(const Improve_report_3& r)
{
  Json_text json;
  json.begin_object().member("ok", r.ok()).member("stop_reason", name(r.stop_reason)).member("manifold", r.manifold);
  json.member("inverted_before", r.inverted_before).member("inverted_after", r.inverted_after);
  json.member("unrepresented", r.unrepresented).member("boundary_bound", r.boundary_bound);
  json.member("moves", r.moves).member("insertions", r.insertions).member("removals", r.removals);
  json.member("flips", r.flips);
  append_course(json, r);
  json.end();
  return json.text() + "\n";
}

inline std::string report_json(const Mesh_report_3& report, const Quality_3& quality)
{
  Json_text json;
  json.begin_object();
  append_json(json, report);
  append_json(json, quality);
  json.end();
  return json.text() + "\n";
}

} // namespace internal

namespace IO {

/// Writes one JSON object: the members of the report, and the quality of the mesh with the histogram of its dihedral
/// angles as the member "quality".
inline void write_report_json(std::ostream& out, const Mesh_report_3& report, const Quality_3& quality)
{
  out << internal::report_json(report, quality);
}

/// Writes the same object to a file.
/// \throws File_error if the file can't be written.
inline void write_report_json(const std::string& filename, const Mesh_report_3& report, const Quality_3& quality)
{
  internal::write_text_file(filename, internal::report_json(report, quality));
}

/// Writes what `improve_3()` did, with the quality of the mesh before and after as members "before" and "after".
/// \throws File_error if the file can't be written.
inline void write_report_json(const std::string& filename, const Improve_report_3& report)
{
  internal::write_text_file(filename, internal::report_json(report));
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_REPORT_JSON_3_H
