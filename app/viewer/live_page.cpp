// The viewer while its scene lives: what goes on from the sample at hand, and what changes it.
#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "app/viewer/viewer.h"
#include "sim/math/frames.h"
#include "sim/problem/problem.h"

namespace tumble {

namespace {

/// Samples that one page adds at most: a scene that cannot keep up runs slower than the clock.
constexpr double kMostAtOnce = 2.0;
/// States of bodies that are kept; beyond, the older half is forgotten: 600 MB.
constexpr std::size_t kMostHeld = 4'000'000;

// A list to choose one name from.
template <class Rows>
bool chooseName(const char* label, const Rows& rows, std::string& chosen) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, chosen.c_str())) return false;
  for (const auto& row : rows) {
    const std::string name(row.name);
    if (!ImGui::Selectable(name.c_str(), name == chosen)) continue;
    changed = name != chosen;
    chosen = name;
  }
  ImGui::EndCombo();
  return changed;
}

bool choosePreset(SteppingSettings& stepping) {
  std::string name = "its own";
  for (const SolverPreset& preset : solverPresets()) {
    SteppingSettings taken = stepping;
    taken.take(preset);
    if (taken == stepping) name = preset.name;
  }
  if (!chooseName("preset", solverPresets(), name)) return false;
  stepping.take(*findSolverPreset(name));
  return true;
}

bool chooseStep(WorldDef& def) {
  bool changed = false;
  double& step = def.method == "course" ? def.course.step : def.stepping.step;
  if (!ImGui::BeginCombo("step / s", fmt::format("1/{:.4g}", 1.0 / step).c_str())) return false;
  for (const int rate : {30, 60, 120, 240, 480, 960, 1920}) {
    if (!ImGui::Selectable(fmt::format("1/{}", rate).c_str(), false)) continue;
    step = 1.0 / rate;
    changed = true;
  }
  ImGui::EndCombo();
  return changed;
}

bool chooseGravity(Vec3& gravity) {
  std::array<float, 3> g{};
  for (int k = 0; k < 3; ++k) g[k] = static_cast<float>(gravity[k]);
  if (!ImGui::DragFloat3("g / m/s²", g.data(), 0.05f, -50.0f, 50.0f, "%.2f")) return false;
  for (int k = 0; k < 3; ++k) gravity[k] = static_cast<double>(g[k]);
  return true;
}

// One value for all bodies, from the first of those that move.
bool chooseSurface(const char* label, double BodyDef::*value, float most, WorldDef& def) {
  const auto first = std::find_if(def.bodies.begin(), def.bodies.end(),
                                  [](const BodyDef& body) { return !body.fixed; });
  if (first == def.bodies.end()) return false;
  float now = static_cast<float>((*first).*value);
  if (!ImGui::SliderFloat(label, &now, 0.0f, most, "%.2f")) return false;
  for (BodyDef& body : def.bodies) body.*value = static_cast<double>(now);
  def.pairs.clear();
  return true;
}

Vec3 sightThrough(const Projection& projection, float x, float y, float width, float height) {
  const double pixel = projection.pixelAtUnitDepth();
  return projection.forward() + pixel * (x - 0.5 * width) * projection.right() +
         pixel * (0.5 * height - y) * projection.up();
}

}  // namespace

void Viewer::setLive(bool live) {
  if (!presenter_ || live == live_.has_value()) return;
  if (!live) {
    Scene whole = std::move(*whole_);
    whole.show = scene_->show;
    return begin(std::move(whole));
  }
  if (!recorder_) whole_ = scene_;
  recorder_.reset();
  scene_->checks.clear();
  scene_->expects.clear();
  recording_->report = {};
  live_.emplace(*scene_, recording_->rate);
  playback_.growing = true;
  if (playback_.playing()) playback_.toggle();
  play();
}

void Viewer::play() {
  if (live_ && !playback_.playing()) branch();
  playback_.toggle();
}

// What came after the sample that is shown has not happened.
void Viewer::branch() {
  owed_ = 0.0;
  complaint_.clear();
  const auto kept = static_cast<std::size_t>(playback_.sample()) + 1;
  if (kept == recording_->samples.size()) return;
  live_->leave();
  recording_->samples.resize(kept);
  playback_.extend(static_cast<int>(kept) - 1);
  present();
}

