// SPDX-License-Identifier: GPL-3.0-or-later
//
// Everything that can be done about one sliver: its vertices are moved, one is inserted near it or removed (Tournois
// 2009, sec. 3.2.2 and 4.1), its neighbours make room (sec. 3.2.2.4), and where all that fails, kicks: something near
// it is changed for the worse, what that does is mended, and all is undone unless that mends the sliver, too.

#ifndef WEFT_SPATIAL_OPTIMISE_SLIVER_MENDER_3_H
#define WEFT_SPATIAL_OPTIMISE_SLIVER_MENDER_3_H

#include <weft/internal/Timer.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/Vertex_perturber_3.h>
#include <weft/spatial/restricted/Cell_ids_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <random>
#include <vector>

namespace weft::internal {

/// A cell by the ids of its vertices, since cells go.
struct Sliver_3
{
  double measure; ///< see `sliver_measure()`
  Cell_ids_3 vertices;

  /// The worst first, then by ids.
  bool operator<(const Sliver_3& other) const
  {
    return measure != other.measure ? measure > other.measure : vertices < other.vertices;
  }
};

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Sliver_mender_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Perturber = Vertex_perturber_3<Restricted>;
  using Purpose = typename Perturber::Purpose;
  using Judge = typename Perturber::Judge;

  /// \param timer since when time is counted.
  Sliver_mender_3(Restricted& mesh, Criteria_guard_3<Restricted>& guard, const Perturb_options_3& options,
                  Perturb_report_3& report, const Timer& timer)
      : mesh_(mesh),
        options_(options),
        report_(report),
        timer_(timer),
        perturber_(mesh, guard, options, report),
        most_insertions_(static_cast<std::size_t>(options.insertions * static_cast<double>(mesh.vertices().size()))),
        random_(options.seed + 1)
  {}

  Perturber& perturber() { return perturber_; }
  const Perturber& perturber() const { return perturber_; }

  /// Cells that measure more are slivers.
  void set_bound(double measure)
  {
    bound_ = measure;
    perturber_.set_bound(measure);
  }
  double bound() const { return bound_; }

  /// No angle may get smaller than the one with this cosine.
  void set_floor(double cosine)
  {
    floor_ = cosine;
    perturber_.judge().set_floor(cosine);
  }

  bool is_late() const { return timer_.seconds() >= options_.time_limit; }
  bool may_insert() const { return report_.insertions < most_insertions_ + report_.removals; }

  static Sliver_3 sliver_of(Cell_handle c, double measure) { return {measure, ids_of_cell(c)}; }

  /// The cell if it is there still and still a sliver.
  Cell_handle cell(const Sliver_3& sliver) const
  {
    const Cell_handle c = find_cell(mesh_, sliver.vertices); // removals have changed ids
    return c != Cell_handle() && c->subdomain() != 0 && is_sliver(c) ? c : Cell_handle();
  }

  /// Whether a cell is gone or no sliver any more after everything has been tried.
  /// \param effort 0: what is cheap; from 1 on kicks, the more the larger.
  bool mend(const Sliver_3& sliver, int effort)
  {
    const int trials = options_.random_trials << (std::min)(effort, 5);
    if (move_vertices(sliver, trials)) return true;
    const Cell_handle c = cell(sliver);
    if (c == Cell_handle()) return true;
    if (may_insert() && perturber_.insert_near(c, 4 * trials, bound_)) return true;
    if (remove_vertex(sliver)) return true;
    if (effort >= make_room_from && make_room(sliver)) return true;
    for (int k = 0; k < kicks_per_effort * (std::min)(effort, most_effort) && !is_late(); ++k)
      if (kick(sliver)) return true;
    return false;
  }

private:
  bool is_sliver(Cell_handle c) const
  {
    const Dihedral_cosines_3 x = perturber_.judge().cosines(c);
    return sliver_measure(x) > bound_ || x.smallest > floor_;
  }

  bool is_gone(const Sliver_3& sliver) const { return cell(sliver) == Cell_handle(); }

  bool move_vertices(const Sliver_3& sliver, int trials)
  {
    for (const int id : sliver.vertices) {
      if (is_gone(sliver)) return true;
      if (is_late()) return false;
      perturber_.move(id, Purpose::mend, trials);
    }
    return is_gone(sliver);
  }

  bool remove_vertex(const Sliver_3& sliver)
  {
    return std::any_of(sliver.vertices.begin(), sliver.vertices.end(),
                       [this](int id) { return perturber_.remove(id, bound_); });
  }

