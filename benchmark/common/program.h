// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the benchmark programs share around their work: arguments, files, and what main() does.

#ifndef WEFT_BENCHMARK_COMMON_PROGRAM_H
#define WEFT_BENCHMARK_COMMON_PROGRAM_H

#include <weft/errors.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>

namespace benchmark {

/// Goes through the arguments of a program, one after the other.
class Argument_reader
{
public:
  Argument_reader(int argc, char** argv) : argc_(argc), argv_(argv) {}

  bool next() { return ++at_ < argc_; }
  std::string argument() const { return argv_[at_]; }
  bool is(const std::string& option) const { return argument() == option; }

  /// What follows an option.
  /// \throws weft::Option_error if nothing does.
  std::string value()
  {
    if (at_ + 1 >= argc_) throw weft::Option_error(argument() + " needs a value");
    return argv_[++at_];
  }

  /// A number that isn't negative.
  /// \throws weft::Option_error if what follows isn't one.
  double number()
  {
    const std::string name = argument();
    return checked(name, value(), false);
  }

  /// \throws weft::Option_error as above, and for 0.
  double positive()
  {
    const std::string name = argument();
    return checked(name, value(), true);
  }

  /// An argument that isn't an option.
  /// \throws weft::Option_error if it is one.
  std::string operand() const
  {
    if (argument().rfind("--", 0) == 0) throw weft::Option_error("unknown option " + argument());
    return argument();
  }

  static double checked(const std::string& name, const std::string& digits, bool positive)
  {
    char* end = nullptr;
    const double result = std::strtod(digits.c_str(), &end);
    if (digits.empty() || *end || !std::isfinite(result) || result < 0 || (positive && result == 0))
      throw weft::Option_error(name + " needs a " + (positive ? "positive " : "") + "number, not " + digits);
    return result;
  }

private:
  int argc_;
  char** argv_;
  int at_ = 0;
};

/// \throws weft::File_error if it can't be written.
inline void write_text(const std::string& filename, const std::string& text)
{
  std::ofstream out(filename);
  out << text << "\n";
  out.close();
  if (!out) throw weft::File_error(filename, 0, "can't be written");
}

/// Calls `main()`, says what it throws, and returns the status of the program.
template <class Main>
int run_program(const char* name, const Main& main)
{
  try {
    main();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << "\n";
    return 1;
  }
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_COMMON_PROGRAM_H
