// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of make_mesh_2() and relax_2(): the guarantees hold on every domain with every sizing field, results are
// reproducible bit for bit, budgets and failing fields leave valid meshes, and neither place nor order of the input
// matter much.

#include "fixtures/cgal_mesh_2.h"
#include "fixtures/meshing_2.h"

#include <weft/IO/read_pslg.h>
#include <weft/make_mesh_2.h>
#include <weft/planar/sizing/Lfs_sizing_2.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace {

using namespace planar;
using weft::Mesh_options_2;
using weft::Mesh_report_2;

struct Named_field
{
  std::string name;
  Field field;
};

std::vector<Named_field> fields(const Pslg& pslg)
{
  const Point spot(0.2, 0.13);
  return {{"linear", [](const Point& p) { return 0.05 + 0.1 * std::abs(p.x()); }},
          {"lfs", weft::Lfs_sizing_2<K>(pslg, 0.4, 0.01, 0.3)},
          {"discontinuous", [](const Point& p) { return p.x() + 0.3 * p.y() < 0.5 ? 0.04 : 0.15; }},
          {"steep", [](const Point& p) { return 0.02 + 1.5 * std::abs(p.y() - 0.3); }},
          {"tiny spot", [spot](const Point& p) {
             return (std::min)(0.2, 0.002 + 0.5 * std::sqrt(CGAL::squared_distance(p, spot)));
           }}};
}

/// The report must say what the mesh is.
void check_report(const Mesh_report_2& report, const Cdt& cdt, const Pslg& pslg)
{
  const std::set<Point> input(pslg.points.begin(), pslg.points.end());
  std::size_t on_constraints = 0, inside = 0;
  for (const auto v : cdt.finite_vertex_handles()) {
    on_constraints += v->constraint() >= 0;
    inside += v->constraint() == weft::free_vertex;
  }
  CHECK(report.input_vertices == input.size());
  CHECK(report.vertices == cdt.number_of_vertices());
  CHECK(report.constraint_steiner == on_constraints);
  CHECK(report.interior_steiner == inside);
  CHECK(report.steiner() + report.input_vertices == report.vertices);
  const weft::Quality_2 quality = weft::measure_quality_2(cdt);
  CHECK(report.triangles == quality.triangles);
  CHECK(report.smallest_angle == Approx(quality.smallest_angle.degrees).margin(1e-6));
  CHECK(report.largest_angle == Approx(quality.largest_angle.degrees).margin(1e-6));
}

template <class Sizing>
void check_report_of_sizes(const Mesh_report_2& report, const Cdt& cdt, const Sizing& sizing)
{
  const weft::Sizing_quality_2 quality = weft::measure_sizing_2(cdt, sizing);
  CHECK(report.largest_ratio == Approx((std::max)(quality.triangles.largest, quality.constrained_edges.largest)));
  CHECK(report.oversized == quality.triangles.oversized + quality.constrained_edges.oversized);
}

/// Numbers that others may rely on after the call.
void check_numbering(const Cdt& cdt)
{
  std::set<int> ids;
  for (const auto v : cdt.finite_vertex_handles()) ids.insert(v->id());
  CHECK(ids.size() == cdt.number_of_vertices());
  CHECK(*ids.begin() == 0);
  CHECK(*ids.rbegin() == static_cast<int>(cdt.number_of_vertices()) - 1);
}

template <class Sizing>
Mesh_report_2 mesh_and_check(Cdt& cdt, const Pslg& pslg, const Sizing& sizing, const Mesh_options_2& options = {})
{
  const Mesh_report_2 report = weft::make_mesh_2(cdt, sizing, options);
  CHECK(mesh_faults(cdt, pslg) == "");
  check_numbering(cdt);
  return report;
}

template <class Sizing>
void check_all_criteria(const Pslg& pslg, const Sizing& sizing, const Mesh_options_2& options = {})
{
  Cdt cdt = triangulate(pslg);
  const Mesh_report_2 report = mesh_and_check(cdt, pslg, sizing, options);
  CHECK(report.stop_reason == weft::Stop_reason::criteria_met);
  CHECK(report.ok());
  CHECK(faults(weft::check_sizing_2(cdt, sizing)) == "");
}

Field gentle()
{
  return [](const Point& p) { return 0.03 + 0.1 * std::abs(p.x()); };
}

struct Broken_field : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Every vertex is an input vertex or inside of the domain's box: nothing of the mesher's own is left.
bool is_within_box(const Cdt& cdt, const Pslg& pslg)
{
  CGAL::Bbox_2 box;
  for (const Point& p : pslg.points) box += p.bbox();
  for (const auto v : cdt.finite_vertex_handles())
    if (!CGAL::do_overlap(box, v->point().bbox())) return false;
  return true;
}

} // namespace

TEST_CASE("uniform sizes: every criterion holds on every domain, and input vertices stay in place")
{
  for (const Domain& domain : domains())
    for (const double size : {3.0, 0.3, 0.08, 0.03}) {
      INFO(domain.name << ", size " << size);
      check_all_criteria(domain.pslg, Uniform(size));
    }
}

TEST_CASE("graded sizes: every criterion holds on every domain, and input vertices stay in place")
{
  for (const Domain& domain : domains())
    for (const Named_field& field : fields(domain.pslg)) {
      INFO(domain.name << ", " << field.name);
      check_all_criteria(domain.pslg, field.field);
    }
}

