// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes a surface as mesh_3 does, turned at random if asked, and prints a JSON object: whether everything holds, and
// the dihedral angles of cells that small angles of the input force apart from those of the others.
//
//   measure_angles SURFACE SIZE [--approximation PERCENT] [--turn N] [--seed N] [--time-limit S] [--bad]
//                  [--output MESH] [--turned OFF]
//
// SIZE and edge lengths are in the input's units, PERCENT is of its bounding box diagonal (default 0.1).
// --bad: lists what isn't as good as asked and what is missed, on standard error.

#include "../common/program.h"
#include "../common/table.h"
#include "../common/user_time.h"

#include <weft/IO/read_surface.h>
#include <weft/IO/write_mesh_3.h>
#include <weft/mesh_surface_3.h>
#include <weft/spatial/criteria/forced_elements_3.h>
#include <weft/spatial/criteria/visit_bad_elements_3.h>
#include <weft/spatial/domain/check_domain_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/surface/mended_complex_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <iostream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Soup = weft::Polygon_soup_3<K>;
using Restricted = weft::Restricted_delaunay_3<weft::Polyhedral_oracle_3<K>>;
using weft::internal::degrees_of_cosine;

/// Turns about the origin by a random quaternion; the same seed gives the same turn.
void turn(Soup& soup, unsigned seed)
{
  std::mt19937 random(seed);
  const auto draw = [&random] { return static_cast<double>(random()) / 4294967295.0 - 0.5; };
  std::array<double, 4> q{{draw(), draw(), draw(), draw()}};
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& x : q) x /= length;
  const auto [w, x, y, z] = q;
  for (K::Point_3& p : soup.points)
    p = K::Point_3((1 - 2 * (y * y + z * z)) * p.x() + 2 * (x * y - z * w) * p.y() + 2 * (x * z + y * w) * p.z(),
                   2 * (x * y + z * w) * p.x() + (1 - 2 * (x * x + z * z)) * p.y() + 2 * (y * z - x * w) * p.z(),
                   2 * (x * z - y * w) * p.x() + 2 * (y * z + x * w) * p.y() + (1 - 2 * (x * x + y * y)) * p.z());
}

std::string off_of(const Soup& soup)
{
  std::ostringstream off;
  off << std::setprecision(std::numeric_limits<double>::max_digits10);
  off << "OFF\n" << soup.points.size() << " " << soup.polygons.size() << " 0\n";
  for (const auto& p : soup.points) off << p.x() << " " << p.y() << " " << p.z() << "\n";
  for (const auto& polygon : soup.polygons) {
    off << polygon.size();
    for (const std::size_t v : polygon) off << " " << v;
    off << "\n";
  }
  return off.str();
}

/// Dihedral angles in degrees, cells at small angles of the input apart.
struct Angles
{
  /// At larger angles cells needn't be worse than elsewhere.
  static constexpr double largest_forcing = weft::internal::largest_angle_with_twins;

  double unforced = 180; ///< the smallest of cells that nothing forces
  double part = 180;     ///< the smallest of forced ones, in parts of the angle that forces
  double largest = 0;
  std::size_t forced = 0, below_20 = 0; ///< cells; of those that nothing forces

  void add(const Restricted& mesh, Restricted::Cell_handle c, bool lists_bad)
  {
    const auto& p = [c](int i) -> const K::Point_3& { return c->vertex(i)->point(); };
    const auto x = weft::internal::cosines_of_extreme_dihedrals(p(0), p(1), p(2), p(3));
    const double angle = degrees_of_cosine(x.smallest), forcing = weft::internal::forcing_angle(mesh, c);
    largest = std::max(largest, degrees_of_cosine(x.largest));
    const bool is_forced = forcing <= largest_forcing;
    forced += is_forced;
    (is_forced ? part : unforced) = std::min(is_forced ? part : unforced, is_forced ? angle / forcing : angle);
    const bool is_bad = is_forced ? angle < 0.6 * forcing : angle < 20;
    below_20 += is_bad && !is_forced;
    if (!is_bad || !lists_bad) return;
    std::cerr << angle << " degrees, forced at " << forcing << ", ratio "
              << std::sqrt(CGAL::squared_distance(c->circumcenter(), p(0))) << ":";
    for (int i = 0; i < 4; ++i)
      std::cerr << "  " << c->vertex(i)->id() << " " << c->vertex(i)->location().dimension << "/"
                << c->vertex(i)->location().index << (mesh.is_fixed(c->vertex(i)) ? "f" : "")
                << (mesh.is_fixed_with_twin(c->vertex(i)) ? "t" : "") << " (" << p(i) << ")";
    std::cerr << "\n";
  }
};

std::string text_of(Restricted::Vertex_handle v)
{
  std::ostringstream text;
  text << "  " << v->location().dimension << "/" << v->location().index << " (" << v->point() << ")";
  return text.str();
}

