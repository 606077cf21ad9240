// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the program mesh_2 as a user sees it: exit statuses, what it says and where, and which files are there
// afterwards. The program is run for each of them in an empty folder.

#include "fixtures/program_fixture.h"

#include <weft/version.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using program::contains;
using program::content;
using program::Names;
using program::number;
using program::Outcome;

const std::string unit_square = "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n";

/// An empty folder that goes with the test case, where mesh_2 runs.
struct Folder : program::Folder
{
  explicit Folder(const std::string& name) : program::Folder("mesh_2_program_test_" + name, WEFT_MESH_2) {}
};

bool is_one_line(const std::string& err)
{
  return program::is_one_line(err, "mesh_2");
}

/// Number of triangles in an .off file.
std::size_t triangles(const std::string& off)
{
  std::istringstream in(off);
  std::string magic;
  std::size_t vertices = 0, faces = 0;
  in >> magic >> vertices >> faces;
  CHECK(magic == "OFF");
  return faces;
}

const std::string data = WEFT_DATA_DIR;

} // namespace

TEST_CASE("a complete mesh gives status 0 and every file that was asked for, and says nothing on stderr")
{
  const Folder folder("complete");
  folder.write("square.poly", unit_square);
  const Outcome outcome =
      folder.run("square.poly --size 0.2 --output m.off --output m.vtu --output m.mesh --output m.msh --output m.svg "
                 "--voronoi v.svg --histogram h.svg --report r.json");
  CHECK(outcome.status == 0);
  CHECK(outcome.err == "");
  CHECK(contains(outcome.out, "all criteria met"));
  CHECK(folder.files() ==
        Names{"square.poly", "m.off", "m.vtu", "m.mesh", "m.msh", "m.svg", "v.svg", "h.svg", "r.json"});
  CHECK(triangles(folder.read("m.off")) > 50);
  CHECK(contains(folder.read("m.vtu"), "</VTKFile>"));
  CHECK(contains(folder.read("m.mesh"), "\nEnd\n"));
  CHECK(contains(folder.read("m.msh"), "$EndElements"));
  for (const char* picture : {"m.svg", "v.svg", "h.svg"}) CHECK(contains(folder.read(picture), "</svg>"));
  CHECK(contains(folder.read("h.svg"), "CGAL"));
  const std::string report = folder.read("r.json");
  CHECK(contains(report, "\"ok\": true"));
  CHECK(number(report, "area") == Approx(1));
  CHECK(number(report, "largest_ratio") <= 1);
}

TEST_CASE("lengths may be parts of the diagonal, and there is a default size, which is said")
{
  const Folder folder("lengths");
  folder.write("square.poly", unit_square);
  const Outcome by_default = folder.run("square.poly --output a.off");
  CHECK(by_default.status == 0);
  CHECK(contains(by_default.out, "size 5% of the diagonal, by default"));
  CHECK(folder.run("square.poly --size 5% --output b.off").status == 0);
  CHECK(folder.run("square.poly --size 0.07071067811865477 --output c.off").status == 0);
  CHECK(folder.read("a.off") == folder.read("b.off"));
  CHECK(folder.read("a.off") == folder.read("c.off"));
  CHECK(folder.run("square.poly --lfs 1 --min-size 10% --output d.off").status == 0);
  CHECK(triangles(folder.read("d.off")) < triangles(folder.read("a.off")));
}

TEST_CASE("a run without --output says that no mesh is written")
{
  const Folder folder("no_output");
  folder.write("square.poly", unit_square);
  CHECK(contains(folder.run("square.poly --size 0.3").out, "no mesh is written"));
  CHECK(!contains(folder.run("square.poly --size 0.3 --output m.off").out, "no mesh is written"));
}

