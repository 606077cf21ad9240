// SPDX-License-Identifier: GPL-3.0-or-later
//
// How bad an element is by all that a guard watches: the criteria, the topological disk, interior vertices on the
// boundary, facets that are turned away from the surface or lie farther from it than any did at the start.

#ifndef WEFT_SPATIAL_CRITERIA_ELEMENT_GRADER_3_H
#define WEFT_SPATIAL_CRITERIA_ELEMENT_GRADER_3_H

#include <weft/internal/parallel_for.h>
#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/Deviation_3.h>
#include <weft/spatial/criteria/Facet_memory_3.h>
#include <weft/spatial/criteria/facet_turn_3.h>
#include <weft/spatial/criteria/Tolerated_elements_3.h>
#include <weft/spatial/restricted/topological_disk_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft::internal {

/// Calls `look(k, era, result)` for k in [0, n), block by block, each with a result and an era of Deviation_3 of its
/// own, then `take(result)` in order of the blocks, which are the same for any number of threads.
template <class Restricted, class Result, class Look, class Take>
void for_facet_blocks(std::size_t n, int threads, const Result& initial, const Look& look, const Take& take)
{
  constexpr std::size_t block_size = 128; // facets that are looked at one after the other
  const std::size_t blocks = (n + block_size - 1) / block_size;
  std::vector<Result> results(blocks, initial);
  parallel_for(
      blocks, threads,
      [&](std::size_t b) {
        const std::uint64_t era = Deviation_3<Restricted>::new_era();
        for (std::size_t k = b * block_size; k < (std::min)(n, (b + 1) * block_size); ++k) look(k, era, results[b]);
      },
      1);
  for (const Result& result : results) take(result);
}

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Element_grader_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Cell_handle = typename Restricted::Cell_handle;
  using Facet = typename Restricted::Restricted_facet;
  using Crease_edge = typename Restricted::Crease_edge;

  /// \param facets numbers of the records that tell how far facets may be from the surface.
  /// \param threads to look at them.
  Element_grader_3(const Restricted& mesh, const Criteria_3<Kernel>& criteria, const std::vector<int>& facets,
                   int threads)
      : mesh_(mesh), measure_(mesh, criteria, 1), deviation_(mesh), allowed_(criteria.deviation)
  {
    const CGAL::Bbox_3 b = mesh.oracle().bbox();
    const double rounding = 1e-6 * std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
    farthest_ = {rounding * rounding, rounding * rounding}; // all that is seen on flat patches
    // Most facets needn't be measured, once a far one is known.
    for_facet_blocks<Restricted>(
        facets.size(), threads, farthest_,
        [&](std::size_t k, std::uint64_t era, Squared_deviation_3& farthest) {
          farthest.raise_to(deviation_.beyond(farthest, mesh.facets()[static_cast<std::size_t>(facets[k])], era));
        },
        [this](const Squared_deviation_3& farthest) { farthest_.raise_to(farthest); });
    farthest_.depth *= closer * closer;
    farthest_of_crease_ = rounding * rounding;
    for (const Crease_edge& e : mesh.creases().edges())
      farthest_of_crease_ = (std::max)(farthest_of_crease_, deviation_.of(e));
  }

  const Badness_measure_3<Restricted>& measure() const { return measure_; }

  Grade_3 cell(Cell_handle c) const { return {ratio(measure_.cell(c)), 0, 0, 0, 0}; }
  Grade_3 unlabelled_cell(Cell_handle c) const { return {ratio(measure_.unlabelled_cell(c)), 0, 0, 0, 0}; }

  /// \param era see `Deviation_3::new_era()`.
  Grade_3 facet(const Facet& f, std::uint64_t era) const
  {
    Grade_3 grade = facet_by_criteria(f);
    const Grade_3 own = facet_by_own_distance(f);
    grade.depth = own.depth;
    grade.turn = own.turn;
    grade.height = facet_by_height(f, era).height;
    return grade;
  }

  Grade_3 facet_by_criteria(const Facet& f) const
  {
    Grade_3 grade{ratio(measure_.facet(f)), 0, 0, 0, 0};
    for (int i = 1; i < 4; ++i) grade.astray += f.cell->vertex((f.index + i) & 3)->location().dimension > 2;
    return grade;
  }

  /// What hangs on the facets around it, too.
  Grade_3 facet_by_height(const Facet& f, std::uint64_t era) const
  {
    return {0, 0, deviation_.height_beyond(bound_at(f.steiner).height, f, era), 0, 0};
  }

  /// What doesn't hang on the facets around it. How deep a facet is, and how its corners look, is its own affair.
  Grade_3 facet_by_own_distance(const Facet& f) const
  {
    const bool may_be_known = !allowed_ && mesh_.is_boundary(f);
    const Facet_memory_3::Key key = may_be_known ? Facet_memory_3::key(f, name_) : Facet_memory_3::Key();
    const bool is_known = may_be_known && Facet_memory_3::of_thread().has(key);
    double cosine =
        least_cosine_to_surface_of(mesh_, f, is_known ? Facet_points_3::steiner_point : Facet_points_3::all);
    const double depth = is_known ? 0 : deviation_.depth_beyond(bound_at(f.steiner).depth, f);
    if (cosine < least_cosine_to_surface) {
      if (is_beside_sharp_edge(mesh_.oracle(), f)) cosine = 1;
    } else if (may_be_known && !is_known && depth == 0) {
      Facet_memory_3::of_thread().add(key);
    }
    return {0, depth, 0, 0, cosine < least_cosine_to_surface ? 1 - cosine : 0};
  }

  Grade_3 crease_edge(const Crease_edge& e) const
  {
    const double d = deviation_.of(e), allowed = allowed_ ? allowed_(e.steiner) : 0;
    const double farthest = (std::max)(farthest_of_crease_, allowed * allowed);
    return {ratio(measure_.crease_edge(e)), d > farthest ? d : 0, 0, 0, 0};
  }

  Grade_3 vertex(Vertex_handle v) const { return {has_topological_disk(mesh_, v) ? 0. : 1., 0, 0, 0, 0}; }

private:
  Squared_deviation_3 bound_at(const typename Restricted::Point& p) const
  {
    Squared_deviation_3 bound = farthest_;
    const double allowed = allowed_ ? allowed_(p) : 0;
    bound.raise_to({allowed * allowed, allowed * allowed});
    return bound;
  }

  static double ratio(const Badness_3& badness) { return badness.is_bad() ? badness.ratio : 0; }

  /// For what lies between the samples of facets.
  static constexpr double closer = 0.85;

  const Restricted& mesh_;
  Badness_measure_3<Restricted> measure_;
  Deviation_3<Restricted> deviation_;
  std::uint64_t name_ = Deviation_3<Restricted>::new_era(); ///< in the memory of facets that are good by themselves
  Length_field_3<Kernel> allowed_;                          ///< see `Criteria_3::deviation`
  Squared_deviation_3 farthest_;                            ///< that facets may be
  double farthest_of_crease_ = 0;                           ///< that crease edges may be, squared
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_ELEMENT_GRADER_3_H
