// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random planar straight line graphs, sizes and options: each run ends in time, in one of weft's errors or in a valid
// mesh. Every case has a seed of its own, which is in the message when it fails.

#include "fixtures/meshing_2.h"

#include <weft/make_mesh_2.h>
#include <weft/planar/sizing/Lfs_sizing_2.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace {

using namespace planar;

/// Ends the program with the seed of the case at work when that takes far too long.
class Watchdog
{
public:
  explicit Watchdog(int seconds) : seconds_(seconds), thread_([this] { watch(); }) {}
  ~Watchdog()
  {
    done_ = true;
    thread_.join();
  }
  void begin(unsigned seed)
  {
    seed_ = seed;
    age_ = 0;
  }

private:
  void watch()
  {
    constexpr int ticks = 20; // a second
    while (!done_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1000 / ticks));
      if (++age_ <= seconds_ * ticks) continue;
      std::fprintf(stderr, "the case with seed %u hangs\n", seed_.load());
      std::abort();
    }
  }

  int seconds_;
  std::atomic<bool> done_{false};
  std::atomic<unsigned> seed_{0};
  std::atomic<int> age_{0};
  std::thread thread_;
};

struct Case
{
  Pslg pslg;
  weft::Crossings crossings = weft::Crossings::refuse;
  weft::Mesh_options_2 options;
  double size = 1, tolerance = 0;
  int field = 0;
  std::string text;
};

/// Puts the graph at an extreme place now and then.
void transform(Pslg& pslg, Random& random, std::ostream& text)
{
  const double angle = random() % 2 ? 0 : uniform(random, 0, 2 * pi);
  double scale = 1, dx = 0, dy = 0;
  switch (below(random, 6)) {
  case 0: {
    constexpr std::array<double, 8> scales{1e-150, 1e-60, 1e-50, 1e-10, 1e10, 1e50, 1e60, 1e150};
    scale = scales[below(random, scales.size())];
    break;
  }
  case 1:
    dx = std::pow(10.0, uniform(random, 6, 12));
    dy = random() % 2 ? -dx : 0;
    break;
  default:
    break;
  }
  pslg = transformed(pslg, scale, angle, dx, dy);
  text << ", scale " << scale << ", angle " << angle << ", offset " << dx << " " << dy;
}

weft::Mesh_options_2 random_options(Random& random, std::ostream& text)
{
  weft::Mesh_options_2 options;
  const auto one_in = [&](std::size_t n) { return below(random, n) == 0; };
  if (one_in(4)) options.seeding = weft::Seeding::none;
  if (one_in(4)) options.min_angle = uniform(random, 0, 40);
  if (one_in(4)) options.grade_input = false;
  if (one_in(4)) options.polish = false;
  if (one_in(4)) options.size_feedback = uniform(random, 0, 8);
  if (one_in(8)) options.max_sweeps = static_cast<int>(below(random, 5));
  if (one_in(8)) options.max_batches = static_cast<int>(below(random, 5));
  options.final_quadrature = 20;
  options.max_vertices = one_in(4) ? below(random, 50) : 50 + below(random, 1200);
  options.time_limit = one_in(10) ? uniform(random, 0, 0.01) : 0.4;
  text << ", seeding " << static_cast<int>(options.seeding) << ", min_angle " << options.min_angle << ", grade_input "
       << options.grade_input << ", polish " << options.polish << ", size_feedback " << options.size_feedback
       << ", max_sweeps " << options.max_sweeps << ", max_batches " << options.max_batches << ", max_vertices "
       << options.max_vertices << ", time_limit " << options.time_limit;
  return options;
}

/// A hole somewhere. Whether a point within rounding of a segment is left or right of it isn't the mesher's business.
void add_hole(Pslg& pslg, Random& random, std::ostream& text)
{
  const double d = diameter(pslg);
  const Point& corner = pslg.points[below(random, pslg.points.size())];
  const Point hole(corner.x() + uniform(random, -0.3, 0.3) * d, corner.y() + uniform(random, -0.3, 0.3) * d);
  const double largest = (std::max)(std::abs(hole.x()), std::abs(hole.y()));
  for (const auto& [a, b] : pslg.segments)
    if (std::sqrt(CGAL::squared_distance(hole, K::Segment_2(pslg.points[a], pslg.points[b]))) < 1e-13 * largest) return;
  pslg.holes.push_back(hole);
  text << ", hole " << hole;
}

/// The graph that a triangulation was filled with once crossings had been split.
Pslg split_graph(const Cdt& cdt, const Pslg& pslg)
{
  Pslg result;
  std::map<Cdt::Vertex_handle, std::size_t> number;
  for (const auto v : cdt.finite_vertex_handles()) {
    number[v] = result.points.size();
    result.points.push_back(v->point());
  }
  for (auto e = cdt.constrained_edges_begin(); e != cdt.constrained_edges_end(); ++e)
    result.segments.push_back(
        {number.at(e->first->vertex(cdt.ccw(e->second))), number.at(e->first->vertex(cdt.cw(e->second)))});
  result.holes = pslg.holes;
  return result;
}