TEST_CASE("batch refinement alone meets all criteria, too")
{
  Mesh_options_2 options;
  options.seeding = weft::Seeding::none;
  for (const Domain& domain : domains()) {
    INFO(domain.name);
    check_all_criteria(domain.pslg, Uniform(0.08), options);
    for (const Named_field& field : fields(domain.pslg)) {
      INFO(field.name);
      check_all_criteria(domain.pslg, field.field, options);
    }
  }
}

TEST_CASE("without polishing, grading or feedback all criteria are met as well")
{
  for (int variant = 0; variant < 3; ++variant)
    for (const Domain& domain : domains()) {
      INFO(domain.name << ", variant " << variant);
      Mesh_options_2 options;
      if (variant == 0) options.polish = false;
      if (variant == 1) options.grade_input = false;
      if (variant == 2) options.size_feedback = 0;
      check_all_criteria(domain.pslg, Uniform(0.06), options);
      check_all_criteria(domain.pslg, gentle(), options);
    }
}

TEST_CASE("without sweeps nothing is relaxed, and all criteria are met as well")
{
  Mesh_options_2 options;
  options.max_sweeps = 0;
  for (const Domain& domain : domains()) {
    INFO(domain.name);
    check_all_criteria(domain.pslg, Uniform(0.06), options);
    Cdt cdt = triangulate(domain.pslg);
    CHECK(weft::make_mesh_2(cdt, gentle(), options).sweeps == 0);
  }
}

TEST_CASE("a number is a sizing field that is the same everywhere")
{
  for (const Domain& domain : domains()) {
    INFO(domain.name);
    Cdt by_number = triangulate(domain.pslg), by_field = triangulate(domain.pslg);
    weft::make_mesh_2(by_number, 0.06);
    weft::make_mesh_2(by_field, Uniform(0.06));
    REQUIRE(by_number.number_of_vertices() == by_field.number_of_vertices());
    CHECK(std::equal(by_number.points_begin(), by_number.points_end(), by_field.points_begin()));
  }
  Cdt cdt = triangulate(annulus());
  CHECK_THROWS_AS(weft::make_mesh_2(cdt, 0), weft::Option_error);
  CHECK_THROWS_AS(weft::relax_2(cdt, -1.), weft::Option_error);
}

TEST_CASE("the report says what the mesh is")
{
  for (const Domain& domain : domains())
    for (int variant = 0; variant < 4; ++variant) {
      INFO(domain.name << ", variant " << variant);
      Mesh_options_2 options;
      if (variant == 1) options.max_vertices = 60;
      if (variant == 2) options.seeding = weft::Seeding::none;
      if (variant == 3) options.max_batches = 0;
      Cdt cdt = triangulate(domain.pslg), graded = triangulate(domain.pslg);
      const Mesh_report_2 report = weft::make_mesh_2(cdt, Uniform(0.05), options);
      check_report(report, cdt, domain.pslg);
      check_report_of_sizes(report, cdt, Uniform(0.05));
      const Mesh_report_2 of_graded = weft::make_mesh_2(graded, gentle(), options);
      check_report(of_graded, graded, domain.pslg);
      check_report_of_sizes(of_graded, graded, gentle());
    }
}

TEST_CASE("the sizing field is asked within the box of the input only")
{
  for (const Domain& domain : domains())
    for (const auto seeding : {weft::Seeding::crystal, weft::Seeding::none}) {
      INFO(domain.name << ", seeding " << static_cast<int>(seeding));
      CGAL::Bbox_2 box;
      for (const Point& p : domain.pslg.points) box += p.bbox();
      box.dilate(1); // units in the last place
      int outside = 0;
      const Field field = [&](const Point& p) {
        outside += !CGAL::do_overlap(box, p.bbox());
        return 0.08 + 0.05 * std::abs(p.x());
      };
      Mesh_options_2 options;
      options.seeding = seeding;
      Cdt cdt = triangulate(domain.pslg);
      weft::make_mesh_2(cdt, field, options);
      CHECK(outside == 0);
    }
}

TEST_CASE("a Lipschitz field is met everywhere with constraints that cross its gradient")
{
  const Pslg pslg = close_constraints();
  for (const double k : {0.3, 0.7, 1.0, 2.0}) {
    INFO("k " << k);
    check_all_criteria(pslg, Field(weft::Lfs_sizing_2<K>(pslg, k)));
  }
}

TEST_CASE("triangles of the uniform square are well shaped and few")
{
  Cdt cdt = triangulate(square());
  const Mesh_report_2 report = weft::make_mesh_2(cdt, Uniform(0.03));
  CHECK(report.ok());
  CHECK(weft::measure_quality_2(cdt).smallest_angle.degrees > 30);
  CHECK(weft::measure_quality_2(cdt).largest_angle.degrees < 105);
  CHECK(weft::measure_sizing_2(cdt, Uniform(0.03)).relative_count() < 1.7);
}

TEST_CASE("the domain is marked by parity if it isn't marked yet, and is kept if it is")
{
  const Pslg pslg = nested_holes();
  Cdt marked = triangulate(pslg), unmarked = triangulate(pslg), filled = triangulate(pslg);
  for (const auto f : unmarked.all_face_handles()) f->set_in_domain(false);
  const std::vector<Point> none;
  weft::mark_domain_by_seeds(filled, none.begin(), none.end());
  for (Cdt* cdt : {&marked, &unmarked, &filled}) weft::make_mesh_2(*cdt, Uniform(0.08));
  CHECK(fingerprint(marked) == fingerprint(unmarked));
  CHECK(weft::measure_quality_2(filled).area == Approx(1));
  CHECK(mesh_faults(marked, pslg) == "");
}

