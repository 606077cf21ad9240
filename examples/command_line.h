// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the command-line programs share: options, numbers, interruption, a progress bar, files that appear complete or
// not at all, exit statuses and what main() does.

#ifndef WEFT_EXAMPLES_COMMAND_LINE_H
#define WEFT_EXAMPLES_COMMAND_LINE_H

#include <weft/version.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace command_line {

/// What a user can set right; `what()` is one line.
class Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// ---- Options

/// An option that a program knows.
struct Option
{
  std::string name;  ///< with its dashes
  std::string value; ///< what its value is called; empty if it has none
  std::string help;  ///< a line break starts a new line in the list of options
  bool repeatable = false;
};

/// The lines of a list of options.
inline std::string describe(const std::vector<Option>& options)
{
  constexpr std::size_t indent = 26;
  std::string text;
  for (const Option& option : options) {
    std::string line = "  " + option.name + (option.value.empty() ? "" : " " + option.value);
    line.resize(std::max(line.size() + 1, indent), ' ');
    for (const char c : option.help) line += c == '\n' ? "\n" + std::string(indent, ' ') : std::string(1, c);
    text += line + "\n";
  }
  return text;
}

/// Whether the name of a file ends as wanted (".svg", lower case).
inline bool has_extension(const std::string& filename, const std::string& wanted)
{
  std::string extension = std::filesystem::path(filename).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension == wanted;
}

/// A length in units of the input, or in per cent of its extent.
struct Length
{
  double value = 0;
  bool is_relative = false;

  double in(double extent) const { return is_relative ? value / 100 * extent : value; }
};

/// The arguments of a program, checked against the options that it knows. Values follow as the next argument or after
/// an equals sign; after "--" everything is an operand.
class Arguments
{
public:
  /// \throws Error for unknown options, missing or unwanted values, and options given twice that may not be.
  Arguments(const std::vector<Option>& known, int argc, const char* const* argv)
  {
    const std::vector<std::string> given(argv + 1, argv + argc);
    for (auto argument = given.begin(); argument != given.end(); ++argument) {
      if (*argument == "--") {
        operands_.insert(operands_.end(), argument + 1, given.end());
        break;
      }
      if (argument->size() < 2 || argument->front() != '-')
        operands_.push_back(*argument);
      else
        take_option(known, argument, given.end());
    }
  }

  const std::vector<std::string>& operands() const { return operands_; }
  bool has(const std::string& name) const { return values_.count(name) > 0; }

  /// Every value of an option, in order.
  std::vector<std::string> values(const std::string& name) const
  {
    const auto found = values_.find(name);
    return found == values_.end() ? std::vector<std::string>() : found->second;
  }

  /// The value of an option, or an empty string.
  std::string value(const std::string& name) const { return has(name) ? values_.at(name).front() : std::string(); }

  /// A positive finite number. \throws Error if the value is anything else, even if it only begins like one.
  std::optional<double> positive(const std::string& name) const
  {
    if (!has(name)) return {};
    const auto number = parse<double>(value(name));
    if (!number || !std::isfinite(*number) || !(*number > 0)) refuse(name, "a positive number");
    return number;
  }

  /// A number in a range. \throws Error as above.
  std::optional<double> number(const std::string& name, double least, double most) const
  {
    if (!has(name)) return {};
    const auto number = parse<double>(value(name));
    if (!number || !(*number >= least && *number <= most)) {
      char range[80];
      std::snprintf(range, sizeof range, "a number from %g to %g", least, most);
      refuse(name, range);
    }
    return number;
  }

  /// A finite length, positive or, where that is allowed, 0; a trailing % makes it relative. \throws Error as above.
  std::optional<Length> length(const std::string& name, bool may_be_zero = false) const
  {
    if (!has(name)) return {};
    return read_length(name, value(name), may_be_zero);
  }

  /// The same for a text that is a part of the value of an option.
  static Length read_length(const std::string& name, std::string text, bool may_be_zero = false)
  {
    const std::string whole = text;
    const bool is_relative = !text.empty() && text.back() == '%';
    if (is_relative) text.pop_back();
    const auto number = parse<double>(text);
    if (!number || !std::isfinite(*number) || !(*number > 0 || (may_be_zero && *number == 0)))
      throw Error(name + ": '" + whole + "' is not a positive length, or one in % of the bounding box diagonal");
    return Length{*number, is_relative};
  }

  /// A whole number. \throws Error as above.
  static int read_integer(const std::string& name, const std::string& text)
  {
    const auto number = parse<int>(text);
    if (!number) throw Error(name + ": '" + text + "' is not a whole number");
    return *number;
  }

  /// The name of a file with the extension that it must have, or an empty string. \throws Error for other extensions.
  std::string filename(const std::string& name, const std::string& extension) const
  {
    const std::string filename = value(name);
    if (!filename.empty() && !has_extension(filename, extension))
      throw Error(name + ": '" + filename + "' should end in " + extension);
    return filename;
  }

