#include "app/viewer/viewer.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <limits>

#include "app/claim/verdict.h"
#include "app/file/file.h"
#include "app/present/bodies.h"
#include "app/scene/demos.h"
#include "app/scene/toml.h"

namespace tumble {

namespace {

/// The first sample of most scenes is there within this time [s].
constexpr double kPatience = 0.3;

std::filesystem::file_time_type timeOf(const std::string& file) {
  std::error_code missing;
  return std::filesystem::last_write_time(file, missing);
}

// What stands at a key of the root, if it is a text.
std::string textAt(const Node& root, const char* key, const std::string& otherwise) {
  const Table* table = root.as<Table>();
  const Entry* entry = table ? table->find(key) : nullptr;
  const std::string* text = entry ? entry->node.as<std::string>() : nullptr;
  return text && !text->empty() ? *text : otherwise;
}

}  // namespace

// Only the text is read: meshes and variants of all demos would keep the window waiting.
std::vector<DemoEntry> demoEntries() {
  std::vector<DemoEntry> entries;
  for (const std::string& name : demoNames()) {
    DemoEntry entry{name, name, "", scenePath(name)};
    try {
      const Node root = parseToml(readFile(entry.path));
      entry.title = textAt(root, "title", name);
      entry.chapter = textAt(root, "chapter", "");
    } catch (const std::runtime_error&) {
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
  recorder_.reset();
  live_.reset();
  presenter_.reset();
  whole_.reset();
  scene_ = std::move(scene);
  recording_ = std::move(recording);
  presenter_.emplace(*scene_, *recording_);
  complaint_ = recording_->report.stopped ? recording_->report.reason : "";
  playback_ = Playback(presenter_->count() - 1, recording_->rate);
  show();
  home_ = orbit_ = Orbit::of(presenter_->image(0).camera);
}

// What a new recording begins with.
void Viewer::show() {
  drawn_ = {};
  presented_ = recording_->samples.size();
  picked_.reset();
  following_ = false;
  saved_ = timeOf(scene_->file);
}

// A run that is not complete can keep no promise: its claims wait.
void Viewer::begin(Scene scene) {
  makeWorld(scene);  // refused before what is shown goes
  recorder_.reset();
  live_.reset();
  presenter_.reset();
  whole_ = scene;
  scene_ = std::move(scene);
  scene_->checks.clear();
  scene_->expects.clear();
  recording_.emplace();
  recording_->rate = scene_->image.rate;
  complaint_.clear();
  playback_ = Playback(0, recording_->rate);
  playback_.growing = true;
  playback_.toggle();
  show();
  recorder_ = std::make_unique<Recorder>(*scene_);
  recorder_->waitFor(kPatience);
  pull();
}

void Viewer::load(const std::string& path) {
  const bool same = scene_ && scene_->file == path;
  const Orbit view = orbit_;
  try {
    Scene scene = readScene(path, same ? scene_->overrides : std::vector<std::string>());
    requireKnownChecks(scene);
    begin(std::move(scene));
    if (same)
      orbit_ = view;
    else
      kept_.clear();
  } catch (const SceneError& error) {
    complaint_ = error.what();
    if (same) saved_ = timeOf(path);
  } catch (const FileError& error) {
    complaint_ = error.what();
  }
}

void Viewer::pull() {
  if (!recorder_) return;
  const bool running = recorder_->running();
  const bool news = recorder_->take(*recording_);
  if (!running) {
    complaint_ = !recorder_->complaint().empty() ? recorder_->complaint()
                 : recording_->report.stopped    ? recording_->report.reason
                                                 : "";
    recorder_.reset();
    playback_.growing = false;
    const ShowFlags flags = scene_->show;
    scene_ = std::move(whole_);
    scene_->show = flags;
    whole_.reset();
  }
  if (recording_->samples.empty() || (!news && recorder_)) return;
  playback_.extend(static_cast<int>(recording_->samples.size()) - 1);
  const std::size_t count = recording_->samples.size();
  if (presenter_ && recorder_ && static_cast<double>(count) < kGrown * presented_) return;

  // Framed anew, and looked at from there unless the user has turned it.
  const bool untouched = !presenter_ || orbit_ == home_;
  present();
  home_ = Orbit::of(presenter_->image(0).camera);
  if (untouched) orbit_ = home_;
}

void Viewer::reloadIfSaved() {
  const double now = ImGui::GetTime();
  if (!scene_ || now < looked_ + 0.5) return;
  looked_ = now;
  const std::string file = scene_->file;
  if (std::filesystem::exists(file) && timeOf(file) != saved_) load(file);
}

// The eye stays above the floor.
Camera Viewer::camera() const {
  Camera camera = orbit_.camera();
  for (const BodyDef& body : scene_->world.bodies)
    if (isFloor(body))
      camera.eye.y() =
          std::max(camera.eye.y(), std::get<HalfSpace>(body.shape).d + 0.02 * orbit_.distance);
  return camera;
}

void Viewer::draw(int width, int height) {
  // What stands on the page stands on this one.
  if (scene_->image.width != width || scene_->image.height != height) {
    scene_->image.width = width;
    scene_->image.height = height;
    presenter_.emplace(*scene_, *recording_);
  }
  if (following_ && picked_)
    orbit_.target = recording_->samples[playback_.sample()].bodies[*picked_].x;
  const Camera from = camera();
  const Drawn wanted{playback_.sample(), width, height, revision_, from.eye, from.target};
  if (wanted == drawn_) return;
  Picture picture = presenter_->image(wanted.sample);
  picture.camera = from;
  texture_.load(renderer_.draw(picture, {.width = width, .height = height}));
  drawn_ = wanted;
}

// The body whose ball is hit first by the sight line through a place of the picture [px].
void Viewer::pick(float x, float y, float width, float height) {
  const Projection projection(camera(), width, height);
  const std::vector<BodySample>& bodies = recording_->samples[playback_.sample()].bodies;
  picked_.reset();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyDef& body = scene_->world.bodies[i];
    if (std::holds_alternative<HalfSpace>(body.shape)) continue;
    const auto place = projection.project(bodies[i].x);
    if (!place || place->z() >= nearest) continue;
    const double radius =
        std::max(4.0, boundingRadius(body.shape) / (projection.pixelAtUnitDepth() * place->z()));
    if ((place->head<2>() - Eigen::Vector2d(x, y)).norm() > radius) continue;
    nearest = place->z();
    picked_ = static_cast<int>(i);
  }
}

std::string Viewer::command() const {
  std::string words = "tumble render " + scene_->file;
  for (const std::string& change : scene_->overrides) words += " --set '" + change + "'";
  // A view that the user has turned to takes the place of the scene's camera.
  if (!(orbit_ == home_)) {
    const Camera seen = camera();
    const auto list = [](const Eigen::Vector3d& p) {
      return fmt::format("[{:.5g}, {:.5g}, {:.5g}]", p.x(), p.y(), p.z());
    };
    words += fmt::format(" --set 'camera={{eye={}, target={}, fov={:g}}}'", list(seen.eye),
                         list(seen.target), seen.fov);
  }
  return words + fmt::format(" --still {:.6g}", playback_.time());
}

void Viewer::keepView() {
  constexpr std::size_t kMost = 9;
  if (kept_.size() == kMost) kept_.erase(kept_.begin());
  kept_.push_back(orbit_);
  told_ = fmt::format("{0} goes back to this view", kept_.size());
}

void Viewer::screenshot() {
  const std::string file = fmt::format("{}-{:06}.png", scene_->name, playback_.sample());
  Picture picture = presenter_->image(playback_.sample());
  picture.camera = camera();
  try {
    writePng(file, renderer_.draw(picture, {}));
    told_ = "wrote " + file;
  } catch (const std::exception& error) {
    told_ = error.what();
  }
}

}  // namespace tumble
