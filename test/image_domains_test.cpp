// SPDX-License-Identifier: GPL-3.0-or-later
//
// Domains of images: components, shapes and borders of random labels against brute force, and meshes of images whose
// components and volumes are known.

#include "fixtures/image_domains_3.h"
#include "fixtures/meshing_fixtures_3.h"
#include "fixtures/surface_fixtures.h"

#include <weft/spatial/domain/contacts_at_edges_3.h>
#include <weft/spatial/domain/looks_like_grey_values.h>
#include <weft/spatial/domain/missing_components_3.h>
#include <weft/spatial/domain/shape_of_image_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace {

using image_domains::Oracle;
using meshing::K;
using meshing::Mesh;
using meshing::Point;
using weft::Grey_image_3;
using weft::Label_image_3;
using Voxel = weft::Voxel_image_3::Voxel;
using Size = std::array<std::size_t, 3>;

const double pi = std::acos(-1.0);

std::ptrdiff_t count(const Size& size, std::size_t axis)
{
  return static_cast<std::ptrdiff_t>(size[axis]);
}

template <class Visit>
void for_each_voxel(const Size& size, const Visit& visit)
{
  Voxel v;
  for (v[2] = 0; v[2] < count(size, 2); ++v[2])
    for (v[1] = 0; v[1] < count(size, 1); ++v[1])
      for (v[0] = 0; v[0] < count(size, 0); ++v[0]) visit(v);
}

Label_image_3 image_of(const Size& size, const std::array<double, 3>& spacing,
                       const std::function<int(const Voxel&)>& label)
{
  std::vector<int> values;
  for_each_voxel(size, [&](const Voxel& v) { values.push_back(label(v)); });
  return Label_image_3(size, spacing, {{0, 0, 0}}, values);
}

Grey_image_3 grey_image_of(const Size& size, const std::function<double(const Voxel&)>& value, double iso)
{
  std::vector<float> values;
  for_each_voxel(size, [&](const Voxel& v) { values.push_back(static_cast<float>(value(v))); });
  return Grey_image_3(size, {{1, 1, 1}}, {{0, 0, 0}}, values, iso);
}

/// Each voxel belongs to the nearest of n points, so that there is no outside.
Label_image_3 grains(const Size& size, int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<std::array<double, 3>> sites;
  for (int i = 0; i < n; ++i) {
    sites.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) sites.back()[k] = random() / 4294967296.0 * static_cast<double>(size[k]);
  }
  return image_of(size, {{1, 1, 1}}, [&](const Voxel& v) {
    int nearest = 0;
    double least = HUGE_VAL;
    for (int i = 0; i < n; ++i) {
      const auto& s = sites[static_cast<std::size_t>(i)];
      const double d = std::hypot(s[0] - static_cast<double>(v[0]), s[1] - static_cast<double>(v[1]),
                                  s[2] - static_cast<double>(v[2]));
      if (d < least) least = d, nearest = i + 1;
    }
    return nearest;
  });
}

/// Volumes by label, from random points.
std::map<int, double> sampled_volumes(const weft::Voxel_image_3& image, int n)
{
  std::map<int, double> sums;
  const CGAL::Bbox_3 b = image.bbox();
  const double part = (b.xmax() - b.xmin()) * (b.ymax() - b.ymin()) * (b.zmax() - b.zmin()) / n;
  std::mt19937 random(3);
  const auto between = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  for (int i = 0; i < n; ++i) {
    const double x = between(b.xmin(), b.xmax()), y = between(b.ymin(), b.ymax()), z = between(b.zmin(), b.zmax());
    sums[image(Point(x, y, z))] += part;
  }
  return sums;
}

