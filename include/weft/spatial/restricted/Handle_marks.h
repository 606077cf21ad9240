// SPDX-License-Identifier: GPL-3.0-or-later
//
// Marks of cells and vertices that lie beside them: several threads look at one triangulation, and what one of them
// marks the others mustn't see.

#ifndef WEFT_SPATIAL_RESTRICTED_HANDLE_MARKS_H
#define WEFT_SPATIAL_RESTRICTED_HANDLE_MARKS_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft::internal {

/// A small hash table from handles to numbers that is emptied at once.
class Handle_marks
{
public:
  static constexpr int none = -1;

  void clear()
  {
    ++epoch_;
    used_ = 0;
  }

  /// The number of a handle; `none` if it has none.
  template <class Handle>
  int get(Handle h) const
  {
    const void* const key = &*h;
    for (std::size_t at = place(key);; at = (at + 1) & (table_.size() - 1)) {
      const Entry& e = table_[at];
      if (e.epoch != epoch_) return none;
      if (e.key == key) return e.value;
    }
  }

  /// Gives a handle a number of 0 or more; false, and nothing happens, if it has one.
  template <class Handle>
  bool add(Handle h, int value)
  {
    if (2 * (used_ + 1) > table_.size()) grow();
    return add_key(&*h, value);
  }

private:
  struct Entry
  {
    const void* key = nullptr;
    std::uint64_t epoch = 0;
    int value = none;
  };

  std::size_t place(const void* key) const
  {
    const auto bits = static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(key));
    return static_cast<std::size_t>((bits * 0x9e3779b97f4a7c15u) >> 32) & (table_.size() - 1);
  }

  bool add_key(const void* key, int value)
  {
    std::size_t at = place(key);
    for (; table_[at].epoch == epoch_; at = (at + 1) & (table_.size() - 1))
      if (table_[at].key == key) return false;
    table_[at] = {key, epoch_, value};
    ++used_;
    return true;
  }

  void grow()
  {
    std::vector<Entry> old(2 * table_.size());
    old.swap(table_);
    used_ = 0;
    for (const Entry& e : old)
      if (e.epoch == epoch_) add_key(e.key, e.value);
  }

  std::vector<Entry> table_{std::vector<Entry>(512)};
  std::uint64_t epoch_ = 1;
  std::size_t used_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_HANDLE_MARKS_H
