// What the commands' options have in common.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/command/command_line.h"
#include "app/scene/scene.h"

namespace tumble {

/// SCENE, --set and --threads.
struct SceneOptions {
  std::string scene;
  std::vector<std::string> overrides;
  int threads = 1;
};
void addSceneOptions(CommandLine& line, SceneOptions& options);

/// --set alone, for commands that take several scenes or none.
void addOverrides(CommandLine& line, std::vector<std::string>& overrides);

/// --rate: samples or images a second; 0 stays the scene's own.
void addRate(CommandLine& line, double& rate);

/// Reads the scene that the options name; worlds use their threads from now on.
/// @throws UsageError, SceneError
Scene load(const SceneOptions& options);

/// Instants in ascending order, "T,T,…" with 0 < T ≤ the duration [s].
/// @throws UsageError naming the option, its text and what is expected.
std::vector<double> parseInstants(const std::string& text, double duration);

/// Two whole numbers: "A:B" with 0 ≤ A < B, "WxH" with 16 ≤ W, H ≤ 8192, "I/N" with 0 ≤ I < N.
/// @throws UsageError naming the option, its text and what is expected.
std::pair<int, int> parseFrames(const std::string& text);
std::pair<int, int> parseSize(const std::string& text);
std::pair<int, int> parseShard(const std::string& text);

}  // namespace tumble
