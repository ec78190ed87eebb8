// tumble render: images of one scene.
#include <fmt/core.h>

#include <algorithm>

#include "app/command/command.h"
#include "app/command/letters.h"
#include "app/command/options.h"
#include "app/command/progress.h"
#include "app/command/run.h"
#include "app/command/shoot.h"
#include "app/file/file.h"
#include "app/scene/findings.h"

namespace tumble::command {

namespace {

struct Options {
  SceneOptions scene;
  std::string folder, frames, size, video, shard, camera, html;
  double rate = 0.0;
  int jobs = 1;
  std::optional<double> still;
  bool strobe = false, sheet = false, panels = false, events = false, masks = false;
};

bool readOptions(int argc, char** argv, Options& options) {
  CommandLine line(
      "render", "Draws a scene.",
      {"path-of-brick                  # out/path-of-brick/image-000000.png …",
       "path-of-brick --strobe --sheet # strobe.png and sheet.png instead",
       "my-scene.toml --panels         # its [[panel]], [[graph]] and [[chart]] on one page",
       "path-of-brick --still 1.2 --size 1920x1080",
       "path-of-brick --frames 0:60    # the first 60 images; run again to go on",
       "pile --masks                   # and image-000000.depth.png, image-000000.identity.png",
       "path-of-brick --jobs 4         # by four processes; --shard 0/4 … 3/4 on four machines",
       "path-of-brick --video brick.mp4",
       "pile --html pile.html          # a page that plays it, to turn and to scrub",
       "stacked-boxes --still 0 --set world.gravity=[0,-1.62,0] -o out/moon"});
  addSceneOptions(line, options.scene);
  line.option("-o,--output", options.folder, "folder for the images [out/<scene>]");
  line.option("--frames", options.frames, "images A to B-1 of the sequence", {.type = "A:B"});
  line.option("--shard", options.shard, "every N-th of them from the I-th, for one of N machines",
              {.type = "I/N"});
  line.option("--jobs", options.jobs, "processes that draw the sequence at once [1]",
              {.type = "N", .range = {{1.0, 256.0}}});
  line.option("--size", options.size, "pixels [the scene's own]", {.type = "WxH"});
  line.option("--camera", options.camera, "one of the scene's [[camera]]s [the first]",
              {.type = "NAME"});
  addRate(line, options.rate);
  line.option("--still", options.still, "one image, at this time", {.type = "SECONDS"});
  line.flag("--strobe", options.strobe, "one image of the whole motion");
  line.flag("--sheet", options.sheet, "up to twelve stills on one page");
  line.flag("--panels", options.panels, "the scene's panels, graphs and charts");
  line.flag("--events", options.events, "events.svg: all events on a line of time");
  line.flag("--masks", options.masks, "depth and identity of bodies beside each image, as PNG");
  line.option("--video", options.video, "a film, by ffmpeg", {.type = "FILE"});
  line.option("--html", options.html, "one page that plays the run in a browser", {.type = "FILE"});
  return line.read(argc, argv);
}

CameraView cameraNamed(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const CameraView& camera : scene.cameras) {
    if (camera.name == name) return camera;
    if (!camera.name.empty()) names.push_back(camera.name);
  }
  throw UsageError(fmt::format("--camera {}: {} has no [[camera]] of that name{}", name, scene.file,
                               hint(name, names)));
}

// The range of --frames, or everything.
std::pair<int, int> rangeOf(const Options& options, int count) {
  if (options.frames.empty()) return {0, count};
  const std::pair<int, int> range = parseFrames(options.frames);
  if (range.first >= count)
    throw UsageError(
        fmt::format("--frames {}: the sequence has images 0 to {}", options.frames, count - 1));
  if (range.second > count)
    note(fmt::format("--frames {}: the sequence ends with image {}", options.frames, count - 1));
  return {range.first, std::min(range.second, count)};
}

// Of the images of --frames, those of --shard.
std::vector<int> imagesOf(const Options& options, int count) {
  const auto [first, last] = rangeOf(options, count);
  const auto [one, of] = options.shard.empty() ? std::pair(0, 1) : parseShard(options.shard);
  std::vector<int> images;
  for (int k = first + one; k < last; k += of) images.push_back(k);
  return images;
}

// @throws UsageError for an ending that names no format of films
void requireKnownFilm(const std::string& path) {
  if (path.empty()) return;
  for (const char* ending : {".mp4", ".m4v", ".mov", ".mkv", ".webm", ".avi", ".gif"})
    if (path.ends_with(ending)) return;
  throw UsageError(fmt::format(
      "--video {}: expected a name that ends in .mp4, .m4v, .mov, .mkv, .webm, .avi or .gif",
      path));
}

}  // namespace

int render(int argc, char** argv) {
  Options options;
  if (!readOptions(argc, argv, options)) return kOk;
  Scene scene = load(options.scene);
  if (!options.size.empty())
    std::tie(scene.image.width, scene.image.height) = parseSize(options.size);
  if (options.rate > 0.0) scene.image.rate = options.rate;
  if (!options.camera.empty()) scene.camera = cameraNamed(scene, options.camera);
  if (options.folder.empty()) options.folder = "out/" + scene.name;

  if (options.still && !(*options.still >= 0.0 && *options.still <= scene.world.duration))
    throw UsageError(fmt::format("--still {:g}: the scene lasts from 0 to {:g} s", *options.still,
                                 scene.world.duration));

  const bool others = options.still || options.strobe || options.sheet || options.events ||
                      !options.video.empty() || !options.html.empty();
  if (options.panels && scene.panels.empty() && scene.graphs.empty() && scene.charts.empty()) {
    const std::string none =
        fmt::format("{} has neither [[panel]] nor [[graph]] nor [[chart]]", scene.file);
    if (!others) throw UsageError(none);
    note("no --panels: " + none);
    options.panels = false;
  }
  const bool single = others || options.panels;
  if (single && (options.jobs > 1 || !options.shard.empty()))
    throw UsageError("--jobs and --shard divide a sequence; leave them out or the single pictures");
  const std::vector<int> images = imagesOf(options, sampleCount(scene, scene.image.rate));
  for (const std::string& path : {options.video, options.html})
    if (!path.empty()) prepareFile(path);
  requireKnownFilm(options.video);
  Studio studio;
  // Processes that draw open OpenGL themselves: its threads would not live on in them.
  const bool pageAlone = !options.html.empty() && !options.still && !options.strobe &&
                         !options.sheet && !options.panels && !options.events &&
                         options.video.empty();
  if (options.jobs == 1 && !pageAlone) studio.open();
  if (!pageAlone) noteLackingLetters(scene);
  Shoot shoot(scene, options.folder, studio);
  if (options.masks) shoot.withMasks();
  std::vector<std::string> written;
  if (options.still) written.push_back(shoot.still(*options.still));
  if (options.strobe) written.push_back(shoot.strobe());
  if (options.sheet) written.push_back(shoot.sheet());
  if (options.events) written.push_back(shoot.events());
  if (options.panels)
    for (const std::string& path : shoot.panels()) written.push_back(path);
  if (!options.video.empty()) {
    shoot.video(options.video, {images.front(), images.back() + 1});
    written.push_back(options.video);
  }
  if (!options.html.empty()) {
    shoot.page(options.html);
    written.push_back(options.html);
  }
  if (!single) written.push_back(shoot.sequence(images, options.jobs));
  for (const std::string& path : written) say(path);
  return shoot.recorded() ? exitOf(shoot.recording()) : kOk;
}

}  // namespace tumble::command
