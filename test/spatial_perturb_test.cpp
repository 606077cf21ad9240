// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of sliver perturbation: gradients against differences, angles against their definition, changes that can
// be undone, crease vertices that come and go, and what has to hold whenever and however a run ends.

#include "fixtures/meshing_3.h"

#include <weft/make_mesh_3.h>
#include <weft/spatial/criteria/check_criteria_3.h>
#include <weft/spatial/mesh/hausdorff_3.h>
#include <weft/spatial/mesh/validate_3.h>
#include <weft/spatial/optimise/perturb_slivers_3.h>
#include <weft/spatial/restricted/check_restricted_3.h>
#include <weft/spatial/restricted/Mesh_without_vertex_3.h>
#include <weft/spatial/restricted/Moves_together_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <random>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using surfaces::K;
using surfaces::Point;
using surfaces::Surface;
using Vector = K::Vector_3;
using Oracle = weft::Polyhedral_oracle_3<K>;
using Criteria = weft::Criteria_3<K>;
using Mesh = weft::Tetrahedral_mesh_3<K>;
using Restricted = weft::Restricted_delaunay_3<Oracle>;
using Perturber = weft::internal::Vertex_perturber_3<Restricted>;

Oracle oracle_of(const Surface& surface, double angle = 60)
{
  return Oracle(weft::piecewise_smooth_complex(surface.points, surface.triangles, weft::Feature_options{angle}));
}

Criteria criteria_of(double size, double approximation)
{
  Criteria criteria;
  criteria.size = size;
  criteria.approximation = approximation;
  criteria.topology = true;
  return criteria;
}

/// The cells by their points: what doesn't hang on numbers.
std::set<std::array<Point, 4>> cells_of(const Restricted& restricted)
{
  const Mesh mesh = weft::tetrahedral_mesh(restricted);
  std::set<std::array<Point, 4>> cells;
  for (const auto& c : mesh.cells) {
    std::array<Point, 4> p = {mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]]};
    std::sort(p.begin(), p.end());
    cells.insert(p);
  }
  return cells;
}

bool same(const Mesh& a, const Mesh& b)
{
  return a.points == b.points && a.cells == b.cells && a.facets == b.facets && a.edges == b.edges;
}

struct Tetrahedron
{
  Point v, a, b, c;
};

Tetrahedron random_tetrahedron(std::mt19937& random)
{
  const auto point = [&random] {
    const double x = random() / 4294967296., y = random() / 4294967296., z = random() / 4294967296.;
    return Point(x, y, z);
  };
  for (;;) {
    const Point v = point(), a = point(), b = point(), c = point();
    if (std::abs(CGAL::volume(v, a, b, c)) > 0.01) return {v, a, b, c};
  }
}

template <class Function>
Vector central_difference(const Point& v, const Function& f)
{
  const double h = 1e-5;
  const auto along = [&](double x, double y, double z) {
    return (f(v + Vector(x, y, z)) - f(v - Vector(x, y, z))) / (2 * h);
  };
  return Vector(along(h, 0, 0), along(0, h, 0), along(0, 0, h));
}

double length(const Vector& v)
{
  return std::sqrt(v.squared_length());
}

/// Whatever a perturbation did, and whenever it was stopped.
void check_sound(const Restricted& restricted, const Oracle& oracle, const Criteria& criteria)
{
  CHECK(restricted.triangulation().is_valid());
  weft::Validity_3 validity = weft::check_restricted_3(restricted);
  const Mesh mesh = weft::tetrahedral_mesh(restricted);
  validity += weft::validate_3(mesh);
  validity += weft::check_criteria_3(mesh, criteria);
  validity += weft::check_distances_3(mesh, oracle);
  validity += weft::check_features_3(mesh, oracle.complex());
  INFO(validity);
  CHECK(validity.ok());
}

} // namespace

