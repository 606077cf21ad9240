// SPDX-License-Identifier: GPL-3.0-or-later
//
// The creases of an image whose labels reach its border: the edges of the box, and on its faces the curves where labels
// meet (as CGAL's Detect_features_on_image_bbox does from 5.6 on). Curves are followed from square to square between
// four voxel centers, as marching squares do.

#ifndef WEFT_SPATIAL_DOMAIN_IMAGE_BORDER_3_H
#define WEFT_SPATIAL_DOMAIN_IMAGE_BORDER_3_H

#include <weft/spatial/domain/Crease_network_3.h>
#include <weft/spatial/domain/Voxel_image_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft::internal {

/// Finds them.
/// \tparam K a CGAL kernel whose coordinates are doubles.
template <class K>
class Image_border_3
{
public:
  using Point = typename K::Point_3;
  using Voxel = Voxel_image_3::Voxel;

  explicit Image_border_3(const Voxel_image_3& image) : image_(image)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) add_edges_of_box(axis);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) add_curves(axis, side);
  }

  /// Corners where box edges meet, where curves meet them, and where more than two curves meet.
  Crease_network_3<K> creases() const
  {
    std::map<Key, std::vector<std::size_t>> pieces_at;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      pieces_at[pieces_[i].from].push_back(i);
      pieces_at[pieces_[i].to].push_back(i);
    }
    std::vector<Point> corners;
    for (const auto& [key, pieces] : pieces_at)
      if (is_corner(key, pieces)) corners.push_back(places_.at(key));
    std::vector<char> is_used(pieces_.size(), false);
    std::vector<Crease_polyline_3<K>> creases;
    // From corners first; what is left are cycles.
    for (const bool cycles : {false, true})
      for (const auto& [key, pieces] : pieces_at)
        if (cycles || is_corner(key, pieces))
          for (const std::size_t i : pieces)
            if (!is_used[i]) creases.push_back(followed(key, i, pieces_at, is_used));
    return Crease_network_3<K>(std::move(corners), std::move(creases));
  }

