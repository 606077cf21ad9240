// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the program improve_3 as a user sees it: exit statuses, what it says and where, and which files are
// there afterwards.

#include "fixtures/program_fixture.h"
#include "fixtures/spatial_fixtures.h"

#include <weft/IO/write_mesh_3.h>
#include <weft/version.h>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

using program::contains;
using program::Names;
using program::number;
using program::Outcome;

/// An empty folder with a ball full of slivers, where improve_3 runs.
struct Folder : program::Folder
{
  explicit Folder(const std::string& name) : program::Folder("improve_3_program_test_" + name, WEFT_IMPROVE_3)
  {
    weft::IO::write_mesh_3("ball_" + name + ".mesh", fixtures::ball(300, 300).mesh);
    std::ifstream in("ball_" + name + ".mesh");
    write("ball.mesh", {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
    std::filesystem::remove("ball_" + name + ".mesh");
  }

  /// Names of the files that weren't there before.
  Names new_files() const
  {
    Names names = files();
    names.erase("ball.mesh");
    return names;
  }
};

bool is_one_line(const std::string& err)
{
  return program::is_one_line(err, "improve_3");
}

} // namespace

TEST_CASE("an improved mesh gives status 0 and every file that was asked for, and says how it was before and after")
{
  for (const std::string boundary : {"", " --boundary fixed"}) {
    const Folder folder("complete");
    const Outcome outcome = folder.run("ball.mesh --min-dihedral 10 --output m.mesh --output m.vtu --output m.msh "
                                       "--output m.off --histogram h.svg --report r.json" +
                                       boundary);
    CAPTURE(outcome.err, outcome.out);
    CHECK(outcome.status == 0);
    CHECK(outcome.err == "");
    CHECK(contains(outcome.out, "before: 600 vertices"));
    CHECK(contains(outcome.out, "after:  "));
    CHECK(folder.new_files() == Names{"m.mesh", "m.vtu", "m.msh", "m.off", "h.svg", "r.json"});
    const std::string report = folder.read("r.json"), before = report.substr(report.find("\"before\"")),
                      after = report.substr(report.find("\"after\""));
    CHECK(number(before, "degrees") < 5);
    CHECK(number(after, "degrees") >= 10);
    CHECK(contains(folder.read("h.svg"), "before: "));
    CHECK(contains(folder.read("h.svg"), "after: "));
    const Outcome again = folder.run("m.vtu --min-dihedral 10 --quiet --output n.mesh" + boundary);
    CHECK(again.status == 0);
    CHECK(again.out == "");
  }
}

TEST_CASE("an angle that can't be reached gives status 2 and the mesh as good as it got")
{
  const Folder folder("unreachable");
  const Outcome outcome = folder.run("ball.mesh --min-dihedral 60 --time-limit 1 --boundary fixed --output m.mesh");
  CHECK(outcome.status == 2);
  CHECK(is_one_line(outcome.err));
  CHECK(contains(outcome.err, "the smallest dihedral angle is"));
  CHECK(folder.new_files() == Names{"m.mesh"});
}

TEST_CASE("bad usage and bad input give status 1, one line, and no file")
{
  const Folder folder("refused");
  folder.write("bad.mesh",
               "MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 0\nHexahedra\n1\n1 1 1 1 1 1 1 1 0\n");
  for (const std::string arguments :
       {"", "missing.mesh", "bad.mesh", "ball.mesh ball.mesh", "ball.mesh --boundary glued", "ball.mesh --output m.xyz",
        "ball.mesh --boundary fixed --sharp-angle 30", "ball.mesh --min-dihedral 80", "ball.mesh --unknown",
        "ball.mesh --deviation 0", "ball.mesh --threads 0"}) {
    const Outcome outcome = folder.run(arguments + " --report r.json");
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.out == "");
    CHECK(is_one_line(outcome.err));
  }
  CHECK(folder.new_files() == Names{"bad.mesh"});
}

TEST_CASE("help and version are printed")
{
  const Folder folder("help");
  const Outcome help = folder.run("--help");
  CHECK(help.status == 0);
  CHECK(contains(help.out, "usage: improve_3"));
  CHECK(contains(help.out, "--boundary"));
  CHECK(contains(folder.run("--version").out, WEFT_VERSION));
}
