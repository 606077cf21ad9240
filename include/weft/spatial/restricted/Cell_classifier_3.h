// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a domain makes of new cells of a Delaunay triangulation: their circumcenters, the subdomains that those lie in,
// and the facets whose Voronoi edges meet the boundary, with their farthest crossings (Tournois 2009, sec. 1.1).
//
// Circumcenters are rounded to doubles; what is decided exactly is where the segments between the rounded ones meet the
// boundary. So the labels of any two cells agree with the crossings of the Voronoi edge between them, whatever the
// shape of the cells.
//
// After a sweep of smoothing all cells are new. Neighbours, labels and circumcenters of new cells lie in arrays of
// their own, each cell is visited once to fill them and once to hear of its label, and no records are made of Voronoi
// edges without a crossing, which are most.

#ifndef WEFT_SPATIAL_RESTRICTED_CELL_CLASSIFIER_3_H
#define WEFT_SPATIAL_RESTRICTED_CELL_CLASSIFIER_3_H

#include <weft/internal/parallel_for.h>
#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/mesh/circumcenter_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft::internal {

/// A restricted facet of a spatial Delaunay triangulation.
template <class Triangulation>
struct Restricted_facet_3
{
  typename Triangulation::Cell_handle cell; ///< one of its two cells; null for an unused record
  int index = 0;                            ///< of the vertex of `cell` opposite to it
  int patch = 0;                            ///< on which the Steiner point lies
  int crossings = 0;                        ///< of its Voronoi edge with the boundary
  bool several = false;                     ///< whether they lie on different patches
  int triangle = -1;                        ///< on which the Steiner point lies, see Surface_hit_3
  typename Triangulation::Point steiner;    ///< the farthest of them from the vertices of the facet
  double squared_radius = 0;                ///< of the surface Delaunay ball around it
  int version = 0;                          ///< of the mesh before it was made, see Restricted_delaunay_3::version()
};

/// How often the oracle was asked, and how often it needn't be.
struct Oracle_counts_3
{
  std::size_t segments = 0, locations = 0, skipped = 0;
};

/// \tparam Triangulation a Mesh_triangulation_3.
/// \tparam Oracle a domain oracle, see Polyhedral_oracle_3.h.
template <class Triangulation, class Oracle>
class Cell_classifier_3
{
public:
  using Kernel = typename Oracle::Kernel;
  using Point = typename Kernel::Point_3;
  using Surface_hit = Surface_hit_3<Kernel>;
  using Cell_handle = typename Triangulation::Cell_handle;
  using Restricted_facet = Restricted_facet_3<Triangulation>;

  /// \param oracle has to live as long as this object.
  Cell_classifier_3(const Oracle& oracle, int threads) : oracle_(&oracle), threads_(threads) {}

  /// Sets circumcenters and labels of new cells, whose `id()` it uses. Linear in their number, but for the oracle.
  /// \param cells finite ones, not classified; every other finite cell is.
  void classify(const std::vector<Cell_handle>& cells)
  {
    if (classified_.size() > most_kept) release_memory();
    find_circumcenters(cells);
    list_edges(cells);
    cross_boundary(cells);
    label_cells(cells);
    publish(cells);
  }

  /// The cells of the last call, in an order in which each follows a neighbour that tells its label.
  const std::vector<Cell_handle>& cells() const { return classified_; }

  /// The facets of these cells whose Voronoi edges meet the boundary, without record numbers or versions.
  const std::vector<Restricted_facet>& facets() const { return facets_; }

  int threads() const { return threads_; }

  const Oracle_counts_3& counts() const { return counts_; }
  void add_counts(const Oracle_counts_3& other)
  {
    counts_.segments += other.segments;
    counts_.locations += other.locations;
    counts_.skipped += other.skipped;
  }

private:
  // What lies across a facet of a new cell: the number of another new cell, or one of these.
  static constexpr int old_cell = -1, no_edge = -2; ///< no edge: the facet has a vertex of the box

  static constexpr std::size_t block_size = 256;  ///< edges whose facets are collected together
  static constexpr std::size_t most_kept = 10000; ///< cells for which memory is kept

  /// Most calls are about some dozens of cells, but the first one is about all.
  void release_memory()
  {
    const auto release = [](auto&... vectors) { (std::decay_t<decltype(vectors)>().swap(vectors), ...); };
    release(centers_, labels_, box_, across_, changes_, slots_, blocks_, front_, classified_, facets_);
  }

  void find_circumcenters(const std::vector<Cell_handle>& cells)
  {
    centers_.resize(cells.size());
    labels_.resize(cells.size());
    box_.resize(cells.size());
    for (std::size_t k = 0; k < cells.size(); ++k) cells[k]->set_id(static_cast<int>(k));
    parallel_for(cells.size(), threads_, [&](std::size_t k) {
      const Cell_handle c = cells[k];
      centers_[k] = circumcenter_of_cell_3<Kernel>(c);
      c->set_circumcenter(centers_[k]);
      box_[k] = vertices_of_box(c);
      labels_[k] = box_[k] ? 0 : unknown;
      if constexpr (Oracle::labels_first)
        if (!box_[k]) labels_[k] = oracle_->subdomain(centers_[k]);
    });
    if (Oracle::labels_first) counts_.locations += cells.size();
  }

  /// Every Voronoi edge once, from the new cell that comes first.
  void list_edges(const std::vector<Cell_handle>& cells)
  {
    across_.resize(4 * cells.size());
    changes_.resize(4 * cells.size());
    slots_.clear();
    for (std::size_t k = 0; k < cells.size(); ++k)
      for (std::size_t i = 0; i < 4; ++i) {
        int& n = across_[4 * k + i];
        n = no_edge;
        if ((box_[k] & ~(1u << i)) != 0) continue;
        const Cell_handle other = cells[k]->neighbor(static_cast<int>(i));
        n = other->is_classified() ? old_cell : other->id();
        if (n == old_cell || static_cast<std::size_t>(n) > k) slots_.push_back(4 * k + i);
      }
  }

