#include "app/command/shoot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/command/command.h"
#include "app/command/interrupt.h"
#include "app/command/jobs.h"
#include "app/command/progress.h"
#include "app/command/run.h"
#include "app/command/stamp.h"
#include "app/command/video.h"
#include "app/export/page.h"
#include "app/file/file.h"
#include "app/panel/event_line.h"
#include "app/panel/page.h"
#include "app/present/digits.h"
#include "app/present/instants.h"
#include "render/png_writer.h"
#include "render/sheet.h"

namespace tumble {

Shoot::Shoot(const Scene& scene, std::string folder, Studio& studio)
    : scene_(scene), folder_(std::move(folder)), studio_(studio) {
  makeWorld(scene_);  // what its method refuses leaves no folder behind
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
  Stamp stamp = readStamp(path);
  stamp.erase(kMetresOfLevel);
  return stamp == stampOf(scene_, what);
}

bool Shoot::hasMasks(const std::string& path, const std::string& what) const {
  return finished(maskPath(path, "depth"), "depth of " + what) &&
         finished(maskPath(path, "identity"), "identities of " + what);
}

void Shoot::drawMasks(int k, const std::string& path, const std::string& what) {
  if (!masks_) {
    masks_.emplace(scene_, recording(), studio_);
    writeFile(folder_ + "/identities.csv", masks_->legend());
  }
  masks_->write(k, path, stampOf(scene_, "identities of " + what),
                stampOf(scene_, "depth of " + what));
}

std::string Shoot::still(double t) {
  const std::string path = folder_ + "/still.png", what = fmt::format("still at {:.17g} s", t);
  if (!finished(path, what))
    writePng(path, studio_.draw(presenter().still(t), scene_.image), stampOf(scene_, what));
  if (masked_ && !hasMasks(path, what)) drawMasks(presenter().sampleAt(t), path, what);
  return path;
}

std::string Shoot::events() {
  presenter();
  const std::string path = folder_ + "/events.svg";
  writeFile(path, eventLineSvg(scene_, recording(), studio_.fonts()));
  return path;
}

std::string Shoot::strobe() {
  const std::string path = folder_ + "/strobe.png", what = "strobe";
  if (!finished(path, what))
    writePng(path, studio_.draw(presenter().strobe(), scene_.image), stampOf(scene_, what));
  return path;
}

std::string Shoot::sheet() {
  constexpr int kColumns = 4;
  const std::string path = folder_ + "/sheet.png", what = "sheet";
  if (finished(path, what)) return path;
  ImageFormat format = scene_.image;
  format.width = 480;
  format.height = std::max(16, format.width * scene_.image.height / scene_.image.width);
  format.transparent = false;
  std::vector<Panel> panels;
  for (const int k : tellingSamples(scene_, recording(), 12)) {
    Picture picture = presenter().image(k);
    stripForPanel(picture);
    if (!panels.empty()) picture.bar.reset();  // one scale, told once
    panels.push_back(
        {studio_.draw(picture, format, panelPage(scene_).y()),
         fmt::format("t = {} s", instant(recording().samples[k].t, scene_.world.duration)), ""});
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
  format.transparent = false;
  const auto draw = [&](const Picture& picture) {
    return studio_.draw(picture, format, panelPage(scene_).y());
  };
  for (const Plot& plot : plotsOf(scene_, runs)) {
    writeFile(folder_ + "/" + plot.name + ".csv", plot.csv);
    writeFile(folder_ + "/" + plot.name + ".svg",
              svgOf(plot.chart, 720.0 * aspectOf(scene_), 720.0, studio_.fonts()));
    writePng(folder_ + "/" + plot.name + ".png",
             drawChart(plot.chart, scene_.image.width, scene_.image.height,
                       scene_.image.height / 720.0, studio_.fonts()),
             stampOf(scene_, "panels"));
  }
  writePng(paths.front(), drawPage(scene_, runs, kSheetPanel, draw, studio_.fonts()),
           stampOf(scene_, "panels"));
  return paths;
}

std::string Shoot::imagePath(int k) const {
  return fmt::format("{}/image-{:06}.png", folder_, k);
}

bool Shoot::hasImage(int k) const {
  const std::string path = imagePath(k), what = fmt::format("image {}", k);
  return finished(path, what) && (!masked_ || hasMasks(path, what));
}

void Shoot::drawImages(const std::vector<int>& images, const std::function<void()>& tell) {
  PngWriter writer;
  for (const int k : images) {
    if (Interrupt::asked()) break;
    if (k >= presenter().count()) break;
    const std::string what = fmt::format("image {}", k);
    writer.write(imagePath(k), studio_.draw(presenter().image(k), scene_.image),
                 stampOf(scene_, what));
    if (masked_) drawMasks(k, imagePath(k), what);
    tell();
  }
  writer.finish();
}

// The run is simulated once, before the processes part; each draws every jobs-th image.
void Shoot::drawBy(int jobs, const std::vector<int>& images, Progress& progress) {
  presenter();
  const auto work = [&](int job, const std::function<void()>& tell) {
    std::vector<int> part;
    for (std::size_t n = job; n < images.size(); n += jobs) part.push_back(images[n]);
    setQuiet(true);
    drawImages(part, tell);
    return +kOk;
  };
  const int code = runJobs(jobs, work, [&](long done) {
    progress.show(static_cast<double>(done) / static_cast<double>(images.size()));
  });
  if (code != kOk && !Interrupt::asked())
    throw FileError(fmt::format("a process that drew images ended with {}", code));
}

std::string Shoot::sequence(const std::vector<int>& images, int jobs) {
  std::vector<int> missing;
  for (const int k : images)
    if (!hasImage(k)) missing.push_back(k);
  if (!missing.empty()) {
    presenter();
    const Interrupt interrupt;
    Progress progress("drawing");
    std::size_t done = 0;
    const auto tell = [&] { progress.show(static_cast<double>(++done) / missing.size()); };
    if (jobs > 1)
      drawBy(std::min(jobs, static_cast<int>(missing.size())), missing, progress);
    else
      drawImages(missing, tell);
    if (Interrupt::asked())
      throw Interrupted(fmt::format(
          "{} of {} images are there; run again to go on",
          std::count_if(images.begin(), images.end(), [this](int k) { return hasImage(k); }),
          images.size()));
  }
  tellStrangers(images);
  return folder_ + "/image-*.png";
}

// Images of another scene, another size or beyond the end stand beside those of this run and would
// go into a film with them.
void Shoot::tellStrangers(const std::vector<int>& images) const {
  std::vector<std::string> strangers;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    int k = 0;
    if (std::sscanf(name.c_str(), "image-%6d.png", &k) != 1 || imagePath(k) != folder_ + "/" + name)
      continue;
    if (std::binary_search(images.begin(), images.end(), k)) continue;
    if (k >= count() || !hasImage(k)) strangers.push_back(name);
  }
  if (strangers.empty()) return;
  note(fmt::format(
      "{} of the images in {} are not of this run, the first is {}; remove them or choose another "
      "folder by -o",
      strangers.size(), folder_, *std::min_element(strangers.begin(), strangers.end())));
}

void Shoot::page(const std::string& path) {
  presenter();
  writeFile(path, pageHtml(scene_, recording()));
}

void Shoot::video(const std::string& path, std::pair<int, int> range) {
  Video video(path, scene_.image.width, scene_.image.height, scene_.image.rate);
  ImageFormat format = scene_.image;
  format.transparent = false;
  const int last = std::min(range.second, presenter().count());
  const Interrupt interrupt;
  Progress progress("filming");
  for (int k = range.first; k < last; ++k) {
    if (Interrupt::asked()) throw Interrupted("stopped while filming; nothing is kept of it");
    video.add(studio_.draw(presenter().image(k), format));
    progress.show(static_cast<double>(k - range.first) / (last - range.first));
  }
  video.finish();
}

}  // namespace tumble
