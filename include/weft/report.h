// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a mesher did: counts, worst elements, which criteria hold, why it stopped and where the time went.

#ifndef WEFT_REPORT_H
#define WEFT_REPORT_H

#include <weft/Domain_comparison_3.h>
#include <weft/internal/cold.h>
#include <weft/internal/counted.h>
#include <weft/visitor.h>

#include <cstddef>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// Result of `make_mesh_2()` and `relax_2()`.
struct Mesh_report_2
{
  std::size_t input_vertices = 0;     ///< vertices before
  std::size_t vertices = 0;           ///< vertices after
  std::size_t constraint_steiner = 0; ///< of them, inserted on constraints
  std::size_t interior_steiner = 0;   ///< of them, inserted inside
  std::size_t triangles = 0;          ///< triangles in the domain

  double smallest_angle = 0, largest_angle = 0; ///< degrees, over all triangles in the domain
  double largest_ratio = 0;        ///< of longest edge to target size, over triangles and constrained edges
  std::size_t oversized = 0;       ///< triangles and constrained edges whose ratio exceeds 1
  std::size_t below_min_angle = 0; ///< triangles below the requested smallest angle, input angles apart
  std::size_t at_input_angle = 0;  ///< triangles below it that hold an input angle below it

  std::size_t batches = 0, sweeps = 0, flips = 0;
  std::size_t moves = 0;    ///< single vertex moves of the relaxation
  std::size_t put_back = 0; ///< of them, not carried out since a triangle would have turned over
  std::size_t polished = 0; ///< vertex moves of the polishing

  Stop_reason stop_reason = Stop_reason::criteria_met;
  std::vector<std::pair<std::string, double>> stage_seconds; ///< wall time by stage, in order
  std::vector<std::string> notes; ///< about the input, for the report's readers: the mesher leaves it empty

  std::size_t steiner() const { return constraint_steiner + interior_steiner; }
  /// Whether every requested criterion holds.
  bool ok() const { return stop_reason == Stop_reason::criteria_met && oversized == 0 && below_min_angle == 0; }
};

/// Several lines for a person.
WEFT_COLD inline std::ostream& operator<<(std::ostream& out, const Mesh_report_2& r)
{
  using internal::counted;
  out << counted(r.vertices, "vertex (", "vertices (") << r.input_vertices << " given, " << r.constraint_steiner
      << " on constraints, " << r.interior_steiner << " inside), " << counted(r.triangles, "triangle", "triangles")
      << "\n"
      << "angles " << r.smallest_angle << " to " << r.largest_angle << " degrees, largest edge / size "
      << r.largest_ratio << "\n";
  for (const std::string& note : r.notes) out << note << "\n";
  out << name(r.stop_reason);
  if (r.oversized) out << ", " << counted(r.oversized, "element", "elements") << " too large";
  if (r.below_min_angle)
    out << ", " << counted(r.below_min_angle, "triangle", "triangles") << " below the smallest angle asked for";
  if (r.at_input_angle) out << ", " << r.at_input_angle << " at input angles below it";
  out << "\n"
      << counted(r.batches, "batch", "batches") << ", " << counted(r.sweeps, "sweep", "sweeps") << ", "
      << counted(r.flips, "flip", "flips") << ";";
  for (const auto& [stage, seconds] : r.stage_seconds) out << " " << stage << " " << seconds << " s";
  return out << "\n";
}

/// Elements of one kind that violate a criterion at the end, by what keeps them from being refined.
struct Unsatisfied_3
{
  std::size_t size = 0, approximation = 0, shape = 0, topology = 0, disk = 0; ///< by criterion; may overlap
  std::size_t elements = 0;                                                   ///< bad elements altogether
  std::size_t at_floor = 0;      ///< of them, whose Steiner point would come closer to a vertex than the size floor
  std::size_t at_acute_edge = 0; ///< of them, beside an edge of the input with an acute dihedral angle
  std::size_t demand = 0;        ///< of them, by a demand of the user
};

/// Result of `make_mesh_3()`.
struct Mesh_report_3
{
  std::size_t vertices = 0; ///< of the mesh; the box and vertices without a cell in the domain don't count
  std::size_t corner_vertices = 0, crease_vertices = 0, patch_vertices = 0, interior_vertices = 0;
  std::size_t cells = 0, facets = 0, crease_edges = 0;

  double smallest_dihedral = 0, largest_dihedral = 0;     ///< degrees, over all cells of the mesh
  double largest_facet_shape = 0, largest_cell_shape = 0; ///< circumradius / shortest edge
  bool manifold = false;                                  ///< whether the boundary is a closed 2-manifold

  Unsatisfied_3 bad_edges, bad_facets, bad_cells;
  /// Elements at small angles of the input whose shape these force: they violate bounds on shapes, which don't apply to
  /// them, and aren't bad. Where slivers were to be perturbed, cells with a dihedral angle above 179 degrees are bad
  /// instead.
  std::size_t forced_facets = 0, forced_cells = 0;
  std::size_t bad_vertices = 0; ///< vertices without a topological disk of boundary facets or crease edges
  std::size_t bare_patches = 0; ///< patches without a boundary facet
  Domain_comparison_3 domain;   ///< the mesh beside its domain: what is missing; made at the end
  Given_comparison_3 given; ///< the mesh beside surfaces before they were mended, if `compare_with_given_3()` was asked

