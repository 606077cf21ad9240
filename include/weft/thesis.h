// SPDX-License-Identifier: GPL-3.0-or-later
//
// The algorithms of Tournois 2009 as they are printed, to compare with. For good meshes: `make_mesh_2()`,
// `make_mesh_3()`.
//
//   #include <weft/IO/read_surface.h>
//   #include <weft/spatial/domain/Polyhedral_oracle_3.h>
//   #include <weft/spatial/surface/piecewise_smooth_complex.h>
//
//   const auto surface = weft::IO::read_surface<K>("gear.off");
//   const weft::Polyhedral_oracle_3<K> domain(surface, weft::Feature_options{60});
//   weft::Criteria_3<K> criteria;
//   criteria.size = 3;
//   const auto result = weft::mesh_as_published_3(domain, criteria);
//
// clang-format off
// | thesis | where | switched by |
// | --- | --- | --- |
// | Alg. 2, refinement and Lloyd in turns | mesh_as_published_2() | As_published_options_2::interleave |
// | its falling target | mesh_as_published_2() | lower_slowly |
// | its alteration of sizes | mesh_as_published_2() | alter_edges, alter_triangles |
// | Alg. 3 and 4, bounded Voronoi diagram | Bounded_voronoi_diagram_2 | |
// | Alg. 5, refinement and Natural ODT in turns | mesh_as_published_3() | As_published_options_3::interleave |
// | its initialisation, sec. 3.2.1.3 | mesh_as_published_3() | initial_loosening, target_steps, plain_creases |
// | Alg. 6, independent sets | mesh_as_published_3() | mixed_batches |
// | Steiner vertices, sec. 3.2.1.4 | mesh_as_published_3() | plain_points; follow_folds, see_ridges, mirror, lattice |
// | K-grading, sec. 3.2.1.5 | mesh_as_published_3() | grade |
// | Natural ODT, sec. 3.2.1.5 | smooth_3() with Natural_odt_3{0, 0} | sweeps; smooth_surface, keep_criteria |
// | locking, sec. 3.3.3 | smooth_3() | lock |
// | Alg. 7, sliver perturbation | perturb_as_published_3() | published_perturbation, perturbation |
// | Alg. 8, Newton | minimise_energy_2(), minimise_energy_3() | Solver_options::solver |
// | weights, sec. 4.2.3 | weighted_odt_energy_3(), minimise_weighted_energy_3() | Weighted_options_3 |
// clang-format on

#ifndef WEFT_THESIS_H
#define WEFT_THESIS_H

#include <weft/planar/run/mesh_as_published_2.h>
#include <weft/spatial/run/mesh_as_published_3.h>

#endif // WEFT_THESIS_H
