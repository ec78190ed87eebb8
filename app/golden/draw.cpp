#include "app/golden/draw.h"

#include "app/command/data.h"
#include "app/present/present.h"
#include "app/record/output.h"
#include "app/viewer/snapshot.h"

namespace tumble {

namespace {

constexpr RenderOptions kSmall = {.width = 480, .height = 270};
constexpr int kRows = 20;  // intervals between the instants that numbers are kept of

// What the window shows when its golden is drawn: something of every kind, over in a moment.
constexpr const char* kWindowScene = R"toml(
title = "A ball and a brick"
chapter = "window"
[world]
duration = 1.0
[materials.clay]
density = 1000.0
restitution = 0.5
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "ball"
shape = { sphere = 0.2 }
material = "clay"
position = [-0.4, 1.0, 0.0]
[[body]]
name = "brick"
shape = { box = [0.4, 0.1, 0.3] }
material = "clay"
position = [0.4, 0.8, 0.0]
angular_velocity = [0.0, 1.0, 3.0]
[show]
path = true
)toml";

// Every sample whose instant is one of kRows + 1 that divide the duration evenly.
Recording thinned(const Recording& recording) {
  Recording few = recording;
  few.samples.clear();
  const std::size_t last = recording.samples.size() - 1;
  for (std::size_t k = 0; k <= kRows; ++k)
    few.samples.push_back(recording.samples[last * k / kRows]);
  return few;
}

Golden drawWindow(Renderer& renderer) {
  const Scene scene = parseScene(kWindowScene, std::string(kWindowSubject));
  return {
      std::string(kWindowSubject), {{"page", viewerSnapshot(renderer, scene, 0.5, 960, 540)}}, ""};
}

Golden drawDemo(const std::string& name, Renderer& renderer) {
  const Scene scene = readScene(scenePath(name));
  const Recording recording = record(scene, scene.image.rate);
  const Presenter presenter(scene, recording);
  const int last = presenter.count() - 1;
  std::vector<NamedImage> images;
  const auto draw = [&](const std::string& image, const Picture& picture) {
    images.push_back({image, renderer.draw(picture, kSmall)});
  };
  draw("strobe", presenter.strobe());
  draw("end", presenter.image(last));
  draw("middle", presenter.image(last / 3));
  draw("start", presenter.image(0));
  return {name, distinctImages(std::move(images)), trajectoryCsv(thinned(recording), scene)};
}

}  // namespace

Golden drawGolden(const std::string& subject, Renderer& renderer) {
  return subject == kWindowSubject ? drawWindow(renderer) : drawDemo(subject, renderer);
}

}  // namespace tumble
