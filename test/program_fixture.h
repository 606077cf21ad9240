// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of command-line programs share: a folder of their own in which a program runs, and what it left there.

#ifndef WEFT_TEST_PROGRAM_FIXTURE_H
#define WEFT_TEST_PROGRAM_FIXTURE_H

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#ifndef _WIN32
#include <sys/wait.h>
#endif

namespace program {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

inline std::string content(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// What a run left.
struct Outcome
{
  int status;
  std::string out, err;
};

/// An empty folder that goes with the test case.
class Folder
{
public:
  /// \param name of the folder. \param program with its path.
  Folder(const std::string& name, const std::string& program) : path_(fs::current_path() / name), program_(program)
  {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }
  std::string read(const std::string& name) const { return content(path_ / name); }

  /// Names of all files, hidden ones included.
  Names files() const
  {
    Names names;
    for (const auto& entry : fs::directory_iterator(path_)) names.insert(entry.path().filename().string());
    return names;
  }

  /// Runs the program here. \param before goes before the program on the command line.
  Outcome run(const std::string& arguments, const std::string& before = "") const
  {
    const std::string out = path_.string() + ".out", err = path_.string() + ".err";
    const std::string command = "cd '" + path_.string() + "' && " + before + " '" + program_ + "' " + arguments +
                                " >'" + out + "' 2>'" + err + "' </dev/null";
    int status = std::system(command.c_str());
#ifndef _WIN32
    status = WIFEXITED(status) ? WEXITSTATUS(status) : -1; // -1: killed by a signal
#endif
    const Outcome outcome{status, content(out), content(err)};
    fs::remove(out);
    fs::remove(err);
    return outcome;
  }

private:
  fs::path path_;
  std::string program_;
};

/// Whether an error is one line that begins with the program's name.
inline bool is_one_line(const std::string& err, const std::string& program)
{
  return err.rfind(program + ": ", 0) == 0 && std::count(err.begin(), err.end(), '\n') == 1 && err.back() == '\n';
}

/// The number after `"name": ` in a JSON text.
inline double number(const std::string& json, const std::string& name)
{
  const std::string key = "\"" + name + "\": ";
  const std::size_t place = json.find(key);
  REQUIRE(place != std::string::npos);
  return std::stod(json.substr(place + key.size()));
}

} // namespace program

#endif // WEFT_TEST_PROGRAM_FIXTURE_H
