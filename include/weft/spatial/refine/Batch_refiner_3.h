// SPDX-License-Identifier: GPL-3.0-or-later
//
// Batch refinement of a restricted Delaunay triangulation (Tournois 2009, sec. 3.2.1.4, Alg. 6): collect bad crease
// edges, facets and cells, choose Steiner points whose conflict zones are independent, worst first and in order of
// dimension, cells by multiple choice, and insert them together. Which point mends an element best is up to
// Steiner_chooser_3.h; where there is none, a Steiner point that encroaches upon the surface Delaunay ball of an
// element of lower dimension gives way to that element's own.

#ifndef WEFT_SPATIAL_REFINE_BATCH_REFINER_3_H
#define WEFT_SPATIAL_REFINE_BATCH_REFINER_3_H

#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/refine/Acute_refinement_3.h>
#include <weft/spatial/refine/Bad_elements_list_3.h>
#include <weft/spatial/refine/Disk_mender_3.h>
#include <weft/spatial/refine/Multiple_choice.h>
#include <weft/spatial/refine/Refinement_policy_3.h>
#include <weft/spatial/refine/Steiner_batch_3.h>
#include <weft/spatial/refine/Steiner_proposals_3.h>
#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace weft::internal {

/// What one batch did.
struct Batch_3
{
  std::size_t inserted = 0;
  std::size_t bad = 0; ///< bad elements before it, as far as they were looked at
};

/// Refines in batches until nothing is bad.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Batch_refiner_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Restricted_facet = typename Restricted::Restricted_facet;
  using Crease_edge = typename Restricted::Crease_edge;
  using Measure = Badness_measure_3<Restricted>;

  /// \param factor by which the criteria are loosened.
  /// \param with_cells whether cells are refined, too; else only crease edges and facets.
  /// \param size_floor no Steiner point is inserted closer than that to a vertex.
  /// \param settled what `settle()` returned for a refiner of this mesh with the same criteria; 0 if there was none.
  Batch_refiner_3(Restricted& mesh, const Criteria_3<Kernel>& criteria, double factor, bool with_cells,
                  double size_floor, unsigned seed, int settled = 0,
                  const Refinement_policy_3& policy = Refinement_policy_3())
      : mesh_(mesh),
        with_cells_(with_cells),
        policy_(policy),
        measure_(mesh, criteria, factor, policy.sees_ridges),
        batch_(mesh, measure_, size_floor * size_floor, policy),
        bad_(mesh, measure_, batch_.chooser(), with_cells),
        acute_(mesh, measure_, batch_),
        proposals_(mesh, criteria.has_functions() ? 1 : mesh.threads()),
        random_(seed),
        disks_(mesh, measure_, batch_, acute_, random_)
  {
    mesh_.update();
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) bad_.add_cell(c);
    for (std::size_t f = 0; f < mesh_.facets().size(); ++f)
      if (mesh_.facets()[f].cell != Cell_handle()) add_facet(static_cast<int>(f), settled);
    disks_.add_vertices(settled);
  }

  Batch_refiner_3(const Batch_refiner_3&) = delete; // its parts know each other
  Batch_refiner_3& operator=(const Batch_refiner_3&) = delete;

  /// See Acute_refinement_3.
  void leave_knife_edges() { acute_.leave_knife_edges(); }

  /// One batch of at most `room` vertices. Nothing is inserted when all criteria hold, or where they don't, no Steiner
  /// point is possible.
  Batch_3 refine(std::size_t room)
  {
    batch_.begin(room);
    acute_.begin_batch();
    Batch_3 result;
    result.bad += choose_edges();
    if (policy_.mirrors) acute_.choose_mirror_images();
    result.bad += choose_facets();
    const auto has_room = [this] { return batch_.size() == 0 || !policy_.sorts_dimensions; };
    if (has_room())
      result.bad += disks_.choose_at_vertices([this](const Restricted_facet& f) { choose(f, false, false); });
    if (has_room()) result.bad += choose_cells();
    insert_chosen();
    result.inserted = batch_.size();
    // Without cells, the surface will be refined once more.
    return batch_.size() == 0 && with_cells_ && acute_.lower_floor() ? refine(room) : result;
  }

  /// To be called when nothing was inserted last: another refiner needn't look at facets and vertices again that are
  /// good and stay.
  /// \returns the version of the mesh; what is bad counts as changed in it.
  int settle()
  {
    bad_.set_changed();
    disks_.set_changed();
    return mesh_.version();
  }

  /// Whether a facet has been found that is turned away from the surface, see facet_turn_3.h.
  bool has_found_turned() const { return bad_.has_found_turned(); }

  std::size_t candidates() const { return batch_.candidates(); }
  std::size_t encroachments() const { return batch_.encroachments(); }

