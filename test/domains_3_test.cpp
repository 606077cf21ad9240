// SPDX-License-Identifier: GPL-3.0-or-later
//
// Domains that aren't one closed surface: implicit functions, labellings, labelled images, several surfaces.

#include "fixtures/domains_3.h"
#include "fixtures/meshing_fixtures_3.h"

#include <map>
#include <random>

namespace {

using domains::Implicit;
using domains::Labelled;
using domains::Labelling;
using meshing::K;
using meshing::Mesh;
using meshing::Point;

const double pi = std::acos(-1.0);

double torus(const Point& p)
{
  const double q = std::hypot(p.x(), p.y()) - 1;
  return q * q + p.z() * p.z() - 0.16;
}
const CGAL::Bbox_3 torus_box(-1.5, -1.5, -0.5, 1.5, 1.5, 0.5);

/// A ball of three materials.
int three_parts(const Point& p)
{
  if (p.x() * p.x() + p.y() * p.y() + p.z() * p.z() > 1) return 0;
  return p.x() < 0.2 ? 1 : p.y() < 0 ? 2 : 3;
}
const CGAL::Bbox_3 ball_box(-1.1, -1.1, -1.1, 1.1, 1.1, 1.1);

template <class Oracle>
auto mesh_of(const Oracle& oracle, double size, double approximation, weft::Mesh_options_3 options = {})
{
  weft::Criteria_3<K> criteria;
  criteria.size = size;
  criteria.approximation = approximation;
  auto result = weft::make_mesh_3(oracle, criteria, options);
  meshing::check_consistent(result.restricted, result.report);
  CHECK(result.report.ok());
  CHECK(result.report.smallest_dihedral >= options.min_dihedral_angle);
  Mesh mesh = weft::tetrahedral_mesh(result.restricted);
  weft::Validity_3 validity = weft::validate_3(mesh);
  validity += weft::check_criteria_3(mesh, criteria);
  validity += weft::check_manifold_3(mesh); // subdomain by subdomain
  INFO(validity);
  CHECK(validity.ok());
  return mesh;
}

weft::Polygon_soup_3<K> soup(const meshing::Surface& surface)
{
  weft::Polygon_soup_3<K> result{surface.points, {}};
  for (const auto& t : surface.triangles) result.polygons.emplace_back(t.begin(), t.end());
  return result;
}

meshing::Surface shifted(meshing::Surface s, double x, double y = 0, double z = 0)
{
  return surfaces::moved(std::move(s), 1, x, y, z);
}

} // namespace

TEST_CASE("an implicit torus is meshed with its topology, volume and surface")
{
  const Implicit oracle(torus, torus_box);
  const Mesh mesh = mesh_of(oracle, 0.3, 0.01);
  CHECK(meshing::euler_characteristic(mesh.facets) == 0);
  CHECK(meshing::number_of_shells(mesh) == 1);
  CHECK(meshing::volumes_of_subdomains(mesh)[1] == Approx(2 * pi * pi * 0.16).epsilon(0.03));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (mesh.locations[v].dimension == 2)
      CHECK(std::abs(torus(mesh.points[v])) < 1e-8);
    else
      CHECK(torus(mesh.points[v]) < 0);
  }
}

TEST_CASE("crossings and projections of an implicit function lie on its boundary and near the nearest point")
{
  const Implicit oracle([](const Point& p) { return p.x() * p.x() + p.y() * p.y() + p.z() * p.z() - 1; }, ball_box);
  std::mt19937 random(5);
  const auto number = [&] { return 1.0 - 2.0 * (random() / 4294967295.0); };
  for (int k = 0; k < 500; ++k) {
    const double x = number(), y = number(), z = number();
    const Point p(x, y, z);
    const double r = std::sqrt(x * x + y * y + z * z);
    if (r < 0.05) continue;
    const auto hit = oracle.closest(p);
    REQUIRE(hit.patch == 0);
    CHECK(std::sqrt(CGAL::squared_distance(hit.point, Point(0, 0, 0))) == Approx(1).epsilon(1e-8));
    CHECK(std::sqrt(CGAL::squared_distance(hit.point, p)) <= 1.05 * std::abs(1 - r) + 1e-3 * 3.8);
    std::vector<weft::Surface_hit_3<K>> hits;
    const Point q(number(), number(), number());
    CHECK(oracle.intersect(p, q, hits) == (oracle.subdomain(p) ^ oracle.subdomain(q)));
    for (const auto& h : hits)
      CHECK(std::sqrt(CGAL::squared_distance(h.point, Point(0, 0, 0))) == Approx(1).epsilon(1e-8));
  }
}