TEST_CASE("gradients of volume and circumradius are what differences say")
{
  std::mt19937 random(1);
  for (int k = 0; k < 200; ++k) {
    const auto [v, a, b, c] = random_tetrahedron(random);
    const Vector volume = weft::internal::gradient_of_volume(v, a, b, c);
    const Vector expected_volume = central_difference(
        v, [&, &a = a, &b = b, &c = c](const Point& p) { return std::abs(CGAL::volume(p, a, b, c)); });
    CHECK(length(volume - expected_volume) <= 1e-6 * length(volume));
    const Vector radius = weft::internal::gradient_of_squared_radius(v, a, b, c, CGAL::circumcenter(v, a, b, c));
    const Vector expected_radius =
        central_difference(v, [&, &a = a, &b = b, &c = c](const Point& p) { return CGAL::squared_radius(p, a, b, c); });
    CHECK(length(radius - expected_radius) <= 1e-4 * (length(radius) + 1e-3));
  }
  const Point a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), flat(1, 1, 0);
  CHECK(length(weft::internal::gradient_of_volume(flat, a, b, c)) == 0);
  CHECK(length(weft::internal::gradient_of_squared_radius(flat, a, b, c, Point(0, 0, 1))) == 0);
}

TEST_CASE("extreme dihedral angles are those between the facets")
{
  std::mt19937 random(2);
  for (int k = 0; k < 200; ++k) {
    const auto [a, b, c, d] = random_tetrahedron(random);
    const std::array<Point, 4> p = {a, b, c, d};
    double smallest = -1, largest = 1;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) { // at the edge between the other two
        std::size_t e[2], n = 0;
        for (std::size_t m = 0; m < 4; ++m)
          if (m != i && m != j) e[n++] = m;
        const Vector edge = p[e[1]] - p[e[0]];
        const auto across = [&](std::size_t m) {
          const Vector u = p[m] - p[e[0]];
          return u - (u * edge) / edge.squared_length() * edge;
        };
        const double cosine = across(i) * across(j) / (length(across(i)) * length(across(j)));
        smallest = std::max(smallest, cosine);
        largest = std::min(largest, cosine);
      }
    const bool positive = CGAL::orientation(a, b, c, d) == CGAL::POSITIVE;
    const auto found = positive ? weft::internal::cosines_of_extreme_dihedrals(a, b, c, d)
                                : weft::internal::cosines_of_extreme_dihedrals(b, a, c, d);
    CHECK(found.smallest == Approx(smallest).margin(1e-9));
    CHECK(found.largest == Approx(largest).margin(1e-9));
    const auto inverted = positive ? weft::internal::cosines_of_extreme_dihedrals(b, a, c, d)
                                   : weft::internal::cosines_of_extreme_dihedrals(a, b, c, d);
    CHECK(inverted.smallest == 1);
    CHECK(inverted.largest == -1);
  }
}

TEST_CASE("circumcenters of cells don't hang on the order of the vertices")
{
  const Oracle oracle = oracle_of(surfaces::torus(24, 12));
  const auto result = weft::make_mesh_3(oracle, criteria_of(0.5, 0.05));
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  for (const auto c : result.restricted.triangulation().finite_cell_handles()) {
    if (c->subdomain() == 0) continue;
    const Point center = weft::internal::circumcenter_of_cell_3<K>(c);
    std::array<Point, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[order[i]] = c->vertex(static_cast<int>(i))->point();
    std::next_permutation(order.begin(), order.end());
    std::sort(p.begin(), p.end());
    CHECK(center == weft::internal::circumcenter_3<K>(p[0], p[1], p[2], p[3]));
    CHECK(center == c->circumcenter());
  }
}

