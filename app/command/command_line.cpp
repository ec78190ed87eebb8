// The one file that reads CLI11: its templates take seconds to compile.
#include "app/command/command_line.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>

#include "app/command/command.h"
#include "app/command/progress.h"
#include "app/command/sheet.h"
#include "app/scene/findings.h"

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
  CommandSheet sheet;
  bool quiet = false;
};

CommandSheet* CommandLine::listener = nullptr;

CommandLine::CommandLine(const std::string& name, const std::string& summary,
                         const std::vector<std::string>& examples)
    : parser_(new Parser{CLI::App(summary, "tumble " + name), {name, summary, examples, {}}}) {
  std::string text = "\nExamples:";
  for (const std::string& example : examples) text += "\n  tumble " + name + " " + example;
  parser_->app.footer(text);
  flag("-q,--quiet", parser_->quiet, "say nothing but results and errors");
}

CommandLine::~CommandLine() = default;

void CommandLine::flag(const std::string& names, bool& value, const std::string& help) {
  parser_->app.add_flag(names, value, help);
  parser_->sheet.options.push_back({names, "", help, true});
}

template <typename Value>
void CommandLine::option(const std::string& names, Value& value, const std::string& help,
                         const OptionTraits& traits) {
  CLI::Option* const option = parser_->app.add_option(names, value, help);
  if (!traits.hidden)
    parser_->sheet.options.push_back({names, traits.type, help, false, traits.required});
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

namespace {

// What no option or place takes: unknown options, with the nearest that there are, or else words.
std::string unexpected(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  std::string options, words;
  for (const std::string& word : app.remaining()) {
    if (!word.starts_with("-")) {
      words += (words.empty() ? "unexpected '" : ", '") + word + "'";
      continue;
    }
    const std::string name = word.substr(0, word.find('='));
    const std::string nearest = nearestName(name, names);
    options += (options.empty() ? "unknown option '" : ", '") + name + "'";
    if (!nearest.empty()) options += ", did you mean '" + nearest + "'?";
  }
  return options.empty() ? words : options;
}

// Other errors as refusals of scenes are told. CLI11 says "Could not convert: --still = -o" and
// "--html: 1 required FILE missing".
std::string worded(const CLI::App& app, std::string what) {
  const std::string head = "Could not convert: ", one = ": 1 required ", missing = " missing";
  if (const std::size_t at = what.find(one); at != std::string::npos && what.ends_with(missing))
    return what.substr(0, at + 2) +
           what.substr(at + one.size(), what.size() - at - one.size() - missing.size()) +
           " is missing";
  const std::size_t equals = what.find(" = ");
  if (!what.starts_with(head) || equals == std::string::npos) return what;
  const std::string name = what.substr(head.size(), equals - head.size());
  const CLI::Option* option = app.get_option_no_throw(name);
  if (!option) return what;
  // With a range it reads "N:from 1 to 256".
  std::string type = option->get_type_name();
  if (type.starts_with("N:")) type = "a whole number " + type.substr(2);
  return fmt::format("{}: expected {}, found '{}'", name, type, what.substr(equals + 3));
}

}  // namespace

bool CommandLine::read(int argc, char** argv) {
  if (listener) {
    *listener = parser_->sheet;
    return false;
  }
  try {
    parser_->app.parse(argc, argv);
    setQuiet(parser_->quiet);
    return true;
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}\n", parser_->app.help());
    return false;
  } catch (const CLI::ExtrasError&) {
    throw UsageError(fmt::format("{}; `{} --help` shows how", unexpected(parser_->app),
                                 parser_->app.get_name()));
  } catch (const CLI::ParseError& error) {
    std::string what = error.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw UsageError(fmt::format("{}; `{} --help` shows how", worded(parser_->app, what),
                                 parser_->app.get_name()));
  }
}

std::vector<CommandSheet> sheetsOf(std::span<const Command> table) {
  std::vector<CommandSheet> sheets;
  for (const Command& row : table) {
    CommandSheet sheet;
    CommandLine::listener = &sheet;
    row.run(0, nullptr);
    CommandLine::listener = nullptr;
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

}  // namespace tumble
