// SPDX-License-Identifier: GPL-3.0-or-later
//
// The restricted facets of a triangulation that changes, in records with numbers that cells know them by; and while it
// doesn't change, those around every vertex.

#ifndef WEFT_SPATIAL_RESTRICTED_FACET_RECORDS_3_H
#define WEFT_SPATIAL_RESTRICTED_FACET_RECORDS_3_H

#include <weft/spatial/restricted/Cell_classifier_3.h>

#include <cstddef>
#include <vector>

namespace weft::internal {

/// Records are used again: a facet is known by its record's number and its version together.
/// \tparam Triangulation a Mesh_triangulation_3.
template <class Triangulation>
class Facet_records_3
{
public:
  using Cell_handle = typename Triangulation::Cell_handle;
  using Restricted_facet = Restricted_facet_3<Triangulation>;

  /// \param patches how many are known; others may turn up.
  explicit Facet_records_3(std::size_t patches) : of_patch_(patches, 0) {}

  /// All records; those with a null cell are unused.
  const std::vector<Restricted_facet>& all() const { return records_; }

  /// The facet opposite to vertex i of c, or null.
  const Restricted_facet* find(Cell_handle c, int i) const
  {
    const int record = c->facet_record(i);
    return record < 0 ? nullptr : &records_[static_cast<std::size_t>(record)];
  }

  /// How many there are whose Steiner point lies on a patch.
  int number_on(int patch) const
  {
    const auto p = static_cast<std::size_t>(patch);
    return p < of_patch_.size() ? of_patch_[p] : 0;
  }

  /// Numbers of the records made by the last call of `add()`.
  const std::vector<int>& newest() const { return newest_; }

  /// Gives facets records, free ones first.
  void add(const std::vector<Restricted_facet>& facets, int version)
  {
    newest_.clear();
    ++changes_;
    for (const Restricted_facet& f : facets) {
      auto record = static_cast<int>(records_.size());
      if (free_.empty()) {
        records_.push_back(f);
      } else {
        record = free_.back();
        free_.pop_back();
        records_[static_cast<std::size_t>(record)] = f;
      }
      set_version(record, version);
      newest_.push_back(record);
      const auto patch = static_cast<std::size_t>(f.patch);
      if (patch >= of_patch_.size()) of_patch_.resize(patch + 1, 0); // found only now
      ++of_patch_[patch];
      const Cell_handle c = f.cell, n = c->neighbor(f.index);
      c->set_facet_record(f.index, record);
      n->set_facet_record(n->index(c), record);
    }
  }

  void set_version(int record, int version) { records_[static_cast<std::size_t>(record)].version = version; }

  /// Forgets the facet opposite to vertex i of c, if there is one.
  void remove(Cell_handle c, int i)
  {
    const int record = c->facet_record(i);
    if (record < 0) return;
    ++changes_;
    const Cell_handle n = c->neighbor(i);
    n->set_facet_record(n->index(c), -1);
    c->set_facet_record(i, -1);
    Restricted_facet& f = records_[static_cast<std::size_t>(record)];
    f.cell = Cell_handle();
    --of_patch_[static_cast<std::size_t>(f.patch)];
    free_.push_back(record);
  }

  /// The same for all facets of a cell.
  void remove(Cell_handle c)
  {
    for (int i = 0; i < 4; ++i) remove(c, i);
  }

  /// Forgets all facets, when the cells are gone.
  void clear()
  {
    records_.clear();
    free_.clear();
    of_patch_.assign(of_patch_.size(), 0);
    ++changes_;
  }

  /// When the triangulation was copied.
  /// \param copies of the cells, by their ids.
  void set_cells(const std::vector<Cell_handle>& copies)
  {
    for (Restricted_facet& f : records_)
      if (f.cell != Cell_handle()) f.cell = copies[static_cast<std::size_t>(f.cell->id())];
  }

  // ---- around vertices

  /// Lists the facets at every vertex, which holds until facets change. It pays where many vertices are looked at: no
  /// cells have to be walked through then. Linear.
  /// \param vertices how many there are.
  void list_stars(std::size_t vertices)
  {
    if (has_stars()) return;
    first_.assign(vertices + 1, 0);
    visit_corners([this](std::size_t v, int) { ++first_[v + 1]; });
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    stars_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    visit_corners([&](std::size_t v, int record) { stars_[next[v]++] = record; });
    listed_ = changes_;
  }

  /// Whether `visit_star()` may be called.
  bool has_stars() const { return listed_ == changes_; }

  /// Calls `visit(facet)` for each facet at the vertex with an id.
  template <class Visit>
  void visit_star(int id, const Visit& visit) const
  {
    const auto v = static_cast<std::size_t>(id);
    for (std::size_t k = first_[v]; k < first_[v + 1]; ++k) visit(records_[static_cast<std::size_t>(stars_[k])]);
  }

private:
  /// Calls `visit(id of a vertex, record)` for the corners of all facets.
  template <class Visit>
  void visit_corners(const Visit& visit) const
  {
    for (std::size_t r = 0; r < records_.size(); ++r)
      if (records_[r].cell != Cell_handle())
        for (int i = 1; i <= 3; ++i)
          visit(static_cast<std::size_t>(records_[r].cell->vertex((records_[r].index + i) & 3)->id()),
                static_cast<int>(r));
  }

  std::vector<Restricted_facet> records_;
  std::vector<int> free_, newest_, of_patch_;
  std::vector<std::size_t> first_;       ///< of each vertex in `stars_`
  std::vector<int> stars_;               ///< records
  std::size_t changes_ = 1, listed_ = 0; ///< the latter: at which of the former stars were listed
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_FACET_RECORDS_3_H
