// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regions into which triangles that meet in edges only cut space, whatever their orientation and however many meet
// in an edge. Each triangle has two sides; around an edge the triangles are sorted by exact predicates, and sides that
// face each other there belong to one region. A triangle with the same region on both sides bounds nothing.

#ifndef WEFT_SPATIAL_SURFACE_SURFACE_REGIONS_3_H
#define WEFT_SPATIAL_SURFACE_SURFACE_REGIONS_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/Triangle_hierarchy_3.h>
#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/surface/check_surface_volume_3.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace weft::internal {

/// See the top of the file.
/// \tparam K a CGAL kernel with exact predicates.
template <class K>
class Surface_regions_3
{
public:
  /// \param net how often each triangle is there as it is turned, less how often the other way.
  Surface_regions_3(const Triangle_surface_3<K>& surface, const std::vector<int>& net)
      : surface_(surface), net_(net), sides_(sorted_sides(surface.triangles)), parts_(2 * surface.triangles.size())
  {
    for_each_edge(sides_, [&](auto first, auto last) { join_around_edge(first, last); });
  }

  /// Whether a triangle has the same region on both sides.
  bool bounds_nothing(std::size_t triangle) { return parts_.find(2 * triangle) == parts_.find(2 * triangle + 1); }

  /// The subdomains behind and before each triangle, 0 for outside: numbered from 1 by first triangle, one for each
  /// region of the domain. The two are equal where a triangle bounds nothing. Regions that have the outside beside them
  /// belong to the domain. Others do, unless the triangles are oriented throughout such that they wind around nothing;
  /// and so on in the regions outside. What lies in a region of the domain without touching its boundary is a cavity.
  /// \param is_union whether what is wound around more than once is part of what it overlaps, and what is wound around
  ///        the other way is outside.
  std::vector<std::pair<int, int>> sides(bool is_union = false)
  {
    collect_components();
    find_windings();
    nest(is_union);
    return number_sides(is_union);
  }

  /// Which triangles have to be turned so that each component looks outwards, wherever it lies. Triangles between
  /// regions within it are turned with the others, if their orientations fit together.
  std::vector<bool> looking_inwards()
  {
    collect_components();
    find_windings();
    std::vector<double> outwards(components_.size(), 0); // area that looks outwards, less what looks inwards
    const auto sign = [this](std::size_t t) {            // 0 between regions within
      const std::size_t outer = components_[regions_[region_of(2 * t)].component].outer;
      return region_of(2 * t + 1) == outer ? 1 : region_of(2 * t) == outer ? -1 : 0;
    };
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      if (bounds_nothing(t)) continue;
      const auto& [a, b, c] = surface_.triangles[t];
      const Xyz_3 origin = xyz(surface_.points[a]);
      outwards[regions_[region_of(2 * t)].component] +=
          sign(t) * norm(cross_product(minus(xyz(surface_.points[b]), origin), minus(xyz(surface_.points[c]), origin)));
    }
    std::vector<bool> is_inwards(surface_.triangles.size(), false);
    for (std::size_t t = 0; t < is_inwards.size(); ++t) {
      if (bounds_nothing(t)) continue;
      const std::size_t component = regions_[region_of(2 * t)].component;
      is_inwards[t] = sign(t) < 0 || (sign(t) == 0 && components_[component].is_consistent && outwards[component] < 0);
    }
    return is_inwards;
  }