  bool make_room(const Sliver_3& sliver)
  {
    // What has been tried and undone may have put the cell's vertices into another order. Its measure is then rounded
    // in another way and may be no more than the bound.
    const Cell_handle c = cell(sliver);
    if (c == Cell_handle()) return true;
    const std::vector<int> around = vertices_around(c);
    for (const Purpose purpose : {Purpose::better, Purpose::shake})
      for (const int id : around) {
        if (is_late()) return false;
        perturber_.move(id, purpose, options_.random_trials);
        if (is_gone(sliver)) return true;
      }
    return false;
  }

  /// Vertices that may move of the cells around one.
  std::vector<int> vertices_around(Cell_handle c) const
  {
    std::vector<int> around;
    std::vector<Cell_handle> star;
    for (int i = 0; i < 4; ++i) mesh_.triangulation().incident_cells(c->vertex(i), std::back_inserter(star));
    for (const Cell_handle n : star)
      for (int k = 0; k < 4; ++k)
        if (n->vertex(k)->location().dimension > 0) around.push_back(n->vertex(k)->id());
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    return around;
  }

  // ---- kicks

  bool kick(const Sliver_3& sliver)
  {
    if (is_gone(sliver)) return true;
    const Perturb_report_3 saved = report_;
    ++report_.kicks;
    perturber_.begin();
    perturber_.judge().set_floor(1); // until the end
    pending_ = {sliver};
    const bool kept = change_near(cell(sliver)) && mend_pending();
    perturber_.judge().set_floor(floor_);
    if (kept) return ++report_.kicks_kept, true;
    perturber_.undo();
    report_.by_radius = saved.by_radius;
    report_.by_volume = saved.by_volume;
    report_.by_chance = saved.by_chance;
    report_.insertions = saved.insertions;
    report_.removals = saved.removals;
    return false;
  }

  bool change_near(Cell_handle c)
  {
    const std::vector<int> around = vertices_around(c);
    if (around.empty()) return false;
    const int id = around[random_() % around.size()];
    const double depth = deepest_kick + (1 - deepest_kick) * static_cast<double>(random_()) / 4294967295.0;
    const double bound = cosine_of_degrees(depth * degrees_of_cosine(bound_));
    bool changed = false;
    switch (random_() % 4) {
    case 0:
    case 1:
      changed = may_insert() && perturber_.insert_near(c, options_.random_trials, bound, false);
      break;
    case 2:
      changed = remove(id, bound);
      break;
    default:
      perturber_.set_kick_bound(bound);
      changed = perturber_.move(id, Purpose::kick, options_.random_trials);
    }
    if (changed) note_new_slivers();
    return changed;
  }

  bool remove(int id, double bound)
  {
    const int last = static_cast<int>(mesh_.vertices().size()) - 1;
    if (!perturber_.remove(id, bound)) return false;
    std::vector<Sliver_3> left;
    for (Sliver_3& sliver : pending_) {
      auto& v = sliver.vertices;
      if (std::find(v.begin(), v.end(), id) != v.end()) continue; // it died with its vertex
      std::replace(v.begin(), v.end(), last, id);
      std::sort(v.begin(), v.end());
      left.push_back(sliver);
    }
    pending_ = std::move(left);
    return true;
  }

  void note_new_slivers()
  {
    for (const Cell_handle c : mesh_.new_cells())
      if (c->subdomain() != 0 && is_sliver(c)) pending_.push_back(sliver_of(c, perturber_.judge().measure(c)));
  }

  /// Whether a few moves, the worst sliver first, leave none of those that a kick has made, nor the one it is for.
  bool mend_pending()
  {
    for (int k = 0; k < moves_per_kick && !is_late(); ++k) {
      const auto gone = [this](const Sliver_3& s) { return is_gone(s); };
      pending_.erase(std::remove_if(pending_.begin(), pending_.end(), gone), pending_.end());
      if (pending_.empty()) return true;
      if (pending_.size() > most_pending) return false;
      const Sliver_3 worst = *std::min_element(pending_.begin(), pending_.end());
      const auto moves = [this](int id) { return perturber_.move(id, Purpose::mend, options_.random_trials); };
      if (std::none_of(worst.vertices.begin(), worst.vertices.end(), moves)) return false;
      note_new_slivers();
    }
    return false;
  }

  static constexpr int make_room_from = 4, most_effort = 30; ///< efforts
  // With these smallest angles rise fastest.
  static constexpr int kicks_per_effort = 8, moves_per_kick = 20;
  static constexpr std::size_t most_pending = 10;
  static constexpr double deepest_kick = 0.3; ///< in parts of the bound, as an angle

  Restricted& mesh_;
  const Perturb_options_3& options_;
  Perturb_report_3& report_;
  const Timer& timer_;
  Perturber perturber_;
  std::size_t most_insertions_;
  std::mt19937 random_;
  double bound_ = 1, floor_ = 1;
  std::vector<Sliver_3> pending_; ///< during a kick: what is still to be mended
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_SLIVER_MENDER_3_H
