// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mistakes in space, one in each case, and what the compiler should say first. See check.cmake.

#include "spatial.h"

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = K::Point_3;
using Soup = weft::Polygon_soup_3<K>;
using Domain = CGAL::Labeled_mesh_domain_3<K>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;

/// All that is known of a ball by its labels, and all that an oracle answers beyond that.
struct Ball : weft::Domain_by_labels_3<Ball, K>
{
  Ball() : weft::Domain_by_labels_3<Ball, K>(CGAL::Bbox_3(-2, -2, -2, 2, 2, 2)) {}
  int label(const Point& p) const { return CGAL::squared_distance(p, Point(0, 0, 0)) < 1; }
  int patch(int, int, const Point&, const Point&) const { return 0; }
};

/// It and what it lacks.
struct Complete_ball : Ball
{
  static constexpr bool is_thread_safe = true;
  int number_of_patches() const { return 1; }
};

/// Has only the `intersect()` for oracles without `labels_first`.
struct Ball_without_labels : Complete_ball
{
  int intersect(const Point& p, const Point& q, std::vector<weft::Surface_hit_3<K>>& hits) const
  {
    return Complete_ball::intersect(p, q, hits);
  }
};

struct Beginning
{
  using Kernel = K;
  int subdomain(const Point&) const { return 1; }
};

void mistake(const Soup& soup, const weft::Criteria_3<K>& criteria)
{
#if CASE == 1
  const Complete_ball ball;
  const auto [mesh, report] = weft::make_mesh_3(ball, criteria);
  weft::make_mesh_3(ball, {}, weft::Mesh_options_3::refinement());
#endif

#if CASE == 2 // weft: the oracle lacks `static constexpr bool is_thread_safe`
  const Ball ball;
  const auto [mesh, report] = weft::make_mesh_3(ball, criteria);
  weft::tetrahedral_mesh(mesh);
#endif

#if CASE == 3 // weft: the oracle lacks `int intersect(const Point& p, const Point& q, int at_p, int at_q,
  const Ball_without_labels ball;
  weft::make_mesh_3(ball, criteria);
#endif

#if CASE == 4 // weft: the oracle lacks `static constexpr bool is_thread_safe`
  const Beginning domain;
  weft::make_mesh_3(domain, criteria);
#endif

#if CASE == 5 // which must not be a temporary
  const auto [mesh, report] = weft::make_mesh_3(weft::Polyhedral_oracle_3<K>(soup, 60.), criteria);
  weft::tetrahedral_mesh(mesh);
#endif

#if CASE == 6 // weft: this is no domain oracle
  const auto [mesh, report] = weft::make_mesh_3(soup, criteria);
#endif

#if CASE == 7 // weft: this is no domain oracle
  const auto [mesh, report] = weft::make_mesh_3(weft::piecewise_smooth_complex(soup), criteria);
  weft::tetrahedral_mesh(mesh);
#endif

#if CASE == 8 // weft: the criteria aren't a weft::Criteria_3 with the oracle's kernel
  const weft::Polyhedral_oracle_3<K> domain(soup, 60.);
  const auto [mesh, report] = weft::make_mesh_3(domain, 0.1);
#endif

#if CASE == 9 // weft: a length is a number, or is called as const with a point
  weft::Criteria_3<K> own = criteria;
  own.size = [](const K::Point_2& p) { return p.x(); };
#endif

#if CASE == 10 // weft: spatial meshes need a kernel with exact predicates and coordinates of type double
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  const weft::Polygon_soup_3<Exact> exact;
  const weft::Polyhedral_oracle_3<Exact> domain(exact, 60.);
#endif

#if CASE == 11 // weft: mesh_surface_3() takes what piecewise_smooth_complex(surface) returns
  const auto result = weft::mesh_surface_3(soup, criteria);
#endif

#if CASE == 12 // weft: the criteria aren't a weft::Criteria_3 with the surface's kernel
  const auto result = weft::mesh_surface_3(weft::piecewise_smooth_complex(soup), 0.1);
#endif

#if CASE == 13 // weft: improve_3() takes a weft::Tetrahedral_mesh_3<K>
  const C3t3 c3t3;
  const auto [mesh, report] = weft::improve_3(c3t3);
#endif

#if CASE == 14 // weft: this is no domain oracle
  const weft::Tetrahedral_mesh_3<K> given;
  const auto [mesh, report] = weft::improve_3(given, weft::piecewise_smooth_complex(soup), {});
#endif

#if CASE == 15 // weft: make_mesh_3<C3t3>() takes a model of CGAL's MeshDomain_3
  const CGAL::Mesh_criteria_3<Triangulation> own(CGAL::parameters::cell_size = 0.2);
  weft::make_mesh_3<C3t3>(soup, own);
#endif

#if CASE == 16 // weft: make_mesh_3<C3t3>() takes a model of CGAL's MeshCriteria_3
  const Domain domain = Domain::create_implicit_mesh_domain([](const Point& p) { return p.x(); }, K::Sphere_3());
  weft::make_mesh_3<C3t3>(domain, criteria);
#endif
}