TEST_CASE("vertices on creases may be taken away and put back or left out, and everything kept agrees")
{
  const Oracle oracle = oracle_of(surfaces::cylinder(40)); // two closed creases
  auto result = weft::make_mesh_3(oracle, criteria_of(0.4, 0.02));
  Restricted& mesh = result.restricted;
  REQUIRE(mesh.creases().edges().size() > 10);
  std::mt19937 random(3);
  const auto criteria = criteria_of(0.4, 0.02);
  weft::internal::Criteria_guard_3<Restricted> guard(mesh, criteria);
  weft::internal::Perturbation_judge_3<Restricted> judge(mesh, guard);
  for (int k = 0; k < 60; ++k) {
    const int id = static_cast<int>(random() % mesh.vertices().size());
    const auto v = mesh.vertices()[static_cast<std::size_t>(id)];
    const auto location = v->location();
    if (location.dimension == 0 || (k % 2 == 0 && location.dimension != 1)) continue;
    const Point origin = v->point();
    const std::size_t vertices = mesh.vertices().size();
    weft::internal::Vertex_transaction_3<Restricted> change(mesh, v);
    if (k % 3 == 0) {
      change.leave_out();
      change.commit();
      CHECK(mesh.vertices().size() == vertices - 1);
    } else {
      REQUIRE(judge.find_zone(origin, change.filling().front()));
      change.place(judge.zone());
      change.commit();
      CHECK(mesh.vertices()[static_cast<std::size_t>(id)]->point() == origin);
    }
    for (std::size_t i = 0; i < mesh.vertices().size(); ++i) CHECK(mesh.vertices()[i]->id() == static_cast<int>(i));
    for (const auto& e : mesh.creases().edges()) CHECK(mesh.creases().edge(e.target, e.source) == &e);
    const auto agreement = weft::check_restricted_3(mesh);
    INFO(agreement);
    CHECK(agreement.ok());
  }
}

namespace {

/// All that is kept of a mesh, by the ids of its vertices.
template <class Mesh>
auto picture_of(const Mesh& mesh)
{
  std::vector<std::pair<Point, weft::Vertex_location_3>> vertices;
  for (const auto v : mesh.vertices()) vertices.emplace_back(v->point(), v->location());
  std::set<std::pair<std::array<int, 4>, int>> cells;
  for (const auto c : mesh.triangulation().finite_cell_handles()) {
    std::array<int, 4> ids = {c->vertex(0)->id(), c->vertex(1)->id(), c->vertex(2)->id(), c->vertex(3)->id()};
    std::sort(ids.begin(), ids.end());
    if (!Mesh::is_at_box(c)) cells.emplace(ids, c->subdomain());
  }
  std::set<std::pair<std::array<int, 3>, int>> facets;
  for (const auto& f : mesh.facets()) {
    if (f.cell == typename Mesh::Cell_handle()) continue;
    std::array<int, 3> ids;
    for (std::size_t i = 0; i < 3; ++i) ids[i] = f.cell->vertex((f.index + 1 + static_cast<int>(i)) % 4)->id();
    std::sort(ids.begin(), ids.end());
    facets.emplace(ids, f.patch);
  }
  std::set<std::pair<int, int>> creases;
  for (const auto& e : mesh.creases().edges()) creases.insert(std::minmax(e.source->id(), e.target->id()));
  return std::make_tuple(vertices, cells, facets, creases);
}

constexpr int stages_of_change = 7;

/// Takes a change of a vertex, or the insertion of one beside it, as far as a stage, and doesn't commit it.
template <class Mesh>
void begin_change(Mesh& mesh, int id, int stage)
{
  using Change = weft::internal::Vertex_transaction_3<Mesh>;
  weft::internal::Vacant_numbers_3<Mesh> vacant(mesh);
  const auto v = mesh.vertices()[static_cast<std::size_t>(id)];
  const weft::Vertex_location_3 location = v->location();
  const Point p = v->point();
  std::vector<typename Mesh::Vertex_handle> neighbours;
  mesh.triangulation().finite_adjacent_vertices(v, std::back_inserter(neighbours));
  const auto w =
      *std::find_if(neighbours.begin(), neighbours.end(), [](const auto& n) { return n->location().dimension >= 0; });
  const auto beside = weft::internal::project_on_location(mesh.oracle(), p + 0.3 * (w->point() - p), location);
  REQUIRE(beside);
  typename Mesh::Zone zone;
  const auto find = [&](typename Mesh::Cell_handle near) {
    return weft::internal::find_conflict_zone(mesh.triangulation(), *beside, near, zone) ==
           weft::internal::Zone_result::found;
  };
  if (stage > 4) {
    if (!find(v->cell())) return;
    if (stage == 5)
      Change(mesh, zone, location);
    else
      Change(mesh, zone, location, id);
    return;
  }
  Change change(mesh, v);
  if (stage == 1) change.leave_out();
  if (stage == 2) change.leave_out(vacant);
  if (stage < 3 || !find(change.filling().front())) return;
  change.place(zone);
  if (stage == 4) change.take_out_again();
}

/// An oracle that throws when asked often enough, once or from then on.
struct Interrupting_oracle : Oracle
{
  explicit Interrupting_oracle(const Oracle& oracle) : Oracle(oracle) {}
  template <class Hits>
  int intersect(const Point& p, const Point& q, Hits& hits) const
  {
    if (questions_left == 0 || (questions_left < 0 && keeps_throwing)) {
      questions_left = -1;
      throw std::runtime_error("interrupted");
    }
    --questions_left;
    return Oracle::intersect(p, q, hits);
  }
  mutable long questions_left = -1; ///< negative: it doesn't throw, or has done so
  mutable bool keeps_throwing = false;
};

} // namespace