TEST_CASE("every component of an implicit domain is found, and cavities are")
{
  // Two balls, one with a cavity.
  const auto f = [](const Point& p) {
    const auto ball = [&](double x, double r) { return std::hypot(p.x() - x, p.y(), p.z()) - r; };
    return (std::min)((std::max)(ball(-1, 0.8), -ball(-1, 0.4)), ball(1, 0.5));
  };
  const Mesh mesh = mesh_of(Implicit(f, CGAL::Bbox_3(-2, -1, -1, 2, 1, 1)), 0.4, 0.02);
  CHECK(meshing::number_of_shells(mesh) == 3);
  CHECK(meshing::volumes_of_subdomains(mesh)[1] == Approx(4 * pi / 3 * (0.512 - 0.064 + 0.125)).epsilon(0.06));
}

TEST_CASE("a domain that reaches beyond its bounding box is cut off there")
{
  const Mesh mesh = mesh_of(Implicit([](const Point& p) { return p.z(); }, CGAL::Bbox_3(0, 0, -1, 1, 1, 1)), 0.4, 0.03);
  CHECK(meshing::volumes_of_subdomains(mesh)[1] == Approx(1).epsilon(0.05)); // without creases, edges are rounded off
}

TEST_CASE("functions that aren't numbers, throw or have no zero are refused")
{
  CHECK_THROWS_AS(Implicit([](const Point&) { return std::nan(""); }, ball_box), weft::Domain_error);
  CHECK_THROWS_AS(Implicit([](const Point&) { return 1.0; }, ball_box), weft::Domain_error);
  CHECK_THROWS_AS(Implicit([](const Point&) -> double { throw std::runtime_error("no"); }, ball_box),
                  std::runtime_error);
  CHECK_THROWS_AS(Labelled([](const Point&) { return 7; }, ball_box, 2), weft::Domain_error);
  CHECK_THROWS_AS(Labelled([](const Point&) { return -1; }, ball_box, 2), weft::Domain_error);
  // Found out while meshing: far from the seeds' grid lines.
  const auto late = [](const Point& p) {
    return std::hypot(p.x() - 0.0137, p.y() - 0.0171, p.z() - 0.0093) < 0.02 ? std::nan("")
                                                                             : std::hypot(p.x(), p.y(), p.z()) - 1;
  };
  try {
    const Implicit oracle(late, ball_box, 10);
    weft::Criteria_3<K> criteria;
    criteria.size = 0.3;
    weft::make_mesh_3(oracle, criteria, meshing::refinement());
  } catch (const weft::Domain_error& error) {
    CHECK(std::string(error.what()).find("isn't a number") != std::string::npos);
  }
}

TEST_CASE("three materials: interfaces are shared, volumes are right, criteria hold in each")
{
  const Labelled oracle(three_parts, ball_box, 4);
  const Mesh mesh = mesh_of(oracle, 0.25, 0.01);
  const double cap = pi * 0.8 * 0.8 * (3 - 0.8) / 3; // x > 0.2
  auto volume = meshing::volumes_of_subdomains(mesh);
  REQUIRE(volume.size() == 3);
  CHECK(volume[1] == Approx(4 * pi / 3 - cap).epsilon(0.03));
  CHECK(volume[2] == Approx(cap / 2).epsilon(0.04));
  CHECK(volume[3] == Approx(cap / 2).epsilon(0.04));
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto sides = Labelled::sides_of_patch(mesh.patches[f]);
    CHECK(Labelled::patch_between(sides.second, sides.first) == mesh.patches[f]);
  }
}

TEST_CASE("subdomains and patches may have criteria of their own, and demands of the user hold")
{
  const Labelled oracle(three_parts, ball_box, 4);
  weft::Criteria_3<K> criteria;
  criteria.size = 0.5;
  criteria.subdomains[2].size = 0.15;
  criteria.patches[Labelled::patch_between(0, 1)].size = 0.2;
  criteria.cell_demand = [](const weft::Cell_view_3<K>& cell) {
    const double near = CGAL::squared_distance(*cell.circumcenter, Point(-0.8, 0, 0));
    return near < 0.04 ? CGAL::squared_distance(*cell.circumcenter, *cell.points[0]) / 0.01 : 0;
  };
  const auto result = weft::make_mesh_3(oracle, criteria, weft::Mesh_options_3());
  CHECK(result.report.ok());
  const Mesh mesh = weft::tetrahedral_mesh(result.restricted);
  const auto longest = [&](const auto& corners) {
    double length = 0;
    for (const std::size_t v : corners)
      for (const std::size_t w : corners)
        length = (std::max)(length, std::sqrt(CGAL::squared_distance(mesh.points[v], mesh.points[w])));
    return length;
  };
  double of_others = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    CHECK(longest(mesh.cells[c]) <= (mesh.subdomains[c] == 2 ? 0.15 : 0.5) * (1 + 1e-9));
    if (mesh.subdomains[c] == 3) of_others = (std::max)(of_others, longest(mesh.cells[c]));
    const auto& v = mesh.cells[c];
    const Point o = CGAL::circumcenter(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]);
    if (CGAL::squared_distance(o, Point(-0.8, 0, 0)) < 0.0399)
      CHECK(CGAL::squared_distance(o, mesh.points[v[0]]) <= 0.01 * (1 + 1e-9));
  }
  CHECK(of_others > 0.3);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    if (mesh.patches[f] == Labelled::patch_between(0, 1)) CHECK(longest(mesh.facets[f]) <= 0.2 * (1 + 1e-9));
}

