// SPDX-License-Identifier: GPL-3.0-or-later
//
// A domain of two materials that no surface describes: a ball by its function, cut in two by a labelling.
//
//   implicit_domain    writes ball.vtu and halves.vtu

#include <weft/IO/write_mesh_3.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/domain/Implicit_oracle_3.h>
#include <weft/spatial/domain/Labelled_oracle_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <iostream>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;

int main()
{
  const CGAL::Bbox_3 box(-1.1, -1.1, -1.1, 1.1, 1.1, 1.1);
  weft::Criteria_3<K> criteria;
  criteria.size = 0.3;
  criteria.approximation = 0.01;

  const auto ball = [](const K::Point_3& p) { return p.x() * p.x() + p.y() * p.y() + p.z() * p.z() - 1; };
  const weft::Implicit_oracle_3<K, decltype(ball)> whole(ball, box); // inside, where it is negative
  weft::IO::write_mesh_3("ball.vtu", weft::tetrahedral_mesh(weft::make_mesh_3(whole, criteria).restricted));

  const auto label = [&](const K::Point_3& p) { return ball(p) >= 0 ? 0 : p.x() < 0.2 ? 1 : 2; };
  const weft::Labelled_oracle_3<K, decltype(label)> halves(label, box, 3); // labels 0, 1 and 2
  criteria.subdomains[2].size = 0.15;
  const auto result = weft::make_mesh_3(halves, criteria);
  std::cout << result.report;
  weft::IO::write_mesh_3("halves.vtu", weft::tetrahedral_mesh(result.restricted));
}
