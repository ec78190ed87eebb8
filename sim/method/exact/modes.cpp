// Which contact sticks, slides or idles, and until when.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/contact/carry.h"
#include "sim/method/exact/corners.h"
#include "sim/method/exact/sustained.h"

namespace tumble {
namespace {

/// Part of the acceleration of the bodies by which a mode may be off: contact problems are solved
/// much better, and what is wrong grows too fast for the delay to matter.
constexpr double kMargin = 1e-9;
/// Accelerations below this part of the largest are rounding.
constexpr double kRounding = 2e-10;
/// What friction must leave of a push; see `pushLeft`.
constexpr double kPushLeft = 1e-12;

Vec3 tangential(const Contact& c) {
  return c.force - c.force.dot(c.point.n) * c.point.n;
}

}  // namespace

double Sustained::forceScale(const Contact& c) const {
  double mobility = 0.0;
  for (const int i : {c.a, c.b}) {
    const RigidBody& body = state_.bodies[i];
    const Vec3 turn = (c.point.p - body.x).cross(c.point.n);
    mobility += body.invM + turn.dot(body.Iinv * turn);
  }
  return acceleration_ / mobility;
}

SolveReport Sustained::solveCones(std::vector<RigidBody>& bodies,
                                  std::vector<Contact>& contacts) const {
  system_.outerForces(bodies);
  const SolveReport solved = RestForces(true).apply(bodies, contacts);
  system_.effort.done += Effort::kPolished * countMoving(bodies);
  if (solved.status != SolveStatus::Solved) system_.effort.done += Effort::kUnsolved;
  return solved;
}

void Sustained::chooseModes() {
  acceleration_ = model_.def.gravity.norm();
  for (std::size_t i = 0; i < state_.bodies.size(); ++i)
    acceleration_ = std::max(acceleration_, state_.bodies[i].invM * state_.exact.outer[i].norm());
  if (acceleration_ == 0.0) acceleration_ = 1.0;
  std::vector<Contact>& lasting = state_.lasting;
  for (Contact& c : lasting) {
    const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
    follow(a, b, c);
    // A slip that has grown beyond its onset has a direction of its own, however far from the one
    // in which it was expected.
    const Vec3 slip = slipVelocity(a, b, c.point);
    const bool grown = c.sliding && slip.norm() >= onset_;
    if (grown && hasTurned(c, slip)) c.slipDirection = slip.normalized();
    c.creeping = false;
    c.onset = 0.0;
    if (c.sliding) c.slipDirection = slipDirectionOf(a, b, c);
  }
  if (!state_.exact.modesKnown) {
    const std::vector<Contact> before = lasting;
    tieCrossings(state_, tolerance_.rest, lasting);
    // What touches to rounding is not moved: that would be work.
    for (Contact& c : lasting) c.granted = -c.point.separation;
    std::vector<RigidBody> bodies = state_.bodies;
    solveCones(bodies, lasting);
    for (Contact& c : lasting) {
      c.idle = c.force.norm() <= kRounding * forceScale(c);
      if (c.idle || c.sliding || c.friction <= 0.0) continue;
      const Vec3 rate = slipAcceleration(bodies[c.a], bodies[c.b], c.point);
      if (rate.norm() <= kRounding * acceleration_) continue;
      c.sliding = true;
      c.slipDirection = -tangential(c).normalized();
    }
    unload();
    recordChanges(before, lasting, state_.bodies, state_.t, report_);
    state_.exact.modesKnown = true;
  }
  slip_.clear();
  for (const Contact& c : lasting)
    slip_.push_back(slipVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point).norm());
}

// Where two begin to slip at once, their directions depend on each other: these are left alone.
void Sustained::markOnset() {
  Contact* begins = nullptr;
  for (std::size_t k = 0; k < state_.lasting.size(); ++k) {
    Contact& c = state_.lasting[k];
    if (!c.sliding || c.idle || c.friction <= 0.0 || c.creeping || slip_[k] >= onset_) continue;
    if (begins) return;
    begins = &c;
    const Vec3 rate = slipAcceleration(trial_[c.a], trial_[c.b], c.point);
    if (slip_[k] > tolerance_.stick && !(rate.dot(c.slipDirection) > 0.0)) return;
  }
  if (!begins) return;
  begins->onset = onset_;
  system_.begin(state_.lasting);
  trial_ = state_.bodies;
  system_.findForces(trial_);
}

