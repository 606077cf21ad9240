// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the two programs that make the gallery's meshes share: their arguments, and the figures of a mesh as JSON.

#ifndef WEFT_BENCHMARK_GALLERY_PROGRAM_H
#define WEFT_BENCHMARK_GALLERY_PROGRAM_H

#include "planar_table.h"

#include <weft/errors.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {

/// An input, and options that all have a value.
class Gallery_arguments
{
public:
  /// \param defaults all options that there are, without their dashes, with their default values.
  Gallery_arguments(int argc, char** argv, std::map<std::string, std::string> defaults) : options_(std::move(defaults))
  {
    for (int i = 1; i < argc; ++i) {
      const std::string arg = argv[i];
      if (arg.rfind("--", 0) != 0) {
        input_ = arg;
        continue;
      }
      const auto option = options_.find(arg.substr(2));
      if (option == options_.end()) throw weft::Option_error("unknown option " + arg);
      if (i + 1 == argc) throw weft::Option_error(arg + " needs a value");
      option->second = argv[++i];
    }
    if (input_.empty()) throw weft::Option_error("needs the name of an input, or a file");
    if (text("output").empty()) throw weft::Option_error("needs --output");
  }

  const std::string& input() const { return input_; }
  const std::string& text(const std::string& option) const { return options_.at(option); }

  /// \throws weft::Option_error if it isn't a number, or less than 0.
  double number(const std::string& option) const
  {
    const std::string& digits = text(option);
    char* end = nullptr;
    const double result = std::strtod(digits.c_str(), &end);
    if (digits.empty() || *end || !std::isfinite(result) || result < 0)
      throw weft::Option_error("--" + option + " needs a number, not " + digits);
    return result;
  }

private:
  std::map<std::string, std::string> options_;
  std::string input_;
};

template <std::size_t N>
std::string counts_json(const std::array<std::size_t, N>& counts)
{
  std::string result = "[";
  for (std::size_t i = 0; i < N; ++i) result += (i ? ", " : "") + std::to_string(counts[i]);
  return result + "]";
}

/// Writes PREFIX.json: what was asked, and a row for each mesh.
inline void write_gallery_json(const std::string& prefix, Json_object asked, const std::vector<std::string>& meshes)
{
  const std::string filename = prefix + ".json";
  std::ofstream out(filename);
  out << asked.add_raw("meshes", json_array(meshes)).str() << "\n";
  out.close();
  if (!out) throw weft::File_error(filename, 0, "can't be written");
}

/// Runs the program and says what it throws; its exit status.
template <class Run>
int run_gallery_program(const std::string& name, const Run& run)
{
  try {
    run();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << "\n";
    return EXIT_FAILURE;
  }
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_GALLERY_PROGRAM_H
