// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the program adapt_3 as a user sees it: exit statuses, what it says and where, and which files are there
// afterwards.

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
using program::number;
using program::Outcome;

/// An empty folder with a box, where adapt_3 runs.
struct Folder : program::Folder
{
  explicit Folder(const std::string& name) : program::Folder("adapt_3_program_test_" + name, WEFT_ADAPT_3)
  {
    const auto mesh = fixtures::box(4).mesh;
    const std::string file = "adapt_" + name + ".mesh";
    weft::IO::write_mesh_3(file, mesh);
    std::ifstream in(file);
    write("box.mesh", {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
    std::filesystem::remove(file);
    std::string sizes =
        "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n" + std::to_string(mesh.points.size()) + "\n1 1\n";
    for (const auto& p : mesh.points) sizes += p.x() < 0.3 * 4 ? "0.4\n" : "1.6\n";
    write("box.sol", sizes + "End\n");
  }
};

} // namespace

TEST_CASE("a mesh adapts to sizes at its vertices, and the files that were asked for are there")
{
  const Folder folder("field");
  const Outcome outcome = folder.run("box.mesh --size-field box.mesh --output m.mesh --output m.vtu --report r.json");
  CAPTURE(outcome.err, outcome.out);
  CHECK(outcome.status == 0);
  CHECK(contains(outcome.out, "all criteria met"));
  CHECK(folder.files().count("m.mesh") == 1);
  CHECK(folder.files().count("m.vtu") == 1);
  CHECK(number(folder.read("r.json"), "longest_edge") <= 1.6);
  const Outcome again = folder.run("m.mesh --size 0.5 --quiet --report s.json");
  CHECK(again.status == 0);
  CHECK(again.out == "");
  CHECK(number(folder.read("s.json"), "longest_edge") <= 0.5);
}

TEST_CASE("bad usage gives status 1, one line and no file")
{
  const Folder folder("usage");
  for (const std::string arguments : {"", "box.mesh", "box.mesh --size 0", "box.mesh --size 1 --gradation -1",
                                      "missing.mesh --size 1", "box.mesh --size-field missing.vtu"}) {
    INFO(arguments);
    const Outcome outcome = folder.run(arguments);
    CHECK(outcome.status == 1);
    CHECK(program::is_one_line(outcome.err, "adapt_3"));
    CHECK(outcome.out == "");
  }
  CHECK(contains(folder.run("--help").out, "--gradation"));
  CHECK(contains(folder.run("--version").out, WEFT_VERSION));
}
