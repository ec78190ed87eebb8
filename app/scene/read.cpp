// Scene files: text to tree, tree to scene.
#include "app/scene/scene.h"

#include <filesystem>
#include <fstream>

#include "app/scene/array.h"
#include "app/scene/force.h"
#include "app/scene/override.h"
#include "app/scene/settings.h"
#include "app/scene/toml.h"

namespace tumble {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLargestFile = 4 << 20;  // bytes

SceneError refusal(const std::string& file, const std::string& what) {
  std::vector<Diagnostic> one(1);
  one[0].place.file = file;
  one[0].message = what;
  return SceneError(std::move(one));
}

// What a person calls the parts of a scene that other keys depend on comes first: materials before
// bodies, bodies before forces.
Scene readTree(const Node& tree, Findings& findings) {
  Scene scene;
  Section root(tree, "", findings);
  readTexts(root, scene);
  readWorld(root, scene);
  readCourse(root, scene.world.course);
  readStepping(root, scene.world.stepping);
  const Materials materials = readMaterials(root);
  readPairs(root, materials, scene.world.pairs);
  Bodies bodies(scene);
  readBodies(root, materials, bodies);
  readArrays(root, materials, scene.seed, scene.world.gravity, bodies);
  if (bodies.next() == 0 && root.good())
    root.complain("body", "missing; a scene needs at least one [[body]] or [[array]]");
  readForces(root, bodies, scene.world.forces);
  if (root.find("joint")) root.complain("joint", "joints are not built yet");
  readCamera(root, scene.camera);
  readImage(root, scene.image);
  readShow(root, scene.show);
  readSweep(root, scene.sweep);
  root.finish();
  findings.raise();
  scene.places = findings.takePlaces();
  return scene;
}

// A sweep's parameter has to be a key that the scene understands: try its first value.
void trySweep(const Sweep& sweep, Node tree, std::vector<std::string> sources) {
  sources.push_back(sources[0] + ": [sweep] " + sweep.parameter + "=" + sweep.values[0]);
  Findings findings(sources);
  apply({sweep.parameter, sweep.values[0]}, static_cast<int>(sources.size()) - 1, tree, findings);
  readTree(tree, findings);
}

}  // namespace

Scene parseScene(const std::string& text, const std::string& file,
                 const std::vector<std::string>& overrides) {
  // The text as a tree, changed by each --set.
  if (text.size() > kLargestFile)
    throw refusal(file, "larger than 4 MiB; use [[array]] for many bodies");
  std::vector<std::string> sources{file};
  std::vector<Override> changes;
  for (const std::string& override : overrides) {
    changes.push_back(splitOverride(override));
    sources.push_back("--set " + override);
  }
  Findings findings(sources);
  Node tree;
  try {
    tree = parseToml(text);
  } catch (const TomlError& error) {
    findings.complain(error.spot, "", std::string("not valid TOML: ") + error.what());
    findings.raise();
  }
  for (std::size_t i = 0; i < changes.size(); ++i)
    apply(changes[i], static_cast<int>(i) + 1, tree, findings);

  // The tree as a scene.
  Scene scene = readTree(tree, findings);
  if (scene.sweep) trySweep(*scene.sweep, tree, sources);
  scene.file = file;
  scene.name = fs::path(file).stem().string();
  scene.line = scene.name;
  for (const std::string& override : overrides) scene.line += " " + override;
  return scene;
}

Scene readScene(const std::string& path, const std::vector<std::string>& overrides) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw refusal(path, "is a folder, not a scene file");
  if (!fs::exists(path, ignored)) throw refusal(path, "there is no such file");
  std::ifstream in(path, std::ios::binary);
  std::string text(kLargestFile + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || (in.fail() && !in.eof())) throw refusal(path, "cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parseScene(text, path, overrides);
}

}  // namespace tumble
