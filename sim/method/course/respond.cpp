// The events of one instant: impulses on colliding contacts, and the list of those that last.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/contact/jam.h"
#include "sim/joint/joint_bonds.h"
#include "sim/math/rotation.h"
#include "sim/method/course/course.h"
#include "sim/method/crush.h"
#include "sim/method/impacts.h"

namespace tumble {
namespace {

// A bounce that would rise less than kHeight and be over within kTime is the last of its row: the
// contact comes to rest instead of hopping for ever.
constexpr double kHeight = 1e-10;  // [m]
constexpr double kTime = 1e-6;     // [s]
// Pairs that hit each other so often in one step come to rest at the next hit that is slower than
// what a step of free fall gives.
constexpr int kHitsInStep = 40;

// Approach of so many times the resting speed calls for an impulse.
constexpr double kNoise = 10.0;

// Slip below this many times what friction changes in a step has its direction chosen implicitly.
constexpr double kCreep = 4.0;
// Ends of slips that are located within one step.
constexpr int kSticksInStep = 20;

}  // namespace

bool Course::collides() const {
  if (limitApproach(state_.bodies, model_.joints, tolerance_.touch) < -kNoise * tolerance_.rest)
    return true;
  return std::any_of(touching_.begin(), touching_.end(), [&](const Contact& c) {
    return approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point) <
           -kNoise * tolerance_.rest;
  });
}

bool Course::leans(const Contact& c) const {
  const double vrel = approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point);
  return wasLasting(c.a, c.b) && std::abs(vrel) <= tolerance_.keep;
}

double Course::restitutionNow(const Contact& c) const {
  const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
  const double rebound = -c.restitution * approachVelocity(a, b, c.point);
  if (rebound <= c.restitution * tolerance_.rest) return c.restitution;  // it does not approach
  if (wasLasting(c.a, c.b) && rebound < tolerance_.keep) return hits_ ? c.restitution : 0.0;
  const double press = -normalAcceleration(a, b, c.point);
  if (press > 0.0 && rebound * rebound < 2.0 * press * kHeight &&
      2.0 * rebound < press * (1.0 - c.restitution) * kTime)
    return 0.0;
  const auto recent = state_.course.recentImpacts.find({c.a, c.b});
  const int hits = recent == state_.course.recentImpacts.end() ? 0 : recent->second;
  const double crawl = accelerationScale() * model_.def.course.step;
  if (hits > kHitsInStep && rebound < crawl) return 0.0;
  return c.restitution;
}

void Course::stopIf(const std::string& words) {
  if (words.empty()) return;
  report_.stopped = true;
  report_.reason = words;
}

void Course::respond() {
  stopIf(findCrushed(model_, state_.t, state_.bodies, touching_));
  if (report_.stopped) return;
  hits_ = std::any_of(touching_.begin(), touching_.end(), [&](const Contact& c) {
    return approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point) < -tolerance_.rest &&
           !leans(c);
  });
  std::vector<double> restitution, vrel;
  for (Contact& c : touching_) {
    c.lasting = leans(c);
    restitution.push_back(restitutionNow(c));
    vrel.push_back(approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point));
  }
  std::vector<Vec3> impulse(touching_.size(), Vec3::Zero());
  Bonds bonds;
  impactBonds(state_.bodies, model_.joints, tolerance_.touch, bonds);
  const ImpactReport impact = findImpactLaw(model_.def.impact)
                                  ->apply({.bodies = state_.bodies,
                                           .contacts = touching_,
                                           .restitution = restitution,
                                           .impulse = impulse,
                                           .tolerance = tolerance_,
                                           .bonds = &bonds});
  bookImpact(impact, report_);
  recordImpacts(touching_, vrel, impulse);
  recordBonds(bonds);
  stopIf(findLocked(model_, state_.t, state_.bodies, touching_, impact.residual));
}

void Course::recordBonds(const Bonds& bonds) {
  if (!bonds.empty()) state_.externalImpulse += outerBonds(bonds, state_.bodies).force;
}

void Course::recordImpacts(std::span<const Contact> contacts, std::span<const double> vrel,
                           std::span<const Vec3> impulse) {
  std::pair<int, int> hit{-1, -1};
  for (const Event& event : impactEvents(model_, state_, state_.t, contacts, vrel, impulse)) {
    if (wasLasting(event.a, event.b) && leansOn(event, state_.bodies, tolerance_.keep)) continue;
    report_.events.push_back(event);
    const std::pair<int, int> pair(event.a, event.b);
    if (pair != hit) ++state_.course.recentImpacts[pair];
    hit = pair;
  }
}

