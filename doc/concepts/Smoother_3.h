// SPDX-License-Identifier: GPL-3.0-or-later
//
// The concept of smoothers, for weft::smooth_3(), as a class with just the members it requires. Part of the manual, not
// of the library; archetypes_test smooths with it.

#ifndef WEFT_DOC_SMOOTHER_3_H
#define WEFT_DOC_SMOOTHER_3_H

#include <optional>
#include <vector>

namespace concepts {

/// The position that a vertex should have, given the cells around it. weft::smooth_3() projects it onto the vertex's
/// patch or crease, shortens the move, and undoes it where a criterion would be violated.
///
/// Models: weft::Natural_odt_3, weft::Odt_3, weft::Lloyd_3.
/// \tparam Model what this archetype passes everything on to; no part of the concept.
/// \ingroup concept_classes
template <class Model>
class Smoother_3
{
public:
  /// Whether vertices on patches and creases move, too.
  static constexpr bool moves_boundary = Model::moves_boundary;
  /// Whether it lowers the ODT energy: if so, sweeps that raise it are undone where sizes are uniform.
  static constexpr bool minimises_odt = Model::minimises_odt;

  explicit Smoother_3(const Model& model) : model_(model) {}

  /// Called by several threads at once. Vertex_handle and Cell_handle are those of weft::Mesh_triangulation_3: a vertex
  /// has `point()`, `location()` and `id()`, a cell `vertex(i)`, `neighbor(i)`, `subdomain()` and `circumcenter()`.
  /// examples/custom_smoother.h is a smoother.
  /// \tparam Context weft::Smoothing_context_3: the mesh, sizes, masses of cells, crease edges.
  /// \param v neither a feature vertex nor locked.
  /// \param star all finite cells around v, those outside of the domain included.
  /// \returns nothing if the vertex should stay.
  template <class Context>
  std::optional<typename Context::Point> operator()(const Context& context, typename Context::Vertex_handle v,
                                                    const std::vector<typename Context::Cell_handle>& star) const
  {
    return model_(context, v, star);
  }

private:
  const Model& model_;
};

} // namespace concepts

#endif // WEFT_DOC_SMOOTHER_3_H
