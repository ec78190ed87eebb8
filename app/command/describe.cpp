// tumble describe: what a scene contains and what it uses.
#include <fmt/core.h>

#include <map>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/record/recording.h"

namespace tumble::command {

namespace {

std::string join(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
  return line.empty() ? "none" : line;
}

// "11 sphere, 11 box, 1 half-space"
std::string countShapes(const Scene& scene) {
  std::map<std::string_view, int> counts;
  for (const BodyDef& body : scene.world.bodies) ++counts[shapeName(body.shape)];
  std::vector<std::string> words;
  for (const auto& [name, count] : counts) words.push_back(fmt::format("{} {}", count, name));
  return join(words);
}

}  // namespace

int describe(int argc, char** argv) {
  SceneOptions options;
  CommandLine app("describe", "What a scene contains, uses and claims.",
                  {"path-of-brick", "my-scene.toml --set world.method=stepping"});
  addSceneOptions(app, options);
  if (!app.read(argc, argv)) return kOk;

  const Scene scene = load(options);
  const WorldDef& world = scene.world;
  fmt::print("{}: {}\n", scene.name, scene.title);
  if (!scene.claim.empty()) fmt::print("claim     {}\n", scene.claim);
  fmt::print("checks    {}\n", join(scene.checks));
  fmt::print("bodies    {}: {}\n", world.bodies.size(), countShapes(scene));
  fmt::print("forces    {}\n", world.forces.size());
  fmt::print("gravity   {:g} {:g} {:g} m/s²\n", world.gravity.x(), world.gravity.y(),
             world.gravity.z());
  fmt::print("method    {}, {:g} s\n", world.method, world.duration);
  const World running = makeWorld(scene);
  fmt::print("uses      {}\n", join(running.features()));
  fmt::print("leaves    {}\n", join(running.features(false)));
  if (scene.sweep)
    fmt::print("sweep     {} over {}\n", scene.sweep->parameter, join(scene.sweep->values));
  return kOk;
}

}  // namespace tumble::command
