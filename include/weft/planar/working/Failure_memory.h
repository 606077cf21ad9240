// SPDX-License-Identifier: GPL-3.0-or-later
//
// Remembers places of a mesh where an improvement was tried in vain, by a key made of all that the attempt depends on.
// Numbers of vertices change and trials are taken back, coordinates then are what they were; so keys are made of those.

#ifndef WEFT_PLANAR_WORKING_FAILURE_MEMORY_H
#define WEFT_PLANAR_WORKING_FAILURE_MEMORY_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace weft::internal {

/// Scrambles a number (the finaliser of SplitMix64; Steele, Lea and Flood, "Fast splittable pseudorandom number
/// generators", 2014).
inline std::uint64_t scrambled(std::uint64_t x)
{
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

inline std::uint64_t key_of_point(double x, double y)
{
  std::uint64_t a, b;
  std::memcpy(&a, &x, sizeof a);
  std::memcpy(&b, &y, sizeof b);
  return scrambled(a + 0x9e3779b97f4a7c15u * b);
}

/// A set of keys of limited size: a new key may push out an old one, which then is tried once more. That two keys
/// coincide by chance, one in 10^19, costs an improvement and no more.
class Failure_memory
{
public:
  /// Makes room for about so many keys; forgets all if there was less.
  void reserve(std::size_t keys)
  {
    std::size_t slots = 1024;
    while (slots < 2 * keys) slots *= 2;
    if (slots > slots_.size()) slots_.assign(slots, 0);
  }

  bool contains(std::uint64_t key) const { return !slots_.empty() && slots_[key & (slots_.size() - 1)] == key; }
  void add(std::uint64_t key)
  {
    if (!slots_.empty()) slots_[key & (slots_.size() - 1)] = key;
  }

private:
  std::vector<std::uint64_t> slots_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_WORKING_FAILURE_MEMORY_H
