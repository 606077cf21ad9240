// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sizes that a mesh has: edge lengths of equilateral triangles as large as those around each vertex, evened out
// over neighbours. Areas count, not edges, so that a mesh keeps its number of vertices however thin its triangles are.

#ifndef WEFT_PLANAR_RUN_VERTEX_DENSITY_SIZING_2_H
#define WEFT_PLANAR_RUN_VERTEX_DENSITY_SIZING_2_H

#include <weft/sizing/Background_sizing_2.h>

#include <CGAL/number_utils.h>
#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace weft::internal {

/// Mean edge lengths at the vertices of a triangulation, by the areas of the faces in its domain.
/// \param rounds of evening out. Linear time.
template <class Cdt>
CGAL::Unique_hash_map<typename Cdt::Vertex_handle, double> vertex_sizes_2(const Cdt& cdt, int rounds)
{
  using Vertex_handle = typename Cdt::Vertex_handle;
  struct Mean
  {
    double sum = 0, weight = 0;
  };
  std::vector<std::array<std::size_t, 3>> faces;
  std::vector<Mean> means;
  CGAL::Unique_hash_map<Vertex_handle, std::size_t> number;
  for (const auto v : cdt.finite_vertex_handles()) {
    number[v] = means.size();
    means.emplace_back();
  }
  double total = 0;
  for (const auto f : cdt.finite_face_handles()) {
    if (!f->is_in_domain()) continue;
    faces.push_back({number[f->vertex(0)], number[f->vertex(1)], number[f->vertex(2)]});
    const double area = CGAL::to_double(cdt.triangle(f).area());
    total += area;
    for (const std::size_t v : faces.back()) {
      means[v].sum += area;
      means[v].weight += 1;
    }
  }
  const double typical = total / static_cast<double>(faces.size());
  const auto edge = [](double area) { return std::sqrt(area * 4 / std::sqrt(3.)); };
  std::vector<double> logarithm; // of sizes
  for (const Mean& m : means) logarithm.push_back(std::log(edge(m.weight > 0 ? m.sum / m.weight : typical)));
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t v = 0; v < means.size(); ++v) means[v] = {logarithm[v], 1};
    for (const auto& f : faces)
      for (std::size_t i = 0; i < 3; ++i) {
        means[f[i]].sum += logarithm[f[(i + 1) % 3]] + logarithm[f[(i + 2) % 3]];
        means[f[i]].weight += 2;
      }
    for (std::size_t v = 0; v < means.size(); ++v) logarithm[v] = means[v].sum / means[v].weight;
  }
  CGAL::Unique_hash_map<Vertex_handle, double> result;
  for (const auto v : cdt.finite_vertex_handles()) result[v] = std::exp(logarithm[number[v]]);
  return result;
}

/// A sizing field from the sizes at the vertices of a triangulation, which is copied.
template <class K>
class Vertex_density_sizing_2
{
public:
  using Point = typename K::Point_2;

  /// \param largest edges of good meshes are up to so many times as long as those of equilateral triangles of the same
  ///   area.
  /// \param growth of sizes by distance, at most.
  /// \param allow_constraints whether sizes are to allow all constrained edges, whatever their length.
  template <class Cdt>
  Vertex_density_sizing_2(const Cdt& cdt, double largest, double growth, bool allow_constraints) : largest_(largest)
  {
    auto sizes = vertex_sizes_2(cdt, 3);
    field_.emplace(cdt, [&sizes](typename Cdt::Vertex_handle v) { return sizes[v]; });
    field_->limit_gradient(growth);
    if (!allow_constraints) return;
    std::size_t i = 0;
    for (const auto v : cdt.finite_vertex_handles()) sizes[v] = field_->sizes()[i++];
    for (const auto f : cdt.finite_face_handles())
      for (int k = 0; k < 3; ++k) {
        if (!f->is_in_domain() || !f->is_constrained(k)) continue;
        const double least = 1.05 * std::sqrt(CGAL::to_double(cdt.segment(f, k).squared_length())) / largest;
        for (int j = 0; j < 3; ++j) sizes[f->vertex(j)] = (std::max)(sizes[f->vertex(j)], least);
      }
    field_.emplace(cdt, [&sizes](typename Cdt::Vertex_handle v) { return sizes[v]; });
  }

  /// The longest edge that there should be.
  double operator()(const Point& p) const { return largest_ * mean(p); }

  /// The edge length of equilateral triangles.
  double mean(const Point& p) const { return CGAL::to_double((*field_)(p)); }

private:
  std::optional<Background_sizing_2<K>> field_; ///< always there
  double largest_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_VERTEX_DENSITY_SIZING_2_H
