// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the program mesh_3 as a user sees it: exit statuses, what it says and where, and which files are there
// afterwards. The program is run for each of them in an empty folder.

#include "fixtures/program_fixture.h"

#include <weft/version.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace {

using program::contains;
using program::Names;
using program::number;
using program::Outcome;

/// An empty folder that goes with the test case, where mesh_3 runs. It holds a cube and one that lacks a face.
struct Folder : program::Folder
{
  explicit Folder(const std::string& name) : program::Folder("mesh_3_program_test_" + name, WEFT_MESH_3)
  {
    const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
    const std::string walls = "4 0 3 2 1\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
    write("cube.off", "OFF\n8 6 0\n" + points + walls + "4 4 5 6 7\n");
    write("open.off", "OFF\n8 5 0\n" + points + walls);
  }

  /// Names of the files that weren't there before.
  Names new_files() const
  {
    Names names = files();
    names.erase("cube.off");
    names.erase("open.off");
    return names;
  }
};

bool is_one_line(const std::string& err)
{
  return program::is_one_line(err, "mesh_3");
}

/// Number of elements in a section of a Medit file.
std::size_t count_in_medit(const std::string& text, const std::string& section)
{
  std::istringstream in(text);
  std::size_t count = 0;
  for (std::string word; in >> word;)
    if (word == section) in >> count;
  return count;
}

} // namespace

TEST_CASE("a complete mesh gives status 0 and every file that was asked for, and says nothing on stderr")
{
  const Folder folder("complete");
  const Outcome outcome = folder.run("cube.off --size 0.4 --output m.mesh --output m.vtu --output m.msh --output m.off "
                                     "--output m.stl --histogram h.svg --report r.json");
  CHECK(outcome.status == 0);
  CHECK(outcome.err == "");
  CHECK(contains(outcome.out, "all criteria met"));
  CHECK(folder.new_files() == Names{"m.mesh", "m.vtu", "m.msh", "m.off", "m.stl", "h.svg", "r.json"});
  const std::string medit = folder.read("m.mesh"), report = folder.read("r.json");
  CHECK(count_in_medit(medit, "Tetrahedra") > 20);
  CHECK(count_in_medit(medit, "Corners") == 8);
  CHECK(contains(folder.read("m.vtu"), "</VTKFile>"));
  CHECK(contains(folder.read("m.msh"), "$EndElements"));
  CHECK(contains(folder.read("h.svg"), "Dihedral angles: cube.off"));
  CHECK(contains(report, "\"ok\": true"));
  CHECK(number(report, "volume") == Approx(1));
  CHECK(number(report, "boundary_area") == Approx(6));
  CHECK(number(report, "longest_edge") <= 0.4);
  CHECK(number(report, "crease_edges") >= 36);
  CHECK(number(report, "cells") == static_cast<double>(count_in_medit(medit, "Tetrahedra")));
}

TEST_CASE("without options the mesh is as fine as the help says, in parts of the diagonal")
{
  const Folder folder("defaults");
  const Outcome outcome = folder.run("cube.off --report r.json --quiet");
  CHECK(outcome.status == 0);
  CHECK(outcome.out == "");
  CHECK(outcome.err == "");
  const double longest = number(folder.read("r.json"), "longest_edge");
  CHECK(longest <= 0.05 * std::sqrt(3.));
  CHECK(longest > 0.025 * std::sqrt(3.));
  folder.run(
      "cube.off --size 5% --approximation 0.1% --facet-shape 2 --cell-shape 2 --sharp-angle 60 --report same.json");
  const auto quality = [](const std::string& json) { return json.substr(json.find("\"quality\"")); };
  CHECK(quality(folder.read("same.json")) == quality(folder.read("r.json")));
}

