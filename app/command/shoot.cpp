#include "app/command/shoot.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/command/command.h"
#include "app/command/progress.h"
#include "app/command/run.h"
#include "app/command/stamp.h"
#include "app/command/video.h"
#include "app/file/file.h"
#include "app/panel/page.h"
#include "render/png_writer.h"
#include "render/sheet.h"

namespace tumble {

Shoot::Shoot(const Scene& scene, std::string folder, Studio& studio)
    : scene_(scene), folder_(std::move(folder)), studio_(studio) {
  makeFolder(folder_);
}

int Shoot::count() const {
  return sampleCount(scene_, scene_.image.rate);
}

const Recording& Shoot::recording() {
  if (!recording_) recording_ = recordWithProgress(scene_);
  return *recording_;
}

const Presenter& Shoot::presenter() {
  if (recording().samples.empty())
    throw StoppedError("the physics could not begin: " + recording().report.reason);
  if (!presenter_) presenter_.emplace(scene_, recording());
  return *presenter_;
}

bool Shoot::finished(const std::string& path, const std::string& what) const {
  return readStamp(path) == stampOf(scene_, what);
}

std::string Shoot::still(double t) {
  const std::string path = folder_ + "/still.png", what = fmt::format("still at {:.17g} s", t);
  if (!finished(path, what))
    writePng(path, studio_.draw(presenter().still(t), scene_.image), stampOf(scene_, what));
  return path;
}

std::string Shoot::strobe() {
  const std::string path = folder_ + "/strobe.png", what = "strobe";
  if (!finished(path, what))
    writePng(path, studio_.draw(presenter().strobe(), scene_.image), stampOf(scene_, what));
  return path;
}

std::string Shoot::sheet() {
  constexpr int kPanels = 12, kColumns = 4;
  const std::string path = folder_ + "/sheet.png", what = "sheet";
  if (finished(path, what)) return path;
  ImageFormat format = scene_.image;
  format.width = 480;
  format.height = std::max(16, format.width * scene_.image.height / scene_.image.width);
  const double end = (presenter().count() - 1) / scene_.image.rate;
  std::vector<Panel> panels;
  for (int n = 0; n < kPanels; ++n) {
    const double t = end * n / (kPanels - 1);
    Picture picture = presenter().still(t);
    stripForPanel(picture);
    panels.push_back({studio_.draw(picture, format), fmt::format("t = {:.2f} s", t), ""});
  }
  writePng(path, drawSheet(panels, kColumns, scene_.title, scene_.subtitle, studio_.fonts()),
           stampOf(scene_, what));
  return path;
}

std::vector<std::string> Shoot::panels() {
  const std::size_t total = runsOf(scene_);
  std::vector<std::string> paths;
  if (total == 0) return paths;
  paths.push_back(folder_ + "/panels.png");
  for (const auto& [name, title] : plotNames(scene_))
    paths.push_back(folder_ + "/" + name + ".png");
  if (std::all_of(paths.begin(), paths.end(),
                  [this](const std::string& path) { return finished(path, "panels"); }))
    return paths;

  std::size_t count = 0;
  Progress progress("simulating panels");
  const PageRuns runs =
      runPage(scene_, [&] { progress.show(static_cast<double>(++count) / total); });
  ImageFormat format = scene_.image;
  format.width = kSheetPanel;
  format.height = panelHeight(scene_, kSheetPanel);
  const auto draw = [&](const Picture& picture) {
    return studio_.draw(picture, format, panelPage(scene_).y());
  };
  for (const Plot& plot : plotsOf(scene_, runs)) {
    writeFile(folder_ + "/" + plot.name + ".csv", plot.csv);
    writePng(folder_ + "/" + plot.name + ".png",
             drawChart(plot.chart, scene_.image.width, scene_.image.height,
                       scene_.image.height / 720.0, studio_.fonts()),
             stampOf(scene_, "panels"));
  }
  writePng(paths.front(), drawPage(scene_, runs, kSheetPanel, draw, studio_.fonts()),
           stampOf(scene_, "panels"));
  return paths;
}

std::string Shoot::sequence(std::pair<int, int> range) {
  const auto name = [this](int k) { return fmt::format("{}/image-{:06}.png", folder_, k); };
  const auto what = [](int k) { return fmt::format("image {}", k); };
  PngWriter writer;
  Progress progress("drawing");
  const int last = std::min(range.second, count());
  for (int k = range.first; k < last; ++k) {
    progress.show(static_cast<double>(k - range.first) / (last - range.first));
    if (finished(name(k), what(k))) continue;
    if (k >= presenter().count()) break;
    writer.write(name(k), studio_.draw(presenter().image(k), scene_.image),
                 stampOf(scene_, what(k)));
  }
  writer.finish();
  return folder_ + "/image-*.png";
}

void Shoot::video(const std::string& path, std::pair<int, int> range) {
  Video video(path, scene_.image.width, scene_.image.height, scene_.image.rate);
  const int last = std::min(range.second, presenter().count());
  Progress progress("filming");
  for (int k = range.first; k < last; ++k) {
    video.add(studio_.draw(presenter().image(k), scene_.image));
    progress.show(static_cast<double>(k - range.first) / (last - range.first));
  }
  video.finish();
}

}  // namespace tumble
