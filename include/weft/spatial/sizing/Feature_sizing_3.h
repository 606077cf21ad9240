// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sizing field that follows the features of a domain in space, measured on its oracle:
//   mu(x) = min(max_size, inf_s [k d(s, x) + 2 lfs(s) / cells]), s on the boundary,
// Alliez, Cohen-Steiner, Yvinec and Desbrun, "Variational tetrahedral meshing" (2005); Tournois 2009, sec. 3.2.1.
//
// The local feature size of a smooth surface is its distance to the medial axis, which is 0 at every edge of a
// polyhedron. Taken here: lfs(s) is the radius of the smaller of the two balls that touch the boundary in s, one on
// each side, and again in another point, as far as that other point is one of another sheet: it is seen from the center
// at least 45 degrees away from s, and doesn't lie on a patch that meets that of s in a crease or a feature vertex.
// Half of a thickness, half of a gap and the radius of a curve that turns by 45 degrees are feature sizes then; creases
// and smaller folds count for nothing, as in the plane features that share a point don't. The balls are found by
// shrinking (Ma, Bae and Choi, "3D medial axis point approximation using nearest neighbors and the normal field",
// 2012), and the angle is as in Peters, "Geographical point cloud modelling with the 3D medial axis transform" (2018).

#ifndef WEFT_SPATIAL_SIZING_FEATURE_SIZING_3_H
#define WEFT_SPATIAL_SIZING_FEATURE_SIZING_3_H

#include <weft/errors.h>
#include <weft/internal/Answers.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/sizing/Lipschitz_sizing_3.h>
#include <weft/spatial/domain/boundary_samples_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace weft {

/// What `Feature_sizing_3` asks for.
struct Feature_sizing_options_3
{
  double cells = 2;     ///< edges across a thickness or a gap, and along the diameter of a curve
  double min_size = 0;  ///< in the input's units; 0: a thousandth of the bounding box diagonal
  double max_size = 0;  ///< in the input's units; 0: a twentieth of the diagonal
  double samples = 128; ///< of the boundary along the diagonal: how far apart feature sizes are measured

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    if (!(cells > 0) || !std::isfinite(cells)) throw Option_error("cells must be positive");
    if (!(min_size >= 0) || !(max_size >= 0)) throw Option_error("sizes must not be negative");
    if (!(samples >= 1 && samples <= 10000)) throw Option_error("samples must lie in [1, 10000]");
  }
};

/// Sizing field from the features of a domain. Copies share its table. Safe to read from many threads.
/// \tparam K the oracle's kernel.
template <class K>
class Feature_sizing_3
{
public:
  using FT = typename K::FT;
  using Point = typename K::Point_3;

  /// Asks the oracle some ten times a sample; afterwards it isn't needed.
  /// \param oracle a domain oracle that has samples of its boundary: of surfaces or images.
  /// \param k growth of the size per unit of distance, >= 0.
  /// \throws Option_error for arguments out of range.
  template <class Oracle>
  Feature_sizing_3(const Oracle& oracle, double k, const Feature_sizing_options_3& options = Feature_sizing_options_3())
      : field_(graded(oracle, k, options))
  {}

  /// Target edge length at `x`.
  FT operator()(const Point& x) const { return field_(x); }

  double k() const { return field_.k(); }
  double smallest() const { return field_.smallest(); } ///< anywhere
  /// The field as what it is.
  const Lipschitz_sizing_3<K>& field() const { return field_; }

private:
  using Xyz = internal::Xyz_3;

  template <class Oracle>
  static Lipschitz_sizing_3<K> graded(const Oracle& oracle, double k, const Feature_sizing_options_3& options)
  {
    static_assert(internal::Has_boundary_samples_3<Oracle>::value,
                  "weft: Feature_sizing_3 takes an oracle with visit_samples(): of a surface or an image");
    options.check();
    const CGAL::Bbox_3 b = oracle.bbox();
    const double diagonal = std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
    Gradation_options_3 gradation;
    gradation.max_size = options.max_size > 0 ? options.max_size : diagonal / 20;
    gradation.min_size = options.min_size > 0 ? options.min_size : (std::min)(gradation.max_size, diagonal / 1000);
    const std::set<std::pair<int, int>> meeting = meeting_patches(oracle);
    const double reach = options.cells / 2 * gradation.max_size;
    std::vector<typename Lipschitz_sizing_3<K>::Source> sources;
    oracle.visit_samples(diagonal / options.samples, [&](const Point& p, int patch,
                                                         const std::array<double, 3>& normal) {
      if (normal == std::array<double, 3>()) return;
      double radius = reach;
      for (const double side : {-1., 1.})
        radius = shrunk(oracle, p, patch, {{side * normal[0], side * normal[1], side * normal[2]}}, meeting, radius);
      if (radius < reach) sources.push_back({p, 2 * radius / options.cells});
    });
    const double largest = gradation.max_size;
    return Lipschitz_sizing_3<K>([largest](const Point&) { return largest; }, sources, b, k, gradation);
  }

  /// Pairs of patches that meet in a crease or a feature vertex.
  template <class Oracle>
  static std::set<std::pair<int, int>> meeting_patches(const Oracle& oracle)
  {
    std::set<std::pair<int, int>> pairs;
    const Feature_incidence_3 incidence = oracle.incidence();
    const auto add = [&](const std::vector<int>& patches) {
      for (const int p : patches)
        for (const int q : patches)
          if (p != q) pairs.emplace(p, q);
    };
    for (std::size_t c = 0; c < oracle.number_of_creases(); ++c) add(incidence.patches_of_crease(static_cast<int>(c)));
    for (std::size_t c = 0; c < oracle.number_of_corners(); ++c) {
      std::set<int> patches;
      for (const int crease : incidence.creases_of_corner(static_cast<int>(c)))
        for (const int p : incidence.patches_of_crease(crease)) patches.insert(p);
      add({patches.begin(), patches.end()});
    }
    return pairs;
  }

  /// Radius of the ball that touches the boundary in p, on the side of a unit vector, and in another sheet.
  /// \param radius to begin with, which it is where the ball meets nothing.
  template <class Oracle>
  static double shrunk(const Oracle& oracle, const Point& p, int patch, const Xyz& towards,
                       const std::set<std::pair<int, int>>& meeting, double radius)
  {
    constexpr int most_steps = 30;
    constexpr double cosine = 0.7071067811865476; // of the angle under which another sheet is seen
    const Xyz from = internal::xyz(p);
    for (int step = 0; step < most_steps; ++step) {
      const Point center(from[0] + radius * towards[0], from[1] + radius * towards[1], from[2] + radius * towards[2]);
      const auto hit = oracle.closest(center);
      if (hit.patch < 0 || meeting.count({patch, hit.patch}) > 0) break;
      const Xyz q = internal::xyz(hit.point), chord = internal::minus(q, from);
      const double nearest = internal::norm(internal::minus(q, internal::xyz(center)));
      const double along = internal::dot_product(chord, towards);
      if (!(nearest < radius * (1 - 1e-3)) || !(along > 0)) break;
      const double smaller = internal::dot_product(chord, chord) / (2 * along);
      // cos of the angle at the new center between p, which is -towards away, and q
      const double cosine_of_sheets = 1 - along / smaller;
      if (!(smaller < radius) || cosine_of_sheets > cosine) break;
      radius = smaller;
    }
    return radius;
  }

  Lipschitz_sizing_3<K> field_;
};

} // namespace weft

#endif // WEFT_SPATIAL_SIZING_FEATURE_SIZING_3_H
