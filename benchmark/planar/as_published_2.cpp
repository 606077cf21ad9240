// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each part of Alg. 2 of Tournois 2009 buys: triangles in parts of m_Delta (sec. 2.4), angles, batches and sweeps,
// of Alg. 2 as printed, with one part switched off at a time, and of `make_mesh_2()`.
//
//   as_published_2 [--triangles N]

#include "../common/program.h"
#include "../common/table.h"
#include "../common/user_time.h"
#include "planar_inputs.h"

#include <weft/make_mesh_2.h>
#include <weft/planar/graph/insert_pslg.h>
#include <weft/planar/mesh/quality_2.h>
#include <weft/planar/run/mesh_as_published_2.h>

#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

using namespace benchmark;

namespace {

using Cdt = weft::Mesh_triangulation_2<Kernel>;

double area_of(const Cdt& cdt)
{
  double area = 0;
  for (const auto f : cdt.finite_face_handles())
    if (f->is_in_domain()) area += CGAL::area(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point());
  return area;
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("as_published_2", [&] {
    double triangles = 3000;
    for (Argument_reader a(argc, argv); a.next();)
      if (a.is("--triangles"))
        triangles = a.positive();
      else
        a.operand();
    using Options = weft::As_published_options_2;
    std::vector<std::pair<std::string, Options>> ways(7);
    ways[0].first = "as printed";
    ways[1].first = "refine, then optimise";
    ways[1].second.interleave = false;
    ways[2].first = "target 1 at once";
    ways[2].second.lower_slowly = false;
    ways[3].first = "no alteration of edges";
    ways[3].second.alter_edges = false;
    ways[4].first = "no alteration of triangles";
    ways[4].second.alter_triangles = false;
    ways[5].first = "S = S' = 0.3 %";
    ways[5].second.move_ratio = ways[5].second.final_move_ratio = 0.003;
    ways[6].first = "with size feedback";
    ways[6].second.size_feedback = 3;
    std::cout << markdown_head(
        {"input", "way", "vertices", "T / m_Delta", "angles", "largest ratio", "batches", "sweeps", "user s"});
    for (const Planar_input& input : planar_inputs()) {
      for (std::size_t k = 0; k <= ways.size(); ++k) {
        Cdt cdt;
        weft::insert_pslg(cdt, input.pslg);
        weft::mark_domain_by_parity(cdt);
        const double area = area_of(cdt), size = std::sqrt(4 * area / std::sqrt(3.) / triangles);
        const Stopwatch watch;
        std::vector<std::string> tail;
        if (k < ways.size()) {
          const auto report = weft::mesh_as_published_2(cdt, size, ways[k].second);
          tail = {text(report.largest_ratio, 2), std::to_string(report.batches), std::to_string(report.sweeps)};
        } else {
          const auto report = weft::make_mesh_2(cdt, size);
          tail = {text(report.largest_ratio, 2), std::to_string(report.batches), std::to_string(report.sweeps)};
        }
        const double seconds = watch.seconds();
        const auto quality = weft::measure_quality_2(cdt);
        std::vector<std::string> row{
            input.name, k < ways.size() ? ways[k].first : "make_mesh_2()", std::to_string(cdt.number_of_vertices()),
            text(static_cast<double>(quality.triangles) / triangles, 2),
            text(quality.smallest_angle.degrees, 1) + " to " + text(quality.largest_angle.degrees, 1)};
        row.insert(row.end(), tail.begin(), tail.end());
        row.push_back(seconds_text(seconds));
        std::cout << markdown_row(row);
      }
    }
  });
}