TEST_CASE("sizes come from features and from files, and grade")
{
  const Folder folder("sizes");
  folder.write("plate.off", "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 .2\n1 0 .2\n1 1 .2\n0 1 .2\n4 0 3 2 1\n"
                            "4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n4 4 5 6 7\n");
  const auto longest = [&](const std::string& arguments) {
    const Outcome outcome = folder.run(arguments + " --report r.json --quiet");
    CHECK(outcome.status == 0);
    return number(folder.read("r.json"), "longest_edge");
  };
  CHECK(longest("plate.off --size 0.6") > 0.3);
  CHECK(longest("plate.off --size 0.6 --size auto") < 0.2); // half of the thickness on its faces

  REQUIRE(folder.run("cube.off --size 0.4 --output background.mesh --quiet").status == 0);
  const std::size_t n = count_in_medit(folder.read("background.mesh"), "Vertices");
  std::string sizes = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n" + std::to_string(n) + "\n1 1\n";
  for (std::size_t v = 0; v < n; ++v) sizes += "0.2\n";
  folder.write("background.sol", sizes + "End\n");
  CHECK(longest("cube.off --size-field background.mesh") <= 0.2);
  CHECK(longest("cube.off --size-field background.sol --size 0.15") <= 0.15);
  folder.write("background.sol", sizes.substr(0, sizes.size() - 20)); // cut off
  const Outcome outcome = folder.run("cube.off --size-field background.mesh --output m.mesh");
  CHECK(outcome.status == 1);
  CHECK(is_one_line(outcome.err));
}

TEST_CASE("creases are found by the angle that was asked for")
{
  const Folder folder("angle");
  folder.run("cube.off --size 0.4 --sharp-angle 100 --output smooth.mesh");
  folder.run("cube.off --size 0.4 --sharp-angle 80 --output sharp.mesh");
  CHECK(count_in_medit(folder.read("smooth.mesh"), "Corners") == 0);
  CHECK(count_in_medit(folder.read("smooth.mesh"), "Edges") == 0);
  CHECK(count_in_medit(folder.read("sharp.mesh"), "Corners") == 8);
}

TEST_CASE("bad usage gives status 1, one line on stderr and no file")
{
  const Folder folder("usage");
  const std::vector<std::string> bad = {"",
                                        "cube.off open.off --strict",
                                        "cube.off --bogus",
                                        "cube.off --size",
                                        "cube.off --size -1",
                                        "cube.off --size 0",
                                        "cube.off --size %",
                                        "cube.off --size 5%%",
                                        "cube.off --size inf",
                                        "cube.off --approximation -1%",
                                        "cube.off --gradation 0",
                                        "cube.off --size auto --size auto",
                                        "cube.off --size-field missing.vtu",
                                        "cube.off --facet-shape 0.9",
                                        "cube.off --cell-shape nan",
                                        "cube.off --sharp-angle 181",
                                        "cube.off --min-dihedral 71",
                                        "cube.off --effort 1.1",
                                        "cube.off --effort 0.5 --no-perturb",
                                        "cube.off --effort 0.5 --min-dihedral 20",
                                        "cube.off --topology=yes",
                                        "cube.off --size 1 --size 2",
                                        "cube.off --output m.svg",
                                        "cube.off --output m.off --output ./m.off",
                                        "cube.off --output no/such/folder/m.off",
                                        "cube.off --histogram h.png",
                                        "cube.off --report r.txt",
                                        "cube.off --threads 0",
                                        "cube.off --seed 1.5",
                                        "cube.off --time-limit 0",
                                        "missing.off",
                                        "cube.txt"};
  for (const std::string& arguments : bad) {
    INFO(arguments);
    const Outcome outcome = folder.run(
        arguments + (arguments.find("--output") == std::string::npos && arguments != "" ? " --output m.mesh" : ""));
    CHECK(outcome.status == 1);
    CHECK(is_one_line(outcome.err));
    CHECK(outcome.out == "");
    CHECK(folder.new_files().empty());
  }
}

