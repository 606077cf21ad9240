// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef WEFT_EXAMPLES_PROGRAMS_MESH_3_RESULT_H
#define WEFT_EXAMPLES_PROGRAMS_MESH_3_RESULT_H

#include "domain.h"

#include <weft/errors.h>
#include <weft/report.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/domain/raise_order_3.h>
#include <weft/spatial/domain/Voxel_components_3.h>
#include <weft/spatial/mesh/Mesh_names_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mesh_3_program {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Result
{
  weft::Tetrahedral_mesh_3<K> mesh;
  weft::Mesh_report_3 report;
  weft::Quality_3 quality;
  weft::Mesh_names_3 names;
  std::optional<std::vector<weft::Voxel_component_3>> missing; ///< of images: components that stayed out
  std::optional<weft::Raised_mesh_3<K>> raised;                ///< the same mesh with elements of second order
};

/// Measures the quality.
std::shared_ptr<const Result> make_result(weft::Tetrahedral_mesh_3<K> mesh, const weft::Mesh_report_3& report,
                                          weft::Mesh_names_3 names, std::optional<weft::Raised_mesh_3<K>> raised,
                                          std::optional<std::vector<weft::Voxel_component_3>> missing = std::nullopt);

/// The mesh with elements of that order, if it is the second.
template <class Oracle>
std::optional<weft::Raised_mesh_3<K>> raised(const weft::Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle, int order)
{
  if (order < 2 || mesh.cells.empty()) return std::nullopt;
  return weft::raise_order_3(mesh, oracle);
}

/// What a domain consists of.
struct Parts
{
  std::map<int, int> subdomains;          ///< by label
  std::vector<std::pair<int, int>> sides; ///< of each patch, subdomains, 0 for the outside
};

/// Values by label as values by subdomain.
/// \throws weft::Option_error for a label that there isn't.
template <class Value>
std::map<int, Value> by_subdomain(const std::map<int, Value>& by_label, const Parts& parts)
{
  std::map<int, Value> result;
  for (const auto& [label, value] : by_label) {
    const auto found = parts.subdomains.find(label);
    if (found == parts.subdomains.end()) throw weft::Option_error("the input has no label " + std::to_string(label));
    result[found->second] = value;
  }
  return result;
}

/// Criteria of patches and subdomains are further ones: what holds everywhere is the weakest of them.
inline weft::Criteria_3<K> criteria(const Bounds& bounds, const Parts& parts)
{
  const std::map<int, double> size_of = by_subdomain(bounds.size_of, parts),
                              approximation_of = by_subdomain(bounds.approximation_of, parts);
  const auto value = [](const std::map<int, double>& own, int subdomain, double otherwise) {
    const auto found = own.find(subdomain);
    return found == own.end() ? otherwise : found->second;
  };
  // Of bounds on distances 0 is the weakest.
  const auto is_weaker = [](double a, double b) { return b != 0 && (a == 0 || a > b); };
  double size = 0, approximation = parts.subdomains.empty() ? bounds.approximation : -1;
  for (const auto& [label, subdomain] : parts.subdomains) {
    size = std::max(size, value(size_of, subdomain, bounds.size));
    const double own = value(approximation_of, subdomain, bounds.approximation);
    if (approximation < 0 || is_weaker(own, approximation)) approximation = own;
  }
  weft::Criteria_3<K> criteria;
  criteria.size = parts.subdomains.empty() ? bounds.size : size;
  criteria.approximation = approximation;
  for (const auto& [label, subdomain] : parts.subdomains)
    if (const double own = value(size_of, subdomain, bounds.size); own < size)
      criteria.subdomains[subdomain].size = own;
  for (std::size_t p = 0; p < parts.sides.size(); ++p) {
    double own = approximation;
    for (const int side : {parts.sides[p].first, parts.sides[p].second}) {
      const double bound = side == 0 ? 0 : value(approximation_of, side, bounds.approximation);
      if (is_weaker(own, bound)) own = bound;
    }
    if (own != approximation) criteria.patches[static_cast<int>(p)].approximation = own;
  }
  criteria.facet_shape = bounds.facet_shape;
  criteria.cell_shape = bounds.cell_shape;
  criteria.topology = bounds.topology;
  return criteria;
}

inline double diagonal(const CGAL::Bbox_3& box)
{
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

} // namespace mesh_3_program

#endif // WEFT_EXAMPLES_PROGRAMS_MESH_3_RESULT_H