private:
  /// Places in half voxels: even numbers are centers, odd ones lie between, -1 and 2n - 1 on the box.
  using Key = std::array<std::ptrdiff_t, 3>;

  struct Piece
  {
    Key from, to;
    std::vector<Point> between;
  };

  std::ptrdiff_t count(std::size_t axis) const { return static_cast<std::ptrdiff_t>(image_.size()[axis]); }
  bool is_on_face(const Key& key, std::size_t axis) const
  {
    return key[axis] == -1 || key[axis] == 2 * count(axis) - 1;
  }

  /// On edges of the box everything ends.
  bool is_corner(const Key& key, const std::vector<std::size_t>& pieces) const
  {
    return pieces.size() != 2 || is_on_face(key, 0) + is_on_face(key, 1) + is_on_face(key, 2) > 1;
  }

  Crease_polyline_3<K> followed(const Key& start, std::size_t piece,
                                const std::map<Key, std::vector<std::size_t>>& pieces_at,
                                std::vector<char>& is_used) const
  {
    Crease_polyline_3<K> crease;
    Key at = start;
    for (;;) {
      is_used[piece] = true;
      const Piece& p = pieces_[piece];
      crease.points.push_back(places_.at(at));
      const bool forwards = p.from == at;
      if (forwards)
        crease.points.insert(crease.points.end(), p.between.begin(), p.between.end());
      else
        crease.points.insert(crease.points.end(), p.between.rbegin(), p.between.rend());
      at = forwards ? p.to : p.from;
      const auto& next = pieces_at.at(at);
      if (is_corner(at, next)) {
        crease.points.push_back(places_.at(at));
        return crease;
      }
      piece = next[0] == piece ? next[1] : next[0];
      if (is_used[piece]) {
        crease.closed = true;
        return crease;
      }
    }
  }

  void add_place(const Key& key, const std::array<double, 3>& place)
  {
    places_.try_emplace(key, Point(place[0], place[1], place[2]));
  }
  void add_piece(const Key& from, const Key& to, std::vector<Point> between = {})
  {
    pieces_.push_back({from, to, std::move(between)});
  }

  /// The stretches of the four edges of the box along an axis that have a subdomain behind them.
  void add_edges_of_box(std::size_t axis)
  {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int side_u = 0; side_u < 2; ++side_u)
      for (int side_v = 0; side_v < 2; ++side_v) {
        Voxel at{{0, 0, 0}};
        at[u] = side_u * (count(u) - 1), at[v] = side_v * (count(v) - 1);
        Key from{{-1, -1, -1}};
        from[u] = side_u == 0 ? -1 : 2 * count(u) - 1, from[v] = side_v == 0 ? -1 : 2 * count(v) - 1;
        std::array<double, 3> place;
        place[u] = image_.border(u, side_u), place[v] = image_.border(v, side_v);
        place[axis] = image_.border(axis, 0);
        std::array<double, 3> place_from = place;
        for (; at[axis] < count(axis); ++at[axis]) {
          const bool is_last = at[axis] + 1 == count(axis);
          Voxel next = at;
          ++next[axis];
          const int label = image_.label(at);
          if (!is_last && image_.label(next) == label) continue;
          Key to = from;
          to[axis] = 2 * at[axis] + 1;
          place[axis] = is_last ? image_.border(axis, 1)
                                : image_.coordinate(axis, static_cast<double>(at[axis]) + image_.crossing(at, next));
          if (label != 0) {
            add_place(from, place_from);
            add_place(to, place);
            add_piece(from, to);
          }
          from = to, place_from = place;
        }
      }
  }

  /// The curves between labels on a face.
  void add_curves(std::size_t axis, int side)
  {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    Voxel at;
    at[axis] = side * (count(axis) - 1);
    const std::ptrdiff_t layer = side == 0 ? -1 : 2 * count(axis) - 1;
    for (at[v] = 0; at[v] < count(v); ++at[v])
      for (at[u] = 0; at[u] < count(u); ++at[u]) {
        if (at[u] + 1 < count(u) && at[v] + 1 < count(v)) add_square(at, axis, side, layer);
        // From the outermost centers curves run straight to the edges of the box.
        for (const bool along_u : {true, false}) {
          const std::size_t a = along_u ? u : v, b = along_u ? v : u;
          if (at[b] != 0 && at[b] + 1 != count(b)) continue;
          Voxel next = at;
          if (++next[a] >= count(a) || image_.label(at) == image_.label(next)) continue;
          for (int end = 0; end < 2; ++end) {
            if (at[b] != end * (count(b) - 1)) continue;
            Key from, to;
            const std::array<double, 3> place = add_crossing(at, next, a, axis, side, layer, from);
            to = from;
            to[b] = end == 0 ? -1 : 2 * count(b) - 1;
            std::array<double, 3> place_to = place;
            place_to[b] = image_.border(b, end);
            add_place(to, place_to);
            add_piece(from, to);
          }
        }
      }
  }

  /// Where the label changes between neighbours along `a`, on a face across `axis`.
  std::array<double, 3> add_crossing(const Voxel& from, const Voxel& to, std::size_t a, std::size_t axis, int side,
                                     std::ptrdiff_t layer, Key& key)
  {
    std::array<double, 3> place;
    for (std::size_t k = 0; k < 3; ++k) {
      key[k] = 2 * from[k];
      place[k] = image_.coordinate(k, static_cast<double>(from[k]));
    }
    key[axis] = layer, place[axis] = image_.border(axis, side);
    key[a] = from[a] + to[a];
    const Voxel& low = from[a] < to[a] ? from : to;
    const Voxel& high = from[a] < to[a] ? to : from;
    place[a] = image_.coordinate(a, static_cast<double>(low[a]) + image_.crossing(low, high));
    add_place(key, place);
    return place;
  }

  /// The curves in the square from `low` on, between the centers of four voxels.
  void add_square(const Voxel& low, std::size_t axis, int side, std::ptrdiff_t layer)
  {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<Voxel, 4> square{{low, low, low, low}}; // in order around
    ++square[1][u], ++square[2][u], ++square[2][v], ++square[3][v];
    std::array<int, 4> labels;
    for (std::size_t i = 0; i < 4; ++i) labels[i] = image_.label(square[i]);
    std::array<Key, 4> keys; // of the crossing between voxels i and i + 1
    std::vector<std::size_t> crossed;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t next = (i + 1) % 4;
      if (labels[i] == labels[next]) continue;
      crossed.push_back(i);
      add_crossing(square[i], square[next], i % 2 == 0 ? u : v, axis, side, layer, keys[i]);
    }
    if (crossed.empty()) return;
    const auto sides = [&](std::size_t i) { return std::array<int, 2>{{labels[i], labels[(i + 1) % 4]}}; };
    const auto add = [&](std::size_t i, std::size_t j) { add_curve(keys[i], keys[j], u, v, sides(i)); };
    if (crossed.size() == 2) return add(crossed[0], crossed[1]);
    Key middle{};
    middle[axis] = layer, middle[u] = 2 * low[u] + 1, middle[v] = 2 * low[v] + 1;
    std::array<double, 2> at{{0.5, 0.5}};
    if (crossed.size() == 4) {
      const int through = image_.label_across(square);
      if (through >= 0) { // two curves, around the two corners with other labels
        const bool even = labels[0] == through && labels[2] == through;
        for (const std::size_t i : {std::size_t(even ? 1 : 0), std::size_t(even ? 3 : 2)}) add((i + 3) % 4, i);
        return;
      }
    } else {
      // Voxels i and i + 1 have the same label: three labels weigh the same two thirds of the way to the other side.
      std::size_t i = 0;
      while (labels[i] != labels[(i + 1) % 4]) ++i;
      constexpr double third = 1. / 3;
      constexpr std::array<double, 2> places[] = {
          {{0.5, 2 * third}}, {{third, 0.5}}, {{0.5, third}}, {{2 * third, 0.5}}};
      at = places[i];
    }
    std::array<double, 3> place;
    place[axis] = image_.border(axis, side);
    place[u] = image_.coordinate(u, static_cast<double>(low[u]) + at[0]);
    place[v] = image_.coordinate(v, static_cast<double>(low[v]) + at[1]);
    add_place(middle, place);
    for (const std::size_t i : crossed) add_curve(keys[i], middle, u, v, sides(i));
  }

  /// A curve in a square, with three points on the way.
  /// \param sides the labels beside it.
  void add_curve(const Key& from, const Key& to, std::size_t u, std::size_t v, const std::array<int, 2>& sides)
  {
    const Point a = places_.at(from), b = places_.at(to), middle = refined(a, b, u, v, sides);
    add_piece(from, to, {refined(a, middle, u, v, sides), middle, refined(middle, b, u, v, sides)});
  }

  /// A point of the curve beside the middle of two of its points: where the labels change nearest to it.
  Point refined(const Point& a, const Point& b, std::size_t u, std::size_t v, const std::array<int, 2>& sides) const
  {
    const std::array<double, 3> p{{a.x(), a.y(), a.z()}}, q{{b.x(), b.y(), b.z()}};
    const auto at = [&](double t) {
      std::array<double, 3> x;
      for (std::size_t k = 0; k < 3; ++k) x[k] = 0.5 * (p[k] + q[k]);
      x[u] -= t * (q[v] - p[v]);
      x[v] += t * (q[u] - p[u]);
      return x;
    };
    const auto changes = [&](double s, double t) {
      const int x = image_.label_at(at(s)), y = image_.label_at(at(t));
      return (x == sides[0] && y == sides[1]) || (x == sides[1] && y == sides[0]);
    };
    constexpr int steps = 10;
    constexpr double step = 0.05; // of the length; curves bend less than all of them
    double t = 0;
    for (int k = 0; k < 2 * steps; ++k) {
      double low = (k % 2 == 0 ? k / 2 : -k / 2 - 1) * step, high = low + step;
      if (!changes(low, high)) continue;
      const int label = image_.label_at(at(low));
      for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (low + high);
        (image_.label_at(at(middle)) == label ? low : high) = middle;
      }
      t = 0.5 * (low + high);
      break;
    }
    const auto x = at(t);
    return Point(x[0], x[1], x[2]);
  }

  const Voxel_image_3& image_;
  std::map<Key, Point> places_;
  std::vector<Piece> pieces_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_IMAGE_BORDER_3_H
