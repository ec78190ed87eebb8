#include "app/command/options.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "app/claim/verdict.h"
#include "app/command/command.h"
#include "app/record/threads.h"
#include "app/scene/demos.h"

namespace tumble {

void addOverrides(CommandLine& line, std::vector<std::string>& overrides) {
  line.option("--set", overrides, "override a key of the scene; repeatable", {.type = "KEY=VALUE"});
}

void addSceneOptions(CommandLine& line, SceneOptions& options) {
  line.option("SCENE", options.scene, "a demo's name or a TOML file", {.required = true});
  addOverrides(line, options.overrides);
  line.option("--threads", options.threads,
              "threads that solve islands of contacts; no bit depends on them [1]",
              {.type = "N", .range = {{1, 256}}});
}

void addRate(CommandLine& line, double& rate) {
  line.option("--rate", rate, "samples and images a second [the scene's own]",
              {.type = "HZ", .range = {{1e-3, 1e5}}});
}

Scene load(const SceneOptions& options) {
  for (const std::string& text : options.overrides) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError(
          fmt::format("--set {}: expected KEY=VALUE, for example world.gravity=[0,-1.62,0]", text));
  }
  useThreads(options.threads);
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

std::vector<double> parseInstants(const std::string& text, double duration) {
  std::vector<double> instants;
  const char *at = text.data(), *const end = at + text.size();
  while (true) {
    double t = 0.0;
    const std::from_chars_result read = std::from_chars(at, end, t);
    const bool number = read.ec == std::errc() && (read.ptr == end || *read.ptr == ',');
    if (!number || !(t > 0.0 && t <= duration) || (!instants.empty() && t <= instants.back()))
      throw UsageError(fmt::format(
          "--at {}: expected ascending instants T,T,... in seconds, above 0 and up to the duration "
          "of {:g} s, for example {:g},{:g}",
          text, duration, 0.5 * duration, duration));
    instants.push_back(t);
    if (read.ptr == end) return instants;
    at = read.ptr + 1;
  }
}

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