TEST_CASE("seeded holes are kept")
{
  Pslg pslg = nested_holes();
  pslg.holes = {{0.5, 0.4}}; // between the island's hole and its shore
  check_all_criteria(pslg, Uniform(0.07));
  check_all_criteria(pslg, gentle());
}

TEST_CASE("two runs give the same bits wherever the triangulation lies in memory")
{
  for (const Domain& domain : domains()) {
    INFO(domain.name);
    const auto run = [&](bool graded, weft::Seeding seeding) {
      Cdt cdt = triangulate(domain.pslg);
      Mesh_options_2 options;
      options.seeding = seeding;
      if (domain.name != "star") options.min_angle = 25;
      if (graded)
        weft::make_mesh_2(cdt, gentle(), options);
      else
        weft::make_mesh_2(cdt, Uniform(0.05), options);
      return fingerprint(cdt);
    };
    for (const bool graded : {false, true})
      for (const auto seeding : {weft::Seeding::crystal, weft::Seeding::none}) {
        const Fingerprint first = run(graded, seeding);
        const Memory_noise noise(1);
        CHECK(first == run(graded, seeding));
      }
  }
}

TEST_CASE("the number of threads doesn't change a bit")
{
  for (const bool graded : {false, true}) {
    Fingerprint first;
    for (const int threads : {1, 2, 4}) {
      Cdt cdt = triangulate(nested_holes());
      Mesh_options_2 options;
      options.threads = threads;
      if (graded)
        weft::make_mesh_2(cdt, Field([](const Point& p) { return 0.01 + 0.02 * std::abs(p.x()); }), options);
      else
        weft::make_mesh_2(cdt, Uniform(0.015), options);
      CHECK(cdt.number_of_faces() > 2500); // or the loops aren't split among threads
      if (threads == 1) first = fingerprint(cdt);
      CHECK(first == fingerprint(cdt));
    }
  }
}

TEST_CASE("the seed is the only source of randomness, and any seed gives a good mesh")
{
  for (const unsigned seed : {1u, 2u, 77u}) {
    Mesh_options_2 options;
    options.seed = seed;
    check_all_criteria(annulus(), Uniform(0.05), options);
  }
}

namespace {

/// A mesh with bad angles: all sizes hold, but nothing has been polished.
Cdt unpolished_mesh(const Pslg& pslg, double size)
{
  Cdt cdt = triangulate(pslg);
  Mesh_options_2 options;
  options.polish = false;
  options.seeding = weft::Seeding::none;
  CHECK(weft::make_mesh_2(cdt, Uniform(size), options).ok());
  return cdt;
}

/// Hops until the budget is used up. Returns the number of changes that were kept.
std::size_t hop(Cdt& cdt, double size, std::size_t insertions, unsigned seed = 0)
{
  using Mesh = weft::internal::Working_mesh_2<Cdt, Uniform>;
  const Uniform sizing(size);
  Mesh mesh(cdt, sizing, Mesh::Given::relaxable);
  weft::internal::Polisher_2<Mesh> polisher(mesh);
  weft::internal::Basin_hopper_2<Mesh> hopper(mesh, polisher, seed);
  return hopper.run(1, insertions, [] { return true; });
}

} // namespace

TEST_CASE("random changes of neighborhoods keep the worst angles, every size and all that is given")
{
  std::size_t kept = 0;
  int better = 0;
  for (const Domain& domain : domains())
    for (const unsigned seed : {0u, 5u}) {
      INFO(domain.name << ", seed " << seed);
      Cdt cdt = unpolished_mesh(domain.pslg, 0.06);
      const weft::Quality_2 before = weft::measure_quality_2(cdt);
      const std::size_t changes = hop(cdt, 0.06, 1000, seed);
      kept += changes;
      const weft::Quality_2 after = weft::measure_quality_2(cdt);
      CHECK(faults(weft::validate_2(cdt)) == "");
      // Isolated points look like any other vertex inside.
      if (domain.name != "isolated points") CHECK(faults(weft::check_conformity_2(cdt, domain.pslg)) == "");
      CHECK(faults(weft::check_sizing_2(cdt, Uniform(0.06))) == "");
      CHECK(after.area == Approx(before.area));
      CHECK(after.smallest_angle.degrees >= before.smallest_angle.degrees - 1e-6);
      CHECK(after.largest_angle.degrees <= before.largest_angle.degrees + 1e-6);
      better += after.smallest_angle.degrees > before.smallest_angle.degrees + 0.5;
    }
  CHECK(kept > 100);
  CHECK(better > 5);
}

TEST_CASE("without room for insertions random changes add no vertex")
{
  for (const Domain& domain : domains()) {
    INFO(domain.name);
    Cdt cdt = unpolished_mesh(domain.pslg, 0.06);
    const std::size_t vertices = cdt.number_of_vertices();
    hop(cdt, 0.06, 0);
    CHECK(cdt.number_of_vertices() <= vertices);
  }
}

TEST_CASE("random changes are the same bits for the same seed wherever the triangulation lies in memory")
{
  const Cdt mesh = unpolished_mesh(annulus(), 0.06);
  const auto run = [&](unsigned seed) {
    Cdt cdt(mesh);
    CHECK(hop(cdt, 0.06, 1000, seed) > 0);
    return fingerprint(cdt);
  };
  const Fingerprint first = run(1);
  {
    const Memory_noise noise(1);
    CHECK(first == run(1));
  }
  CHECK(!(first == run(2)));
}

