// SPDX-License-Identifier: GPL-3.0-or-later
//
// Watches that optimisation undoes nothing that refinement has achieved: which elements violate a criterion, lack a
// topological disk, hang on an interior vertex or lie farther from the surface than any facet did at the start. What
// was bad at the start is tolerated. One guard may watch several stages one after the other: what they may not undo is
// then what held before the first of them.

#ifndef WEFT_SPATIAL_CRITERIA_CRITERIA_GUARD_3_H
#define WEFT_SPATIAL_CRITERIA_CRITERIA_GUARD_3_H

#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/Deviation_3.h>
#include <weft/spatial/criteria/Element_grader_3.h>
#include <weft/spatial/criteria/Tolerated_elements_3.h>
#include <weft/spatial/mesh/circumcenter_3.h>
#include <weft/spatial/restricted/has_free_vertex_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft::internal {

/// What refuses a change.
enum class Refusal_3
{
  none,
  cell,
  facet,
  crease,
  disk,
  bare ///< a patch would lose its last facet, or a crease its last edge
};

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Criteria_guard_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Cell_handle = typename Restricted::Cell_handle;
  using Facet = typename Restricted::Restricted_facet;
  using Crease_edge = typename Restricted::Crease_edge;

  /// Elements that are bad now are tolerated from now on, as long as they don't get worse. Linear in the size of the
  /// mesh.
  /// \param threads to use where many elements are looked at; what they find is the same for any number. Criteria of
  ///   the user are asked by one.
  /// \param moving_only whether to look only at elements with a vertex that isn't fixed, as far as others stay as they
  ///   are.
  Criteria_guard_3(const Restricted& mesh, const Criteria_3<Kernel>& criteria, int threads = 1,
                   bool moving_only = false)
      : Criteria_guard_3(mesh, criteria, Restricted::Oracle::is_thread_safe && !criteria.has_functions() ? threads : 1,
                         moving_only, everything(mesh, moving_only))
  {}

  const Restricted& mesh() const { return mesh_; }
  const Badness_measure_3<Restricted>& measure() const { return grader_.measure(); }
  /// How many threads may ask at once, about cells and facets that aren't in the mesh.
  int threads() const { return threads_; }

  /// Before anything is classified: whether cells would be good if they belong to the domain, which their circumcenters
  /// decide. Sets those.
  bool may_accept(const std::vector<Cell_handle>& cells) const
  {
    for (const Cell_handle c : cells) {
      if (Restricted::is_at_box(c)) continue;
      c->set_circumcenter(circumcenter_3<Kernel>(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(),
                                                 c->vertex(3)->point()));
      if (offends(element_of_cell(c), grader_.unlabelled_cell(c)) && mesh_.oracle().subdomain(c->circumcenter()) != 0)
        return false;
    }
    return true;
  }

  /// Before a change is made: whether cells and facets, which needn't be in the mesh, would be good, but for what hangs
  /// on those around them.
  bool may_accept(const std::vector<Cell_handle>& cells, const std::vector<Facet>& facets) const
  {
    for (const Cell_handle c : cells)
      if (c->subdomain() != 0 && offends(element_of_cell(c), grader_.cell(c))) return false;
    for (const Facet& f : facets)
      if (offends(element_of_facet(f), grader_.facet_by_criteria(f))) return false;
    return std::none_of(facets.begin(), facets.end(), [this](const Facet& f) {
      return offends(element_of_facet(f), grader_.facet_by_own_distance(f));
    });
  }

  /// The first fault found in what the last change has made. Unlike `new_offenders()` it ends at the first, looks
  /// crease edges up only where the change was, and sees patches and creases that have lost everything.
  Refusal_3 refusal() const
  {
    const Refusal_3 found = refusal(mesh_.new_cells(), mesh_.new_facets(), present_era());
    return found == Refusal_3::none && has_bare_part() ? Refusal_3::bare : found;
  }

  /// The same for some cells and facets, but for patches and creases that have lost everything. Several threads may
  /// ask. \param facets numbers of records. \param era see `Deviation_3::new_era()`.
  Refusal_3 refusal(const std::vector<Cell_handle>& cells, const std::vector<int>& facets, std::uint64_t era) const
  {
    for (const Cell_handle c : cells)
      if (c->subdomain() != 0 && offends(element_of_cell(c), grader_.cell(c))) return Refusal_3::cell;
    for (const int record : facets)
      if (offends(element_of_facet(facet(record)), grader_.facet_by_criteria(facet(record)))) return Refusal_3::facet;
    for (const Cell_handle c : cells)
      if (has_bad_crease_edge(c)) return Refusal_3::crease;
    for (const int id : boundary_vertices(cells))
      if (offends({id, -1, -1, -1}, grader_.vertex(vertex(id)))) return Refusal_3::disk;
    for (const int record : facets)
      if (offends(element_of_facet(facet(record)), grader_.facet_by_own_distance(facet(record))))
        return Refusal_3::facet;
    for (const int record : facets) // the dearest last
      if (offends(element_of_facet(facet(record)), grader_.facet_by_height(facet(record), era)))
        return Refusal_3::facet;
    return Refusal_3::none;
  }
  bool accepts_change() const { return refusal() == Refusal_3::none; }

  /// Whether a patch has lost its last facet, or a crease its last edge.
  bool has_bare_part() const
  {
    return std::any_of(patches_.begin(), patches_.end(), [this](int p) { return mesh_.number_of_facets(p) == 0; }) ||
           std::any_of(creases_.begin(), creases_.end(),
                       [this](std::size_t c) { return mesh_.creases().number_of_edges(c) == 0; });
  }

  /// The bad elements among those that the last change of the mesh has made, and all bad crease edges.
  std::vector<Element_3> new_offenders() const
  {
    std::vector<Element_3> bad;
    const auto collect = [&bad](const std::vector<Element_3>& some) {
      bad.insert(bad.end(), some.begin(), some.end());
    };
    const std::vector<int>& facets = mesh_.new_facets();
    for_facet_blocks<Restricted>(
        facets.size(), threads_, std::vector<Element_3>(),
        [&](std::size_t k, std::uint64_t era, std::vector<Element_3>& some) {
          const Facet& f = facet(facets[k]);
          if (f.cell != Cell_handle() && offends(f, era)) some.push_back(element_of_facet(f));
        },
        collect);
    const std::vector<Cell_handle>& cells = mesh_.new_cells();
    for_facet_blocks<Restricted>(
        cells.size(), threads_, std::vector<Element_3>(),
        [&](std::size_t k, std::uint64_t, std::vector<Element_3>& some) {
          const Cell_handle c = cells[k];
          if (c->subdomain() != 0 && offends(element_of_cell(c), grader_.cell(c))) some.push_back(element_of_cell(c));
        },
        collect);
    for (const Crease_edge& e : mesh_.creases().edges())
      if (offends(element_of_edge(e), grader_.crease_edge(e))) bad.push_back(element_of_edge(e));
    const std::vector<int> vertices = boundary_vertices(cells);
    for_facet_blocks<Restricted>(
        vertices.size(), threads_, std::vector<Element_3>(),
        [&](std::size_t k, std::uint64_t, std::vector<Element_3>& some) {
          const int id = vertices[k];
          if (offends({id, -1, -1, -1}, grader_.vertex(vertex(id)))) some.push_back({id, -1, -1, -1});
        },
        collect);
    return bad;
  }

  /// Tolerates what is bad now, too, as after changes that were judged by the elements that they made: how far the
  /// surface is from a facet hangs on the facets around it, too. Linear in the size of the mesh.
  void tolerate_all() { tolerate(everything(mesh_, moving_only_)); }

  /// To be called when all vertices get new numbers.
  /// \param numbers the new ones by the old ones; -1 for vertices that are gone.
  void renumber(const std::vector<int>& numbers) { tolerated_.renumber(numbers); }

  /// To be called when a vertex number gets another meaning: what was tolerated at it isn't any more.
  void forget(int id) { tolerated_.forget(id); }

  /// Whether an element exists and is bad.
  bool is_offending(const Element_3& e) const
  {
    const auto& tr = mesh_.triangulation();
    Cell_handle c;
    int i, j, k, l;
    if (e[3] >= 0)
      return tr.is_cell(vertex(e[0]), vertex(e[1]), vertex(e[2]), vertex(e[3]), c, i, j, k, l) && c->subdomain() != 0 &&
             offends(e, grader_.cell(c));
    if (e[2] >= 0) {
      if (!tr.is_facet(vertex(e[0]), vertex(e[1]), vertex(e[2]), c, i, j, k)) return false;
      const Facet* f = mesh_.facet(c, 6 - i - j - k);
      return f && offends(*f, present_era());
    }
    if (e[1] >= 0) {
      const Crease_edge* edge = mesh_.creases().edge(vertex(e[0]), vertex(e[1]));
      return edge && offends(e, grader_.crease_edge(*edge));
    }
    return offends(e, grader_.vertex(vertex(e[0])));
  }