TEST_CASE("a labelled domain gives the same mesh for any number of threads")
{
  const Labelled oracle(three_parts, ball_box, 4);
  weft::Mesh_options_3 options;
  const Mesh one = mesh_of(oracle, 0.4, 0.02, options);
  options.threads = 4;
  CHECK(meshing::same(one, mesh_of(oracle, 0.4, 0.02, options)));
}

namespace {

/// An image of a labelling.
weft::Label_image_3 image_of(const Labelling& labelling, std::size_t n, double spacing)
{
  std::vector<int> values;
  const double middle = 0.5 * static_cast<double>(n - 1);
  for (std::size_t z = 0; z < n; ++z)
    for (std::size_t y = 0; y < n; ++y)
      for (std::size_t x = 0; x < n; ++x)
        values.push_back(
            labelling(Point((static_cast<double>(x) - middle) * spacing, (static_cast<double>(y) - middle) * spacing,
                            (static_cast<double>(z) - middle) * spacing)));
  return weft::Label_image_3({{n, n, n}}, {{spacing, spacing, spacing}},
                             {{-middle * spacing, -middle * spacing, -middle * spacing}}, values);
}

/// By labels, from random samples: a grid would lie on one side of plane interfaces.
std::map<int, double> volumes(const weft::Label_image_3& image)
{
  std::map<int, double> sums;
  constexpr int n = 4000000;
  const CGAL::Bbox_3 b = image.bbox();
  const double box = (b.xmax() - b.xmin()) * (b.ymax() - b.ymin()) * (b.zmax() - b.zmin());
  std::mt19937 random(3);
  const auto between = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  for (int i = 0; i < n; ++i) {
    const double x = between(b.xmin(), b.xmax()), y = between(b.ymin(), b.ymax()), z = between(b.zmin(), b.zmax());
    sums[image(Point(x, y, z))] += box / n;
  }
  return sums;
}

Labelled oracle_of(const weft::Label_image_3& image, int grid)
{
  return Labelled(Labelling(image), image.bbox(), image.number_of_labels(), grid);
}

} // namespace

TEST_CASE("an image of three materials is meshed to volumes within a percent")
{
  const auto image = image_of([](const Point& p) { return 10 * three_parts(p); }, 45, 0.05);
  CHECK(image.number_of_labels() == 4);
  CHECK(image.value(2) == 20);
  const Mesh mesh = mesh_of(oracle_of(image, 44), 0.12, 0.012);
  auto wanted = volumes(image);
  auto volume = meshing::volumes_of_subdomains(mesh);
  for (int label = 1; label <= 3; ++label) CHECK(volume[label] == Approx(wanted[label]).epsilon(0.01));
}

TEST_CASE("images of one voxel, with labels that touch at a point, or without sense are meshed or refused")
{
  // A voxel in the middle of the outside; one alone is a cube, see image_domains_test.
  std::vector<int> middle(27, 0);
  middle[13] = 5;
  const weft::Label_image_3 voxel({{3, 3, 3}}, {{1, 1, 1}}, {{0, 0, 0}}, middle);
  CHECK(voxel.number_of_labels() == 2);
  const Mesh one = mesh_of(oracle_of(voxel, 24), 0.15, 0);
  CHECK(meshing::volumes_of_subdomains(one)[1] == Approx(volumes(voxel)[1]).epsilon(0.1));

  const weft::Label_image_3 corners({{2, 2, 2}}, {{1, 1, 1}}, {{0, 0, 0}}, {1, 0, 0, 0, 0, 0, 0, 1});
  weft::Criteria_3<K> criteria;
  criteria.size = 0.5;
  weft::Mesh_options_3 options;
  options.max_vertices = 20000;
  const auto oracle = oracle_of(corners, 8);
  const auto result = weft::make_mesh_3(oracle, criteria, options);
  meshing::check_consistent(result.restricted, result.report);
  CHECK(result.report.cells > 0);

  using Image = weft::Label_image_3;
  CHECK_THROWS_AS(Image({{2, 2, 2}}, {{1, 1, 1}}, {{0, 0, 0}}, {1, 0, 0}), weft::Domain_error);
  CHECK_THROWS_AS(Image({{2, 1, 1}}, {{1, 1, 1}}, {{0, 0, 0}}, {0, 0}), weft::Domain_error);
  CHECK_THROWS_AS(Image({{1, 1, 1}}, {{1, 0, 1}}, {{0, 0, 0}}, {1}), weft::Domain_error);
  CHECK_THROWS_AS(Image({{0, 1, 1}}, {{1, 1, 1}}, {{0, 0, 0}}, {}), weft::Domain_error);
}

