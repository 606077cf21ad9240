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
#include <weft/spatial/refine/crease_steiner_point_3.h>
#include <weft/spatial/refine/Steiner_chooser_3.h>
#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>
#include <weft/spatial/restricted/spatial_order_3.h>
#include <weft/spatial/restricted/topological_disk_3.h>

#include <CGAL/centroid.h>
#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
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
  using Triangulation = typename Restricted::Triangulation;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Zone = typename Restricted::Zone;
  using Surface_hit = typename Restricted::Surface_hit;
  using Restricted_facet = typename Restricted::Restricted_facet;
  using Crease_edge = typename Restricted::Crease_edge;
  using Measure = Badness_measure_3<Restricted>;

  /// \param factor by which the criteria are loosened.
  /// \param with_cells whether cells are refined, too; else only crease edges and facets.
  /// \param size_floor no Steiner point is inserted closer than that to a vertex.
  /// \param settled what `settle()` returned for a refiner of this mesh with the same criteria; 0 if there was none.
  Batch_refiner_3(Restricted& mesh, const Criteria_3<Kernel>& criteria, double factor, bool with_cells,
                  double size_floor, unsigned seed, int settled = 0)
      : mesh_(mesh),
        with_cells_(with_cells),
        measure_(mesh, criteria, factor),
        squared_floor_(size_floor * size_floor),
        chooser_(mesh, measure_, squared_floor_),
        random_(seed)
  {
    mesh_.update();
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) add_cell(c);
    for (std::size_t f = 0; f < mesh_.facets().size(); ++f)
      if (mesh_.facets()[f].cell != Cell_handle()) add_facet(static_cast<int>(f), settled);
    for (const Vertex_handle v : mesh_.vertices()) undecided_.push_back(mesh_.changed_at(v) >= settled);
  }

  ~Batch_refiner_3()
  {
    for (const Bad_cell& b : bad_cells_)
      if (b.cell != Cell_handle()) b.cell->set_bad_index(-1);
  }
  Batch_refiner_3(const Batch_refiner_3&) = delete;
  Batch_refiner_3& operator=(const Batch_refiner_3&) = delete;

  /// One batch of at most `room` vertices. Nothing is inserted when all criteria hold, or where they don't, no Steiner
  /// point is possible.
  Batch_3 refine(std::size_t room)
  {
    room_ = room;
    used_ = 0;
    left_ = 0;
    batch_ = next_batch_number();
    Batch_3 result;
    result.bad += choose_edges();
    choose_mirror_images();
    result.bad += choose_facets();
    if (used_ == 0) result.bad += choose_at_vertices();
    if (used_ == 0) result.bad += choose_cells();
    insert_chosen();
    result.inserted = used_;
    return used_ == 0 && lower_acute_floor() ? refine(room) : result;
  }

  /// To be called when nothing was inserted last: another refiner needn't look at facets and vertices again that are
  /// good and stay. On the armadillo, looking at all of them takes 5 % of refinement each time. \returns the version of
  /// the mesh; what is bad counts as changed in it.
  int settle()
  {
    for (const Bad_facet& f : bad_facets_)
      if (facet(f.id)) mesh_.set_changed(f.id.record);
    for (const Facet_id& id : unseen_)
      if (facet(id)) mesh_.set_changed(id.record);
    for (std::size_t i = 0; i < undecided_.size(); ++i)
      if (undecided_[i]) mesh_.set_changed(mesh_.vertices()[i]);
    return mesh_.version();
  }

  std::size_t candidates() const { return candidates_; }
  std::size_t encroachments() const { return encroachments_; }

