// SPDX-License-Identifier: GPL-3.0-or-later
//
// The elements that were bad when a guard began, and how bad: they may stay so, but not get worse.

#ifndef WEFT_SPATIAL_CRITERIA_TOLERATED_ELEMENTS_3_H
#define WEFT_SPATIAL_CRITERIA_TOLERATED_ELEMENTS_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <vector>

namespace weft::internal {

/// An element by the ids of its vertices in falling order, filled up with -1.
using Element_3 = std::array<int, 4>;

inline Element_3 sorted_element(Element_3 ids)
{
  std::sort(ids.begin(), ids.end(), [](int a, int b) { return a > b; });
  return ids;
}

template <class Cell_handle>
Element_3 element_of_cell(Cell_handle c)
{
  return sorted_element({c->vertex(0)->id(), c->vertex(1)->id(), c->vertex(2)->id(), c->vertex(3)->id()});
}

/// \param f a Restricted_facet_3.
template <class Facet>
Element_3 element_of_facet(const Facet& f)
{
  const auto id = [&f](int i) { return f.cell->vertex((f.index + i) & 3)->id(); };
  return sorted_element({id(1), id(2), id(3), -1});
}

/// \param e a Crease_edge_3.
template <class Crease_edge>
Element_3 element_of_edge(const Crease_edge& e)
{
  return sorted_element({e.source->id(), e.target->id(), -1, -1});
}

/// How bad an element is; zeros for a good one.
struct Grade_3
{
  double badness = 0;           ///< ratio of its worst measure to the bound
  double depth = 0, height = 0; ///< squared distances between it and the surface, see Deviation_3
  int astray = 0;               ///< of a boundary facet, vertices that don't lie on the boundary
  double turn = 0; ///< of a boundary facet that is turned away from the surface, see facet_turn_3.h: 1 - cosine

  bool is_bad() const { return badness > 0 || depth > 0 || height > 0 || astray > 0 || turn > 0; }
  bool exceeds(const Grade_3& other) const
  {
    constexpr double slack = 1 + 1e-9;
    return badness > slack * other.badness || depth > slack * other.depth || height > slack * other.height ||
           astray > other.astray || turn > slack * other.turn;
  }
};

/// See the top of the file.
class Tolerated_elements_3
{
public:
  /// Whether an element is bad, and worse than is tolerated.
  bool is_exceeded(const Element_3& e, const Grade_3& grade) const
  {
    if (!grade.is_bad()) return false;
    const auto found = grades_.find(e);
    return found == grades_.end() || grade.exceeds(found->second);
  }

  void tolerate(const Element_3& e, const Grade_3& grade)
  {
    if (is_exceeded(e, grade)) grades_[e] = grade;
  }

  /// To be called when all vertices get new numbers.
  /// \param numbers the new ones by the old ones; -1 for vertices that are gone.
  void renumber(const std::vector<int>& numbers)
  {
    std::map<Element_3, Grade_3> renumbered;
    for (const auto& [element, grade] : grades_) {
      Element_3 ids = element;
      bool exists = true;
      for (int& id : ids) {
        if (id < 0) continue;
        id = numbers[static_cast<std::size_t>(id)];
        exists = exists && id >= 0;
      }
      if (exists) renumbered[sorted_element(ids)] = grade;
    }
    grades_.swap(renumbered);
  }

  /// Tolerates nothing at a vertex any more.
  void forget(int id)
  {
    for (auto i = grades_.begin(); i != grades_.end();)
      i = std::find(i->first.begin(), i->first.end(), id) == i->first.end() ? std::next(i) : grades_.erase(i);
  }

private:
  std::map<Element_3, Grade_3> grades_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_TOLERATED_ELEMENTS_3_H
