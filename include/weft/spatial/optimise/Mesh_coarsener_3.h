// SPDX-License-Identifier: GPL-3.0-or-later
//
// The coarsener behind coarsen_3.h.

#ifndef WEFT_SPATIAL_OPTIMISE_MESH_COARSENER_3_H
#define WEFT_SPATIAL_OPTIMISE_MESH_COARSENER_3_H

#include <weft/internal/boxes/nearest_point_3.h>
#include <weft/internal/parallel_for.h>
#include <weft/internal/Timer.h>
#include <weft/spatial/criteria/Approximation_multiples.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/Coarsen_options_3.h>
#include <weft/spatial/restricted/Removal_preview_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>
#include <weft/spatial/restricted/Vertex_transaction_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <iterator>
#include <utility>
#include <vector>

namespace weft::internal {

/// The coarsener; `coarsen_3()` runs it.
template <class Restricted>
class Mesh_coarsener_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;

  Mesh_coarsener_3(Restricted& mesh, Criteria_guard_3<Restricted>& guard, const Coarsen_options_3& options)
      : mesh_(mesh),
        guard_(guard),
        options_(options),
        is_promising_(mesh.vertices().size(), true),
        vacant_(mesh),
        preview_(mesh)
  {}

  Coarsen_report_3 run()
  {
    bound_ = cosine_of_degrees(options_.min_dihedral_angle);
    while (static_cast<int>(report_.passes) < options_.most_passes && goes_on_) {
      const std::size_t before = report_.removed;
      run_pass();
      const auto gain = static_cast<double>(report_.removed - before);
      if (gain < options_.least_gain * static_cast<double>(mesh_.vertices().size())) break;
    }
    mesh_.add_counts(preview_.counts());
    if (report_.removed > 0) guard_.renumber(vacant_.close());
    report_.seconds = timer_.seconds();
    return report_;
  }

private:
  using Preview = Removal_preview_3<Restricted>;

