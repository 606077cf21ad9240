// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many bad restricted facets a Steiner point would remove, net of those that it would make.

#ifndef WEFT_SPATIAL_REFINE_FACET_GAIN_3_H
#define WEFT_SPATIAL_REFINE_FACET_GAIN_3_H

#include <weft/spatial/criteria/Badness_measure_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Facet_gain_3
{
public:
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Zone = typename Restricted::Zone;
  using Restricted_facet = typename Restricted::Restricted_facet;
  using Measure = Badness_measure_3<Restricted>;

  Facet_gain_3(const Restricted& mesh, const Measure& measure) : mesh_(mesh), measure_(measure) {}

  /// To be told of every new facet.
  void set_bad_facet(std::size_t record, bool is_bad)
  {
    if (record >= is_bad_facet_.size()) is_bad_facet_.resize(record + 1, false);
    is_bad_facet_[record] = is_bad;
  }

  /// Bad facets whose balls the point of a zone enters, less the bad triangles between it and the boundary of their
  /// union, plus `gain`; anything up to `least` if it is less than that. How far such a triangle will be from the
  /// surface is estimated at its circumcenter.
  double operator()(const Zone& zone, double gain, double least) const
  {
    thread_local std::vector<int> records;
    thread_local std::vector<Side> sides;
    sides.clear();
    records.clear();
    for (const Cell_handle c : zone.cells)
      for (int i = 0; i < 4; ++i)
        if (const Restricted_facet* f = mesh_.facet(c, i))
          if (squared(zone.point, f->steiner) < f->squared_radius) records.push_back(c->facet_record(i));
    std::sort(records.begin(), records.end());
    records.erase(std::unique(records.begin(), records.end()), records.end());
    for (const int record : records) {
      const auto r = static_cast<std::size_t>(record);
      gain += is_bad_facet_[r];
      for (int i = 1; i <= 3; ++i) {
        const Vertex_handle v = Measure::vertex(mesh_.facets()[r], i),
                            w = Measure::vertex(mesh_.facets()[r], i % 3 + 1);
        sides.push_back(v->id() < w->id() ? Side(v, w) : Side(w, v));
      }
    }
    keep_single_sides(sides);
    for (const auto& [v, w] : sides) {
      if (gain <= least) return gain;
      gain -= is_bad_facet(zone.point, v->point(), w->point());
    }
    return gain;
  }

private:
  using Side = std::pair<Vertex_handle, Vertex_handle>;

  /// Drops the sides that two facets or more have in common.
  static void keep_single_sides(std::vector<Side>& sides)
  {
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::make_pair(a.first->id(), a.second->id()) < std::make_pair(b.first->id(), b.second->id());
    });
    std::size_t n = 0;
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t j = i + 1;
      while (j < sides.size() && sides[j] == sides[i]) ++j;
      if (j == i + 1) sides[n++] = sides[i];
      i = j;
    }
    sides.resize(n);
  }

  bool is_bad_facet(const Point& p, const Point& q, const Point& r) const
  {
    if (measure_.is_bad_facet(p, q, r)) return true;
    if constexpr (!Restricted::Oracle::labels_first) {
      const double bound = measure_.approximation(p);
      if (bound == 0) return false;
      return !mesh_.oracle().is_within(CGAL::circumcenter(p, q, r), bound * bound);
    }
    return false;
  }

  static double squared(const Point& p, const Point& q) { return CGAL::to_double(CGAL::squared_distance(p, q)); }

  const Restricted& mesh_;
  const Measure& measure_;
  std::vector<char> is_bad_facet_; ///< by record
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_FACET_GAIN_3_H
