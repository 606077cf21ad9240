// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sizing field with one size per region of a planar straight line graph. From the boundary of a finer region sizes
// grow by k per unit of distance (as in Lipschitz_sizing_2), so that a coarse region meets a fine one with good angles.
// A bound on areas, as in Triangle's .poly files, is one on edges: no triangle with edges up to s is larger than the
// equilateral one, √3/4 s².

#ifndef WEFT_PLANAR_SIZING_REGION_SIZING_2_H
#define WEFT_PLANAR_SIZING_REGION_SIZING_2_H

#include <weft/errors.h>
#include <weft/internal/as_index.h>
#include <weft/planar/graph/Mesh_marks_2.h>
#include <weft/sizing/Lipschitz_sizing_2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace weft {

/// Sizing field by regions. Safe to read from many threads; copies share their data.
/// \tparam Cdt the type of triangulation that is meshed.
template <class Cdt>
class Region_sizing_2
{
public:
  using K = typename Cdt::Geom_traits;
  using FT = typename K::FT;
  using Point = typename K::Point_2;

  /// \param cdt as `insert_pslg()` and `mark_domain()` left it, before meshing; it is copied.
  /// \param tags as `insert_pslg()` returned them; area bounds of their regions count.
  /// \param size largest edge length where no other is given, in the input's units.
  /// \param size_of_mark the same for regions with a mark.
  /// \param k growth of the size per unit of distance from a finer region.
  /// \throws Option_error for sizes that aren't positive and finite, and for a mark that no region has.
  Region_sizing_2(const Cdt& cdt, const Mesh_tags_2<K>& tags, double size,
                  const std::map<int, double>& size_of_mark = {}, double k = 0.5)
      : data_(std::make_shared<Data>(cdt, tags, size, size_of_mark, k))
  {}

  /// Largest edge length at a point. Takes as long as locating it in the input's triangulation.
  FT operator()(const Point& p) const { return data_->transition.below(p, FT(data_->size(p))); }

private:
  struct Data
  {
    Data(const Cdt& input, const Mesh_tags_2<K>& tags, double size, const std::map<int, double>& size_of_mark, double k)
        : cdt(input),
          marks(cdt, tags),
          sizes(sizes_of_components(cdt, marks, tags, size, size_of_mark)),
          transition(boundaries(cdt, marks, sizes), k, 0, *std::max_element(sizes.begin(), sizes.end()))
    {}

    double size(const Point& p) const { return sizes[internal::as_index(marks.component(cdt.locate(p)))]; }

    Cdt cdt;
    Mesh_marks_2<Cdt> marks;
    std::vector<double> sizes; ///< per component
    Lipschitz_sizing_2<K> transition;
  };

  static std::vector<double> sizes_of_components(const Cdt& cdt, const Mesh_marks_2<Cdt>& marks,
                                                 const Mesh_tags_2<K>& tags, double size,
                                                 const std::map<int, double>& size_of_mark)
  {
    const auto checked = [](double s) {
      if (!(s > 0) || !std::isfinite(s)) throw Option_error("Region_sizing_2: sizes must be positive and finite");
      return s;
    };
    for (const auto& [mark, s] : size_of_mark)
      if (std::none_of(tags.regions.begin(), tags.regions.end(), [m = mark](const auto& r) { return r.marker == m; }))
        throw Option_error("Region_sizing_2: no region has the mark " + std::to_string(mark));
    std::vector<double> sizes(internal::as_index((std::max)(marks.number_of_components(), 1)), checked(size));
    for (const auto face : cdt.finite_face_handles()) {
      const int i = marks.region_index(face);
      if (i < 0) continue;
      const auto& region = tags.regions[internal::as_index(i)];
      const auto given = size_of_mark.find(region.marker);
      double& s = sizes[internal::as_index(marks.component(face))];
      s = given != size_of_mark.end() ? checked(given->second) : size;
      if (region.max_area > 0) s = (std::min)(s, checked(std::sqrt(4 / std::sqrt(3.) * region.max_area)));
    }
    // Points of the boundary may be located beyond it by rounding: there the boundary's size counts.
    const double largest = *std::max_element(sizes.begin(), sizes.end());
    for (const auto face : cdt.all_face_handles())
      if (!face->is_in_domain()) sizes[internal::as_index(marks.component(face))] = largest;
    return sizes;
  }

  /// Constrained edges between sizes that differ, with the smaller one.
  static auto boundaries(const Cdt& cdt, const Mesh_marks_2<Cdt>& marks, const std::vector<double>& sizes)
  {
    std::vector<typename Lipschitz_sizing_2<K>::Source> sources;
    for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge) {
      const auto [face, i] = *edge;
      const double a = sizes[internal::as_index(marks.component(face))],
                   b = sizes[internal::as_index(marks.component(face->neighbor(i)))], s = (std::min)(a, b);
      if (a != b) sources.push_back({face->vertex(cdt.ccw(i))->point(), face->vertex(cdt.cw(i))->point(), s, s});
    }
    return sources;
  }

  std::shared_ptr<const Data> data_;
};

} // namespace weft

#endif // WEFT_PLANAR_SIZING_REGION_SIZING_2_H
