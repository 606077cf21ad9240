// SPDX-License-Identifier: GPL-3.0-or-later
//
// Criteria whose sizes grade: the least of what is asked for everywhere, in subdomains, on patches, on creases and at
// points, as a field that grows by at most K per unit of distance (Tournois 2009, sec. 3.2.1).

#ifndef WEFT_SPATIAL_SIZING_GRADE_CRITERIA_3_H
#define WEFT_SPATIAL_SIZING_GRADE_CRITERIA_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/sizing/Lipschitz_sizing_3.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/domain/boundary_samples_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft {

/// Replaces the size in criteria by a field that is nowhere above any of their sizes and grows by at most k; all else
/// stays. Refinement then grades by it, where it would otherwise go from one size to another as fast as shapes allow.
///
/// Sizes on patches and creases are sampled, at distances of 0.7 times the size there, but for at most 200 along the
/// bounding box diagonal on patches.
/// \param oracle a domain oracle, see doc/concepts/DomainOracle_3.h; asked during the call alone.
/// \param k growth of the size per unit of distance, >= 0; 0.3 to 1 are common.
/// \param points further sizes, such as at feature vertices.
/// \throws Option_error for arguments or criteria out of range.
template <class Oracle>
Criteria_3<typename Oracle::Kernel>
grade_criteria_3(const Oracle& oracle, const Criteria_3<typename Oracle::Kernel>& criteria, double k,
                 const Gradation_options_3& options = Gradation_options_3(),
                 const std::vector<typename Lipschitz_sizing_3<typename Oracle::Kernel>::Source>& points = {})
{
  using Kernel = typename Oracle::Kernel;
  using Point = typename Kernel::Point_3;
  criteria.check();
  std::vector<typename Lipschitz_sizing_3<Kernel>::Source> sources = points;
  const CGAL::Bbox_3 b = oracle.bbox();
  const double diagonal = std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
  constexpr double part = 0.7;

  double spacing = diagonal / 40;
  bool has_patches = false;
  for (const auto& [patch, own] : criteria.patches) {
    has_patches = has_patches || bool(own.size);
    if (own.size && own.size.is_constant()) spacing = (std::min)(spacing, part * own.size.constant());
  }
  const auto add_on_patch = [&](const Point& p, int patch) {
    const auto own = criteria.patches.find(patch);
    if (own != criteria.patches.end() && own->second.size) sources.push_back({p, own->second.size(p)});
  };
  if (has_patches) {
    spacing = (std::max)(spacing, diagonal / 200);
    if constexpr (internal::Has_boundary_samples_3<Oracle>::value) {
      oracle.visit_samples(spacing,
                           [&](const Point& p, int patch, const std::array<double, 3>&) { add_on_patch(p, patch); });
    } else {
      constexpr std::size_t seeds = 4096;
      for (const auto& own : criteria.patches)
        for (const auto& seed : oracle.patch_seeds(own.first, seeds)) add_on_patch(seed.point, own.first);
    }
  }
  if (criteria.crease_size)
    for (std::size_t c = 0; c < oracle.number_of_creases(); ++c) {
      auto chain = oracle.crease_points(static_cast<int>(c));
      if (oracle.crease_is_closed(static_cast<int>(c))) chain.push_back(chain.front());
      for (std::size_t i = 1; i < chain.size(); ++i) {
        const auto a = internal::xyz(chain[i - 1]), step = internal::minus(internal::xyz(chain[i]), a);
        const double length = internal::norm(step);
        for (double t = 0; t < length;) {
          const Point p(a[0] + t / length * step[0], a[1] + t / length * step[1], a[2] + t / length * step[2]);
          const double size = criteria.crease_size(p);
          sources.push_back({p, size});
          t += part * size;
        }
        sources.push_back({chain[i], criteria.crease_size(chain[i])});
      }
    }

  bool has_subdomains = false;
  for (const auto& [label, own] : criteria.subdomains) has_subdomains = has_subdomains || bool(own.size);
  const auto field = [&](const Point& p) {
    double size = criteria.size(p);
    if (!has_subdomains) return size;
    const auto own = criteria.subdomains.find(oracle.subdomain(p));
    return own == criteria.subdomains.end() ? size : internal::least_bound<Kernel>(size, &own->second.size, p);
  };
  Criteria_3<Kernel> graded = criteria;
  graded.size = Lipschitz_sizing_3<Kernel>(field, sources, b, k, options);
  return graded;
}

} // namespace weft

#endif // WEFT_SPATIAL_SIZING_GRADE_CRITERIA_3_H