private:
  struct Bad_cell
  {
    Cell_handle cell; ///< null once it is gone
    double ratio;
    bool is_stuck; ///< no Steiner point is possible
  };
  struct Facet_id
  {
    int record, version; ///< records are used again
  };
  struct Bad_facet
  {
    Facet_id id;
    double ratio;
    bool is_free;   ///< only sizes and distances are at stake
    bool is_needed; ///< see `is_left()`
    bool is_stuck;
  };
  enum class Choice
  {
    chosen,
    later,     ///< its zone touches another's, or it is left as it is
    impossible ///< at the size floor, or out of its own zone by rounding
  };
  struct Chosen
  {
    Zone zone;
    Vertex_location_3 location;
  };

  int next_batch_number() const
  {
    // Numbers only have to differ from those that cells remember; vertices grow with every batch that does anything.
    return ++mesh_.batches();
  }

  // ---- what is bad

  void add_cell(Cell_handle c)
  {
    c->set_bad_index(-1);
    if (!with_cells_ || c->subdomain() == 0) return;
    const Badness_3 badness = measure_.cell(c);
    if (!badness.is_bad()) return;
    c->set_bad_index(static_cast<int>(bad_cells_.size()));
    bad_cells_.push_back({c, badness.ratio, false});
  }

  void add_facet(int record, int settled = 0)
  {
    const auto r = static_cast<std::size_t>(record);
    const Restricted_facet& f = mesh_.facets()[r];
    const Facet_id id{record, f.version};
    if (is_mixed_up(f)) mixed_up_.push_back(id);
    chooser_.set_bad_facet(r, false);
    if (f.version < settled) return;
    unseen_.push_back(id);
    const Badness_3 badness = measure_.facet(f);
    chooser_.set_bad_facet(r, badness.is_bad());
    if (badness.is_bad())
      bad_facets_.push_back({id, badness.ratio, (badness.reasons & (bad_topology | bad_disk)) == 0,
                             is_needed(badness.reasons, f.crossings > 1), false});
  }

  /// Null if it is gone.
  const Restricted_facet* facet(const Facet_id& id) const
  {
    const Restricted_facet& f = mesh_.facets()[static_cast<std::size_t>(id.record)];
    return f.cell != Cell_handle() && f.version == id.version ? &f : nullptr;
  }

  // ---- choosing

  std::size_t choose_edges()
  {
    bad_edges_.clear();
    for (const Crease_edge& e : mesh_.creases().edges()) {
      const Badness_3 badness = measure_.crease_edge(e);
      if (badness.is_bad()) bad_edges_.emplace_back(badness.ratio, &e);
    }
    std::stable_sort(bad_edges_.begin(), bad_edges_.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [ratio, e] : bad_edges_) choose(*e, true);
    return bad_edges_.size();
  }

  std::size_t choose_facets()
  {
    bad_facets_.erase(
        std::remove_if(bad_facets_.begin(), bad_facets_.end(), [this](const Bad_facet& f) { return !facet(f.id); }),
        bad_facets_.end());
    const auto is_stuck = [](const Bad_facet& f) { return f.is_stuck; };
    if (std::all_of(bad_facets_.begin(), bad_facets_.end(), is_stuck)) look_again();
    // Records are numbered in order of creation, so ties don't depend on memory.
    std::stable_sort(bad_facets_.begin(), bad_facets_.end(),
                     [](const Bad_facet& a, const Bad_facet& b) { return a.ratio > b.ratio; });
    for (Bad_facet& f : bad_facets_)
      if (!f.is_stuck) f.is_stuck = choose(*facet(f.id), f.is_free, f.is_needed) == Choice::impossible;
    return bad_facets_.size();
  }

  /// When no facet is bad by what its axis meets, or nothing can be done about it, those that are new: their centers
  /// and the middles of their sides may be far from the surface. On the bear for 0.001 that brings its distance
  /// from 2.3 bounds to 1.5 with 0.3 % more vertices (CGAL: 2.0).
  void look_again()
  {
    if constexpr (!Restricted::Oracle::labels_first) {
      for (const Facet_id& id : unseen_)
        if (const Restricted_facet* f = facet(id); f && is_far(*f))
          bad_facets_.push_back({id, Measure::just_bad, true, is_needed(bad_approximation, f->crossings > 1), false});
    }
    unseen_.clear();
  }

  bool is_far(const Restricted_facet& f) const
  {
    const double bound = deviation_tolerance * measure_.approximation(f.steiner);
    if (bound == 0) return false;
    const Point &a = Measure::vertex(f, 1)->point(), &b = Measure::vertex(f, 2)->point(),
                &c = Measure::vertex(f, 3)->point();
    const Point samples[] = {CGAL::centroid(a, b, c), CGAL::midpoint(a, b), CGAL::midpoint(b, c), CGAL::midpoint(c, a)};
    return !std::all_of(std::begin(samples), std::end(samples),
                        [&](const Point& p) { return mesh_.oracle().is_within(p, bound * bound); });
  }

  /// Topological disks, looked at when no facet is bad: the vertices whose stars changed since they were last seen.
  std::size_t choose_at_vertices()
  {
    std::size_t bad = 0;
    for (std::size_t i = 0; i < undecided_.size(); ++i) {
      if (!undecided_[i]) continue;
      const Vertex_handle v = mesh_.vertices()[i];
      if (v->location().dimension > 2 || has_topological_disk(mesh_, v)) {
        undecided_[i] = false;
        continue;
      }
      ++bad;
      const Restricted_facet* worst = worst_facet_around(v);
      if (worst)
        choose(*worst, false, false);
      else if (v->location().dimension == 2)
        choose_beside(v);
    }
    return bad;
  }

  const Restricted_facet* worst_facet_around(Vertex_handle v) const
  {
    const Restricted_facet* worst = nullptr;
    double error = -1;
    for_each_facet_at(mesh_, v, [&](const Restricted_facet& f) {
      const double e = measure_.approximation_error(f);
      if (e <= error) return;
      error = e;
      worst = &f;
    });
    return worst;
  }

  /// Multiple choice: always the worst of a few random ones.
  std::size_t choose_cells()
  {
    compact_cells();
    pool_.resize(bad_cells_.size());
    std::size_t n = 0;
    for (std::size_t i = 0; i < bad_cells_.size(); ++i)
      if (!bad_cells_[i].is_stuck) pool_[n++] = static_cast<int>(i);
    pool_.resize(n);
    container_.clear();
    std::size_t in_vain = 0;
    while (used_ < room_ && !(used_ > 0 && in_vain > in_vain_at_least + in_vain_for_each * used_)) {
      while (container_.size() < choices && !pool_.empty()) container_.push_back(take_random());
      if (container_.empty()) break;
      const auto worst =
          std::max_element(container_.begin(), container_.end(), [this](int i, int j) { return ratio(i) < ratio(j); });
      Bad_cell& b = bad_cells_[static_cast<std::size_t>(*worst)];
      *worst = container_.back();
      container_.pop_back();
      if (is_near_claimed(b.cell)) continue;
      const Choice choice = choose(b.cell);
      b.is_stuck = choice == Choice::impossible;
      in_vain += choice == Choice::later;
    }
    return bad_cells_.size();
  }

  double ratio(int i) const { return bad_cells_[static_cast<std::size_t>(i)].ratio; }

  int take_random()
  {
    const std::size_t i = random_() % pool_.size();
    const int taken = pool_[i];
    pool_[i] = pool_.back();
    pool_.pop_back();
    return taken;
  }

  /// A cell whose zone surely or very likely touches a claimed one; looking for the zone would tell no more.
  bool is_near_claimed(Cell_handle c) const
  {
    if (c->batch() == batch_) return true;
    for (int i = 0; i < 4; ++i)
      if (c->neighbor(i)->batch() == batch_) return true;
    return false;
  }

  void compact_cells()
  {
    std::size_t n = 0;
    for (const Bad_cell& b : bad_cells_) {
      if (b.cell == Cell_handle()) continue;
      b.cell->set_bad_index(static_cast<int>(n));
      bad_cells_[n++] = b;
    }
    bad_cells_.resize(n);
  }

  // ---- acute angles of the input

  /// Whether an element has to be refined whatever the angles beside it. Distances don't count where the Steiner point
  /// may belong to another part of the surface.
  static bool is_needed(unsigned reasons, bool is_mixed_up)
  {
    return (reasons & bad_size) != 0 || ((reasons & bad_approximation) != 0 && !is_mixed_up);
  }

  /// Whether to leave an element as it is if that isn't needed: a small one beside an acute edge. See Acute_edges_3.h.
  bool is_left(const Point& center, double squared_radius)
  {
    const double least = acute_floor_ * measure_.size(center);
    const bool left =
        squared_radius < least * least && mesh_.oracle().is_at_acute_edge(center, std::sqrt(squared_radius));
    left_ += left;
    return left;
  }

  /// Smaller elements mend what is left at angles that aren't very acute, and only multiply it at others. To be called
  /// when nothing else can be done; returns whether it is worth going on: while little is left, or much less than
  /// before, and less than ever within a few steps. The same few can be left at any scale: facets at a corner with an
  /// angle below that of the facet shape.
  bool lower_acute_floor()
  {
    if (!with_cells_) return false; // the surface will be refined once more
    const auto most =
        (std::max)(static_cast<std::size_t>(0.7 * static_cast<double>(left_before_)), mesh_.vertices().size() / 50);
    if (left_ < least_left_) {
      least_left_ = left_;
      steps_left_ = most_steps;
    }
    if (left_ == 0 || left_ > most || acute_floor_ < least_acute_floor || steps_left_-- == 0) return false;
    left_before_ = left_;
    acute_floor_ /= 2;
    return true;
  }

  /// Whether a facet belongs to one side of an acute edge and has a vertex on the other, and which one.
  int vertex_across(const Restricted_facet& f, Surface_hit& image) const
  {
    const double radius = std::sqrt(f.squared_radius);
    for (int i = 1; i <= 3; ++i) {
      const Vertex_handle v = Measure::vertex(f, i);
      if (v->location().dimension == 2 && mesh_.oracle().mirror_at_acute_edge(v->point(), f.steiner, radius, image) &&
          CGAL::to_double(CGAL::squared_distance(image.point, f.steiner)) < 0.99 * f.squared_radius)
        return i;
    }
    return 0;
  }

  bool is_mixed_up(const Restricted_facet& f) const
  {
    Surface_hit image;
    return vertex_across(f, image) != 0;
  }

  /// Beside acute edges, vertices come in mirrored pairs as far as they have to: then every point of a side has the
  /// nearest vertex on its own side, however near the other is, and facets don't mix them up.
  void choose_mirror_images()
  {
    std::size_t n = 0;
    for (const Facet_id& id : mixed_up_)
      if (const Restricted_facet* f = facet(id); f && choose_mirror_image(*f) != Choice::impossible)
        mixed_up_[n++] = id;
    mixed_up_.resize(n);
  }

  Choice choose_mirror_image(const Restricted_facet& f)
  {
    Surface_hit image;
    const int across = vertex_across(f, image);
    if (across == 0) return Choice::impossible;
    const Zone_result result = find_near(image.point, f);
    if (result != Zone_result::found) return failure(result);
    const double apart = CGAL::to_double(CGAL::squared_distance(Measure::vertex(f, across)->point(), image.point));
    // Pairs that all but exist: of 0.05 to 0.25, 0.15 leaves the fewest bad elements beside knife edges.
    if (chooser_.nearest_in(chosen_[used_].zone) <
        (std::max)(topology_floor * topology_floor * squared_floor_, 0.15 * 0.15 * apart))
      return Choice::impossible;
    if (const Crease_edge* e = chooser_.encroached_edge(chosen_[used_].zone)) {
      ++encroachments_;
      return choose(*e, false);
    }
    return accept({2, image.patch});
  }

  // ---- one Steiner point

  Choice choose(const Crease_edge& e, bool needed)
  {
    if (!needed && is_left(e.steiner, e.squared_radius)) return Choice::later;
    const Point p = crease_steiner_point(mesh_, e);
    if (nearest_end(e, p) < squared_floor_) return Choice::impossible;
    const Zone_result result = find(p, mesh_.triangulation().locate(p, e.source->cell()), scratch());
    return result == Zone_result::found ? accept({1, e.steiner_crease}) : failure(result);
  }

  static double nearest_end(const Crease_edge& e, const Point& p)
  {
    return CGAL::to_double(
        (std::min)(CGAL::squared_distance(p, e.source->point()), CGAL::squared_distance(p, e.target->point())));
  }

  /// \param free whether the point may be moved; the topology of a mesh is mended only by the Steiner point itself.
  Choice choose(const Restricted_facet& f, bool free, bool needed)
  {
    if (!needed && is_left(f.steiner, f.squared_radius)) return Choice::later;
    if (f.squared_radius < (free ? 1 : topology_floor * topology_floor) * squared_floor_) return Choice::impossible;
    const Zone_result result = free ? find_best(f) : find_near(own_steiner_point(f), f);
    if (result != Zone_result::found) return failure(result);
    if (const Crease_edge* e = chooser_.encroached_edge(chosen_[used_].zone)) {
      ++encroachments_;
      return choose(*e, needed);
    }
    return accept({2, f.patch});
  }

  /// The best Steiner point of a facet, or where the surface bends near its own, a point there. A tip that the facet
  /// misses by more than the bound comes first. Reaches of 0.4 and 0.5 radii: of 0.3 to 0.7 for both, these give the
  /// fewest vertices on average.
  Zone_result find_best(const Restricted_facet& f)
  {
    if (f.cell->batch() == batch_) return Zone_result::claimed; // looking for the point would tell no more
    Point p = f.steiner;
    const auto missed = measure_.worst_missed_point(f);
    const double radius = std::sqrt(f.squared_radius);
    if (missed.ratio > 1) {
      if (missed.is_vertex) p = missed.point;
    }
    // Between the sides of an acute edge it isn't the best point that ends refinement but the mirror image.
    else if (!mesh_.oracle().attract(p, 0.4 * radius, 0.5 * radius, f.patch) &&
             !mesh_.oracle().is_at_acute_edge(f.steiner, radius)) {
      ++candidates_;
      return chooser_.choose(f, batch_, scratch());
    }
    const Zone_result result = find_near(p, f);
    return result == Zone_result::no_conflict && p != f.steiner ? find_near(f.steiner, f) : result;
  }

  /// The Steiner point that mends the topology.
  Point own_steiner_point(const Restricted_facet& f)
  {
    Point p = f.squared_radius < squared_floor_ ? shaken_steiner_point(f) : f.steiner;
    // A vertex right beside an acute edge and its mirror image leave no room for facets of good shape between them.
    mesh_.oracle().attract_to_acute_edge(p, std::sqrt(f.squared_radius));
    return p;
  }

  /// Below the size floor, where the same failure repeats itself at ever smaller scales: somewhere near.
  Point shaken_steiner_point(const Restricted_facet& f)
  {
    return shaken(f.steiner, std::sqrt(f.squared_radius), f.patch);
  }

  /// A random point of a patch near one of its points: up to 0.4 radii away in each coordinate, before it is projected.
  Point shaken(const Point& p, double radius, int patch)
  {
    const double step = 0.4 * radius;
    const auto random = [&] { return step * (2 * (random_() / 4294967295.0) - 1); };
    const double x = random(), y = random(), z = random(); // in this order, whatever the compiler
    const Surface_hit hit = mesh_.oracle().project_on_patch(p + typename Kernel::Vector_3(x, y, z), patch);
    return hit.patch == patch ? hit.point : p;
  }

  /// For a vertex on a patch without any restricted facet: the surface enters and leaves its Voronoi cell through
  /// facets alone. A second vertex of the patch near by gives the cell edges there.
  Choice choose_beside(Vertex_handle v)
  {
    cells_.clear();
    mesh_.triangulation().incident_cells(v, std::back_inserter(cells_));
    double nearest = HUGE_VAL;
    for (const Cell_handle c : cells_)
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i) != v)
          nearest = (std::min)(nearest, CGAL::to_double(CGAL::squared_distance(c->vertex(i)->point(), v->point())));
    Point p = v->point();
    for (int k = 0; k < 20 && CGAL::to_double(CGAL::squared_distance(p, v->point())) < 0.01 * nearest; ++k)
      p = shaken(v->point(), std::sqrt(nearest), v->location().index); // from outside of a tip, back to the tip
    if (CGAL::to_double(CGAL::squared_distance(p, v->point())) < squared_floor_) return Choice::impossible;
    const Zone_result result = find(p, mesh_.triangulation().locate(p, v->cell()), scratch());
    if (result != Zone_result::found) return failure(result);
    if (const Crease_edge* e = chooser_.encroached_edge(chosen_[used_].zone)) {
      ++encroachments_;
      return choose(*e, false);
    }
    return accept(v->location());
  }

  Zone_result find_near(const Point& p, const Restricted_facet& f)
  {
    ++candidates_;
    return chooser_.find(p, f, batch_, scratch());
  }

  Choice choose(Cell_handle c)
  {
    const Point& p = c->circumcenter();
    if (CGAL::to_double(CGAL::squared_distance(p, c->vertex(0)->point())) < squared_floor_) return Choice::impossible;
    const bool needed = is_needed(measure_.cell(c).reasons, false);
    if (!needed && is_left(p, CGAL::to_double(CGAL::squared_distance(p, c->vertex(0)->point())))) return Choice::later;
    Zone& zone = scratch();
    ++candidates_;
    Zone_result result = chooser_.choose(c, batch_, zone);
    if (result == Zone_result::found) return accept({3, c->subdomain()});
    if (result == Zone_result::no_conflict) result = find(p, c, zone);
    if (result != Zone_result::found) return failure(result);
    if (const Crease_edge* e = chooser_.encroached_edge(zone)) {
      ++encroachments_;
      return choose(*e, needed);
    }
    if (const Restricted_facet* f = chooser_.encroached_facet(zone)) {
      ++encroachments_;
      return choose(*f, true, needed);
    }
    return accept({3, c->subdomain()});
  }

  Zone& scratch()
  {
    if (chosen_.size() == used_) chosen_.emplace_back();
    return chosen_[used_].zone;
  }

  Zone_result find(const Point& p, Cell_handle start, Zone& zone)
  {
    ++candidates_;
    return find_conflict_zone(mesh_.triangulation(), p, start, batch_, zone);
  }

  Choice accept(const Vertex_location_3& location)
  {
    if (used_ >= room_) return Choice::later;
    claim(chosen_[used_].zone, batch_);
    chosen_[used_++].location = location;
    return Choice::chosen;
  }

  static Choice failure(Zone_result result)
  {
    return result == Zone_result::claimed ? Choice::later : Choice::impossible;
  }

  // ---- inserting

  /// Inserts along a space-filling curve: cells made one after the other stand side by side in memory.
  void insert_chosen()
  {
    std::vector<Point> points;
    for (std::size_t k = 0; k < used_; ++k) points.push_back(chosen_[k].zone.point);
    for (const std::size_t k : order_along_curve_3<Kernel>(points)) {
      const Chosen& chosen = chosen_[k];
      for (const Cell_handle c : chosen.zone.cells) {
        if (c->bad_index() >= 0) bad_cells_[static_cast<std::size_t>(c->bad_index())].cell = Cell_handle();
        for (int i = 0; i < 4; ++i)
          if (const Restricted_facet* f = mesh_.facet(c, i)) set_undecided(*f);
      }
      mesh_.insert(chosen.zone, chosen.location);
    }
    mesh_.update();
    undecided_.resize(mesh_.vertices().size(), true);
    for (const Cell_handle c : mesh_.new_cells()) add_cell(c);
    for (const int record : mesh_.new_facets()) {
      set_undecided(mesh_.facets()[static_cast<std::size_t>(record)]);
      add_facet(record);
    }
  }

  /// Whether a vertex has a topological disk hangs on the facets at it alone.
  void set_undecided(const Restricted_facet& f)
  {
    for (int i = 1; i <= 3; ++i)
      if (const int id = Measure::vertex(f, i)->id(); id >= 0) undecided_[static_cast<std::size_t>(id)] = true;
  }

  /// Part of the size floor down to which the topology is mended. At a sharp edge that nobody marked, whether the disks
  /// come out right is luck at every scale, so it takes a few more halvings than distances do.
  static constexpr double topology_floor = 0.1;

  /// Facets may be farther from the surface than the approximation bound, which is about Steiner points: with 2 / 1.8 /
  /// 1.6 / 1.4 the bear's distance is 1.8, 1.7, 1.5, 1.5 bounds, 0.1 to 1 % more vertices for each step.
  static constexpr double deviation_tolerance = 1.6;

  static constexpr double least_acute_floor = 1e-4;
  static constexpr int most_steps = 3;

  /// Cells tried in vain that end a batch, beside those for each of its vertices. In a wedge of one degree a batch
  /// would try 8000 to insert four, and refinement take 25 s instead of 7; elsewhere it is mostly far fewer (armadillo:
  /// 16 for each).
  static constexpr std::size_t in_vain_at_least = 200, in_vain_for_each = 100;

  static constexpr std::size_t choices = 20; // Tournois 2009, sec. 3.2.1.4

  Restricted& mesh_;
  bool with_cells_;
  Measure measure_;
  double squared_floor_;
  Steiner_chooser_3<Restricted> chooser_;
  std::mt19937 random_;
  std::vector<Bad_cell> bad_cells_;
  std::vector<Bad_facet> bad_facets_;
  std::vector<Facet_id> mixed_up_; ///< facets that have a vertex across an acute edge
  std::vector<Facet_id> unseen_;   ///< facets that `look_again()` has yet to see
  std::vector<std::pair<double, const Crease_edge*>> bad_edges_;
  std::vector<char> undecided_; ///< by vertex, whether its topological disk has to be looked at
  std::vector<int> pool_, container_;
  std::vector<Cell_handle> cells_;
  std::vector<Chosen> chosen_;
  std::size_t used_ = 0, room_ = 0;
  double acute_floor_ = 0.125; ///< part of the size down to which elements beside acute edges are refined
  std::size_t least_left_ = std::size_t(1) << 40;  ///< smallest value of the following before a lowering
  int steps_left_ = most_steps;                    ///< lowerings until that has to get smaller
  std::size_t left_ = 0;                           ///< elements that the batch has left because of it
  std::size_t left_before_ = std::size_t(1) << 40; ///< the same before it was lowered last
  int batch_ = 0;
  std::size_t candidates_ = 0, encroachments_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_BATCH_REFINER_3_H