namespace {

/// Sharp input angles and points within a fraction of the size: the worst angle is where luck decides.
bool is_delicate(const Domain& domain)
{
  return domain.name == "star" || domain.name == "isolated points";
}

weft::Quality_2 quality_of_mesh(const Pslg& pslg, double size)
{
  Cdt cdt = triangulate(pslg);
  CHECK(weft::make_mesh_2(cdt, Uniform(size)).ok());
  CHECK(mesh_faults(cdt, pslg) == "");
  CHECK(faults(weft::check_sizing_2(cdt, Uniform(size))) == "");
  return weft::measure_quality_2(cdt);
}

void check_alike(const weft::Quality_2& a, const weft::Quality_2& b)
{
  CHECK(std::abs(a.mean_smallest_angle - b.mean_smallest_angle) < 1.5);
  CHECK(std::abs(static_cast<double>(a.vertices) / static_cast<double>(b.vertices) - 1) < 0.08);
}

void check_worst_angles_alike(const weft::Quality_2& a, const weft::Quality_2& b)
{
  CHECK(std::abs(a.smallest_angle.degrees - b.smallest_angle.degrees) < 5);
  CHECK(std::abs(a.largest_angle.degrees - b.largest_angle.degrees) < 10);
}

struct Transformation
{
  double scale, angle, dx, dy;
};

const std::vector<Transformation> transformations{{1, 0.3, 0, 0},  {1, pi / 2, 0, 0}, {1e-30, 0, 0, 0},
                                                  {1e30, 1, 0, 0}, {1, 0, 1e5, -1e4}, {37, 2, 5, 8}};

/// Calls `check(before, after)` for the meshes of all transformed and reordered domains.
template <class Check>
void compare_variants(bool delicate, const Check& check)
{
  for (const Domain& domain : domains()) {
    if (is_delicate(domain) && !delicate) continue;
    INFO(domain.name);
    const weft::Quality_2 before = quality_of_mesh(domain.pslg, 0.04);
    for (const auto& t : transformations) {
      INFO("scale " << t.scale << ", angle " << t.angle << ", offset " << t.dx << " " << t.dy);
      check(before, quality_of_mesh(transformed(domain.pslg, t.scale, t.angle, t.dx, t.dy), 0.04 * t.scale));
    }
    for (unsigned seed = 0; seed < 3; ++seed) {
      INFO("order " << seed);
      check(before, quality_of_mesh(shuffled(domain.pslg, seed), 0.04));
    }
  }
}

} // namespace

TEST_CASE("turning, scaling, shifting and reordering the input changes the mesh little")
{
  compare_variants(true, check_alike);
}

TEST_CASE("turning, scaling, shifting and reordering changes the worst angles little")
{
  compare_variants(false, check_worst_angles_alike);
}

TEST_CASE("scaling and shifting by powers of two changes nothing but the coordinates")
{
  const Pslg pslg = star();
  Cdt cdt = triangulate(pslg), other = triangulate(transformed(pslg, 1024, 0, 0, 0));
  weft::make_mesh_2(cdt, Uniform(0.0625));
  weft::make_mesh_2(other, Uniform(64));
  Fingerprint a = fingerprint(cdt);
  for (double& x : a.coordinates) x *= 1024;
  CHECK(a == fingerprint(other));
}

TEST_CASE("in spikes down to 5 degrees angles are as good as elsewhere, at any size")
{
  const Pslg pslg = star();
  for (const double size : {0.04, 0.03, 0.0208, 0.02, 0.015, 0.012, 0.01}) {
    INFO("size " << size);
    Cdt cdt = triangulate(pslg);
    const Mesh_report_2 report = mesh_and_check(cdt, pslg, Uniform(size));
    CHECK(report.ok());
    CHECK(report.smallest_angle > 4.999); // the input's own
    CHECK(report.largest_angle < 105);
  }
}

TEST_CASE("a vertex budget is kept, and the mesh is valid when it is used up")
{
  const Pslg pslg = nested_holes();
  for (const auto seeding : {weft::Seeding::crystal, weft::Seeding::none})
    for (const std::size_t budget : {0, 1, 30, 45, 46, 50, 100, 300}) {
      INFO("budget " << budget << ", seeding " << static_cast<int>(seeding));
      Mesh_options_2 options;
      options.max_vertices = budget;
      options.seeding = seeding;
      Cdt cdt = triangulate(pslg), graded = triangulate(pslg);
      const Mesh_report_2 report = mesh_and_check(cdt, pslg, Uniform(0.01), options);
      CHECK(report.stop_reason == weft::Stop_reason::vertex_budget);
      CHECK_FALSE(report.ok());
      CHECK(cdt.number_of_vertices() <= (std::max)(budget, pslg.points.size()));
      mesh_and_check(graded, pslg, Field([](const Point& p) { return 0.004 + 0.02 * std::abs(p.x()); }), options);
      CHECK(graded.number_of_vertices() <= (std::max)(budget, pslg.points.size()));
    }
  // Enough is enough.
  Mesh_options_2 options;
  options.max_vertices = 100000;
  Cdt cdt = triangulate(pslg);
  CHECK(mesh_and_check(cdt, pslg, Uniform(0.1), options).stop_reason == weft::Stop_reason::criteria_met);
}