  void run_pass()
  {
    ++report_.passes;
    if (report_.passes == 1) leave_excellent();
    std::vector<std::pair<double, int>> order;
    for (const Vertex_handle v : mesh_.vertices())
      if (v != Vertex_handle() && !mesh_.is_fixed(v) && is_promising_[static_cast<std::size_t>(v->id())])
        order.emplace_back(shortest_edge(v), v->id());
    std::sort(order.begin(), order.end());
    const std::size_t window = (std::max)(least_window, mesh_.vertices().size() / 4);
    std::size_t tried = report_.tried, removed = report_.removed; // when the window began
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (may_look_ahead() && i % look_ahead == 0) judge_ahead(order, i);
      goes_on_ = timer_.seconds() < options_.time_limit && (i % 64 != 0 || !options_.go_on || options_.go_on());
      if (!goes_on_) return;
      report_.removed += remove(order[i].second, i % look_ahead);
      if (report_.tried < tried + window) continue;
      if (report_.removed < removed + window / part_in_window) return; // the others have longer edges, and few are left
      tried = report_.tried;
      removed = report_.removed;
    }
  }

  /// Interior vertices among excellent cells aren't tried: those of a lattice, which is as sparse as its size allows.
  void leave_excellent()
  {
    const double smallest = cosine_of_degrees(smallest_excellent_dihedral),
                 largest = cosine_of_degrees(largest_excellent_dihedral);
    std::vector<char> is_excellent(is_promising_.size(), true);
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (Restricted::is_at_box(c) || has_dihedrals_between(c, smallest, largest)) continue;
      for (int i = 0; i < 4; ++i) is_excellent[static_cast<std::size_t>(c->vertex(i)->id())] = false;
    }
    for (const Vertex_handle v : mesh_.vertices())
      if (v->location().dimension == 3 && is_excellent[static_cast<std::size_t>(v->id())])
        is_promising_[static_cast<std::size_t>(v->id())] = false;
  }

  double shortest_edge(Vertex_handle v)
  {
    neighbours_.clear();
    mesh_.triangulation().finite_adjacent_vertices(v, std::back_inserter(neighbours_));
    double shortest = HUGE_VAL;
    for (const Vertex_handle w : neighbours_)
      shortest = (std::min)(shortest, CGAL::to_double(CGAL::squared_distance(v->point(), w->point())));
    return shortest;
  }

  /// What is known of a vertex without taking it away.
  enum class Verdict
  {
    needed,  ///< by the surface
    refused, ///< by the guard
    open
  };

  /// A verdict of a mesh in which nothing was changed yet around the vertex.
  struct Early_verdict
  {
    Verdict verdict = Verdict::open;
    bool is_known = false;
    std::vector<int> neighbours; ///< ids
    Oracle_counts_3 counts;
  };

  /// Several threads judge vertices of the mesh as it is, some of them one after the other. What they find is what they
  /// would find when it is the turn of the vertex, unless something has changed around it.
  bool may_look_ahead() const { return guard_.threads() > 1 && bound_ >= 1; }

  void judge_ahead(const std::vector<std::pair<double, int>>& order, std::size_t first)
  {
    const std::size_t n = (std::min)(look_ahead, order.size() - first), part = look_ahead / parts;
    early_.resize(look_ahead);
    while (previews_.size() < parts) previews_.emplace_back(mesh_);
    early_version_ = mesh_.version();
    parallel_for(
        parts, guard_.threads(),
        [&](std::size_t p) {
          for (std::size_t k = p * part; k < (std::min)(n, (p + 1) * part); ++k) {
            const Vertex_handle v = mesh_.vertices()[static_cast<std::size_t>(order[first + k].second)];
            early_[k] = judged(v, previews_[p], previews_[p].look_without_marks(v));
          }
        },
        1);
  }

  Early_verdict judged(Vertex_handle v, Preview& preview, bool is_seen) const
  {
    Early_verdict result;
    result.is_known = is_seen;
    if (!is_seen) return result;
    for (const Vertex_handle w : preview.neighbours())
      if (w->id() >= 0) result.neighbours.push_back(w->id());
    const Oracle_counts_3 before = preview.counts();
    if (is_needed(v))
      result.verdict = Verdict::needed;
    else if (!may_be_left_out(v, preview))
      result.verdict = Verdict::refused;
    result.counts = preview.counts();
    result.counts.segments -= before.segments;
    result.counts.locations -= before.locations;
    result.counts.skipped -= before.skipped;
    return result;
  }

  /// Whether nothing around the vertex has changed since.
  bool holds(const Early_verdict& early) const
  {
    return early.is_known && std::all_of(early.neighbours.begin(), early.neighbours.end(), [this](int id) {
             const Vertex_handle w = mesh_.vertices()[static_cast<std::size_t>(id)];
             return w != Vertex_handle() && mesh_.changed_at(w) < early_version_;
           });
  }

  Verdict verdict(Vertex_handle v, std::size_t ahead)
  {
    if (may_look_ahead() && holds(early_[ahead])) {
      mesh_.add_counts(early_[ahead].counts);
      return early_[ahead].verdict;
    }
    if (is_needed(v)) return Verdict::needed;
    return preview_.look_without(v) && !may_be_left_out(v, preview_) ? Verdict::refused : Verdict::open;
  }

  /// Takes a vertex away for good if nothing needs it.
  /// \param ahead its place among the early verdicts.
  bool remove(int id, std::size_t ahead)
  {
    const Vertex_handle v = mesh_.vertices()[static_cast<std::size_t>(id)];
    const Verdict early = verdict(v, ahead);
    report_.tried += early != Verdict::needed;
    if (early != Verdict::open) {
      is_promising_[static_cast<std::size_t>(id)] = false;
      return false;
    }
    const double limit = worst_allowed(v);
    Vertex_transaction_3<Restricted> change(mesh_, v);
    if (guard_.may_accept(change.filling())) {
      change.leave_out(vacant_);
      if (keeps_angles(change.filling(), limit) && guard_.accepts_change()) {
        set_promising(change.filling());
        change.commit();
        return true;
      }
    }
    is_promising_[static_cast<std::size_t>(id)] = false;
    change.roll_back();
    return false;
  }

  /// Whether nothing that can be seen without changing the mesh speaks against it.
  bool may_be_left_out(Vertex_handle v, Preview& preview) const
  {
    if (!guard_.may_accept(preview.cells())) return false;
    preview.classify();
    return keeps_angles(preview.cells(), worst_allowed(v)) && guard_.may_accept(preview.cells(), preview.facets());
  }

  /// Whether the surface at a vertex on a patch is farther from every triangle between its neighbours there than facets
  /// may be, and a little more: the facets that would fill its place are some of those triangles. That spares trials,
  /// and leaves few vertices that could be taken away all the same.
  bool is_needed(Vertex_handle v) const
  {
    if (v->location().dimension != 2) return false;
    const double bound = Approximation_multiples::needed_vertex * guard_.measure().approximation(v->point());
    if (bound == 0) return false;
    thread_local std::vector<Vertex_handle> n;
    n.clear();
    mesh_.visit_facets_at(v, [v](const typename Restricted::Restricted_facet& f) {
      for (int i = 1; i < 4; ++i)
        if (f.cell->vertex((f.index + i) & 3) != v) n.push_back(f.cell->vertex((f.index + i) & 3));
    });
    std::sort(n.begin(), n.end(), [](Vertex_handle a, Vertex_handle b) { return a->id() < b->id(); });
    n.erase(std::unique(n.begin(), n.end()), n.end());
    for (std::size_t i = 2; i < n.size(); ++i)
      for (std::size_t j = 1; j < i; ++j)
        for (std::size_t k = 0; k < j; ++k) {
          const Point nearest = nearest_point_on_triangle(v->point(), n[i]->point(), n[j]->point(), n[k]->point());
          if (CGAL::to_double(CGAL::squared_distance(nearest, v->point())) <= bound * bound) return false;
        }
    return true;
  }

  /// What was tried in vain is tried again only after a change near by: of facets for vertices on the boundary, since
  /// those are what refuses them.
  void set_promising(const std::vector<Cell_handle>& filling)
  {
    for (const Cell_handle c : filling)
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i)->location().dimension == 3) is_promising_[static_cast<std::size_t>(c->vertex(i)->id())] = true;
    for (const int record : mesh_.new_facets()) {
      const auto& f = mesh_.facets()[static_cast<std::size_t>(record)];
      for (int i = 1; i < 4; ++i)
        is_promising_[static_cast<std::size_t>(f.cell->vertex((f.index + i) & 3)->id())] = true;
    }
  }

  /// Cosine of the smallest dihedral angle that may be made: the bound, or that of the cells around a vertex.
  double worst_allowed(Vertex_handle v) const
  {
    if (bound_ >= 1) return 1;
    std::vector<Cell_handle> star;
    mesh_.triangulation().incident_cells(v, std::back_inserter(star));
    double worst = bound_;
    for (const Cell_handle c : star)
      if (c->subdomain() != 0) worst = (std::max)(worst, cosines_of_cell(c).smallest);
    return worst;
  }

  static bool keeps_angles(const std::vector<Cell_handle>& filling, double limit)
  {
    return std::all_of(filling.begin(), filling.end(),
                       [&](Cell_handle c) { return c->subdomain() == 0 || cosines_of_cell(c).smallest <= limit; });
  }

  static constexpr std::size_t look_ahead = 128, parts = 8; ///< early verdicts, and how many threads may share them
  static constexpr std::size_t least_window = 400;          ///< trials
  static constexpr std::size_t part_in_window = 100;        ///< a pass ends where fewer than one in so many succeed

  Restricted& mesh_;
  Criteria_guard_3<Restricted>& guard_;
  const Coarsen_options_3& options_;
  double bound_ = 1;
  bool goes_on_ = true;
  std::vector<char> is_promising_; ///< by id
  Vacant_numbers_3<Restricted> vacant_;
  Preview preview_;
  std::deque<Preview> previews_;     ///< for early verdicts
  std::vector<Early_verdict> early_; ///< of the vertices whose turn comes next
  int early_version_ = 0;            ///< of the mesh then
  std::vector<Vertex_handle> neighbours_;
  Timer timer_;
  Coarsen_report_3 report_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_MESH_COARSENER_3_H