// Contacts that slide in unlike directions share a load in more than one way, and not all ways move
// the bodies alike. Those that would have to pull idle, one after the other, unless they approach
// then.
void Sustained::unload() {
  const std::vector<Contact> found = state_.lasting;
  for (std::size_t round = 0; round < found.size(); ++round) {
    system_.begin(state_.lasting);
    trial_ = state_.bodies;
    system_.findForces(trial_);
    const std::vector<Contact>& contacts = system_.contacts();
    std::size_t worst = contacts.size();
    double most = -kMargin;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const Contact& c = contacts[k];
      const double push = c.idle ? 0.0 : c.force.dot(c.point.n) / forceScale(c);
      if (push < most && !pairCarries(k)) most = push, worst = k;
    }
    if (worst == contacts.size()) break;
    state_.lasting[worst].idle = true;
  }
  for (const Contact& c : system_.contacts()) {
    if (!c.idle) continue;
    if (normalAcceleration(trial_[c.a], trial_[c.b], c.point) > -kMargin * acceleration_) continue;
    state_.lasting = found;
    return;
  }
}

// Whether the contacts of the pair at k can share their load in another way, each within its law.
bool Sustained::pairCarries(std::size_t k) const {
  const std::vector<Contact>& contacts = system_.contacts();
  std::vector<Contact> own;
  for (const Contact& c : contacts)
    if (c.a == contacts[k].a && c.b == contacts[k].b) own.push_back(c);
  return canCarry(trial_[own[0].a], trial_[own[0].b], own, kMargin * acceleration_);
}

bool Sustained::conesAgree(std::span<const RigidBody> moded) const {
  std::vector<RigidBody> bodies(moded.begin(), moded.end());
  std::vector<Contact> contacts = system_.contacts();
  solveCones(bodies, contacts);
  const double off = kMargin * acceleration_;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const RigidBody &p = moded[i], &q = bodies[i];
    if (p.fixed()) continue;
    const double radius = boundingRadius(model_.shapes[i]);
    if (p.invM * (p.force - q.force).norm() > off) return false;
    if (!p.particle && radius * (p.Iinv * (p.torque - q.torque)).norm() > off) return false;
  }
  return true;
}

// How far the contact at k is from a law of forces, ≥ 0 kept.
double Sustained::forceAllowance(std::size_t k) const {
  const Contact& c = system_.contacts()[k];
  const double scale = forceScale(state_.lasting[k]), push = c.force.dot(c.point.n);
  double left = push;
  if (c.friction > 0.0 && !c.sliding)
    left = std::min(push, c.friction * push - tangential(c).norm());
  return left / scale + kMargin;
}

// How far the contact at k is from the end of its slip, or from jamming.
double Sustained::slipAllowance(std::size_t k) const {
  const std::vector<Contact>& contacts = system_.contacts();
  const Contact& c = contacts[k];
  const RigidBody &a = trial_[c.a], &b = trial_[c.b];
  const double along = slipVelocity(a, b, c.point).dot(c.slipDirection);
  const double least = along + (slip_[k] > tolerance_.stick ? 0.0 : tolerance_.stick);
  const auto ofPair = [&](const Contact& d) { return d.a == c.a && d.b == c.b && !d.idle; };
  if (std::count_if(contacts.begin(), contacts.end(), ofPair) > 1) return least;
  return std::min(least, pushLeft(a, b, c) - kPushLeft);
}

double Sustained::modeAllowance() {
  system_.findForces(trial_);
  const std::vector<Contact>& contacts = system_.contacts();
  double least = std::numeric_limits<double>::infinity(), doubtful = least;
  const Contact* asked = nullptr;
  bool carries = false;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    if (c.idle) continue;
    if (c.friction > 0.0 && c.sliding) least = std::min(least, slipAllowance(k));
    // The smallest forces may break a law that others, with the same motion, keep.
    const double kept = forceAllowance(k);
    if (kept < 0.0 && !(asked && asked->a == c.a && asked->b == c.b))
      asked = &c, carries = pairCarries(k);
    doubtful = std::min(doubtful, kept < 0.0 && carries ? kMargin : kept);
  }
  if (doubtful < 0.0 && conesAgree(trial_)) doubtful = kMargin;
  return std::min(least, doubtful);
}

}  // namespace tumble
