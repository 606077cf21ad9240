// SPDX-License-Identifier: GPL-3.0-or-later
// What spatial.cpp includes, parsed once.

#include <weft/improve_3.h>
#include <weft/make_c3t3.h>
#include <weft/mesh_surface_3.h>
#include <weft/spatial/domain/Implicit_oracle_3.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
