// SPDX-License-Identifier: GPL-3.0-or-later
//
// Watches that optimisation undoes nothing that refinement has achieved: which elements violate a criterion, lack a
// topological disk, hang on an interior vertex or lie farther from the surface than any facet did at the start. What
// was bad at the start is tolerated.

#ifndef WEFT_SPATIAL_CRITERIA_GUARD_3_H
#define WEFT_SPATIAL_CRITERIA_GUARD_3_H

#include <weft/spatial/circumcenter_3.h>
#include <weft/spatial/Criteria_3.h>
#include <weft/spatial/measure_badness_3.h>
#include <weft/spatial/topological_disk_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

namespace weft {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Criteria_guard_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Cell_handle = typename Restricted::Cell_handle;

  /// An element by the sorted ids of its vertices, filled up with -1.
  using Element = std::array<int, 4>;

  /// Elements that are bad now are tolerated from now on. Linear in the size of the mesh.
  Criteria_guard_3(const Restricted& mesh, const Criteria_3<Kernel>& criteria)
      : mesh_(mesh), measure_(mesh, criteria, 1)
  {
    const Part all = everything();
    const CGAL::Bbox_3 b = mesh.oracle().bbox();
    const double rounding = 1e-6 * std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
    deviation_bound_ = crease_deviation_bound_ = rounding * rounding; // on flat patches all that is seen
    for (const int record : all.facets)
      deviation_bound_ =
          (std::max)(deviation_bound_, squared_deviation(mesh.facets()[static_cast<std::size_t>(record)]));
    deviation_bound_ *= closer * closer;
    for (const auto& e : mesh.creases().edges())
      crease_deviation_bound_ = (std::max)(crease_deviation_bound_, squared_deviation(e));
    for (const Element& e : offenders(all)) tolerated_.insert(e);
  }

  /// Before anything is classified: whether cells would be good if they belong to the domain, which their circumcenters
  /// decide. Sets those.
  bool may_accept(const std::vector<Cell_handle>& cells) const
  {
    for (const Cell_handle c : cells) {
      if (Restricted::is_at_box(c)) continue;
      c->set_circumcenter(circumcenter_3<Kernel>(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(),
                                                 c->vertex(3)->point()));
      if (measure_.cell(c).is_bad() && mesh_.oracle().subdomain(c->circumcenter()) != 0 &&
          tolerated_.count(key(c)) == 0)
        return false;
    }
    return true;
  }

  /// Whether what the last change has made is good: the same as `new_offenders().empty()` but sooner at its end, and
  /// with crease edges looked up only where the change was.
  bool accepts_change() const
  {
    for (const int record : mesh_.new_facets()) {
      const auto& f = mesh_.facets()[static_cast<std::size_t>(record)];
      if (is_bad(f) && tolerated_.count(key(f)) == 0) return false;
    }
    for (const Cell_handle c : mesh_.new_cells())
      if (c->subdomain() != 0 && measure_.cell(c).is_bad() && tolerated_.count(key(c)) == 0) return false;
    for (const Cell_handle c : mesh_.new_cells())
      if (has_bad_crease_edge(c)) return false;
    for (const int id : boundary_vertices(mesh_.new_cells()))
      if (tolerated_.count({id, -1, -1, -1}) == 0 &&
          !has_topological_disk(mesh_, mesh_.vertices()[static_cast<std::size_t>(id)]))
        return false;
    return true;
  }

  /// The bad elements among those that the last change of the mesh has made, and all bad crease edges.
  std::vector<Element> new_offenders() const { return offenders({mesh_.new_cells(), mesh_.new_facets()}); }

  /// Whether an element exists and is bad.
  bool is_offending(const Element& e) const
  {
    if (tolerated_.count(e) > 0) return false;
    const auto& tr = mesh_.triangulation();
    const auto v = [&](std::size_t i) { return mesh_.vertices()[static_cast<std::size_t>(e[i])]; };
    Cell_handle c;
    int i, j, k, l;
    if (e[3] >= 0)
      return tr.is_cell(v(0), v(1), v(2), v(3), c, i, j, k, l) && c->subdomain() != 0 && measure_.cell(c).is_bad();
    if (e[2] >= 0) {
      if (!tr.is_facet(v(0), v(1), v(2), c, i, j, k)) return false;
      const auto* f = mesh_.facet(c, 6 - i - j - k);
      return f && is_bad(*f);
    }
    if (e[1] >= 0) {
      const auto* crease_edge = mesh_.creases().edge(v(0), v(1));
      return crease_edge && is_bad(*crease_edge);
    }
    return !has_topological_disk(mesh_, v(0));
  }

private:
  struct Part
  {
    std::vector<Cell_handle> cells;
    std::vector<int> facets;
  };

