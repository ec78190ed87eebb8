// Impacts with restitution: a step is divided where they happen, and the scene's law of impact is
// applied there. What a step has no part left for is struck at the start of its last part.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/body/force.h"
#include "sim/joint/joint_bonds.h"
#include "sim/method/impacts.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

double Stepping::meet(double h, bool mayDivide) {
  constexpr double kSoon = 1e-4;  // of a step
  const double soon = kSoon * model_.def.stepping.step;
  // Where a step has no parts left, hits come to rest that are slower than what a step of free fall
  // gives.
  const double least = mayDivide ? tolerance_.keep : std::max(tolerance_.keep, -landingSpeed());
  sumForces(model_.def.gravity, model_.def.forces, state_.bodies);
  findTouching(h);
  double first = untilHit(soon, h, least);
  if (strike(mayDivide ? soon : h)) {
    sumForces(model_.def.gravity, model_.def.forces, state_.bodies);
    findTouching(h);
    first = untilHit(soon, h, least);
  }
  if (!mayDivide) first = h;
  holdStopped(first, !mayDivide);
  return first;
}

void Stepping::holdStopped(double h, bool all) {
  for (const PairMemory& pair : memory_.pairs) {
    if (!pair.bounces) continue;
    for (const Touch& touch : pair.touches)
      if (all || (!closed(touch) && touch.due < h)) hold(touch.contact);
  }
}

void Stepping::hold(const Contact& c) {
  for (const int i : {c.a, c.b})
    if (!model_.fixed(i)) work_.held[i] = 1;
}

double Stepping::untilHit(double soon, double h, double least) {
  double first = h;
  const auto bounces = [](const PairMemory& pair) { return pair.bounces; };
  if (std::none_of(memory_.pairs.begin(), memory_.pairs.end(), bounces)) return first;
  findHeld();
  for (PairMemory& pair : memory_.pairs) {
    if (!pair.bounces) continue;
    for (Touch& touch : pair.touches) {
      foresee(touch, least);
      if (touch.rebounds && touch.due > soon) first = std::min(first, touch.due);
      if (flies(touch, 0.0)) touch.impulse.setZero();
    }
  }
  return first;
}

void Stepping::findHeld() {
  work_.held.assign(state_.bodies.size() + 1, 0);
  for (const PairMemory& pair : memory_.pairs) {
    for (const Touch& touch : pair.touches) {
      const Contact& c = touch.contact;
      if (closed(touch) &&
          approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point) <= tolerance_.keep)
        hold(c);
    }
  }
  for (const Joint& joint : model_.joints)
    for (const int i : {joint.a, joint.b})
      if (i < model_.count() && !model_.fixed(i)) work_.held[i] = 1;
}

RigidBody Stepping::underWay(int i) const {
  RigidBody body = state_.bodies[i];
  if (state_.trail.empty() || !work_.held[i]) return body;
  const Segment& last = state_.trail.back();
  const RigidBody &start = last.start[i], &end = last.end[i];
  const bool struck = end.P != body.P || end.L != body.L;
  if (struck) return body;
  body.force = (end.P - start.P) / (last.t1 - last.t0);
  body.torque = (end.L - start.L) / (last.t1 - last.t0);
  return body;
}

/// The gap goes by  s + ṡ t + s̈ t²/2  between free bodies, by  s + ṡ t + s̈ t²  where a step moves
/// one with the velocity at its end. Hits that would rebound at no more than the speed of a contact
/// that lasts are left to the contact problem.
void Stepping::foresee(Touch& touch, double least) const {
  const Contact& c = touch.contact;
  const double gap = closed(touch) ? 0.0 : c.point.separation;
  const double rate = approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point);
  double bend = 0.0;
  if (gap > 0.0 || rate > 0.0) {
    bend = normalAcceleration(underWay(c.a), underWay(c.b), c.point);
    if (work_.held[c.a] || work_.held[c.b]) bend *= 2.0;
  }
  const double square = rate * rate - 2.0 * bend * gap;
  const bool meets = square >= 0.0 && (rate < 0.0 || bend < 0.0);
  const double speed = meets ? std::sqrt(square) : 0.0;
  touch.rebounds = c.restitution * speed > least;
  touch.due = 0.0;
  if (touch.rebounds) touch.due = rate < 0.0 ? 2.0 * gap / (speed - rate) : (speed + rate) / -bend;
  if (!meets && !closed(touch)) touch.due = std::numeric_limits<double>::infinity();
}

bool Stepping::anyHit(double within) const {
  const auto hits = [&](const Touch& touch) {
    const Contact& c = touch.contact;
    return touch.rebounds && touch.due <= within &&
           approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point) < 0.0;
  };
  return std::any_of(memory_.pairs.begin(), memory_.pairs.end(), [&](const PairMemory& pair) {
    return pair.bounces && std::any_of(pair.touches.begin(), pair.touches.end(), hits);
  });
}

bool Stepping::strike(double within) {
  if (!anyHit(within)) return false;
  std::vector<Contact> contacts;
  std::vector<double> restitution, vrel;
  for (const PairMemory& pair : memory_.pairs) {
    for (const Touch& touch : pair.touches) {
      const Contact& c = touch.contact;
      if (!closed(touch) && !(touch.rebounds && touch.due <= within)) continue;
      contacts.push_back(c);
      vrel.push_back(approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point));
      const bool leans = vrel.back() < 0.0 && -c.restitution * vrel.back() <= tolerance_.keep;
      restitution.push_back(leans ? 0.0 : c.restitution);
    }
  }
  std::vector<Vec3> impulse(contacts.size(), Vec3::Zero());
  Bonds bonds;
  impactBonds(state_.bodies, model_.joints, tolerance_.touch, bonds);
  bookImpact(findImpactLaw(model_.def.impact)
                 ->apply({.bodies = state_.bodies,
                          .contacts = contacts,
                          .restitution = restitution,
                          .impulse = impulse,
                          .tolerance = tolerance_,
                          .bonds = &bonds}),
             report_);
  if (!bonds.empty()) state_.externalImpulse += outerBonds(bonds, state_.bodies).force;
  for (const Event& event : impactEvents(model_, state_, state_.t, contacts, vrel, impulse))
    if (!leansOn(event, state_.bodies, tolerance_.keep)) report_.events.push_back(event);
  return true;
}

}  // namespace tumble