/// Numbers voxels by what hangs together with them through faces, of those that `belongs` says; -1 for others.
std::map<Voxel, int> flooded(const Size& size, std::ptrdiff_t margin,
                             const std::function<bool(const Voxel&, const Voxel&)>& connects)
{
  std::map<Voxel, int> number;
  int parts = 0;
  Voxel v;
  for (v[2] = -margin; v[2] < count(size, 2) + margin; ++v[2])
    for (v[1] = -margin; v[1] < count(size, 1) + margin; ++v[1])
      for (v[0] = -margin; v[0] < count(size, 0) + margin; ++v[0]) {
        if (number.count(v) || !connects(v, v)) continue;
        number[v] = parts;
        surfaces::flood(v, [&](const Voxel& from, const Voxel& to) {
          for (std::size_t j = 0; j < 3; ++j)
            if (to[j] < -margin || to[j] >= count(size, j) + margin) return false;
          return !number.count(to) && connects(from, to) && number.emplace(to, parts).second;
        });
        ++parts;
      }
  return number;
}

int number_of_parts(const std::map<Voxel, int>& number)
{
  std::set<int> parts;
  for (const auto& [v, part] : number) parts.insert(part);
  return static_cast<int>(parts.size());
}

struct Meshed
{
  Mesh mesh;
  weft::Mesh_report_3 report;
};

Meshed mesh_of(const Oracle& oracle, double size, double approximation, double floor)
{
  weft::Criteria_3<K> criteria;
  criteria.size = size;
  criteria.approximation = approximation;
  weft::Mesh_options_3 options;
  options.size_floor = floor;
  auto result = weft::make_mesh_3(oracle, criteria, options);
  meshing::check_consistent(result.restricted, result.report);
  return {weft::tetrahedral_mesh(result.restricted), result.report};
}

} // namespace

// ---- components and shapes

TEST_CASE("components of labels, and what surrounds them, are those of a flood")
{
  std::mt19937 random(1);
  for (int round = 0; round < 30; ++round) {
    const Size size{{1 + random() % 6, 1 + random() % 6, 1 + random() % 6}};
    const unsigned labels = 2 + random() % 3;
    const auto image = image_of(size, {{1, 2, 0.5}}, [&](const Voxel& v) {
      return v == Voxel{{0, 0, 0}} ? 1 : static_cast<int>(random() % labels);
    });
    const weft::Voxel_components_3 components(image);
    const auto number =
        flooded(size, 0, [&](const Voxel& a, const Voxel& b) { return image.label(a) == image.label(b); });
    REQUIRE(components.components().size() == static_cast<std::size_t>(number_of_parts(number)));
    std::map<std::size_t, std::size_t> voxels;
    for (const auto& [v, part] : number) {
      CHECK(components.component(v) == static_cast<std::size_t>(part)); // both number them by their first voxels
      ++voxels[static_cast<std::size_t>(part)];
    }
    const auto surroundings = components.number_of_surroundings();
    for (std::size_t c = 0; c < components.components().size(); ++c) {
      const weft::Voxel_component_3& component = components.components()[c];
      CHECK(component.voxels == voxels[c]);
      CHECK(component.volume == Approx(static_cast<double>(voxels[c])));
      CHECK(component.label == image.label(component.first));
      const auto is_outside = [&](const Voxel& v) { return !image.contains(v) || components.component(v) != c; };
      CHECK(surroundings[c] == number_of_parts(flooded(size, 1, [&](const Voxel& a, const Voxel& b) {
              return is_outside(a) && is_outside(b);
            })));
    }
  }
}

