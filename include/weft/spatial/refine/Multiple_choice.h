// SPDX-License-Identifier: GPL-3.0-or-later
//
// Multiple choice (Tournois 2009, sec. 3.2.1.4): always the worst of a few random ones. What comes next can be told
// ahead, since it hangs on random numbers alone.

#ifndef WEFT_SPATIAL_REFINE_MULTIPLE_CHOICE_H
#define WEFT_SPATIAL_REFINE_MULTIPLE_CHOICE_H

#include <algorithm>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace weft::internal {

/// Draws numbers out of a pool.
class Multiple_choice
{
public:
  /// \param random all random choices are drawn from it, in the order in which they are made.
  explicit Multiple_choice(std::mt19937& random) : random_(random) {}

  void begin(std::vector<std::size_t> pool)
  {
    pool_ = std::move(pool);
    container_.clear();
  }

  /// The numbers that come next, fewer, or none, if there are no more.
  /// \param is_better `is_better(i, j)` compares numbers.
  template <class Is_better>
  const std::vector<std::size_t>& pick(std::size_t most, const Is_better& is_better)
  {
    before_ = random_;
    picked_.clear();
    draws_.clear();
    unsigned long long draws = 0;
    while (picked_.size() < most) {
      for (; container_.size() < choices && !pool_.empty(); ++draws) container_.push_back(take_random());
      if (container_.empty()) break;
      const auto worst = std::max_element(container_.begin(), container_.end(), is_better);
      picked_.push_back(*worst);
      draws_.push_back(draws);
      *worst = container_.back();
      container_.pop_back();
    }
    return picked_;
  }

  /// Ends drawing as if only the first k of the numbers picked last had been picked.
  void end_after(std::size_t k)
  {
    random_ = before_;
    random_.discard(k > 0 ? draws_[k - 1] : 0);
  }

private:
  std::size_t take_random()
  {
    const std::size_t i = random_() % pool_.size();
    const std::size_t taken = pool_[i];
    pool_[i] = pool_.back();
    pool_.pop_back();
    return taken;
  }

  static constexpr std::size_t choices = 20; // Tournois 2009, sec. 3.2.1.4

  std::mt19937& random_;
  std::mt19937 before_; ///< state of `random_` before the last numbers were picked
  std::vector<std::size_t> pool_, container_, picked_;
  std::vector<unsigned long long> draws_; ///< random numbers drawn up to each of these
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_MULTIPLE_CHOICE_H