/// Says which elements violate criteria, and what of the boundary is missed.
void list_bad(const Restricted& mesh, const weft::Criteria_3<K>& criteria)
{
  weft::internal::visit_bad_elements(
      mesh, criteria,
      [](const auto& e, auto...) { std::cerr << "bad edge of crease " << e.crease << " (" << e.steiner << ")\n"; },
      [](const auto& f, auto...) {
        std::cerr << "bad facet of patch " << f.patch;
        for (int i = 1; i < 4; ++i) std::cerr << text_of(f.cell->vertex((f.index + i) % 4));
        std::cerr << "\n";
      },
      [](auto c, auto...) {
        std::cerr << "bad cell";
        for (int i = 0; i < 4; ++i) std::cerr << text_of(c->vertex(i));
        std::cerr << "\n";
      },
      [&mesh](auto v) {
        std::cerr << "no disk" << text_of(v) << " facets:";
        mesh.visit_facets_at(v, [v](const auto& f) {
          std::cerr << " [" << f.patch;
          for (int i = 1; i < 4; ++i)
            if (f.cell->vertex((f.index + i) % 4) != v) std::cerr << text_of(f.cell->vertex((f.index + i) % 4));
          std::cerr << " r " << std::sqrt(f.squared_radius) << "]";
        });
        std::cerr << "\n";
      });
  std::vector<std::pair<K::Point_3, int>> missed;
  weft::check_domain_3(weft::tetrahedral_mesh(mesh), mesh.oracle(), criteria.approximation.constant(), 0, &missed);
  for (const auto& [p, patch] : missed) std::cerr << "missed of patch " << patch << " (" << p << ")\n";
}

double diagonal(const Soup& soup)
{
  CGAL::Bbox_3 box;
  for (const auto& p : soup.points) box += p.bbox();
  return std::hypot(box.x_span(), box.y_span(), box.z_span());
}

void run(benchmark::Argument_reader arguments)
{
  std::vector<std::string> operands;
  double percent = 0.1;
  unsigned turns = 0;
  bool lists_bad = false;
  std::string output, turned;
  weft::Mesh_options_3 options;
  while (arguments.next())
    if (arguments.is("--approximation"))
      percent = arguments.positive();
    else if (arguments.is("--turn"))
      turns = static_cast<unsigned>(arguments.number());
    else if (arguments.is("--seed"))
      options.seed = static_cast<unsigned>(arguments.number());
    else if (arguments.is("--time-limit"))
      options.time_limit = arguments.positive();
    else if (arguments.is("--bad"))
      lists_bad = true;
    else if (arguments.is("--output"))
      output = arguments.value();
    else if (arguments.is("--turned"))
      turned = arguments.value();
    else
      operands.push_back(arguments.operand());
  if (operands.size() != 2) throw weft::Option_error("usage: measure_angles SURFACE SIZE [OPTION...]");
  Soup soup = weft::IO::read_surface<K>(operands[0]);
  if (turns > 0) turn(soup, turns);
  if (!turned.empty()) benchmark::write_text(turned, off_of(soup));
  weft::Criteria_3<K> criteria;
  criteria.size = benchmark::Argument_reader::checked("SIZE", operands[1], true);
  criteria.approximation = diagonal(soup) * percent / 100;
  const benchmark::Stopwatch watch;
  const auto [domain, mesh, report] = weft::mesh_surface_3(weft::mended_complex_3(soup), criteria, options);
  const double seconds = watch.seconds();
  if (!output.empty()) weft::IO::write_mesh_3(output, weft::tetrahedral_mesh(mesh));
  Angles angles;
  for (const auto c : mesh.triangulation().finite_cell_handles())
    if (c->subdomain() != 0) angles.add(mesh, c, lists_bad);
  if (!report.ok()) std::cerr << report;
  if (lists_bad) list_bad(mesh, criteria);

  const auto yes = [](bool b) { return b ? "true" : "false"; };
  const auto number = [](std::size_t n) { return static_cast<double>(n); };
  benchmark::Json_object result;
  result.add_raw("ok", yes(report.ok())).add_raw("manifold", yes(report.manifold));
  result.add_raw("domain", yes(report.domain.ok())).add("stop_reason", name(report.stop_reason));
  result.add("bad", number(report.bad())).add("creases_given_up", number(report.creases_given_up));
  result.add("vertices", number(report.vertices)).add("cells", number(report.cells));
  result.add("forced", number(angles.forced)).add("below_20", number(angles.below_20));
  result.add("smallest", report.smallest_dihedral).add("largest", angles.largest);
  result.add("unforced", angles.unforced).add("part", angles.part).add("seconds", seconds);
  std::cout << result.str() << "\n";
}

} // namespace

int main(int argc, char** argv)
{
  return benchmark::run_program("measure_angles", [&] { run({argc, argv}); });
}