bool Course::isJoined(int body) const {
  return std::any_of(model_.joints.begin(), model_.joints.end(),
                     [&](const Joint& joint) { return joint.a == body || joint.b == body; });
}

void Course::settleCreep(std::span<Contact> lasting) {
  if (std::none_of(lasting.begin(), lasting.end(), [](const Contact& c) { return c.creeping; }))
    return;
  const double h = model_.def.course.step;
  std::vector<RigidBody> ends = state_.bodies;
  for (RigidBody& body : ends) {
    body.x += h * body.v;
    if (!body.particle) body.q = rotated(body.q, h * body.omega);
    updateDerived(body);
  }
  Bonds bonds;
  restBonds(ends, model_.joints, state_.limits, pullTime(model_), bonds);
  rest_.settleCreep(state_.bodies, ends, lasting, h, &bonds);
}

bool Course::pairIsStill(const Contact& contact, double stick) const {
  return std::all_of(touching_.begin(), touching_.end(), [&](const Contact& c) {
    return c.a != contact.a || c.b != contact.b ||
           slipVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point).norm() <= stick;
  });
}

void Course::chooseLasting() {
  const double scale = accelerationScale();
  std::vector<Contact> lasting;
  for (Contact c : touching_) {
    const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
    const double band = wasLasting(c.a, c.b) ? tolerance_.keep : tolerance_.rest;
    if (classify(approachVelocity(a, b, c.point), band) != ContactClass::Resting) continue;
    c.lasting = true;
    if (c.point.separation < -tolerance_.touch) c.granted = -c.point.separation;
    c.anchor = anchorOf(a, b, c.point);
    setPull(a, b, pullTime(model_), c);
    const Vec3 slip = slipVelocity(a, b, c.point);
    // What an integrator leaves of the slip of a contact that stuck is pulled back, and a slip that
    // fades with that pull goes on to do so.
    const std::optional<double> stuck = slipWhereStuck(c);
    const double stick = stuck ? tolerance_.keep : tolerance_.stick;
    c.sliding = c.friction > 0.0 && slip.norm() > std::max(stick, stuck.value_or(0.0));
    if (c.sliding) c.slipDirection = slip.normalized();
    c.creeping = c.sliding && slip.norm() < kCreep * c.friction * scale * model_.def.course.step;
    // After many ends of slips in one step a creeping contact is taken as sticking: its slip then
    // fades with the pull of a lasting contact, inside Coulomb's cone.
    if (c.creeping && state_.course.recentBackUps >= kSticksInStep) c.sliding = c.creeping = false;
    c.mayStick = c.sliding;
    // A wedge that friction locks in its joint cannot be drawn out, however slowly.
    if (!c.sliding && c.friction > 0.0 && slip.norm() <= stick && pairIsStill(c, stick) &&
        (isJoined(c.a) || isJoined(c.b))) {
      c.pull = 0.0;
      c.slipPull.setZero();
    }
    lasting.push_back(c);
  }
  state_.limits = restingLimits(state_.bodies, model_.joints, tolerance_.touch, tolerance_.rest,
                                tolerance_.keep, state_.limits);
  settleCreep(lasting);
  std::swap(state_.lasting, lasting);
  recordChanges(lasting, state_.lasting, state_.bodies, state_.t, report_);
}

bool Course::endJam() {
  if (!contact_.impulses || jams_ >= kJams) return false;
  std::vector<RigidBody> bodies = state_.bodies;
  sumForces(model_.def.gravity, model_.def.forces, bodies);
  Bonds bonds;
  restBonds(bodies, model_.joints, state_.limits, std::numeric_limits<double>::infinity(), bonds);
  std::vector<RigidBody> held = bodies;
  std::vector<Contact> lasting = state_.lasting;
  if (!jams(bodies, lasting) && RestForces(true).apply(held, lasting, &bonds).residual < kNoForces)
    return false;

  std::vector<double> rest(lasting.size(), 0.0);
  std::vector<Vec3> impulse(lasting.size(), Vec3::Zero());
  ImpulseEnergy energy;
  const Impact impact{bodies, lasting, rest, impulse, tolerance_, &bonds};
  if (!tumble::endJam(impact, state_.kineticMax, energy)) return false;
  ++jams_;
  state_.bodies = bodies;
  report_.certificate.energy_lost_friction += energy.lost;
  report_.certificate.work_of_forces += energy.work;
  recordImpacts(lasting, rest, impulse);
  recordBonds(bonds);
  report_.note(kJamNote);
  return true;
}

}  // namespace tumble