Case random_case(unsigned seed)
{
  Random random(seed);
  Case result;
  std::ostringstream text;
  const int kind = static_cast<int>(seed % kinds_of_random_graphs);
  text << "seed " << seed << ", kind " << kind;
  result.pslg = random_pslg(kind, random);
  transform(result.pslg, random, text);
  if (below(random, 3) == 0) result.crossings = weft::Crossings::split;
  if (below(random, 8) == 0) add_hole(result.pslg, random, text);
  result.size =
      diameter(result.pslg) * std::pow(10.0, below(random, 5) ? uniform(random, -1.7, 0.5) : uniform(random, -9, 9));
  result.field = static_cast<int>(below(random, 5));
  text << ", split " << static_cast<int>(result.crossings) << ", size " << result.size << ", field " << result.field;
  result.options = random_options(random, text);
  result.text = text.str();
  return result;
}

Field random_field(const Case& c)
{
  const double s = c.size, d = diameter(c.pslg);
  const Point o = c.pslg.points.front();
  switch (c.field) {
  case 2:
    return weft::Lfs_sizing_2<K>(c.pslg, 0.5, 1e-3 * s);
  case 3:
    return [=](const Point& p) { return p.x() < o.x() ? s : 10 * s; };
  default:
    return [=](const Point& p) { return s + 0.5 * (std::min)(d, std::sqrt(CGAL::squared_distance(o, p))); };
  }
}

/// What a case comes to: "" for a valid mesh or one of weft's errors.
struct Outcome
{
  std::string faults;
  bool is_mesh = false, is_complete = false;
};

template <class Sizing>
void mesh_and_check(Cdt& cdt, const Case& c, const Sizing& sizing, Outcome& outcome)
{
  const weft::Mesh_report_2 report = weft::make_mesh_2(cdt, sizing, c.options);
  outcome.is_mesh = true;
  outcome.is_complete = report.ok();
  outcome.faults = mesh_faults(cdt, c.pslg);
  if (outcome.faults.empty() && report.ok()) outcome.faults = faults(weft::check_sizing_2(cdt, sizing));
}

Outcome run(Case& c)
{
  Outcome outcome;
  Cdt cdt;
  try {
    Pslg graph = weft::insert_pslg(cdt, c.pslg, {c.crossings, c.tolerance}).graph;
    weft::mark_domain(cdt, c.pslg);
    if (c.tolerance > 0) c.pslg = std::move(graph);
  } catch (const weft::Error&) {
    return outcome;
  }
  if (c.tolerance == 0 && c.crossings == weft::Crossings::split) c.pslg = split_graph(cdt, c.pslg);
  outcome.faults = mesh_faults(cdt, c.pslg);
  if (!outcome.faults.empty()) {
    outcome.faults = "already before meshing: " + outcome.faults;
    return outcome;
  }
  try {
    if (c.field < 2)
      mesh_and_check(cdt, c, weft::Uniform_sizing<>(c.size), outcome);
    else
      mesh_and_check(cdt, c, random_field(c), outcome);
  } catch (const weft::Error& error) {
    outcome.faults = mesh_faults(cdt, c.pslg);
    if (!outcome.faults.empty()) outcome.faults = std::string("after '") + error.what() + "': " + outcome.faults;
  } catch (const std::exception& error) {
    outcome.faults = std::string("not one of weft's errors: ") + error.what();
  }
  return outcome;
}

struct Tally
{
  int meshes = 0, complete = 0;
};

/// Runs the cases with the given seeds, each with its own time bound.
/// \param tolerance of `insert_pslg()`.
Tally fuzz(unsigned first, unsigned last, double tolerance = 0)
{
  constexpr double most_seconds = 10; // time limits of the cases are below half a second
  Watchdog watchdog(120);
  Tally tally;
  for (unsigned seed = first; seed < last; ++seed) {
    watchdog.begin(seed);
    Case c = random_case(seed);
    c.tolerance = tolerance;
    INFO(c.text);
    if (std::getenv("WEFT_FUZZ_VERBOSE")) std::fprintf(stderr, "%s\n", c.text.c_str());
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = run(c);
    CHECK(outcome.faults == "");
    CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < most_seconds);
    tally.meshes += outcome.is_mesh;
    tally.complete += outcome.is_complete;
  }
  return tally;
}

} // namespace

TEST_CASE("every random graph ends in an error of weft or a valid mesh")
{
  const Tally tally = fuzz(0, 400);
  // Else the cases say nothing.
  CHECK(tally.meshes > 200);
  CHECK(tally.complete > 60);
}

TEST_CASE("random graphs whose close points are joined end in an error of weft or a valid mesh")
{
  const double tolerance = weft::Pslg_options().tolerance;
  const Tally tally = fuzz(400, 500, tolerance);
  CHECK(tally.meshes > 50);
  CHECK(tally.complete > 15);
}

TEST_CASE("every one of many random graphs ends in an error of weft or a valid mesh", "[.nightly]")
{
  const Tally tally = fuzz(1000, 7000);
  CHECK(tally.meshes > 3000);
  CHECK(tally.complete > 1000);
  for (const double tolerance : {1e-12, weft::Pslg_options().tolerance, 1e-6, 1e-3})
    CHECK(fuzz(7000, 8000, tolerance).meshes > 400);
}
