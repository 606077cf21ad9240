// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sliver removal by perturbing vertices (Tournois 2009, sec. 3.2.2, Alg. 7; Tournois, Srinivasan, Alliez, "Perturbing
// slivers in 3D Delaunay meshes", 2009): a vertex of a sliver moves along the gradient of the squared circumradius, or
// down that of the volume, or somewhere at random, so that the Delaunay triangulation flips the sliver away. A move is
// kept if the smallest dihedral angle of all cells made is larger than that of all cells unmade, the boundary stays a
// surface and no criterion is violated that held: the smallest dihedral angle of the mesh never falls.
//
// Other than in Alg. 7, the vertex is taken away once, and moves are judged by the conflict zones of the places it
// might go to, before anything is inserted; and vertices that can't be helped don't end a pass.

#ifndef WEFT_SPATIAL_PERTURB_SLIVERS_3_H
#define WEFT_SPATIAL_PERTURB_SLIVERS_3_H

#include <weft/errors.h>
#include <weft/internal/timer.h>
#include <weft/spatial/Criteria_3.h>
#include <weft/spatial/dihedral_angles_3.h>
#include <weft/spatial/measure_badness_3.h>
#include <weft/spatial/Restricted_delaunay_3.h>
#include <weft/spatial/topological_disk_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace weft {

/// Options of `perturb_slivers_3()`.
struct Perturb_options_3
{
  double target = 20;         ///< smallest dihedral angle to reach, in degrees; 90: as far as it goes
  double first_bound = 4;     ///< bound of the first passes, in degrees
  double step = 2;            ///< by which the bound is raised
  int most_passes = 8;        ///< over the vertices of cells below a bound
  int random_trials = 24;     ///< random places for a vertex
  double insertions = 0.04;   ///< most vertices to insert where no move helps, in parts of those there are
  double random_reach = 0.35; ///< how far from it, in parts of its shortest edge
  double time_limit = std::numeric_limits<double>::infinity(); ///< seconds of wall time
  unsigned seed = 0;
  std::function<bool(double)> go_on; ///< called with the smallest dihedral angle between passes; false ends the run

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(target >= 0 && target <= 90, "target must lie in [0, 90] degrees");
    require(first_bound > 0 && step > 0, "bounds must be positive");
    require(most_passes > 0 && random_trials >= 0, "numbers of passes and trials must not be negative");
    require(insertions >= 0 && insertions <= 1, "insertions must lie in [0, 1]");
    require(random_reach > 0 && random_reach < 1, "random_reach must lie in (0, 1)");
    require(time_limit >= 0, "time_limit must not be negative");
  }
};

/// What `perturb_slivers_3()` did.
struct Perturb_report_3
{
  double before = 0, after = 0; ///< smallest dihedral angles, in degrees
  std::size_t passes = 0, tried_vertices = 0, trials = 0;
  std::size_t by_radius = 0, by_volume = 0, by_chance = 0; ///< moves that were kept, by direction
  std::size_t insertions = 0;                              ///< of vertices inside, where no move helped
  std::size_t refused = 0; ///< moves that were undone: the boundary or a criterion would have suffered
  double seconds = 0;
};

/// The perturber; `perturb_slivers_3()` runs it.
template <class Restricted>
class Sliver_perturber_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Vector = typename Kernel::Vector_3;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Zone = typename Restricted::Zone;

  Sliver_perturber_3(Restricted& mesh, const Criteria_3<Kernel>& criteria, const Perturb_options_3& options)
      : mesh_(mesh),
        measure_(mesh, criteria, 1),
        options_(options),
        random_(options.seed),
        random_trials_(options.random_trials),
        most_insertions_(static_cast<std::size_t>(options.insertions * static_cast<double>(mesh.vertices().size())))
  {}

  Perturb_report_3 run()
  {
    report_.before = report_.after = degrees(worst_cosine());
    for (double bound = options_.first_bound; goes_on(); bound += options_.step) {
      bound_ = std::cos((std::min)(bound, options_.target) * degree);
      for (int pass = 0; pass < options_.most_passes && goes_on(); ++pass)
        if (run_pass() == 0 && insert_vertices() == 0) break;
      report_.after = degrees(worst_cosine());
      if (bound >= options_.target) break;
    }
    insist();
    report_.seconds = timer_.seconds();
    return report_;
  }

