// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bad crease edges, facets and cells of a restricted Delaunay triangulation while it is refined (Tournois 2009,
// sec. 3.2.1.4): elements are measured once when they are made, and how bad they are is remembered until they are gone.

#ifndef WEFT_SPATIAL_REFINE_BAD_ELEMENTS_LIST_3_H
#define WEFT_SPATIAL_REFINE_BAD_ELEMENTS_LIST_3_H

#include <weft/internal/parallel_for.h>
#include <weft/spatial/criteria/Approximation_multiples.h>
#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/criteria/facet_turn_3.h>
#include <weft/spatial/refine/Steiner_chooser_3.h>

#include <CGAL/centroid.h>
#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace weft::internal {

/// Names a restricted facet: records are used again.
struct Facet_id_3
{
  int record, version;
};

/// Null if it is gone.
template <class Restricted>
const typename Restricted::Restricted_facet* find_facet(const Restricted& mesh, const Facet_id_3& id)
{
  const auto& f = mesh.facets()[static_cast<std::size_t>(id.record)];
  return f.cell != typename Restricted::Cell_handle() && f.version == id.version ? &f : nullptr;
}

/// Whether an element has to be refined whatever the angles beside it. Distances don't count where the Steiner point
/// may belong to another part of the surface.
inline bool must_be_refined(unsigned reasons, bool is_mixed_up)
{
  return (reasons & bad_size) != 0 || ((reasons & bad_approximation) != 0 && !is_mixed_up);
}

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Bad_elements_list_3
{
public:
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Restricted_facet = typename Restricted::Restricted_facet;
  using Crease_edge = typename Restricted::Crease_edge;
  using Measure = Badness_measure_3<Restricted>;

  struct Bad_cell
  {
    Cell_handle cell; ///< null once it is gone
    double ratio;
    bool is_stuck; ///< no Steiner point is possible
  };
  struct Bad_facet
  {
    Facet_id_3 id;
    double ratio;
    bool is_free;   ///< only sizes and distances are at stake
    bool is_needed; ///< see `must_be_refined()`
    bool is_stuck;
  };
  using Bad_edge = std::pair<double, const Crease_edge*>;

  /// \param chooser is told which facets are bad.
  /// \param with_cells whether cells are looked at, too.
  Bad_elements_list_3(Restricted& mesh, const Measure& measure, Steiner_chooser_3<Restricted>& chooser, bool with_cells)
      : mesh_(mesh), measure_(measure), chooser_(chooser), with_cells_(with_cells)
  {}

  ~Bad_elements_list_3()
  {
    for (const Bad_cell& b : cells_)
      if (b.cell != Cell_handle()) b.cell->set_bad_index(-1);
  }
  Bad_elements_list_3(const Bad_elements_list_3&) = delete;
  Bad_elements_list_3& operator=(const Bad_elements_list_3&) = delete;

  void add_cell(Cell_handle c)
  {
    c->set_bad_index(-1);
    if (!with_cells_ || c->subdomain() == 0) return;
    const Badness_3 badness = measure_.cell(c);
    if (!badness.is_bad()) return;
    c->set_bad_index(static_cast<int>(cells_.size()));
    cells_.push_back({c, badness.ratio, false});
  }

  /// \param settled facets of earlier versions of the mesh are known to be good.
  void add_facet(int record, int settled = 0)
  {
    const auto r = static_cast<std::size_t>(record);
    const Restricted_facet& f = mesh_.facets()[r];
    const Facet_id_3 id{record, f.version};
    chooser_.set_bad_facet(r, false);
    if (f.version < settled) return;
    unseen_.push_back(id);
    const Badness_3 badness = measure_.facet(f);
    chooser_.set_bad_facet(r, badness.is_bad());
    if (badness.is_bad())
      facets_.push_back({id, badness.ratio, (badness.reasons & (bad_topology | bad_disk)) == 0,
                         must_be_refined(badness.reasons, f.crossings > 1), false});
  }

  /// To be told of cells that are about to go.
  void forget(Cell_handle c)
  {
    if (c->bad_index() >= 0) cells_[static_cast<std::size_t>(c->bad_index())].cell = Cell_handle();
  }

  /// The bad crease edges, the worst first.
  const std::vector<Bad_edge>& edges()
  {
    edges_.clear();
    for (const Crease_edge& e : mesh_.creases().edges()) {
      const Badness_3 badness = measure_.crease_edge(e);
      if (badness.is_bad()) edges_.emplace_back(badness.ratio, &e);
    }
    std::stable_sort(edges_.begin(), edges_.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    return edges_;
  }

  /// The bad facets, the worst first.
  std::vector<Bad_facet>& facets()
  {
    facets_.erase(
        std::remove_if(facets_.begin(), facets_.end(), [this](const Bad_facet& f) { return !find_facet(mesh_, f.id); }),
        facets_.end());
    if (measure_.sees_ridges() &&
        std::all_of(facets_.begin(), facets_.end(), [](const Bad_facet& f) { return f.is_stuck; }))
      look_again();
    // Records are numbered in order of creation, so ties don't depend on memory.
    std::stable_sort(facets_.begin(), facets_.end(),
                     [](const Bad_facet& a, const Bad_facet& b) { return a.ratio > b.ratio; });
    return facets_;
  }

  /// Whether a facet has been found that is turned away from the surface.
  bool has_found_turned() const { return has_found_turned_; }

  /// The bad cells, none of them gone, in no order.
  std::vector<Bad_cell>& cells()
  {
    std::size_t n = 0;
    for (const Bad_cell& b : cells_) {
      if (b.cell == Cell_handle()) continue;
      b.cell->set_bad_index(static_cast<int>(n));
      cells_[n++] = b;
    }
    cells_.resize(n);
    return cells_;
  }

  /// What `facets()` returned last.
  const std::vector<Bad_facet>& found_facets() const { return facets_; }

  /// Makes facets count as changed that are bad or haven't been looked at closely: see `Batch_refiner_3::settle()`.
  void set_changed()
  {
    for (const Bad_facet& f : facets_)
      if (find_facet(mesh_, f.id)) mesh_.set_changed(f.id.record);
    for (const Facet_id_3& id : unseen_)
      if (find_facet(mesh_, id)) mesh_.set_changed(id.record);
  }

private:
  /// When no facet is bad by what its axis meets, or nothing can be done about it, those that are new: their centers
  /// and the middles of their sides may be far from the surface.
  void look_again()
  {
    if constexpr (!Restricted::Oracle::labels_first) {
      enum : char
      {
        good,
        turned,
        far
      };
      std::vector<char> found(unseen_.size(), good);
      const int threads = measure_.criteria().has_functions() ? 1 : mesh_.threads();
      parallel_for(
          unseen_.size(), threads,
          [&](std::size_t k) {
            const Restricted_facet* f = find_facet(mesh_, unseen_[k]);
            if (!f) return;
            const bool is_turned = measure_.factor() <= 1 && cosine_to_surface(mesh_, *f) < least_cosine_to_surface;
            found[k] = is_turned ? turned : is_far(*f) ? far : good;
          },
          16);
      for (std::size_t k = 0; k < unseen_.size(); ++k) {
        if (found[k] == good) continue;
        const bool is_turned = found[k] == turned;
        has_found_turned_ = has_found_turned_ || is_turned;
        const bool is_mixed_up = find_facet(mesh_, unseen_[k])->crossings > 1;
        facets_.push_back({unseen_[k], Measure::just_bad, !is_turned,
                           !is_turned && must_be_refined(bad_approximation, is_mixed_up), false});
      }
    }
    unseen_.clear();
  }

  bool is_far(const Restricted_facet& f) const
  {
    const double bound = Approximation_multiples::facet * measure_.approximation(f.steiner, f.patch);
    if (bound == 0) return false;
    const Point &a = Measure::vertex(f, 1)->point(), &b = Measure::vertex(f, 2)->point(),
                &c = Measure::vertex(f, 3)->point();
    const Point samples[] = {CGAL::centroid(a, b, c), CGAL::midpoint(a, b), CGAL::midpoint(b, c), CGAL::midpoint(c, a)};
    return !std::all_of(std::begin(samples), std::end(samples),
                        [&](const Point& p) { return mesh_.oracle().is_within(p, bound * bound); });
  }

  Restricted& mesh_;
  const Measure& measure_;
  Steiner_chooser_3<Restricted>& chooser_;
  bool with_cells_;
  std::vector<Bad_cell> cells_;
  std::vector<Bad_facet> facets_;
  std::vector<Facet_id_3> unseen_; ///< facets that `look_again()` has yet to see
  std::vector<Bad_edge> edges_;
  bool has_found_turned_ = false;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_BAD_ELEMENTS_LIST_3_H
