// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes random solids with small dihedral angles, some of them with several subdomains: NAME.off bounds the whole,
// NAME.1.off, NAME.2.off, ... the subdomains, NAME.json has what is known: kind, smallest angle, volumes, diagonals of
// bounding boxes. The same seeds give the same files.
//
//   angle_solids FIRST N FOLDER

#include "../../test/fixtures/angle_surfaces.h"
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

void write_off(const surfaces::Surface& s, const std::string& name)
{
  std::ostringstream off = exact_text();
  off << "OFF\n" << s.points.size() << " " << s.triangles.size() << " 0\n";
  for (const auto& p : s.points) off << p.x() << " " << p.y() << " " << p.z() << "\n";
  for (const auto& t : s.triangles) off << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  benchmark::write_text(name, off.str());
}

/// Members of a JSON object: the volume, and the diagonal of the bounding box.
std::string measures(const surfaces::Surface& s)
{
  CGAL::Bbox_3 box;
  for (const auto& p : s.points) box += p.bbox();
  std::ostringstream text = exact_text();
  text << "\"volume\": " << thin::exact_volume(s)
       << ", \"diagonal\": " << std::hypot(box.x_span(), box.y_span(), box.z_span());
  return text.str();
}

void write(const angles::Angle_solid& solid, unsigned seed, const std::string& folder)
{
  std::ostringstream name = exact_text(), known = exact_text();
  name << folder << "/" << std::setw(6) << std::setfill('0') << seed << "_" << solid.kind;
  known << "{\"seed\": " << seed << ", \"kind\": \"" << solid.kind << "\", \"angle\": " << solid.angle << ", "
        << measures(solid.whole) << ", \"parts\": [";
  write_off(solid.whole, name.str() + ".off");
  for (std::size_t i = 0; i < solid.parts.size(); ++i) {
    write_off(solid.parts[i], name.str() + "." + std::to_string(i + 1) + ".off");
    known << (i > 0 ? ", " : "") << "{" << measures(solid.parts[i]) << "}";
  }
  known << "]}";
  benchmark::write_text(name.str() + ".json", known.str());
}

void run(benchmark::Argument_reader arguments)
{
  std::vector<std::string> operands;
  while (arguments.next()) operands.push_back(arguments.operand());
  if (operands.size() != 3) throw weft::Option_error("usage: angle_solids FIRST N FOLDER");
  const auto number = [&operands](std::size_t i, const char* what) {
    return static_cast<unsigned>(benchmark::Argument_reader::checked(what, operands[i], false));
  };
  const unsigned first = number(0, "FIRST"), n = number(1, "N");
  for (unsigned seed = first; seed < first + n; ++seed) write(angles::angle_solid(seed), seed, operands[2]);
}

} // namespace

int main(int argc, char** argv)
{
  return benchmark::run_program("angle_solids", [&] { run({argc, argv}); });
}
