// SPDX-License-Identifier: GPL-3.0-or-later
//
// The smoothers that minimise the ODT energy: Natural ODT, which moves vertices of the boundary, too, and ODT.

#ifndef WEFT_SPATIAL_OPTIMISE_NATURAL_ODT_3_H
#define WEFT_SPATIAL_OPTIMISE_NATURAL_ODT_3_H

#include <weft/spatial/optimise/smoothing_pull_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace weft {

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

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_NATURAL_ODT_3_H