TEST_CASE("the shape of an image has the volume of random samples and the topology that was drawn")
{
  const Size size{{13, 12, 11}};
  const auto middle_distance = [](const Voxel& v, double x, double y, double z) {
    return std::hypot(static_cast<double>(v[0]) - x, static_cast<double>(v[1]) - y, static_cast<double>(v[2]) - z);
  };
  const auto check = [&](const std::function<int(const Voxel&)>& label,
                         const std::map<int, std::array<long, 2>>& wanted) {
    const auto image = image_of(size, {{0.5, 1, 2}}, label);
    const auto shape = weft::shape_of_image(image, weft::Voxel_components_3(image));
    auto volume = sampled_volumes(image, 150000);
    REQUIRE(shape.size() == wanted.size());
    for (const auto& [l, topology] : wanted) {
      CHECK(shape.at(l).components == topology[0]);
      CHECK(shape.at(l).euler == topology[1]);
      const double deviation = std::sqrt(volume[l] * 13 * 12 * 11 / 150000); // of the random samples
      CHECK(shape.at(l).volume == Approx(volume[l]).margin(4 * deviation));
    }
  };
  check([&](const Voxel& v) { return middle_distance(v, 6, 6, 5) < 4.2; }, {{1, {{1, 2}}}});
  // A ball around another, and within a third that fills the image.
  check(
      [&](const Voxel& v) { return middle_distance(v, 6, 6, 5) < 2.2   ? 2
                                   : middle_distance(v, 6, 6, 5) < 4.2 ? 1
                                                                       : 3; },
      {{1, {{2, 4}}}, {2, {{1, 2}}}, {3, {{2, 4}}}});
  // A ring, and a box beside it.
  check(
      [&](const Voxel& v) {
        const double q = std::hypot(static_cast<double>(v[0]) - 6, static_cast<double>(v[1]) - 6) - 3.5;
        return std::hypot(q, static_cast<double>(v[2]) - 3) < 1.5 ? 1 : v[2] > 7 ? 2 : 0;
      },
      {{1, {{1, 0}}}, {2, {{1, 2}}}});
  // Voxels that meet at an edge: nobody knows.
  check([&](const Voxel& v) { return (v[0] < 5) == (v[1] < 5) ? 1 : 0; }, {{1, {{-1, 0}}}});
}

TEST_CASE("the area of an image's shape is nearly that of a box and of a ball")
{
  const auto box = image_of({{8, 9, 10}}, {{1, 1, 1}}, [](const Voxel& v) { return 1 + (v[2] > 4); });
  const auto shape = weft::image_oracle_3<K>(box).shape();
  CHECK(shape.at(1).area == Approx(2 * (8 * 9 + 8 * 5 + 9 * 5)).epsilon(0.02));
  CHECK(shape.at(1).volume == Approx(8 * 9 * 5));
  const auto ball = grey_image_of(
      {{24, 24, 24}},
      [](const Voxel& v) {
        return std::hypot(static_cast<double>(v[0]) - 11.4, static_cast<double>(v[1]) - 11.6,
                          static_cast<double>(v[2]) - 11.5);
      },
      8);
  CHECK(!ball.lies_above());
  const auto of_ball = weft::image_oracle_3<K>(ball).shape();
  CHECK(of_ball.at(1).volume == Approx(4 * pi / 3 * 512).epsilon(0.01)); // interpolation flattens it a little
  CHECK(of_ball.at(1).volume == Approx(sampled_volumes(ball, 150000)[1]).epsilon(0.01));
  CHECK(of_ball.at(1).area == Approx(4 * pi * 64).epsilon(0.08));
  CHECK(of_ball.at(1).components == 1);
  CHECK(of_ball.at(1).euler == 2);
}

TEST_CASE("labels that are grey values are told from labels")
{
  const auto ball = [](const Voxel& v) {
    return std::hypot(static_cast<double>(v[0]) - 14.5, static_cast<double>(v[1]) - 14.5,
                      static_cast<double>(v[2]) - 14.5);
  };
  const Size size{{30, 30, 30}};
  CHECK(weft::looks_like_grey_values(
      image_of(size, {{1, 1, 1}}, [&](const Voxel& v) { return std::max(0, static_cast<int>(250 - 20 * ball(v))); })));
  CHECK(weft::looks_like_grey_values(image_of(size, {{1, 1, 1}}, [&](const Voxel& v) {
          return static_cast<int>(100 * ball(v)) % 200 / 2 - 20;
        })) == false); // saw teeth: far from each other
  CHECK(!weft::looks_like_grey_values(image_of(size, {{1, 1, 1}}, [&](const Voxel& v) { return ball(v) < 9; })));
  for (const int n : {6, 60, 200}) CHECK(!weft::looks_like_grey_values(grains({{24, 24, 24}}, n, 7)));
}

// ---- borders

