// SPDX-License-Identifier: GPL-3.0-or-later
//
// Smoothers (Tournois 2009, sec. 3.2.1.5): Natural ODT, ODT and Lloyd. A smoother looks at the cells around a vertex
// and returns the position that the vertex should have, not projected yet. Lengths, areas and volumes are measured in
// the metric of a sizing field that is given at vertices and linear between them, by quadrature of the second degree; a
// constant field gives the uniform formulas back.

#ifndef WEFT_SPATIAL_OPTIMISE_SMOOTHERS_3_H
#define WEFT_SPATIAL_OPTIMISE_SMOOTHERS_3_H

#include <weft/internal/parallel_for.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
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

namespace internal {

/// Sum of weighted vectors from a vertex to where it is drawn.
template <class Vector>
struct Pull_3
{
  Vector sum{0, 0, 0};
  double weight = 0;

  void add(double w, const Vector& to)
  {
    sum = sum + w * to;
    weight += w;
  }

  template <class Point>
  std::optional<Point> position(const Point& from) const
  {
    if (!(weight > 0) || !std::isfinite(weight)) return std::nullopt;
    return from + sum / weight;
  }
};

/// The circumcenters of the domain's cells around a vertex, weighted with volumes: the optimal position of ODT, less
/// its boundary terms.
template <class Context>
auto pull_of_circumcenters(const Context& context, typename Context::Vertex_handle v,
                           const std::vector<typename Context::Cell_handle>& star)
{
  Pull_3<typename Context::Vector> pull;
  for (const auto c : star) {
    if (c->subdomain() == 0) continue;
    pull.add(context.mass(c), c->circumcenter() - v->point());
  }
  return pull;
}

} // namespace internal

/// Natural ODT (Tournois 2009, sec. 3.2.1.5): minimises the ODT energy on interior vertices, and has the circumsphere
/// property on boundary vertices, too: a vertex whose neighbours lie on a sphere around it stays, whether its ring is
/// full or not.
///
/// Other than in the thesis, what is projected on a patch or crease is the mean of that position and of the one that
/// ODT of the patch's facets or of the crease's edges alone wants, which has the property, too, where the ring is flat
/// or straight. Volumes say little about where a vertex should slide along the boundary, and what the surface lacks in
/// regularity becomes slivers below it.
struct Natural_odt_3
{
  static constexpr bool moves_boundary = true, minimises_odt = true;

  double patch_share = 0.5, crease_share = 1; ///< of the patch's and of the crease's own ODT; 0: as in the thesis

  template <class Context>
  std::optional<typename Context::Point> operator()(const Context& context, typename Context::Vertex_handle v,
                                                    const std::vector<typename Context::Cell_handle>& star) const
  {
    const int dimension = v->location().dimension;
    const double share = dimension == 2 ? patch_share : dimension == 1 ? crease_share : 0;
    const auto natural = share < 1 ? in_space(context, v, star) : std::nullopt;
    if (!(share > 0)) return natural;
    const auto own = dimension == 2 ? on_patch(context, v, star) : on_crease(context, v);
    if (!own || !natural) return own ? own : natural;
    return *natural + share * (*own - *natural);
  }

private:
  /// ODT of the restricted facets around a vertex, whose circumcenters on the surface are those of their surface
  /// Delaunay balls.
  template <class Context>
  static std::optional<typename Context::Point> on_patch(const Context& context, typename Context::Vertex_handle v,
                                                         const std::vector<typename Context::Cell_handle>& star)
  {
    const auto& p = v->point();
    internal::Pull_3<typename Context::Vector> pull;
    for (const auto c : star)
      for (int i = 0; i < 4; ++i) {
        const auto* f = context.mesh().facet(c, i);
        if (c->vertex(i) == v || !f || f->cell != c) continue;
        pull.add(context.area(c, i), f->steiner - p);
      }
    return pull.position(p);
  }

  /// The same of the two crease edges at a vertex.
  template <class Context>
  static std::optional<typename Context::Point> on_crease(const Context& context, typename Context::Vertex_handle v)
  {
    const auto& ends = context.crease_ends(v);
    if (ends.size() != 2) return std::nullopt;
    internal::Pull_3<typename Context::Vector> pull;
    for (const auto& [other, crossing] : ends)
      pull.add(std::sqrt(context.squared_length(v, other)), crossing - v->point());
    return pull.position(v->point());
  }

  template <class Context>
  static std::optional<typename Context::Point> in_space(const Context& context, typename Context::Vertex_handle v,
                                                         const std::vector<typename Context::Cell_handle>& star)
  {
    auto pull = internal::pull_of_circumcenters(context, v, star);
    for (const auto c : star) {
      const unsigned boundary = c->subdomain() == 0 ? 0 : context.boundary(c);
      if (boundary == 0) continue;
      const int iv = c->index(v);
      for (int i = 0; i < 4; ++i)
        if (i != iv && (boundary >> i & 1))
          pull.sum = pull.sum - boundary_term(context, c, iv, i) / 12; // lambda = -1/2 times 1/6
    }
    return pull.position(v->point());
  }

