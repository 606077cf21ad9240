// SPDX-License-Identifier: GPL-3.0-or-later
//
// The concept of a spatial domain, as a class with just the members it requires. Part of the manual, not of the
// library. The test archetypes_test makes meshes with it, so nothing that the mesher calls can be missing here.

#ifndef WEFT_DOC_DOMAIN_ORACLE_3_H
#define WEFT_DOC_DOMAIN_ORACLE_3_H

#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/Bbox_3.h>

#include <cstddef>
#include <vector>

/// \defgroup concept_classes Concepts
/// Members that types of your own need to take the place of weft's; see \ref concepts "their page".

/// The concepts as classes, with which tests make meshes. Not part of the library.
namespace concepts {

/// The questions of a spatial mesher about a domain. All functions are const and give the same answer each time. A
/// domain without folds inherits weft::No_folds_3. One that knows the subdomain of every point inherits
/// weft::Domain_by_labels_3, which has nearly all members.
///
/// examples/custom_oracle.h is an oracle with all of it.
///
/// Models: weft::Polyhedral_oracle_3, weft::Implicit_oracle_3, weft::Labelled_oracle_3, weft::Image_oracle_3,
/// weft::Mesh_domain_oracle_3.
/// \tparam Model what this archetype passes everything on to, and `is_asked_labels_first` which of the two kinds of
///   oracles it is; no part of the concept.
/// \ingroup concept_classes
template <class Model, bool is_asked_labels_first = false>
class DomainOracle_3
{
public:
  /// A CGAL kernel with exact predicates whose coordinates are doubles.
  using Kernel = typename Model::Kernel;
  using Point = typename Kernel::Point_3;
  /// A point of the boundary and its patch: `point`, of type Point, and `patch`, an int.
  using Surface_hit = weft::Surface_hit_3<Kernel>;

  /// Whether several threads may ask at once; else the mesher asks from one.
  static constexpr bool is_thread_safe = true;
  /// Whether locating points is cheaper than finding out from segments where the boundary lies between them. If so
  /// there must be the `intersect()` below, too, which gets the subdomains of the ends.
  static constexpr bool labels_first = is_asked_labels_first;

  explicit DomainOracle_3(const Model& model) : model_(model) {}

  /// \name The boundary
  /// @{

  /// Contains the domain.
  CGAL::Bbox_3 bbox() const { return model_.bbox(); }

  /// The subdomain that a point lies in, from 1; 0 outside.
  int subdomain(const Point& p) const { return model_.subdomain(p); }

  /// Appends where the segment pq meets the boundary, in order.
  /// \returns the exclusive or of the subdomains of p and q, which is 0 where they are the same, without ever
  /// contradicting `subdomain()`.
  int intersect(const Point& p, const Point& q, std::vector<Surface_hit>& hits) const
  {
    return model_.intersect(p, q, hits);
  }

  /// The same for ends whose subdomains are known, `at_p` and `at_q`. Only oracles with `labels_first` need it.
  int intersect(const Point& p, const Point& q, [[maybe_unused]] int at_p, [[maybe_unused]] int at_q,
                std::vector<Surface_hit>& hits) const
  {
    return model_.intersect(p, q, hits);
  }

  /// Nearest point of the boundary; patch -1 if none was found.
  Surface_hit closest(const Point& p) const { return model_.closest(p); }

  /// Whether the boundary has a point within that squared distance from p.
  bool is_within(const Point& p, double squared_distance) const { return model_.is_within(p, squared_distance); }

  /// Whether the boundary keeps that distance from p; false if that isn't known.
  bool is_clear(const Point& p, double radius) const { return model_.is_clear(p, radius); }
  /// @}

  /// \name Patches
  /// Parts of the boundary that get facets of their own, numbered from 0.
  /// @{

  int number_of_patches() const { return model_.number_of_patches(); }

  /// Whether a mesh has to have a facet on the patch.
  bool is_expected(int patch) const { return model_.is_expected(patch); }

  /// Nearest point of a patch; patch -1 if none was found.
  Surface_hit project_on_patch(const Point& p, int patch) const { return model_.project_on_patch(p, patch); }

  /// At most n well-spread points of a patch, off creases and corners.
  std::vector<Surface_hit> patch_seeds(int patch, std::size_t n) const { return model_.patch_seeds(patch, n); }
  /// @}

