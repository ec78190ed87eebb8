// Impacts: a step is divided where they happen, and the scene's law of impact is applied there, to
// what rebounds and to what lands faster than resting bodies do. What a step has no part left for
// is struck at the start of its last part.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/body/force.h"
#include "sim/contact/impulse.h"
#include "sim/joint/joint_bonds.h"
#include "sim/method/crush.h"
#include "sim/method/impacts.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

constexpr double kSoon = 1e-6,
                 kNext = 1e-10;  ///< of a step: what is struck at once, and after that

constexpr const char* kPassedOn =
    "blows that went on to others within a step did not rebound from all; their energy counts as "
    "lost in impacts";

void forgetHits(PairMemory& pair) {
  for (Touch& touch : pair.touches) {
    touch.rebounds = false;
    touch.due = 0.0;
  }
}

}  // namespace

void Stepping::findOut(double h) {
  if (known_) return;
  if (!parted_) sumForces(model_.def.gravity, memory_.drives->outer, state_.bodies);
  findTouching(h);
  known_ = true;
}

double Stepping::meet(double h, Hits divide) {
  const double step = model_.def.stepping.step, soon = kSoon * step;
  // Of hits for which no step is divided those come to rest that are slower than what a step of
  // free fall gives.
  const double least =
      divide == Hits::All ? tolerance_.keep : std::max(tolerance_.keep, -landingSpeed());
  const bool divides = divide != Hits::None;
  findOut(h);
  known_ = false;
  if (halted()) return h;
  if (reboundsInStep()) {
    for (PairMemory& pair : memory_.pairs) forgetHits(pair);
    return h;
  }
  // Where a step is not divided, a blow goes on from body to body in no time.
  double first = untilHit(soon, h, least);
  for (int left = divides ? 1 : mostBlows(); left > 0 && strike(divides ? soon : h); --left) {
    if (report_.stopped) return h;
    struck_ = true;
    findOut(h);
    known_ = false;
    if (halted()) return h;
    first = untilHit(kNext * step, h, least);
  }
  if (!divides) {
    first = h;
    if (anyHit(h)) report_.note(kPassedOn);
  }
  holdStopped(first);
  return first;
}

int Stepping::mostBlows() const {
  constexpr int kFew = 8, kRow = 4000;  // blows; times pairs: a row of twenty takes 140
  return std::max(kFew, kRow / std::max(1, static_cast<int>(memory_.pairs.size())));
}

void Stepping::holdStopped(double h) {
  // In a crowd what parts is held at once where a fall of h alone would bring it back: what pushes
  // there does so, and problem after problem would find it out, each for the next few points.
  const double fall = 0.5 * gravity_ * h * h;
  const bool crowd = strikesAsCrowd();
  const auto meets = [&](const Touch& touch) {
    const Contact& c = touch.contact;
    if (!closed(touch) && touch.due < h) return true;
    if (!crowd) return false;
    const double vrel = approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point);
    return std::max(c.point.separation, 0.0) + h * vrel < fall;
  };
  for (const PairMemory& pair : memory_.pairs) {
    if (!pair.strikes) continue;
    for (const Touch& touch : pair.touches)
      if (meets(touch)) hold(touch.contact);
  }
}

void Stepping::hold(const Contact& c) {
  for (const int i : {c.a, c.b})
    if (!model_.fixed(i)) work_.held[i] = 1;
}

double Stepping::untilHit(double soon, double h, double least) {
  double first = h;
  bool heldKnown = false;
  for (std::size_t k = 0; k < memory_.pairs.size(); ++k) {
    PairMemory& pair = memory_.pairs[k];
    const bool tumbled = std::exchange(pair.tumbles, tumbles(k, h));
    const bool hits = pair.bounces || landsHard(k),
               struck = std::exchange(pair.strikes, hits || pair.tumbles),
               foreseen = pair.strikes || struck || tumbled, comes = !foreseen && seemsToMeet(k, h);
    if (!foreseen && !comes) continue;
    if (!std::exchange(heldKnown, true)) findHeld();
    if (comes) {
      foreseePassing(k, h);
      continue;
    }
    pair.lasts = pair.tumbles ? partOnRim(k) : h;
    first = std::min(first, pair.lasts);
    if (hits) {
      foresee(k, least);
    } else {
      forgetHits(pair);
    }
    if (pair.tumbles) foreseeMeeting(k, h);
    for (Touch& touch : pair.touches) {
      if (touch.rebounds && touch.due > soon) first = std::min(first, touch.due);
      if (flies(touch, 0.0)) touch.impulse.setZero();
    }
  }
  return first;
}

void Stepping::findHeld() {
  for (const int i : work_.active) work_.held[i] = 0;
  for (const PairMemory& pair : memory_.pairs) {
    for (const Touch& touch : pair.touches) {
      const Contact& c = touch.contact;
      if (closed(touch) &&
          approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point) <= tolerance_.keep)
        hold(c);
    }
  }
  for (const Joint& joint : joints())
    for (const int i : {joint.a, joint.b})
      if (i < model_.count() && !model_.fixed(i)) work_.held[i] = 1;
}

