// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the program improve_2 as a user sees it: exit statuses, what it says and where, and which files are
// there afterwards.

#include "fixtures/program_fixture.h"

#include <weft/version.h>

#include <catch2/catch.hpp>

#include <cstddef>
#include <random>
#include <sstream>
#include <string>

namespace {

using program::contains;
using program::Names;
using program::number;
using program::Outcome;

/// A square of n x n squares cut in two, as a Medit file; vertices inside are moved at random.
std::string shaken_square(int n)
{
  std::mt19937 random(1);
  std::ostringstream text;
  text << "MeshVersionFormatted 2\nDimension 2\nVertices\n" << (n + 1) * (n + 1) << "\n";
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      const bool inside = x > 0 && y > 0 && x < n && y < n;
      const double dx = static_cast<double>(random()) / 4294967296.0 - 0.5;
      const double dy = static_cast<double>(random()) / 4294967296.0 - 0.5;
      text << x + (inside ? dx : 0) << " " << y + (inside ? dy : 0) << " 0\n";
    }
  text << "Triangles\n" << 2 * n * n << "\n";
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x + 1, c = a + n + 1;
      text << a << " " << a + 1 << " " << c << " 3\n" << c << " " << a + 1 << " " << c + 1 << " 3\n";
    }
  text << "End\n";
  return text.str();
}

/// An empty folder with a bad mesh, where improve_2 runs.
struct Folder : program::Folder
{
  explicit Folder(const std::string& name) : program::Folder("improve_2_program_test_" + name, WEFT_IMPROVE_2)
  {
    write("square.mesh", shaken_square(12));
  }

  /// Names of the files that weren't there before.
  Names new_files() const
  {
    Names names = files();
    names.erase("square.mesh");
    return names;
  }
};

bool is_one_line(const std::string& err)
{
  return program::is_one_line(err, "improve_2");
}

} // namespace

TEST_CASE("an improved mesh gives status 0 and every file that was asked for, and says how it was before and after")
{
  for (const std::string boundary : {"", " --boundary fixed"}) {
    const Folder folder("complete");
    const Outcome outcome = folder.run("square.mesh --min-angle 35 --output m.mesh --output m.vtu --output m.msh "
                                       "--output m.off --output m.svg --histogram h.svg --report r.json" +
                                       boundary);
    CAPTURE(outcome.err, outcome.out);
    CHECK(outcome.status == 0);
    CHECK(outcome.err == "");
    CHECK(contains(outcome.out, "before: 169 vertices"));
    CHECK(contains(outcome.out, "after:  "));
    CHECK(folder.new_files() == Names{"m.mesh", "m.vtu", "m.msh", "m.off", "m.svg", "h.svg", "r.json"});
    const std::string report = folder.read("r.json"), before = report.substr(report.find("\"before\"")),
                      after = report.substr(report.find("\"after\""));
    CHECK(number(before, "degrees") < 20);
    CHECK(number(after, "degrees") >= 35);
    CHECK(contains(folder.read("h.svg"), "before: "));
    for (const std::string again : {"m.msh", "m.vtu", "m.off"}) {
      const Outcome second = folder.run(again + " --min-angle 35 --quiet --output n.mesh" + boundary);
      CHECK(second.status == 0);
      CHECK(second.out == "");
    }
  }
}

TEST_CASE("an angle that can't be reached gives status 2 and the mesh as good as it got")
{
  const Folder folder("unreachable");
  const Outcome outcome = folder.run("square.mesh --min-angle 55 --time-limit 1 --output m.mesh");
  CHECK(outcome.status == 2);
  CHECK(is_one_line(outcome.err));
  CHECK(contains(outcome.err, "the smallest angle is"));
  CHECK(folder.new_files() == Names{"m.mesh"});
}

TEST_CASE("bad usage and bad input give status 1, one line, and no file")
{
  const Folder folder("refused");
  folder.write("bad.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices\n1\n0 0 0\nTriangles\n1\n1 1 1 0\n");
  folder.write("crossing.off", "OFF\n5 2 0\n0 0 0\n2 0 0\n1 2 0\n1 -1 0\n1 1 0\n3 0 1 2\n3 0 3 4\n");
  for (const std::string arguments :
       {"", "missing.mesh", "bad.mesh", "crossing.off", "square.mesh square.mesh", "square.mesh --boundary glued",
        "square.mesh --output m.xyz", "square.mesh --boundary fixed --corner-angle 30", "square.mesh --min-angle 61",
        "square.mesh --unknown", "square.mesh --deviation 2", "square.mesh --threads 0"}) {
    const Outcome outcome = folder.run(arguments + " --report r.json");
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.out == "");
    CHECK(is_one_line(outcome.err));
  }
  CHECK(folder.new_files() == Names{"bad.mesh", "crossing.off"});
}

TEST_CASE("help and version are printed")
{
  const Folder folder("help");
  const Outcome help = folder.run("--help");
  CHECK(help.status == 0);
  CHECK(contains(help.out, "usage: improve_2"));
  CHECK(contains(help.out, "--corner-angle"));
  CHECK(contains(folder.run("--version").out, WEFT_VERSION));
}
