// SPDX-License-Identifier: GPL-3.0-or-later
//
// The perturber behind perturb_slivers_3.h: which slivers are worked on, in which order and for how long.

#ifndef WEFT_SPATIAL_OPTIMISE_SLIVER_PERTURBER_3_H
#define WEFT_SPATIAL_OPTIMISE_SLIVER_PERTURBER_3_H

#include <weft/internal/Timer.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/Sliver_mender_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// The perturber; `perturb_slivers_3()` runs it.
template <class Restricted>
class Sliver_perturber_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;

  Sliver_perturber_3(Restricted& mesh, Criteria_guard_3<Restricted>& guard, const Perturb_options_3& options)
      : mesh_(mesh), guard_(guard), options_(options), mender_(mesh, guard, options, report_, timer_)
  {}

  Perturb_report_3 run()
  {
    look_around(0);
    report_.before = report_.after;
    raise_bounds();
    if (options_.mend_worst) mend_worst();
    report_.seconds = timer_.seconds();
    return report_;
  }

private:
  using Mender = Sliver_mender_3<Restricted>;
  using Judge = typename Mender::Judge;

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

  const Judge& judge() const { return mender_.perturber().judge(); }

  bool goes_on()
  {
    return !mender_.is_late() && report_.after < options_.target && (!options_.go_on || options_.go_on(report_.after));
  }

  /// Measures all cells: the smallest dihedral angle, below which nothing may fall from here on, and the worst cells.
  /// \param most how many of those that are worse than the target are kept in `worst_`.
  void look_around(std::size_t most)
  {
    const double target = cosine_of_degrees(options_.target);
    double smallest = -1;
    std::vector<std::pair<double, Cell_handle>> cells;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0 || judge().is_locked(c)) continue;
      const Dihedral_cosines_3 x = judge().cosines(c);
      smallest = (std::max)(smallest, x.smallest);
      if (most > 0 && sliver_measure(x) > target) cells.emplace_back(sliver_measure(x), c);
    }
    below_target_ = cells.size();
    if (cells.size() > most) {
      const auto last = cells.begin() + static_cast<std::ptrdiff_t>(most);
      std::nth_element(cells.begin(), last, cells.end(),
                       [](const auto& a, const auto& b) { return a.first > b.first; });
      cells.erase(last, cells.end());
    }
    worst_.clear();
    for (const auto& [measure, c] : cells) worst_.push_back(Mender::sliver_of(c, measure));
    std::sort(worst_.begin(), worst_.end());
    report_.after = degrees_of_cosine(smallest);
    mender_.set_floor(smallest);
  }

  // ---- bounds over the whole mesh

  void raise_bounds()
  {
    for (double bound = options_.first_bound; goes_on(); bound += options_.step) {
      mender_.set_bound(cosine_of_degrees((std::min)(bound, options_.target)));
      for (int pass = 0; pass < options_.most_passes && goes_on(); ++pass) {
        std::size_t mended = run_pass();
        if (mended == 0 || pass >= passes_of_moves) mended += insert_vertices();
        look_around(0);
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
    std::vector<int> ids;
    for (const Candidate& candidate : candidates) ids.push_back(candidate.id);
    return mender_.perturber().move_all(std::move(ids), options_.random_trials, [this] { return mender_.is_late(); });
  }

  /// Where criteria can't hold, cells that violate them are tried once: no bound makes them easier to mend, and there
  /// may be thousands.
  bool is_given_up(Cell_handle c) const
  {
    return !options_.mend_worst && report_.passes > 1 && guard_.measure().cell(c).is_bad();
  }

  std::vector<Candidate> list_candidates() const
  {
    std::vector<Candidate> all(mesh_.vertices().size());
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0 || judge().is_locked(c)) continue;
      const double x = judge().measure(c);
      if (x <= mender_.bound() || is_given_up(c)) continue;
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
    std::vector<Sliver_3> slivers;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0 || judge().is_locked(c)) continue;
      const double x = judge().measure(c);
      if (x > mender_.bound() && !is_given_up(c)) slivers.push_back(Mender::sliver_of(c, x));
    }
    std::sort(slivers.begin(), slivers.end());
    std::size_t inserted = 0;
    for (const Sliver_3& sliver : slivers) {
      if (mender_.is_late() || !mender_.may_insert()) break;
      const Cell_handle c = mender_.cell(sliver);
      if (c != Cell_handle()) inserted += mender_.perturber().insert_near(c, insertion_trials, mender_.bound());
    }
    return inserted;
  }

  // ---- the worst cells

  /// Works on the worst few cells until they stay for as many trials as all progress has taken, or the target is out of
  /// reach.
  void mend_worst()
  {
    std::size_t last_progress = report_.trials;
    const std::size_t batch = (std::max)(least_batch, mesh_.vertices().size() / batch_divisor);
    look_around(batch);
    course_.assign(1, {report_.trials, report_.after, below_target_});
    for (int idle = 0; !worst_.empty() && idle < most_idle && report_.trials < 2 * last_progress + patience &&
                       !is_out_of_reach() && goes_on();) {
      mender_.set_bound(std::nextafter(worst_.back().measure, -1.0)); // the last is a sliver, too
      const std::vector<Sliver_3> worst = std::move(worst_);
      std::size_t mended = 0;
      for (std::size_t k = 0; k < worst.size() && !mender_.is_late(); ++k)
        mended += mender_.mend(worst[k], k < very_worst ? 1 + idle : 0);
      look_around(batch);
      course_.push_back({report_.trials, report_.after, below_target_});
      ++report_.passes;
      idle = worst_.empty() || worst_.front().measure < worst.front().measure - 1e-4 ? 0 : idle + 1;
      if (idle == 0 || mended > worst.size() / 4) last_progress = report_.trials;
    }
  }

  struct Milestone
  {
    std::size_t trials;
    double smallest;          ///< dihedral angle
    std::size_t below_target; ///< cells
  };

  /// Whether the target would take many times all the trials so far at the pace of the latter half of them. Narrow
  /// walls, for instance, leave no room. The smallest angle rises in leaps: as long as cells below the target become
  /// fewer, it isn't out of reach.
  bool is_out_of_reach() const
  {
    const std::size_t first = course_.front().trials;
    if (options_.target >= Perturb_options_3::as_far_as_it_goes || report_.trials < first + patience) return false;
    const std::size_t middle = first + (report_.trials - first) / 2;
    const auto half = std::find_if(course_.begin(), course_.end(), [&](const auto& c) { return c.trials >= middle; });
    const auto is_slow = [this](double gain, double missing) { return 2 * options_.persistence * gain < missing; };
    return is_slow(report_.after - half->smallest, options_.target - report_.after) &&
           is_slow(static_cast<double>(half->below_target) - static_cast<double>(below_target_),
                   static_cast<double>(below_target_));
  }

  static constexpr double last_bound = 20;  ///< degrees, up to where the whole mesh is worked on
  static constexpr int passes_of_moves = 3; ///< before insertions
  static constexpr int insertion_trials = 200;
  static constexpr std::size_t patience = 200000; ///< trials
  static constexpr int most_idle = 40;            ///< passes that leave the worst cell as it is
  // Smallest angles rise fastest with batches of about this size.
  static constexpr std::size_t least_batch = 40, batch_divisor = 80;
  static constexpr std::size_t very_worst = 3; ///< these are worked on ever harder

  Restricted& mesh_;
  const Criteria_guard_3<Restricted>& guard_;
  const Perturb_options_3& options_;
  Timer timer_;
  Perturb_report_3 report_;
  Mender mender_;
  std::vector<Sliver_3> worst_;
  std::size_t below_target_ = 0;  ///< cells, when the worst were last listed
  std::vector<Milestone> course_; ///< after each pass over the worst
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_SLIVER_PERTURBER_3_H