  /// Of the facet opposite to vertex i of c, seen from its vertex iv: the inward normal with the facet's area as
  /// length, times the squared lengths of the two spokes. In the metric that is a number, which the size makes a
  /// length.
  template <class Context>
  static typename Context::Vector boundary_term(const Context& context, typename Context::Cell_handle c, int iv, int i)
  {
    std::array<typename Context::Vertex_handle, 3> facet{c->vertex(iv), {}, {}};
    for (int k = 0, n = 1; k < 4; ++k)
      if (k != i && k != iv) facet[static_cast<std::size_t>(n++)] = c->vertex(k);
    const auto &a = facet[0]->point(), &p = facet[1]->point(), &q = facet[2]->point();
    typename Context::Vector normal = CGAL::cross_product(p - a, q - a) / 2;
    if (normal * (c->vertex(i)->point() - a) < 0) normal = -normal;
    const double spokes = context.squared_length(facet[0], facet[1]) + context.squared_length(facet[0], facet[2]);
    return (context.template mean_power<3>(facet, 2) * spokes * context.size(facet[0])) * normal;
  }
};

/// ODT (Chen 2004; Alliez, Cohen-Steiner, Yvinec, Desbrun 2005): as Natural ODT inside; vertices on the boundary stay.
struct Odt_3
{
  static constexpr bool moves_boundary = false, minimises_odt = true;

  template <class Context>
  std::optional<typename Context::Point> operator()(const Context& context, typename Context::Vertex_handle v,
                                                    const std::vector<typename Context::Cell_handle>& star) const
  {
    return internal::pull_of_circumcenters(context, v, star).position(v->point());
  }
};

/// Lloyd's iteration (Du, Faber, Gunzburger 1999) with density size^-(d + 2): interior vertices move to the centroids
/// of their Voronoi cells, those on patches and creases to the centroids of their restricted Voronoi cells, whose
/// corners are the surface Delaunay ball centers of the facets or crease edges around.
struct Lloyd_3
{
  static constexpr bool moves_boundary = true, minimises_odt = false;

  template <class Context>
  std::optional<typename Context::Point> operator()(const Context& context, typename Context::Vertex_handle v,
                                                    const std::vector<typename Context::Cell_handle>& star) const
  {
    switch (v->location().dimension) {
    case 1:
      return on_crease(context, v);
    case 2:
      return on_patch(context, v, star);
    default:
      return inside(context, v, star);
    }
  }

private:
  template <class Context>
  static std::optional<typename Context::Point> on_crease(const Context& context, typename Context::Vertex_handle v)
  {
    const auto& ends = context.crease_ends(v);
    if (ends.size() != 2) return std::nullopt;
    return CGAL::midpoint(ends[0].crossing, ends[1].crossing);
  }

  /// Triangles between the vertex and the centers of two facets that share an edge with it.
  template <class Context>
  static std::optional<typename Context::Point> on_patch(const Context& context, typename Context::Vertex_handle v,
                                                         const std::vector<typename Context::Cell_handle>& star)
  {
    using Vertex_handle = typename Context::Vertex_handle;
    const auto& p = v->point();
    std::vector<std::pair<Vertex_handle, typename Context::Point>> half_edges;
    for (const auto c : star)
      for (int i = 0; i < 4; ++i) {
        const auto* f = context.mesh().facet(c, i);
        if (c->vertex(i) == v || !f || f->cell != c) continue;
        for (int k = 0; k < 4; ++k)
          if (k != i && c->vertex(k) != v) half_edges.emplace_back(c->vertex(k), f->steiner);
      }
    internal::Pull_3<typename Context::Vector> pull;
    for (std::size_t i = 0; i < half_edges.size(); ++i)
      for (std::size_t j = i + 1; j < half_edges.size(); ++j) {
        if (half_edges[i].first != half_edges[j].first) continue;
        const auto a = half_edges[i].second - p, b = half_edges[j].second - p;
        const double area = std::sqrt(CGAL::to_double(CGAL::cross_product(a, b).squared_length())) / 2;
        pull.add(area * context.template mean_power<2>({v, half_edges[i].first}, 4), (a + b) / 3);
      }
    return pull.position(p);
  }

  /// Tetrahedra between the vertex and a triangulation of each Voronoi facet from its first corner.
  template <class Context>
  static std::optional<typename Context::Point> inside(const Context& context, typename Context::Vertex_handle v,
                                                       const std::vector<typename Context::Cell_handle>& star)
  {
    const auto& p = v->point();
    internal::Pull_3<typename Context::Vector> pull;
    for (const auto c : star) // each edge at v once: from the eldest cell around it
      for (int k = 0; k < 4; ++k) {
        if (c->vertex(k) == v) continue;
        auto around = context.mesh().triangulation().incident_cells(c, c->index(v), k);
        const auto begin = around;
        bool first = true;
        while (++around != begin) first = first && c->time_stamp() < around->time_stamp();
        if (!first) continue;
        if (c->vertex(k)->id() < 0) return std::nullopt; // the cell reaches the box
        const double density = context.template mean_power<2>({v, c->vertex(k)}, 5);
        const auto a = c->circumcenter() - p;
        auto last = ++around;
        while (++around != begin) {
          const auto b = last->circumcenter() - p, d = around->circumcenter() - p;
          const double volume = std::abs(CGAL::to_double(CGAL::cross_product(a, b) * d)) / 6;
          pull.add(volume * density, (a + b + d) / 4);
          last = around;
        }
      }
    return pull.position(p);
  }
};

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_SMOOTHERS_3_H