namespace {

using Ids = std::vector<int>;

template <class Cell_handle>
Ids ids_of(Cell_handle c, int but = -1)
{
  Ids ids;
  for (int i = 0; i < 4; ++i)
    if (i != but) ids.push_back(c->vertex(i)->id());
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// The cells of a zone and the facets around it by the ids of their vertices, the latter with those beyond.
std::set<std::pair<Ids, Ids>> picture_of_zone(const Restricted::Zone& zone)
{
  std::set<std::pair<Ids, Ids>> all;
  for (const auto c : zone.cells) all.emplace(ids_of(c), Ids());
  for (const auto& [c, i] : zone.hull) all.emplace(ids_of(c, i), ids_of(c));
  return all;
}

} // namespace

TEST_CASE("points have the same conflict zones in a mesh without a vertex and beside the mesh that has it")
{
  const Oracle oracle = oracle_of(surfaces::cylinder(40));
  auto result = weft::make_mesh_3(oracle, criteria_of(0.3, 0.02));
  Restricted& mesh = result.restricted;
  weft::internal::Mesh_without_vertex_3<Restricted> without(mesh);
  std::mt19937 random(5);
  const auto draw = [&random] { return 0.6 * (static_cast<double>(random()) / 4294967295.0 - 0.5); };
  std::size_t found = 0;
  for (int k = 0; k < 40; ++k) {
    const auto v = mesh.vertices()[random() % mesh.vertices().size()];
    if (v->location().dimension == 0) continue;
    without.look_at(v, true);
    REQUIRE(without.leave_out());
    std::vector<Point> points = {v->point()};
    std::vector<std::set<std::pair<Ids, Ids>>> zones;
    for (int n = 0; n < 8; ++n) points.push_back(v->point() + Vector(draw(), draw(), draw()));
    std::vector<Restricted::Vertex_handle> neighbours; // no zone where another vertex is
    mesh.triangulation().finite_adjacent_vertices(v, std::back_inserter(neighbours));
    for (const auto w : neighbours) points.push_back(w->point());
    for (const Point& p : points) {
      Restricted::Zone zone;
      zones.emplace_back();
      if (!without.find_zone(p, zone)) continue;
      zones.back() = picture_of_zone(zone);
      for (const auto c : zone.cells) CHECK(without.is_in_zone(c));
      for (const auto& f : zone.hull) CHECK(!without.is_in_zone(f.first));
    }
    weft::internal::Vertex_transaction_3<Restricted> change(mesh, v);
    for (std::size_t n = 0; n < points.size(); ++n) {
      Restricted::Zone zone;
      const bool is_found = find_conflict_zone(mesh.triangulation(), points[n], change.filling().front(), zone) ==
                            weft::internal::Zone_result::found;
      CHECK((is_found ? picture_of_zone(zone) : std::set<std::pair<Ids, Ids>>()) == zones[n]);
      found += is_found;
    }
    change.roll_back();
  }
  CHECK(found > 200);
}

TEST_CASE("vertices move together, some of them or all are taken back, and everything kept agrees")
{
  const Oracle oracle = oracle_of(surfaces::cylinder(40));
  auto result = weft::make_mesh_3(oracle, criteria_of(0.2, 0.02));
  Restricted& mesh = result.restricted;
  const auto before = picture_of(mesh);
  weft::internal::Moves_together_3<Restricted> together(mesh);
  std::mt19937 random(6);
  const auto draw = [&random] { return 0.1 * (static_cast<double>(random()) / 4294967295.0 - 0.5); };
  const auto check = [&mesh] {
    const auto agreement = weft::check_restricted_3(mesh);
    INFO(agreement);
    CHECK(agreement.ok());
  };
  for (const bool all : {false, true}) {
    together.begin();
    const auto here = picture_of(mesh);
    std::size_t refused = 0;
    for (const auto v : std::vector<Restricted::Vertex_handle>(mesh.vertices()))
      if (const int id = v->id(); v->location().dimension == 3)
        refused +=
            !together.move(id, mesh.vertices()[static_cast<std::size_t>(id)]->point() + Vector(draw(), draw(), draw()));
    CHECK(together.size() > 5);
    CHECK(refused > 5); // they would have changed what others made
    together.classify();
    check();
    CHECK(picture_of(mesh) != here);
    std::vector<char> is_back(together.size(), false);
    std::vector<std::size_t> waiting;
    for (std::size_t k = 0; k < together.size(); k += all ? 1 : 2) waiting.push_back(k);
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      const std::size_t k = waiting[i];
      if (is_back[k]) continue;
      is_back[k] = true;
      for (const std::size_t other : together.take_back(k))
        if (!is_back[other]) waiting.push_back(other);
    }
    together.classify();
    check();
    if (all) CHECK(picture_of(mesh) == here);
  }
  CHECK(picture_of(mesh) != before);
}