TEST_CASE("sizes far below the domain's end in the vertex budget, far above it in few triangles")
{
  for (const double size : {1e-3, 1e-6, 1e-12, 1e-100, 1e-300}) {
    INFO("size " << size);
    Mesh_options_2 options;
    options.max_vertices = 2000;
    Cdt cdt = triangulate(annulus());
    const auto start = std::chrono::steady_clock::now();
    const Mesh_report_2 report = weft::make_mesh_2(cdt, Uniform(size), options);
    CHECK(report.stop_reason == weft::Stop_reason::vertex_budget);
    CHECK(mesh_faults(cdt, annulus()) == "");
    CHECK(cdt.number_of_vertices() <= 2000);
    CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 20);
  }
  for (const double size : {1e3, 1e12, 1e100, 1e300}) {
    INFO("size " << size);
    check_all_criteria(square(), Uniform(size));
    Mesh_options_2 options;
    options.grade_input = false;
    Cdt cdt = triangulate(square());
    weft::make_mesh_2(cdt, Uniform(size), options);
    CHECK(cdt.number_of_vertices() < 10);
  }
}

TEST_CASE("a hundred thousand vertices in sight of the convex hull don't make a run slow to begin or end")
{
  constexpr std::size_t n = 100000;
  for (const double dent : {0., 0.3}) { // convex; with seven bays
    INFO("dent " << dent);
    Pslg pslg;
    for (std::size_t i = 0; i < n; ++i) {
      const double t = 2 * std::acos(-1.) * static_cast<double>(i) / n, r = 1 + dent * std::cos(7 * t);
      pslg.points.emplace_back(r * std::cos(t), r * std::sin(t));
      pslg.segments.push_back({i, (i + 1) % n});
    }
    Cdt cdt = triangulate(pslg);
    Mesh_options_2 options;
    options.max_vertices = n + 1000;
    const auto start = std::chrono::steady_clock::now();
    const Mesh_report_2 report = weft::make_mesh_2(cdt, Uniform(0.1), options);
    CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 20);
    CHECK(report.stop_reason == weft::Stop_reason::vertex_budget);
    CHECK(mesh_faults(cdt, pslg) == "");
  }
}

TEST_CASE("a time limit of zero ends at once with a valid mesh")
{
  for (const Domain& domain : domains())
    for (const auto seeding : {weft::Seeding::crystal, weft::Seeding::none}) {
      INFO(domain.name);
      Mesh_options_2 options;
      options.time_limit = 0;
      options.seeding = seeding;
      Cdt cdt = triangulate(domain.pslg);
      const Mesh_report_2 report = mesh_and_check(cdt, domain.pslg, Uniform(0.01), options);
      CHECK(report.stop_reason == weft::Stop_reason::time_limit);
      CHECK_FALSE(report.ok());
    }
}

TEST_CASE("a time limit is kept")
{
  for (const auto seeding : {weft::Seeding::crystal, weft::Seeding::none}) {
    Mesh_options_2 options;
    options.time_limit = 0.2;
    options.seeding = seeding;
    Cdt cdt = triangulate(nested_holes());
    const auto start = std::chrono::steady_clock::now();
    CHECK(weft::make_mesh_2(cdt, Uniform(0.002), options).stop_reason == weft::Stop_reason::time_limit);
    CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 10);
    CHECK(mesh_faults(cdt, nested_holes()) == "");
  }
}

TEST_CASE("without batches the mesh is valid and the report says what is missing")
{
  Mesh_options_2 options;
  options.max_batches = 0;
  options.seeding = weft::Seeding::none;
  Cdt cdt = triangulate(annulus());
  const Mesh_report_2 report = mesh_and_check(cdt, annulus(), Uniform(0.05), options);
  CHECK(report.stop_reason == weft::Stop_reason::iteration_limit);
  CHECK(report.batches == 0);
  CHECK(report.oversized > 0);
  CHECK_FALSE(report.ok());
  options.max_sweeps = 0;
  options.max_batches = 3;
  Cdt other = triangulate(annulus());
  const Mesh_report_2 three = mesh_and_check(other, annulus(), gentle(), options);
  CHECK(three.stop_reason == weft::Stop_reason::iteration_limit);
  CHECK(three.batches == 3);
  CHECK(three.sweeps == 0);
}

TEST_CASE("a visitor that says no ends the run with a valid mesh, whenever it does")
{
  const Pslg pslg = nested_holes();
  for (const auto seeding : {weft::Seeding::crystal, weft::Seeding::none}) {
    int calls_of_a_whole_run = 0;
    const auto run = [&](int allowed, bool graded) {
      Mesh_options_2 options;
      options.seeding = seeding;
      int calls = 0;
      options.visitor = [&](const weft::Progress& progress) {
        CHECK(progress.seconds >= 0);
        return ++calls <= allowed;
      };
      Cdt cdt = triangulate(pslg);
      const Mesh_report_2 report =
          graded ? mesh_and_check(cdt, pslg, gentle(), options) : mesh_and_check(cdt, pslg, Uniform(0.05), options);
      CHECK((report.stop_reason == weft::Stop_reason::cancelled) == (calls > allowed));
      CHECK(calls <= allowed + 1); // once is enough
      calls_of_a_whole_run = calls;
    };
    for (const bool graded : {false, true}) {
      run(1000000, graded);
      const int all = calls_of_a_whole_run;
      CHECK(all > 10);
      INFO("calls in a whole run: " << all);
      for (int n = 0; n < 12; ++n) run(n, graded);
      for (int n = 12; n < all; n += 1 + n / 4) run(n, graded);
    }
  }
}

