// SPDX-License-Identifier: GPL-3.0-or-later
//
// Watches that optimisation undoes nothing that refinement has achieved: which elements violate a criterion, lack a
// topological disk, hang on an interior vertex or lie farther from the surface than any facet did at the start. What
// was bad at the start is tolerated. One guard may watch several stages one after the other: what they may not undo is
// then what held before the first of them.

#ifndef WEFT_SPATIAL_CRITERIA_CRITERIA_GUARD_3_H
#define WEFT_SPATIAL_CRITERIA_CRITERIA_GUARD_3_H

#include <weft/internal/parallel_for.h>
#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/Deviation_3.h>
#include <weft/spatial/criteria/Facet_memory_3.h>
#include <weft/spatial/criteria/facet_turn_3.h>
#include <weft/spatial/mesh/circumcenter_3.h>
#include <weft/spatial/restricted/has_free_vertex_3.h>
#include <weft/spatial/restricted/topological_disk_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
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

  /// An element by the ids of its vertices in falling order, filled up with -1.
  using Element = std::array<int, 4>;

  /// Elements that are bad now are tolerated from now on, as long as they don't get worse. Linear in the size of the
  /// mesh.
  /// \param threads to use where many elements are looked at; what they find is the same for any number. Criteria of
  ///   the user are asked by one.
  /// \param moving_only whether to look only at elements with a vertex that isn't fixed, as far as others stay as they
  ///   are.
  Criteria_guard_3(const Restricted& mesh, const Criteria_3<Kernel>& criteria, int threads = 1,
                   bool moving_only = false)
      : mesh_(mesh),
        measure_(mesh, criteria, 1),
        deviation_(mesh),
        allowed_(criteria.deviation),
        threads_(Restricted::Oracle::is_thread_safe && !criteria.has_functions() ? threads : 1),
        moving_only_(moving_only)
  {
    const Part all = everything();
    const CGAL::Bbox_3 b = mesh.oracle().bbox();
    const double rounding = 1e-6 * std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
    farthest_ = {rounding * rounding, rounding * rounding}; // all that is seen on flat patches
    // Most facets needn't be measured, once a far one is known.
    for_blocks(
        all.facets.size(), farthest_,
        [&](std::size_t k, std::uint64_t era, Squared_deviation_3& farthest) {
          farthest.raise_to(deviation_.beyond(farthest, facet(all.facets[k]), era));
        },
        [this](const Squared_deviation_3& farthest) { farthest_.raise_to(farthest); });
    farthest_.depth *= closer * closer;
    farthest_of_crease_ = rounding * rounding;
    for (const Crease_edge& e : mesh.creases().edges())
      farthest_of_crease_ = (std::max)(farthest_of_crease_, deviation_.of(e));
    tolerate(all);
    for (int p = 0; p < mesh.oracle().number_of_patches(); ++p)
      if (mesh.number_of_facets(p) > 0) patches_.push_back(p);
    for (std::size_t c = 0; c < mesh.creases().number_of_creases(); ++c)
      if (mesh.creases().number_of_edges(c) > 0) creases_.push_back(c);
  }

  const Restricted& mesh() const { return mesh_; }
  const Badness_measure_3<Restricted>& measure() const { return measure_; }
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
      if (offends(key(c), unlabelled_grade(c)) && mesh_.oracle().subdomain(c->circumcenter()) != 0) return false;
    }
    return true;
  }

  /// Before a change is made: whether cells and facets, which needn't be in the mesh, would be good, but for what hangs
  /// on those around them.
  bool may_accept(const std::vector<Cell_handle>& cells, const std::vector<Facet>& facets) const
  {
    for (const Cell_handle c : cells)
      if (c->subdomain() != 0 && offends(key(c), grade(c))) return false;
    for (const Facet& f : facets)
      if (offends(key(f), grade_by_criteria(f))) return false;
    return std::none_of(facets.begin(), facets.end(),
                        [this](const Facet& f) { return offends(key(f), grade_by_own_distance(f)); });
  }

  /// The first fault found in what the last change has made. Unlike `new_offenders()` it ends at the first, looks
  /// crease edges up only where the change was, and sees patches and creases that have lost everything.
  Refusal_3 refusal() const
  {
    for (const Cell_handle c : mesh_.new_cells())
      if (c->subdomain() != 0 && offends(key(c), grade(c))) return Refusal_3::cell;
    for (const int record : mesh_.new_facets())
      if (offends(key(facet(record)), grade_by_criteria(facet(record)))) return Refusal_3::facet;
    for (const Cell_handle c : mesh_.new_cells())
      if (has_bad_crease_edge(c)) return Refusal_3::crease;
    for (const int id : boundary_vertices(mesh_.new_cells()))
      if (offends({id, -1, -1, -1}, grade(vertex(id)))) return Refusal_3::disk;
    for (const int record : mesh_.new_facets())
      if (offends(key(facet(record)), grade_by_own_distance(facet(record)))) return Refusal_3::facet;
    const std::uint64_t era = present_era();
    for (const int record : mesh_.new_facets()) // the dearest last
      if (offends(key(facet(record)), grade_by_height(facet(record), era))) return Refusal_3::facet;
    return has_bare_part() ? Refusal_3::bare : Refusal_3::none;
  }
  bool accepts_change() const { return refusal() == Refusal_3::none; }

  /// The bad elements among those that the last change of the mesh has made, and all bad crease edges.
  std::vector<Element> new_offenders() const
  {
    std::vector<Element> bad;
    const auto collect = [&bad](const std::vector<Element>& some) { bad.insert(bad.end(), some.begin(), some.end()); };
    const std::vector<int>& facets = mesh_.new_facets();
    for_blocks(
        facets.size(), std::vector<Element>(),
        [&](std::size_t k, std::uint64_t era, std::vector<Element>& some) {
          const Facet& f = facet(facets[k]);
          if (f.cell != Cell_handle() && offends(f, era)) some.push_back(key(f));
        },
        collect);
    for (const Cell_handle c : mesh_.new_cells())
      if (c->subdomain() != 0 && offends(key(c), grade(c))) bad.push_back(key(c));
    for (const Crease_edge& e : mesh_.creases().edges())
      if (offends(key(e), grade(e))) bad.push_back(key(e));
    for (const int id : boundary_vertices(mesh_.new_cells()))
      if (offends({id, -1, -1, -1}, grade(vertex(id)))) bad.push_back({id, -1, -1, -1});
    return bad;
  }

  /// Tolerates what is bad now, too, as after changes that were judged by the elements that they made: how far the
  /// surface is from a facet hangs on the facets around it, too. Linear in the size of the mesh.
  void tolerate_all() { tolerate(everything()); }

  /// To be called when all vertices get new numbers.
  /// \param numbers the new ones by the old ones; -1 for vertices that are gone.
  void renumber(const std::vector<int>& numbers)
  {
    std::map<Element, Grade> renumbered;
    for (const auto& [element, grade] : tolerated_) {
      Element ids = element;
      bool exists = true;
      for (int& id : ids) {
        if (id < 0) continue;
        id = numbers[static_cast<std::size_t>(id)];
        exists = exists && id >= 0;
      }
      if (exists) renumbered[sorted(ids)] = grade;
    }
    tolerated_.swap(renumbered);
  }

  /// To be called when a vertex number gets another meaning: what was tolerated at it isn't any more.
  void forget(int id)
  {
    for (auto i = tolerated_.begin(); i != tolerated_.end();)
      i = std::find(i->first.begin(), i->first.end(), id) == i->first.end() ? std::next(i) : tolerated_.erase(i);
  }

  /// Whether an element exists and is bad.
  bool is_offending(const Element& e) const
  {
    const auto& tr = mesh_.triangulation();
    Cell_handle c;
    int i, j, k, l;
    if (e[3] >= 0)
      return tr.is_cell(vertex(e[0]), vertex(e[1]), vertex(e[2]), vertex(e[3]), c, i, j, k, l) && c->subdomain() != 0 &&
             offends(e, grade(c));
    if (e[2] >= 0) {
      if (!tr.is_facet(vertex(e[0]), vertex(e[1]), vertex(e[2]), c, i, j, k)) return false;
      const Facet* f = mesh_.facet(c, 6 - i - j - k);
      return f && offends(*f, present_era());
    }
    if (e[1] >= 0) {
      const Crease_edge* edge = mesh_.creases().edge(vertex(e[0]), vertex(e[1]));
      return edge && offends(e, grade(*edge));
    }
    return offends(e, grade(vertex(e[0])));
  }