TEST_CASE("a change of a vertex that isn't committed is rolled back, wherever it ends")
{
  for (const Surface& surface : {surfaces::cylinder(40), surfaces::cube()}) {
    const Oracle oracle = oracle_of(surface);
    auto [mesh, report] = weft::make_mesh_3(oracle, criteria_of(0.4, 0.02));
    const auto before = picture_of(mesh);
    std::mt19937 random(5);
    for (int k = 0; k < 8 * stages_of_change; ++k) {
      const auto v = mesh.vertices()[random() % mesh.vertices().size()];
      if (mesh.is_fixed(v)) continue;
      begin_change(mesh, v->id(), k % stages_of_change);
      INFO("stage " << k % stages_of_change);
      REQUIRE(picture_of(mesh) == before);
      const auto agreement = weft::check_restricted_3(mesh);
      INFO(agreement);
      CHECK(agreement.ok());
    }
  }
}

TEST_CASE("a change of a vertex is rolled back when the oracle throws")
{
  const Oracle oracle = oracle_of(surfaces::cylinder(40));
  auto [finished, report] = weft::make_mesh_3(oracle, criteria_of(0.4, 0.02));
  const Interrupting_oracle interrupting(oracle);
  weft::Restricted_delaunay_3<Interrupting_oracle> mesh(interrupting);
  std::vector<Point> points;
  std::vector<weft::Vertex_location_3> locations;
  for (const auto v : finished.vertices()) {
    points.push_back(v->point());
    locations.push_back(v->location());
  }
  mesh.insert(points, locations);
  const auto before = picture_of(mesh);
  std::mt19937 random(6);
  int interruptions = 0;
  for (int k = 0; k < 12 * stages_of_change; ++k) {
    const auto v = mesh.vertices()[random() % mesh.vertices().size()];
    if (mesh.is_fixed(v)) continue;
    const int stage = k % stages_of_change, id = v->id();
    interrupting.questions_left = k / stages_of_change / 2;
    interrupting.keeps_throwing = k / stages_of_change % 2 == 1;
    try {
      begin_change(mesh, id, stage);
    } catch (const std::runtime_error&) {
      ++interruptions;
    }
    interrupting.questions_left = -1;
    interrupting.keeps_throwing = false;
    mesh.update(); // what is left if it was rolling back that the oracle interrupted
    INFO("stage " << stage << " of vertex " << id);
    REQUIRE(picture_of(mesh) == before);
    const auto agreement = weft::check_restricted_3(mesh);
    INFO(agreement);
    CHECK(agreement.ok());
  }
  CHECK(interruptions > 6 * stages_of_change);
}