  std::size_t creases_given_up = 0; ///< that were found by angle, since criteria couldn't hold with them

  double refined_smallest_dihedral = 0;  ///< degrees, after refinement; 0 if no optimisation followed
  double smoothed_smallest_dihedral = 0; ///< degrees, before perturbation; 0 if there was none
  std::size_t coarsened = 0;             ///< vertices taken away since no criterion needs them
  std::size_t smoothing_sweeps = 0;      ///< that were kept
  std::size_t smoothing_moves = 0;       ///< of vertices
  std::size_t smoothing_locked = 0;      ///< vertices that stayed among excellent cells, summed over sweeps
  std::size_t smoothing_rejected = 0;    ///< moves taken back since a criterion would have been violated
  std::size_t moved_in_place = 0, moved_one_by_one = 0, moved_by_rebuilding = 0; ///< moves of smoothing, by the way
  std::size_t perturbed = 0;                                                     ///< vertex moves of the perturbation
  std::size_t perturb_insertions = 0; ///< vertices it inserted where no move helped

  std::size_t batches = 0;
  std::size_t candidates = 0;       ///< Steiner points looked for; a choice among several counts once
  std::size_t encroachments = 0;    ///< Steiner points replaced by that of an element they encroach upon
  std::size_t segment_queries = 0;  ///< Voronoi edges against the boundary
  std::size_t location_queries = 0; ///< points located in the domain
  std::size_t skipped_queries = 0;  ///< questions that needn't be put to the oracle

  Stop_reason stop_reason = Stop_reason::criteria_met;
  std::vector<std::pair<std::string, double>> stage_seconds; ///< wall time by stage, in order

  std::size_t bad() const
  {
    return bad_edges.elements + bad_facets.elements + bad_cells.elements + bad_vertices + bare_patches;
  }
  /// Whether every requested criterion holds, and the mesh is the whole domain, as far as the oracle knows that.
  bool ok() const { return stop_reason == Stop_reason::criteria_met && bad() == 0 && domain.ok() && given.ok(); }
};

/// Several lines for a person.
WEFT_COLD inline std::ostream& operator<<(std::ostream& out, const Mesh_report_3& r)
{
  using internal::counted;
  const auto unsatisfied = [&out](const Unsatisfied_3& u, const char* what) {
    if (!u.elements) return;
    out << u.elements << " bad " << what << " (size " << u.size << ", approximation " << u.approximation << ", shape "
        << u.shape << ", topology " << u.topology << ", disk " << u.disk << ", demands " << u.demand
        << "; at the size floor " << u.at_floor << ", at acute edges of the input " << u.at_acute_edge << ")\n";
  };
  out << r.vertices << " vertices (" << r.corner_vertices << " feature, " << r.crease_vertices << " on creases, "
      << r.patch_vertices << " on patches, " << r.interior_vertices << " inside), " << r.cells << " cells, " << r.facets
      << " boundary facets\n"
      << "dihedral angles " << r.smallest_dihedral << " to " << r.largest_dihedral << " degrees, boundary "
      << (r.manifold ? "a closed manifold" : "not manifold") << "\n"
      << name(r.stop_reason) << "\n";
  if (r.creases_given_up)
    out << counted(r.creases_given_up, "crease", "creases") << " found by angle given up: criteria can't hold there\n";
  if (r.coarsened) out << "coarsening: " << counted(r.coarsened, "vertex", "vertices") << " taken away\n";
  if (r.smoothing_sweeps)
    out << "smoothing: from " << r.refined_smallest_dihedral << " degrees, "
        << counted(r.smoothing_sweeps, "sweep", "sweeps") << ", " << counted(r.smoothing_moves, "move", "moves") << ", "
        << r.smoothing_rejected << " rejected\n";
  if (r.perturbed)
    out << "perturbation: from " << r.smoothed_smallest_dihedral << " degrees, "
        << counted(r.perturbed, "move", "moves") << ", " << counted(r.perturb_insertions, "insertion", "insertions")
        << "\n";
  unsatisfied(r.bad_edges, "crease edges");
  unsatisfied(r.bad_facets, "facets");
  unsatisfied(r.bad_cells, "cells");
  if (r.forced_facets || r.forced_cells)
    out << "at small angles of the input: shapes of " << counted(r.forced_facets, "facet", "facets") << " and "
        << counted(r.forced_cells, "cell", "cells") << "\n";
  if (r.bad_vertices) out << r.bad_vertices << " vertices without a topological disk\n";
  if (r.bare_patches) out << counted(r.bare_patches, "patch", "patches") << " without a facet\n";
  out << r.domain << r.given;
  out << r.batches << " batches, " << r.candidates << " candidates, " << r.encroachments << " encroachments, "
      << r.segment_queries << " segment queries, " << r.skipped_queries << " skipped;";
  for (const auto& [stage, seconds] : r.stage_seconds) out << " " << stage << " " << seconds << " s";
  return out << "\n";
}

} // namespace weft

#endif // WEFT_REPORT_H
