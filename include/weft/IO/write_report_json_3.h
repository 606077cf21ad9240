// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes what the spatial mesher did and how good the mesh is as JSON, in the manner of write_report_json_2.h, and by
// the same library.

#ifndef WEFT_IO_WRITE_REPORT_JSON_3_H
#define WEFT_IO_WRITE_REPORT_JSON_3_H

#include <weft/IO/write_report_json_2.h>
#include <weft/report.h>
#include <weft/spatial/domain/Voxel_components_3.h>
#include <weft/spatial/local/Improve_options_3.h>
#include <weft/spatial/mesh/quality_3.h>

#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace weft {
namespace internal {

inline Json to_json(const Unsatisfied_3& u)
{
  return {{"elements", u.elements},
          {"at_floor", u.at_floor},
          {"at_acute_edge", u.at_acute_edge},
          {"size", u.size},
          {"approximation", u.approximation},
          {"shape", u.shape},
          {"topology", u.topology},
          {"disk", u.disk},
          {"demand", u.demand}};
}

inline Json to_json(const Domain_comparison_3& c)
{
  Json subdomains = Json::array();
  for (const Subdomain_comparison_3& s : c.subdomains) {
    Json row = {{"subdomain", s.subdomain}, {"volume", s.volume},           {"components", s.components},
                {"euler", s.euler},         {"has_volume", s.has_volume()}, {"has_topology", s.has_topology()}};
    if (!std::isnan(s.expected_volume)) {
      row["expected_volume"] = s.expected_volume;
      row["allowed_difference"] = s.allowed_difference;
    }
    if (s.expected_components >= 0) {
      row["expected_components"] = s.expected_components;
      row["expected_euler"] = s.expected_euler;
    }
    subdomains.push_back(row);
  }
  return {{"ok", c.ok()},
          {"has_surface", c.has_surface()},
          {"has_volumes", c.has_volumes()},
          {"has_topology", c.has_topology()},
          {"samples", c.samples},
          {"missed_patch_samples", c.missed_patch_samples},
          {"missed_crease_samples", c.missed_crease_samples},
          {"missing_corners", c.missing_corners},
          {"tolerance", c.tolerance},
          {"largest_distance", c.largest_distance},
          {"subdomains", subdomains}};
}

inline Json to_json(const Given_comparison_3& c)
{
  if (!c.is_known) return nullptr;
  return {{"ok", c.ok()},
          {"area", c.area},
          {"missed_area", c.missed_area},
          {"missed_share", c.missed_share()},
          {"area_left_out", c.area_left_out},
          {"tolerance", c.tolerance},
          {"largest_distance", c.largest_distance}};
}

inline Json to_json(const Mesh_report_3& r)
{
  return {{"ok", r.ok()},
          {"stop_reason", name(r.stop_reason)},
          {"manifold", r.manifold},
          {"vertices", r.vertices},
          {"corner_vertices", r.corner_vertices},
          {"crease_vertices", r.crease_vertices},
          {"patch_vertices", r.patch_vertices},
          {"interior_vertices", r.interior_vertices},
          {"cells", r.cells},
          {"facets", r.facets},
          {"crease_edges", r.crease_edges},
          {"smallest_dihedral", r.smallest_dihedral},
          {"largest_dihedral", r.largest_dihedral},
          {"largest_facet_shape", r.largest_facet_shape},
          {"largest_cell_shape", r.largest_cell_shape},
          {"refined_smallest_dihedral", r.refined_smallest_dihedral},
          {"smoothed_smallest_dihedral", r.smoothed_smallest_dihedral},
          {"creases_given_up", r.creases_given_up},
          {"coarsened", r.coarsened},
          {"smoothing_sweeps", r.smoothing_sweeps},
          {"smoothing_moves", r.smoothing_moves},
          {"smoothing_locked", r.smoothing_locked},
          {"smoothing_rejected", r.smoothing_rejected},
          {"moved_in_place", r.moved_in_place},
          {"moved_one_by_one", r.moved_one_by_one},
          {"moved_by_rebuilding", r.moved_by_rebuilding},
          {"perturbed", r.perturbed},
          {"perturb_insertions", r.perturb_insertions},
          {"bad_edges", to_json(r.bad_edges)},
          {"bad_facets", to_json(r.bad_facets)},
          {"bad_cells", to_json(r.bad_cells)},
          {"forced_facets", r.forced_facets},
          {"forced_cells", r.forced_cells},
          {"bad_vertices", r.bad_vertices},
          {"bare_patches", r.bare_patches},
          {"domain", to_json(r.domain)},
          {"given", to_json(r.given)},
          {"batches", r.batches},
          {"candidates", r.candidates},
          {"encroachments", r.encroachments},
          {"segment_queries", r.segment_queries},
          {"location_queries", r.location_queries},
          {"skipped_queries", r.skipped_queries},
          {"stages", stages_json(r.stage_seconds)}};
}

/// \param element what the extreme is at: "cell" or "facet".
inline Json to_json(const Angle_extreme_3& angle, const char* element)
{
  return {{"degrees", angle.degrees}, {element, angle.element}, {"vertices", angle.vertices}};
}

inline Json to_json(const Quality_3& q)
{
  Json below = Json::object();
  for (const std::size_t degrees : {5u, 10u, 15u, 20u}) below[std::to_string(degrees)] = q.cells_below(degrees);
  return {{"cells", q.cells},
          {"vertices", q.vertices},
          {"facets", q.facets},
          {"volume", q.volume},
          {"boundary_area", q.boundary_area},
          {"smallest_dihedral", to_json(q.smallest_dihedral, "cell")},
          {"largest_dihedral", to_json(q.largest_dihedral, "cell")},
          {"mean_smallest_dihedral", q.mean_smallest_dihedral},
          {"cells_below", below},
          {"largest_radius_edge_ratio", q.largest_radius_edge_ratio},
          {"mean_radius_edge_ratio", q.mean_radius_edge_ratio},
          {"smallest_radius_ratio", q.smallest_radius_ratio},
          {"mean_radius_ratio", q.mean_radius_ratio},
          {"shortest_edge", q.shortest_edge},
          {"longest_edge", q.longest_edge},
          {"smallest_facet_angle", to_json(q.smallest_facet_angle, "facet")},
          {"largest_facet_angle", to_json(q.largest_facet_angle, "facet")},
          {"largest_facet_ratio", q.largest_facet_ratio},
          {"dihedral_histogram", {{"bin_degrees", 180 / Quality_3::bins}, {"counts", q.dihedrals}}}};
}

inline std::string report_json(const Improve_report_3& r)
{
  Json json = {{"ok", r.ok()},
               {"stop_reason", name(r.stop_reason)},
               {"manifold", r.manifold},
               {"inverted_before", r.inverted_before},
               {"inverted_after", r.inverted_after},
               {"unrepresented", r.unrepresented},
               {"boundary_bound", r.boundary_bound},
               {"moves", r.moves},
               {"insertions", r.insertions},
               {"removals", r.removals},
               {"flips", r.flips}};
  add_course(json, r, to_json(r.before), to_json(r.after));
  return json_text(json);
}

inline std::string report_json(const Mesh_report_3& report, const Quality_3& quality,
                               const std::vector<Voxel_component_3>* missing = nullptr)
{
  Json json = to_json(report);
  if (missing) {
    Json list = Json::array();
    for (const Voxel_component_3& c : *missing)
      list.push_back({{"label", c.label}, {"voxels", c.voxels}, {"volume", c.volume}, {"center", c.center}});
    json["missing_components"] = list;
    json["ok"] = report.ok() && missing->empty();
  }
  json["quality"] = to_json(quality);
  return json_text(json);
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

/// Writes the same object, of the mesh of an image, with the member "missing_components": the components of labels that
/// stayed out, as `missing_components_3()` has them, each with its label, the number and the volume of its voxels and
/// the center of one of them. Not "ok" if there are some.
/// \throws File_error if the file can't be written.
inline void write_report_json(const std::string& filename, const Mesh_report_3& report, const Quality_3& quality,
                              const std::vector<Voxel_component_3>& missing)
{
  internal::write_text_file(filename, internal::report_json(report, quality, &missing));
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