TEST_CASE("an exception from the visitor passes through and leaves the triangulation valid")
{
  for (int n = 1; n < 60; n += 1 + n / 3) {
    Mesh_options_2 options;
    int calls = 0;
    options.visitor = [&](const weft::Progress&) -> bool {
      if (++calls == n) throw Broken_field("visitor");
      return true;
    };
    Cdt cdt = triangulate(annulus());
    INFO("call " << n);
    CHECK_THROWS_AS(weft::make_mesh_2(cdt, Uniform(0.05), options), Broken_field);
    CHECK(mesh_faults(cdt, annulus()) == "");
    CHECK(is_within_box(cdt, annulus()));
  }
}

TEST_CASE("a failing sizing field is an error that leaves the triangulation valid, whenever it fails")
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Pslg pslg = annulus();
  int total = 0;
  {
    Cdt cdt = triangulate(pslg);
    weft::make_mesh_2(cdt, Field([&](const Point& p) {
                        ++total;
                        return 0.06 + 0.05 * std::abs(p.x());
                      }));
  }
  for (int n = 0; n < total; n = n < 5 ? n + 1 : n * 3 / 2)
    for (const double bad : {0.0, -1.0, infinity, -infinity, std::nan(""), 7.0}) {
      INFO("evaluation " << n << " is " << bad);
      for (const auto seeding : {weft::Seeding::crystal, weft::Seeding::none}) {
        int calls = 0;
        const Field field = [&](const Point& p) {
          if (++calls <= n) return 0.06 + 0.05 * std::abs(p.x());
          if (bad == 7) throw Broken_field("field");
          return bad;
        };
        Mesh_options_2 options;
        options.seeding = seeding;
        Cdt cdt = triangulate(pslg);
        try {
          weft::make_mesh_2(cdt, field, options);
          CHECK(calls <= n); // refinement alone may need fewer
        } catch (const Broken_field&) {
          CHECK(bad == 7);
        } catch (const weft::Option_error& error) {
          CHECK(bad != 7);
          CHECK(std::string(error.what()).find("sizing field") != std::string::npos);
        }
        CHECK(mesh_faults(cdt, pslg) == "");
        CHECK(is_within_box(cdt, pslg));
      }
    }
}

TEST_CASE("after a failure the same triangulation can be meshed")
{
  Cdt cdt = triangulate(annulus()), fresh = triangulate(annulus());
  CHECK_THROWS_AS(weft::make_mesh_2(cdt, Field([](const Point&) { return std::nan(""); })), weft::Option_error);
  CHECK(cdt.number_of_vertices() == fresh.number_of_vertices());
  CHECK(weft::make_mesh_2(cdt, gentle()).ok());
  CHECK(mesh_faults(cdt, annulus()) == "");
}

TEST_CASE("options out of range and empty domains are refused before anything happens")
{
  Cdt cdt = triangulate(square());
  const Fingerprint before = fingerprint(cdt);
  const auto refused = [&](const auto& spoil) {
    Mesh_options_2 options;
    spoil(options);
    CHECK_THROWS_AS(weft::make_mesh_2(cdt, Uniform(0.1), options), weft::Option_error);
    CHECK_THROWS_AS(weft::relax_2(cdt, Uniform(0.1), options), weft::Option_error);
  };
  refused([](auto& o) { o.move_ratio = 0; });
  refused([](auto& o) { o.final_move_ratio = std::nan(""); });
  refused([](auto& o) { o.quadrature = 0; });
  refused([](auto& o) { o.final_quadrature = -1; });
  refused([](auto& o) { o.size_feedback = -1; });
  refused([](auto& o) { o.max_sweeps = -1; });
  refused([](auto& o) { o.max_batches = -1; });
  refused([](auto& o) { o.min_angle = 90; });
  refused([](auto& o) { o.time_limit = -1; });
  refused([](auto& o) { o.time_limit = std::nan(""); });
  refused([](auto& o) { o.threads = 0; });
  CHECK(before == fingerprint(cdt));
  CHECK_THROWS_AS(Uniform(0), weft::Option_error);

  Cdt empty, line, open;
  CHECK_THROWS_AS(weft::make_mesh_2(empty, Uniform(1)), weft::Domain_error);
  line.insert_constraint(Point(0, 0), Point(1, 1));
  CHECK_THROWS_AS(weft::make_mesh_2(line, Uniform(1)), weft::Domain_error);
  open.insert_constraint(Point(0, 0), Point(1, 0));
  open.insert_constraint(Point(1, 0), Point(1, 1));
  CHECK_THROWS_AS(weft::make_mesh_2(open, Uniform(1)), weft::Domain_error);
  CHECK(open.number_of_vertices() == 3);
  CHECK(open.is_valid());
}

TEST_CASE("coordinates out of range are refused, at the edge of the range they are meshed")
{
  for (const double scale : {1e-150, 1e-61, 1e61, 1e150}) {
    const Pslg pslg = transformed(nested_holes(), scale, 0, 0, 0);
    Cdt cdt = triangulate(pslg);
    CHECK_THROWS_AS(weft::make_mesh_2(cdt, Uniform(0.1 * scale)), weft::Domain_error);
    CHECK(mesh_faults(cdt, pslg) == "");
    CHECK(cdt.number_of_vertices() == pslg.points.size());
  }
  for (const double scale : {1e-59, 1e-50, 1e50, 1e59}) {
    INFO("scale " << scale);
    const Pslg pslg = transformed(nested_holes(), scale, 0.3, 0, 0);
    check_all_criteria(pslg, Uniform(0.07 * scale));
    check_all_criteria(pslg, Field([scale](const Point& p) { return 0.05 * scale + 0.1 * std::abs(p.x()); }));
  }
}

