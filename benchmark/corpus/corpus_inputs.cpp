// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the inputs that run_corpus makes at random, one file per seed: the planar straight line graphs of the tests,
// and damaged surfaces. The same seeds give the same files. Options that suit an input go to a file beside
// it, whose name has ".options" appended.
//
//   corpus_inputs pslgs FIRST N FOLDER
//   corpus_inputs mutations FIRST N LIST FOLDER       LIST: a file with the names of surfaces to damage, one a line

#include "corpus_mutations.h"

#include <weft/IO/read_surface.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace corpus;

/// A file that says so if it can't be written.
class File
{
public:
  explicit File(const std::string& name) : name_(name), out_(name)
  {
    out_.precision(std::numeric_limits<double>::max_digits10);
  }
  template <class T>
  File& operator<<(const T& value)
  {
    out_ << value;
    return *this;
  }
  void close()
  {
    out_.close();
    if (!out_) throw std::runtime_error("can't write " + name_);
  }

private:
  std::string name_;
  std::ofstream out_;
};

void write_options(const std::string& input, const std::string& options)
{
  File file(input + ".options");
  file << options << "\n";
  file.close();
}

/// "00042_kind3", so that names sort as seeds do.
std::string file_name(const std::string& folder, unsigned seed, const std::string& kind)
{
  const std::string number = std::to_string(seed);
  return folder + "/" + std::string(number.size() < 6 ? 6 - number.size() : 0, '0') + number + "_" + kind;
}

// ---- Planar straight line graphs

void write_poly(const std::string& name, const planar::Pslg& pslg)
{
  File file(name);
  file << pslg.points.size() << " 2 0 0\n";
  for (std::size_t i = 0; i < pslg.points.size(); ++i)
    file << i << " " << pslg.points[i].x() << " " << pslg.points[i].y() << "\n";
  file << pslg.segments.size() << " 0\n";
  for (std::size_t i = 0; i < pslg.segments.size(); ++i)
    file << i << " " << pslg.segments[i][0] << " " << pslg.segments[i][1] << "\n";
  file << pslg.holes.size() << "\n";
  for (std::size_t i = 0; i < pslg.holes.size(); ++i)
    file << i << " " << pslg.holes[i].x() << " " << pslg.holes[i].y() << "\n";
  file.close();
}

/// Puts the graph at an extreme place now and then.
planar::Pslg placed(const planar::Pslg& pslg, Random& random)
{
  const double angle = random() % 2 ? 0 : uniform(random, 0, 2 * planar::pi);
  const std::size_t kind = below(random, 6);
  const double scale = kind == 0 ? power(random, -150, 150) : 1, away = kind == 1 ? power(random, 6, 12) : 0;
  return planar::transformed(pslg, scale, angle, away, -away);
}

std::string pslg_options(const planar::Pslg& pslg, Random& random)
{
  std::ostringstream options;
  options.precision(std::numeric_limits<double>::max_digits10);
  const double d = planar::diameter(pslg);
  const auto one_in = [&](std::size_t n) { return below(random, n) == 0; };
  if (one_in(3))
    options << "--lfs " << uniform(random, 0.05, 1);
  else
    options << "--size " << (d > 0 ? d : 1) * (one_in(5) ? power(random, -9, 9) : power(random, -1.7, 0.5));
  if (one_in(3)) options << " --split-crossings";
  if (one_in(4)) options << " --min-angle " << uniform(random, 1, 40);
  options << " --max-vertices " << (one_in(4) ? 1 + below(random, 50) : 50000) << " --seed " << below(random, 100);
  return options.str();
}

void write_pslgs(unsigned first, unsigned n, const std::string& folder)
{
  for (unsigned seed = first; seed < first + n; ++seed) {
    Random random(seed);
    const int kind = static_cast<int>(seed % planar::kinds_of_random_graphs);
    planar::Pslg pslg = placed(planar::random_pslg(kind, random), random);
    const double d = planar::diameter(pslg);
    if (below(random, 8) == 0) {
      const double dx = uniform(random, -0.3, 0.3) * d, dy = uniform(random, -0.3, 0.3) * d;
      pslg.holes.emplace_back(pslg.points[0].x() + dx, pslg.points[0].y() + dy);
    }
    const std::string name = file_name(folder, seed, "kind" + std::to_string(kind)) + ".poly";
    write_poly(name, pslg);
    write_options(name, pslg_options(pslg, random));
  }
}

