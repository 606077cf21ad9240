// SPDX-License-Identifier: GPL-3.0-or-later

#include "../command_line.h"

#include <weft/version.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <new>
#include <optional>
#include <utility>

namespace command_line {

namespace {

/// The texts of a program around CLI11's list of options: its own usage line has but "[OPTIONS]".
class Help : public CLI::Formatter
{
public:
  Help() { column_width(26); }
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode mode) const override
  {
    return app->get_description() + make_groups(app, mode) + "\n" + app->get_footer();
  }
};

/// A whole text as a number. CLI11 would read numbers by strtold(), which goes by the locale and takes spaces and
/// hexadecimal digits.
template <class Number>
std::optional<Number> parse_number(const std::string& text)
{
  Number number{};
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  if (result.ec != std::errc() || result.ptr != end) return {};
  return number;
}

[[noreturn]] void refuse(const std::string& name, const std::string& value, const std::string& wanted)
{
  throw Error(name + ": '" + value + "' is not " + wanted);
}

/// CLI11 takes the next argument for the value whatever it is. An option is none: its own value has been forgotten.
void check_given(const std::string& name, const std::string& value)
{
  if (value.empty() || value.substr(0, 2) == "--") throw Error(name + " needs a value");
}

} // namespace

struct Options::Parser
{
  Parser(const std::string& program, const std::string& before, const std::string& after) : app(before, program)
  {
    app.formatter(std::make_shared<Help>());
    app.footer(after);
    app.set_help_flag();                    // --help is answered whatever else is wrong, which CLI11's own flag isn't
    app.allow_windows_style_options(false); // a slash begins a path
  }

  /// An option that may be given once.
  /// \param take gets the value.
  void add(const std::string& name, const std::string& value_name, const std::string& help,
           const std::function<void(const std::string&)>& take)
  {
    const std::function<void(const std::string&)> check_and_take = [name, take](const std::string& value) {
      check_given(name, value);
      take(value);
    };
    app.add_option_function(name, check_and_take, help)->option_text(value_name);
  }

  /// A flag that is answered when it is met.
  template <class Answer>
  void add_answer(const std::string& name, const std::string& help)
  {
    app.add_flag_callback(
           name, [] { throw Answer(); }, help)
        ->trigger_on_parse();
  }

  /// What was wrong with the command line, in the words of the programs.
  std::string complaint(const CLI::ArgumentMismatch&, const std::string& last_argument) const
  {
    for (const CLI::Option* option : app.get_options())
      if (option->count() > 1 && option->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw)
        return option->get_name() + " is given twice";
    return last_argument.substr(0, last_argument.find('=')) + " needs a value"; // there were no more arguments
  }

  CLI::App app;
};

Options::Options(const std::string& program, const std::string& before, const std::string& after)
    : program_(program), parser_(std::make_unique<Parser>(program, before, after))
{}

Options::~Options() = default;

void Options::operands(std::vector<std::string>& operands)
{
  parser_->app.add_option("INPUT", operands);
}

