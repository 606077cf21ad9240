// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which of the numbers 0, 1, ... belong together, when pairs of them are said to.

#ifndef WEFT_INTERNAL_DISJOINT_PARTS_H
#define WEFT_INTERNAL_DISJOINT_PARTS_H

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace weft::internal {

/// Sets that are united.
class Disjoint_parts
{
public:
  explicit Disjoint_parts(std::size_t n) : parent_(n)
  {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = i;
  }
  std::size_t find(std::size_t i)
  {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t i, std::size_t j)
  {
    i = find(i), j = find(j);
    parent_[(std::max)(i, j)] = (std::min)(i, j);
  }

private:
  std::vector<std::size_t> parent_;
};

/// Numbers parts by their first element; returns how many there are.
inline int number_parts(Disjoint_parts& parts, std::size_t n, std::vector<int>& number)
{
  number.clear();
  std::map<std::size_t, int> number_of_part;
  for (std::size_t t = 0; t < n; ++t)
    number.push_back(number_of_part.try_emplace(parts.find(t), static_cast<int>(number_of_part.size())).first->second);
  return static_cast<int>(number_of_part.size());
}

} // namespace weft::internal

#endif // WEFT_INTERNAL_DISJOINT_PARTS_H