TEST_CASE("an image's oracle has the label of the image everywhere, and patches and creases on the faces where it ends")
{
  for (unsigned seed = 1; seed < 7; ++seed) {
    std::mt19937 random(seed);
    const Size size{{4 + random() % 4, 4 + random() % 4, 4 + random() % 4}};
    const auto image = image_of(size, {{1, 0.5, 2}}, [&](const Voxel&) { return static_cast<int>(random() % 5); });
    const Oracle oracle = weft::image_oracle_3<K>(image);
    const CGAL::Bbox_3 b = oracle.bbox();
    const auto somewhere = [&](double beyond) {
      const auto between = [&](double low, double high) {
        return low - beyond + (high - low + 2 * beyond) * (random() / 4294967296.0);
      };
      const double x = between(b.xmin(), b.xmax()), y = between(b.ymin(), b.ymax());
      return Point(x, y, between(b.zmin(), b.zmax()));
    };
    const auto at_face = [&](const Point& p, int face) {
      const double faces[] = {b.xmin(), b.xmax(), b.ymin(), b.ymax(), b.zmin(), b.zmax()};
      return p[face / 2] == faces[face];
    };
    for (int i = 0; i < 300; ++i) {
      const Point p = somewhere(1), q = somewhere(1);
      CHECK(oracle.subdomain(p) == image(p));
      std::vector<weft::Surface_hit_3<K>> hits;
      CHECK(oracle.intersect(p, q, hits) == (image(p) ^ image(q)));
      for (const auto& hit : hits) {
        const auto [low, high] = oracle.sides_of_patch(hit.patch);
        const int face = oracle.face_of_patch(hit.patch);
        CHECK((low == image(p) || high == image(p) || low == image(q) || high == image(q)));
        if (face >= 0) {
          CHECK(at_face(hit.point, face));
          CHECK(oracle.subdomain(hit.point) == high);
          CHECK(oracle.patch_at_border(high, face) == hit.patch);
          const auto same = oracle.project_on_patch(hit.point, hit.patch);
          CHECK(same.patch == hit.patch);
          CHECK(same.point == hit.point);
          const auto from_afar = oracle.project_on_patch(p, hit.patch); // which may not find it
          CHECK((from_afar.patch < 0 || (from_afar.patch == hit.patch && at_face(from_afar.point, face))));
        } else {
          CHECK(Oracle::patch_between(low, high) == hit.patch);
        }
      }
    }
    // Creases have at least three sectors around them, counting the outside and each face apart.
    for (int c = 0; c < static_cast<int>(oracle.number_of_creases()); ++c) {
      const auto points = oracle.crease_points(c);
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Point middle = CGAL::midpoint(points[i], points[i + 1]);
        int faces = 0, axis = 0;
        for (int f = 0; f < 6; ++f)
          if (at_face(middle, f)) ++faces, axis = f / 2;
        REQUIRE(faces >= 1);
        std::set<int> labels;
        for (int k = 0; k < 16; ++k) {
          const double r = 0.1, u = r * std::cos(k * pi / 8), v = r * std::sin(k * pi / 8);
          double x[3] = {middle.x(), middle.y(), middle.z()};
          x[(axis + 1) % 3] += u, x[(axis + 2) % 3] += v;
          if (const Point p(x[0], x[1], x[2]);
              faces == 1 || (b.xmin() <= x[0] && x[0] <= b.xmax() && b.ymin() <= x[1] && x[1] <= b.ymax() &&
                             b.zmin() <= x[2] && x[2] <= b.zmax()))
            labels.insert(image(p));
        }
        if (faces == 1)
          CHECK(labels.size() > 1); // labels meet
        else
          CHECK(*labels.rbegin() > 0); // an edge of the box
      }
    }
  }
}

