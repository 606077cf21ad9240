// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where refinement goes beyond Tournois 2009, sec. 3.2.1.3 and 3.2.1.4, as switches. `make_mesh_3()` has all of them
// on, `mesh_as_published_3()` all off unless asked otherwise.

#ifndef WEFT_SPATIAL_REFINE_REFINEMENT_POLICY_3_H
#define WEFT_SPATIAL_REFINE_REFINEMENT_POLICY_3_H

namespace weft::internal {

struct Refinement_policy_3
{
  bool chooses_points = true;   ///< among candidates (Steiner_chooser_3.h); else always an element's own Steiner point
  bool sorts_dimensions = true; ///< cells wait until no facet, and disks until no edge or facet, was chosen
  bool shapes_creases = true;   ///< equal parts, concentric spheres, bends: see crease_steiner_point_3.h
  bool follows_folds = true;    ///< where the surface bends nearby, the Steiner point of a facet moves there
  bool sees_ridges = true;      ///< facets have to be near ridges, tips and the surface at their middles, too
  bool mirrors = true;          ///< pairs and twins beside acute edges; else small elements are left at all of those

  /// What the thesis prints.
  static Refinement_policy_3 as_published() { return {false, false, false, false, false, false}; }
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_REFINEMENT_POLICY_3_H