  /// Asks the oracle about every Voronoi edge. Facets come in the order of the edges, for any number of threads.
  void cross_boundary(const std::vector<Cell_handle>& cells)
  {
    const std::size_t blocks = (slots_.size() + block_size - 1) / block_size;
    if (blocks_.size() < blocks) blocks_.resize(blocks);
    parallel_for(
        blocks, threads_,
        [&](std::size_t b) {
          blocks_[b].clear();
          const std::size_t end = (std::min)(slots_.size(), (b + 1) * block_size);
          for (std::size_t e = b * block_size; e < end; ++e) cross_boundary(cells, slots_[e], blocks_[b]);
        },
        1);
    facets_.clear();
    for (std::size_t b = 0; b < blocks; ++b) facets_.insert(facets_.end(), blocks_[b].begin(), blocks_[b].end());
    counts_.segments += slots_.size();
  }

  void cross_boundary(const std::vector<Cell_handle>& cells, std::size_t slot, std::vector<Restricted_facet>& facets)
  {
    thread_local std::vector<Surface_hit> hits;
    hits.clear();
    const std::size_t k = slot / 4;
    const int i = static_cast<int>(slot % 4), n = across_[slot];
    const Cell_handle c = cells[k];
    const bool is_new = n >= 0;
    const Point &p = centers_[k], &q = is_new ? centers_[static_cast<std::size_t>(n)] : c->neighbor(i)->circumcenter();
    const bool forwards = !(q < p); // the same answer from either cell
    const Point &from = forwards ? p : q, &to = forwards ? q : p;
    int& change = changes_[slot];
    if constexpr (Oracle::labels_first) {
      const int at_p = labels_[k], at_q = is_new ? labels_[static_cast<std::size_t>(n)] : c->neighbor(i)->subdomain();
      change = oracle_->intersect(from, to, forwards ? at_p : at_q, forwards ? at_q : at_p, hits);
    } else {
      change = oracle_->intersect(from, to, hits);
    }
    if (is_new)
      for (std::size_t j = 4 * static_cast<std::size_t>(n); j < 4 * static_cast<std::size_t>(n) + 4; ++j)
        if (across_[j] == static_cast<int>(k)) changes_[j] = change;
    if (hits.empty()) return;
    facets.emplace_back();
    Restricted_facet& f = facets.back();
    f.cell = c;
    f.index = i;
    f.crossings = static_cast<int>(hits.size());
    const Point& a = c->vertex(i == 0 ? 1 : 0)->point();
    for (const auto& hit : hits) {
      const double r = CGAL::to_double(CGAL::squared_distance(hit.point, a));
      f.several |= hit.patch != hits.front().patch;
      if (r <= f.squared_radius) continue;
      f.squared_radius = r;
      f.steiner = hit.point;
      f.patch = hit.patch;
      f.triangle = hit.triangle;
    }
  }

  /// A cell lies in the subdomain of a neighbour, but for what the Voronoi edge between them crosses: from the old
  /// cells and those of the box inwards.
  void label_cells(const std::vector<Cell_handle>& cells)
  {
    front_.clear();
    if (Oracle::labels_first) {
      for (std::size_t k = 0; k < cells.size(); ++k) front_.push_back(k);
      return;
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      for (std::size_t i = 0; i < 4 && labels_[k] == unknown; ++i)
        if (across_[4 * k + i] == old_cell)
          labels_[k] = cells[k]->neighbor(static_cast<int>(i))->subdomain() ^ changes_[4 * k + i];
      if (labels_[k] != unknown) front_.push_back(k);
    }
    for (std::size_t at = 0; at < front_.size(); ++at) {
      const std::size_t k = front_[at];
      for (std::size_t i = 0; i < 4; ++i) {
        const int n = across_[4 * k + i];
        if (n < 0 || labels_[static_cast<std::size_t>(n)] != unknown) continue;
        labels_[static_cast<std::size_t>(n)] = labels_[k] ^ changes_[4 * k + i];
        front_.push_back(static_cast<std::size_t>(n));
      }
    }
  }

  void publish(const std::vector<Cell_handle>& cells)
  {
    classified_.clear();
    for (const std::size_t k : front_) classified_.push_back(cells[k]);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      cells[k]->set_subdomain(labels_[k]);
      cells[k]->set_classified(true);
    }
  }

  /// Bit i for vertex i.
  static unsigned char vertices_of_box(Cell_handle c)
  {
    unsigned bits = 0;
    for (int i = 0; i < 4; ++i) bits |= unsigned(c->vertex(i)->location().dimension < 0) << i;
    return static_cast<unsigned char>(bits);
  }

  static constexpr int unknown = -1;

  const Oracle* oracle_;
  int threads_;
  // By new cell:
  std::vector<Point> centers_;
  std::vector<int> labels_;
  std::vector<unsigned char> box_; ///< which of its vertices are those of the box
  // By new cell and facet, at the slot 4 * cell + facet:
  std::vector<int> across_, changes_; ///< what the Voronoi edge makes of the label
  std::vector<std::size_t> slots_;    ///< of the edges to look at
  std::vector<std::vector<Restricted_facet>> blocks_;
  std::vector<std::size_t> front_;
  std::vector<Cell_handle> classified_;
  std::vector<Restricted_facet> facets_;
  Oracle_counts_3 counts_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_CELL_CLASSIFIER_3_H