  Part everything() const
  {
    Part all;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) all.cells.push_back(c);
    for (std::size_t f = 0; f < mesh_.facets().size(); ++f)
      if (mesh_.facets()[f].cell != Cell_handle()) all.facets.push_back(static_cast<int>(f));
    return all;
  }

  std::vector<Element> offenders(const Part& part) const
  {
    std::vector<Element> bad;
    const auto add = [&](const Element& e) {
      if (tolerated_.count(e) == 0) bad.push_back(e);
    };
    for (const int record : part.facets) {
      const auto& f = mesh_.facets()[static_cast<std::size_t>(record)];
      if (f.cell != Cell_handle() && is_bad(f)) add(key(f));
    }
    for (const Cell_handle c : part.cells)
      if (c->subdomain() != 0 && measure_.cell(c).is_bad()) add(key(c));
    for (const auto& e : mesh_.creases().edges())
      if (is_bad(e)) add(key(e));
    for (const int id : boundary_vertices(part.cells))
      if (!has_topological_disk(mesh_, mesh_.vertices()[static_cast<std::size_t>(id)])) add({id, -1, -1, -1});
    return bad;
  }

  bool is_bad(const typename Restricted::Restricted_facet& f) const
  {
    return hangs_inside(f) || measure_.facet(f).is_bad() || squared_deviation(f) > deviation_bound_;
  }

  /// Squared distance of a facet from the surface, sampled. The distance that refinement bounds is that along the
  /// facet's axis.
  double squared_deviation(const typename Restricted::Restricted_facet& f) const
  {
    const auto& a = f.cell->vertex((f.index + 1) & 3)->point();
    const auto& b = f.cell->vertex((f.index + 2) & 3)->point();
    const auto& c = f.cell->vertex((f.index + 3) & 3)->point();
    double farthest = 0;
    const auto ab = b - a, ac = c - a;
    for (const auto& [s, t] : samples) {
      const auto p = a + s * ab + t * ac;
      farthest = (std::max)(farthest, CGAL::to_double(CGAL::squared_distance(p, mesh_.oracle().closest(p).point)));
    }
    return farthest;
  }

  bool is_bad(const typename Restricted::Crease_edge& e) const
  {
    return measure_.crease_edge(e).is_bad() || squared_deviation(e) > crease_deviation_bound_;
  }

  /// Squared distance of the farthest corner of a crease from the edge that stands for it there: those corners to both
  /// sides of its Steiner point whose projections lie between the ends of the edge.
  double squared_deviation(const typename Restricted::Crease_edge& e) const
  {
    const auto& points = mesh_.creases().points(static_cast<std::size_t>(e.steiner_crease));
    const auto& a = e.source->point();
    const auto ab = e.target->point() - a;
    const double length = CGAL::to_double(ab.squared_length());
    double farthest = 0;
    const auto visit = [&](std::size_t i) {
      const auto ap = points[i] - a;
      const double t = CGAL::to_double(ap * ab) / length;
      if (!(t > 0 && t < 1)) return false;
      farthest = (std::max)(farthest, CGAL::to_double((ap - t * ab).squared_length()));
      return true;
    };
    const auto middle = static_cast<std::size_t>(e.position);
    for (std::size_t i = middle + 1; i < points.size() && visit(i);) ++i;
    for (std::size_t i = middle + 1; i-- > 0 && visit(i);) {
    }
    return farthest;
  }

  bool has_bad_crease_edge(Cell_handle c) const
  {
    if (mesh_.creases().edges().empty()) return false;
    for (int i = 0; i < 3; ++i)
      for (int j = i + 1; j < 4; ++j) {
        const auto* e = mesh_.creases().edge(c->vertex(i), c->vertex(j));
        if (e && is_bad(*e) && tolerated_.count(key(*e)) == 0) return true;
      }
    return false;
  }

  /// The boundary belongs to the vertices on it.
  static bool hangs_inside(const typename Restricted::Restricted_facet& f)
  {
    for (int i = 1; i < 4; ++i)
      if (f.cell->vertex((f.index + i) & 3)->location().dimension > 2) return true;
    return false;
  }

  static std::vector<int> boundary_vertices(const std::vector<Cell_handle>& cells)
  {
    std::vector<int> ids;
    for (const Cell_handle c : cells)
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i)->id() >= 0 && c->vertex(i)->location().dimension <= 2) ids.push_back(c->vertex(i)->id());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  static Element sorted(Element ids)
  {
    std::sort(ids.begin(), ids.end(), [](int a, int b) { return a > b; });
    return ids;
  }
  static Element key(const typename Restricted::Crease_edge& e)
  {
    return sorted({e.source->id(), e.target->id(), -1, -1});
  }
  static Element key(Cell_handle c)
  {
    return sorted({c->vertex(0)->id(), c->vertex(1)->id(), c->vertex(2)->id(), c->vertex(3)->id()});
  }
  static Element key(const typename Restricted::Restricted_facet& f)
  {
    const auto id = [&f](int i) { return f.cell->vertex((f.index + i) & 3)->id(); };
    return sorted({id(1), id(2), id(3), -1});
  }

  /// Barycentric coordinates of where facets are held against the surface. With the centroid and the midpoints of
  /// the edges alone, smoothing raises the distance of the dragknob by a third unseen; with these by 15 %.
  static constexpr double samples[][2] = {{1. / 3, 1. / 3}, {.6, .2},   {.2, .6},  {.2, .2}, {.5, 0},
                                          {0, .5},          {.5, .5},   {.25, 0},  {.75, 0}, {0, .25},
                                          {0, .75},         {.25, .75}, {.75, .25}};
  static constexpr double closer = 0.9; ///< for what lies between the samples

  const Restricted& mesh_;
  Badness_measure_3<Restricted> measure_;
  std::set<Element> tolerated_;
  double crease_deviation_bound_ = std::numeric_limits<double>::infinity(); ///< squared
  double deviation_bound_ = std::numeric_limits<double>::infinity();        ///< squared
};

} // namespace weft

#endif // WEFT_SPATIAL_CRITERIA_GUARD_3_H
