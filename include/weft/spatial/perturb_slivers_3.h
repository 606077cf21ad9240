// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sliver removal by perturbing vertices (Tournois 2009, sec. 3.2.2, Alg. 7; Tournois, Srinivasan, Alliez, "Perturbing
// slivers in 3D Delaunay meshes", 2009): a vertex of a sliver moves along the gradient of the squared circumradius, or
// down that of the volume, or somewhere at random, so that the Delaunay triangulation flips the sliver away. A move is
// kept if the worst of all cells made is better than the worst of all cells unmade, the boundary stays a surface and no
// criterion is violated that held: the smallest dihedral angle of the mesh never falls.
//
// Bounds rise over the whole mesh first, which is fast, then the worst few cells are worked on with all means again and
// again: what the smallest angle of a mesh hangs on is a handful of cells.

#ifndef WEFT_SPATIAL_PERTURB_SLIVERS_3_H
#define WEFT_SPATIAL_PERTURB_SLIVERS_3_H

#include <weft/internal/timer.h>
#include <weft/spatial/Criteria_3.h>
#include <weft/spatial/dihedral_angles_3.h>
#include <weft/spatial/Perturb_options_3.h>
#include <weft/spatial/Vertex_perturber_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace weft {

/// The perturber; `perturb_slivers_3()` runs it.
template <class Restricted>
class Sliver_perturber_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;

  Sliver_perturber_3(Restricted& mesh, const Criteria_3<Kernel>& criteria, const Perturb_options_3& options)
      : mesh_(mesh),
        options_(options),
        perturber_(mesh, criteria, options, report_),
        most_insertions_(static_cast<std::size_t>(options.insertions * static_cast<double>(mesh.vertices().size())))
  {}

  Perturb_report_3 run()
  {
    look_around();
    report_.before = report_.after;
    raise_bounds();
    mend_worst();
    report_.seconds = timer_.seconds();
    return report_;
  }

