// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of the command-line programs, which appear complete or not at all.

#ifndef WEFT_EXAMPLES_OUTPUT_FILES_H
#define WEFT_EXAMPLES_OUTPUT_FILES_H

#include "command_line.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace command_line {

/// Files that a program writes. Each is written under another name beside its own and renamed when all are complete, so
/// that a failure leaves none of them behind.
class Output_files
{
public:
  Output_files() = default;
  Output_files(const Output_files&) = delete;
  Output_files& operator=(const Output_files&) = delete;
  ~Output_files() { discard(); }

  /// Says before the work begins that a file will be written.
  /// \throws Error if that can't be, or if it has been announced before.
  void announce(const std::string& filename)
  {
    for (const std::string& other : announced_)
      if (std::filesystem::path(other).lexically_normal() == std::filesystem::path(filename).lexically_normal())
        throw Error(filename + ": two outputs have this name");
    if (std::filesystem::is_directory(filename)) throw Error(filename + ": is a directory");
    std::filesystem::remove(reserve(filename));
    announced_.push_back(filename);
  }

  /// Calls `write(name)` with the name to write to. Devices and pipes are written to as they are, not replaced.
  /// \throws Error if that fails.
  template <class Write>
  void add(const std::string& filename, const Write& write)
  {
    const bool is_file = !std::filesystem::exists(filename) || std::filesystem::is_regular_file(filename);
    const std::string temporary = is_file ? reserve(filename) : filename;
    if (is_file) written_.emplace_back(temporary, filename);
    try {
      write(temporary);
    } catch (const std::exception& error) {
      std::string what = error.what();
      const std::size_t place = what.find(temporary);
      throw Error(place == std::string::npos ? filename + ": " + what
                                             : what.replace(place, temporary.size(), filename));
    }
  }

  /// Gives all files their names.
  void commit()
  {
    for (const auto& [temporary, filename] : written_) std::filesystem::rename(temporary, filename);
    written_.clear();
  }

private:
  /// Creates an empty file in the same folder and with the same extension: writers go by that.
  static std::string reserve(const std::string& filename)
  {
    const std::filesystem::path path(filename);
    constexpr int most_tries = 1000;
    for (int i = 0; i < most_tries; ++i) {
      std::filesystem::path name = path;
      name.replace_filename("." + path.stem().string() + "." + std::to_string(i) + path.extension().string());
      if (std::filesystem::exists(name)) continue;
      if (std::FILE* file = std::fopen(name.string().c_str(), "wx")) { // x: must not exist
        std::fclose(file);
        return name.string();
      }
    }
    throw Error(filename + ": can't be opened for writing");
  }

  void discard()
  {
    std::error_code ignored;
    for (const auto& file : written_) std::filesystem::remove(file.first, ignored);
  }

  std::vector<std::string> announced_;
  std::vector<std::pair<std::string, std::string>> written_;
};

} // namespace command_line

#endif // WEFT_EXAMPLES_OUTPUT_FILES_H
