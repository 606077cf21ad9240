// SPDX-License-Identifier: GPL-3.0-or-later
//
// The restricted facets of a triangulation that changes, in records with numbers that cells know them by, and in a list
// for each vertex.

#ifndef WEFT_SPATIAL_RESTRICTED_FACET_RECORDS_3_H
#define WEFT_SPATIAL_RESTRICTED_FACET_RECORDS_3_H

#include <weft/spatial/restricted/Cell_classifier_3.h>

#include <array>
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
    for (const Restricted_facet& f : facets) {
      auto record = static_cast<int>(records_.size());
      if (free_.empty()) {
        records_.push_back(f);
        next_.emplace_back();
      } else {
        record = free_.back();
        free_.pop_back();
        records_[static_cast<std::size_t>(record)] = f;
      }
      link(record);
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
    const Cell_handle n = c->neighbor(i);
    n->set_facet_record(n->index(c), -1);
    c->set_facet_record(i, -1);
    Restricted_facet& f = records_[static_cast<std::size_t>(record)];
    unlink(record);
    f.cell = Cell_handle();
    --of_patch_[static_cast<std::size_t>(f.patch)];
    free_.push_back(record);
  }

  /// The same for all facets of a cell.
  void remove(Cell_handle c)
  {
    for (int i = 0; i < 4; ++i) remove(c, i);
  }

  /// Forgets all facets, when the cells and vertices are gone.
  void clear()
  {
    records_.clear();
    next_.clear();
    free_.clear();
    of_patch_.assign(of_patch_.size(), 0);
  }

  /// When the triangulation was copied, with what its vertices know.
  /// \param copies of the cells, by their ids.
  void set_cells(const std::vector<Cell_handle>& copies)
  {
    for (Restricted_facet& f : records_)
      if (f.cell != Cell_handle()) f.cell = copies[static_cast<std::size_t>(f.cell->id())];
  }

  /// Calls `visit(facet)` for each facet at a vertex, the newest first.
  template <class Visit>
  void visit_star(typename Triangulation::Vertex_handle v, const Visit& visit) const
  {
    for (int r = v->first_facet(); r >= 0;) {
      const Restricted_facet& f = records_[static_cast<std::size_t>(r)];
      r = next_[static_cast<std::size_t>(r)][place(f, v)];
      visit(f);
    }
  }

private:
  using Vertex_handle = typename Triangulation::Vertex_handle;

  static Vertex_handle corner(const Restricted_facet& f, std::size_t k)
  {
    return f.cell->vertex((f.index + 1 + static_cast<int>(k)) & 3);
  }
  /// Which corner of a facet a vertex is.
  static std::size_t place(const Restricted_facet& f, Vertex_handle v)
  {
    return corner(f, 0) == v ? 0 : corner(f, 1) == v ? 1 : 2;
  }

  /// Adds a facet to the lists of its corners.
  void link(int record)
  {
    const Restricted_facet& f = records_[static_cast<std::size_t>(record)];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vertex_handle v = corner(f, k);
      next_[static_cast<std::size_t>(record)][k] = v->first_facet();
      v->set_first_facet(record);
    }
  }

  void unlink(int record)
  {
    const Restricted_facet& f = records_[static_cast<std::size_t>(record)];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vertex_handle v = corner(f, k);
      const int after = next_[static_cast<std::size_t>(record)][k];
      int r = v->first_facet();
      if (r == record) {
        v->set_first_facet(after);
        continue;
      }
      for (;;) {
        int& next = next_[static_cast<std::size_t>(r)][place(records_[static_cast<std::size_t>(r)], v)];
        if (next == record) {
          next = after;
          break;
        }
        r = next;
      }
    }
  }

  std::vector<Restricted_facet> records_;
  std::vector<std::array<int, 3>> next_; ///< by record, for each corner the next facet at it; -1 at the end
  std::vector<int> free_, newest_, of_patch_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_FACET_RECORDS_3_H
