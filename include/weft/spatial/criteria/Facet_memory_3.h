// SPDX-License-Identifier: GPL-3.0-or-later
//
// Remembers facets that were found to be good by what depends on their corners and their patch alone. While vertices
// are tried to be taken away or moved, the facets around come back again and again.

#ifndef WEFT_SPATIAL_CRITERIA_FACET_MEMORY_3_H
#define WEFT_SPATIAL_CRITERIA_FACET_MEMORY_3_H

#include <weft/internal/boxes/coordinates_3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace weft::internal {

/// Some of the facets added last: places are by a hash, and each has room for one.
class Facet_memory_3
{
public:
  /// A facet, the same from either side and in whatever order its corners come.
  struct Key
  {
    std::array<Xyz_3, 3> corners; ///< in order
    int patch = -1;
    int inside = 0; ///< the subdomain that the facet looks out of
    std::uint64_t owner = 0;

    bool operator==(const Key& other) const
    {
      return corners == other.corners && patch == other.patch && inside == other.inside && owner == other.owner;
    }
  };

  /// That of the thread that asks.
  static Facet_memory_3& of_thread()
  {
    thread_local Facet_memory_3 memory;
    return memory;
  }

  /// Of a restricted facet with different subdomains on both sides.
  /// \param owner a number of whoever finds facets to be good.
  template <class Facet>
  static Key key(const Facet& f, std::uint64_t owner)
  {
    const auto at = [&](int i) { return xyz(f.cell->vertex((f.index + i) & 3)->point()); };
    Key key{{{at(1), at(2), at(3)}}, f.patch, 0, owner};
    auto& [a, b, c] = key.corners;
    bool is_turned = (f.index & 1) == 0; // the other corner lies on the other side of an odd permutation
    const auto order = [&is_turned](Xyz_3& p, Xyz_3& q) {
      if (!(q < p)) return;
      std::swap(p, q);
      is_turned = !is_turned;
    };
    order(a, b), order(b, c), order(a, b);
    const int here = f.cell->subdomain(), there = f.cell->neighbor(f.index)->subdomain();
    key.inside = 2 * (here != 0 ? here : there) + (is_turned == (here != 0));
    return key;
  }

  bool has(const Key& key) const { return places_[place(key)] == key; }
  void add(const Key& key) { places_[place(key)] = key; }

private:
  static std::size_t place(const Key& key)
  {
    std::uint64_t hash = 0;
    for (const Xyz_3& p : key.corners)
      for (const double x : p) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &x, sizeof bits);
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
      }
    return static_cast<std::size_t>(hash & (size - 1));
  }

  static constexpr std::size_t size = 1 << 13;
  std::vector<Key> places_{size};
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_FACET_MEMORY_3_H