TEST_CASE("a full device is an error, whatever is written to it")
{
  if (!fs::exists("/dev/full")) return;
  const Folder folder("full");
  folder.write("square.poly", unit_square);
  const auto run = [&](const std::string& arguments) { return folder.run("square.poly --size 0.3 " + arguments); };
  for (const std::string arguments :
       {"--output full.off", "--output full.vtu", "--output full.mesh", "--output full.msh", "--output full.svg",
        "--voronoi full.svg", "--histogram full.svg", "--report full.json"}) {
    const std::string name = arguments.substr(arguments.find(' ') + 1);
    fs::create_symlink("/dev/full", fs::current_path() / "mesh_2_program_test_full" / name);
    const Outcome outcome = run(arguments);
    INFO(arguments << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(is_one_line(outcome.err));
    CHECK(contains(outcome.err, name + ": writing failed"));
    CHECK(folder.files() == Names{"square.poly", name});
    fs::remove(fs::current_path() / "mesh_2_program_test_full" / name);
  }
  const Outcome standard_output = folder.run("square.poly --size 0.3", "sh -c '\"$0\" \"$@\" >/dev/full'");
  CHECK(standard_output.status == 1);
  CHECK(contains(standard_output.err, "standard output can't be written"));
}

TEST_CASE("what was joined is in the report, and points that name nothing are warned about")
{
  const Folder folder("notes");
  // Two rectangles turned by 88 degrees, which touch along a part of a side; the common side differs by rounding.
  const double c = std::cos(88 * std::acos(-1.) / 180), s = std::sin(88 * std::acos(-1.) / 180);
  std::ostringstream file;
  file.precision(17);
  file << "8 2 0 0\n";
  const double corners[8][2] = {{0, 0}, {3, 0}, {3, 2}, {0, 2}, {3, 0.4}, {4, 0.4}, {4, 1.2}, {3, 1.2}};
  for (int i = 0; i < 8; ++i)
    file << i << " " << c * corners[i][0] - s * corners[i][1] << " " << s * corners[i][0] + c * corners[i][1] << "\n";
  file << "8 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n4 4 5\n5 5 6\n6 6 7\n7 7 4\n0\n2\n"
       << "0 " << c - s << " " << s + c << " 5 -1\n1 99 99 6 0.01\n";
  folder.write("touch.poly", file.str());
  const Outcome outcome = folder.run("touch.poly --size 0.2 --output m.off --report r.json");
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  CHECK(contains(outcome.err, "warning: touch.poly: the point of region 1, counted from 0, lies outside"));
  CHECK(contains(outcome.err, "1 part of the domain has no region"));
  CHECK(contains(outcome.out, "close to it"));
  CHECK(contains(folder.read("r.json"), "close to it"));
  CHECK(contains(folder.read("r.json"), "lies outside of everything"));
  CHECK(triangles(folder.read("m.off")) < 700);
  CHECK(folder.run("touch.poly --size 0.2 --tolerance 1e-10% --output n.off").status == 0);
}

TEST_CASE("sizes by mark, and bounds on areas in the file")
{
  const Folder folder("regions");
  const std::string plate = "8 2 0 0\n1 0 0\n2 10 0\n3 10 10\n4 0 10\n5 4 4\n6 6 4\n7 6 6\n8 4 6\n"
                            "8 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n5 5 6\n6 6 7\n7 7 8\n8 8 5\n0\n";
  folder.write("plain.poly", plate + "2\n1 1 1 1\n2 5 5 2 -1\n");
  folder.write("areas.poly", plate + "2\n1 1 1 1 -1\n2 5 5 2 0.01\n");
  std::vector<std::size_t> counts;
  for (const char* arguments : {"plain.poly --size 1", "plain.poly --size 1 --size 2:0.15", "areas.poly --size 1",
                                "plain.poly --size 2:1.5%"}) {
    const Outcome outcome = folder.run(std::string(arguments) + " --output m.off --report r.json");
    INFO(arguments << outcome.err);
    CHECK(outcome.status == 0);
    CHECK(outcome.err == "");
    CHECK(number(folder.read("r.json"), "area") == Approx(100)); // the inclusion is part of it
    counts.push_back(triangles(folder.read("m.off")));
  }
  for (std::size_t i = 1; i < counts.size(); ++i) CHECK(counts[i] > counts[0] + 200);
}

TEST_CASE("a quiet run prints nothing")
{
  const Folder folder("quiet");
  folder.write("square.poly", unit_square);
  const Outcome outcome = folder.run("--quiet square.poly --size=0.3 --output=m.off");
  CHECK(outcome.status == 0);
  CHECK(outcome.out == "");
  CHECK(outcome.err == "");
  CHECK(folder.files() == Names{"square.poly", "m.off"});
}

TEST_CASE("help and version go to stdout with status 0")
{
  const Folder folder("help");
  const Outcome help = folder.run("--help"), version = folder.run("--version");
  CHECK(help.status == 0);
  CHECK(help.err == "");
  CHECK(contains(help.out, "usage: mesh_2 INPUT [--size [MARK:]S]... [--lfs K] [--min-size S] [--min-angle DEG]"));
  for (const char* option : {"--output", "--voronoi", "--histogram", "--report", "--seed", "--threads", "--time-limit",
                             "--max-vertices", "--tolerance", "--split-crossings", "--quiet"})
    CHECK(contains(help.out, std::string("\n  ") + option));
  CHECK(version.status == 0);
  CHECK(contains(version.out, WEFT_VERSION));
}

TEST_CASE("bad usage gives status 1, one line that says what is wrong, and no output file")
{
  struct Case
  {
    const char *arguments, *said;
  };
  const Case cases[] = {{"", "no input file"},
                        {"--size 0.1", "no input file"},
                        {"square.poly square.poly --size 1", "more than one input file"},
                        {"square.poly --size 0.1 --lfs 0.1", "exclude each other"},
                        {"square.poly --size 0.1 --size 0.2", "--size is given twice"},
                        {"square.poly --size 0.1 --min-size 0.1", "--min-size goes with --lfs"},
                        {"square.poly --size 0.1 --size 0.2%", "--size is given twice"},
                        {"square.poly --size 1:0.1 --size 1:0.2", "--size is given twice for the mark 1"},
                        {"square.poly --size x:0.1", "--size: 'x' is not a whole number"},
                        {"square.poly --size 1:", "--size: '' is not a positive length"},
                        {"square.poly --size 7:0.1", "no region has the mark 7"},
                        {"square.poly --size 0.1 --tolerance -1", "--tolerance: '-1' is not a positive length"},
                        {"square.poly --size 0.1 --tolerance 50%", "tolerance must lie in"},
                        {"square.poly --size 0.1 --colour red", "unknown option '--colour'"},
                        {"square.poly --size 0.1 -q", "unknown option '-q'"},
                        {"square.poly --size", "--size needs a value"},
                        {"square.poly --size --quiet", "--size needs a value"},
                        {"square.poly --size=", "--size needs a value"},
                        {"square.poly --size 0.1 --quiet=yes", "--quiet takes no value"},
                        {"square.poly --size 0", "--size: '0' is not a positive length"},
                        {"square.poly --size -1", "--size: '-1' is not a positive length"},
                        {"square.poly --size nan", "'nan' is not a positive length"},
                        {"square.poly --size inf", "'inf' is not a positive length"},
                        {"square.poly --size 1e999", "'1e999' is not a positive length"},
                        {"square.poly --size 0.1x", "'0.1x' is not a positive length"},
                        {"square.poly --size 0,1", "'0,1' is not a positive length"},
                        {"square.poly --size ' 0.1'", "is not a positive length"},
                        {"square.poly --size ''", "--size needs a value"},
                        {"square.poly --lfs 0", "--lfs: '0' is not a positive number"},
                        {"square.poly --lfs 0.5 --min-size -2", "--min-size: '-2' is not a positive length"},
                        {"square.poly --size 0.1 --min-angle 41", "--min-angle"},
                        {"square.poly --size 0.1 --min-angle x", "--min-angle: 'x' is not a positive number"},
                        {"square.poly --size 0.1 --seed -1", "--seed: '-1' is not a whole number"},
                        {"square.poly --size 0.1 --seed 1.5", "--seed: '1.5' is not a whole number"},
                        {"square.poly --size 0.1 --threads 0", "--threads: '0' is not a whole number from 1"},
                        {"square.poly --size 0.1 --time-limit 0", "--time-limit: '0' is not a positive number"},
                        {"square.poly --size 0.1 --max-vertices 0", "--max-vertices: '0' is not a whole number"},
                        {"square.poly --size 0.1 --output n.stl", "--output: 'n.stl' should end in .vtu"},
                        {"square.poly --size 0.1 --voronoi v.png", "--voronoi: 'v.png' should end in .svg"},
                        {"square.poly --size 0.1 --histogram h", "--histogram: 'h' should end in .svg"},
                        {"square.poly --size 0.1 --report r.txt", "--report: 'r.txt' should end in .json"},
                        {"square.poly --size 0.1 --output m.svg --voronoi ./m.svg", "two outputs have this name"},
                        {"square.poly --size 0.1 --output missing/n.vtu", "missing/n.vtu: can't be opened for writing"},
                        {"square.poly --size 0.1 --output folder.vtu", "folder.vtu: is a directory"}};
  const Folder folder("usage");
  folder.write("square.poly", unit_square);
  fs::create_directory(fs::current_path() / "mesh_2_program_test_usage" / "folder.vtu");
  const Names before = folder.files();
  for (const Case& c : cases) {
    const Outcome outcome = folder.run(std::string("--output m.off ") + c.arguments);
    INFO(c.arguments << "\n" << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.out == "");
    CHECK(is_one_line(outcome.err));
    CHECK(contains(outcome.err, c.said));
    CHECK(folder.files() == before);
  }
}

TEST_CASE("bad input gives status 1, one line that names the file, and no output file")
{
  const std::string cross = "4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n4 0\n0 0 1\n1 1 3\n2 3 2\n3 2 0\n0\n";
  const std::vector<std::pair<std::string, std::string>> inputs = {
      {"empty.poly", ""},
      {"words.poly", "not a mesh\n"},
      {"binary.poly", std::string("\x7f\x45\x4c\x46\0\1\2\3", 8)},
      {"cross.poly", cross},
      {"open.poly", "3 2 0 0\n0 0 0\n1 1 0\n2 1 1\n2 0\n0 0 1\n1 1 2\n"},
      {"nan.poly", "3 2 0 0\n0 0 nan\n1 1 0\n2 1 1\n3 0\n0 0 1\n1 1 2\n2 2 0\n"},
      {"line.edg", "2\n0 0 1 1\n1 1 2 2\n"},
      {"point.node", "1 2 0 0\n0 0 0\n"},
      {"all_hole.poly", "3 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0\n0 0 1\n1 1 2\n2 2 0\n1\n0 0.7 0.2\n"},
      {"far.poly", "3 2 0 0\n0 0 0\n1 1e70 0\n2 1e70 1e70\n3 0\n0 0 1\n1 1 2\n2 2 0\n0\n"},
      {"square.stl", unit_square}};
  const Folder folder("input");
  folder.write("m.off", "an older file\n");
  for (const auto& [name, text] : inputs) folder.write(name, text);
  const Names before = folder.files();
  const auto check = [&](const std::string& name) {
    const Outcome outcome = folder.run(name + " --size 0.1 --output m.off --output m.vtu --histogram h.svg");
    INFO(name << "\n" << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.out == "");
    CHECK(is_one_line(outcome.err));
    CHECK(contains(outcome.err, name));
    CHECK(folder.files() == before);
    CHECK(folder.read("m.off") == "an older file\n");
  };
  for (const auto& input : inputs) check(input.first);
  check("no_such_file.poly");

  const Outcome crossing = folder.run("cross.poly --size 0.1");
  CHECK(contains(crossing.err, "--split-crossings"));
  CHECK(contains(crossing.err, "segments 1 and 3, counted from 0, cross"));
  folder.write("from_1.poly", "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 4\n3 4 3\n4 3 1\n0\n");
  CHECK(contains(folder.run("from_1.poly --size 0.1").err, "segments 2 and 4, counted from 1, cross"));
  CHECK(folder.run("cross.poly --size 0.1 --split-crossings --output s.off").status == 0);
  CHECK(triangles(folder.read("s.off")) > 50);
}

TEST_CASE("a file that is cut anywhere is refused, never meshed in part")
{
  const Folder folder("cut");
  const std::string whole = content(data + "/plate.poly");
  REQUIRE(whole.size() > 1000);
  // The last lines are regions, which a file may lack: cuts well before them only.
  const std::size_t most = whole.size() - 150;
  for (std::size_t length = 1; length < most; length += most / 12) {
    folder.write("cut.poly", whole.substr(0, length));
    const Outcome outcome = folder.run("cut.poly --size 10 --output m.off");
    INFO(length << "\n" << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(is_one_line(outcome.err));
    CHECK(folder.files() == Names{"cut.poly"});
  }
}

TEST_CASE("a run that is stopped early gives status 2, the mesh so far, and one line that says why")
{
  const Folder folder("early");
  folder.write("square.poly", unit_square);
  struct Case
  {
    const char *arguments, *said;
  };
  for (const Case& c :
       {Case{"--size 0.01 --time-limit 1e-6", "time limit"}, Case{"--size 0.01 --max-vertices 1", "vertex budget"},
        Case{"--size 0.01 --max-vertices 500", "vertex budget"},
        Case{"--size 1e-200 --max-vertices 2000", "vertex budget"}}) {
    const Outcome outcome = folder.run(std::string("square.poly --quiet --output m.off --histogram h.svg "
                                                   "--voronoi v.svg --report r.json ") +
                                           c.arguments,
                                       "timeout --signal=KILL 60");
    INFO(c.arguments << "\n" << outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.out == "");
    CHECK(is_one_line(outcome.err));
    CHECK(contains(outcome.err, c.said));
    CHECK(contains(outcome.err, "too large"));
    CHECK(folder.files() == Names{"square.poly", "m.off", "h.svg", "v.svg", "r.json"});
    CHECK(triangles(folder.read("m.off")) >= 2);
    const std::string report = folder.read("r.json");
    CHECK(contains(report, "\"ok\": false"));
    CHECK(number(report, "area") == Approx(1));
    CHECK(number(report, "vertices") <= 2100);
  }
}

#ifndef _WIN32
TEST_CASE("Ctrl-C ends a run with status 2 and the mesh so far")
{
  const Folder folder("interrupt");
  folder.write("square.poly", unit_square);
  for (const char* signal : {"INT", "TERM"}) {
    const Outcome outcome = folder.run("square.poly --size 0.001 --output m.off",
                                       std::string("timeout --preserve-status --signal=") + signal + " 1");
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(is_one_line(outcome.err));
    CHECK(contains(outcome.err, "cancelled"));
    CHECK(folder.files() == Names{"square.poly", "m.off"});
    CHECK(triangles(folder.read("m.off")) >= 2);
    fs::remove(fs::current_path() / "mesh_2_program_test_interrupt" / "m.off");
  }
}
#endif

TEST_CASE("holes bound the domain where the file has some, else nesting parity does")
{
  const std::string squares = "12 2 0 0\n"
                              "0 0 0\n1 6 0\n2 6 6\n3 0 6\n4 1 1\n5 5 1\n6 5 5\n7 1 5\n8 2 2\n9 4 2\n10 4 4\n11 2 4\n"
                              "12 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n4 4 5\n5 5 6\n6 6 7\n7 7 4\n"
                              "8 8 9\n9 9 10\n10 10 11\n11 11 8\n";
  const Folder folder("nesting");
  folder.write("parity.poly", squares + "0\n");
  folder.write("hole.poly", squares + "1\n0 3 3\n");
  CHECK(folder.run("parity.poly --size 1 --report parity.json").status == 0);
  CHECK(folder.run("hole.poly --size 1 --report hole.json").status == 0);
  CHECK(number(folder.read("parity.json"), "area") == Approx(36 - 16 + 4));
  CHECK(number(folder.read("hole.json"), "area") == Approx(36 - 4));
}

TEST_CASE("sizes from the local feature size grade a mesh, and a smallest size bounds them")
{
  const Folder folder("lfs");
  CHECK(folder.run("'" + data + "/plate.poly' --lfs 0.6 --min-size 2 --report coarse.json").status == 0);
  CHECK(folder.run("'" + data + "/plate.poly' --lfs 0.6 --min-size 1 --report fine.json").status == 0);
  CHECK(number(folder.read("coarse.json"), "triangles") < number(folder.read("fine.json"), "triangles"));
}

TEST_CASE("the same input gives the same bytes, for any number of threads")
{
  const Folder folder("same");
  const std::string arguments = "'" + data + "/gulf.poly' --size 3 --seed 7 --quiet --output ";
  CHECK(folder.run(arguments + "a.off").status == 0);
  CHECK(folder.run(arguments + "b.off").status == 0);
  CHECK(folder.read("a.off") == folder.read("b.off"));
  for (const char* threads : {"2", "3", "4", "8"}) {
    CHECK(folder.run(arguments + "c.off --threads " + threads).status == 0);
    CHECK(folder.read("a.off") == folder.read("c.off"));
  }
}

TEST_CASE("the data of the project can be meshed")
{
  const Folder folder("data");
  for (const char* arguments : {"gulf.poly' --size 3", "plate.poly' --size 8", "airfoil.poly' --size 0.5"}) {
    const Outcome outcome = folder.run("'" + data + "/" + arguments + " --report r.json");
    INFO(arguments << "\n" << outcome.err);
    CHECK(outcome.status == 0);
    CHECK(number(folder.read("r.json"), "smallest_angle") > 25);
  }
}

TEST_CASE("sizes come from a file, and grade")
{
  const Folder folder("size_field");
  folder.write("square.poly", unit_square);
  const std::string mesh =
      "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nTriangles\n2\n"
      "1 2 3 1\n1 3 4 1\nEnd\n";
  const auto solution = [](const std::string& values) {
    return "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n4\n1 1\n" + values + "End\n";
  };
  folder.write("field.mesh", mesh);
  const auto run = [&](const std::string& arguments) {
    const Outcome outcome = folder.run("square.poly --output m.off " + arguments);
    CHECK(outcome.status == 0);
    return triangles(folder.read("m.off"));
  };
  folder.write("field.sol", solution("0.1\n0.1\n0.1\n0.1\n"));
  const std::size_t even = run("--size 0.1");
  CHECK(static_cast<double>(run("--size-field field.mesh")) == Approx(even).epsilon(0.05));
  CHECK(static_cast<double>(run("--size-field field.sol --size 0.05")) == Approx(run("--size 0.05")).epsilon(0.05));
  folder.write("field.sol", solution("0.02\n2\n2\n2\n"));
  const std::size_t graded = run("--size-field field.mesh --gradation 0.1");
  CHECK(graded > run("--size-field field.mesh --gradation 0.3"));
  for (const std::string bad :
       {"--size-field missing.vtu", "--size-field field.mesh --lfs 1", "--gradation 0.2", "--size-field square.poly"}) {
    const Outcome outcome = folder.run("square.poly --output bad.off " + bad);
    CHECK(outcome.status == 1);
    CHECK(is_one_line(outcome.err));
  }
}
