// SPDX-License-Identifier: GPL-3.0-or-later
//
// A program of CGAL's Mesh_3 with one line changed: weft makes the mesh.
//
//   cgal_mesh_domain    writes out.mesh

#include <weft/make_c3t3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>

#include <cmath>
#include <fstream>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<K>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

double torus(const K::Point_3& p)
{
  const double q = std::hypot(p.x(), p.y()) - 1;
  return q * q + p.z() * p.z() - 0.16;
}

int main()
{
  namespace parameters = CGAL::parameters;
  const Domain domain = Domain::create_implicit_mesh_domain(torus, K::Sphere_3(CGAL::ORIGIN, 4));
  const Criteria criteria(parameters::facet_angle = 30, parameters::facet_size = 0.2, parameters::facet_distance = 0.02,
                          parameters::cell_radius_edge_ratio = 2, parameters::cell_size = 0.2);
  const C3t3 c3t3 = weft::make_mesh_3<C3t3>(domain, criteria); // was CGAL::make_mesh_3
  std::ofstream out("out.mesh");
  c3t3.output_to_medit(out);
}
