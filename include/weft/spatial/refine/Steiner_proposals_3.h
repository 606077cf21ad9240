// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steiner points of the next bad elements of a batch, found ahead by several threads. While a batch is chosen, nothing
// but the claims changes (Tournois 2009, sec. 3.2.1.4): what is found without regard to them is what would be found
// when it is the turn of the element, unless something that was looked at is claimed by then.

#ifndef WEFT_SPATIAL_REFINE_STEINER_PROPOSALS_3_H
#define WEFT_SPATIAL_REFINE_STEINER_PROPOSALS_3_H

#include <weft/internal/parallel_for.h>
#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/restricted/Handle_marks.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Looks for conflict zones; `claimed` if they touch those of a batch.
template <class Restricted>
struct Zones_between_claims_3
{
  const typename Restricted::Triangulation& tr;
  int batch;

  Zone_result operator()(const typename Restricted::Point& p, typename Restricted::Cell_handle start,
                         typename Restricted::Zone& zone) const
  {
    return find_conflict_zone(tr, p, start, batch, zone);
  }
};

/// The same while others look, too; keeps the cells in mind whose claims would count.
template <class Restricted>
struct Zones_aside_3
{
  const typename Restricted::Triangulation& tr;
  int batch;
  Handle_marks &marks, &is_seen;
  std::vector<typename Restricted::Cell_handle>& seen;

  Zone_result operator()(const typename Restricted::Point& p, typename Restricted::Cell_handle start,
                         typename Restricted::Zone& zone) const
  {
    const Zone_result result = find_conflict_zone_aside(tr, p, start, batch, zone, marks);
    if (is_seen.add(start, 1)) seen.push_back(start);
    for (const auto c : zone.cells)
      if (is_seen.add(c, 1)) seen.push_back(c);
    return result;
  }
};

/// See the top of the file.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Steiner_proposals_3
{
public:
  using Zone = typename Restricted::Zone;
  using Cell_handle = typename Restricted::Cell_handle;

  struct Proposal
  {
    Zone_result result;
    Zone zone;
    std::size_t candidates;        ///< tried for it
    std::vector<Cell_handle> seen; ///< if one of them is claimed, the result is `claimed`

    bool is_claimed(int batch) const
    {
      return std::any_of(seen.begin(), seen.end(), [batch](Cell_handle c) { return c->batch() == batch; });
    }
  };

  /// \param threads with one nothing is looked for ahead.
  Steiner_proposals_3(const Restricted& mesh, int threads) : mesh_(mesh), threads_(threads) {}

  static constexpr std::size_t block_size = 128; ///< elements that are looked at together

  /// Looks for the points of n elements that come next, but for those near to others of them, which will mostly find
  /// their zones claimed.
  /// \param cell_of `cell_of(k)` is the cell of an element, null if nothing is to be looked for.
  /// \param look `look(k, find, zone, candidates)` finds the zone for an element by `find` and returns its result.
  template <class Cell_of, class Look>
  void look_ahead(std::size_t n, int batch, const Cell_of& cell_of, const Look& look)
  {
    wanted_.clear();
    places_.assign(n, none);
    if (threads_ == 1) return;
    taken_.clear();
    for (std::size_t k = 0; k < n; ++k) {
      if (const Cell_handle c = cell_of(k); c == Cell_handle() || !take_around(c)) continue;
      places_[k] = wanted_.size();
      wanted_.push_back(k);
    }
    if (proposals_.size() < wanted_.size()) proposals_.resize(wanted_.size());
    parallel_for(
        wanted_.size(), threads_,
        [&](std::size_t i) {
          thread_local Handle_marks marks, is_seen;
          Proposal& p = proposals_[i];
          p.candidates = 0;
          p.seen.clear();
          is_seen.clear();
          p.result = look(wanted_[i], Zones_aside_3<Restricted>{mesh_.triangulation(), batch, marks, is_seen, p.seen},
                          p.zone, p.candidates);
        },
        1);
  }

  /// What was found for an element; null if nothing was looked for.
  Proposal* find(std::size_t k) { return places_[k] == none ? nullptr : &proposals_[places_[k]]; }

private:
  /// Takes the cells around one unless some of them are taken already.
  bool take_around(Cell_handle c)
  {
    around_.assign(1, c);
    is_around_.clear();
    is_around_.add(c, 1);
    if (taken_.get(c) != Handle_marks::none) return false;
    for (std::size_t ring = 0, first = 0; ring < rings; ++ring)
      for (const std::size_t end = around_.size(); first < end; ++first)
        for (int i = 0; i < 4; ++i) {
          const Cell_handle n = around_[first]->neighbor(i);
          if (!is_around_.add(n, 1)) continue;
          if (taken_.get(n) != Handle_marks::none) return false;
          around_.push_back(n);
        }
    for (const Cell_handle n : around_) taken_.add(n, 1);
    return true;
  }

  static constexpr std::size_t rings = 3, none = static_cast<std::size_t>(-1);

  const Restricted& mesh_;
  int threads_;
  std::vector<std::size_t> wanted_, places_; ///< which elements have a proposal; of each of them, where
  std::vector<Proposal> proposals_;
  std::vector<Cell_handle> around_;
  Handle_marks taken_, is_around_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_STEINER_PROPOSALS_3_H