TEST_CASE("a hole is capped with a note, and refused with its edges named where that isn't wanted")
{
  const Folder folder("open");
  for (const char* option : {"--strict", "--cap 0", "--cap 0.1"}) {
    INFO(option);
    const Outcome refused = folder.run(std::string("open.off --size 0.5 --output m.mesh ") + option);
    CHECK(refused.status == 1);
    CHECK(is_one_line(refused.err));
    CHECK(contains(refused.err, "4-5"));
    CHECK(folder.new_files().empty());
  }
  CHECK(contains(folder.run("open.off --cap 0.1").err, "caps of its holes would be 17 % of the area"));
  CHECK(contains(folder.run("open.off --cap 0.1").err, "--cap"));
  const Outcome capped = folder.run("open.off --size 0.5 --report r.json");
  CHECK(capped.status == 0);
  CHECK(contains(capped.err, "hole was capped, its cap is 17 % of the area"));
  CHECK(number(folder.read("r.json"), "volume") == Approx(1));
}

TEST_CASE("dirt is mended with a note for each thing done, and refused with --strict")
{
  const Folder folder("dirt");
  // Each face has points of its own, some facets are turned over, one is there twice, and a fin sticks out.
  folder.write("dirt.off", "OFF\n27 8 0\n"
                           "0 0 0\n0 1 0\n1 1 0\n1 0 0\n0 0 0\n1 0 0\n1 0 1\n0 0 1\n1 0 0\n1 1 0\n1 1 1\n1 0 1\n"
                           "1 1 0\n0 1 0\n0 1 1\n1 1 1\n0 1 0\n0 0 0\n0 0 1\n0 1 1\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                           "0 0 1\n1 0 1\n0.5 0 1.3\n"
                           "4 0 1 2 3\n4 4 5 6 7\n4 11 10 9 8\n4 12 13 14 15\n4 16 17 18 19\n4 23 22 21 20\n"
                           "4 16 17 18 19\n3 24 25 26\n");
  const Outcome mended = folder.run("dirt.off --size 0.5 --output m.mesh --report r.json");
  CHECK(mended.status == 0);
  for (const char* note : {"welded to equal ones", "turned over", "twice", "left out"})
    CHECK(contains(mended.err, note));
  CHECK(number(folder.read("r.json"), "volume") == Approx(1));
  CHECK(folder.run("dirt.off --size 0.5 --output m.mesh --quiet").err == "");
  const Outcome strict = folder.run("dirt.off --size 0.5 --strict --output s.mesh");
  CHECK(strict.status == 1);
  CHECK(is_one_line(strict.err));
  CHECK(folder.files().count("s.mesh") == 0);
  CHECK(folder.run("dirt.off --strict --cap 0.2").status == 1);
  folder.write("mixed.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  CHECK(folder.run("mixed.off --size 0.5 --strict --output s.mesh").status == 1);
  CHECK(folder.run("mixed.off --size 0.5 --output u.mesh").status == 0);
  CHECK(folder.run("cube.off --size 0.5 --strict --output s.mesh").status == 0);
  CHECK(folder.run("cube.off --size 0.5 --output t.mesh").err == "");
  CHECK(folder.read("s.mesh") == folder.read("t.mesh"));
  CHECK(contains(folder.run("dirt.off --weld 0.1").err, "--weld"));
}

TEST_CASE("a wall inside makes two subdomains, and so do cubes that share an edge")
{
  const Folder folder("wall");
  folder.write("wall.off", "OFF\n12 11 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n0 0 1\n1 0 1\n2 0 1\n0 1 1\n1 1 1\n"
                           "2 1 1\n4 0 3 4 1\n4 6 7 10 9\n4 0 1 7 6\n4 3 9 10 4\n4 0 6 9 3\n4 1 4 10 7\n4 1 4 5 2\n"
                           "4 7 8 11 10\n4 1 2 8 7\n4 4 10 11 5\n4 2 5 11 8\n");
  folder.write("edge.off", "OFF\n14 12 0\n0 0 0\n0 1 0\n1 1 0\n1 0 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n1 2 0\n2 2 0\n2 1 0\n"
                           "2 1 1\n2 2 1\n1 2 1\n4 0 1 2 3\n4 4 5 6 7\n4 0 3 5 4\n4 1 7 6 2\n4 0 4 7 1\n4 3 2 6 5\n"
                           "4 2 8 9 10\n4 6 11 12 13\n4 2 10 11 6\n4 8 13 12 9\n4 2 6 13 8\n4 10 9 12 11\n");
  for (const char* name : {"wall.off", "edge.off"}) {
    INFO(name);
    const Outcome outcome = folder.run(std::string(name) + " --size 0.5 --output m.mesh --report r.json");
    CHECK(outcome.status == 0);
    CHECK(contains(outcome.err, "2 subdomains"));
    CHECK(number(folder.read("r.json"), "volume") == Approx(1)); // of the first
    CHECK(contains(folder.read("r.json"), "\"subdomain\": 2"));
  }
}

TEST_CASE("parts that cross are united, and refused with --strict")
{
  const Folder folder("crossed");
  folder.write("crossed.off",
               // two tetrahedra through each other
               "OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n.1 .1 .1\n1.1 .1 .1\n.1 1.1 .1\n.1 .1 1.1\n"
               "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 4 7 6\n");
  const Outcome outcome = folder.run("crossed.off --size 0.5 --no-perturb --output m.mesh --report r.json");
  CHECK((outcome.status == 0 || outcome.status == 2));
  CHECK(contains(outcome.err, "cut"));
  CHECK(number(folder.read("r.json"), "volume") == Approx((2 - 0.343) / 6).epsilon(1e-3));
  CHECK(folder.run("crossed.off --size 0.5 --strict --output s.mesh").status == 1);
}

TEST_CASE("a sheet is refused with advice that can help")
{
  const Folder folder("sheet");
  folder.write("sheet.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  const Outcome outcome = folder.run("sheet.off --output m.mesh");
  CHECK(outcome.status == 1);
  CHECK(is_one_line(outcome.err));
  CHECK(contains(outcome.err, "a sheet: give it a thickness"));
  CHECK(folder.files().count("m.mesh") == 0);
}

TEST_CASE("nasty input gives status 1 and one line, whatever is wrong with it")
{
  const Folder folder("nasty");
  const std::string cube = folder.read("cube.off");
  const auto refuses = [&folder](const std::string& name, const std::string& text) {
    INFO(name);
    folder.write(name, text);
    const Outcome outcome = folder.run(name + " --size 0.5 --output m.mesh");
    CHECK(outcome.status == 1);
    CHECK(is_one_line(outcome.err));
    CHECK(folder.files().count("m.mesh") == 0);
  };
  refuses("empty.off", "");
  refuses("truncated.off", cube.substr(0, cube.size() - 20));
  refuses("nan.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 nan 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  refuses("flat.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  refuses("index.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 9\n3 0 3 2\n");
}

TEST_CASE("an acute dihedral angle gives a mesh that meets its criteria, and a line that counts what the angle forces")
{
  const Folder folder("acute");
  folder.write("wedge.off", "OFF\n6 8 0\n0 0 0\n1 0 0\n.996 .087 0\n0 0 1\n1 0 1\n.996 .087 1\n" // 5 degrees
                            "3 0 2 1\n3 3 4 5\n3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n3 2 0 3\n3 2 3 5\n");
  for (const char* features : {"60", "0"}) {
    const Outcome outcome =
        folder.run(std::string("wedge.off --size 0.2 --approximation 0.01 --output m.mesh --sharp-angle ") + features);
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK(contains(outcome.out, "at small angles of the input: shapes of"));
    CHECK(count_in_medit(folder.read("m.mesh"), "Tetrahedra") > 100);
    CHECK(count_in_medit(folder.read("m.mesh"), "Vertices") < 1000);
  }
}

TEST_CASE("a run that stops early gives status 2, says why, and writes the mesh so far")
{
  const Folder folder("early");
  const Outcome outcome = folder.run("cube.off --size 0.05 --max-vertices 200 --output m.mesh --report r.json");
  CHECK(outcome.status == 2);
  CHECK(is_one_line(outcome.err));
  CHECK(contains(outcome.err, "vertex budget reached"));
  CHECK(folder.new_files() == Names{"m.mesh", "r.json"});
  CHECK(contains(folder.read("r.json"), "\"ok\": false"));
  CHECK(count_in_medit(folder.read("m.mesh"), "Tetrahedra") > 0);
}

TEST_CASE("without --output it is said that no mesh is written; a full device is an error, whatever is written to it")
{
  const Folder folder("full");
  CHECK(contains(folder.run("cube.off --size 0.5").out, "no mesh is written"));
  CHECK(!contains(folder.run("cube.off --size 0.5 --output m.mesh").out, "no mesh is written"));
  if (!program::fs::exists("/dev/full")) return;
  for (const std::string arguments :
       {"--output full.mesh", "--output full.vtu", "--output full.msh", "--output full.off", "--output full.stl",
        "--report full.json", "--histogram full.svg"}) {
    const std::string name = arguments.substr(arguments.find(' ') + 1);
    const program::fs::path link = program::fs::current_path() / "mesh_3_program_test_full" / name;
    program::fs::create_symlink("/dev/full", link);
    const Outcome outcome = folder.run("cube.off --size 0.5 " + arguments);
    INFO(arguments << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(is_one_line(outcome.err));
    CHECK(contains(outcome.err, name + ": writing failed"));
    program::fs::remove(link);
  }
  const Outcome standard_output = folder.run("cube.off --size 0.5", "sh -c '\"$0\" \"$@\" >/dev/full'");
  CHECK(standard_output.status == 1);
  CHECK(contains(standard_output.err, "standard output can't be written"));
}

TEST_CASE("a smallest dihedral angle that isn't reached gives status 2 and says what was reached")
{
  const Folder folder("dihedral");
  const Outcome outcome = folder.run("cube.off --size 0.4 --min-dihedral 70 --output m.mesh");
  CHECK(outcome.status == 2);
  CHECK(is_one_line(outcome.err));
  CHECK(contains(outcome.err, "smallest dihedral angle"));
  CHECK(contains(outcome.err, "not 70.0"));
  CHECK(folder.new_files() == Names{"m.mesh"});
}

TEST_CASE("elements of second order are written where a format has them")
{
  const Folder folder("order");
  const Outcome outcome = folder.run("cube.off --size 0.5 --order 2 --output m.vtu --output m.msh --output m.inp");
  CHECK(outcome.status == 0);
  CHECK(contains(outcome.out, "second order: 0 curved edges, 0 bent less"));
  CHECK(contains(folder.read("m.inp"), "TYPE=C3D10"));
  CHECK(contains(folder.read("m.vtu"), "</VTKFile>"));
  CHECK(folder.run("cube.off --order 2 --output n.mesh").status == 1);
  CHECK(folder.run("cube.off --order 3 --output n.vtu").status == 1);
}

TEST_CASE("the same request gives the same files, for any number of threads")
{
  const Folder folder("same");
  folder.run("cube.off --size 0.2 --seed 7 --output a.mesh");
  CHECK(folder.read("a.mesh").size() > 1000);
  for (const char* threads : {"1", "2", "3", "4", "8"}) {
    folder.run(std::string("cube.off --size 0.2 --seed 7 --output b.mesh --threads ") + threads);
    CHECK(folder.read("a.mesh") == folder.read("b.mesh"));
  }
}

TEST_CASE("the boundary that was written can be read and meshed again")
{
  const Folder folder("again");
  REQUIRE(folder.run("cube.off --size 0.4 --output m.off --output m.stl").status == 0);
  for (const char* input : {"m.off", "m.stl"}) {
    const Outcome outcome = folder.run(std::string(input) + " --size 0.5 --report r.json");
    CHECK(outcome.status == 0);
    CHECK(outcome.err == ""); // nothing had to be turned over
    CHECK(number(folder.read("r.json"), "volume") == Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("solids of an .stl file are subdomains whose names are in the files, and so are several files")
{
  const Folder folder("solids");
  const auto solid = [](const std::string& name, int by) {
    const std::vector<std::vector<int>> quadrangles = {{0, 3, 2, 1}, {0, 1, 5, 4}, {1, 2, 6, 5},
                                                       {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
    std::ostringstream text;
    text << "solid " << name << "\n";
    for (const auto& q : quadrangles)
      for (const auto& t : {std::vector<int>{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}) {
        text << "facet normal 0 0 0\nouter loop\n";
        for (const int v : t)
          text << "vertex " << by + (v % 4 == 1 || v % 4 == 2) << " " << (v % 4 > 1) << " " << v / 4 << "\n";
        text << "endloop\nendfacet\n";
      }
    return text.str() + "endsolid " + name + "\n";
  };
  folder.write("two.stl", solid("bolt", 0) + solid("nut", 1));
  const Outcome outcome = folder.run("two.stl --size 1 --output t.msh");
  CHECK(outcome.status == 0);
  CHECK(contains(outcome.err, "subdomain 2 is \"nut\""));
  CHECK(contains(folder.read("t.msh"), "3 1 \"bolt\""));
  CHECK(contains(folder.read("t.msh"), "3 2 \"nut\""));
  folder.write("far.stl", solid("nut", 3));
  CHECK(folder.run("cube.off far.stl --size 1 --name 2:lid --output u.msh").status == 0);
  CHECK(contains(folder.read("u.msh"), "3 1 \"cube\""));
  CHECK(contains(folder.read("u.msh"), "3 2 \"lid\""));
}

TEST_CASE("help and version go to stdout, and the help names every option of the usage")
{
  const Folder folder("help");
  const Outcome help = folder.run("--help"), version = folder.run("--version");
  CHECK(help.status == 0);
  CHECK(help.err == "");
  for (const char* option :
       {"--size",     "--approximation", "--facet-shape", "--cell-shape",  "--sharp-angle", "--topology",
        "--manifold", "--min-dihedral",  "--effort",      "--no-optimise", "--no-perturb",  "--output",
        "--report",   "--histogram",     "--seed",        "--threads",     "--time-limit",  "--quiet",
        "--cap",      "--strict",        "--weld"})
    CHECK(contains(help.out, std::string("\n  ") + option));
  CHECK(version.status == 0);
  CHECK(version.out == "mesh_3 (weft) " WEFT_VERSION "\n");
}

TEST_CASE("a sliver whose measure rounds in another way once something was tried and undone doesn't end the program")
{
  const Folder folder("undone");
  const std::string surface = WEFT_TEST_DATA_DIR "/torus_with_thin_facets.off";
  const Outcome outcome = folder.run("'" + surface + "' --size 7.94792% --topology --seed 26 --max-vertices 20000 " +
                                     "--time-limit 20 --output mesh.mesh --quiet");
  CHECK((outcome.status == 0 || outcome.status == 2));
  CHECK(folder.new_files() == Names{"mesh.mesh"});
}

// ---- images

namespace {

/// An INRIMAGE file of n^3 voxels of one byte, written to the folder.
template <class Value>
void write_image(const Folder& folder, const std::string& name, int n, const Value& value)
{
  const std::string side = std::to_string(n);
  std::string bytes = "#INRIMAGE-4#{\nXDIM=" + side + "\nYDIM=" + side + "\nZDIM=" + side +
                      "\nVDIM=1\nTYPE=unsigned fixed\nPIXSIZE=8 bits\nSCALE=2**0\nCPU=decm\nVX=1\nVY=1\nVZ=1\n";
  bytes += std::string(256 - 4 - bytes.size(), '\n') + "##}\n";
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) bytes += static_cast<char>(value(x, y, z));
  folder.write(name, bytes);
}

/// Of a report, the volume of the mesh.
double volume(const std::string& report)
{
  return number(report.substr(report.find("\"quality\"")), "volume");
}

double distance(int x, int y, int z, double center)
{
  return std::hypot(x - center, y - center, z - center);
}

} // namespace

TEST_CASE("an image that looks like grey values leads to a question, which --iso and --labels answer")
{
  const Folder folder("grey");
  write_image(folder, "g.inr", 20, [](int x, int y, int z) { return std::max(0., 250 - 25 * distance(x, y, z, 9.5)); });
  const Outcome question = folder.run("g.inr --output m.mesh");
  CHECK(question.status == 1);
  CHECK(is_one_line(question.err));
  CHECK(contains(question.err, "--iso VALUE"));
  CHECK(contains(question.err, "--labels"));
  CHECK(folder.files().count("m.mesh") == 0);
  const Outcome ball = folder.run("g.inr --iso 100 --size 3 --approximation 0.1 --report r.json");
  CHECK(ball.status == 0);
  CHECK(contains(ball.err, "above 100"));
  const double ball_volume = 4.18879 * 216, ball_area = 12.56637 * 36;                          // radius 6
  CHECK(volume(folder.read("r.json")) == Approx(ball_volume).margin((0.1 + 0.05) * ball_area)); // rounded values
  // The rest is beyond it, up to the box.
  CHECK(folder.run("g.inr --iso 100 --inside below --size 3 --approximation 0.3 --report r.json").status == 0);
  CHECK(volume(folder.read("r.json")) == Approx(8000 - ball_volume).margin((0.3 + 0.05) * ball_area));
  for (const char* bad : {"cube.off --iso 3", "cube.off --labels", "g.inr --iso x", "g.inr --inside above",
                          "g.inr --iso 1 --inside out", "g.inr --iso 1 --labels", "g.inr --iso 1e6"}) {
    INFO(bad);
    const Outcome outcome = folder.run(bad);
    CHECK(outcome.status == 1);
    CHECK(is_one_line(outcome.err));
  }
}

TEST_CASE("sizes and names are given by label")
{
  const Folder folder("labels");
  // Two halves, of labels 7 and 9, up to the border.
  write_image(folder, "h.inr", 10, [](int x, int, int) { return x < 5 ? 7 : 9; });
  const auto cells = [&] { return number(folder.read("r.json"), "cells"); };
  const Outcome coarse = folder.run("h.inr --size 4 --output c.msh --report r.json");
  CHECK(coarse.status == 0);
  CHECK(contains(coarse.err, "the subdomains 1, 2 are the labels 7, 9"));
  CHECK(contains(folder.read("c.msh"), "3 2 \"label 9\""));
  CHECK(contains(folder.read("c.msh"), "\"label 9, x max\""));
  CHECK(volume(folder.read("r.json")) == Approx(1000));
  CHECK(contains(folder.read("r.json"), "\"missing_components\": []"));
  const double few = cells();
  CHECK(folder.run("h.inr --size 4 --size 9:1 --name 9:bone --output f.msh --output f.vtu --report r.json").status ==
        0);
  const double half_fine = cells();
  CHECK(contains(folder.read("f.msh"), "\"bone\""));
  CHECK(contains(folder.read("f.msh"), "\"bone, label 7\""));
  CHECK(contains(folder.read("f.vtu"), "subdomain_names"));
  CHECK(folder.run("h.inr --size 1 --size 7:4 --report r.json").status == 0);
  CHECK(cells() == Approx(half_fine).epsilon(0.1));
  CHECK(folder.run("h.inr --size 1 --report r.json").status == 0);
  CHECK(half_fine > 3 * few);
  CHECK(cells() > 1.2 * half_fine);
  for (const char* bad : {"h.inr --size 8:1", "h.inr --size 7:1 --size 7:2", "h.inr --size 7:0", "h.inr --size x:1",
                          "h.inr --approximation 7:-1", "h.inr --name bone", "h.inr --name 7:", "h.inr --name 5:a",
                          "cube.off --size 2:1"}) {
    INFO(bad);
    const Outcome outcome = folder.run(std::string(bad) + " --quiet");
    CHECK(outcome.status == 1);
    CHECK(is_one_line(outcome.err));
  }
}
