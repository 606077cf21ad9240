// SPDX-License-Identifier: GPL-3.0-or-later
//
// Topological disks: every vertex of the surface is to have one of restricted facets around it (Tournois 2009, sec.
// 3.2.1.4). Where it hasn't, the facet at it that is farthest from the surface is refined.

#ifndef WEFT_SPATIAL_REFINE_DISK_MENDER_3_H
#define WEFT_SPATIAL_REFINE_DISK_MENDER_3_H

#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/refine/Acute_refinement_3.h>
#include <weft/spatial/refine/Steiner_batch_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>
#include <weft/spatial/restricted/topological_disk_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <random>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Disk_mender_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Surface_hit = typename Restricted::Surface_hit;
  using Restricted_facet = typename Restricted::Restricted_facet;
  using Crease_edge = typename Restricted::Crease_edge;
  using Measure = Badness_measure_3<Restricted>;

  Disk_mender_3(Restricted& mesh, const Measure& measure, Steiner_batch_3<Restricted>& batch,
                Acute_refinement_3<Restricted>& acute, std::mt19937& random)
      : mesh_(mesh), measure_(measure), batch_(batch), acute_(acute), random_(random)
  {}

  /// Takes the vertices up that there are.
  /// \param settled those whose stars changed in no later version of the mesh are known to have their disks.
  void add_vertices(int settled)
  {
    for (const Vertex_handle v : mesh_.vertices()) undecided_.push_back(mesh_.changed_at(v) >= settled);
  }

  /// To be told when vertices have been inserted.
  void add_new_vertices() { undecided_.resize(mesh_.vertices().size(), true); }

  /// To be told of facets that come or go: whether a vertex has a topological disk hangs on the facets at it alone.
  void set_undecided(const Restricted_facet& f)
  {
    for (int i = 1; i <= 3; ++i)
      if (const int id = Measure::vertex(f, i)->id(); id >= 0) undecided_[static_cast<std::size_t>(id)] = true;
  }

  /// Chooses a Steiner point for each vertex without a disk, of those whose stars changed since they were last seen. To
  /// be called when no facet is bad.
  /// \returns how many there were.
  /// \param choose_facet `choose_facet(facet)` chooses one for a facet.
  template <class Choose_facet>
  std::size_t choose_at_vertices(const Choose_facet& choose_facet)
  {
    std::size_t bad = 0;
    for (std::size_t i = 0; i < undecided_.size(); ++i) {
      if (!undecided_[i]) continue;
      const Vertex_handle v = mesh_.vertices()[i];
      if (v->location().dimension > 2 || has_topological_disk(mesh_, v)) {
        undecided_[i] = false;
        continue;
      }
      ++bad;
      const Restricted_facet* worst = worst_facet_around(v);
      if (worst)
        choose_facet(*worst);
      else if (v->location().dimension == 2)
        choose_beside(v);
    }
    return bad;
  }

  /// The Steiner point of a facet that mends the topology.
  Point steiner_point(const Restricted_facet& f)
  {
    // Below the size floor, where the same failure repeats itself at ever smaller scales: somewhere near.
    Point p =
        f.squared_radius < batch_.squared_floor() ? shaken(f.steiner, std::sqrt(f.squared_radius), f.patch) : f.steiner;
    // A vertex right beside an acute edge and its mirror image leave no room for facets of good shape between them.
    if (batch_.policy().mirrors) mesh_.oracle().attract_to_acute_edge(p, std::sqrt(f.squared_radius));
    return p;
  }

  /// Makes vertices count as changed that haven't been looked at, or have no disk: see `Batch_refiner_3::settle()`.
  void set_changed()
  {
    for (std::size_t i = 0; i < undecided_.size(); ++i)
      if (undecided_[i]) mesh_.set_changed(mesh_.vertices()[i]);
  }

private:
  const Restricted_facet* worst_facet_around(Vertex_handle v) const
  {
    const Restricted_facet* worst = nullptr;
    double error = -1;
    mesh_.visit_facets_at(v, [&](const Restricted_facet& f) {
      const double e = measure_.approximation_error(f);
      if (e <= error) return;
      error = e;
      worst = &f;
    });
    return worst;
  }

  /// A random point of a patch near one of its points: up to 0.4 radii away in each coordinate, before it is projected.
  Point shaken(const Point& p, double radius, int patch)
  {
    const double step = 0.4 * radius;
    const auto random = [&] { return step * (2 * (static_cast<double>(random_()) / 4294967295.0) - 1); };
    const double x = random(), y = random(), z = random(); // in this order, whatever the compiler
    const Surface_hit hit = mesh_.oracle().project_on_patch(p + typename Kernel::Vector_3(x, y, z), patch);
    return hit.patch == patch ? hit.point : p;
  }

  /// For a vertex on a patch without any restricted facet: the surface enters and leaves its Voronoi cell through
  /// facets alone. A second vertex of the patch near by gives the cell edges there.
  Choice_3 choose_beside(Vertex_handle v)
  {
    cells_.clear();
    mesh_.triangulation().incident_cells(v, std::back_inserter(cells_));
    double nearest = HUGE_VAL;
    for (const Cell_handle c : cells_)
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i) != v)
          nearest = (std::min)(nearest, CGAL::to_double(CGAL::squared_distance(c->vertex(i)->point(), v->point())));
    Point p = v->point();
    for (int k = 0; k < 20 && CGAL::to_double(CGAL::squared_distance(p, v->point())) < 0.01 * nearest; ++k)
      p = shaken(v->point(), std::sqrt(nearest), v->location().index); // from outside of a tip, back to the tip
    if (CGAL::to_double(CGAL::squared_distance(p, v->point())) < batch_.squared_floor()) return Choice_3::impossible;
    const Zone_result result = batch_.find(p, mesh_.triangulation().locate(p, v->cell()));
    if (result != Zone_result::found) return batch_.failure(result);
    if (const Crease_edge* e = batch_.encroached_edge()) return acute_.choose(*e, false);
    return batch_.accept(v->location());
  }

  Restricted& mesh_;
  const Measure& measure_;
  Steiner_batch_3<Restricted>& batch_;
  Acute_refinement_3<Restricted>& acute_;
  std::mt19937& random_;
  std::vector<char> undecided_; ///< by vertex, whether its topological disk has to be looked at
  std::vector<Cell_handle> cells_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_DISK_MENDER_3_H
