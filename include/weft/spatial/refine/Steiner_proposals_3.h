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

/// Looks for conflict zones while others do, whatever is claimed, and keeps the cells in mind whose claims would count.
template <class Restricted>
struct Zones_aside_3
{
  const typename Restricted::Triangulation& tr;
  Handle_marks &marks, &is_seen;
  std::vector<typename Restricted::Cell_handle>& seen;

  Zone_result operator()(const typename Restricted::Point& p, typename Restricted::Cell_handle start,
                         typename Restricted::Zone& zone) const
  {
    const Zone_result result = find_conflict_zone_aside(tr, p, start, zone, marks);
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

  /// How many of so many elements to look at together: of few elements, most are near each other.
  static std::size_t block(std::size_t elements)
  {
    return (std::min)(most_together, (std::max)(least_together, elements / 16));
  }

  /// Looks for the points of n elements that come next.
  /// \param is_wanted called with the place of an element, by one thread.
  /// \param look `look(k, find, zone, candidates)` finds the zone for an element by `find` and returns its result.
  template <class Is_wanted, class Look>
  void look_ahead(std::size_t n, const Is_wanted& is_wanted, const Look& look)
  {
    wanted_.clear();
    places_.assign(n, none);
    if (threads_ == 1) return;
    for (std::size_t k = 0; k < n; ++k) {
      if (!is_wanted(k)) continue;
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
          p.result = look(wanted_[i], Zones_aside_3<Restricted>{mesh_.triangulation(), marks, is_seen, p.seen}, p.zone,
                          p.candidates);
        },
        1);
  }

  /// What was found for an element; null if nothing was looked for.
  Proposal* find(std::size_t k) { return places_[k] == none ? nullptr : &proposals_[places_[k]]; }

private:
  static constexpr std::size_t most_together = 64, least_together = 8, none = static_cast<std::size_t>(-1);

  const Restricted& mesh_;
  int threads_;
  std::vector<std::size_t> wanted_, places_; ///< which elements have a proposal; of each of them, where
  std::vector<Proposal> proposals_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_STEINER_PROPOSALS_3_H
