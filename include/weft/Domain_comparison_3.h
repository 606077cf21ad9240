// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a mesh and its domain differ: what `check_domain_3()` finds and reports of meshing hold.

#ifndef WEFT_DOMAIN_COMPARISON_3_H
#define WEFT_DOMAIN_COMPARISON_3_H

#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <vector>

namespace weft {

/// One subdomain in the domain and in the mesh.
struct Subdomain_comparison_3
{
  int subdomain = 0;
  double expected_volume = std::numeric_limits<double>::quiet_NaN(); ///< of the domain; not a number if it isn't known
  double volume = 0;                                                 ///< of the mesh
  double allowed_difference = 0; ///< of the volumes: what the approximation bound allows; infinite if nothing is asked
  long expected_components = -1; ///< connected components of the boundary; -1 if not known
  long components = 0;           ///< of the mesh
  long expected_euler = 0;       ///< V - E + F of the boundary, if the components are known
  long euler = 0;                ///< of the mesh

  bool has_volume() const
  {
    return std::isnan(expected_volume) || std::abs(volume - expected_volume) <= allowed_difference;
  }
  bool has_topology() const
  {
    return expected_components < 0 || (components == expected_components && euler == expected_euler);
  }
};

/// A mesh beside its domain.
struct Domain_comparison_3
{
  std::vector<Subdomain_comparison_3> subdomains; ///< in the order of their numbers
  std::size_t samples = 0; ///< points of the boundary and of creases whose distance from the mesh was measured
  std::size_t missed_patch_samples =
      0; ///< of them, on patches and farther than the tolerance from facets of their patch
  std::size_t missed_crease_samples = 0; ///< of them, on creases and farther than it from edges of their crease
  std::size_t missing_corners = 0;       ///< feature vertices that are no vertices of the mesh
  double tolerance = 0;                  ///< of those distances, in the input's units: the largest
  double largest_distance = 0;           ///< of a missed sample; of the first thousand of patches

  /// Samples and feature vertices that the mesh lacks.
  std::size_t missed() const { return missed_patch_samples + missed_crease_samples + missing_corners; }

  bool has_surface() const { return missed() == 0; }
  bool has_volumes() const
  {
    for (const auto& s : subdomains)
      if (!s.has_volume()) return false;
    return true;
  }
  bool has_topology() const
  {
    for (const auto& s : subdomains)
      if (!s.has_topology()) return false;
    return true;
  }
  /// Whether the mesh is the domain, as far as is known of that.
  bool ok() const { return has_surface() && has_volumes() && has_topology(); }
};

/// A mesh beside surfaces as they were given, before they were mended.
struct Given_comparison_3
{
  bool is_known = false; ///< whether they were compared
  double area = 0;       ///< of the surfaces, in the input's units
  double missed_area =
      0; ///< of what is farther from the mesh than the tolerance and neither was left out nor lies within
  double area_left_out = 0;    ///< of fins and sheets that were left out and are farther away
  double tolerance = 0;        ///< in the input's units
  double largest_distance = 0; ///< of what is missed

  double missed_share() const { return area > 0 ? missed_area / area : 0; }
  /// Whether at most 0.5 % of the area is missed.
  bool ok() const { return missed_share() <= 0.005; }
};

/// What is missed, in a line; nothing where nothing is.
inline std::ostream& operator<<(std::ostream& out, const Given_comparison_3& c)
{
  if (c.missed_area > 0)
    out << 100 * c.missed_share() << " % of the area as given is farther than " << c.tolerance
        << " from the mesh, up to " << c.largest_distance << "\n";
  return out;
}

/// What differs, a line each; nothing where nothing does.
inline std::ostream& operator<<(std::ostream& out, const Domain_comparison_3& c)
{
  if (!c.has_surface()) {
    out << "the mesh lacks parts of the boundary:";
    if (c.missing_corners) out << " " << c.missing_corners << " feature vertices;";
    if (c.missed_crease_samples) out << " " << c.missed_crease_samples << " points of creases;";
    if (c.missed_patch_samples) out << " " << c.missed_patch_samples << " points of patches;";
    out << " of " << c.samples << " the farthest is " << c.largest_distance << " away, more than " << c.tolerance
        << "\n";
  }
  for (const auto& s : c.subdomains) {
    if (!s.has_volume())
      out << "subdomain " << s.subdomain << " has volume " << s.volume << " instead of " << s.expected_volume << "\n";
    if (!s.has_topology())
      out << "the boundary of subdomain " << s.subdomain << " has " << s.components
          << " components and Euler characteristic " << s.euler << " instead of " << s.expected_components << " and "
          << s.expected_euler << "\n";
  }
  return out;
}

} // namespace weft

#endif // WEFT_DOMAIN_COMPARISON_3_H