private:
  using Perturber = Vertex_perturber_3<Restricted>;
  using Purpose = typename Perturber::Purpose;
  using Judge = typename Perturber::Judge;

  static constexpr double degree = 3.14159265358979323846 / 180;

  /// A vertex of slivers: interior ones first, then those with fewer slivers, then the smaller angle, then the elder.
  struct Candidate
  {
    int id;
    bool on_boundary = false;
    int slivers = 0;
    double measure = -1;

    bool operator<(const Candidate& other) const
    {
      if (on_boundary != other.on_boundary) return other.on_boundary;
      if (slivers != other.slivers) return slivers < other.slivers;
      if (measure != other.measure) return measure > other.measure;
      return id < other.id;
    }
  };

  /// A cell by the ids of its vertices, since cells go.
  struct Sliver
  {
    double measure;
    std::array<int, 4> vertices;

    bool operator<(const Sliver& other) const
    {
      return measure != other.measure ? measure > other.measure : vertices < other.vertices;
    }
  };

  static double degrees(double cosine) { return std::acos((std::max)(-1.0, (std::min)(1.0, cosine))) / degree; }

  bool is_late() const { return timer_.seconds() >= options_.time_limit; }

  bool goes_on()
  {
    return !is_late() && report_.after < options_.target && (!options_.go_on || options_.go_on(report_.after));
  }

  /// Measures all cells: the smallest dihedral angle, below which nothing may fall from here on, and the slivers.
  void look_around()
  {
    double smallest = -1;
    slivers_ = 0;
    worst_ = -1;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0) continue;
      const Dihedral_cosines_3 x = Judge::cosines(c);
      const double measure = sliver_measure(x);
      smallest = (std::max)(smallest, x.smallest);
      worst_ = (std::max)(worst_, measure);
      slivers_ += measure > bound_;
    }
    report_.after = degrees(smallest);
    perturber_.judge().set_floor(smallest);
  }

  void set_bound(double measure)
  {
    bound_ = measure;
    perturber_.set_bound(measure);
  }

  // ---- bounds over the whole mesh

  void raise_bounds()
  {
    for (double bound = options_.first_bound; goes_on(); bound += options_.step) {
      set_bound(std::cos((std::min)(bound, options_.target) * degree));
      for (int pass = 0; pass < options_.most_passes && goes_on(); ++pass) {
        const std::size_t mended = run_pass() + insert_vertices();
        look_around();
        if (mended == 0) break;
      }
      if (bound >= (std::min)(options_.target, last_bound)) break;
    }
  }

  std::size_t run_pass()
  {
    ++report_.passes;
    std::vector<Candidate> candidates = list_candidates();
    std::sort(candidates.begin(), candidates.end());
    std::size_t moved = 0;
    for (const Candidate& candidate : candidates) {
      if (is_late()) break;
      moved += perturber_.move(candidate.id, Purpose::mend, options_.random_trials);
    }
    return moved;
  }

  std::vector<Candidate> list_candidates() const
  {
    std::vector<Candidate> all(mesh_.vertices().size());
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0) continue;
      const double x = Judge::measure(c);
      if (x <= bound_) continue;
      for (int i = 0; i < 4; ++i) {
        const Vertex_handle v = c->vertex(i);
        Candidate& candidate = all[static_cast<std::size_t>(v->id())];
        candidate.id = v->id();
        candidate.on_boundary = v->location().dimension < 3;
        candidate.measure = (std::max)(candidate.measure, x);
        ++candidate.slivers;
      }
    }
    all.erase(std::remove_if(all.begin(), all.end(), [](const Candidate& c) { return c.slivers == 0; }), all.end());
    return all;
  }

  /// Inserts a vertex near each cell below the bound, where that helps; how many.
  std::size_t insert_vertices()
  {
    std::size_t inserted = 0;
    for (const Sliver& sliver : list_slivers(bound_)) {
      if (is_late() || !may_insert()) break;
      const Cell_handle c = cell(sliver);
      if (c != Cell_handle()) inserted += perturber_.insert_near(c, insertion_trials, true);
    }
    return inserted;
  }

  bool may_insert() const { return report_.insertions < most_insertions_ + report_.removals; }

  /// Cells that measure more, the worst first.
  std::vector<Sliver> list_slivers(double bound) const
  {
    std::vector<Sliver> slivers;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0) continue;
      const double x = Judge::measure(c);
      if (x <= bound) continue;
      slivers.push_back({x, {}});
      for (std::size_t i = 0; i < 4; ++i) slivers.back().vertices[i] = c->vertex(static_cast<int>(i))->id();
      std::sort(slivers.back().vertices.begin(), slivers.back().vertices.end());
    }
    std::sort(slivers.begin(), slivers.end());
    return slivers;
  }

  /// The cell if it is there still and still a sliver.
  Cell_handle cell(const Sliver& sliver) const
  {
    Vertex_handle v[4];
    for (std::size_t i = 0; i < 4; ++i) {
      const auto id = static_cast<std::size_t>(sliver.vertices[i]);
      if (id >= mesh_.vertices().size()) return Cell_handle(); // removals have changed ids
      v[i] = mesh_.vertices()[id];
    }
    Cell_handle c;
    int i, j, k, l;
    if (!mesh_.triangulation().is_cell(v[0], v[1], v[2], v[3], c, i, j, k, l)) return Cell_handle();
    return c->subdomain() != 0 && Judge::measure(c) > bound_ ? c : Cell_handle();
  }

  // ---- the worst cells

  void mend_worst()
  {
    for (int idle = 0; idle < patience && goes_on();) {
      std::vector<Sliver> worst = list_slivers(std::cos(options_.target * degree));
      if (worst.empty()) break;
      const std::size_t batch = (std::max)(least_batch, mesh_.vertices().size() / 400);
      if (worst.size() > batch) worst.resize(batch);
      set_bound(worst.back().measure - 1e-9);
      const double before = worst.front().measure;
      std::size_t mended = 0;
      for (std::size_t k = 0; k < worst.size() && !is_late(); ++k) mended += mend(worst[k], k < 3 ? 2 + idle : 0);
      look_around();
      ++report_.passes;
      ++idle;
      if (worst_ < before - 1e-4 || mended > worst.size() / 4) idle = 0;
    }
  }

  /// Tries everything on a cell; whether it is gone or better than the bound.
  bool mend(const Sliver& sliver, int effort)
  {
    const int trials = options_.random_trials << (std::min)(effort, 5);
    if (move_vertices(sliver, trials)) return true;
    Cell_handle c = cell(sliver);
    if (c == Cell_handle()) return true;
    if (may_insert() && perturber_.insert_near(c, 4 * trials, true)) return true;
    if (remove_one(sliver)) return true;
    if (effort == 0) return false;
    const std::vector<int> around = vertices_around(cell(sliver));
    for (const Purpose purpose : {Purpose::better, Purpose::shake})
      for (const int id : around) {
        if (is_late()) return false;
        perturber_.move(id, purpose, options_.random_trials);
        if (cell(sliver) == Cell_handle()) return true;
      }
    return move_vertices(sliver, trials);
  }

  bool move_vertices(const Sliver& sliver, int trials)
  {
    for (const int id : sliver.vertices) {
      if (cell(sliver) == Cell_handle()) return true;
      if (is_late()) return false;
      perturber_.move(id, Purpose::mend, trials);
    }
    return cell(sliver) == Cell_handle();
  }

  bool remove_one(const Sliver& sliver)
  {
    for (const int id : sliver.vertices) {
      const std::size_t vertices = mesh_.vertices().size();
      const Vertex_handle v = mesh_.vertices()[static_cast<std::size_t>(id)];
      if (perturber_.remove(id)) return true;
      if (mesh_.vertices().size() != vertices || mesh_.vertices()[static_cast<std::size_t>(id)] != v) return false;
    }
    return false;
  }

  std::vector<int> vertices_around(Cell_handle c) const
  {
    std::vector<int> around;
    std::vector<Cell_handle> star;
    for (int i = 0; i < 4 && c != Cell_handle(); ++i)
      mesh_.triangulation().incident_cells(c->vertex(i), std::back_inserter(star));
    for (const Cell_handle n : star)
      for (int k = 0; k < 4; ++k)
        if (n->vertex(k)->location().dimension > 0) around.push_back(n->vertex(k)->id());
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    return around;
  }

  static constexpr double last_bound = 20; ///< degrees, up to where the whole mesh is worked on
  static constexpr int insertion_trials = 200;
  static constexpr std::size_t least_batch = 10;
  static constexpr int patience = 16;

  Restricted& mesh_;
  const Perturb_options_3& options_;
  internal::Timer timer_;
  Perturb_report_3 report_;
  Perturber perturber_;
  std::size_t most_insertions_, slivers_ = 0;
  double bound_ = 1, worst_ = 1; ///< sliver measures
};

/// Raises the smallest dihedral angle of a mesh as far as `options.target` by moving, inserting and removing vertices
/// inside, on patches and on creases.
///
/// The triangulation stays Delaunay, vertices stay on their patches and creases, the boundary stays a surface, and
/// elements that satisfied `criteria` are replaced by elements that do. The smallest dihedral angle never falls.
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
