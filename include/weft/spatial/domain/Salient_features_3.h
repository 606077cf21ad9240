// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a polyhedral surface bends: its folds, which are edges with an angle that isn't large enough for a crease, and
// the vertices at their ends. A Steiner point that may lie anywhere in some ball does most for the approximation if it
// lies on one of them; facets then line up with the folds instead of cutting across. Not in the thesis: coarse surfaces
// take half to two thirds of the vertices with it; surfaces whose triangles are much smaller than the mesh's stay as
// they were.

#ifndef WEFT_SPATIAL_DOMAIN_SALIENT_FEATURES_3_H
#define WEFT_SPATIAL_DOMAIN_SALIENT_FEATURES_3_H

#include <weft/internal/boxes/Box_hierarchy_3.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/nearest_point_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft::internal {

/// The folds of a surface inside its patches, and their ends.
template <class K>
class Salient_features_3
{
public:
  using Point = typename K::Point_3;

  /// Angles between the normals of two triangles, in degrees.
  struct Bends
  {
    double fold;         ///< the smallest at a fold
    double ridge;        ///< the smallest at a ridge
    double sharp, acute; ///< between them nothing attracts. Along sharp edges that aren't creases, the restricted
                         ///< Delaunay triangulation of points on the edge itself needn't be a surface at any scale;
                         ///< beside acute ones mirrored pairs make it one, see Acute_edges_3.h.
  };

  Salient_features_3() = default;

  /// O(n log n).
  Salient_features_3(const Piecewise_smooth_complex_3<K>& complex, const Bends& bends)
  {
    const Bends cosines{cosine_of_degrees(bends.fold), cosine_of_degrees(bends.ridge), cosine_of_degrees(bends.sharp),
                        cosine_of_degrees(bends.acute)};
    std::vector<char> is_end(complex.points.size(), false), is_sharp(complex.points.size(), false);
    std::vector<int> patch(complex.points.size(), -1);
    std::vector<double> angle(complex.points.size(), 0);
    find_folds(complex, cosines, is_end, is_sharp, patch, angle);
    for (const auto& crease : complex.creases)
      for (const std::size_t v : crease.vertices) is_end[v] = false;
    for (const auto& feature : complex.features) is_end[feature.vertex] = false;
    std::vector<Box_3> boxes;
    for (std::size_t v = 0; v < complex.points.size(); ++v) {
      if (!is_end[v]) continue;
      vertices_.push_back({complex.points[v], patch[v], angle[v], !is_sharp[v]});
      boxes.emplace_back();
      boxes.back().add(complex.points[v].x(), complex.points[v].y(), complex.points[v].z());
    }
    vertex_boxes_ = Box_hierarchy_3(boxes);
    vertices_ = by_block(vertices_, vertex_boxes_);
  }

  bool empty() const { return folds_.empty(); }

  /// Moves `p` to a vertex of a fold within `vertex_reach`, else to a point of one within `fold_reach`, on the given
  /// patch. Of several the one with the largest angle, less in proportion to its distance: that takes fewer vertices
  /// than the nearest. Returns whether there was one.
  bool attract(Point& p, double vertex_reach, double fold_reach, int patch) const
  {
    const Point center = p;
    double best = 0;
    const auto take = [&](const Point& x, double angle, double reach) {
      const Xyz_3 d = difference(x, center);
      const double score = angle * (1 - norm(d) / reach);
      if (!(score > best)) return; // equally good ones: the first
      best = score;
      p = x;
    };
    visit_near(vertex_boxes_, center, vertex_reach * vertex_reach, [&](std::uint32_t item) {
      const Vertex& v = vertices_[item];
      if (v.patch == patch && v.attracts) take(v.point, v.angle, vertex_reach);
    });
    if (best > 0) return true;
    visit_near(fold_boxes_, center, fold_reach * fold_reach, [&](std::uint32_t item) {
      const Fold& fold = folds_[item];
      if (fold.patch == patch) take(nearest_point_on_segment(center, fold.source, fold.target), fold.angle, fold_reach);
    });
    return best > 0;
  }

  /// Calls `visit(point, whether it attracts)` for every vertex of a fold on the patch in a ball, and perhaps for some
  /// outside.
  template <class Visit>
  void visit_vertices(const Point& center, double squared_radius, int patch, const Visit& visit) const
  {
    visit_near(vertex_boxes_, center, squared_radius, [&](std::uint32_t item) {
      if (vertices_[item].patch == patch) visit(vertices_[item].point, vertices_[item].attracts);
    });
  }

