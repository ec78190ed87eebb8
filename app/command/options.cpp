#include "app/command/options.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "app/claim/verdict.h"
#include "app/command/command.h"
#include "app/scene/demos.h"

namespace tumble {

CommandLine::CommandLine(const std::string& name, const std::string& summary,
                         const std::vector<std::string>& examples)
    : CLI::App(summary, "tumble " + name) {
  std::string text = "\nExamples:";
  for (const std::string& example : examples) text += "\n  tumble " + name + " " + example;
  footer(text);
}

bool CommandLine::read(int argc, char** argv) {
  try {
    parse(argc, argv);
    return true;
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}\n", help());
    return false;
  } catch (const CLI::ParseError& error) {
    std::string what = error.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw UsageError(fmt::format("{}; `{} --help` shows how", what, get_name()));
  }
}

void addOverrides(CLI::App& app, std::vector<std::string>& overrides) {
  app.add_option("--set", overrides, "override a key of the scene; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void addSceneOptions(CLI::App& app, SceneOptions& options) {
  app.add_option("SCENE", options.scene, "a demo's name or a TOML file")->required();
  addOverrides(app, options.overrides);
}

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

void addRate(CLI::App& app, double& rate) {
  app.add_option("--rate", rate, "samples and images a second [the scene's own]")
      ->type_name("HZ")
      ->check(between(1e-3, 1e5));
}

Scene load(const SceneOptions& options) {
  for (const std::string& text : options.overrides) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError(
          fmt::format("--set {}: expected KEY=VALUE, for example world.gravity=[0,-1.62,0]", text));
  }
  Scene scene = readScene(scenePath(options.scene), options.overrides);
  requireKnownChecks(scene);
  return scene;
}

namespace {

// Both numbers around the separator, if the whole text is that.
std::optional<std::pair<int, int>> twoNumbers(const std::string& text, char separator) {
  std::pair<int, int> numbers;
  const char* const end = text.data() + text.size();
  const std::from_chars_result first = std::from_chars(text.data(), end, numbers.first);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != separator) return {};
  const std::from_chars_result second = std::from_chars(first.ptr + 1, end, numbers.second);
  if (second.ec != std::errc() || second.ptr != end) return {};
  return numbers;
}

}  // namespace

std::pair<int, int> parseFrames(const std::string& text) {
  const std::optional<std::pair<int, int>> range = twoNumbers(text, ':');
  if (!range || range->first < 0 || range->second <= range->first)
    throw UsageError(fmt::format(
        "--frames {}: expected A:B with 0 <= A < B, for example 0:60 for images 0 to 59", text));
  return *range;
}

std::pair<int, int> parseSize(const std::string& text) {
  const std::optional<std::pair<int, int>> size = twoNumbers(text, 'x');
  if (!size || std::min(size->first, size->second) < 16 ||
      std::max(size->first, size->second) > 8192)
    throw UsageError(fmt::format(
        "--size {}: expected WxH in pixels, each from 16 to 8192, for example 1280x720", text));
  return *size;
}

std::pair<int, int> parseShard(const std::string& text) {
  const std::optional<std::pair<int, int>> shard = twoNumbers(text, '/');
  if (!shard || shard->first < 0 || shard->second <= shard->first)
    throw UsageError(
        fmt::format("--shard {}: expected I/N with 0 <= I < N, for example 0/4", text));
  return *shard;
}

}  // namespace tumble