TEST_CASE("what fills an image to its border has flat faces, sharp edges and all of its volume")
{
  const Size size{{9, 8, 10}};
  const auto image = grains(size, 3, 2);
  const Oracle oracle = weft::image_oracle_3<K>(image);
  const Meshed result = mesh_of(oracle, 1.5, 0.3, 0.3);
  INFO(result.report);
  CHECK(result.report.ok());
  auto volume = meshing::volumes_of_subdomains(result.mesh);
  auto wanted = sampled_volumes(image, 300000);
  double sum = 0;
  for (const auto& [label, own] : volume) {
    CHECK(own == Approx(wanted[label]).epsilon(0.03));
    sum += own;
  }
  CHECK(sum == Approx(9 * 8 * 10).epsilon(0.003));
  const CGAL::Bbox_3 b = oracle.bbox();
  const double faces[] = {b.xmin(), b.xmax(), b.ymin(), b.ymax(), b.zmin(), b.zmax()};
  std::array<double, 6> areas{};
  for (std::size_t f = 0; f < result.mesh.facets.size(); ++f) {
    const int face = oracle.face_of_patch(result.mesh.patches[f]);
    if (face < 0) continue;
    const auto& v = result.mesh.facets[f];
    const auto n = CGAL::cross_product(result.mesh.points[v[1]] - result.mesh.points[v[0]],
                                       result.mesh.points[v[2]] - result.mesh.points[v[0]]);
    areas[static_cast<std::size_t>(face)] += std::abs(CGAL::to_double(n[face / 2])) / 2;
  }
  for (const int face : {0, 1, 2, 3, 4, 5}) {
    const double area = 9. * 8 * 10 / static_cast<double>(size[static_cast<std::size_t>(face / 2)]);
    CHECK(areas[static_cast<std::size_t>(face)] == Approx(area).epsilon(0.01));
  }
  for (std::size_t v = 0; v < result.mesh.points.size(); ++v) {
    const auto& at = result.mesh.locations[v];
    const int face = at.dimension == 2 ? oracle.face_of_patch(at.index) : -1;
    if (face >= 0) CHECK(result.mesh.points[v][face / 2] == faces[face]);
  }
  std::set<Point> corners;
  for (const std::size_t v : result.mesh.corners) corners.insert(result.mesh.points[v]);
  for (const double x : {b.xmin(), b.xmax()})
    for (const double y : {b.ymin(), b.ymax()})
      for (const double z : {b.zmin(), b.zmax()}) CHECK(corners.count(Point(x, y, z)) == 1);
}

TEST_CASE("a single voxel is a cube")
{
  const Label_image_3 voxel({{1, 1, 1}}, {{1, 2, 3}}, {{0, 0, 0}}, {5});
  const Oracle oracle = weft::image_oracle_3<K>(voxel);
  CHECK(oracle.number_of_corners() == 8);
  CHECK(oracle.number_of_creases() == 12);
  const Meshed result = mesh_of(oracle, 1, 0.05, 0);
  INFO(result.report);
  CHECK(result.report.ok());
  CHECK(meshing::volumes_of_subdomains(result.mesh)[1] == Approx(6));
}

// ---- components in meshes

TEST_CASE("small components stay in the mesh, and those that don't are listed")
{
  // Balls on a lattice, from one voxel to many.
  std::mt19937 random(5);
  std::map<Voxel, std::pair<double, int>> balls;
  for (std::ptrdiff_t x = 5; x < 20; x += 10)
    for (std::ptrdiff_t y = 5; y < 20; y += 10)
      for (std::ptrdiff_t z = 4; z < 20; z += 8)
        balls[{{x, y, z}}] = {std::array<double, 4>{{0.5, 1.2, 2.1, 3.2}}[random() % 4],
                              1 + static_cast<int>(random() % 3)};
  const auto image = image_of({{20, 20, 20}}, {{0.3, 0.3, 0.9}}, [&](const Voxel& v) {
    for (const auto& [center, ball] : balls)
      if (std::hypot(static_cast<double>(v[0] - center[0]), static_cast<double>(v[1] - center[1]),
                     static_cast<double>(v[2] - center[2])) < ball.first)
        return ball.second;
    return 0;
  });
  const Oracle oracle = weft::image_oracle_3<K>(image);
  const auto missing = [&](const Mesh& mesh) { return weft::missing_components_3(image, oracle.components(), mesh); };
  const Meshed result = mesh_of(oracle, 1, 0.4, 0.09);
  INFO(result.report);
  CHECK(missing(result.mesh).empty());
  // Without the cells of some components these are missing.
  for (const unsigned modulus : {2u, 3u}) {
    Mesh less = result.mesh;
    less.cells.clear(), less.subdomains.clear();
    std::set<Voxel> taken;
    for (std::size_t c = 0; c < result.mesh.cells.size(); ++c) {
      const auto& v = result.mesh.cells[c];
      const auto p = CGAL::centroid(result.mesh.points[v[0]], result.mesh.points[v[1]], result.mesh.points[v[2]],
                                    result.mesh.points[v[3]]);
      const Voxel at = image.voxel_at(p);
      const Voxel cell{{at[0] / 10 * 10 + 5, at[1] / 10 * 10 + 5, at[2] / 8 * 8 + 4}};
      if ((cell[0] / 10 + cell[1] / 10 + cell[2] / 8) % static_cast<std::ptrdiff_t>(modulus) == 0) {
        taken.insert(cell);
        continue;
      }
      less.cells.push_back(v);
      less.subdomains.push_back(result.mesh.subdomains[c]);
    }
    const auto list = missing(less);
    CHECK(list.size() == taken.size());
    for (const weft::Voxel_component_3& c : list) {
      const Voxel cell{{c.first[0] / 10 * 10 + 5, c.first[1] / 10 * 10 + 5, c.first[2] / 8 * 8 + 4}};
      REQUIRE(taken.count(cell) == 1);
      CHECK(c.label == balls[cell].second);
      CHECK(c.volume == Approx(static_cast<double>(c.voxels) * 0.081));
    }
  }
  CHECK(missing(Mesh()).size() == 8);
}

