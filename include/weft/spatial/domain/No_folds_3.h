// SPDX-License-Identifier: GPL-3.0-or-later
//
// Base of domain oracles whose boundary has no folds, tips or acute edges: the members of the concept that are about
// those.

#ifndef WEFT_SPATIAL_DOMAIN_NO_FOLDS_3_H
#define WEFT_SPATIAL_DOMAIN_NO_FOLDS_3_H

#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

namespace weft {

/// Base of domain oracles without salient features; see Polyhedral_oracle_3 for what the functions mean.
template <class K>
class No_folds_3
{
public:
  using Point = typename K::Point_3;

  bool attract(Point&, double, double, int) const { return false; }
  template <class Visit>
  void visit_salient_points(const Point&, double, int, const Visit&) const
  {}
  template <class Visit>
  void visit_ridges(const Point&, double, int, const Visit&) const
  {}
  bool is_at_acute_edge(const Point&, double) const { return false; }
  bool mirror_at_acute_edge(const Point&, const Point&, double, Surface_hit_3<K>&) const { return false; }
  bool attract_to_acute_edge(Point&, double) const { return false; }
  double acute_angle_at(const Point&, double) const { return 180; }
  bool has_mirror_images() const { return false; }
  template <class Visit>
  void visit_creases_at_small_angles(int, const Visit&) const
  {}
  template <class Visit>
  void visit_mirror_images(const Point&, const Vertex_location_3&, double, const Visit&) const
  {}
};

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_NO_FOLDS_3_H
