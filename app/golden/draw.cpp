#include "app/golden/draw.h"

#include <cmath>

#include "app/file/data.h"
#include "app/panel/page.h"
#include "app/present/present.h"
#include "app/record/output.h"
#include "app/scene/demos.h"
#include "app/viewer/snapshot.h"

namespace tumble {

namespace {

constexpr double kPixels = 480.0 * 270.0;  // of an image
constexpr int kSmallPanel = 360;           // [px] width of a panel
constexpr int kRows = 20;  // intervals between the instants that numbers are kept of

// A ball flies at a wall: bodies of two forms that fill the image and shade each other.
constexpr const char* kWindowScene = R"toml(
title = "A ball and a wall"
chapter = "window"
[world]
method = "stepping"
duration = 0.5
[materials.clay]
density = 1000.0
restitution = 0.3
friction = 0.5
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
material = "clay"
[[body]]
name = "ball"
shape = { sphere = 0.2 }
material = "clay"
position = [-0.6, 0.7, 1.2]
velocity = [0.8, 1.0, -3.0]
[[array]]
name = "wall"
kind = "wall"
rows = 5
columns = 4
body = { shape = { box = [0.4, 0.2, 0.2] }, material = "clay" }
[camera]
azimuth = 35.0
elevation = 25.0
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

// Of the scene's own shape.
RenderOptions smallImages(const Scene& scene) {
  const double width = std::sqrt(kPixels * aspectOf(scene));
  return {.width = static_cast<int>(std::lround(width)),
          .height = static_cast<int>(std::lround(kPixels / width))};
}

Golden drawWindow(Renderer& renderer) {
  const Scene scene = windowScene();
  const Eigen::Vector2f ball(582.0f, 195.0f), forces(149.0f, 365.0f);  // [px]
  const auto click = [](const Eigen::Vector2f& at) {
    return std::vector<Deed>{{at}, {at, true}, {at}};
  };
  std::vector<Deed> picked = click(ball), shown = {{forces}, {.pointer = forces, .wheel = -30.0f}};
  for (const Deed& deed : click(forces)) shown.push_back(deed);
  picked.push_back({.typed = "f"});
  std::vector<Deed> live = {{.typed = "l"}, {ball}};
  for (int k = 0; k <= 30; ++k)
    live.push_back({.pointer = ball + static_cast<float>(k) * Eigen::Vector2f(4.0f, -2.0f),
                    .pressed = true,
                    .seconds = 1.0 / 60.0});
  // Turned, kept as the first view, left, and gone back to.
  const Eigen::Vector2f page(500.0f, 120.0f), aside(620.0f, 150.0f);
  std::vector<Deed> turned = {{page}, {page, true}, {aside, true}, {aside}}, kept = turned;
  turned.push_back({.typed = "c"});
  for (const char* key : {"k", "v", "1"}) kept.push_back({.typed = key});
  const struct {
    const char* name;
    double share;
    std::vector<Deed> deeds;
  } states[] = {{"page", 0.5, {}},
                {"picked", 0.5, picked},
                {"forces", 1.0, shown},
                {"live", 0.5, live},
                {"kept", 0.5, kept},
                {"command", 0.5, turned},
                {"help", 0.0, {{.typed = "h"}}},
                {"refused", 0.5, {{.dropped = "missing.toml"}}}};
  Golden golden{std::string(kWindowSubject), {}, {}};
  for (const auto& state : states)
    golden.images.push_back(
        {state.name, viewerSnapshot(renderer, scene, state.share, 960, 540, state.deeds)});
  return golden;
}

// The page of panels and charts, and the numbers that every machine finds for the charts.
void addPage(const Scene& scene, Renderer& renderer, Golden& golden) {
  if (runsOf(scene) == 0) return;
  const PageRuns runs = runPage(scene);
  Fonts fonts(dataFolder("fonts"));
  const RenderOptions options{.width = kSmallPanel,
                              .height = panelHeight(scene, kSmallPanel),
                              .pageHeight = panelPage(scene).y()};
  const auto draw = [&](const Picture& picture) { return renderer.draw(picture, options); };
  golden.images.push_back({"panels", drawPage(scene, runs, kSmallPanel, draw, fonts)});
  for (const Plot& plot : plotsOf(scene, runs)) golden.tables.push_back({plot.name, plot.csv});
}

}  // namespace

Golden drawGolden(const Scene& scene, Renderer& renderer) {
  const Recording recording = record(scene, scene.image.rate);
  if (recording.report.stopped)
    throw StoppedError(scene.file +
                       " stops, so no golden of it is kept: " + recording.report.reason);
  const RenderOptions options = smallImages(scene);
  Scene small = scene;
  small.image.width = options.width;
  small.image.height = options.height;
  const Presenter presenter(small, recording);
  const int last = presenter.count() - 1;
  std::vector<NamedImage> images;
  const auto draw = [&](const std::string& image, const Picture& picture) {
    images.push_back({image, renderer.draw(picture, options)});
  };
  draw("strobe", presenter.strobe());
  draw("end", presenter.image(last));
  draw("middle",
       scene.image.still ? presenter.still(*scene.image.still) : presenter.image(last / 3));
  draw("start", presenter.image(0));
  Golden golden{scene.name,
                distinctImages(std::move(images)),
                {{"numbers", trajectoryCsv(thinned(recording), scene)}}};
  addPage(scene, renderer, golden);
  return golden;
}

Scene windowScene() {
  return parseScene(kWindowScene, std::string(kWindowSubject));
}

Golden drawGolden(const std::string& subject, Renderer& renderer) {
  return subject == kWindowSubject ? drawWindow(renderer)
                                   : drawGolden(readScene(scenePath(subject)), renderer);
}

}  // namespace tumble
