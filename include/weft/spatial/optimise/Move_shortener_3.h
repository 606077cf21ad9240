// SPDX-License-Identifier: GPL-3.0-or-later
//
// What keeps the criteria while vertices are smoothed: moves that break one are shortened until none does.

#ifndef WEFT_SPATIAL_OPTIMISE_MOVE_SHORTENER_3_H
#define WEFT_SPATIAL_OPTIMISE_MOVE_SHORTENER_3_H

#include <weft/internal/Timer.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/criteria/Tolerated_elements_3.h>
#include <weft/spatial/domain/project_on_location_3.h>
#include <weft/spatial/optimise/Smooth_options_3.h>
#include <weft/spatial/restricted/Mesh_relocation_3.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Move_shortener_3
{
public:
  using Point = typename Restricted::Point;
  using Vertex_handle = typename Restricted::Vertex_handle;

  static constexpr double least_part = 0.25; ///< of the way; what would be less stays

  Move_shortener_3(Restricted& mesh, const Criteria_guard_3<Restricted>& guard, Smooth_report_3& report)
      : mesh_(mesh), guard_(guard), report_(report)
  {}

  /// Shortens the moves of the vertices of elements that became bad, then those of the vertices around, until all is
  /// well: at worst when all are back.
  /// \param ids of the vertices that have moved, from `old` to `targets`.
  /// \param parts of the ways that they have gone; updated.
  void take_back(const std::vector<int>& ids, const std::vector<Point>& old, const std::vector<Point>& targets,
                 std::vector<double>& parts)
  {
    place_.assign(mesh_.vertices().size(), none);
    for (std::size_t i = 0; i < ids.size(); ++i) place_[static_cast<std::size_t>(ids[i])] = i;
    auto bad = new_offenders();
    for (int round = 0; !bad.empty(); ++round) {
      const std::vector<std::size_t> shortened = shorten_moves(bad, round, ids, parts);
      if (shortened.empty()) break; // all is as it was
      std::vector<int> moved;
      std::vector<Point> points;
      for (const std::size_t i : shortened) {
        moved.push_back(ids[i]);
        points.push_back(parts[i] > 0 ? part_of_the_way(old[i], targets[i], parts[i], vertex(ids[i])->location())
                                      : old[i]);
      }
      report_.relocations.add_times(relocate(mesh_, moved, points));
      auto next = new_offenders();
      for (const auto& element : bad)
        if (guard_.is_offending(element)) next.push_back(element);
      std::sort(next.begin(), next.end());
      next.erase(std::unique(next.begin(), next.end()), next.end());
      bad.swap(next);
    }
  }

private:
  Vertex_handle vertex(int id) const { return mesh_.vertices()[static_cast<std::size_t>(id)]; }

  auto new_offenders()
  {
    Lap_timer lap;
    auto result = guard_.new_offenders();
    report_.guard_seconds += lap.seconds();
    return result;
  }

  /// The moves that were made shorter, by their places in `ids`.
  std::vector<std::size_t> shorten_moves(const std::vector<Element_3>& bad, int round, const std::vector<int>& ids,
                                         std::vector<double>& parts)
  {
    std::vector<std::size_t> shortened;
    const auto shorten = [&](int id) {
      const std::size_t i = place_[static_cast<std::size_t>(id)];
      if (i == none || parts[i] == 0) return false;
      shortened.push_back(i);
      return true;
    };
    for (const auto& element : bad) {
      bool helps = false;
      for (const int id : element)
        if (id >= 0) helps = shorten(id) || helps;
      if (!helps) shorten_around(element, shorten);
    }
    if (shortened.empty() || round >= most_rounds) // not seen to end so far
      for (const int id : ids) shorten(id);
    std::sort(shortened.begin(), shortened.end());
    shortened.erase(std::unique(shortened.begin(), shortened.end()), shortened.end());
    for (const std::size_t i : shortened) parts[i] = round < most_rounds && parts[i] > least_part ? parts[i] / 2 : 0;
    return shortened;
  }

  /// Ring by ring around an element, until there is something to shorten: what it is like depends on its neighbours,
  /// too.
  template <class Shorten>
  void shorten_around(const Element_3& element, const Shorten& shorten)
  {
    std::vector<int> ring, next;
    for (const int id : element)
      if (id >= 0) ring.push_back(id);
    for (int k = 0; k < most_rings; ++k) {
      next.clear();
      for (const int id : ring) {
        neighbours_.clear();
        mesh_.triangulation().finite_adjacent_vertices(vertex(id), std::back_inserter(neighbours_));
        for (const Vertex_handle w : neighbours_)
          if (w->id() >= 0) next.push_back(w->id());
      }
      std::sort(next.begin(), next.end());
      next.erase(std::unique(next.begin(), next.end()), next.end());
      bool helps = false;
      for (const int id : next) helps = shorten(id) || helps;
      if (helps) return;
      ring.swap(next);
    }
  }

  Point part_of_the_way(const Point& from, const Point& to, double part, const Vertex_location_3& at) const
  {
    return project_on_location(mesh_.oracle(), from + part * (to - from), at).value_or(from);
  }

  static constexpr int most_rounds = 20, most_rings = 4;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  Restricted& mesh_;
  const Criteria_guard_3<Restricted>& guard_;
  Smooth_report_3& report_;
  std::vector<std::size_t> place_; ///< by id: place among the moves
  std::vector<Vertex_handle> neighbours_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_MOVE_SHORTENER_3_H
