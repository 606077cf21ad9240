// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the command-line programs share: options, exit statuses and what main() does. CLI11 takes the command line
// apart and prints the list of options; it is compiled once for all programs, in programs/command_line.cpp.

#ifndef WEFT_EXAMPLES_COMMAND_LINE_H
#define WEFT_EXAMPLES_COMMAND_LINE_H

#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace command_line {

/// What a user can set right; `what()` is one line.
class Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A length in units of the input, or in per cent of its extent.
struct Length
{
  double value = 0;
  bool is_relative = false;

  double in(double extent) const { return is_relative ? value / 100 * extent : value; }
};

/// What a program takes: its options, in the order of the list in --help, each with the variable that it sets. A
/// variable keeps its value where its option isn't given. In `help` a line break starts a new line in that list.
///
/// Values follow as the next argument or after an equals sign; after "--" everything is an operand. An option may be
/// given once, but for those that say otherwise. A wrong value ends `parse()` with an Error that names the option and
/// the value.
class Options
{
public:
  /// \param before,after what --help prints around the list of options.
  Options(const std::string& program, const std::string& before, const std::string& after);
  ~Options();

  /// The arguments that aren't options.
  void operands(std::vector<std::string>& operands);
  void flag(const std::string& name, bool& is_given, const std::string& help);
  /// Any text that isn't empty.
  /// \param value_name what the list of options calls the value.
  void text(const std::string& name, const std::string& value_name, std::string& text, const std::string& help);
  /// The same; may be given several times.
  void texts(const std::string& name, const std::string& value_name, std::vector<std::string>& texts,
             const std::string& help);
  /// The name of a file with the extension that it must have (".svg", lower case).
  void filename(const std::string& name, const std::string& extension, std::string& filename, const std::string& help);
  /// A positive finite number.
  void positive(const std::string& name, const std::string& value_name, double& number, const std::string& help);
  /// A number in a range.
  void number(const std::string& name, const std::string& value_name, double least, double most, double& number,
              const std::string& help);
  /// A finite length, positive or, where that is allowed, 0; a trailing % makes it relative.
  void length(const std::string& name, const std::string& value_name, bool may_be_zero, Length& length,
              const std::string& help);
  /// A whole number in a range; for int, unsigned and std::size_t.
  template <class Integer>
  void integer(const std::string& name, const std::string& value_name, Integer least, Integer most, Integer& integer,
               const std::string& help);

  /// Reads the command line.
  /// \throws Error if there is something wrong with it.
  /// \returns the answer to --help or --version, empty if neither is given.
  std::string parse(int argc, const char* const* argv);

  const std::string& program() const { return program_; }
  /// Whether an option was given, and its value as it was.
  /// \pre `parse()` has been called.
  bool has(const std::string& name) const;
  std::string value(const std::string& name) const;

private:
  struct Parser;
  std::string program_;
  std::unique_ptr<Parser> parser_;
};

/// A text that is a part of the value of an option, as a length or a whole number.
/// \throws Error as above.
Length read_length(const std::string& option, const std::string& text, bool may_be_zero = false);
int read_integer(const std::string& option, const std::string& text);

/// Whether the name of a file ends as wanted (".svg", lower case).
bool has_extension(const std::string& filename, const std::string& wanted);

/// Writes "PROGRAM: WHAT" to standard error, as one line whatever `what` contains.
void complain(const std::string& program, std::string what);

/// Exit statuses.
enum Status
{
  complete = 0,
  refused = 1,
  stopped_early = 2
};

/// What main() does: answers --help and --version, else runs and says what went wrong.
/// \param run called when the command line has been read; returns a status.
int run_program(Options& options, const std::function<Status()>& run, int argc, const char* const* argv);

/// The same for a program that has what is asked for as a Request.
/// \param before,after as for `Options`.
/// \param add_options declares options that set members of a Request.
/// \param check refuses what doesn't go together, and sets what several options decide.
/// \param run returns a status.
template <class Request>
int run_program(const std::string& name, const std::string& before, const std::string& after,
                void (*add_options)(Options&, Request&), void (*check)(const Options&, Request&),
                Status (*run)(const Request&), int argc, const char* const* argv)
{
  Request request;
  Options options(name, before, after);
  add_options(options, request);
  return run_program(
      options,
      [&] {
        check(options, request);
        return run(request);
      },
      argc, argv);
}

} // namespace command_line

#endif // WEFT_EXAMPLES_COMMAND_LINE_H