private:
  struct Region
  {
    std::size_t component = 0;
    double volume = 0; ///< as bounded by its sides; negative of what is around a component
    Box_3 box;
    int winding = 0;
    bool is_domain = false;
    std::unique_ptr<Triangle_hierarchy_3<K>> boundary;
    std::vector<std::size_t> triangles;
  };
  struct Component
  {
    std::size_t outer = 0, largest = 0;
    double largest_area = -1;
    bool is_consistent = true;
    bool has_parent = false;
    std::size_t parent = 0; ///< the region that it lies in
    std::vector<std::size_t> regions;
  };

  /// The side of a triangle that one comes to when turning around an edge, from low to high, and the one beyond.
  static std::size_t side_before(const Surface_side_3& s) { return 2 * s.triangle + (s.forward ? 0 : 1); }
  static std::size_t side_after(const Surface_side_3& s) { return 2 * s.triangle + (s.forward ? 1 : 0); }

  template <class Iterator>
  void join_around_edge(Iterator first, Iterator last)
  {
    std::vector<Surface_side_3> around(first, last);
    if (around.size() > 2) sort_around_edge(around);
    for (std::size_t i = 0; i < around.size(); ++i)
      parts_.unite(side_after(around[i]), side_before(around[(i + 1) % around.size()]));
  }

  void sort_around_edge(std::vector<Surface_side_3>& around) const
  {
    const auto orientation = K().orientation_3_object();
    const auto coplanar_orientation = K().coplanar_orientation_3_object();
    const auto& points = surface_.points;
    const auto &a = points[around[0].low], &b = points[around[0].high];
    const auto apex = [&](const Surface_side_3& s) { return points[surface_.triangles[s.triangle][(s.side + 2) % 3]]; };
    const auto reference = apex(around[0]);
    std::vector<std::pair<int, Surface_side_3>> sorted;
    for (const Surface_side_3& s : around) {
      const auto turn = orientation(a, b, reference, apex(s));
      const int quarter = turn == CGAL::POSITIVE ? 1
                          : turn == CGAL::NEGATIVE
                              ? 3
                              : (coplanar_orientation(a, b, reference, apex(s)) == CGAL::POSITIVE ? 0 : 2);
      sorted.emplace_back(quarter, s);
    }
    std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& s, const auto& t) {
      if (s.first != t.first) return s.first < t.first;
      return s.first % 2 == 1 && orientation(a, b, apex(s.second), apex(t.second)) == CGAL::POSITIVE;
    });
    for (std::size_t i = 0; i < around.size(); ++i) around[i] = sorted[i].second;
  }

  std::size_t region_of(std::size_t side) { return region_of_part_.at(parts_.find(side)); }

  /// What hangs together across edges, without the triangles that bound nothing; its regions and their volumes.
  void collect_components()
  {
    const std::size_t n = surface_.triangles.size();
    Disjoint_parts connected(n);
    for_each_edge(sides_, [&](auto first, auto last) {
      std::size_t one = n;
      for (; first != last; ++first) {
        if (bounds_nothing(first->triangle)) continue;
        if (one < n) connected.unite(one, first->triangle);
        one = first->triangle;
      }
    });
    std::map<std::size_t, std::size_t> number;
    for (std::size_t t = 0; t < n; ++t) {
      if (bounds_nothing(t)) continue;
      const auto [at, is_new] = number.try_emplace(connected.find(t), components_.size());
      if (is_new) components_.emplace_back();
      Component& component = components_[at->second];
      const Xyz_3 origin = xyz(surface_.points[surface_.triangles[at->first][0]]);
      std::array<Xyz_3, 3> v;
      for (std::size_t i = 0; i < 3; ++i) v[i] = minus(xyz(surface_.points[surface_.triangles[t][i]]), origin);
      const double volume = dot_product(v[0], cross_product(v[1], v[2]));
      const double area = norm(cross_product(minus(v[1], v[0]), minus(v[2], v[0])));
      if (area > component.largest_area) component.largest_area = area, component.largest = t;
      for (const std::size_t side : {2 * t, 2 * t + 1}) {
        const auto [region, is_new_region] = region_of_part_.try_emplace(parts_.find(side), regions_.size());
        if (is_new_region) {
          regions_.emplace_back();
          regions_.back().component = at->second;
          component.regions.push_back(region->second);
        }
        Region& r = regions_[region->second];
        r.volume += side % 2 == 0 ? volume : -volume;
        r.triangles.push_back(t);
        for (const Xyz_3& corner : v)
          for (std::size_t k = 0; k < 3; ++k) {
            r.box.low[k] = (std::min)(r.box.low[k], corner[k] + origin[k]);
            r.box.high[k] = (std::max)(r.box.high[k], corner[k] + origin[k]);
          }
      }
      areas_[std::minmax(region_of(2 * t), region_of(2 * t + 1))].add(region_of(2 * t) < region_of(2 * t + 1), area,
                                                                      net_[t]);
    }
    for (Component& component : components_)
      component.outer =
          *std::min_element(component.regions.begin(), component.regions.end(),
                            [this](std::size_t r, std::size_t s) { return regions_[r].volume < regions_[s].volume; });
  }

  /// How often the triangles as they are given wind around each region, if that is the same on all ways.
  void find_windings()
  {
    std::vector<std::vector<std::pair<std::size_t, int>>> beside(regions_.size());
    for (const auto& [pair, area] : areas_) {
      beside[pair.first].emplace_back(pair.second, area.jump());
      beside[pair.second].emplace_back(pair.first, -area.jump());
    }
    std::vector<bool> is_known(regions_.size(), false);
    for (Component& component : components_) {
      std::vector<std::size_t> pending = {component.outer};
      is_known[component.outer] = true;
      while (!pending.empty()) {
        const std::size_t r = pending.back();
        pending.pop_back();
        for (const auto& [s, jump] : beside[r]) {
          const int winding = regions_[r].winding - jump;
          if (!is_known[s]) {
            is_known[s] = true;
            regions_[s].winding = winding;
            pending.push_back(s);
          } else if (regions_[s].winding != winding) {
            component.is_consistent = false;
          }
        }
      }
      for (const auto& [s, jump] : beside[component.outer])
        if (jump == 0) component.is_consistent = false;
    }
  }

  bool contains(Region& region, const Xyz_3& x, const typename K::Point_3& p)
  {
    for (std::size_t k = 0; k < 3; ++k)
      if (x[k] < region.box.low[k] || x[k] > region.box.high[k]) return false;
    if (!region.boundary) {
      std::vector<Surface_triangle_3<K>> triangles;
      for (const std::size_t t : region.triangles) triangles.push_back(hierarchy_triangle(surface_, t));
      region.boundary = std::make_unique<Triangle_hierarchy_3<K>>(triangles);
    }
    return region.boundary->subdomain(p) != 0;
  }

  /// Which region each component lies in, and what of it belongs to the domain.
  void nest(bool is_union)
  {
    std::vector<std::size_t> order(components_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [this](std::size_t c, std::size_t d) {
      return regions_[components_[c].outer].volume < regions_[components_[d].outer].volume;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      Component& component = components_[order[i]];
      const auto& [a, b, c] = surface_.triangles[component.largest];
      Xyz_3 x;
      for (std::size_t k = 0; k < 3; ++k)
        x[k] = xyz(surface_.points[a])[k] / 3 + xyz(surface_.points[b])[k] / 3 + xyz(surface_.points[c])[k] / 3;
      const typename K::Point_3 p(x[0], x[1], x[2]);
      for (std::size_t j = 0; j < i; ++j)
        for (const std::size_t r : components_[order[j]].regions)
          if (r != components_[order[j]].outer && contains(regions_[r], x, p)) {
            component.has_parent = true;
            component.parent = r; // the last is the innermost
          }
      const bool is_cavity = component.has_parent && regions_[component.parent].is_domain;
      for (const std::size_t r : component.regions)
        regions_[r].is_domain = r == component.outer
                                    ? is_cavity
                                    : !is_cavity && (!component.is_consistent ||
                                                     (is_union ? regions_[r].winding > 0 : regions_[r].winding != 0));
    }
  }

  /// The region that stands for all that are one: the outer one of a component is that around it.
  std::size_t standing_for(std::size_t region) const
  {
    const Component& component = components_[regions_[region].component];
    return region == component.outer && component.has_parent ? standing_for(component.parent) : region;
  }

  std::vector<std::pair<int, int>> number_sides(bool is_union)
  {
    Disjoint_parts united(regions_.size());
    for (const auto& [pair, area] : areas_)
      if (is_union && components_[regions_[pair.first].component].is_consistent && area.jump() != 0 &&
          regions_[pair.first].is_domain && regions_[pair.second].is_domain &&
          pair.first != components_[regions_[pair.first].component].outer &&
          pair.second != components_[regions_[pair.second].component].outer)
        united.unite(pair.first, pair.second);
    if (is_union) unite_slivers(united);

    std::vector<std::pair<int, int>> sides(surface_.triangles.size(), {0, 0});
    std::map<std::size_t, int> label;
    const auto label_of = [&](std::size_t side) {
      const std::size_t region = region_of(side);
      if (!regions_[region].is_domain) return 0;
      return label.try_emplace(united.find(standing_for(region)), static_cast<int>(label.size()) + 1).first->second;
    };
    for (std::size_t t = 0; t < sides.size(); ++t) {
      if (bounds_nothing(t)) continue;
      sides[t].first = label_of(2 * t);
      sides[t].second = label_of(2 * t + 1);
    }
    return sides;
  }

  /// Where parts cross that aren't turned alike there are many tiny regions between their facets: each becomes part of
  /// that region of the domain with which it has the largest area in common.
  void unite_slivers(Disjoint_parts& united) const
  {
    for (bool changes = true; changes;) {
      changes = false;
      std::map<std::size_t, double> volumes;
      double all = 0;
      for (std::size_t r = 0; r < regions_.size(); ++r)
        if (regions_[r].is_domain)
          volumes[united.find(standing_for(r))] += regions_[r].volume, all += regions_[r].volume;
      std::map<std::size_t, std::pair<double, std::size_t>> most; // of each, what it has most in common with
      for (const auto& [pair, area] : areas_) {
        if (!regions_[pair.first].is_domain || !regions_[pair.second].is_domain) continue;
        const std::size_t a = united.find(standing_for(pair.first)), b = united.find(standing_for(pair.second));
        for (const auto& [one, other] : {std::make_pair(a, b), std::make_pair(b, a)})
          if (a != b) most[one] = (std::max)(most[one], std::make_pair(area.total, other));
      }
      for (const auto& [region, neighbour] : most)
        if (volumes[region] <= 1e-4 * all) united.unite(region, neighbour.second), changes = true;
    }
  }

  /// The area between two regions, and how much more of it is turned to the second than to the first.
  struct Area
  {
    double total = 0, turned = 0;
    void add(bool to_second, double area, int net)
    {
      total += area;
      turned += (to_second ? net : -net) * area;
    }
    int jump() const { return turned >= total / 2 ? 1 : turned <= -total / 2 ? -1 : 0; }
  };

  const Triangle_surface_3<K>& surface_;
  const std::vector<int>& net_;
  std::vector<Surface_side_3> sides_;
  Disjoint_parts parts_; ///< of sides of triangles: 2t behind triangle t, 2t + 1 before it
  std::map<std::size_t, std::size_t> region_of_part_;
  std::vector<Region> regions_;
  std::vector<Component> components_;
  std::map<std::pair<std::size_t, std::size_t>, Area> areas_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_SURFACE_REGIONS_3_H