TEST_CASE("grey values and signed distances are meshed to the volume of their ball")
{
  const Size size{{24, 24, 24}};
  const auto distance = [](const Voxel& v) {
    return std::hypot(static_cast<double>(v[0]) - 11.4, static_cast<double>(v[1]) - 11.6,
                      static_cast<double>(v[2]) - 11.5) -
           7.3;
  };
  const auto below = grey_image_of(size, distance, 0);
  const auto above = grey_image_of(
      size, [&](const Voxel& v) { return 100 - 10 * distance(v); }, 100);
  CHECK(!below.lies_above());
  CHECK(above.lies_above());
  for (const Grey_image_3& image : {below, above}) {
    const Oracle oracle = weft::image_oracle_3<K>(image);
    const Meshed result = mesh_of(oracle, 3, 0.15, 0.3);
    INFO(result.report);
    CHECK(result.report.ok());
    // By as much as the facets may be off.
    CHECK(meshing::volumes_of_subdomains(result.mesh)[1] ==
          Approx(4 * pi / 3 * 7.3 * 7.3 * 7.3).margin(0.15 * 4 * pi * 7.3 * 7.3));
    for (std::size_t v = 0; v < result.mesh.points.size(); ++v) {
      if (result.mesh.locations[v].dimension != 2) continue;
      const Point& p = result.mesh.points[v];
      CHECK(std::hypot(p.x() - 11.4, p.y() - 11.6, p.z() - 11.5) == Approx(7.3).margin(0.05));
    }
  }
  CHECK_THROWS_AS(grey_image_of(size, distance, -9), weft::Domain_error);
  CHECK_THROWS_AS(grey_image_of(
                      size, [](const Voxel&) { return std::nan(""); }, 0),
                  weft::Domain_error);
}

TEST_CASE("a checkerboard comes to an end, and the report says that topology doesn't hold")
{
  const auto image = image_of({{4, 4, 4}}, {{1, 1, 1}}, [](const Voxel& v) {
    for (std::size_t k = 0; k < 3; ++k)
      if (v[k] < 1 || v[k] > 2) return 0;
    return 1 + static_cast<int>((v[0] + v[1] + v[2]) % 2);
  });
  CHECK(weft::number_of_contacts_at_edges(image) == 3 * 2); // three directions, two layers, a square in each
  const Meshed result = mesh_of(weft::image_oracle_3<K>(image), 1, 0.6, 0.3);
  CHECK(!result.report.ok());
  CHECK(result.report.bad_vertices > 0);
  CHECK(result.report.stop_reason == weft::Stop_reason::exhausted);
  CHECK(result.mesh.points.size() < 3000);
  CHECK(weft::number_of_contacts_at_edges(grains({{10, 10, 10}}, 3, 1)) < 10);
}