RigidBody Stepping::underWay(int i) const {
  RigidBody body = state_.bodies[i];
  const Push& last = memory_.pushes[i];
  if (!(last.t1 > last.t0) || !work_.held[i]) return body;
  const bool struck = last.P1 != body.P || last.L1 != body.L;
  if (struck) return body;
  body.force = (last.P1 - last.P0) / (last.t1 - last.t0);
  body.torque = (last.L1 - last.L0) / (last.t1 - last.t0);
  return body;
}

namespace {

/// A gap [m], how fast it opens [m/s], and the acceleration [m/s²] of that.
struct Closing {
  double gap, rate, bend;

  double square() const { return rate * rate - 2.0 * bend * gap; }
  bool meets() const { return square() >= 0.0 && (rate < 0.0 || bend < 0.0); }
  double speed() const { return std::sqrt(square()); }
  /// When it is closed [s], if it meets.
  double due() const {
    return rate < 0.0 ? 2.0 * gap / (speed() - rate) : (speed() + rate) / -bend;
  }
};

/// The part of normalAcceleration that a step gives as velocity: n·(M⁻¹ F) without what turns.
double pushAlong(const RigidBody& body, const ContactPoint& c) {
  if (body.fixed()) return 0.0;
  const Vec3 turn = body.Iinv * body.torque;
  return c.n.dot(body.invM * body.force + turn.cross(c.p - body.x));
}

}  // namespace

/// The gap goes by  s + ṡ t + s̈ t²/2  between free bodies. A step moves a held one with the
/// velocity that forces give it until its end, so that their part of s̈ counts twice; and its
/// contact problem sees no other part, which must not stop what is still to be struck. Hits that
/// would rebound at no more than the speed of a contact that lasts are left to the contact problem.
void Stepping::foresee(std::size_t pair, double least) {
  std::vector<Touch>& touches = memory_.pairs[pair].touches;
  if (touches.empty()) return;
  const auto [b, a] = state_.near[pair];
  const RigidBody pushedA = underWay(a), pushedB = underWay(b);
  for (Touch& touch : touches) foresee(touch, pushedA, pushedB, least);
}

void Stepping::foresee(Touch& touch, const RigidBody& a, const RigidBody& b, double least) const {
  const Contact& c = touch.contact;
  Closing way{.gap = closed(touch) ? 0.0 : c.point.separation,
              .rate = approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point),
              .bend = 0.0};
  const bool held = work_.held[c.a] || work_.held[c.b];
  Closing row = way;
  if (way.gap > 0.0 || way.rate > 0.0) {
    way.bend = normalAcceleration(a, b, c.point);
    if (held) {
      const double push = pushAlong(a, c.point) - pushAlong(b, c.point);
      way.bend += push;
      row.bend = 2.0 * push;
    }
  }
  touch.rebounds = way.meets() && isHit(touch, way.speed(), least);
  touch.due = 0.0;
  if (touch.rebounds || !closed(touch))
    touch.due = way.meets() ? way.due() : std::numeric_limits<double>::infinity();
  if (touch.rebounds && held && row.meets()) touch.due = std::min(touch.due, row.due());
}

bool Stepping::landsHard(std::size_t k) const {
  const PairMemory& pair = memory_.pairs[k];
  return pair.lands && !(many_ && isOneOf(work_.dense, k)) &&
         std::any_of(pair.touches.begin(), pair.touches.end(), [&](const Touch& touch) {
           const Contact& c = touch.contact;
           return approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point) <
                  landingSpeed();
         });
}

bool Stepping::isHit(const Touch& touch, double speed, double least) const {
  const double restitution = touch.contact.restitution, slowest = leastRebound(touch, least);
  return restitution > 0.0 ? restitution * speed > slowest
                           : speed > std::max(-landingSpeed(), slowest);
}

bool Stepping::seemsToMeet(std::size_t pair, double h) {
  const auto [ib, ia] = state_.near[pair];
  const RigidBody &a = state_.bodies[ia], &b = state_.bodies[ib];
  std::vector<Touch>& touches = memory_.pairs[pair].touches;
  bool open = !isOneOf(work_.crowded, pair) && !model_.bends(ia) && !model_.bends(ib);
  for (Touch& touch : touches) {
    touch.due = 0.0;
    open = open && !closed(touch);
  }
  return open && std::any_of(touches.begin(), touches.end(), [&](const Touch& touch) {
           const ContactPoint& c = touch.contact.point;
           const double push = pushAlong(a, c) - pushAlong(b, c);
           return c.separation + h * (approachVelocity(a, b, c) + 0.5 * h * push) < 0.0;
         });
}

