// SPDX-License-Identifier: GPL-3.0-or-later
//
// What assembling a mesh from elements of any origin has in common in the plane and in space: indices that exist, no
// element twice, points of no element left out, elements oriented alike; and the sentences about what is wrong.

#ifndef WEFT_INTERNAL_RUN_MESH_ASSEMBLER_H
#define WEFT_INTERNAL_RUN_MESH_ASSEMBLER_H

#include <weft/errors.h>
#include <weft/internal/counted.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam Soup an Element_soup_2 or _3.
/// \tparam Imported an Imported_mesh_2 or _3.
template <class Soup, class Imported>
class Mesh_assembler
{
protected:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// By element, those across its sides, and whether they are oriented alike as they are.
  using Neighbours = std::vector<std::vector<std::pair<std::size_t, bool>>>;

  explicit Mesh_assembler(Soup soup) : soup_(std::move(soup)) {}

  // ---- what is wrong

  std::string number_of(std::size_t v) const { return std::to_string(v + soup_.first_number); }

  template <std::size_t N>
  std::string numbers_of(const std::array<std::size_t, N>& vertices) const
  {
    std::string text;
    for (const std::size_t v : vertices) text += (text.empty() ? "" : " ") + number_of(v);
    return text;
  }

  template <std::size_t N>
  [[noreturn]] void refuse(const std::string& name, const std::vector<std::array<std::size_t, N>>& elements,
                           std::size_t e, const std::string& what) const
  {
    const auto& v = elements[e];
    throw Domain_error(name + " " + number_of(e) + " (vertices " + numbers_of(v) + ") " + what, {v.begin(), v.end()},
                       {e});
  }

  void note_dropped(std::size_t n, const std::string& name, const std::string& why)
  {
    if (n > 0) result_.notes.push_back(counted(n, name, name + "s") + " " + why + " left out");
  }

  // ---- checks

  template <std::size_t N>
  void check_indices(const std::vector<std::array<std::size_t, N>>& elements, const std::vector<int>& tags,
                     const std::string& name) const
  {
    if (!tags.empty() && tags.size() != elements.size())
      throw Domain_error("there are " + counted(elements.size(), name, name + "s") + " and " +
                             counted(tags.size(), "tag", "tags") + " of them",
                         {}, {});
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (const std::size_t v : elements[e])
        if (v >= soup_.points.size())
          throw Domain_error(name + " " + number_of(e) + " has the vertex " + number_of(v) + ", which there isn't", {v},
                             {e});
  }

  void check_corner_indices() const
  {
    for (const std::size_t v : soup_.corners)
      if (v >= soup_.points.size())
        throw Domain_error("there is no vertex " + number_of(v) + " to be a corner", {v}, {});
  }

  /// No element has a vertex twice or is there twice.
  /// \param check `check(e)` is called with the number of each element that has no vertex twice.
  template <std::size_t N, class Check>
  void check_repetitions(const std::vector<std::array<std::size_t, N>>& elements, const std::string& name,
                         const Check& check) const
  {
    std::vector<std::pair<std::array<std::size_t, N>, std::size_t>> keys;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      auto key = elements[e];
      std::sort(key.begin(), key.end());
      if (std::adjacent_find(key.begin(), key.end()) != key.end()) refuse(name, elements, e, "has a vertex twice");
      check(e);
      keys.emplace_back(key, e);
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 1; i < keys.size(); ++i)
      if (keys[i - 1].first == keys[i].first)
        refuse(name, elements, keys[i].second,
               "is there twice: it has the vertices of " + name + " " + number_of(keys[i - 1].second));
  }

  // ---- points

  /// Gives the points of elements numbers, in their order, and notes the others.
  /// \returns the number by point, `none` for the others.
  template <std::size_t N>
  std::vector<std::size_t> number_points(const std::vector<std::array<std::size_t, N>>& elements,
                                         const std::string& name)
  {
    std::vector<std::size_t> place(soup_.points.size(), none);
    for (const auto& element : elements)
      for (const std::size_t v : element) place[v] = 0;
    auto& origin = result_.point_origin;
    for (std::size_t v = 0; v < place.size(); ++v) {
      if (place[v] == none) continue;
      place[v] = origin.size();
      origin.push_back(v);
    }
    if (const std::size_t dropped = place.size() - origin.size(); dropped > 0) {
      const auto first = static_cast<std::size_t>(std::find(place.begin(), place.end(), none) - place.begin());
      result_.notes.push_back(counted(dropped, "vertex", "vertices") + " of no " + name + " left out, the first is " +
                              number_of(first));
    }
    return place;
  }

  // ---- orientation

  /// Turns elements so that neighbours agree and the measure of every part that hangs together is positive.
  /// \param measure `measure(e)` is the signed area or volume of an element as it is.
  /// \param turn `turn(e)` turns it over in the list.
  /// \returns for each element whether it was left as it was (1) or turned (-1).
  template <class Measure, class Turn>
  std::vector<signed char> orient(const Neighbours& neighbours, const std::string& name, const Measure& measure,
                                  const Turn& turn) const
  {
    std::vector<signed char> sense(neighbours.size(), 0);
    for (std::size_t seed = 0; seed < sense.size(); ++seed)
      if (sense[seed] == 0) orient_part(seed, neighbours, name, measure, turn, sense);
    return sense;
  }

  // ---- corners

  /// Corners that may be ones, once each.
  /// \param may_be by point.
  void take_corners(std::vector<char> may_be, const std::string& why_not)
  {
    std::size_t dropped = 0;
    for (const std::size_t v : soup_.corners) {
      if (v == none || !may_be[v]) {
        ++dropped;
        continue;
      }
      result_.mesh.corners.push_back(v);
      may_be[v] = false;
    }
    note_dropped(dropped, "corner", why_not);
  }

  Soup soup_;
  Imported result_;

private:
  template <class Measure, class Turn>
  void orient_part(std::size_t seed, const Neighbours& neighbours, const std::string& name, const Measure& measure,
                   const Turn& turn, std::vector<signed char>& sense) const
  {
    std::vector<std::size_t> part = {seed};
    sense[seed] = 1;
    double sum = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const std::size_t e = part[k];
      sum += sense[e] * measure(e);
      for (const auto& [other, agree] : neighbours[e]) {
        const auto wanted = static_cast<signed char>(agree ? sense[e] : -sense[e]);
        if (sense[other] == 0) {
          sense[other] = wanted;
          part.push_back(other);
        } else if (sense[other] != wanted) {
          throw Domain_error("the " + name + "s can't be oriented alike: " + name + "s " + number_of(e) + " and " +
                                 number_of(other) + " contradict each other",
                             {}, {e, other});
        }
      }
    }
    for (const std::size_t e : part) {
      if (sum < 0) sense[e] = static_cast<signed char>(-sense[e]);
      if (sense[e] < 0) turn(e);
    }
  }
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_RUN_MESH_ASSEMBLER_H
