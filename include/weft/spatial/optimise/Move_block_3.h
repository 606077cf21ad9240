// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves of many vertices of slivers in blocks of vertices without common neighbours. Several threads find places for
// those of a block. All of them move, what that changes is classified at once, and several threads judge it. What must
// not be is taken back, so that the result is that of moves one after the other, for any number of threads.

#ifndef WEFT_SPATIAL_OPTIMISE_MOVE_BLOCK_3_H
#define WEFT_SPATIAL_OPTIMISE_MOVE_BLOCK_3_H

#include <weft/internal/parallel_for.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/criteria/Deviation_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/Move_search_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/Perturbation_judge_3.h>
#include <weft/spatial/restricted/Handle_marks.h>
#include <weft/spatial/restricted/Moves_together_3.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <iterator>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Move_block_3
{
public:
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Judge = Perturbation_judge_3<Restricted>;
  using Moves = Move_search_3<Restricted>;
  using Task = typename Moves::Task;
  using Found = typename Moves::Found;

  /// Everything has to live as long as this object.
  Move_block_3(Restricted& mesh, Criteria_guard_3<Restricted>& guard, const Perturb_options_3& options,
               const Judge& judge)
      : mesh_(mesh), guard_(guard), options_(options), judge_(judge), together_(mesh)
  {}

  /// Takes the first vertices that are far enough from each other.
  /// \param later gets all others, in their order.
  /// \param task_for `task_for(id)` returns what is to be found for a vertex.
  template <class Task_for>
  void choose(const std::vector<int>& ids, std::vector<int>& later, const Task_for& task_for)
  {
    tasks_.clear();
    taken_.clear();
    std::size_t k = 0;
    for (; k < ids.size() && k < most_looked_at && tasks_.size() < most_tasks; ++k)
      if (take(vertex(ids[k])))
        tasks_.push_back(task_for(ids[k]));
      else
        later.push_back(ids[k]);
    later.insert(later.end(), ids.begin() + static_cast<std::ptrdiff_t>(k), ids.end());
  }

  /// Finds places for the vertices of the block and moves them to the first that is possible.
  /// \param report gets what was refused.
  void carry_out(Perturb_report_3& report)
  {
    const int version = mesh_.version();
    find_places();
    outcomes_.assign(tasks_.size(), Outcome());
    std::size_t made = 0;
    for (place_ = 0; place_ == 0 || made > 0; ++place_) {
      made = 0;
      moving_.clear();
      together_.begin();
      for (std::size_t k = 0; k < tasks_.size(); ++k) {
        Outcome& outcome = outcomes_[k];
        if (place_ != outcome.tried || found_[k].places.size() <= place_ || outcome.has_moved) continue;
        if (place_ == 0 && !is_unchanged(found_[k].seen, version)) continue;
        if (!together_.move(tasks_[k].id, found_[k].places[place_].point)) continue;
        ++outcome.tried;
        moving_.push_back(k);
      }
      made = moving_.size();
      if (made == 0) break;
      together_.classify();
      states_.assign(made, State::made);
      while (judge_moves(report)) {
        take_back_refused();
        together_.classify();
      }
      for (std::size_t m = 0; m < made; ++m)
        if (states_[m] == State::judged) {
          outcomes_[moving_[m]].has_moved = true;
          outcomes_[moving_[m]].origin = together_.origin(m);
        }
    }
  }

  std::size_t size() const { return tasks_.size(); }
  const Task& task(std::size_t k) const { return tasks_[k]; }
  const Found& found(std::size_t k) const { return found_[k]; }

  struct Outcome
  {
    std::size_t tried = 0;  ///< places, in their order
    bool has_moved = false; ///< to the last of them
    Point origin;           ///< where from
  };
  const Outcome& outcome(std::size_t k) const { return outcomes_[k]; }

private:
  /// Of a move.
  enum class State
  {
    made,
    judged, ///< and accepted
    refused,
    taken_back
  };

  Vertex_handle vertex(int id) const { return mesh_.vertices()[static_cast<std::size_t>(id)]; }

  /// Takes a vertex and its neighbours unless one of them is taken already.
  bool take(Vertex_handle v)
  {
    neighbours_.assign(1, v);
    mesh_.triangulation().finite_adjacent_vertices(v, std::back_inserter(neighbours_));
    const auto has_no_id = [](Vertex_handle w) { return w->id() < 0; };
    neighbours_.erase(std::remove_if(neighbours_.begin(), neighbours_.end(), has_no_id), neighbours_.end());
    for (const Vertex_handle w : neighbours_)
      if (taken_.get(w) != Handle_marks::none) return false;
    for (const Vertex_handle w : neighbours_) taken_.add(w, 1);
    return true;
  }

  void find_places()
  {
    found_.resize(most_tasks);
    while (searches_.size() < parts) searches_.emplace_back(mesh_, guard_, options_);
    parallel_for(
        parts, guard_.threads(),
        [this](std::size_t p) {
          for (std::size_t k = p; k < tasks_.size(); k += parts) searches_[p].find(tasks_[k], true, found_[k]);
        },
        1);
  }

  bool is_unchanged(const std::vector<int>& ids, int version) const
  {
    return std::all_of(ids.begin(), ids.end(), [&](int id) { return mesh_.changed_at(vertex(id)) < version; });
  }

  /// Judges what the moves have made, as far as it wasn't judged as it is; whether some are refused.
  bool judge_moves(Perturb_report_3& report)
  {
    verdicts_.assign(moving_.size(), Refusal_3::none);
    const bool is_bare = guard_.has_bare_part();
    parallel_for(
        moving_.size(), guard_.threads(),
        [this](std::size_t m) {
          if (states_[m] == State::made) verdicts_[m] = verdict(m);
        },
        1);
    bool is_refused = false;
    for (std::size_t m = 0; m < moving_.size(); ++m) {
      if (states_[m] == State::made) states_[m] = State::judged;
      if (is_bare && states_[m] == State::judged) verdicts_[m] = Refusal_3::bare;
      if (Judge::is_acceptable(verdicts_[m], report)) continue;
      states_[m] = State::refused;
      is_refused = true;
    }
    return is_refused;
  }

  Refusal_3 verdict(std::size_t m) const
  {
    const std::vector<Cell_handle>& cells = together_.cells(m);
    const double most = found_[moving_[m]].places[place_].measure + Judge::least_gain / 2;
    const bool is_as_found = std::all_of(cells.begin(), cells.end(), [&](Cell_handle c) {
      if (c->subdomain() == 0) return true;
      const Dihedral_cosines_3 x = judge_.cosines(c);
      return sliver_measure(x) <= most && x.smallest <= judge_.floor();
    });
    return is_as_found ? guard_.refusal(cells, together_.facets(m), Deviation_3<Restricted>::new_era())
                       : Refusal_3::cell;
  }

  /// Moves whose neighbourhood changes by that are to be judged again.
  void take_back_refused()
  {
    const int version = mesh_.version();
    std::vector<std::size_t> refused;
    for (std::size_t m = 0; m < moving_.size(); ++m)
      if (states_[m] == State::refused) refused.push_back(m);
    for (std::size_t i = 0; i < refused.size(); ++i) {
      states_[refused[i]] = State::taken_back;
      for (const std::size_t other : together_.take_back(refused[i])) {
        if (states_[other] == State::refused || states_[other] == State::taken_back) continue;
        states_[other] = State::refused;
        refused.push_back(other);
      }
    }
    for (std::size_t m = 0; m < moving_.size(); ++m)
      if (states_[m] == State::judged && is_touched(together_.cells(m), version)) states_[m] = State::made;
  }

  bool is_touched(const std::vector<Cell_handle>& cells, int version) const
  {
    return std::any_of(cells.begin(), cells.end(), [&](Cell_handle c) {
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i)->id() >= 0 && mesh_.changed_at(c->vertex(i)) >= version) return true;
      return false;
    });
  }

  static constexpr std::size_t most_tasks = 64, parts = 16; ///< of a block, and how many threads may share them
  static constexpr std::size_t most_looked_at = 128;        ///< vertices, to choose a block

  Restricted& mesh_;
  Criteria_guard_3<Restricted>& guard_;
  const Perturb_options_3& options_;
  const Judge& judge_;
  Moves_together_3<Restricted> together_;
  std::deque<Moves> searches_;
  std::vector<Task> tasks_;
  std::vector<Found> found_;
  std::vector<Outcome> outcomes_;
  std::size_t place_ = 0;           ///< of those found, which is tried
  std::vector<std::size_t> moving_; ///< tasks that move there
  std::vector<State> states_;       ///< of these moves
  std::vector<Refusal_3> verdicts_;
  Handle_marks taken_; ///< vertices at those of the block
  std::vector<Vertex_handle> neighbours_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_MOVE_BLOCK_3_H