  /// An integer in a range. \throws Error as above.
  template <class Integer>
  std::optional<Integer> integer(const std::string& name, Integer least, Integer most) const
  {
    if (!has(name)) return {};
    const auto number = parse<Integer>(value(name));
    if (!number || *number < least || *number > most)
      refuse(name, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return number;
  }

private:
  using Iterator = std::vector<std::string>::const_iterator;

  void take_option(const std::vector<Option>& known, Iterator& argument, Iterator end)
  {
    const std::size_t equals = std::min(argument->find('='), argument->size());
    const std::string name = argument->substr(0, equals);
    const auto option =
        std::find_if(known.begin(), known.end(), [&name](const Option& other) { return other.name == name; });
    if (option == known.end()) throw Error("unknown option '" + name + "'");
    if (has(name) && !option->repeatable) throw Error(name + " is given twice");

    std::string value;
    if (equals < argument->size()) {
      if (option->value.empty()) throw Error(name + " takes no value");
      value = argument->substr(equals + 1);
    } else if (!option->value.empty()) {
      // Negative numbers are values, if bad ones; two dashes are the next option.
      if (argument + 1 == end || (argument + 1)->substr(0, 2) == "--") throw Error(name + " needs a value");
      value = *++argument;
    }
    if (value.empty() && !option->value.empty()) throw Error(name + " needs a value");
    values_[name].push_back(value);
  }

  template <class Number>
  static std::optional<Number> parse(const std::string& text)
  {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, number);
    if (result.ec != std::errc() || result.ptr != end) return {};
    return number;
  }

  [[noreturn]] void refuse(const std::string& name, const std::string& wanted) const
  {
    throw Error(name + ": '" + value(name) + "' is not " + wanted);
  }

  std::vector<std::string> operands_;
  std::map<std::string, std::vector<std::string>> values_;
};

/// Writes "PROGRAM: WHAT" to standard error, as one line whatever `what` contains.
inline void complain(const std::string& program, std::string what)
{
  std::replace(what.begin(), what.end(), '\n', ' ');
  std::fprintf(stderr, "%s: %s\n", program.c_str(), what.c_str());
}

// ---- Interruption

/// Turns Ctrl-C (or SIGTERM) into a wish that a program looks at when it suits it. Another one a second later or more
/// ends the program as usual; sooner it is the same wish, which some senders deliver twice.
class Interruption
{
public:
  Interruption()
  {
    for (const int signal : {SIGINT, SIGTERM})
      if (std::signal(signal, note) == SIG_IGN) std::signal(signal, SIG_IGN); // as nohup wants it
  }
  static bool wished() { return first_ != 0; }

private:
  static void note(int signal)
  {
    const auto now = static_cast<long>(std::time(nullptr));
    if (first_ == 0) first_ = now;
    // Some systems restore the default before they call this.
    std::signal(signal, now > first_ + 1 ? SIG_DFL : note);
    if (now > first_ + 1) std::raise(signal);
  }
  static inline std::atomic<long> first_{0}; // lock-free, as a signal handler needs it
};

// ---- Progress

/// A bar on the last line of the terminal that standard error is; nothing at all if it isn't one.
class Progress_bar
{
public:
  explicit Progress_bar(bool wanted) : is_shown_(wanted && is_terminal()) {}
  ~Progress_bar() { clear(); }
  Progress_bar(const Progress_bar&) = delete;
  Progress_bar& operator=(const Progress_bar&) = delete;

  /// \param part in [0, 1]; the bar never goes back. \param text what is being done, some 45 characters.
  void show(double part, const std::string& text)
  {
    using namespace std::chrono;
    part_ = std::clamp(part, part_, 1.);
    const auto now = steady_clock::now();
    if (!is_shown_ || now - last_ < milliseconds(80)) return;
    last_ = now;
    constexpr std::size_t width = 28;
    const auto full = static_cast<std::size_t>(part_ * width);
    const std::string line = "[" + std::string(full, '#') + std::string(width - full, '.') + "] " + text;
    std::fprintf(stderr, "\r%.78s\033[K", line.c_str());
    std::fflush(stderr);
    is_dirty_ = true;
  }

  /// Removes the bar and begins anew.
  void clear()
  {
    part_ = 0;
    if (!is_dirty_) return;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    is_dirty_ = false;
  }

private:
  static bool is_terminal()
  {
#ifdef _WIN32
    return _isatty(_fileno(stderr));
#else
    return isatty(STDERR_FILENO);
#endif
  }

  bool is_shown_, is_dirty_ = false;
  double part_ = 0;
  std::chrono::steady_clock::time_point last_{};
};

// ---- Output files

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

// ---- The program

/// Exit statuses.
enum Status
{
  complete = 0,
  refused = 1,
  stopped_early = 2
};

/// What main() does: answers --help and --version, else runs and says what went wrong.
/// \param help returns the text of --help.
/// \param run called with the arguments; returns a status.
template <class Help, class Run>
int run_program(const std::string& name, const std::vector<Option>& options, const Help& help, const Run& run, int argc,
                char** argv)
{
  try {
    const Arguments arguments(options, argc, argv);
    const bool asks = arguments.has("--help") || arguments.has("--version");
    if (asks) std::cout << (arguments.has("--help") ? help() : name + " (weft) " WEFT_VERSION "\n");
    const int status = asks ? complete : run(arguments);
    if (!std::cout.flush()) throw Error("standard output can't be written; is the disk full?");
    return status;
  } catch (const std::bad_alloc&) {
    complain(name, "out of memory");
  } catch (const std::exception& error) {
    complain(name, error.what());
  }
  return refused;
}

} // namespace command_line

#endif // WEFT_EXAMPLES_COMMAND_LINE_H