private:
  struct Part
  {
    std::vector<Cell_handle> cells;
    std::vector<int> facets; ///< numbers of records
  };

  Criteria_guard_3(const Restricted& mesh, const Criteria_3<Kernel>& criteria, int threads, bool moving_only,
                   const Part& all)
      : mesh_(mesh), threads_(threads), moving_only_(moving_only), grader_(mesh, criteria, all.facets, threads)
  {
    tolerate(all);
    for (int p = 0; p < mesh.oracle().number_of_patches(); ++p)
      if (mesh.number_of_facets(p) > 0) patches_.push_back(p);
    for (std::size_t c = 0; c < mesh.creases().number_of_creases(); ++c)
      if (mesh.creases().number_of_edges(c) > 0) creases_.push_back(c);
  }

  /// For questions by one thread about the mesh as it is.
  std::uint64_t present_era() const
  {
    if (version_ != mesh_.version()) era_ = Deviation_3<Restricted>::new_era();
    version_ = mesh_.version();
    return era_;
  }

  Vertex_handle vertex(int id) const { return mesh_.vertices()[static_cast<std::size_t>(id)]; }
  const Facet& facet(int record) const { return mesh_.facets()[static_cast<std::size_t>(record)]; }

  static Part everything(const Restricted& mesh, bool moving_only)
  {
    Part all;
    for (const Cell_handle c : mesh.triangulation().finite_cell_handles())
      if (!moving_only || has_free_vertex(mesh, c)) all.cells.push_back(c);
    for (std::size_t f = 0; f < mesh.facets().size(); ++f)
      if (const Cell_handle c = mesh.facets()[f].cell; c != Cell_handle() && (!moving_only || has_free_vertex(mesh, c)))
        all.facets.push_back(static_cast<int>(f));
    return all;
  }

  void tolerate(const Part& part)
  {
    using Grades = std::vector<std::pair<Element_3, Grade_3>>;
    for_facet_blocks<Restricted>(
        part.facets.size(), threads_, Grades(),
        [&](std::size_t k, std::uint64_t era, Grades& bad) {
          const Grade_3 g = grader_.facet(facet(part.facets[k]), era);
          if (g.is_bad()) bad.emplace_back(element_of_facet(facet(part.facets[k])), g);
        },
        [this](const Grades& bad) {
          for (const auto& [element, grade] : bad) tolerated_.tolerate(element, grade);
        });
    for (const Cell_handle c : part.cells)
      if (c->subdomain() != 0) tolerated_.tolerate(element_of_cell(c), grader_.cell(c));
    for (const Crease_edge& e : mesh_.creases().edges())
      tolerated_.tolerate(element_of_edge(e), grader_.crease_edge(e));
    for (const int id : boundary_vertices(part.cells))
      tolerated_.tolerate({id, -1, -1, -1}, grader_.vertex(vertex(id)));
  }

  bool offends(const Element_3& e, const Grade_3& grade) const { return tolerated_.is_exceeded(e, grade); }

  /// The dearest is asked last.
  bool offends(const Facet& f, std::uint64_t era) const
  {
    const Element_3 e = element_of_facet(f);
    return offends(e, grader_.facet_by_criteria(f)) || offends(e, grader_.facet_by_own_distance(f)) ||
           offends(e, grader_.facet_by_height(f, era));
  }

  bool has_bad_crease_edge(Cell_handle c) const
  {
    if (mesh_.creases().edges().empty()) return false;
    for (int i = 0; i < 3; ++i)
      for (int j = i + 1; j < 4; ++j) {
        const Crease_edge* e = mesh_.creases().edge(c->vertex(i), c->vertex(j));
        if (e && offends(element_of_edge(*e), grader_.crease_edge(*e))) return true;
      }
    return false;
  }

  static std::vector<int> boundary_vertices(const std::vector<Cell_handle>& cells)
  {
    std::vector<int> ids;
    for (const Cell_handle c : cells)
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i)->id() >= 0 && c->vertex(i)->location().dimension <= 2) ids.push_back(c->vertex(i)->id());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  const Restricted& mesh_;
  int threads_;
  bool moving_only_;
  Element_grader_3<Restricted> grader_;
  Tolerated_elements_3 tolerated_;
  std::vector<int> patches_;         ///< that have facets
  std::vector<std::size_t> creases_; ///< that have edges
  mutable std::uint64_t era_ = 0;    ///< of the mesh in this version, for single changes
  mutable int version_ = -1;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_CRITERIA_GUARD_3_H