  /// Calls `visit(source, target, whether it attracts)` for every ridge on the patch that meets a ball, and perhaps for
  /// some outside. Ridges are folds with large angles, and sharp edges that aren't creases.
  template <class Visit>
  void visit_ridges(const Point& center, double squared_radius, int patch, const Visit& visit) const
  {
    visit_near(ridge_boxes_, center, squared_radius, [&](std::uint32_t item) {
      const Fold& ridge = ridges_[item];
      if (ridge.patch == patch) visit(ridge.source, ridge.target, ridge.attracts);
    });
  }

private:
  struct Vertex
  {
    Point point;
    int patch;
    double angle; ///< the largest of its folds
    bool attracts;
  };
  struct Fold
  {
    Point source, target;
    int patch;
    double angle; ///< between the normals, radians
    bool attracts;
  };

  void find_folds(const Piecewise_smooth_complex_3<K>& complex, const Bends& cosines, std::vector<char>& is_end,
                  std::vector<char>& is_sharp, std::vector<int>& patch, std::vector<double>& angle)
  {
    std::vector<Box_3> boxes, ridge_boxes;
    visit_opposite_sides(complex.triangles, [&](std::size_t t, std::size_t other, std::size_t a, std::size_t b) {
      if (complex.patches[t] != complex.patches[other]) return;
      const double cosine = cosine_of_bend(complex, t, other);
      if (!(cosine < cosines.fold)) return;
      const bool attracts = cosine >= cosines.sharp || cosine < cosines.acute;
      const Fold fold{complex.points[a], complex.points[b], complex.patches[t], std::acos((std::max)(-1.0, cosine)),
                      attracts};
      Box_3 box;
      for (const std::size_t v : {a, b}) box.add(complex.points[v].x(), complex.points[v].y(), complex.points[v].z());
      if (cosine < cosines.ridge) {
        ridges_.push_back(fold);
        ridge_boxes.push_back(box);
      }
      if (attracts) {
        folds_.push_back(fold);
        boxes.push_back(box);
      }
      for (const std::size_t v : {a, b}) {
        is_end[v] = true;
        is_sharp[v] = is_sharp[v] || !attracts;
        angle[v] = (std::max)(angle[v], fold.angle);
        patch[v] = complex.patches[t];
      }
    });
    fold_boxes_ = Box_hierarchy_3(boxes);
    ridge_boxes_ = Box_hierarchy_3(ridge_boxes);
    folds_ = by_block(folds_, fold_boxes_);
    ridges_ = by_block(ridges_, ridge_boxes_);
  }

  /// Items in the order of the hierarchy's blocks, as they are visited.
  template <class Item>
  static std::vector<Item> by_block(const std::vector<Item>& items, const Box_hierarchy_3& boxes)
  {
    std::vector<Item> ordered(boxes.items().size());
    for (std::size_t i = 0; i < ordered.size(); ++i)
      if (boxes.items()[i] != Box_hierarchy_3::nothing) ordered[i] = items[boxes.items()[i]];
    return ordered;
  }

  static Xyz_3 normal(const Piecewise_smooth_complex_3<K>& complex, std::size_t t)
  {
    const auto& v = complex.triangles[t];
    return cross_product(difference(complex.points[v[1]], complex.points[v[0]]),
                         difference(complex.points[v[2]], complex.points[v[0]]));
  }

  static double cosine_of_bend(const Piecewise_smooth_complex_3<K>& complex, std::size_t t, std::size_t u)
  {
    const auto m = normal(complex, t), n = normal(complex, u);
    return dot_product(m, n) / (norm(m) * norm(n));
  }

  /// Calls `visit(item)` for the items, by block, within a distance of p, and for some beyond.
  template <class Visit>
  static void visit_near(const Box_hierarchy_3& boxes, const Point& p, double squared_distance, const Visit& visit)
  {
    const auto framed = boxes.frame()(p.x(), p.y(), p.z());
    const std::array<float, 3> from{
        {static_cast<float>(framed[0]), static_cast<float>(framed[1]), static_cast<float>(framed[2])}};
    const double error = (1 + (std::max)({std::abs(from[0]), std::abs(from[1]), std::abs(from[2])})) * 1e-6;
    const double padded = std::sqrt(squared_distance) * boxes.frame().scale * (1 + 1e-6) + error;
    boxes.visit_nearest(from, static_cast<float>(padded * padded * (1 + 1e-6)), [&](std::uint32_t block, float limit) {
      for (std::uint32_t i = 4 * block; i < 4 * block + 4; ++i) {
        if (boxes.items()[i] == Box_hierarchy_3::nothing) break;
        visit(i);
      }
      return limit;
    });
  }

  std::vector<Vertex> vertices_; ///< by block, like the others
  std::vector<Fold> folds_;
  std::vector<Fold> ridges_; ///< some of the folds, and what is sharper
  Box_hierarchy_3 vertex_boxes_, fold_boxes_, ridge_boxes_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_SALIENT_FEATURES_3_H