// ---- Surfaces

void write_off(const std::string& name, const Surface& s)
{
  File file(name);
  file << "OFF\n" << s.points.size() << " " << s.triangles.size() << " 0\n";
  for (const Point& p : s.points) file << p.x() << " " << p.y() << " " << p.z() << "\n";
  for (const Triangle& t : s.triangles) file << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  file.close();
}

/// Polygons become fans of triangles.
Surface read_surface(const std::string& name)
{
  const auto soup = weft::IO::read_surface<surfaces::K>(name);
  Surface s{soup.points, {}};
  for (const auto& polygon : soup.polygons)
    for (std::size_t i = 2; i < polygon.size(); ++i) s.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
  return s;
}

/// The surfaces that can be read. Large ones would only make the runs long.
std::vector<Surface> read_bases(const std::string& list)
{
  constexpr std::size_t most_triangles = 20000;
  std::vector<Surface> bases;
  std::ifstream in(list);
  for (std::string name; std::getline(in, name);) try {
      Surface s = read_surface(name);
      if (!s.triangles.empty() && s.triangles.size() <= most_triangles) bases.push_back(std::move(s));
    } catch (const weft::File_error& error) {
      std::cerr << "corpus_inputs: left out: " << error.what() << "\n";
    }
  return bases;
}

std::string surface_options(Random& random)
{
  std::ostringstream options;
  const auto one_in = [&](std::size_t n) { return below(random, n) == 0; };
  options << "--size " << 100 * power(random, -1.5, 0.5) << "% --max-vertices 20000 --seed " << below(random, 100);
  if (one_in(3)) options << " --approximation " << 100 * power(random, -3, -1) << "%";
  if (one_in(4)) options << " --cap 0";
  if (one_in(4)) options << " --sharp-angle " << uniform(random, 0, 180);
  if (one_in(4)) options << " --topology";
  if (one_in(4)) options << " --manifold";
  if (one_in(8)) options << " --facet-shape " << (random() % 2 ? 0 : 1);
  if (one_in(8)) options << " --cell-shape " << (random() % 2 ? 0 : 1);
  if (one_in(8)) options << " --min-dihedral 90";
  return options.str();
}

void write_mutations(unsigned first, unsigned n, const std::string& list, const std::string& folder)
{
  const std::vector<Surface> bases = read_bases(list);
  for (unsigned seed = first; seed < first + n; ++seed) {
    Random random(seed);
    Surface s = bases.empty() || random() % 2 ? simple_shape(random) : bases[below(random, bases.size())];
    const int kind = static_cast<int>(seed % kinds_of_mutations);
    mutate(s, kind, random);
    if (random() % 3 == 0 && !s.triangles.empty())
      mutate(s, static_cast<int>(below(random, kinds_of_mutations)), random);
    const std::string name = file_name(folder, seed, "mutation" + std::to_string(kind)) + ".off";
    write_off(name, s);
    write_options(name, surface_options(random));
  }
}

unsigned number(const std::string& text)
{
  std::size_t end = 0;
  const unsigned long value = std::stoul(text, &end);
  if (end != text.size() || value > 1000000000) throw std::invalid_argument("not a number: " + text);
  return static_cast<unsigned>(value);
}

} // namespace

int main(int argc, char** argv)
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    if (arguments.size() == 4 && arguments[0] == "pslgs")
      write_pslgs(number(arguments[1]), number(arguments[2]), arguments[3]);
    else if (arguments.size() == 5 && arguments[0] == "mutations")
      write_mutations(number(arguments[1]), number(arguments[2]), arguments[3], arguments[4]);
    else
      throw std::invalid_argument("usage: corpus_inputs pslgs FIRST N FOLDER | mutations FIRST N LIST FOLDER");
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << "corpus_inputs: " << error.what() << "\n";
    return EXIT_FAILURE;
  }
}
