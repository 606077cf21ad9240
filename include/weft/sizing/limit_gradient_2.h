// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gradient limiting lowers the sizes at vertices until the gradient on every triangle is at most k. Along edges that is
// a shortest path problem; on a triangle it is the local update of fast marching methods (Kimmel and Sethian,
// "Computing geodesic paths on manifolds", 1998; as limiter: Persson, "Mesh size functions for implicit geometries and
// PDE-based gradient limiting", 2006), applied in order of increasing size.

#ifndef WEFT_SIZING_LIMIT_GRADIENT_2_H
#define WEFT_SIZING_LIMIT_GRADIENT_2_H

#include <weft/errors.h>
#include <weft/sizing/Background_triangulation_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace weft::internal {

/// What `limit_gradient_2()` does, step by step.
template <class K>
class Gradient_limiter_2
{
public:
  using Mesh = Background_triangulation_2<K>;
  using Index = typename Mesh::Index;
  using Vector = typename Mesh::Vector;
  using Shape = typename Mesh::Shape;

  explicit Gradient_limiter_2(Mesh& mesh) : mesh_(mesh) {}

  void run(double k)
  {
    std::vector<std::vector<Index>> around(mesh_.points.size());
    for (Index f = 0; f < mesh_.faces.size(); ++f)
      for (const Index v : mesh_.faces[f].vertex) around[v].push_back(f);
    march(k, around);

    using Entry = std::pair<double, Index>; // the smaller sizes first, as in Dijkstra's algorithm; ties by index
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    std::vector<char> waiting(mesh_.faces.size(), 0);
    const auto push = [&](Index f) {
      if (waiting[f]) return;
      waiting[f] = 1;
      const auto& v = mesh_.faces[f].vertex;
      queue.emplace(std::min({mesh_.sizes[v[0]], mesh_.sizes[v[1]], mesh_.sizes[v[2]]}), f);
    };
    const auto lowered = [&](Index v) {
      for (const Index f : around[v]) push(f);
    };
    for (Index f = 0; f < mesh_.faces.size(); ++f) push(f);
    // Sizes only fall and are bounded, but obtuse faces may need many ever smaller steps: the budget ends that.
    for (std::size_t budget = 200 * mesh_.faces.size() + 10000; !queue.empty() && budget > 0; --budget) {
      const Index f = queue.top().second;
      queue.pop();
      waiting[f] = 0;
      limit_edges(f, k, lowered);
      limit_face(f, k, lowered);
    }
    // What is left, a relative 1e-6 unless the budget ended it: pull all sizes towards the smallest, which scales all
    // gradients.
    // The margins are for the rounding of the sizes; on a face so flat that it still matters, rounding has the last
    // word.
    const double lowest = *std::min_element(mesh_.sizes.begin(), mesh_.sizes.end());
    for (const double margin : {1e-15, 1e-12, 1e-9}) {
      if (mesh_.max_gradient() <= k) return;
      double steepest = k;
      for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
        steepest = std::max(steepest, mesh_.gradient(f) - mesh_.rounding(f, mesh_.shape(f)));
      const double factor = steepest > 0 ? k / steepest * (1 - margin) : 0;
      for (double& h : mesh_.sizes) h = lowest + factor * (h - lowest);
    }
  }

private:
  template <class Lowered>
  void limit_edges(std::size_t f, double k, const Lowered& lowered)
  {
    for (std::size_t i = 0; i < 3; ++i) {
      Index low = mesh_.faces[f].vertex[i], high = mesh_.faces[f].vertex[(i + 1) % 3];
      if (mesh_.sizes[low] > mesh_.sizes[high]) std::swap(low, high);
      const double limit =
          mesh_.sizes[low] + k * std::hypot(mesh_.at(low).x - mesh_.at(high).x, mesh_.at(low).y - mesh_.at(high).y);
      if (mesh_.sizes[high] > limit) mesh_.sizes[high] = limit, lowered(high);
    }
  }

  // Largest size at vertex i of a face for which its gradient is at most k, the other two being given.
  double size_from_edge(std::size_t f, std::size_t i, const Shape& s, double k) const
  {
    const Vector g = mesh_.slope(f, s), hat = s.hat[i];
    const double per_height = std::hypot(hat.x, hat.y);
    if (per_height == 0) return std::numeric_limits<double>::infinity();
    const double along = (g.x * hat.y - g.y * hat.x) / per_height; // part along the opposite edge: stays
    const double normal = (g.x * hat.x + g.y * hat.y) / per_height;
    return mesh_.sizes[mesh_.faces[f].vertex[i]] -
           (normal - std::sqrt(std::max(0., k * k - along * along))) / per_height;
  }

