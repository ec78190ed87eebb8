#include "sim/method/exact/sustained.h"
#include "sim/method/crush.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collide/collide.h"
#include "sim/method/exact/crossing.h"
#include "sim/method/exact/exact.h"

namespace tumble {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Error of a step in each number of Y, relative to 1 + |y|.
constexpr double kTolerance = 1e-13;
/// [m] per size of the world: overlap that dates an event of a pair that touches already.
constexpr double kOff = 1e-12;
/// [m/s] per size of the world: up to this, a slip that begins follows its growth.
constexpr double kOnset = 1e-4;
/// [m] per size of the world: overlap that no event explains.
constexpr double kAstray = 1e-9;
/// Energy that friction gives, of the kinetic energy: what slides is no longer what was asked.
constexpr double kGiven = 1e-6;
/// Residual of a contact problem that took all that solvers have.
constexpr double kUnsolved = 1e-9;
/// [m] per size of the world: overlap that nothing mends is no touch any more.
constexpr double kCrushed = 1e-6;
/// [m] per size of the world: overlap at the end of a step, mended or not, of bodies that numbers
/// cannot keep apart.
constexpr double kUnheld = 1e-3;
constexpr char kCrowdedNote[] =
    "more events than time can hold were crossed in short steps, which are right to first order";
constexpr char kLawlessNote[] =
    "where no forces obey the laws of contact and friction, a short step went on with impulses "
    "that do; it is right to first order";
/// [1] Normals that differ by less are one: faces that lie on each other may take turns.
constexpr double kOneNormal = 1e-8;
/// [s] A stretch that is shorter stands still; or counts as an event, however it ended.
constexpr double kInstant = 1e-12, kShort = 1e-4;
/// What it costs, in hits; evaluations that any stretch may have, how many more of them cost as
/// much as a hit, and the most that they cost.
constexpr long kWeight = 25, kEasy = 3000, kToil = 100, kHardest = 100;

bool allFinite(std::span<const double> y) {
  return std::all_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); });
}

bool sameFeature(const Contact& c, const Contact& d) {
  return c.a == d.a && c.b == d.b && c.point.feature == d.point.feature &&
         (c.point.n - d.point.n).squaredNorm() < kOneNormal * kOneNormal;
}

/// Two contacts of a pair at one point, whose normals differ by no more than that [1].
bool samePlace(const Contact& c, const Contact& d, double close, double apart) {
  return c.a == d.a && c.b == d.b && (c.point.p - d.point.p).norm() < close &&
         (c.point.n - d.point.n).squaredNorm() <= apart * apart;
}

}  // namespace

Sustained::Sustained(const Model& model, State& state, Report& report)
    : model_(model),
      state_(state),
      report_(report),
      tolerance_(ContactTolerance::forSize(model.size)),
      system_(model, state.bodies),
      integrator_(system_.size(), kTolerance),
      y0_(static_cast<std::size_t>(system_.size())),
      y_(y0_),
      trial_(state.bodies),
      onset_(kOnset * ContactTolerance::scaleOf(model.size)) {}

void Sustained::next() {
  system_.effort = state_.effort;
  if (state_.exact.pace.level > 0 || state_.exact.lawless)
    return cross(state_.exact.pace.stretch());
  chooseModes();
  system_.begin(state_.lasting);
  system_.pack(state_.bodies, y0_);
  trial_ = state_.bodies;
  system_.findForces(trial_);
  markOnset();
  system_.turnFrom(trial_);
  most_ = lookAhead();
  findNear(most_);
  if (report_.stopped) return;
  double h = most_;
  bool event = findEvent(h);
  for (allowance(h); metUnseen(); allowance(h)) event = findEvent(h);
  // What contacts keep from one try to the next may lead a motion astray: it is cut short.
  for (; overlap_ > kAstray * ContactTolerance::scaleOf(model_.size) && h > kInstant;
       allowance(h)) {
    h *= 0.5;
    event = false;
  }
  if (givesEnergy()) {
    state_.exact.lawless = true;
    return cross(state_.exact.pace.stretch());
  }
  commit(h);
  state_.effort = system_.effort;
  keepPace(event || h < kShort);
  if (event || --state_.exact.stretchesLeft <= 0 || state_.lasting.empty()) leave();
}

void Sustained::keepPace(bool event) {
  const long toil = (system_.evaluations() - before_ - kEasy) / kToil;
  before_ = system_.evaluations();
  state_.exact.pace.see(state_.t, (event ? kWeight : 0) + std::clamp(toil, 0L, kHardest));
  if (!state_.exact.pace.lost() || report_.stopped) return;
  report_.stopped = true;
  report_.reason = crowdedAt(state_.t);
}

