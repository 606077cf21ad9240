// SPDX-License-Identifier: GPL-3.0-or-later
// What planar.cpp includes, parsed once.

#include <weft/improve_2.h>
#include <weft/make_mesh_2.h>

#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_hierarchy_2.h>
