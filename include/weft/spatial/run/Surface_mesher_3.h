// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which creases of a surface a mesh keeps: the driver of `mesh_surface_3()`. Creases found by angle that keep the
// criteria from holding are given up, unless they hold with all creases but for cells that small angles force.

#ifndef WEFT_SPATIAL_RUN_SURFACE_MESHER_3_H
#define WEFT_SPATIAL_RUN_SURFACE_MESHER_3_H

#include <weft/internal/Timer.h>
#include <weft/options.h>
#include <weft/report.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/run/drop_creases_3.h>
#include <weft/spatial/run/Spatial_mesher_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace weft::internal {

/// What becomes of creases at small angles.
enum class Small_angles_3
{
  blamed,   ///< what is bad there tells that creases are at fault; small elements beside knife edges are left, which
            ///< tells sooner
  respected ///< they excuse the shapes of cells, and everything is refined: that ends where twins can be everywhere
};

/// One domain for a surface, and its mesher.
template <class K>
struct Surface_attempt_3
{
  using Oracle = Polyhedral_oracle_3<K>;

  Surface_attempt_3(const Piecewise_smooth_complex_3<K>& complex, const Criteria_3<K>& criteria,
                    const Mesh_options_3& all_options, double time_left, Small_angles_3 small_angles)
      : domain(std::make_shared<const Oracle>(complex, small_angles == Small_angles_3::respected)),
        options(with_time_limit(all_options, time_left)),
        mesher(*domain, criteria, options)
  {
    if (small_angles == Small_angles_3::blamed) mesher.leave_knife_edges();
    mesher.meet_criteria();
    report = mesher.report();
  }

  void optimise()
  {
    mesher.start_again_where_bad();
    mesher.optimise();
    report = mesher.report();
  }

  /// Whether refinement ended by itself, with something bad or without.
  bool has_ended() const
  {
    return report.stop_reason == Stop_reason::criteria_met || report.stop_reason == Stop_reason::exhausted;
  }

  static Mesh_options_3 with_time_limit(Mesh_options_3 options, double time)
  {
    options.time_limit = (std::max)(0.0, time);
    return options;
  }

  std::shared_ptr<const Oracle> domain;
  Mesh_options_3 options;
  Spatial_mesher_3<Oracle> mesher;
  Mesh_report_3 report;
};

/// Meshes a surface with ever fewer creases, and keeps the best attempt.
template <class K>
class Surface_mesher_3
{
public:
  using Complex = Piecewise_smooth_complex_3<K>;
  using Attempt = Surface_attempt_3<K>;

  struct Outcome
  {
    std::unique_ptr<Attempt> attempt; ///< optimised
    std::size_t creases_given_up;
  };

  Surface_mesher_3(Complex complex, const Criteria_3<K>& criteria, const Mesh_options_3& options)
      : complex_(std::move(complex)), criteria_(criteria), options_(options)
  {}

  Outcome run()
  {
    const bool may_give_up = options_.give_up_creases;
    auto first = attempt(complex_, may_give_up ? Small_angles_3::blamed : Small_angles_3::respected);
    if (!may_give_up || first->report.stop_reason != Stop_reason::exhausted) return optimised(std::move(first), 0);
    blamed_ = creases_beside_bad_elements(first->mesher.mesh(), criteria_, complex_);
    // Optimisation may mend a facet or cell, so that creases can stay. A crease edge it doesn't: that is known sooner.
    // Where time is short it would be spent on a mesh that is given up.
    const bool is_hopeless = first->report.bad_edges.elements > 0 || time_left() < enough_time * timer_.seconds();
    if (!is_hopeless) first->optimise();
    if (first->report.stop_reason != Stop_reason::exhausted) return {std::move(first), 0};

    const std::optional<Complex> whole =
        first->domain->has_mirror_images() ? std::optional<Complex>(complex_) : std::nullopt;
    least_bad_ = first->report.bad();
    give_creases_up();
    if (whole && !(best_ && best_->report.ok() && longest_given_up_ < long_crease())) respect_all(*whole);
    if (best_) return optimised(std::move(best_), given_up_for_best_);
    return is_hopeless ? optimised(std::move(first), 0) : Outcome{std::move(first), 0};
  }

private:
  std::unique_ptr<Attempt> attempt(const Complex& complex, Small_angles_3 small_angles) const
  {
    return std::make_unique<Attempt>(complex, criteria_, options_, time_left(), small_angles);
  }

  double time_left() const { return options_.time_limit - timer_.seconds(); }

  static Outcome optimised(std::unique_ptr<Attempt> attempt, std::size_t given_up)
  {
    attempt->optimise();
    return {std::move(attempt), given_up};
  }

  /// First the creases beside bad elements, some times, in the end all.
  void give_creases_up()
  {
    std::size_t given_up = 0;
    for (int round = 1; round <= rounds; ++round) {
      const std::size_t dropped = drop_some(round == rounds);
      given_up += dropped;
      if (dropped == 0) break;
      auto trial = attempt(complex_, Small_angles_3::blamed);
      if (!trial->has_ended()) break; // out of time, or cancelled
      blamed_ = creases_beside_bad_elements(trial->mesher.mesh(), criteria_, complex_);
      const bool is_good = trial->report.ok();
      if (is_good || is_much_better(*trial)) keep(std::move(trial), given_up);
      if (is_good) break;
    }
  }

  /// \returns how many creases were dropped.
  std::size_t drop_some(bool drop_all)
  {
    const std::vector<char> all(blamed_.size(), true);
    const std::vector<char>& which = drop_all ? all : blamed_;
    const double longest = longest_found_crease(complex_, which);
    const std::size_t dropped = drop_creases(which, complex_);
    longest_given_up_ = (std::max)(longest_given_up_, dropped > 0 ? longest : longest_found_crease(complex_, all));
    return dropped > 0 ? dropped : drop_creases(all, complex_); // none of those left is at fault on its own
  }

  /// Another attempt with all creases, which excuse cells now.
  void respect_all(const Complex& whole)
  {
    auto trial = attempt(whole, Small_angles_3::respected);
    if (trial->report.ok() || (trial->has_ended() && is_much_better(*trial))) keep(std::move(trial), 0);
  }

  bool is_much_better(const Attempt& trial) const { return much_less * trial.report.bad() < least_bad_; }

  void keep(std::unique_ptr<Attempt> trial, std::size_t given_up)
  {
    least_bad_ = trial->report.bad();
    best_ = std::move(trial);
    given_up_for_best_ = given_up;
  }

  /// Shorter creases are folds of a scan, and not missed.
  double long_crease() const
  {
    const double size = criteria_.size.smallest();
    return size > 0 ? 2 * size : std::numeric_limits<double>::infinity();
  }

  static constexpr int rounds = 4;
  static constexpr double enough_time = 48; ///< for optimisation, times that of refinement
  static constexpr std::size_t much_less = 4; ///< bad elements: a fourth

  Complex complex_; ///< with the creases that are left
  const Criteria_3<K>& criteria_;
  const Mesh_options_3& options_;
  const Timer timer_;
  std::vector<char> blamed_; ///< of the creases, those beside bad elements of the last attempt
  double longest_given_up_ = 0;
  std::unique_ptr<Attempt> best_; ///< null: the first one
  std::size_t least_bad_ = 0, given_up_for_best_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_SURFACE_MESHER_3_H
