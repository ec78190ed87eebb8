#include "app/viewer/viewer.h"

#include <algorithm>

#include "app/scene/demos.h"

namespace tumble {

std::vector<DemoEntry> demoEntries() {
  std::vector<DemoEntry> entries;
  for (const std::string& name : demoNames()) {
    DemoEntry entry{name, name, "", scenePath(name)};
    try {
      const Scene scene = readScene(entry.path);
      entry.title = scene.title.empty() ? name : scene.title;
      entry.chapter = scene.chapter;
    } catch (const SceneError&) {
      // It stays in the list under its bare name; choosing it tells what is wrong.
    }
    entries.push_back(std::move(entry));
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const DemoEntry& a, const DemoEntry& b) { return a.chapter < b.chapter; });
  return entries;
}

Viewer::Viewer(Renderer& renderer, std::vector<DemoEntry> demos)
    : renderer_(renderer), demos_(std::move(demos)) {}

void Viewer::open(Scene scene) {
  Recording recording = record(scene, scene.image.rate);
  presenter_.reset();
  scene_ = std::move(scene);
  recording_ = std::move(recording);
  presenter_.emplace(*scene_, *recording_);
  complaint_ = recording_->report.stopped ? recording_->report.reason : "";
  playback_ = Playback(presenter_->count() - 1, recording_->rate);
  drawn_ = {};
  home_ = orbit_ = Orbit::of(presenter_->image(0).camera);
}

void Viewer::choose(const DemoEntry& demo) {
  try {
    open(readScene(demo.path));
  } catch (const SceneError& error) {
    complaint_ = error.what();
  }
}

void Viewer::draw(int width, int height) {
  const Camera camera = orbit_.camera();
  const Drawn wanted{playback_.sample(), width, height, camera.eye, camera.target};
  if (wanted == drawn_) return;
  Picture picture = presenter_->image(wanted.sample);
  picture.camera = camera;
  texture_.load(renderer_.draw(picture, {.width = width, .height = height}));
  drawn_ = wanted;
}

}  // namespace tumble