private:
  struct Part
  {
    std::vector<Cell_handle> cells;
    std::vector<int> facets; ///< numbers of records
  };

  /// How bad an element is; zeros for a good one.
  struct Grade
  {
    double badness = 0;           ///< ratio of its worst measure to the bound
    double depth = 0, height = 0; ///< squared distances between it and the surface, see Deviation_3
    int astray = 0;               ///< of a boundary facet, vertices that don't lie on the boundary
    double turn = 0; ///< of a boundary facet that is turned away from the surface, see facet_turn_3.h: 1 - cosine

    bool is_bad() const { return badness > 0 || depth > 0 || height > 0 || astray > 0 || turn > 0; }
    bool exceeds(const Grade& other) const
    {
      constexpr double slack = 1 + 1e-9;
      return badness > slack * other.badness || depth > slack * other.depth || height > slack * other.height ||
             astray > other.astray || turn > slack * other.turn;
    }
  };

  /// Calls `look(k, era, result)` for k in [0, n), block by block, each with a result and an era of its own, then
  /// `take(result)` in order of the blocks, which are the same for any number of threads.
  template <class Result, class Look, class Take>
  void for_blocks(std::size_t n, const Result& initial, const Look& look, const Take& take) const
  {
    const std::size_t blocks = (n + block_size - 1) / block_size;
    std::vector<Result> results(blocks, initial);
    parallel_for(
        blocks, threads_,
        [&](std::size_t b) {
          const std::uint64_t era = Deviation_3<Restricted>::new_era();
          for (std::size_t k = b * block_size; k < (std::min)(n, (b + 1) * block_size); ++k) look(k, era, results[b]);
        },
        1);
    for (const Result& result : results) take(result);
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

  Part everything() const
  {
    Part all;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles())
      if (!moving_only_ || has_free_vertex(mesh_, c)) all.cells.push_back(c);
    for (std::size_t f = 0; f < mesh_.facets().size(); ++f)
      if (const Cell_handle c = mesh_.facets()[f].cell;
          c != Cell_handle() && (!moving_only_ || has_free_vertex(mesh_, c)))
        all.facets.push_back(static_cast<int>(f));
    return all;
  }

  void tolerate(const Part& part)
  {
    const auto look = [this](const Element& e, const Grade& grade) {
      if (offends(e, grade)) tolerated_[e] = grade;
    };
    using Grades = std::vector<std::pair<Element, Grade>>;
    for_blocks(
        part.facets.size(), Grades(),
        [&](std::size_t k, std::uint64_t era, Grades& bad) {
          const Grade g = grade(facet(part.facets[k]), era);
          if (g.is_bad()) bad.emplace_back(key(facet(part.facets[k])), g);
        },
        [&look](const Grades& bad) {
          for (const auto& [element, grade] : bad) look(element, grade);
        });
    for (const Cell_handle c : part.cells)
      if (c->subdomain() != 0) look(key(c), grade(c));
    for (const Crease_edge& e : mesh_.creases().edges()) look(key(e), grade(e));
    for (const int id : boundary_vertices(part.cells)) look({id, -1, -1, -1}, grade(vertex(id)));
  }

  bool offends(const Element& e, const Grade& grade) const
  {
    if (!grade.is_bad()) return false;
    const auto found = tolerated_.find(e);
    return found == tolerated_.end() || grade.exceeds(found->second);
  }

  /// The dearest is asked last.
  bool offends(const Facet& f, std::uint64_t era) const
  {
    const Element e = key(f);
    return offends(e, grade_by_criteria(f)) || offends(e, grade_by_own_distance(f)) ||
           offends(e, grade_by_height(f, era));
  }

  bool has_bare_part() const
  {
    return std::any_of(patches_.begin(), patches_.end(), [this](int p) { return mesh_.number_of_facets(p) == 0; }) ||
           std::any_of(creases_.begin(), creases_.end(),
                       [this](std::size_t c) { return mesh_.creases().number_of_edges(c) == 0; });
  }

  // ---- grades

  Grade grade(Cell_handle c) const { return {ratio(measure_.cell(c)), 0, 0, 0, 0}; }
  Grade unlabelled_grade(Cell_handle c) const { return {ratio(measure_.unlabelled_cell(c)), 0, 0, 0, 0}; }

  Grade grade(const Facet& f, std::uint64_t era) const
  {
    Grade grade = grade_by_criteria(f);
    const Grade own = grade_by_own_distance(f);
    grade.depth = own.depth;
    grade.turn = own.turn;
    grade.height = grade_by_height(f, era).height;
    return grade;
  }

  Grade grade_by_criteria(const Facet& f) const
  {
    Grade grade{ratio(measure_.facet(f)), 0, 0, 0, 0};
    for (int i = 1; i < 4; ++i) grade.astray += f.cell->vertex((f.index + i) & 3)->location().dimension > 2;
    return grade;
  }

  /// What hangs on the facets around it, too.
  Grade grade_by_height(const Facet& f, std::uint64_t era) const
  {
    return {0, 0, deviation_.height_beyond(bound_at(f.steiner).height, f, era), 0, 0};
  }

  /// What doesn't hang on the facets around it. How deep a facet is, and how its corners look, is its own affair.
  Grade grade_by_own_distance(const Facet& f) const
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

  Grade grade(const Crease_edge& e) const
  {
    const double d = deviation_.of(e), allowed = allowed_ ? allowed_(e.steiner) : 0;
    const double farthest = (std::max)(farthest_of_crease_, allowed * allowed);
    return {ratio(measure_.crease_edge(e)), d > farthest ? d : 0, 0, 0, 0};
  }

  Squared_deviation_3 bound_at(const typename Restricted::Point& p) const
  {
    Squared_deviation_3 bound = farthest_;
    const double allowed = allowed_ ? allowed_(p) : 0;
    bound.raise_to({allowed * allowed, allowed * allowed});
    return bound;
  }

  static double ratio(const Badness_3& badness) { return badness.is_bad() ? badness.ratio : 0; }

  Grade grade(Vertex_handle v) const { return {has_topological_disk(mesh_, v) ? 0. : 1., 0, 0, 0, 0}; }

  bool has_bad_crease_edge(Cell_handle c) const
  {
    if (mesh_.creases().edges().empty()) return false;
    for (int i = 0; i < 3; ++i)
      for (int j = i + 1; j < 4; ++j) {
        const Crease_edge* e = mesh_.creases().edge(c->vertex(i), c->vertex(j));
        if (e && offends(key(*e), grade(*e))) return true;
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

  static Element sorted(Element ids)
  {
    std::sort(ids.begin(), ids.end(), [](int a, int b) { return a > b; });
    return ids;
  }
  static Element key(const Crease_edge& e) { return sorted({e.source->id(), e.target->id(), -1, -1}); }
  static Element key(Cell_handle c)
  {
    return sorted({c->vertex(0)->id(), c->vertex(1)->id(), c->vertex(2)->id(), c->vertex(3)->id()});
  }
  static Element key(const Facet& f)
  {
    const auto id = [&f](int i) { return f.cell->vertex((f.index + i) & 3)->id(); };
    return sorted({id(1), id(2), id(3), -1});
  }

  const Restricted& mesh_;
  Badness_measure_3<Restricted> measure_;
  std::map<Element, Grade> tolerated_;
  std::vector<int> patches_;         ///< that have facets
  std::vector<std::size_t> creases_; ///< that have edges
  Deviation_3<Restricted> deviation_;
  std::uint64_t name_ = Deviation_3<Restricted>::new_era(); ///< in the memory of facets that are good by themselves
  mutable std::uint64_t era_ = 0;                           ///< of the mesh in this version, for single changes
  mutable int version_ = -1;
  Length_field_3<Kernel> allowed_; ///< see `Criteria_3::deviation`
  Squared_deviation_3 farthest_;   ///< that facets may be
  double farthest_of_crease_ = 0;  ///< that crease edges may be, squared
  int threads_;
  bool moving_only_;
  /// For what lies between the samples of facets.
  static constexpr double closer = 0.85;
  static constexpr std::size_t block_size = 128; ///< facets that are looked at one after the other
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_CRITERIA_GUARD_3_H
