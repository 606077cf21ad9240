// SPDX-License-Identifier: GPL-3.0-or-later
//
// What archetypes_test.cpp does in space, in the plane.

#include "concepts/mesh_bases.h"
#include "concepts/SizingField.h"

#include <weft/make_mesh_2.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <catch2/catch.hpp>

#include <cstddef>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A base of CGAL's with the members of a concept.
template <class Base, class Concept>
struct Extended : Base, Concept
{
  template <class Tds>
  struct Rebind_TDS
  {
    using Other = Extended<typename Base::template Rebind_TDS<Tds>::Other, Concept>;
  };
  using Base::Base;
  Extended() : Base() {} // not defaulted, see Triangulation_2.h
};

using Vertex_base = Extended<CGAL::Delaunay_mesh_vertex_base_2<K>, concepts::MeshVertexBase_2>;
using Face_base = Extended<CGAL::Delaunay_mesh_face_base_2<K>, concepts::MeshFaceBase_2>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<K, CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>,
                                                       CGAL::No_constraint_intersection_requiring_constructions_tag>;

template <class Triangulation>
void insert_square(Triangulation& cdt)
{
  const typename Triangulation::Point corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 4; ++i) cdt.insert_constraint(corners[i], corners[(i + 1) % 4]);
}

} // namespace

TEST_CASE("make_mesh_2 needs no more than the concepts of bases, sizing fields and visitors say")
{
  const auto sizes = [](const K::Point_2& p) { return 0.1 + 0.1 * p.x(); };
  std::size_t calls = 0;
  const auto watch = [&](const weft::Progress&) { return ++calls > 0; };
  weft::Mesh_options_2 options;
  options.visitor = concepts::MeshVisitor<decltype(watch)>(watch);

  Cdt cdt;
  insert_square(cdt);
  const concepts::SizingField<K::Point_2, decltype(sizes)> sizing(sizes);
  CHECK(weft::make_mesh_2(cdt, sizing, options).ok());
  CHECK(calls > 0);

  weft::Mesh_triangulation_2<K> usual;
  insert_square(usual);
  weft::make_mesh_2(usual, sizes);
  CHECK(cdt.number_of_vertices() == usual.number_of_vertices());
  CHECK(cdt.number_of_vertices() > 50);
}