// ---- several surfaces

TEST_CASE("two cubes beside each other share an interface with creases around it")
{
  const auto complex = weft::piecewise_smooth_complex<K>({soup(surfaces::cube()), soup(shifted(surfaces::cube(), 1))});
  const meshing::Oracle oracle(complex);
  CHECK(complex.number_of_patches == 11);
  CHECK(complex.features.size() == 12);
  CHECK(complex.creases.size() == 20);
  const Mesh mesh = mesh_of(oracle, 0.3, 0.01);
  auto volume = meshing::volumes_of_subdomains(mesh);
  CHECK(volume[1] == Approx(1).epsilon(1e-9));
  CHECK(volume[2] == Approx(1).epsilon(1e-9));
  std::size_t shared = 0;
  for (const int patch : mesh.patches) {
    const auto [behind, before] = complex.sides[static_cast<std::size_t>(patch)];
    shared += behind != 0 && before != 0;
  }
  CHECK(shared > 10);
}

TEST_CASE("a surface within another cuts its subdomain out, whichever comes first")
{
  const auto outer = soup(surfaces::cube());
  const auto inner = soup(shifted(surfaces::moved(surfaces::cube(), 0.4, 0, 0, 0), 0.3, 0.3, 0.3));
  const meshing::Oracle oracle(weft::piecewise_smooth_complex<K>({outer, inner}));
  auto volume = meshing::volumes_of_subdomains(mesh_of(oracle, 0.4, 0.01));
  CHECK(volume[1] == Approx(1 - 0.064).epsilon(1e-9));
  CHECK(volume[2] == Approx(0.064).epsilon(1e-9));
  // The other way round the container covers what is in it.
  const auto covered = weft::piecewise_smooth_complex<K>({inner, outer});
  CHECK(covered.number_of_patches == 6);
}

TEST_CASE("the subdomain of a point is that of the last surface around it")
{
  const meshing::Surface a = surfaces::sphere(2), b = surfaces::moved(surfaces::sphere(2), 0.5, 0, 0, 0),
                         c = shifted(surfaces::sphere(2), 3);
  const std::vector<meshing::Surface> all = {a, b, c};
  const meshing::Oracle oracle(weft::piecewise_smooth_complex<K>({soup(a), soup(b), soup(c)}));
  std::vector<meshing::Oracle> single;
  for (const auto& s : all) single.push_back(meshing::oracle_of(s));
  std::mt19937 random(1);
  Point last(9, 9, 9);
  for (int k = 0; k < 3000; ++k) {
    const auto number = [&](double low, double high) { return low + (high - low) * (random() / 4294967295.0); };
    const double x = number(-1, 4), y = number(-1, 1), z = number(-1, 1);
    const Point p(x, y, z);
    int wanted = 0;
    for (std::size_t s = 0; s < 3; ++s)
      if (single[s].subdomain(p) != 0) wanted = static_cast<int>(s) + 1;
    CHECK(oracle.subdomain(p) == wanted);
    std::vector<weft::Surface_hit_3<K>> hits;
    CHECK(oracle.intersect(last, p, hits) == (oracle.subdomain(last) ^ wanted));
    last = p;
  }
}

TEST_CASE("surfaces that cross or overlap in part are refused")
{
  const auto cube = surfaces::cube();
  const auto refuses = [](const std::vector<weft::Polygon_soup_3<K>>& surfaces, const char* what) {
    try {
      weft::piecewise_smooth_complex(surfaces);
    } catch (const weft::Domain_error& error) {
      return std::string(error.what()).find(what) != std::string::npos;
    }
    return false;
  };
  CHECK(refuses({soup(cube), soup(shifted(cube, 0.51, 0.33, 0.27))}, "cross"));
  CHECK(refuses({soup(cube), soup(shifted(surfaces::moved(cube, 0.5, 0, 0, 0), 1, 0.25, 0.21))}, "overlap"));
  meshing::Surface open = cube;
  open.triangles.pop_back();
  CHECK(refuses({soup(cube), soup(open)}, "surface 1"));
  CHECK(refuses({}, "no surfaces"));
}
