// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sum of many doubles whose error doesn't grow with their number.

#ifndef WEFT_INTERNAL_COMPENSATED_SUM_H
#define WEFT_INTERNAL_COMPENSATED_SUM_H

#include <cmath>

namespace weft::internal {

/// Neumaier's sum: the error doesn't grow with the number of terms, and hardly with their order.
class Compensated_sum
{
public:
  void add(double x)
  {
    const double sum = sum_ + x;
    const double lost = std::abs(sum_) >= std::abs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    if (std::isfinite(lost)) lost_ += lost;
    sum_ = sum;
  }
  double value() const { return sum_ + lost_; }

private:
  double sum_ = 0, lost_ = 0;
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_COMPENSATED_SUM_H
