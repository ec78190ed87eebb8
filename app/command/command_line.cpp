// The one file that reads CLI11: its templates take seconds to compile.
#include "app/command/command_line.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>

#include "app/command/command.h"

namespace tumble {

namespace {

CLI::Validator between(double lo, double hi) {
  return CLI::Validator(
      [lo, hi](const std::string& text) {
        // What is no number at all is left to the conversion that follows.
        const double value = std::strtod(text.c_str(), nullptr);
        return value >= lo && value <= hi
                   ? std::string()
                   : fmt::format("expected a number from {:g} to {:g}, found {}", lo, hi, text);
      },
      fmt::format("from {:g} to {:g}", lo, hi));
}

}  // namespace

struct CommandLine::Parser {
  CLI::App app;
};

CommandLine::CommandLine(const std::string& name, const std::string& summary,
                         const std::vector<std::string>& examples)
    : parser_(new Parser{CLI::App(summary, "tumble " + name)}) {
  std::string text = "\nExamples:";
  for (const std::string& example : examples) text += "\n  tumble " + name + " " + example;
  parser_->app.footer(text);
}

CommandLine::~CommandLine() = default;

void CommandLine::flag(const std::string& names, bool& value, const std::string& help) {
  parser_->app.add_flag(names, value, help);
}

template <typename Value>
void CommandLine::option(const std::string& names, Value& value, const std::string& help,
                         const OptionTraits& traits) {
  CLI::Option* const option = parser_->app.add_option(names, value, help);
  if (names.front() == '-') option->allow_extra_args(false);
  if (!traits.type.empty()) option->type_name(traits.type);
  if (traits.range) option->check(between(traits.range->first, traits.range->second));
  if (traits.required) option->required();
  if (traits.hidden) option->group("");
  if (!traits.needs.empty()) option->needs(traits.needs);
}

template void CommandLine::option(const std::string&, std::string&, const std::string&,
                                  const OptionTraits&);
template void CommandLine::option(const std::string&, int&, const std::string&,
                                  const OptionTraits&);
template void CommandLine::option(const std::string&, double&, const std::string&,
                                  const OptionTraits&);
template void CommandLine::option(const std::string&, std::optional<double>&, const std::string&,
                                  const OptionTraits&);
template void CommandLine::option(const std::string&, std::vector<std::string>&, const std::string&,
                                  const OptionTraits&);

bool CommandLine::read(int argc, char** argv) {
  try {
    parser_->app.parse(argc, argv);
    return true;
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}\n", parser_->app.help());
    return false;
  } catch (const CLI::ParseError& error) {
    std::string what = error.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw UsageError(fmt::format("{}; `{} --help` shows how", what, parser_->app.get_name()));
  }
}

}  // namespace tumble
