// SPDX-License-Identifier: GPL-3.0-or-later
//
// The domain oracle of any function that gives the subdomain of a point: several materials, constructive solid
// geometry, images behind an interpolation (Tournois 2009, sec. 4.2.1.3).

#ifndef WEFT_SPATIAL_DOMAIN_LABELLED_ORACLE_3_H
#define WEFT_SPATIAL_DOMAIN_LABELLED_ORACLE_3_H

#include <weft/errors.h>
#include <weft/spatial/domain/Domain_by_labels_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// A domain whose subdomains a callable tells apart.
/// \tparam K a CGAL kernel whose coordinates are doubles.
/// \tparam Labelling callable, point -> label, an integer from 0 (outside) to the number of labels - 1; if several
///         threads are used, it is called by all of them.
template <class K, class Labelling>
class Labelled_oracle_3 : public Domain_by_labels_3<Labelled_oracle_3<K, Labelling>, K>
{
  using Base = Domain_by_labels_3<Labelled_oracle_3<K, Labelling>, K>;

public:
  using Point = typename K::Point_3;
  static constexpr bool is_thread_safe = true;

  /// \param bbox contains the domain; what is beyond is cut off.
  /// \param number_of_labels including 0.
  /// \param seed_grid number of parts of the box's longest side on which the boundary is looked for; a component
  ///        smaller than a part may be missed.
  /// \throws Domain_error if the labelling returns a number out of range, or nowhere anything but 0.
  Labelled_oracle_3(Labelling labelling, const CGAL::Bbox_3& bbox, int number_of_labels = 2, int seed_grid = 40,
                    Crease_network_3<K> creases = {})
      : Base(bbox, std::move(creases)), labelling_(std::move(labelling)), number_of_labels_(number_of_labels)
  {
    Base::find_seeds(seed_grid);
    bool found = false;
    for (int p = 0; p < number_of_patches(); ++p) found = found || Base::is_expected(p);
    if (!found) throw Domain_error("no point of the boundary was found: the domain is empty or too small", {}, {});
  }

  int label(const Point& p) const
  {
    const int label = labelling_(p);
    if (label < 0 || label >= number_of_labels_)
      throw Domain_error("the labelling returns " + std::to_string(label) + ", which is no label", {}, {});
    return label;
  }

  /// Patches are numbered by their two subdomains, `patch_between()`.
  int patch(int from, int to, const Point&, const Point&) const { return patch_between(from, to); }

  /// The number of the patch between two subdomains: 0-1, 0-2, 1-2, 0-3, ...
  static int patch_between(int a, int b)
  {
    const int low = (std::min)(a, b), high = (std::max)(a, b);
    return high * (high - 1) / 2 + low;
  }
  /// Its two subdomains, the smaller first.
  static std::pair<int, int> sides_of_patch(int patch)
  {
    int high = 1;
    while ((high + 1) * high / 2 <= patch) ++high;
    return {patch - high * (high - 1) / 2, high};
  }
  int number_of_patches() const { return number_of_labels_ * (number_of_labels_ - 1) / 2; }

private:
  Labelling labelling_;
  int number_of_labels_;
};

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_LABELLED_ORACLE_3_H
