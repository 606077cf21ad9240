// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a smoother is given: lengths, areas and volumes in the metric of a sizing field, and the crease edges around a
// vertex.

#ifndef WEFT_SPATIAL_OPTIMISE_SMOOTHING_CONTEXT_3_H
#define WEFT_SPATIAL_OPTIMISE_SMOOTHING_CONTEXT_3_H

#include <weft/internal/parallel_for.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

namespace weft {

/// What smoothers see: the mesh, sizes at its vertices and the crease edges around each vertex.
/// \tparam Sizing called with vertices, as Dynamic_sizing_3.
template <class Restricted_, class Sizing>
class Smoothing_context_3
{
public:
  using Restricted = Restricted_;
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Vector = typename Kernel::Vector_3;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Cell_handle = typename Restricted::Cell_handle;

  Smoothing_context_3(const Restricted& mesh, const Sizing& sizing) : mesh_(mesh), sizing_(sizing)
  {
    for (const auto& e : mesh.creases().edges()) {
      crease_ends_[e.source->id()].push_back({e.target, e.steiner});
      crease_ends_[e.target->id()].push_back({e.source, e.steiner});
    }
  }

  const Restricted& mesh() const { return mesh_; }
  double size(Vertex_handle v) const { return sizing_(v); }

  /// A crease edge, seen from one of its ends.
  struct Crease_end
  {
    Vertex_handle other;
    Point crossing; ///< where its Voronoi facet meets the crease, farthest from the ends
  };

  /// The crease edges at a vertex.
  const std::vector<Crease_end>& crease_ends(Vertex_handle v) const
  {
    static const std::vector<Crease_end> nothing;
    const auto found = crease_ends_.find(v->id());
    return found == crease_ends_.end() ? nothing : found->second;
  }

  /// Integral of size^-power over a simplex with n vertices, in parts of its measure: exact for integrands of the
  /// second degree.
  template <std::size_t n>
  double mean_power(const std::array<Vertex_handle, n>& v, int power) const
  {
    // Weights 1 / ((d + 1) (d + 2)) of the vertices and (d + 1) / (d + 2) of the centroid, in d = n - 1 dimensions.
    double at_vertices = 0, mean = 0;
    for (const Vertex_handle w : v) {
      at_vertices += raised(1 / size(w), power);
      mean += size(w) / n;
    }
    return at_vertices / (n * (n + 1)) + raised(1 / mean, power) * n / (n + 1);
  }

  /// Measures all restricted facets in advance, and all cells of a list, whose numbers they have to have as `id()`:
  /// each is asked for three or four times.
  void measure(const std::vector<Cell_handle>& cells, int threads)
  {
    const auto& facets = mesh_.facets();
    areas_.resize(facets.size());
    internal::parallel_for(facets.size(), threads, [&](std::size_t k) {
      areas_[k] = facets[k].cell == Cell_handle() ? 0 : measured_area(facets[k].cell, facets[k].index);
    });
    masses_.resize(cells.size());
    boundaries_.resize(cells.size());
    internal::parallel_for(cells.size(), threads, [&](std::size_t k) {
      const bool inside = cells[k]->subdomain() != 0;
      masses_[k] = inside ? measured_mass(cells[k]) : 0;
      boundaries_[k] = inside ? measured_boundary(cells[k]) : 0;
    });
  }

  /// Area in the metric of the restricted facet opposite to vertex i of a cell.
  double area(Cell_handle c, int i) const
  {
    return areas_.empty() ? measured_area(c, i) : areas_[static_cast<std::size_t>(c->facet_record(i))];
  }

  /// Volume of a cell in the metric.
  double mass(Cell_handle c) const
  {
    return masses_.empty() ? measured_mass(c) : masses_[static_cast<std::size_t>(c->id())];
  }

  /// Which facets of a cell lie on the boundary of the whole domain: bit i for that opposite to vertex i. Interfaces
  /// have cells on both sides, all of which take part (sec. 4.2.1.2).
  unsigned boundary(Cell_handle c) const
  {
    return boundaries_.empty() ? measured_boundary(c) : boundaries_[static_cast<std::size_t>(c->id())];
  }

  /// Squared length of an edge in the metric.
  double squared_length(Vertex_handle a, Vertex_handle b) const
  {
    const double scale = mean_power<2>({a, b}, 1);
    return CGAL::to_double(CGAL::squared_distance(a->point(), b->point())) * scale * scale;
  }

private:
  double measured_area(Cell_handle c, int i) const
  {
    const std::array<Vertex_handle, 3> v{c->vertex((i + 1) & 3), c->vertex((i + 2) & 3), c->vertex((i + 3) & 3)};
    return std::sqrt(CGAL::to_double(CGAL::squared_area(v[0]->point(), v[1]->point(), v[2]->point()))) *
           mean_power<3>(v, 2);
  }

  double measured_mass(Cell_handle c) const
  {
    const double volume = std::abs(CGAL::to_double(
        CGAL::volume(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(), c->vertex(3)->point())));
    return volume * mean_power<4>({c->vertex(0), c->vertex(1), c->vertex(2), c->vertex(3)}, 3);
  }

  static unsigned char measured_boundary(Cell_handle c)
  {
    unsigned bits = 0;
    for (int i = 0; i < 4; ++i) bits |= unsigned(c->neighbor(i)->subdomain() == 0) << i;
    return static_cast<unsigned char>(bits);
  }

  static double raised(double x, int power)
  {
    double y = x;
    for (int k = 1; k < power; ++k) y *= x;
    return y;
  }

  const Restricted& mesh_;
  const Sizing& sizing_;
  std::unordered_map<int, std::vector<Crease_end>> crease_ends_;
  std::vector<double> areas_, masses_; ///< by facet record, by cell id; empty: measured when asked for
  std::vector<unsigned char> boundaries_;
};

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_SMOOTHING_CONTEXT_3_H