TEST_CASE("moves, insertions and removals can be undone to the last cell")
{
  for (const Surface& surface : {surfaces::torus(48, 24), surfaces::cylinder(40), surfaces::cube()}) {
    const Oracle oracle = oracle_of(surface);
    const Criteria criteria = criteria_of(0.3, 0.02);
    auto result = weft::make_mesh_3(oracle, criteria, weft::Mesh_options_3::refinement());
    Restricted& mesh = result.restricted;
    const auto before = cells_of(mesh);
    std::vector<Point> points;
    for (const auto v : mesh.vertices()) points.push_back(v->point());
    weft::Perturb_options_3 options;
    weft::Perturb_report_3 report;
    weft::internal::Criteria_guard_3<Restricted> guard(mesh, criteria);
    Perturber perturber(mesh, guard, options, report);
    perturber.set_bound(std::cos(0.1));
    perturber.set_kick_bound(std::cos(0.01));
    perturber.begin();
    std::mt19937 random(4);
    for (int k = 0; k < 200; ++k) {
      const int id = static_cast<int>(random() % mesh.vertices().size());
      if (k % 4 == 0)
        perturber.remove(id, std::cos(0.01));
      else if (k % 4 == 1)
        perturber.move(id, Perturber::Purpose::kick, 10);
      else {
        const auto c = mesh.vertices()[static_cast<std::size_t>(id)]->cell();
        if (c->subdomain() != 0) perturber.insert_near(c, 20, std::cos(0.01), k % 4 == 2);
      }
    }
    CHECK(report.removals > 0);
    CHECK(report.insertions > 0);
    CHECK(report.by_chance > 0);
    CHECK(cells_of(mesh) != before);
    perturber.undo();
    CHECK(cells_of(mesh) == before);
    REQUIRE(mesh.vertices().size() == points.size());
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(mesh.vertices()[i]->point() == points[i]);
    check_sound(mesh, oracle, criteria);
  }
}

TEST_CASE("vertices are also inserted on patches that have none yet, but facets between creases")
{
  Surface plate = surfaces::cube();
  for (Point& p : plate.points) p = Point(p.x(), p.y(), 0.2 * p.z());
  const Oracle oracle = oracle_of(plate);
  Criteria criteria;
  criteria.size = 0.4;
  auto [mesh, refined] = weft::make_mesh_3(oracle, criteria, weft::Mesh_options_3::refinement());
  REQUIRE(refined.ok());
  std::set<int> bare; // patches
  for (const auto& f : mesh.facets())
    if (f.cell != Restricted::Cell_handle()) bare.insert(f.patch);
  for (const auto v : mesh.vertices())
    if (v->location().dimension == 2) bare.erase(v->location().index);
  REQUIRE(bare.size() == 4);
  weft::Perturb_options_3 options;
  weft::Perturb_report_3 report;
  weft::internal::Criteria_guard_3<Restricted> guard(mesh, criteria);
  Perturber perturber(mesh, guard, options, report);
  std::size_t reached = 0;
  for (const int patch : bare) {
    bool inserted = false;
    for (std::size_t k = 0; k < mesh.facets().size() && !inserted; ++k) {
      const auto& f = mesh.facets()[k];
      if (f.cell == Restricted::Cell_handle() || f.patch != patch) continue;
      const auto c = f.cell->subdomain() != 0 ? f.cell : f.cell->neighbor(f.index);
      inserted = perturber.insert_near(c, 400, std::cos(0.01)) &&
                 mesh.vertices().back()->location() == weft::Vertex_location_3{2, patch};
    }
    reached += inserted;
  }
  CHECK(reached > 0); // shapes of what it makes don't allow it everywhere
  check_sound(mesh, oracle, criteria);
}