private:
  using Bad_cell = typename Bad_elements_list_3<Restricted>::Bad_cell;
  using Bad_facet = typename Bad_elements_list_3<Restricted>::Bad_facet;
  using Zone = typename Restricted::Zone;
  using Proposals = Steiner_proposals_3<Restricted>;
  using Proposal = typename Proposals::Proposal;

  void add_facet(int record, int settled = 0)
  {
    acute_.add_facet(record);
    bad_.add_facet(record, settled);
  }

  std::size_t choose_edges()
  {
    const auto& edges = bad_.edges();
    for (const auto& [ratio, e] : edges) acute_.choose(*e, true);
    return edges.size();
  }

  std::size_t choose_facets()
  {
    auto& facets = bad_.facets();
    constexpr std::size_t block = Proposals::block_size;
    for (std::size_t i = 0; i < facets.size(); ++i) {
      if (i % block == 0) look_ahead_from(i, (std::min)(block, facets.size() - i));
      Bad_facet& f = facets[i];
      if (f.is_stuck) continue;
      const Choice_3 choice = choose(*find_facet(mesh_, f.id), f.is_free, f.is_needed, proposals_.find(i % block));
      f.is_stuck = choice == Choice_3::impossible;
    }
    return facets.size();
  }

  void look_ahead_from(std::size_t first, std::size_t n)
  {
    const std::vector<Bad_facet>& facets = bad_.found_facets();
    const auto facet = [&](std::size_t k) { return find_facet(mesh_, facets[first + k].id); };
    proposals_.look_ahead(
        n, batch_.number(),
        [&](std::size_t k) {
          const bool may_be = !facets[first + k].is_stuck && facets[first + k].is_free && !batch_.is_full() &&
                              facet(k)->cell->batch() != batch_.number() &&
                              facet(k)->squared_radius >= batch_.squared_floor();
          return may_be ? facet(k)->cell : Cell_handle();
        },
        [&](std::size_t k, const auto& find, Zone& zone, std::size_t& candidates) {
          return find_best(*facet(k), find, zone, candidates);
        });
  }

  std::size_t choose_cells()
  {
    std::vector<Bad_cell>& cells = bad_.cells();
    std::vector<std::size_t> pool;
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (!cells[i].is_stuck) pool.push_back(i);
    choice_.begin(std::move(pool));
    std::size_t in_vain = 0;
    for (bool goes_on = true; goes_on;) {
      const std::vector<std::size_t>& picked = choice_.pick(
          Proposals::block_size, [&](std::size_t i, std::size_t j) { return cells[i].ratio < cells[j].ratio; });
      if (picked.empty()) break;
      proposals_.look_ahead(
          picked.size(), batch_.number(),
          [&](std::size_t k) {
            const Cell_handle c = cells[picked[k]].cell;
            return !is_near_claimed(c) && squared_radius(c) >= batch_.squared_floor() ? c : Cell_handle();
          },
          [&](std::size_t k, const auto& find, Zone& zone, std::size_t& candidates) {
            ++candidates;
            const Cell_handle c = cells[picked[k]].cell;
            return policy_.chooses_points ? batch_.chooser().choose_by(c, find, zone)
                                          : find(c->circumcenter(), c, zone);
          });
      for (std::size_t k = 0; k < picked.size() && goes_on; ++k) {
        goes_on =
            !batch_.is_full() && !(batch_.size() > 0 && in_vain > in_vain_at_least + in_vain_for_each * batch_.size());
        if (!goes_on) choice_.end_after(k);
        Bad_cell& b = cells[picked[k]];
        if (!goes_on || is_near_claimed(b.cell)) continue;
        const Choice_3 choice = choose(b.cell, proposals_.find(k));
        b.is_stuck = choice == Choice_3::impossible;
        in_vain += choice == Choice_3::later;
      }
    }
    return cells.size();
  }

  /// A cell whose zone surely or very likely touches a claimed one; looking for the zone would tell no more.
  bool is_near_claimed(Cell_handle c) const
  {
    if (c->batch() == batch_.number()) return true;
    for (int i = 0; i < 4; ++i)
      if (c->neighbor(i)->batch() == batch_.number()) return true;
    return false;
  }

  /// \param free whether the point may be moved; the topology of a mesh is mended only by the Steiner point itself.
  /// \param proposal null if there is none.
  Choice_3 choose(const Restricted_facet& f, bool free, bool needed, Proposal* proposal = nullptr)
  {
    if (!needed && acute_.is_left(f.steiner, f.squared_radius)) return Choice_3::later;
    if (f.squared_radius < (free ? batch_.squared_floor() : batch_.squared_topology_floor()))
      return Choice_3::impossible;
    const Zone_result result = free ? find_best(f, proposal) : batch_.find_near(disks_.steiner_point(f), f);
    if (result != Zone_result::found) return batch_.failure(result);
    if (const Crease_edge* e = batch_.encroached_edge()) return acute_.choose(*e, needed);
    return batch_.accept({2, f.patch});
  }

  /// The best Steiner point of a facet, or where the surface bends near its own, a point there. A tip that the facet
  /// misses by more than the bound comes first. Reaches of 0.4 and 0.5 radii: of 0.3 to 0.7 for both, these give the
  /// fewest vertices on average.
  template <class Find>
  Zone_result find_best(const Restricted_facet& f, const Find& find, Zone& zone, std::size_t& candidates) const
  {
    Point p = f.steiner;
    const auto missed = policy_.sees_ridges ? measure_.worst_missed_point(f) : typename Measure::Missed_point{p};
    const double radius = std::sqrt(f.squared_radius);
    ++candidates;
    if (missed.ratio > 1) {
      if (missed.is_vertex) p = missed.point;
    }
    // Between the sides of an acute edge it isn't the best point that ends refinement but the mirror image.
    else if (!(policy_.follows_folds && mesh_.oracle().attract(p, 0.4 * radius, 0.5 * radius, f.patch)) &&
             policy_.chooses_points && !mesh_.oracle().is_at_acute_edge(f.steiner, radius)) {
      return batch_.chooser().choose_by(f, find, zone);
    }
    const Zone_result result = batch_.chooser().find_by(p, f, find, zone);
    if (result != Zone_result::no_conflict || p == f.steiner) return result;
    ++candidates;
    return batch_.chooser().find_by(f.steiner, f, find, zone);
  }

  Zone_result find_best(const Restricted_facet& f, Proposal* proposal)
  {
    if (f.cell->batch() == batch_.number()) return Zone_result::claimed; // looking for the point would tell no more
    if (proposal) return batch_.take(*proposal);
    std::size_t candidates = 0;
    const Zones_between_claims_3<Restricted> find{mesh_.triangulation(), batch_.number()};
    const Zone_result result = find_best(f, find, batch_.zone(), candidates);
    batch_.add_candidates(candidates);
    return result;
  }

  static double squared_radius(Cell_handle c)
  {
    return CGAL::to_double(CGAL::squared_distance(c->circumcenter(), c->vertex(0)->point()));
  }

  Choice_3 choose(Cell_handle c, Proposal* proposal)
  {
    const Point& p = c->circumcenter();
    if (squared_radius(c) < batch_.squared_floor()) return Choice_3::impossible;
    const bool needed = must_be_refined(measure_.cell(c).reasons, false);
    if (!needed && acute_.is_left(p, squared_radius(c))) return Choice_3::later;
    Zone_result result = proposal                 ? batch_.take(*proposal)
                         : policy_.chooses_points ? batch_.find_best(c)
                                                  : batch_.find(p, c);
    if (policy_.chooses_points) {
      if (result == Zone_result::found) return batch_.accept({3, c->subdomain()});
      if (result == Zone_result::no_conflict) result = batch_.find(p, c);
    }
    if (result != Zone_result::found) return batch_.failure(result);
    if (const Crease_edge* e = batch_.encroached_edge()) return acute_.choose(*e, needed);
    if (const Restricted_facet* f = batch_.encroached_facet()) return choose(*f, true, needed);
    return batch_.accept({3, c->subdomain()});
  }

  void insert_chosen()
  {
    const auto forget = [this](const std::vector<Cell_handle>& cells) {
      for (const Cell_handle c : cells) {
        bad_.forget(c);
        for (int i = 0; i < 4; ++i)
          if (const Restricted_facet* f = mesh_.facet(c, i)) disks_.set_undecided(*f);
      }
    };
    batch_.insert(forget);
    add_new_elements();
    batch_.insert_twins(forget, [this] { add_new_elements(); });
  }

  void add_new_elements()
  {
    disks_.add_new_vertices();
    for (const Cell_handle c : mesh_.new_cells()) bad_.add_cell(c);
    for (const int record : mesh_.new_facets()) {
      disks_.set_undecided(mesh_.facets()[static_cast<std::size_t>(record)]);
      add_facet(record);
    }
  }

  /// Cells tried in vain that end a batch, beside those for each of its vertices. In sharp wedges a batch would try
  /// thousands to insert a few; elsewhere it is mostly far fewer.
  static constexpr std::size_t in_vain_at_least = 200, in_vain_for_each = 100;

  Restricted& mesh_;
  bool with_cells_;
  Refinement_policy_3 policy_;
  Measure measure_;
  Steiner_batch_3<Restricted> batch_;
  Bad_elements_list_3<Restricted> bad_;
  Acute_refinement_3<Restricted> acute_;
  Proposals proposals_;
  std::mt19937 random_; ///< all random choices, in the order in which they are made
  Disk_mender_3<Restricted> disks_;
  Multiple_choice choice_{random_}; ///< of cells
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_BATCH_REFINER_3_H