void Viewer::present() {
  presenter_.emplace(*scene_, *recording_);
  presented_ = recording_->samples.size();
  ++revision_;
}

bool Viewer::grow() {
  std::vector<Sample>& samples = recording_->samples;
  std::optional<Sample> sample = live_->next(samples.back());
  if (!sample) {
    complaint_ = live_->complaint();
    if (playback_.playing()) playback_.toggle();
    return false;
  }
  samples.push_back(std::move(*sample));
  if (samples.size() * samples.back().bodies.size() > kMostHeld) {
    const std::size_t half = samples.size() / 2;
    samples.erase(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(half));
    playback_.forget(static_cast<int>(half));
    present();
  }
  playback_.extend(static_cast<int>(samples.size()) - 1);
  if (static_cast<double>(samples.size()) >= kGrown * static_cast<double>(presented_)) present();
  return true;
}

void Viewer::advance(double seconds) {
  if (live_ && playback_.playing()) {
    const double rate = recording_->rate;
    owed_ = std::min(owed_ + playback_.speed * seconds, kMostAtOnce / rate);
    // The margin keeps a page of 1/rate at one sample in spite of rounding.
    for (; owed_ * rate >= 1.0 - 1e-6; owed_ -= 1.0 / rate)
      if (!grow()) break;
  }
  playback_.advance(seconds);
}

void Viewer::step(int samples) {
  if (live_ && samples > 0 && playback_.sample() == playback_.last()) grow();
  playback_.step(samples);
}

void Viewer::liveList() {
  ImGui::Spacing();
  ImGui::TextDisabled("live");
  ImGui::PushItemWidth(0.62f * ImGui::GetContentRegionAvail().x);
  WorldDef def = live_->settings();
  bool changed = chooseName("method", methodNames(), def.method);
  changed |= choosePreset(def.stepping);
  if (chooseName("solver", solvers(), def.stepping.solver)) {
    def.stepping.treatCrowdsAlike();
    changed = true;
  }
  changed |= chooseStep(def);
  changed |= chooseGravity(def.gravity);
  changed |= chooseSurface("restitution", &BodyDef::restitution, 1.0f, def);
  changed |= chooseSurface("friction", &BodyDef::friction, 2.0f, def);
  ImGui::PopItemWidth();
  if (!changed) return;
  complaint_.clear();
  live_->change(std::move(def));
}

// A hand takes the picked body where the sight line is as deep as its centre.
void Viewer::grip(float x, float y, float width, float height) {
  if (!live_ || !playback_.playing()) return;
  pick(x, y, width, height);
  if (!picked_ || scene_->world.bodies[*picked_].fixed) return;
  const Projection projection(camera(), width, height);
  const BodySample& body = recording_->samples[playback_.sample()].bodies[*picked_];
  const double depth = projection.forward().dot(body.x - projection.eye());
  const Vec3 p = projection.eye() + depth * sightThrough(projection, x, y, width, height);
  live_->hold(Hand{*picked_, toBody({body.x, body.q}, p), p});
}

// The hand moves across the picture, as deep as it was.
void Viewer::lead(float x, float y, float width, float height) {
  const Projection projection(camera(), width, height);
  Hand hand = *live_->hand();
  const double depth = projection.forward().dot(hand.target - projection.eye());
  hand.target = projection.eye() + depth * sightThrough(projection, x, y, width, height);
  live_->hold(hand);
}

void Viewer::handLine(float width, float height) {
  if (!live_ || !live_->hand()) return;
  const Hand& hand = *live_->hand();
  const BodySample& body = recording_->samples[playback_.sample()].bodies[hand.body];
  const Projection projection(camera(), width, height);
  const auto from = projection.project(toWorld({body.x, body.q}, hand.point_B));
  const auto to = projection.project(hand.target);
  if (!from || !to) return;
  const ImVec2 corner = ImGui::GetWindowPos();
  const auto place = [&](const Eigen::Vector3d& p) {
    return ImVec2(corner.x + static_cast<float>(p.x()), corner.y + static_cast<float>(p.y()));
  };
  constexpr ImU32 kHand = IM_COL32(0xd5, 0x40, 0x1a, 0xff);
  ImGui::GetWindowDrawList()->AddLine(place(*from), place(*to), kHand, 2.0f);
  ImGui::GetWindowDrawList()->AddCircleFilled(place(*to), 4.0f, kHand);
}

}  // namespace tumble
