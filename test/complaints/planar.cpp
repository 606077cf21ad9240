// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mistakes in the plane, one in each case, and what the compiler should say first. See check.cmake.

#include "planar.h"

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cdt = weft::Mesh_triangulation_2<K>;

void mistake()
{
#if CASE == 1
  Cdt cdt;
  weft::make_mesh_2(cdt, 0.1);
  weft::make_mesh_2(cdt, 1, weft::Mesh_options_2());
  weft::relax_2(cdt, 0.1f);
  weft::make_mesh_2(cdt, [](const K::Point_2& p) { return p.x() + 1; });
  CGAL::Constrained_triangulation_plus_2<Cdt> polylines;
  weft::make_mesh_2(polylines, 0.1);
#endif

#if CASE == 2 // weft: the triangulation lacks weft's bases
  CGAL::Constrained_Delaunay_triangulation_2<K> cdt;
  weft::make_mesh_2(cdt, 0.1);
#endif

#if CASE == 3 // weft: Triangulation_hierarchy_2 would lose its layers
  CGAL::Triangulation_hierarchy_2<Cdt> cdt;
  weft::make_mesh_2(cdt, 0.1);
#endif

#if CASE == 4 // weft: Triangulation_hierarchy_2 would lose its layers
  CGAL::Constrained_triangulation_plus_2<CGAL::Triangulation_hierarchy_2<Cdt>> cdt;
  weft::relax_2(cdt, weft::Uniform_sizing<>(0.1));
#endif

#if CASE == 5 // weft: not a CGAL::Constrained_Delaunay_triangulation_2
  CGAL::Delaunay_triangulation_2<K> triangulation;
  weft::make_mesh_2(triangulation, 0.1);
#endif

#if CASE == 6 // this one can't be called with such a point
  Cdt cdt;
  weft::make_mesh_2(cdt, [](const K::Point_3& p) { return p.x(); });
#endif

#if CASE == 7 // weft: a sizing field is called as const
  Cdt cdt;
  double size = 0;
  weft::make_mesh_2(cdt, [size](const K::Point_2&) mutable { return size += 1; });
#endif

#if CASE == 8 // weft: a sizing field returns a number
  Cdt cdt;
  weft::relax_2(cdt, [](const K::Point_2& p) { return p; });
#endif

#if CASE == 9 // weft: improve_2() takes a weft::Triangle_mesh_2<K>
  Cdt cdt;
  const auto [mesh, report] = weft::improve_2(cdt);
#endif
}