void Stepping::foreseePassing(std::size_t pair, double h) {
  const auto [ib, ia] = state_.near[pair];
  constexpr double kAhead = 2.0;  // steps: what meets in the next one lands in this
  if (!fliesFree(ia) || !fliesFree(ib) || firstMeeting(pair, kAhead * h) < kAhead * h) return;
  for (Touch& touch : memory_.pairs[pair].touches)
    touch.due = std::numeric_limits<double>::infinity();
}

bool Stepping::anyHit(double within) const {
  const auto hits = [&](const Touch& touch) {
    const Contact& c = touch.contact;
    return touch.rebounds && touch.due <= within &&
           approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point) < 0.0;
  };
  return std::any_of(memory_.pairs.begin(), memory_.pairs.end(), [&](const PairMemory& pair) {
    return pair.strikes && std::any_of(pair.touches.begin(), pair.touches.end(), hits);
  });
}

void Stepping::rebound(Touch& touch, double vrel, double h, Row& normal) const {
  const Contact& c = touch.contact;
  const double gap = std::max(c.point.separation, 0.0);
  const bool meets = gap + h * vrel < 0.0;
  touch.rebounds = meets && -c.restitution * vrel > -landingSpeed();
  touch.due = touch.rebounds && !closed(touch) ? gap / -vrel : 0.0;
  if (touch.rebounds) normal.bias = c.restitution * vrel;
}

void Stepping::bookShift(const Touch& touch) {
  if (closed(touch) || touch.due <= kSoon * model_.def.stepping.step) return;
  ++report_.certificate.hits_early;
  report_.certificate.max_hit_shift = std::max(report_.certificate.max_hit_shift, touch.due);
}

void Stepping::tellPassedOn(const Touch& touch, double j) {
  const Contact& c = touch.contact;
  const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
  const double came =
      approachVelocity(a, b, c.point) - j * inverseEffectiveMass(a, b, c.point.p, c.point.n);
  if (arrives(touch) && c.restitution * came < landingSpeed()) report_.note(kPassedOn);
}

bool Stepping::hovers(const Touch& touch) const {
  const Contact& c = touch.contact;
  const double vrel = approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point);
  const double step = model_.def.stepping.step, fall = 0.5 * gravity_ * step * step;
  return c.restitution == 0.0 && !strikesAsCrowd() && vrel >= landingSpeed() &&
         c.point.separation + step * vrel < fall;
}

double Stepping::widestHover() const {
  double widest = 0.0;
  for (const PairMemory& pair : memory_.pairs)
    for (const Touch& touch : pair.touches)
      if (hovers(touch)) widest = std::max(widest, touch.contact.point.separation);
  return widest;
}

bool Stepping::strike(double within) {
  if (!anyHit(within)) return false;
  std::vector<Contact> contacts;
  std::vector<double> restitution, vrel;
  const double widest = widestHover();
  for (const PairMemory& pair : memory_.pairs) {
    for (const Touch& touch : pair.touches) {
      const Contact& c = touch.contact;
      const bool hits = touch.rebounds && (touch.due <= within || c.point.separation <= widest);
      const bool lasts = !hits && hovers(touch);
      if (!closed(touch) && !hits && !lasts) continue;
      if (hits) bookShift(touch);
      contacts.push_back(c);
      // It says so of the step, whose end leaves more than rounding.
      contacts.back().lasting = lasts;
      vrel.push_back(approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point));
      const bool leans = lasts || (vrel.back() < -tolerance_.rest &&
                                   -c.restitution * vrel.back() <= tolerance_.keep);
      restitution.push_back(leans ? 0.0 : c.restitution);
    }
  }
  if (const std::string crushed = tumble::findCrushed(model_, state_.t, state_.bodies, contacts);
      !crushed.empty()) {
    report_.stopped = true;
    report_.reason = crushed;
    return true;
  }
  ContactTolerance tolerance = tolerance_;
  tolerance.keep = std::max(tolerance.keep, -landingSpeed());
  std::vector<Vec3> impulse(contacts.size(), Vec3::Zero());
  Bonds bonds;
  impactBonds(state_.bodies, joints(), tolerance_.touch, bonds);
  const ImpactReport impact =
      findImpactLaw(strikesAsCrowd() ? "crowd" : std::string_view(model_.def.impact))
          ->apply({.bodies = state_.bodies,
                   .contacts = contacts,
                   .restitution = restitution,
                   .impulse = impulse,
                   .tolerance = tolerance,
                   .bonds = &bonds,
                   .goesOn = true});
  bookImpact(impact, report_);
  const std::string locked = findLocked(model_, state_.t, state_.bodies, contacts, impact.residual);
  if (!locked.empty()) {
    report_.stopped = true;
    report_.reason = locked;
  }
  if (!bonds.empty()) state_.externalImpulse += outerBonds(bonds, state_.bodies).force;
  for (const Event& event : impactEvents(model_, state_, state_.t, contacts, vrel, impulse))
    if (!leansOn(event, state_.bodies, tolerance_.keep)) report_.events.push_back(event);
  return std::any_of(impulse.begin(), impulse.end(), [](const Vec3& j) { return !j.isZero(0.0); });
}

}  // namespace tumble