bool Sustained::findEvent(double& h) {
  path_.begin(0.0, most_, y0_);
  Look before = look(0.0);
  h = 0.0;
  if (!(before.allowed > 0.0)) return true;
  while (before.s < most_) {
    if (system_.effort.spent()) {
      h = before.s;
      return true;
    }
    if (!path_.grow(system_, integrator_, most_)) {  // forces change faster and faster
      h = 0.9 * before.s;
      state_.exact.jammed = h < kInstant;
      return true;
    }
    Look after = look(path_.reached());
    const std::optional<Bracket> event = between(before, after);
    if (event && !look(event->lo).turned) {
      h = event->hi;
      if (allowance(h) < 0.0 && cause_ == Cause::Touch) h = event->lo;
      return true;
    }
    // The direction of a slip that turns too far would be taken for its end.
    if (after.turned && before.s > 0.0) break;
    if (after.turned && after.s > kInstant) {
      path_.cut(before.s, 0.5 * after.s);
      continue;
    }
    before = std::move(after);
    if (slipBegan()) break;
  }
  h = before.s;
  return false;
}

std::optional<Bracket> Sustained::between(const Look& lo, const Look& hi) {
  if (hi.allowed < 0.0) {
    return findRoot([&](double s) { return allowance(s); }, lo.s, hi.s, lo.allowed, hi.allowed,
                    instantNear(state_.t + hi.s));
  }
  const double when = doubt(lo, hi);
  if (!(when > lo.s && when < hi.s)) return std::nullopt;
  const Look middle = look(when);
  if (const std::optional<Bracket> first = between(lo, middle)) return first;
  return between(middle, hi);
}

Sustained::Look Sustained::look(double s) {
  Look look{.s = s, .allowed = allowance(s)};
  look.turned = slipTurned();
  look.gaps = gaps_;
  for (Contact point : watched_) {
    const RigidBody &a = trial_[point.a], &b = trial_[point.b];
    follow(a, b, point);
    look.heights.push_back(point.point.separation);
    look.rates.push_back(approachVelocity(a, b, point.point));
  }
  return look;
}

// Friction that would give energy is none.
bool Sustained::givesEnergy() const {
  return system_.books(y_).rubbed < -kGiven * state_.kineticMax - state_.load * tolerance_.touch;
}

void Sustained::cross(double most) {
  report_.note(state_.exact.lawless ? kLawlessNote : kCrowdedNote);
  const double left = model_.def.duration - state_.t;
  Crossing step(model_, state_);
  step.take(std::min(most, left));
  if (step.h == 0.0) {
    keepPace(true);
    return leave();
  }
  system_.effort.done += Effort::kPolished * countMoving(state_.bodies);
  if (step.residual > kUnsolved) system_.effort.done += Effort::kUnsolved;
  Certificate& books = report_.certificate;
  const std::vector<Contact> before = state_.lasting;
  const double t1 = step.h < left ? state_.t + step.h : model_.def.duration;
  step.segment.t1 = t1;
  state_.bodies = step.segment.end;
  state_.lasting = step.segment.contacts;
  std::erase_if(state_.lasting, [&](Contact& c) {
    follow(state_.bodies[c.a], state_.bodies[c.b], c);
    return std::abs(c.point.separation) > tolerance_.touch;
  });
  state_.trail.push_back(std::move(step.segment));
  books.max_penetration = std::max(books.max_penetration, step.deepest);
  books.max_complementarity = std::max(books.max_complementarity, step.residual);
  books.work_of_forces += step.work;
  books.energy_lost_friction += step.lostFriction;
  books.energy_lost_impact += step.lostImpact;
  books.energy_added_repair += step.mended;
  state_.externalImpulse += step.impulse;
  state_.t = t1;
  ++books.steps;
  ++books.evaluations;
  recordChanges(before, state_.lasting, state_.bodies, state_.t, report_);
  account(model_, state_, report_);
  state_.effort = system_.effort;
  before_ = system_.evaluations();
  keepPace(step.touches || state_.exact.lawless || step.h < std::min(kShort, left));
  state_.exact.lawless = false;
  if (step.left > kCrushed * ContactTolerance::scaleOf(model_.size)) {
    report_.stopped = true;
    const auto driven = [&](const RigidBody& body) {
      return drives(model_, body, static_cast<int>(&body - state_.bodies.data()));
    };
    report_.reason = std::any_of(state_.bodies.begin(), state_.bodies.end(), driven)
                         ? crushedAt(model_, step.worst, state_.t)
                         : crowdedAt(state_.t);
  }
  if (!report_.stopped && step.deepest > kUnheld * ContactTolerance::scaleOf(model_.size)) {
    report_.stopped = true;
    report_.reason = unheldAt(model_, step.worst, state_.t, step.deepest);
  }
  leave();
}

void Sustained::leave() {
  state_.exact.sustained = false;
  state_.exact.settled = true;
}

double Sustained::allowance(double h) {
  cause_ = Cause::None;
  path_.at(system_, integrator_, h, y_);
  if (!allFinite(y_)) return 1.0;  // commit() reports it
  system_.unpack(h, y_, trial_);
  double least = kInfinity, above = kInfinity;
  gaps_.clear();
  for (const Near& pair : near_) {
    gaps_.push_back(separation(model_.shapes[pair.a], trial_[pair.a].pose(), model_.shapes[pair.b],
                               trial_[pair.b].pose()));
    least = std::min(least, gaps_.back() - pair.floor);
    if (!pair.lasts) above = std::min(above, gaps_.back() - pair.floor);
  }
  overlap_ = -least;
  if (least < 0.0)
    cause_ = Cause::Touch;
  else
    least = std::min(above, lowestWatched());
  const double mode = modeAllowance();
  if (mode < least) {
    least = mode;
    cause_ = Cause::Mode;
  }
  if (h == 0.0 || least <= 0.0) return least;
  if (const double features = featureAllowance(); features < 0.0) {
    least = features;
    cause_ = Cause::Mode;
  }
  return least;
}

