// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sizing field that follows the local feature size of a planar straight line graph:
//   mu(x) = min(max_size, max(min_size, inf_s [k d(s, x) + lfs(s)])), s on the features of the graph,
// the largest k-Lipschitz function that is nowhere on the graph above its local feature size. Tournois 2009, sec. 2.4;
// Alliez, Cohen-Steiner, Yvinec and Desbrun, "Variational tetrahedral meshing" (2005). What lfs is, and that it looks
// across holes, says Local_feature_size_2.h.

#ifndef WEFT_PLANAR_SIZING_LFS_SIZING_2_H
#define WEFT_PLANAR_SIZING_LFS_SIZING_2_H

#include <weft/errors.h>
#include <weft/planar/graph/Pslg_2.h>
#include <weft/planar/sizing/Local_feature_size_2.h>
#include <weft/sizing/Lipschitz_sizing_2.h>

#include <cstddef>
#include <limits>

namespace weft {

/// Sizing field from the local feature size. Safe to read from many threads.
///
/// The infimum is taken over sources that describe lfs from below (Local_feature_size_2::sources()), so that
/// value <= mu <= (1 + tolerance) value everywhere.
/// \tparam K a CGAL kernel whose numbers convert to double.
template <class K>
class Lfs_sizing_2
{
public:
  using FT = typename K::FT;
  using Point = typename K::Point_2;

  /// \param k growth of the size per unit of distance, >= 0. With 0 the field is the smallest lfs everywhere.
  /// \param min_size,max_size the field's range, in the input's units; 0 and infinity for none.
  /// \param tolerance largest relative error, in (0, 1].
  /// \throws Option_error for arguments outside of their range, or when nothing bounds the size (a graph without
  /// segments and with less than two points, and an infinite `max_size`).
  /// \throws Domain_error when `min_size` is 0 and features meet without sharing a point, and for invalid indices
  /// and coordinates.
  Lfs_sizing_2(const Pslg_2<K>& pslg, double k, double min_size = 0,
               double max_size = std::numeric_limits<double>::infinity(), double tolerance = 0.01)
      : field_(checked_sources(pslg, k, min_size, max_size, tolerance), k, min_size, max_size)
  {}

  /// Target edge length at `x`. O(log n) in the number of features.
  FT operator()(const Point& x) const { return field_(x); }

  double k() const { return field_.k(); }
  double min_size() const { return field_.min_size(); }
  double max_size() const { return field_.max_size(); }
  /// The field as what it is: Lipschitz, with segment sources.
  const Lipschitz_sizing_2<K>& sources() const { return field_; }

private:
  static auto checked_sources(const Pslg_2<K>& pslg, double k, double min_size, double max_size, double tolerance)
  {
    Lipschitz_sizing_2<K>::check_range(k, min_size, max_size); // before the work
    if (!(tolerance > 0 && tolerance <= 1)) throw Option_error("Lfs_sizing_2: the tolerance must be in (0, 1]");
    return Local_feature_size_2<K>(pslg).sources(tolerance, min_size, max_size);
  }

  Lipschitz_sizing_2<K> field_;
};

} // namespace weft

#endif // WEFT_PLANAR_SIZING_LFS_SIZING_2_H