  /// \name Corners and creases
  /// @{

  /// Points that are vertices of every mesh.
  std::size_t number_of_corners() const { return model_.number_of_corners(); }
  Point corner(std::size_t i) const { return model_.corner(i); }

  std::size_t number_of_creases() const { return model_.number_of_creases(); }
  /// The polyline that a crease is, in order; a closed one doesn't repeat the first point. One that isn't closed begins
  /// and ends at corners.
  std::vector<Point> crease_points(int i) const { return model_.crease_points(i); }
  bool crease_is_closed(int i) const { return model_.crease_is_closed(i); }

  /// Nearest point of a crease.
  Point project_on_crease(const Point& p, int crease) const { return model_.project_on_crease(p, crease); }

  /// Which creases and patches meet. `weft::Feature_incidence_3()` for a domain without corners and creases;
  /// `weft::Feature_incidence_3(corners, ends)` for one with that many corners, where `ends` has, for each crease, the
  /// numbers of the corners at its ends as a std::pair<int, int>, -1 and -1 for a closed one.
  weft::Feature_incidence_3 incidence() const { return model_.incidence(); }
  /// @}

  /// \name Folds
  /// Where the boundary bends without a crease. weft::No_folds_3 has these for domains without.
  /// @{

  /// Moves a point of a patch to the place within reach where the boundary bends most.
  /// \returns whether there is such a place.
  bool attract(Point& p, double vertex_reach, double fold_reach, int patch) const
  {
    return model_.attract(p, vertex_reach, fold_reach, patch);
  }

  /// Calls `visit(point, whether vertices there are welcome)` for each end of a fold in a ball around a point of a
  /// patch.
  template <class Visit>
  void visit_salient_points(const Point& center, double squared_radius, int patch, const Visit& visit) const
  {
    model_.visit_salient_points(center, squared_radius, patch, visit);
  }

  /// Calls `visit(source, target, whether vertices on it are welcome)` for each ridge that meets such a ball.
  template <class Visit>
  void visit_ridges(const Point& center, double squared_radius, int patch, const Visit& visit) const
  {
    model_.visit_ridges(center, squared_radius, patch, visit);
  }

  /// Whether a ball reaches both sides of an edge of the boundary with an acute dihedral angle.
  bool is_at_acute_edge(const Point& center, double radius) const { return model_.is_at_acute_edge(center, radius); }

  /// The mirror image of p on the other side of such an edge; whether there is one.
  bool mirror_at_acute_edge(const Point& p, const Point& center, double radius, Surface_hit& image) const
  {
    return model_.mirror_at_acute_edge(p, center, radius, image);
  }

  /// Moves the center of a ball to the nearest point of such an edge if that is near.
  /// \returns whether it is.
  bool attract_to_acute_edge(Point& p, double radius) const { return model_.attract_to_acute_edge(p, radius); }

  /// The smallest angle in degrees of the edges of the boundary whose sides a ball reaches both; 180 if there is none.
  double acute_angle_at(const Point& center, double radius) const { return model_.acute_angle_at(center, radius); }

  /// Whether `visit_mirror_images()` and `visit_creases_at_small_angles()` ever visit anything.
  bool has_mirror_images() const { return model_.has_mirror_images(); }

  /// Calls `visit(image, location)` for the places on the other side of small angles where a vertex of the boundary
  /// wants a twin, as far as they are nearer to it than `spacing`.
  template <class Visit>
  void visit_mirror_images(const Point& p, const weft::Vertex_location_3& at, double spacing, const Visit& visit) const
  {
    model_.visit_mirror_images(p, at, spacing, visit);
  }

  /// Calls `visit(other crease, angle in radians)` for the creases that meet a crease at a small angle.
  template <class Visit>
  void visit_creases_at_small_angles(int crease, const Visit& visit) const
  {
    model_.visit_creases_at_small_angles(crease, visit);
  }

  /// Optional: whether such creases excuse the shapes of cells between them. Without it they do.
  bool creases_force_cells() const { return model_.creases_force_cells(); }
  /// @}

private:
  const Model& model_;
};

} // namespace concepts

#endif // WEFT_DOC_DOMAIN_ORACLE_3_H
