// What the commands' options have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/scene/scene.h"

namespace tumble {

/// The parser of one command, with examples below its help.
class CommandLine : public CLI::App {
 public:
  /// @param examples "arguments  # what they do", without the program's name
  CommandLine(const std::string& name, const std::string& summary,
              const std::vector<std::string>& examples);

  /// False if help was asked for and has been printed.
  /// @throws UsageError in one line.
  bool read(int argc, char** argv);
};

/// SCENE and --set.
struct SceneOptions {
  std::string scene;
  std::vector<std::string> overrides;
};
void addSceneOptions(CLI::App& app, SceneOptions& options);

/// --set alone, for commands that take several scenes or none.
void addOverrides(CLI::App& app, std::vector<std::string>& overrides);

/// Refuses all but numbers in [lo, hi], NaN too.
CLI::Validator between(double lo, double hi);

/// --rate: samples or images a second; 0 stays the scene's own.
void addRate(CLI::App& app, double& rate);

/// Reads the scene that the options name.
/// @throws UsageError, SceneError
Scene load(const SceneOptions& options);

/// Two whole numbers: "A:B" with 0 ≤ A < B, "WxH" with 16 ≤ W, H ≤ 8192, "I/N" with 0 ≤ I < N.
/// @throws UsageError naming the option, its text and what is expected.
std::pair<int, int> parseFrames(const std::string& text);
std::pair<int, int> parseSize(const std::string& text);
std::pair<int, int> parseShard(const std::string& text);

}  // namespace tumble
