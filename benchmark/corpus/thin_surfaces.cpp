// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the random thin surfaces of the tests, one file per seed, and beside each what is known of it: NAME.off and
// NAME.off.json with kind, thickness, pieces, shells, Euler characteristic and volume. The same seeds give the same
// files.
//
//   thin_surfaces FIRST N FOLDER

#include "../../test/fixtures/thin_surfaces.h"
#include "../common/program.h"

#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace {

std::ostringstream exact_text()
{
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10);
  return text;
}

void write(const thin::Thin_surface& thing, unsigned seed, const std::string& folder)
{
  std::ostringstream name = exact_text(), off = exact_text(), known = exact_text();
  name << folder << "/" << std::setw(6) << std::setfill('0') << seed << "_";
  for (const char c : thing.kind) name << (c == ' ' || c == '-' ? '_' : c);
  name << ".off";
  const auto& s = thing.surface;
  off << "OFF\n" << s.points.size() << " " << s.triangles.size() << " 0\n";
  for (const auto& p : s.points) off << p.x() << " " << p.y() << " " << p.z() << "\n";
  for (const auto& t : s.triangles) off << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  known << "{\"seed\": " << seed << ", \"kind\": \"" << thing.kind << "\", \"thickness\": " << thing.thickness
        << ", \"pieces\": " << thing.pieces << ", \"shells\": " << thing.shells << ", \"euler\": " << thing.euler
        << ", \"volume\": " << thing.volume << "}";
  benchmark::write_text(name.str(), off.str());
  benchmark::write_text(name.str() + ".json", known.str());
}

void run(benchmark::Argument_reader arguments)
{
  std::vector<std::string> operands;
  while (arguments.next()) operands.push_back(arguments.operand());
  if (operands.size() != 3) throw weft::Option_error("usage: thin_surfaces FIRST N FOLDER");
  const auto number = [&operands](std::size_t i, const char* what) {
    return static_cast<unsigned>(benchmark::Argument_reader::checked(what, operands[i], false));
  };
  const unsigned first = number(0, "FIRST"), n = number(1, "N");
  for (unsigned seed = first; seed < first + n; ++seed) write(thin::thin_surface(seed), seed, operands[2]);
}

} // namespace

int main(int argc, char** argv)
{
  return benchmark::run_program("thin_surfaces", [&] { run({argc, argv}); });
}