void Options::flag(const std::string& name, bool& is_given, const std::string& help)
{
  const auto check = [name](const std::string& value) -> std::string {
    if (value != "true") throw Error(name + " takes no value"); // "true" is what CLI11 has for a flag without one
    return {};
  };
  parser_->app.add_flag(name, is_given, help)->check(check)->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

void Options::text(const std::string& name, const std::string& value_name, std::string& text, const std::string& help)
{
  parser_->add(name, value_name, help, [&text](const std::string& value) { text = value; });
}

void Options::texts(const std::string& name, const std::string& value_name, std::vector<std::string>& texts,
                    const std::string& help)
{
  const std::function<void(const std::vector<std::string>&)> take = [name,
                                                                     &texts](const std::vector<std::string>& values) {
    for (const std::string& value : values) check_given(name, value);
    texts = values;
  };
  parser_->app.add_option_function(name, take, help)
      ->allow_extra_args(false) // else an option takes all arguments that follow
      ->option_text(value_name)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void Options::filename(const std::string& name, const std::string& extension, std::string& filename,
                       const std::string& help)
{
  parser_->add(name, "FILE" + extension, help, [name, extension, &filename](const std::string& value) {
    if (!has_extension(value, extension)) throw Error(name + ": '" + value + "' should end in " + extension);
    filename = value;
  });
}

void Options::positive(const std::string& name, const std::string& value_name, double& number, const std::string& help)
{
  parser_->add(name, value_name, help, [name, &number](const std::string& value) {
    const auto read = parse_number<double>(value);
    if (!read || !std::isfinite(*read) || !(*read > 0)) refuse(name, value, "a positive number");
    number = *read;
  });
}

void Options::number(const std::string& name, const std::string& value_name, double least, double most, double& number,
                     const std::string& help)
{
  parser_->add(name, value_name, help, [name, least, most, &number](const std::string& value) {
    const auto read = parse_number<double>(value);
    if (!read || !(*read >= least && *read <= most)) {
      char range[80];
      std::snprintf(range, sizeof range, "a number from %g to %g", least, most);
      refuse(name, value, range);
    }
    number = *read;
  });
}

void Options::length(const std::string& name, const std::string& value_name, bool may_be_zero, Length& length,
                     const std::string& help)
{
  parser_->add(name, value_name, help, [name, may_be_zero, &length](const std::string& value) {
    length = read_length(name, value, may_be_zero);
  });
}

template <class Integer>
void Options::integer(const std::string& name, const std::string& value_name, Integer least, Integer most,
                      Integer& integer, const std::string& help)
{
  parser_->add(name, value_name, help, [name, least, most, &integer](const std::string& value) {
    const auto read = parse_number<Integer>(value);
    if (!read || *read < least || *read > most)
      refuse(name, value, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    integer = *read;
  });
}

template void Options::integer(const std::string&, const std::string&, int, int, int&, const std::string&);
template void Options::integer(const std::string&, const std::string&, unsigned, unsigned, unsigned&,
                               const std::string&);
template void Options::integer(const std::string&, const std::string&, std::size_t, std::size_t, std::size_t&,
                               const std::string&);

std::string Options::parse(int argc, const char* const* argv)
{
  parser_->add_answer<CLI::CallForHelp>("--help", "print this and exit");
  parser_->add_answer<CLI::CallForVersion>("--version", "print the version and exit");
  try {
    parser_->app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return parser_->app.help();
  } catch (const CLI::CallForVersion&) {
    return program_ + " (weft) " WEFT_VERSION "\n";
  } catch (const CLI::ArgumentMismatch& error) {
    throw Error(parser_->complaint(error, argv[argc - 1]));
  } catch (const CLI::ExtrasError&) {
    const std::string unknown = parser_->app.remaining().front();
    throw Error("unknown option '" + unknown.substr(0, unknown.find('=')) + "'");
  }
  return {};
}

bool Options::has(const std::string& name) const
{
  return parser_->app.get_option(name)->count() > 0;
}

std::string Options::value(const std::string& name) const
{
  return has(name) ? parser_->app.get_option(name)->results().front() : std::string();
}

Length read_length(const std::string& option, const std::string& text, bool may_be_zero)
{
  const bool is_relative = !text.empty() && text.back() == '%';
  const auto read = parse_number<double>(text.substr(0, text.size() - (is_relative ? 1 : 0)));
  if (!read || !std::isfinite(*read) || !(*read > 0 || (may_be_zero && *read == 0)))
    refuse(option, text, "a positive length, or one in % of the bounding box diagonal");
  return {*read, is_relative};
}

int read_integer(const std::string& option, const std::string& text)
{
  const auto read = parse_number<int>(text);
  if (!read) refuse(option, text, "a whole number");
  return *read;
}

bool has_extension(const std::string& filename, const std::string& wanted)
{
  std::string extension = std::filesystem::path(filename).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension == wanted;
}

void complain(const std::string& program, std::string what)
{
  std::replace(what.begin(), what.end(), '\n', ' ');
  std::fprintf(stderr, "%s: %s\n", program.c_str(), what.c_str());
}

int run_program(Options& options, const std::function<Status()>& run, int argc, const char* const* argv)
{
  try {
    const std::string answer = options.parse(argc, argv);
    std::cout << answer;
    const Status status = answer.empty() ? run() : complete;
    if (!std::cout.flush()) throw Error("standard output can't be written; is the disk full?");
    return status;
  } catch (const std::bad_alloc&) {
    complain(options.program(), "out of memory");
  } catch (const std::exception& error) {
    complain(options.program(), error.what());
  }
  return refused;
}

} // namespace command_line
