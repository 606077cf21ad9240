// SPDX-License-Identifier: GPL-3.0-or-later
//
// The best tetrahedra around an edge that is removed, or that stays with fewer cells around it: the ring of vertices
// around it is triangulated so that the worst cell is as good as possible (Klincsek's algorithm).

#ifndef WEFT_SPATIAL_LOCAL_RING_TRIANGULATION_3_H
#define WEFT_SPATIAL_LOCAL_RING_TRIANGULATION_3_H

#include <weft/spatial/local/Editable_mesh_3.h>
#include <weft/spatial/local/Star_optimiser_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// \tparam K a CGAL kernel with exact predicates whose coordinates are doubles.
template <class K>
class Ring_triangulation_3
{
public:
  using Mesh = Editable_mesh_3<K>;
  using Cell_vertices = typename Mesh::Cell_vertices;

  static constexpr std::size_t most_around = 11; ///< vertices in a ring

  explicit Ring_triangulation_3(const Mesh& mesh) : mesh_(mesh) {}

  /// Looks for the best cells of the edge's ends and a ring of 3 to `most_around` vertices. O(n^3) for n of them.
  /// \param ring has to live as long as the result is asked for.
  /// \param bound what isn't better doesn't matter.
  void triangulate(const std::vector<int>& ring, int a, int b, double bound)
  {
    ring_ = &ring;
    a_ = a;
    b_ = b;
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i + 1 < n; ++i) best_[i][i + 1] = HUGE_VAL;
    for (std::size_t length = 2; length < n; ++length)
      for (std::size_t i = 0; i + length < n; ++i) {
        const std::size_t j = i + length;
        best_[i][j] = -HUGE_VAL;
        for (std::size_t k = i + 1; k < j; ++k) {
          double q = (std::min)(best_[i][k], best_[k][j]);
          if (q > (std::max)(best_[i][j], bound)) q = (std::min)(q, quality({ring[i], ring[k], ring[j], b}));
          if (q > (std::max)(best_[i][j], bound)) q = (std::min)(q, quality({ring[i], ring[j], ring[k], a}));
          if (q > best_[i][j]) best_[i][j] = q, tip_[i][j] = k;
        }
      }
  }

  /// The worst cell without the edge.
  double worst() const { return best_[0][ring_->size() - 1]; }

  /// Appends the cells without the edge.
  void append_cells(std::vector<Cell_vertices>& made) const { append_part(0, ring_->size() - 1, made); }

  /// Cuts the ring, which is an open one around an edge that stays, into parts: each has one cell at the edge, and the
  /// rest of it is triangulated.
  /// \returns the worst cell.
  double thin_out()
  {
    const std::size_t n = ring_->size();
    std::array<double, most_around> best; // of the parts so far
    best[0] = HUGE_VAL;
    for (std::size_t j = 1; j < n; ++j) {
      best[j] = -HUGE_VAL;
      for (std::size_t i = 0; i < j; ++i) {
        double q = (std::min)(best[i], best_[i][j]);
        if (q > best[j]) q = (std::min)(q, quality({a_, b_, (*ring_)[i], (*ring_)[j]}));
        if (q > best[j]) best[j] = q, from_[j] = i;
      }
    }
    return best[n - 1];
  }

  /// Appends the cells that `thin_out()` has found.
  void append_thinned(std::vector<Cell_vertices>& made) const
  {
    for (std::size_t j = ring_->size() - 1; j > 0; j = from_[j]) {
      made.push_back({a_, b_, (*ring_)[from_[j]], (*ring_)[j]});
      append_part(from_[j], j, made);
    }
  }

private:
  double quality(const Cell_vertices& v) const { return cell_quality_3(mesh_, v); }

  void append_part(std::size_t i, std::size_t j, std::vector<Cell_vertices>& made) const
  {
    if (j < i + 2) return;
    const std::vector<int>& ring = *ring_;
    const std::size_t k = tip_[i][j];
    made.push_back({ring[i], ring[k], ring[j], b_});
    made.push_back({ring[i], ring[j], ring[k], a_});
    append_part(i, k, made);
    append_part(k, j, made);
  }

  const Mesh& mesh_;
  const std::vector<int>* ring_ = nullptr;
  int a_ = Mesh::none, b_ = Mesh::none;
  std::array<std::array<double, most_around>, most_around> best_{};     ///< the worst cell of each part of the ring
  std::array<std::array<std::size_t, most_around>, most_around> tip_{}; ///< of the triangle at the ends of the part
  std::array<std::size_t, most_around> from_{};                         ///< where the part that ends here begins
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_LOCAL_RING_TRIANGULATION_3_H
