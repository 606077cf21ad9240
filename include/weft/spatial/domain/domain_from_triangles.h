// SPDX-License-Identifier: GPL-3.0-or-later
//
// The domain that triangles of any origin bound, as an oracle to mesh, and a record of what was done to them. Closed
// surfaces stay as they are; others are mended.
//
//   #include <weft/IO/write_mesh_3.h>
//   #include <weft/make_mesh_3.h>
//   #include <weft/spatial/domain/domain_from_triangles.h>
//   #include <iostream>
//
//   const std::vector<K::Point_3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
//   const std::vector<std::vector<int>> triangles = {{0, 2, 1}, {0, 1, 3}, {2, 1, 3}};
//   const auto domain = weft::domain_from_triangles(points, triangles);
//   for (const std::string& change : domain.changes()) std::cerr << change << "\n";
//   weft::Criteria_3<K> criteria;
//   criteria.size = 0.2;
//   const auto result = weft::make_mesh_3(*domain.oracle, criteria);
//   weft::IO::write_mesh_3("mesh.vtu", weft::tetrahedral_mesh(result.restricted));
//
// Of these triangles one is missing, and one is turned over.

#ifndef WEFT_SPATIAL_DOMAIN_DOMAIN_FROM_TRIANGLES_H
#define WEFT_SPATIAL_DOMAIN_DOMAIN_FROM_TRIANGLES_H

#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/surface/Feature_options.h>
#include <weft/spatial/surface/mended_complex_3.h>
#include <weft/spatial/surface/Mending_record_3.h>
#include <weft/spatial/surface/Polygon_soup_3.h>

#include <CGAL/Kernel_traits.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// What triangles bound.
template <class K>
struct Domain_from_triangles_3
{
  std::shared_ptr<const Polyhedral_oracle_3<K>> oracle;

  /// The boundary with creases, patches and subdomains; `mesh_surface_3()` takes it.
  const Piecewise_smooth_complex_3<K>& complex() const { return oracle->complex(); }
  /// What was done to the triangles, in numbers. All of it is 0 if they are a closed surface.
  const Mending_record_3& record() const { return complex().mending; }
  /// The same for people, a line for each thing, and which shells were turned over.
  const std::vector<std::string>& changes() const { return complex().changes; }
  /// Names of the subdomains from 1 on, where groups or surfaces name them; may be empty. `Mesh_names_3` takes them to
  /// files.
  const std::vector<std::string>& names() const { return complex().names; }
};

/// Options of `domain_from_triangles()`.
struct Triangle_domain_options_3
{
  Feature_options features;
  Mend_options_3 mending;
  /// Of each polygon the position of its group's name: groups that bound regions are subdomains with these names, as
  /// `mended_complex_3()` says. Empty: no groups. Several surfaces have groups of their own.
  std::vector<std::size_t> groups = {};
  std::vector<std::string> group_names = {};
  bool groups_are_solids = false; ///< whether groups that overlap stay apart, as the solids of an .stl file do
};

/// The domain that several surfaces bound: number i bounds subdomain i + 1, or several if it is divided; what lies in
/// several surfaces belongs to the last.
/// \throws Domain_error, Option_error as `mended_complex_3()`.
template <class K>
Domain_from_triangles_3<K> domain_from_triangles(const std::vector<Polygon_soup_3<K>>& surfaces,
                                                 const Triangle_domain_options_3& options = {})
{
  return {
      std::make_shared<const Polyhedral_oracle_3<K>>(mended_complex_3(surfaces, options.features, options.mending))};
}

/// The domain that triangles or other polygons bound, whatever their order, orientation and flaws; see
/// `mended_complex_3()` for what is done about these.
/// \param polygons a range of ranges of positions in `points`, such as std::vector<std::array<int, 3>>.
/// \throws Domain_error if they bound nothing or can't be mended, with positions of points and polygons.
/// \throws Option_error if an option is out of range, or groups don't fit the polygons.
template <class Point, class Polygons, class K = typename CGAL::Kernel_traits<Point>::Kernel>
Domain_from_triangles_3<K> domain_from_triangles(const std::vector<Point>& points, const Polygons& polygons,
                                                 const Triangle_domain_options_3& options = {})
{
  Polygon_soup_3<K> soup{points, {}};
  for (const auto& polygon : polygons) {
    soup.polygons.emplace_back();
    for (const auto corner : polygon) soup.polygons.back().push_back(static_cast<std::size_t>(corner));
  }
  soup.groups = options.groups;
  soup.group_names = options.group_names;
  soup.groups_are_solids = options.groups_are_solids;
  if (!soup.groups.empty() && soup.groups.size() != soup.polygons.size())
    throw Option_error("groups must be one for each polygon");
  for (const std::size_t group : soup.groups)
    if (group >= soup.group_names.size()) throw Option_error("groups must have names, which may be empty");
  return domain_from_triangles(std::vector<Polygon_soup_3<K>>{std::move(soup)}, options);
}

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_DOMAIN_FROM_TRIANGLES_H
