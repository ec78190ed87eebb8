// Scene files: text to tree, tree to scene.
#include "app/scene/scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "app/file/file.h"
#include "app/scene/array.h"
#include "app/scene/camera.h"
#include "app/scene/cloth.h"
#include "app/scene/expect.h"
#include "app/scene/force.h"
#include "app/scene/fur.h"
#include "app/scene/joint.h"
#include "app/scene/node.h"
#include "app/scene/numbers.h"
#include "app/scene/override.h"
#include "app/scene/panel.h"
#include "app/scene/settings.h"
#include "app/scene/soft.h"
#include "app/scene/text.h"
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
  readStepping(root, scene.world);
  const Materials materials = readMaterials(root);
  readPairs(root, materials, scene.world.pairs);
  BodyList bodies(scene);
  readBodies(root, materials, bodies);
  readArrays(root, materials, scene.seed, scene.world.gravity, bodies);
  readCloths(root, materials, bodies, scene);
  readSofts(root, materials, bodies, scene);
  readFurs(root, materials, bodies, scene);
  if (bodies.next() == 0 && root.good())
    root.complain("body",
                  "missing; a scene needs at least one [[body]], [[array]], [[cloth]] or [[soft]]");
  readForces(root, bodies, scene.world.forces);
  readJoints(root, bodies, scene.world.joints);
  readCamera(root, scene);
  readImage(root, scene.image);
  readShow(root, scene.show);
  readExpects(root, scene);
  readFreeTexts(root, scene);
  const std::vector<std::string> parts = partNames(tree);
  readSweep(root, scene.sweep);
  readPanels(root, parts, scene);
  readGraphs(root, parts, scene);
  readCharts(root, parts, scene);
  root.finish();
  findings.raise();
  scene.places = findings.takePlaces();
  scene.wordings = findings.takeWordings();
  if (!scene.expects.empty() || !scene.graphs.empty()) scene.numbers = numbersOf(tree);
  return scene;
}

// Sweep, panels and charts have to set keys that the scene understands: reads what each would run,
// of many values the first.
class Trial {
 public:
  Trial(const Node& tree, const std::vector<std::string>& sources)
      : tree_(tree), sources_(sources) {}

  void run(const Scene& scene) {
    if (const auto& sweep = scene.sweep) tryVariant({"", {sweep->setting(0)}, {}}, "[sweep]");
    for (const PanelDef& panel : scene.panels) {
      const auto duration =
          tryVariant(panel.variant, "[[panel]] " + tumble::inQuotes(panel.variant.title));
      // A run cut short by --set takes its last instant instead.
      if (duration && panel.at > *duration && sources_.size() == 1)
        complain(panel.spot, fmt::format("at: the panel's scene lasts from 0 to {:g} s, and not "
                                         "until the still at {:g} s",
                                         *duration, panel.at));
    }
    for (const GraphDef& graph : scene.graphs)
      for (const GraphCurve& curve : graph.curves)
        tryVariant(joined(graph.variant, curve.variant),
                   "[[graph]] " + tumble::inQuotes(curve.variant.title));
    for (const ChartDef& chart : scene.charts)
      for (const CurveDef& curve : chart.curves) {
        Variant variant = joined(chart.variant, curve.variant);
        variant.set.push_back(curve.along.setting(0));
        tryVariant(variant, "[[chart]] " + tumble::inQuotes(curve.variant.title));
      }
    if (!diagnostics_.empty()) throw SceneError(std::move(diagnostics_));
  }

 private:
  // The duration [s] of the variant's scene, if it is one.
  std::optional<double> tryVariant(const Variant& variant, const std::string& what) {
    Findings findings(sources_);
    Node changed = tree_;
    try {
      apply(variant, changed, findings);
      return readTree(changed, findings).world.duration;
    } catch (const SceneError& error) {
      for (Diagnostic diagnostic : error.diagnostics()) {
        diagnostic.message += " (as set in " + what + ")";
        diagnostics_.push_back(std::move(diagnostic));
      }
      return {};
    }
  }

  void complain(Spot spot, const std::string& what) {
    diagnostics_.push_back({{sources_[spot.source], spot.line, spot.column}, what});
  }

  const Node& tree_;
  const std::vector<std::string>& sources_;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace

Scene parseScene(const std::string& text, const std::string& file,
                 const std::vector<std::string>& overrides, const Variant* variant) {
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
    apply(changes[i], {static_cast<int>(i) + 1, 0, 0}, tree, findings);
  if (variant) apply(*variant, tree, findings);

  // The tree as a scene.
  Scene scene = readTree(tree, findings);
  Trial(tree, sources).run(scene);
  scene.file = file;
  scene.name = fs::path(file).stem().string();
  scene.overrides = overrides;
  scene.line = scene.name;
  for (const std::string& override : overrides) scene.line += " " + override;
  if (!variant) return scene;
  for (const Setting& setting : variant->set) scene.line += " " + setting.text;
  for (const std::string& name : variant->bodies) scene.line += " with " + name;
  return scene;
}

Scene readScene(const std::string& path, const std::vector<std::string>& overrides,
                const Variant* variant) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    throw FileError(path + ": is a folder; name a scene file, one that ends in .toml");
  if (!fs::exists(path, ignored)) throw FileError(path + ": there is no such file");
  std::ifstream in(path, std::ios::binary);
  std::string text(kLargestFile + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || (in.fail() && !in.eof())) throw FileError(path + ": cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parseScene(text, path, overrides, variant);
}

}  // namespace tumble