  // The same where the steepest descent from vertex i leaves through the opposite edge, so that the sizes there are
  // what causes it; infinity elsewhere.
  double size_upwind(std::size_t f, std::size_t i, double k) const
  {
    const Shape s = mesh_.shape(f);
    const double size = size_from_edge(f, i, s, k), change = size - mesh_.sizes[mesh_.faces[f].vertex[i]];
    Vector g = mesh_.slope(f, s);
    g.x += change * s.hat[i].x, g.y += change * s.hat[i].y;
    const auto rises_to = [&](std::size_t j) { return g.x * s.hat[j].x + g.y * s.hat[j].y > 0; };
    return rises_to((i + 1) % 3) || rises_to((i + 2) % 3) ? std::numeric_limits<double>::infinity() : size;
  }

  // Fast marching: vertices become final in order of size, and bound their neighbours along edges and, two at a time,
  // across faces. The result is near the largest field of gradient k, but not strictly within k on coarse or obtuse
  // faces.
  void march(double k, const std::vector<std::vector<Index>>& around)
  {
    using Entry = std::pair<double, Index>; // ties by index
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    for (Index v = 0; v < mesh_.points.size(); ++v) queue.emplace(mesh_.sizes[v], v);
    std::vector<char> final(mesh_.points.size(), 0);
    while (!queue.empty()) {
      const auto [size, v] = queue.top();
      queue.pop();
      if (final[v]) continue;
      final[v] = 1;
      for (const Index f : around[v])
        for (std::size_t i = 0; i < 3; ++i) {
          const Index w = mesh_.faces[f].vertex[i],
                      third = mesh_.faces[f].vertex[0] ^ mesh_.faces[f].vertex[1] ^ mesh_.faces[f].vertex[2] ^ v ^ w;
          if (final[w]) continue;
          double limit = size + k * std::hypot(mesh_.at(v).x - mesh_.at(w).x, mesh_.at(v).y - mesh_.at(w).y);
          if (final[third]) limit = std::min(limit, size_upwind(f, i, k));
          if (limit < mesh_.sizes[w]) mesh_.sizes[w] = limit, queue.emplace(limit, w);
        }
    }
  }

  // Flattens a face that is too steep: lowers the vertices that this flattens, each by as much as it helps, which
  // changes the sizes least. There is such a vertex, as the hat functions' gradients sum to 0. The lowest size of the
  // face stays.
  template <class Lowered>
  bool limit_face(std::size_t f, double k, const Lowered& lowered)
  {
    const Shape s = mesh_.shape(f);
    const auto& v = mesh_.faces[f].vertex;
    const Vector g = mesh_.slope(f, s);
    // A relative 1e-6 is left to limit_gradient(): the last steps on flat faces are many and small.
    if (std::hypot(g.x, g.y) <= k * (1 + 1e-6) + mesh_.rounding(f, s)) return false;
    std::array<double, 3> share;
    Vector change{0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      share[i] = std::max(0., g.x * s.hat[i].x + g.y * s.hat[i].y);
      change.x += share[i] * s.hat[i].x, change.y += share[i] * s.hat[i].y;
    }
    // Smallest t with |g - t change| = k, or the flattest t where there is none.
    const double cc = change.x * change.x + change.y * change.y, gc = g.x * change.x + g.y * change.y;
    const double excess = g.x * g.x + g.y * g.y - k * k;
    const double root = std::sqrt(std::max(0., gc * gc - cc * excess));
    const double t = excess / (gc + root) < gc / cc ? excess / (gc + root) : gc / cc;
    const double lowest = std::min({mesh_.sizes[v[0]], mesh_.sizes[v[1]], mesh_.sizes[v[2]]});
    for (std::size_t i = 0; i < 3; ++i) {
      const double size = std::max(lowest, mesh_.sizes[v[i]] - t * share[i]);
      if (size < mesh_.sizes[v[i]]) mesh_.sizes[v[i]] = size, lowered(v[i]);
    }
    return true;
  }

  Mesh& mesh_;
};

/// Lowers sizes until the length of the gradient is at most k on each triangle, up to rounding on nearly flat ones.
///
/// \throws Option_error when k is NaN, infinite or negative.
template <class K>
void limit_gradient_2(Background_triangulation_2<K>& mesh, double k)
{
  if (!(k >= 0) || !std::isfinite(k)) throw Option_error("the gradient of a sizing field must be finite and >= 0");
  Gradient_limiter_2<K>(mesh).run(k);
}

} // namespace weft::internal

#endif // WEFT_SIZING_LIMIT_GRADIENT_2_H