namespace {

void check_smallest_angle(const Domain& domain, double angle, weft::Seeding seeding)
{
  INFO(domain.name << ", at least " << angle << ", seeding " << static_cast<int>(seeding));
  Mesh_options_2 options;
  options.min_angle = angle;
  options.seeding = seeding;
  Cdt cdt = triangulate(domain.pslg);
  const Mesh_report_2 report = mesh_and_check(cdt, domain.pslg, Uniform(0.1), options);
  CHECK(report.stop_reason == weft::Stop_reason::criteria_met);
  CHECK(report.ok());
  CHECK(report.below_min_angle == 0);
  CHECK(faults(weft::check_sizing_2(cdt, Uniform(0.1))) == "");
  if (weft::smallest_constraint_angle_2(cdt) < angle) {
    CHECK(report.at_input_angle > 0);
  } else {
    CHECK(weft::measure_quality_2(cdt).smallest_angle.degrees >= angle - 1e-9);
    CHECK(report.at_input_angle == 0);
  }
}

} // namespace

TEST_CASE("asking for more than can be had doesn't make a mesh worse, and the report says so")
{
  const Pslg plate = weft::IO::read_pslg<K>(WEFT_DATA_DIR "/plate.poly");
  const auto mesh = [&plate](double angle) {
    Mesh_options_2 options;
    options.min_angle = angle;
    Cdt cdt = triangulate(plate);
    return mesh_and_check(cdt, plate, Uniform(12), options);
  };
  const Mesh_report_2 plain = mesh(0);
  REQUIRE(plain.ok());
  for (const double angle : {35, 40}) {
    INFO(angle << " degrees");
    const Mesh_report_2 report = mesh(angle);
    CHECK(report.stop_reason == weft::Stop_reason::iteration_limit);
    CHECK(report.below_min_angle > 0);
    CHECK(report.oversized == 0);
    CHECK(report.smallest_angle > plain.smallest_angle - 0.5);
    CHECK(report.vertices < 5 * plain.vertices);
  }
}

TEST_CASE("a smallest angle is reached")
{
  for (const Domain& domain : domains())
    for (const double angle : {20.0, 28.0})
      for (const auto seeding : {weft::Seeding::crystal, weft::Seeding::none})
        if (domain.name != "star" && domain.name != "isolated points") check_smallest_angle(domain, angle, seeding);
}

TEST_CASE("a smallest angle is reached around isolated points")
{
  for (const double angle : {20.0, 28.0})
    for (const auto seeding : {weft::Seeding::crystal, weft::Seeding::none})
      check_smallest_angle({"isolated points", isolated_points()}, angle, seeding);
}

TEST_CASE("refining for a smallest angle ends at sharper input angles")
{
  Pslg wedge;
  add_loop(wedge, {{0, 0}, {1, 0}, {1, 0.15}});
  for (const auto seeding : {weft::Seeding::crystal, weft::Seeding::none}) {
    check_smallest_angle({"wedge of 8.5 degrees", wedge}, 20, seeding);
    check_smallest_angle({"star", star()}, 20, seeding);
  }
}

TEST_CASE("input below the resolution of the sizing field keeps its angles")
{
  // A circle of 720 sides, each a thirteenth of the size long.
  Cdt cdt = triangulate(circle(720));
  const Mesh_report_2 report = mesh_and_check(cdt, circle(720), Uniform(0.06));
  CHECK(report.ok());
  CHECK(weft::measure_quality_2(cdt).smallest_angle.degrees > 25);
}

TEST_CASE("meshing a mesh again keeps all its vertices and meets a smaller size")
{
  Cdt cdt = triangulate(annulus());
  weft::make_mesh_2(cdt, Uniform(0.15));
  std::set<Point> before, after;
  for (const auto v : cdt.finite_vertex_handles()) before.insert(v->point());
  CHECK(weft::make_mesh_2(cdt, Uniform(0.07)).ok());
  for (const auto v : cdt.finite_vertex_handles()) after.insert(v->point());
  CHECK(std::includes(after.begin(), after.end(), before.begin(), before.end()));
  CHECK(faults(weft::check_sizing_2(cdt, Uniform(0.07))) == "");
  CHECK(mesh_faults(cdt, annulus()) == "");
}