TEST_CASE("as far as it goes: the smallest angle never falls, and all that held holds")
{
  struct Case
  {
    Surface surface;
    double size, approximation, reached;
  };
  for (const Case& c : {Case{surfaces::torus(48, 24), 0.3, 0.02, 28}, Case{surfaces::cylinder(40), 0.4, 0.02, 25},
                        Case{surfaces::l_shape(), 0.3, 0, 28}}) {
    const Oracle oracle = oracle_of(c.surface);
    const Criteria criteria = criteria_of(c.size, c.approximation);
    auto [mesh, refined] = weft::make_mesh_3(oracle, criteria, weft::Mesh_options_3::refinement());
    REQUIRE(refined.ok());
    const double refined_distance =
        weft::hausdorff_3(weft::tetrahedral_mesh(mesh), oracle.complex().points, oracle.complex().triangles, 5000)
            .two_sided();
    weft::Perturb_options_3 options;
    options.target = 90;
    double last = 0;
    int calls = 0;
    options.go_on = [&, &mesh = mesh](double angle) {
      CHECK(angle >= last - 1e-9); // rounding depends on the order of vertices
      last = angle;
      if (calls % 20 == 0) {
        CHECK(weft::measure_quality_3(weft::tetrahedral_mesh(mesh)).smallest_dihedral.degrees ==
              Approx(angle).margin(1e-6));
        CHECK(mesh.triangulation().is_valid());
      }
      return ++calls < 120; // not by time, so that the test is repeatable
    };
    const auto report = weft::perturb_slivers_3(mesh, criteria, options);
    CHECK(report.after >= last);
    CHECK(report.after > c.reached);
    CHECK(report.kicks_kept <= report.kicks);
    CHECK(mesh.vertices().size() == refined.vertices + report.insertions - report.removals);
    check_sound(mesh, oracle, criteria);
    const double distance =
        weft::hausdorff_3(weft::tetrahedral_mesh(mesh), oracle.complex().points, oracle.complex().triangles, 5000)
            .two_sided();
    CHECK(distance <= std::max(1.1 * refined_distance, 2 * c.approximation) + 1e-12);
  }
}

TEST_CASE("equal seeds give equal meshes, other seeds others")
{
  const Oracle oracle = oracle_of(surfaces::cylinder(40));
  const Criteria criteria = criteria_of(0.4, 0.02);
  const auto run = [&](unsigned seed, weft::Perturb_directions_3 directions) {
    auto result = weft::make_mesh_3(oracle, criteria, weft::Mesh_options_3::refinement());
    weft::Perturb_options_3 options;
    options.target = 90;
    options.seed = seed;
    options.directions = directions;
    int calls = 0;
    options.go_on = [&](double) { return ++calls < 40; };
    const auto report = weft::perturb_slivers_3(result.restricted, criteria, options);
    CHECK((directions == weft::Perturb_directions_3::random) == (report.by_radius + report.by_volume == 0));
    CHECK(report.by_chance > 0);
    check_sound(result.restricted, oracle, criteria);
    return weft::tetrahedral_mesh(result.restricted);
  };
  using weft::Perturb_directions_3;
  const Mesh first = run(0, Perturb_directions_3::combined);
  CHECK(same(first, run(0, Perturb_directions_3::combined)));
  CHECK(!same(first, run(1, Perturb_directions_3::combined)));
  CHECK(!same(first, run(0, Perturb_directions_3::random)));
}

TEST_CASE("without time nothing changes, and with little the mesh is sound")
{
  const Oracle oracle = oracle_of(surfaces::torus(48, 24));
  const Criteria criteria = criteria_of(0.3, 0.02);
  for (const double limit : {0., 0.002, 0.02, 0.2}) {
    auto [mesh, refined] = weft::make_mesh_3(oracle, criteria, weft::Mesh_options_3::refinement());
    const auto before = cells_of(mesh);
    weft::Perturb_options_3 options;
    options.target = 90;
    options.time_limit = limit;
    const auto report = weft::perturb_slivers_3(mesh, criteria, options);
    if (limit == 0) CHECK(cells_of(mesh) == before);
    CHECK(report.after >= report.before);
    check_sound(mesh, oracle, criteria);
  }
}

TEST_CASE("a mesh that can't be improved ends the run by itself")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  Criteria criteria;
  criteria.size = 10;                    // the eight corners, none of which may move, and hardly anything else
  for (const double target : {90, 65}) { // as far as it goes; out of reach
    auto [mesh, refined] = weft::make_mesh_3(oracle, criteria, weft::Mesh_options_3::refinement());
    weft::Perturb_options_3 options;
    options.target = target;
    const auto report = weft::perturb_slivers_3(mesh, criteria, options);
    CHECK(report.after >= report.before);
    CHECK(report.after < target);
    check_sound(mesh, oracle, criteria);
  }
}
