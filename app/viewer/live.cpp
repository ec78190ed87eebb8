#include "app/viewer/live.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace tumble {

namespace {

constexpr double kNoEnd = 1e5;    // [s]
constexpr double kHertz = 3.0;    // of what a hand holds, alone
constexpr double kDamped = 0.7;   // of critical damping
constexpr double kFastest = 3.0;  // [m/s] of a point that a hand leads

// Which bodies joints hold together: the number of a group per body.
std::vector<int> groupsOf(const WorldDef& def) {
  std::vector<int> group(def.bodies.size());
  std::iota(group.begin(), group.end(), 0);
  const auto find = [&](int i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  const auto join = [&](int a, int b) {
    if (a == kNoBody || b == kNoBody || def.bodies[a].fixed || def.bodies[b].fixed) return;
    group[find(a)] = find(b);
  };
  for (const JointDef& joint : def.joints) join(joint.a, joint.b);
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = find(static_cast<int>(i));
  return group;
}

std::vector<double> heldTogether(const WorldDef& def) {
  const std::vector<int> group = groupsOf(def);
  std::vector<double> sum(group.size(), 0.0), mass(group.size(), 0.0);
  for (std::size_t i = 0; i < group.size(); ++i)
    if (!def.bodies[i].fixed) sum[group[i]] += bodyMass(def.bodies[i]);
  for (std::size_t i = 0; i < group.size(); ++i) mass[i] = sum[group[i]];
  return mass;
}

std::vector<bool> bending(const WorldDef& def) {
  std::vector<bool> bends(def.bodies.size(), false);
  for (const Force& force : def.forces)
    if (const auto* one = std::get_if<Bending>(&force))
      for (const int i : one->body->bodies) bends[i] = true;
  return bends;
}

}  // namespace

Live::Live(const Scene& scene, double rate)
    : settings_(scene.world),
      pulled_(heldTogether(scene.world)),
      bends_(bending(scene.world)),
      rate_(rate) {
  settings_.duration = kNoEnd;
}

void Live::change(WorldDef settings) {
  settings_ = std::move(settings);
  leave();
}

void Live::hold(const std::optional<Hand>& hand) {
  const bool same = hand ? hand_ && hand->body == hand_->body && hand->point_B == hand_->point_B &&
                               hand->target == hand_->target
                         : !hand_;
  if (!same) leave();
  hand_ = hand;
}

bool Live::leads() const {
  return hand_ && bends_[hand_->body];
}

WorldDef Live::inHand(const Sample& last) const {
  WorldDef def = settings_;
  if (!hand_) return def;
  if (leads()) {
    BodyDef& point = def.bodies[hand_->body];
    point.fixed = true;
    point.velocity = rate_ * (hand_->target - last.bodies[hand_->body].x);
    if (point.velocity.norm() > kFastest) point.velocity *= kFastest / point.velocity.norm();
    return def;
  }
  if (def.method != "course") def.method = "stepping";  // exact takes no springs
  const double mass = pulled_[hand_->body], omega = 2.0 * std::numbers::pi * kHertz;
  def.forces.push_back(Spring{.a = hand_->body,
                              .b = kNoBody,
                              .anchorA_B = hand_->point_B,
                              .anchorB_B = hand_->target,
                              .stiffness = mass * omega * omega,
                              .damping = 2.0 * kDamped * mass * omega});
  return def;
}

std::optional<Sample> Live::next(const Sample& last) {
  complaint_.clear();
  try {
    if (leads()) leave();  // it has another way to go after each sample
    if (!world_) {
      world_.emplace(inHand(last), last);
      start_ = last.t;
      made_ = 0;
    }
    const double t = ++made_ / rate_;
    world_->advance(t);
    if (!world_->report().stopped) {
      Sample sample = world_->sample(t);
      sample.t += start_;
      return sample;
    }
    complaint_ = world_->report().reason;
  } catch (const Refusal& refusal) {
    complaint_ = refusal.what();
  }
  leave();
  return std::nullopt;
}

}  // namespace tumble