namespace {

void check_relaxing_a_mesh_of_cgal(const Domain& domain)
{
  INFO(domain.name);
  Cdt cdt = mesh_by_cgal(domain.pslg, 0.06);
  const weft::Quality_2 before = weft::measure_quality_2(cdt);
  const double ratio_before = weft::measure_sizing_2(cdt, Uniform(0.06)).triangles.largest;
  std::set<Point> on_constraints;
  for (const auto v : cdt.finite_vertex_handles())
    if (cdt.are_there_incident_constraints(v)) on_constraints.insert(v->point());
  const std::size_t vertices = cdt.number_of_vertices();

  const Mesh_report_2 report = weft::relax_2(cdt, Uniform(0.06));
  CHECK(faults(weft::validate_2(cdt)) == "");
  // Isolated points look like any other vertex inside.
  if (domain.name != "isolated points") CHECK(faults(weft::check_conformity_2(cdt, domain.pslg)) == "");
  CHECK(faults(weft::check_domain_2(cdt)) == "");
  CHECK(cdt.number_of_vertices() == vertices);
  CHECK(report.vertices == vertices);
  CHECK(report.moves > 0);
  std::size_t kept = 0;
  for (const auto v : cdt.finite_vertex_handles()) kept += on_constraints.count(v->point());
  CHECK(kept == on_constraints.size());
  const weft::Quality_2 after = weft::measure_quality_2(cdt);
  CHECK(after.area == Approx(before.area));
  CHECK(after.mean_smallest_angle > before.mean_smallest_angle);
  CHECK(after.smallest_angle.degrees >= before.smallest_angle.degrees - 1e-6);
  CHECK(report.largest_ratio <= (std::max)(1.0, ratio_before * (1 + 1e-6)));
}

} // namespace

TEST_CASE("relaxing a mesh of CGAL's mesher improves it and keeps all that is given")
{
  for (const Domain& domain : domains()) check_relaxing_a_mesh_of_cgal(domain);
}

TEST_CASE("relaxing never makes a mesh worse, whatever sizes it was made for and however early it ends")
{
  for (const Domain& domain : domains()) {
    const Cdt mesh = mesh_by_cgal(domain.pslg, 0.06);
    for (const double size : {0.01, 0.03, 0.05, 0.08, 0.3})
      for (const int sweeps : {0, 1, 3, 100})
        for (const bool polish : {false, true}) {
          INFO(domain.name << ", size " << size << ", sweeps " << sweeps << ", polish " << polish);
          Cdt cdt = mesh;
          const weft::Quality_2 before = weft::measure_quality_2(cdt);
          const double ratio = weft::measure_sizing_2(cdt, Uniform(size)).triangles.largest;
          Mesh_options_2 options;
          options.max_sweeps = sweeps;
          options.polish = polish;
          weft::relax_2(cdt, Uniform(size), options);
          const weft::Quality_2 after = weft::measure_quality_2(cdt);
          CHECK(faults(weft::validate_2(cdt)) == "");
          CHECK(after.mean_smallest_angle >= before.mean_smallest_angle - 1e-6);
          CHECK(after.smallest_angle.degrees >= before.smallest_angle.degrees - 1e-6);
          CHECK(after.largest_angle.degrees <= before.largest_angle.degrees + 1e-6);
          CHECK(weft::measure_sizing_2(cdt, Uniform(size)).triangles.largest <= (std::max)(1.0, ratio * (1 + 1e-6)));
        }
  }
}

TEST_CASE("points a unit in the last place apart, and equal ones, are meshed")
{
  const double ulp = std::numeric_limits<double>::epsilon() / 2;
  Pslg pslg = square();
  pslg.points.insert(pslg.points.end(), {{0.5, 0.5}, {0.5 + 2 * ulp, 0.5}, {0.5, 0.5}, {1 - ulp, 0.25}, {1, 0.25}});
  check_all_criteria(pslg, Uniform(0.1));
  check_all_criteria(pslg, gentle());
  add_segment(pslg, {0.25, 0.25}, {0.25 + ulp, 0.25}); // a segment of that length
  check_all_criteria(pslg, Uniform(0.3), [] {
    Mesh_options_2 options;
    options.grade_input = false;
    return options;
  }());
  Mesh_options_2 budget;
  budget.max_vertices = 3000;
  Cdt cdt = triangulate(pslg);
  mesh_and_check(cdt, pslg, Uniform(0.3), budget);
}

TEST_CASE("relaxing stops at budgets and survives failing fields")
{
  const auto coarse = [] {
    Cdt cdt = triangulate(annulus());
    Mesh_options_2 options;
    options.max_sweeps = 0;
    options.polish = false;
    options.seeding = weft::Seeding::none;
    weft::make_mesh_2(cdt, Uniform(0.05), options);
    return cdt;
  };
  for (int n = 0; n < 8; ++n) {
    Cdt cdt = coarse();
    Mesh_options_2 options;
    int calls = 0;
    options.visitor = [&](const weft::Progress&) { return ++calls <= n; };
    CHECK(weft::relax_2(cdt, Uniform(0.05), options).stop_reason == weft::Stop_reason::cancelled);
    CHECK(mesh_faults(cdt, annulus()) == "");
  }
  int all_calls = 0;
  {
    Cdt cdt = coarse();
    weft::relax_2(cdt, Field([&](const Point&) { return ++all_calls, 0.05; }));
  }
  CHECK(all_calls > 1000);
  for (int n = 0; n < all_calls; n = 2 * n + 1) {
    INFO("from call " << n + 1 << " of " << all_calls);
    Cdt cdt = coarse();
    int calls = 0;
    const Field field = [&](const Point&) { return ++calls > n ? std::nan("") : 0.05; };
    CHECK_THROWS_AS(weft::relax_2(cdt, field), weft::Option_error);
    CHECK(mesh_faults(cdt, annulus()) == "");
    CHECK(is_within_box(cdt, annulus()));
  }
  Cdt cdt = coarse();
  Mesh_options_2 options;
  options.time_limit = 0;
  CHECK(weft::relax_2(cdt, Uniform(0.05), options).stop_reason == weft::Stop_reason::time_limit);
  CHECK(mesh_faults(cdt, annulus()) == "");
}