private:
  static constexpr double degree = 3.14159265358979323846 / 180;

  /// A vertex of slivers: interior ones first, then those with fewer slivers, then the smaller angle, then the elder.
  struct Candidate
  {
    int id;
    bool on_boundary = false;
    int slivers = 0;
    double cosine = -1;

    bool operator<(const Candidate& other) const
    {
      if (on_boundary != other.on_boundary) return other.on_boundary;
      if (slivers != other.slivers) return slivers < other.slivers;
      if (cosine != other.cosine) return cosine > other.cosine;
      return id < other.id;
    }
  };

  struct Move
  {
    Point point;
    double cosine = 2; ///< of the smallest dihedral angle that it makes
    std::size_t Perturb_report_3::*kind = nullptr;
    Vertex_location_3 location{}; ///< of a new vertex
  };

  static double degrees(double cosine) { return std::acos((std::max)(-1.0, (std::min)(1.0, cosine))) / degree; }

  bool goes_on()
  {
    return timer_.seconds() < options_.time_limit && (!options_.go_on || options_.go_on(report_.after));
  }

  static double cosine(Cell_handle c)
  {
    return cosine_of_smallest_dihedral(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(),
                                       c->vertex(3)->point());
  }

  std::size_t count_slivers() const
  {
    std::size_t count = 0;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles())
      count += c->subdomain() != 0 && cosine(c) > bound_;
    return count;
  }

  double worst_cosine() const
  {
    double worst = -1;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles())
      if (c->subdomain() != 0) worst = (std::max)(worst, cosine(c));
    return worst;
  }

  // ---- passes

  /// The few cells that are left get ever more random places, vertices inserted near them and their neighbours moved,
  /// until `patience` rounds in a row bring nothing to speak of: moves that better some star a little are always to be
  /// found.
  void insist()
  {
    const int trials = random_trials_;
    std::size_t fewest = count_slivers();
    for (int idle = 0, round = 0; idle < patience && round < most_rounds && fewest > 0 && goes_on(); ++round) {
      random_trials_ = (std::min)(2 * random_trials_, 500);
      const double before = report_.after;
      run_pass();
      insert_vertices();
      perturb_neighbours();
      report_.after = degrees(worst_cosine());
      const std::size_t slivers = count_slivers();
      ++idle;
      if (slivers == 0 || report_.after > before + 0.1 || slivers + fewest / 50 < fewest) idle = 0;
      fewest = (std::min)(fewest, slivers);
    }
    random_trials_ = trials;
  }

  std::size_t run_pass()
  {
    ++report_.passes;
    std::vector<Candidate> candidates = list_candidates();
    std::sort(candidates.begin(), candidates.end());
    std::size_t moved = 0;
    for (const Candidate& candidate : candidates) {
      if (timer_.seconds() >= options_.time_limit) break;
      moved += perturb(candidate.id);
    }
    return moved;
  }

  std::vector<Candidate> list_candidates() const
  {
    std::vector<Candidate> all(mesh_.vertices().size());
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0) continue;
      const double x = cosine(c);
      if (x <= bound_) continue;
      for (int i = 0; i < 4; ++i) {
        const Vertex_handle v = c->vertex(i);
        if (v->location().dimension < 2) continue; // feature vertices and those on creases stay
        Candidate& candidate = all[static_cast<std::size_t>(v->id())];
        candidate.id = v->id();
        candidate.on_boundary = v->location().dimension == 2;
        candidate.cosine = (std::max)(candidate.cosine, x);
        ++candidate.slivers;
      }
    }
    all.erase(std::remove_if(all.begin(), all.end(), [](const Candidate& c) { return c.slivers == 0; }), all.end());
    return all;
  }

  // ---- cells that no vertex can leave

  /// Inserts a vertex inside near each cell below the bound, where that helps; how many.
  std::size_t insert_vertices()
  {
    std::vector<std::pair<double, std::array<int, 4>>> slivers; // by the ids of their vertices, since cells go
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0 || cosine(c) <= bound_) continue;
      slivers.push_back({-cosine(c), {}});
      for (int i = 0; i < 4; ++i) slivers.back().second[static_cast<std::size_t>(i)] = c->vertex(i)->id();
      std::sort(slivers.back().second.begin(), slivers.back().second.end());
    }
    std::sort(slivers.begin(), slivers.end()); // the worst first, then by ids
    std::size_t inserted = 0;
    for (const auto& sliver : slivers) {
      if (report_.insertions >= most_insertions_ || timer_.seconds() >= options_.time_limit) break;
      Vertex_handle v[4];
      for (std::size_t i = 0; i < 4; ++i) v[i] = mesh_.vertices()[static_cast<std::size_t>(sliver.second[i])];
      Cell_handle c;
      int i, j, k, l;
      if (mesh_.triangulation().is_cell(v[0], v[1], v[2], v[3], c, i, j, k, l)) inserted += insert_near(c);
    }
    return inserted;
  }

  bool insert_near(Cell_handle c)
  {
    const Point center =
        CGAL::centroid(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(), c->vertex(3)->point());
    double shortest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i)
      for (int j = i + 1; j < 4; ++j)
        shortest =
            (std::min)(shortest, CGAL::to_double(CGAL::squared_distance(c->vertex(i)->point(), c->vertex(j)->point())));
    filling_.clear();
    filling_cosines_.clear();
    star_cosine_ = cosine(c);
    const int subdomain = c->subdomain();
    const double reach = std::sqrt(shortest);
    int patch = -1;
    for (int i = 0; i < 4; ++i)
      if (c->vertex(i)->location().dimension == 2) patch = c->vertex(i)->location().index;
    std::vector<Move> moves;
    for (int trial = 0; trial < insertion_trials; ++trial) {
      const auto random = [this] { return 2 * (random_() / 4294967295.0) - 1; };
      const double x = random(), y = random(), z = random();
      Move move{center + reach * Vector(x, y, z)};
      Vertex_location_3 at{3, subdomain};
      if (patch >= 0 && trial % 2 == 1) { // every other one on the boundary
        at = {2, patch};
        move.point = mesh_.oracle().project_on_patch(move.point, patch).point;
      }
      ++report_.trials;
      if (at.dimension == 3 && mesh_.oracle().subdomain(move.point) != subdomain) continue;
      if (!find_zone(move.point, c)) continue;
      move.cosine = judge();
      move.location = at;
      if (move.cosine < 2) moves.push_back(move);
    }
    std::stable_sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) { return a.cosine < b.cosine; });
    if (moves.size() > most_tries) moves.resize(most_tries);
    Cell_handle near = c; // c itself dies with an insertion
    for (const Move& move : moves) {
      if (!find_zone(move.point, near)) continue;
      near = mesh_.insert(zone_, move.location)->cell();
      mesh_.update();
      if (is_acceptable()) {
        ++report_.insertions;
        return true;
      }
      ++report_.refused;
      mesh_.remove_last();
      near = mesh_.new_cells().front();
    }
    return false;
  }

  /// Vertices of the cells around slivers whose own vertices can't help (Tournois 2009, sec. 3.2.2.4).
  std::size_t perturb_neighbours()
  {
    std::vector<int> around;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0 || cosine(c) <= bound_) continue;
      for (int i = 0; i < 4; ++i) {
        cells_.clear();
        mesh_.triangulation().incident_cells(c->vertex(i), std::back_inserter(cells_));
        for (const Cell_handle n : cells_)
          for (int k = 0; k < 4; ++k)
            if (n->vertex(k)->location().dimension >= 2) around.push_back(n->vertex(k)->id());
      }
      if (around.size() > most_around) break;
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    std::size_t moved = 0;
    for (const int id : around) {
      if (timer_.seconds() >= options_.time_limit) break;
      moved += perturb(id, true);
    }
    return moved;
  }

  // ---- one vertex

  /// Tries to move a vertex away from its slivers; whether it was moved.
  /// \param also_without whether it is to be moved, too, if none of them is its own.
  bool perturb(int id, bool also_without = false)
  {
    const Vertex_handle v = mesh_.vertices()[static_cast<std::size_t>(id)];
    origin_ = v->point();
    location_ = v->location();
    load_star(v);
    if (!also_without && star_cosine_ <= bound_) return false; // mended meanwhile
    ++report_.tried_vertices;
    filling_ = mesh_.take_away(v);
    load_filling();
    std::vector<Move> moves = find_moves();
    for (const Move& move : moves) {
      if (!put(move.point, id)) continue;
      if (is_acceptable()) {
        ++(report_.*move.kind);
        return true;
      }
      ++report_.refused;
      filling_ = mesh_.take_away_again(mesh_.vertices()[static_cast<std::size_t>(id)]);
      load_filling();
    }
    put(origin_, id);
    return false;
  }

  /// What the star of a vertex is like: its worst angle, the directions that its slivers suggest, what holds on it.
  void load_star(Vertex_handle v)
  {
    const auto& tr = mesh_.triangulation();
    cells_.clear();
    tr.incident_cells(v, std::back_inserter(cells_));
    star_cosine_ = -1;
    by_radius_ = by_volume_ = Vector(0, 0, 0);
    double shortest = std::numeric_limits<double>::infinity();
    for (const Cell_handle c : cells_) {
      if (c->subdomain() == 0) continue;
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i) != v)
          shortest = (std::min)(shortest, CGAL::to_double(CGAL::squared_distance(v->point(), c->vertex(i)->point())));
      const double x = cosine(c);
      star_cosine_ = (std::max)(star_cosine_, x);
      if (x > bound_) add_gradients(c, c->index(v));
    }
    shortest_ = std::sqrt(shortest);
  }

  /// With n the normal of the facet a, b, c opposite to v and o the circumcenter: the circumcenter can only move along
  /// n, which gives the gradient of R^2 as 2 ((o - a) n / (a - v) n) (o - v); the gradient of V is n / 6, n as the
  /// cross product of two edges, towards v.
  void add_gradients(Cell_handle c, int i)
  {
    const Point &v = c->vertex(i)->point(), &a = c->vertex((i + 1) % 4)->point(), &b = c->vertex((i + 2) % 4)->point(),
                &d = c->vertex((i + 3) % 4)->point();
    Vector n = CGAL::cross_product(b - a, d - a);
    if (n * (v - a) < 0) n = -n;
    const Vector ov = c->circumcenter() - v;
    const double below = CGAL::to_double((a - v) * n);
    if (below != 0) by_radius_ = by_radius_ + (2 * ((c->circumcenter() - a) * n) / below) * ov;
    by_volume_ = by_volume_ - n;
  }

  /// Where the vertex might go, the best first: as in Alg. 7 the gradients have their turn before chance.
  std::vector<Move> find_moves()
  {
    std::vector<Move> moves;
    for (const double step : {0.05, 0.1, 0.2, 0.3}) {
      try_move(by_radius_, step, &Perturb_report_3::by_radius, moves);
      try_move(by_volume_, step, &Perturb_report_3::by_volume, moves);
    }
    const auto is_good = [this](const Move& m) { return m.cosine <= bound_; };
    if (std::none_of(moves.begin(), moves.end(), is_good))
      for (int k = 0; k < random_trials_; ++k) {
        const auto random = [this] { return 2 * (random_() / 4294967295.0) - 1; };
        const double x = random(), y = random(), z = random(); // in this order, whatever the compiler
        try_move(Vector(x, y, z), options_.random_reach * random_() / 4294967295.0, &Perturb_report_3::by_chance,
                 moves);
        if (!moves.empty() && is_good(moves.back())) break;
      }
    std::stable_sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) { return a.cosine < b.cosine; });
    if (moves.size() > most_tries) moves.resize(most_tries);
    return moves;
  }

  void try_move(const Vector& direction, double step, std::size_t Perturb_report_3::*kind, std::vector<Move>& moves)
  {
    const double length = std::sqrt(CGAL::to_double(direction.squared_length()));
    if (!(length > 0) || !std::isfinite(length)) return;
    Move move;
    move.kind = kind;
    move.point = origin_ + (step * shortest_ / length) * direction;
    if (location_.dimension == 2) move.point = mesh_.oracle().project_on_patch(move.point, location_.index).point;
    ++report_.trials;
    if (!find_zone(move.point)) return;
    move.cosine = judge();
    if (move.cosine < 2) moves.push_back(move);
  }

  bool find_zone(const Point& p) { return find_zone(p, filling_.front()); }

  bool find_zone(const Point& p, Cell_handle near)
  {
    const auto& tr = mesh_.triangulation();
    const Cell_handle start = tr.locate(p, near);
    return find_conflict_zone(tr, p, start, no_batch, zone_) == Zone_result::found;
  }

  /// The worst angle of the cells that a vertex at the point of `zone_` would make, filling that stays included; 2 if
  /// it isn't better than that of all the cells that would be unmade.
  double judge()
  {
    double limit = star_cosine_;
    ++stamp_;
    for (const Cell_handle c : zone_.cells) {
      if (c->is_classified() && c->subdomain() != 0) limit = (std::max)(limit, cosine(c));
      c->set_id(-stamp_);
    }
    double worst = -1;
    for (std::size_t k = 0; k < filling_.size(); ++k) {
      if (filling_[k]->id() == -stamp_ || filling_cosines_[k] <= worst) continue;
      if (!is_inside(filling_[k]->circumcenter())) continue;
      worst = filling_cosines_[k];
      if (worst >= limit) return 2;
    }
    for (const auto& [c, i] : zone_.hull) {
      std::array<Point, 4> p;
      for (int k = 0; k < 4; ++k) p[k] = c->vertex(k)->point();
      bool at_box = false;
      for (int k = 0; k < 4; ++k) at_box |= k != i && c->vertex(k)->location().dimension < 0;
      if (at_box) continue;
      p[i] = zone_.point;
      std::swap(p[(i + 1) % 4], p[(i + 2) % 4]); // the new vertex is on the other side
      const double x = cosine_of_smallest_dihedral(p[0], p[1], p[2], p[3]);
      if (x <= worst || !is_inside(circumcenter_3<Kernel>(p[0], p[1], p[2], p[3]))) continue;
      worst = x;
      if (worst >= limit) return 2;
    }
    return worst;
  }

  bool is_inside(const Point& p) const { return mesh_.oracle().subdomain(p) != 0; }

  void load_filling()
  {
    filling_cosines_.clear();
    for (const Cell_handle c : filling_) {
      if (Restricted::is_at_box(c)) {
        filling_cosines_.push_back(-1);
        continue;
      }
      c->set_circumcenter(circumcenter_3<Kernel>(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(),
                                                 c->vertex(3)->point()));
      filling_cosines_.push_back(cosine(c));
    }
  }

  bool put(const Point& p, int id)
  {
    if (!find_zone(p)) return false;
    mesh_.put_back(zone_, location_, id, filling_);
    return true;
  }

  /// Whether the boundary is still a surface around what changed, and every element made satisfies the criteria.
  bool is_acceptable()
  {
    for (const int record : mesh_.new_facets()) {
      const Badness_3 badness = measure_.facet(mesh_.facets()[static_cast<std::size_t>(record)]);
      if (badness.is_bad()) return false;
    }
    for (const Cell_handle c : mesh_.new_cells())
      if (c->subdomain() != 0 && measure_.cell(c).is_bad()) return false;
    seen_.clear();
    for (const Cell_handle c : mesh_.new_cells())
      for (int i = 0; i < 4; ++i) {
        const Vertex_handle v = c->vertex(i);
        if (v->location().dimension < 0 || v->location().dimension > 2) continue;
        seen_.push_back(v->id());
      }
    std::sort(seen_.begin(), seen_.end());
    seen_.erase(std::unique(seen_.begin(), seen_.end()), seen_.end());
    for (const int v : seen_)
      if (!has_topological_disk(mesh_, mesh_.vertices()[static_cast<std::size_t>(v)])) return false;
    const auto is_seen = [this](Vertex_handle v) { return std::binary_search(seen_.begin(), seen_.end(), v->id()); };
    for (const auto& e : mesh_.creases().edges())
      if ((is_seen(e.source) || is_seen(e.target)) && measure_.crease_edge(e).is_bad()) return false;
    return true;
  }

  static constexpr int no_batch = -2;
  static constexpr std::size_t most_tries = 3; ///< of the best places, how many are tried for good
  static constexpr int insertion_trials = 200;
  static constexpr int patience = 16, most_rounds = 80;
  static constexpr std::size_t most_around = 20000; ///< vertices around slivers, counted as often as met

  Restricted& mesh_;
  Badness_measure_3<Restricted> measure_;
  const Perturb_options_3& options_;
  std::mt19937 random_;
  int random_trials_;
  std::size_t most_insertions_;
  internal::Timer timer_;
  Perturb_report_3 report_;
  double bound_ = 1; ///< cosine of the angle below which a cell is a sliver

  Point origin_;
  Vertex_location_3 location_;
  double star_cosine_ = -1, shortest_ = 0;
  Vector by_radius_, by_volume_;
  std::vector<Cell_handle> cells_, filling_;
  std::vector<double> filling_cosines_;
  std::vector<int> seen_;
  Zone zone_;
  int stamp_ = 1;
};

/// Raises the smallest dihedral angle of a mesh as far as `options.target` by moving vertices inside and on patches.
///
/// The triangulation stays Delaunay, vertices stay on their patches, the boundary stays a surface, and elements that
/// satisfied `criteria` are replaced by elements that do. The smallest dihedral angle never falls.
/// \tparam Restricted a Restricted_delaunay_3.
/// \throws Option_error for options or criteria out of range.
template <class Restricted>
Perturb_report_3 perturb_slivers_3(Restricted& mesh, const Criteria_3<typename Restricted::Kernel>& criteria,
                                   const Perturb_options_3& options = Perturb_options_3())
{
  criteria.check();
  options.check();
  return Sliver_perturber_3<Restricted>(mesh, criteria, options).run();
}

} // namespace weft

#endif // WEFT_SPATIAL_PERTURB_SLIVERS_3_H
