// The events of one instant: impulses on colliding contacts, and the list of those that last.
#include <algorithm>
#include <cmath>

#include "sim/contact/impact.h"
#include "sim/joint/joint_bonds.h"
#include "sim/method/course/course.h"

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

// Normals that differ by less are one: what rounding leaves of a shared face. [1]
constexpr double kOneNormal = 1e-9;

bool samePair(const Contact& c, const Contact& d) {
  return c.a == d.a && c.b == d.b;
}

bool sameNormal(const ContactPoint& c, const ContactPoint& d) {
  return (c.n - d.n).squaredNorm() < kOneNormal * kOneNormal;
}

}  // namespace

bool Course::collides() const {
  if (limitApproach(state_.bodies, model_.joints, tolerance_.touch) < -kNoise * tolerance_.rest)
    return true;
  return std::any_of(touching_.begin(), touching_.end(), [&](const Contact& c) {
    return approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point) <
           -kNoise * tolerance_.rest;
  });
}

double Course::restitutionNow(const Contact& c) const {
  const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
  const double rebound = -c.restitution * approachVelocity(a, b, c.point);
  if (rebound <= c.restitution * tolerance_.rest) return c.restitution;  // it does not approach
  if (wasLasting(c.a, c.b) && rebound < tolerance_.keep) return 0.0;
  const double press = -normalAcceleration(a, b, c.point);
  if (press > 0.0 && rebound * rebound < 2.0 * press * kHeight &&
      2.0 * rebound < press * (1.0 - c.restitution) * kTime)
    return 0.0;
  const auto recent = state_.recentImpacts.find({c.a, c.b});
  const int hits = recent == state_.recentImpacts.end() ? 0 : recent->second;
  const double crawl = accelerationScale() * model_.def.course.step;
  if (hits > kHitsInStep && rebound < crawl) return 0.0;
  return c.restitution;
}

void Course::respond() {
  std::vector<double> restitution, vrel;
  for (const Contact& c : touching_) {
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
  Certificate& books = report_.certificate;
  books.energy_lost_impact += impact.lostNormal;
  books.energy_lost_friction += impact.lostFriction;
  books.work_of_forces += impact.work;
  books.max_complementarity = std::max(books.max_complementarity, impact.residual);
  if (impact.finishedInelastic)
    report_.note("impacts that did not come to an end were finished without rebound");
  recordImpacts(vrel, impulse);
  recordBonds(bonds);
}

void Course::recordBonds(const Bonds& bonds) {
  if (!bonds.empty()) state_.externalImpulse += outerBonds(bonds, state_.bodies).force;
}

void Course::recordImpacts(std::span<const double> vrel, std::span<const Vec3> impulse) {
  // Contacts of one pair stand together; those that share a normal are one impact.
  for (std::size_t i = 0; i < touching_.size();) {
    std::size_t end = i;
    while (end < touching_.size() && samePair(touching_[end], touching_[i])) ++end;
    const std::size_t before = report_.events.size();
    for (std::size_t k = i; k < end; ++k) {
      const bool first =
          std::none_of(touching_.begin() + i, touching_.begin() + k,
                       [&](const Contact& c) { return sameNormal(c.point, touching_[k].point); });
      if (first) recordImpact(k, end, vrel, impulse);
    }
    if (report_.events.size() > before) ++state_.recentImpacts[{touching_[i].a, touching_[i].b}];
    i = end;
  }
}

void Course::recordImpact(std::size_t first, std::size_t end, std::span<const double> vrel,
                          std::span<const Vec3> impulse) {
  const Contact& c = touching_[first];
  Event event{.t = state_.t, .kind = EventKind::Impact, .a = c.a, .b = c.b};
  event.n = c.point.n;
  event.p.setZero();
  for (std::size_t k = first; k < end; ++k) {
    if (!sameNormal(touching_[k].point, c.point)) continue;
    const double j = impulse[k].dot(event.n);
    event.p += j * touching_[k].point.p;
    event.j += j;
    event.vrel = std::min(event.vrel, vrel[k]);
    if (state_.bodies[c.b].fixed()) state_.externalImpulse += impulse[k];
    if (state_.bodies[c.a].fixed()) state_.externalImpulse -= impulse[k];
  }
  if (event.j <= 0.0) return;
  // A contact that lasts and gets no more than rounding only leans on.
  const double kick = event.j * (state_.bodies[c.a].invM + state_.bodies[c.b].invM);
  if (wasLasting(c.a, c.b) && event.vrel > -tolerance_.keep && kick < tolerance_.keep) return;
  event.p /= event.j;
  report_.events.push_back(event);
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
    const Vec3 slip = slipVelocity(a, b, c.point);
    c.sliding = c.friction > 0.0 && slip.norm() > tolerance_.stick;
    if (c.sliding) c.slipDirection = slip.normalized();
    c.creeping = c.sliding && slip.norm() < kCreep * c.friction * scale * model_.def.course.step;
    // After many ends of slips in one step a creeping contact is taken as sticking: its slip then
    // fades with the pull of a lasting contact, inside Coulomb's cone.
    if (c.creeping && state_.recentBackUps >= kSticksInStep) c.sliding = c.creeping = false;
    c.mayStick = c.sliding;
    lasting.push_back(c);
  }
  state_.limits = restingLimits(state_.bodies, model_.joints, tolerance_.touch, tolerance_.rest,
                                tolerance_.keep, state_.limits);
  Bonds bonds;
  restBonds(state_.bodies, model_.joints, state_.limits, pullTime(model_), bonds);
  rest_.settleCreep(state_.bodies, lasting, model_.def.course.step, &bonds);
  std::swap(state_.lasting, lasting);
  recordChanges(lasting, state_.lasting, state_.t, report_);
}

}  // namespace tumble