// How far [1] the normal of a contact was at the start from one that is found at the same point.
double Sustained::ambiguity(const Contact& c) const {
  double least = kInfinity;
  for (const Contact& d : touching_)
    if (samePlace(c, d, tolerance_.touch, 1.0))
      least = std::min(least, (c.point.n - d.point.n).norm());
  return least < kInfinity ? least : 0.0;
}

// How deep a new point is tells how far back it was not there.
double Sustained::featureAllowance() const {
  double least = kInfinity;
  std::vector<Contact> found;
  const double close = kOff * ContactTolerance::scaleOf(model_.size);
  for (const Near& pair : near_) {
    if (!pair.lasts) continue;
    const auto ofPair = [&](const Contact& c) { return c.a == pair.a && c.b == pair.b; };
    const std::vector<Contact>& held = system_.contacts();
    found.clear();
    findContacts(model_, trial_, {pair.b, pair.a}, tolerance_.touch, found);
    const auto lists = [&](const std::vector<Contact>& list, const Contact& c) {
      return std::any_of(list.begin(), list.end(),
                         [&](const Contact& d) { return sameFeature(c, d); });
    };
    // A corner on an edge touches under two normals, that of either face: they may part from each
    // other as far again.
    const auto remains = [&](const Contact& c) {
      const double apart = 2.0 * ambiguity(state_.lasting[static_cast<std::size_t>(&c - &held[0])]);
      return std::any_of(found.begin(), found.end(), [&](const Contact& d) {
        return sameFeature(c, d) || samePlace(c, d, tolerance_.touch, apart);
      });
    };
    const auto approaches = [&](const Contact& c) {
      return approachVelocity(trial_[c.a], trial_[c.b], c.point) < -tolerance_.rest;
    };
    for (const Contact& c : held)
      if (ofPair(c) && !remains(c)) return -1.0;
    for (const Contact& c : found)
      if (c.point.separation < close && approaches(c) && !lists(held, c) && !lists(touching_, c))
        least = std::min(least, c.point.separation - close);
  }
  return least;
}

void Sustained::commit(double h) {
  Certificate& books = report_.certificate;
  if (!allFinite(y_)) {
    report_.stopped = true;
    state_.effort = system_.effort;
    report_.reason =
        state_.effort.spent()
            ? spentBy(model_, state_)
            : "the motion left the range of numbers at t = " + shortNumber(state_.t) + " s";
    return;
  }
  const SustainedSystem::Books done = system_.books(y_);
  const double t1 = h < model_.def.duration - state_.t ? state_.t + h : model_.def.duration;
  if (t1 > state_.t)
    state_.trail.push_back({.t0 = state_.t,
                            .t1 = t1,
                            .start = state_.bodies,
                            .end = trial_,
                            .contacts = state_.lasting});
  state_.bodies = trial_;
  state_.lasting = system_.contacts();
  for (const Near& pair : near_)
    books.max_penetration =
        std::max(books.max_penetration, -separation(model_.shapes[pair.a], trial_[pair.a].pose(),
                                                    model_.shapes[pair.b], trial_[pair.b].pose()));
  books.work_of_forces += done.work;
  books.energy_lost_friction += done.rubbed;
  state_.externalImpulse += done.impulse;
  books.evaluations += system_.evaluations() - counted_;
  counted_ = system_.evaluations();
  state_.t = t1;
  ++books.steps;
  account(model_, state_, report_);
}

void lookSustained(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
                   std::vector<Contact>& contacts) {
  const Segment* segment = nullptr;
  for (const Segment& s : state.trail)
    if (s.t0 <= t) segment = &s;
  const bool now = !segment || t >= state.t;
  bodies = now ? state.bodies : segment->start;
  if (now &&
      !state.exact.modesKnown) {  // the forces of this instant are known, not yet what slides
    contacts = state.lasting;
    for (Contact& c : contacts) follow(bodies[c.a], bodies[c.b], c);
    return;
  }
  if (!now && segment->crossing) {
    lookAcross(model, state, *segment, t, bodies);
    contacts = segment->contacts;
    for (Contact& c : contacts) follow(bodies[c.a], bodies[c.b], c);
    return;
  }
  SustainedSystem system(model, bodies);
  system.begin(now ? state.lasting : segment->contacts);
  if (!now && t > segment->t0) {
    std::vector<double> y(static_cast<std::size_t>(system.size()));
    system.findForces(bodies);
    system.turnFrom(bodies);
    system.pack(bodies, y);
    Extrapolation(system.size(), kTolerance).step(system, 0.0, t - segment->t0, y);
    system.unpack(t - segment->t0, y, bodies);
  }
  system.findForces(bodies);
  contacts = system.contacts();
}

}  // namespace tumble
