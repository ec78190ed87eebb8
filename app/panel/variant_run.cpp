#include "app/panel/variant_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/claim/verdict.h"
#include "app/present/bent.h"
#include "app/present/bodies.h"
#include "app/present/state_picture.h"

namespace tumble {

namespace {

// [px] of the page of a panel; of a small panel among many, where type has to be larger.
constexpr double kPanelWidth = 800.0, kSmallPanelWidth = 640.0;

// Whether one camera serves both: the same bodies, seen in the same way.
bool comparable(const VariantRun& runA, const VariantRun& runB) {
  if (runA.still != runB.still) return false;
  const Scene &a = runA.scene, &b = runB.scene;
  const CameraView &ca = a.camera, &cb = b.camera;
  if (ca.eye != cb.eye || ca.target != cb.target || ca.fov != cb.fov || ca.azimuth != cb.azimuth ||
      ca.elevation != cb.elevation)
    return false;
  if (a.world.bodies.size() != b.world.bodies.size()) return false;
  for (std::size_t i = 0; i < a.world.bodies.size(); ++i)
    if (a.world.bodies[i].name != b.world.bodies[i].name) return false;
  return true;
}

// The camera that sees the motion of every run that can be compared with this one.
Framing sharedFraming(const std::deque<VariantRun>& runs, const VariantRun& run) {
  std::vector<SeenRun> seen;
  double strained = 0.0;
  for (const VariantRun& other : runs) {
    if (!comparable(run, other)) continue;
    seen.push_back({other.scene, other.recording});
    if (other.scene.show.strain)
      strained = std::max(strained, usualStrain(other.scene, other.recording));
  }
  // Claims stand below the panel and need no room above.
  Scene plain = run.scene;
  plain.expects.clear();
  Framing framing = framingOf(plain, seen);
  framing.strained = strained;
  return framing;
}

// How large a metre looks at what the camera is aimed at, but for the size of the image.
double scaleOf(const Camera& camera) {
  return (camera.eye - camera.target).norm() * std::tan(camera.fov * std::numbers::pi / 360.0);
}

// Each run as its camera sees it. What is seen as large stands on the same grid.
std::vector<Framing> framings(const std::deque<VariantRun>& runs, const Eigen::Vector2d& page) {
  std::vector<Framing> all;
  for (const VariantRun& run : runs) {
    all.push_back(sharedFraming(runs, run));
    all.back().page = page;
  }
  for (Framing& framing : all)
    for (const Framing& other : all)
      if (std::abs(scaleOf(other.camera) / scaleOf(framing.camera) - 1.0) < 1e-3)
        framing.floor = std::max(framing.floor, other.radius);
  return all;
}

// The start as it stands, which may be one that no run can begin with.
void takeState(VariantRun& run) {
  constexpr double kTop = 40.0;  // [px] of its heading
  const StartCheck check = checkedStart(run.scene);
  run.recording.samples = {check.sample};
  run.recording.rate = run.scene.image.rate;
  run.still = true;
  run.wrong = !check.faults.empty();
  run.picture = [scene = &run.scene, check](const Presenter&) {
    return statePicture(*scene, check, kTop);
  };
}

// What stands below a panel: words of its own, then what its picture says below a title, which it
// has not.
std::string findingOf(const VariantRun& run, const Picture& picture) {
  std::vector<std::string> words;
  if (!run.subtitle.empty()) words.push_back(run.subtitle);
  for (const Remark& remark : picture.remarks) words.push_back(remark.text);
  const std::string told = run.scene.subtitle + run.title + run.subtitle;
  if (const std::string dotted = legendOf(picture, told); !dotted.empty()) words.push_back(dotted);
  return fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace

Scene sceneOf(const Scene& scene, const Variant& variant) {
  Scene changed = readScene(scene.file, scene.overrides, &variant);
  requireKnownChecks(changed);
  return changed;
}

std::deque<VariantRun> runPanels(const Scene& scene, const RunDone& done) {
  std::deque<VariantRun> runs;
  for (const PanelDef& panel : scene.panels) {
    VariantRun& run = runs.emplace_back();
    run.title = panel.variant.title;
    run.subtitle = panel.subtitle;
    run.scene = sceneOf(scene, panel.variant);
    if (panel.picture == "state") {
      takeState(run);
      done();
      continue;
    }
    run.recording = record(run.scene, run.scene.image.rate);
    if (run.recording.samples.empty())
      throw StoppedError("the physics of panel '" + run.title +
                         "' could not begin: " + run.recording.report.reason);
    run.still = panel.picture == "still";
    if (run.still)
      run.picture = [at = panel.at](const Presenter& presenter) { return presenter.still(at); };
    else
      run.picture = [](const Presenter& presenter) { return presenter.strobe(); };
    done();
  }
  return runs;
}

std::vector<Panel> drawPanels(const std::deque<VariantRun>& runs, const Eigen::Vector2d& page,
                              const DrawPanel& draw) {
  std::vector<Panel> panels;
  const std::vector<Framing> seen = framings(runs, page);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const VariantRun& run = runs[i];
    const Presenter presenter(run.scene, run.recording, seen[i]);
    Picture picture = run.picture(presenter);
    picture.title.clear();
    picture.subtitle.clear();
    const std::string finding = findingOf(run, picture);
    picture.remarks.clear();
    panels.push_back({draw(picture), run.title, finding});
    if (run.wrong) redden(panels.back().image);
  }
  return panels;
}

Eigen::Vector2d panelPage(const Scene& scene) {
  const std::size_t page = scene.panels.size() + scene.graphs.size() + scene.charts.size();
  const std::size_t sweep = scene.sweep ? scene.sweep->values.size() : 0;
  const double width =
      std::max(columnsOf(page), columnsOf(sweep)) > 3 ? kSmallPanelWidth : kPanelWidth;
  return {width, width * scene.image.height / scene.image.width};
}

int panelHeight(const Scene& scene, int width) {
  return std::max(16, width * scene.image.height / scene.image.width);
}

int columnsOf(std::size_t panels) {
  if (panels <= 3) return static_cast<int>(panels);
  if (panels == 4) return 2;
  if (panels <= 6 || panels == 9) return 3;
  return panels % 4 == 1 ? 5 : 4;  // none alone in the last row
}

}  // namespace tumble
