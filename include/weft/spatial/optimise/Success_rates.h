// SPDX-License-Identifier: GPL-3.0-or-later
//
// Learns which of several ways to do something pays: successes for their cost, with the past fading away. For the
// perturbation of slivers, whose directions (Tournois 2009, sec. 3.2.2) help in some meshes and stages more than in
// others.

#ifndef WEFT_SPATIAL_OPTIMISE_SUCCESS_RATES_H
#define WEFT_SPATIAL_OPTIMISE_SUCCESS_RATES_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// See the top of the file. Deterministic.
class Success_rates
{
public:
  explicit Success_rates(std::size_t number_of_kinds) : kinds_(number_of_kinds) {}

  void spend(std::size_t kind, double cost)
  {
    Kind& k = kinds_[kind];
    k.cost += cost;
    if (k.cost < memory) return;
    k.cost /= 2;
    k.successes /= 2;
  }
  void succeed(std::size_t kind) { ++kinds_[kind].successes; }

  /// The kinds that have paid more than one, the best first; now and then all others, too, since that may change.
  const std::vector<std::size_t>& better_than(std::size_t one)
  {
    better_.clear();
    const bool all = ++asked_ % exploring == 0;
    for (std::size_t k = 0; k < kinds_.size(); ++k)
      if (k != one && (all || rate(k) >= rate(one))) better_.push_back(k);
    std::stable_sort(better_.begin(), better_.end(),
                     [this](std::size_t a, std::size_t b) { return rate(a) > rate(b); });
    return better_;
  }

private:
  struct Kind
  {
    double cost = 20, successes = 1; ///< as if that had been so: all have their chance at first
  };

  double rate(std::size_t kind) const { return kinds_[kind].successes / kinds_[kind].cost; }

  static constexpr double memory = 5000;
  static constexpr std::size_t exploring = 32;

  std::vector<Kind> kinds_;
  std::vector<std::size_t> better_;
  std::size_t asked_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_SUCCESS_RATES_H
