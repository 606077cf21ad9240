// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the two programs that make the gallery's meshes share: their arguments, and the figures of a mesh as JSON.

#ifndef WEFT_BENCHMARK_GALLERY_GALLERY_PROGRAM_H
#define WEFT_BENCHMARK_GALLERY_GALLERY_PROGRAM_H

#include "../common/program.h"
#include "../common/table.h"

#include <weft/errors.h>

#include <array>
#include <cstddef>
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
    for (Argument_reader arguments(argc, argv); arguments.next();) {
      const std::string argument = arguments.argument();
      const auto option = options_.find(argument.rfind("--", 0) == 0 ? argument.substr(2) : argument);
      if (option == options_.end() || argument.rfind("--", 0) != 0)
        input_ = arguments.operand();
      else
        option->second = arguments.value();
    }
    if (input_.empty()) throw weft::Option_error("needs the name of an input, or a file");
    if (text("output").empty()) throw weft::Option_error("needs --output");
  }

  const std::string& input() const { return input_; }
  const std::string& text(const std::string& option) const { return options_.at(option); }

  /// \throws weft::Option_error if it isn't a number, or less than 0.
  double number(const std::string& option) const
  {
    return Argument_reader::checked("--" + option, text(option), false);
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
  write_text(prefix + ".json", asked.add_raw("meshes", json_array(meshes)).str());
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_GALLERY_GALLERY_PROGRAM_H
