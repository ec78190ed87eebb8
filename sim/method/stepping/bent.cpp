// What bends, in a step: linearised, coupled to what it touches, and booked.
#include <algorithm>
#include <cmath>

#include "sim/method/stepping/stepping.h"

namespace tumble {

/// The forces of what bends at the start of a step, and the motion that they give alone.
bool Stepping::bend(double h) {
  work_.crushed.clear();
  findPressed(h);
  if (points_.inStep) findWaysOut(h);
  memory_.unswept.resize(memory_.bendings->parts.size());
  memory_.chords.resize(memory_.bendings->parts.size(), 0);
  for (std::size_t k = 0; k < memory_.unswept.size(); ++k) {
    BendingPart& part = memory_.bendings->parts[k];
    std::fill(part.about.begin(), part.about.end(), Vec3::Zero());
    part.turned = std::numeric_limits<double>::infinity();
    part.newton = false;
    int& left = memory_.unswept[k].left;
    part.sweeps = model_.def.stepping.bent > 0.0 && part.costly && left == 0;
    left = std::max(left - 1, 0);
    lean(part, h);
    part.stored = part.pressed + linearise(part, memory_.bendings->pointOf, state_.bodies, h);
    for (std::size_t p = 0; p < part.bodies.size(); ++p)
      part.swept[p] = state_.bodies[part.bodies[p]].v;
    begin(part, h);
  }
  return work_.crushed.empty();
}

/// The motion that linear forces give alone, where it is not for sweeps to find.
void Stepping::begin(BendingPart& part, double h) {
  part.anew = part.fresh = true;
  setSide(part, state_.bodies, h);
  if (!part.sweeps) factorBent(part, work_.crushed);
}

void Stepping::factorBent(BendingPart& part, std::string& crushed) const {
  if (freeMotion(part, state_.bodies)) return;
  crushed = "\"" + part.body->name +
            "\" left the range of numbers at t = " + shortNumber(state_.t) +
            " s; try a smaller stepping.step, or less stiffness";
}

/// Linearises anew about the motion that was found, Newton's way. @return whether that is needed
bool Stepping::bendFurther(double h, bool all) {
  bool any = false;
  for (std::size_t k = 0; k < bentBooks_.size(); ++k) {
    BendingPart& part = memory_.bendings->parts[k];
    part.anew = (all || part.newton || bentBooks_[k].gained()) && turnOn(part, h);
    any = any || part.anew;
  }
  return any && work_.crushed.empty();
}

bool Stepping::anyByNewton() const {
  const std::vector<BendingPart>& parts = memory_.bendings->parts;
  return std::any_of(parts.begin(), parts.end(),
                     [](const BendingPart& part) { return part.newton; });
}

bool Stepping::turnOn(BendingPart& part, double h) {
  constexpr double kSame = 1e-10;  // of the largest velocity: a step that changes less is the last
  double change = 0.0, scale = 0.0;
  const auto rate = [&](std::size_t p) -> Vec3 {
    const Vec3 v = work_.after[part.bodies[p]].head<3>();
    return part.movesOut() ? Vec3(v + part.wayOut[p]) : v;
  };
  for (std::size_t p = 0; p < part.bodies.size(); ++p) {
    const Vec3 v = rate(p);
    change = std::max(change, (v - part.about[p]).lpNorm<Eigen::Infinity>());
    scale = std::max(scale, v.lpNorm<Eigen::Infinity>());
  }
  if (!(change > kSame * std::max(scale, gravity_ * h))) return false;
  // Where the last one went further astray, half of the way.
  const double share = change < part.turned ? 1.0 : 0.5;
  part.turned = change;
  for (std::size_t p = 0; p < part.bodies.size(); ++p)
    part.about[p] += share * (rate(p) - part.about[p]);
  linearise(part, memory_.bendings->pointOf, state_.bodies, h);
  begin(part, h);
  return true;
}

void Stepping::foreseeBent() {
  for (BendingPart& part : memory_.bendings->parts) {
    part.touched = false;
    for (const int p : part.moving) work_.star[part.bodies[p]].head<3>() = part.star[p];
  }
}

void Stepping::markBent() {
  for (const BendingPart& part : memory_.bendings->parts)
    for (const int p : part.moving) work_.touched[part.bodies[p]] = 1;
}

bool Stepping::anyBends(const Island& island) const {
  return std::any_of(island.movers.begin(), island.movers.end(),
                     [this](int body) { return model_.bends(body); });
}

/// Whether an island is the one that was solved in this step already: no part of it has other
/// forces, and nothing else is met.
bool Stepping::keepsBent(const Island& island, double h) {
  bool same = island.memory->step == step_ && !isBonded(island) && looksTheSame(island, h);
  forBent(island, [&](const BendingPart& part) { same = same && !part.anew; });
  return same;
}

/// All points of what bends in an island belong to it. In order of bodies, however they touch: the
/// structure of its matrix stays.
void Stepping::collectBent(Island& island) {
  constexpr int kAll = 1;  // in the place of the first of a part: all are collected
  const std::size_t touching = island.movers.size();
  for (std::size_t k = 0; k < touching; ++k) {
    if (!model_.bends(island.movers[k])) continue;
    const BendingPart& part = memory_.bendings->partWith(island.movers[k]);
    int& first = island.local[part.bodies[part.moving[0]]];
    if (first == kAll) continue;
    for (const int p : part.moving) {
      int& local = island.local[part.bodies[p]];
      if (local < 0) island.movers.push_back(part.bodies[p]);
      local = 0;
    }
    first = kAll;
  }
  if (anyBends(island)) std::sort(island.movers.begin(), island.movers.end());
}

void Stepping::joinBent() {
  for (const BendingPart& part : memory_.bendings->parts)
    for (const int p : part.moving) joinBodies(part.bodies[p], part.bodies[part.moving[0]]);
}

/// Adds K of what bends in an island to its problem.
void Stepping::coupleBent(Island& island) {
  forBent(island, [&](const BendingPart& part) {
    for (const int p : part.moving) {
      const int at = localOf(island, part.bodies[p]);
      island.problem.couplings.push_back({at, at, part.own[p]});
    }
    for (const auto& [e, inA] : part.movingEdges)
      island.problem.couplings.push_back({localOf(island, part.bodies[part.edges[e].first]),
                                          localOf(island, part.bodies[part.edges[e].second]),
                                          part.off[e]});
  });
}

/// Whether linear forces twist what flies and turns more than it swings. Forces of energies at the
/// end of a step have no moment there; linear ones leave one, which a stiff solid that tumbles
/// keeps as a false spin.
bool Stepping::twists(const BendingPart& part, std::span<const Vec3> v, std::span<const Vec3> pull,
                      double h) const {
  constexpr double kTwist = 0.01;   // of the angle that it turns in the step, and of its spin
  constexpr double kTurns = 0.5;    // of the angular momenta of its points is its own
  constexpr double kFlight = 1e-9;  // of the angular momenta of points that fly: less is rounding
  double mass = 0.0;
  Vec3 centre = Vec3::Zero(), mean = Vec3::Zero();
  for (std::size_t p = 0; p < v.size(); ++p) {
    const double M = state_.bodies[part.bodies[p]].M;
    mass += M;
    centre += M * part.reachedAt[p];
    mean += M * v[p];
  }
  centre /= mass;
  mean /= mass;
  double spin = 0.0, flight = 0.0, inertia = 0.0;
  Vec3 moment = Vec3::Zero(), L = Vec3::Zero();
  for (std::size_t p = 0; p < v.size(); ++p) {
    const Vec3 arm = part.reachedAt[p] - centre;
    const double length = arm.norm(), lever = state_.bodies[part.bodies[p]].M * length;
    moment += arm.cross(part.constant[p] - pull[p]);
    L += state_.bodies[part.bodies[p]].M * arm.cross(v[p] - mean);
    spin += lever * (v[p] - mean).norm();
    flight += lever * v[p].norm();
    inertia += lever * length;
  }
  const double turned = h * spin / inertia;
  return L.norm() > kTurns * spin &&
         moment.norm() > std::max(kTwist * turned * spin, kFlight * flight);
}

/// What a point gains [J] because a step takes its velocity before it for another: beside the
/// change itself, work of contacts and winds is booked by the velocity that it has.
double Stepping::leaned(const BendingPart& part, std::size_t p, const Vec3& impulse, const Vec3& v,
                        double h) const {
  if (part.lean.empty()) return 0.0;
  const RigidBody& body = state_.bodies[part.bodies[p]];
  const Vec3& lean = part.lean[p];
  const Vec3 others = body.M * (v - body.v - lean - h * model_.def.gravity) - impulse;
  return 0.5 * lean.dot(body.M * (2.0 * body.v + lean) + others);
}

/// What the implicit step takes [J], by the impulses p of what bends and its energies alone: with
/// v̄ the mean of the velocities before and after, a point gains p·v̄ while the energies give
/// −ΔE; gravity acts on the way h v⁺, which is ½ h Δv longer than that of v̄, less what the whole
/// falls. Points that are led along take −p from who leads them. On their way out of a solid,
/// points move against p and gravity.
Stepping::BentBooks Stepping::booksOf(const BendingPart& part, double h) const {
  thread_local std::vector<Vec3> v, pull;  // keep their storage from call to call
  v.clear();
  for (const int i : part.bodies) v.push_back(work_.after[i].head<3>());
  part.timesK(v, pull);
  BentBooks books;
  double gained = part.reached - part.stored;
  if (part.joined) books.given = gained;
  for (std::size_t p = 0; p < part.bodies.size(); ++p) {
    const RigidBody& body = state_.bodies[part.bodies[p]];
    const Vec3 impulse = part.constant[p] - pull[p];
    const Vec3 before = work_.before[part.bodies[p]].head<3>() + part.leanOf(p);
    books.given += impulse.dot(part.reachedAt[p] - body.x) / h;
    if (part.mover[p] < 0) {
      books.led -= impulse.dot(body.v);
      books.external -= impulse;
      continue;
    }
    gained +=
        impulse.dot(0.5 * (before + v[p])) -
        h * body.M * model_.def.gravity.dot(0.5 * (v[p] - before) - work_.falls[part.bodies[p]]);
    books.size += 0.5 * body.M * (v[p].squaredNorm() + before.squaredNorm());
    books.turned += leaned(part, p, impulse, v[p], h);
    if (!part.movesOut()) continue;
    gained += impulse.dot(part.wayOut[p]);
    books.movedOut -= (impulse + h * body.M * model_.def.gravity).dot(part.wayOut[p]);
  }
  books.taken = books.led - gained;
  books.astray = !part.touched && part.flies() && twists(part, v, pull, h);
  books.size += part.reached + part.stored;
  return books;
}

/// What the step takes of points that joints hold may be less than nothing, for these are booked by
/// other velocities. Linear forces gain only where their work on the way is more than energies
/// give.
bool Stepping::BentBooks::gained() const {
  constexpr double kGain = 1e-7;  // of the energies at both ends
  return taken < -kGain * size && given > kGain * size;
}

/// Where the velocities at hand lead.
void Stepping::reachBent(double h) {
  for (BendingPart& part : memory_.bendings->parts)
    if (part.fresh) reach(part, state_.bodies, work_.after, work_.falls, h);
}

/// Finds the books of the velocities at hand. @return whether linear forces gain somewhere
bool Stepping::gains(double h) {
  std::vector<BendingPart>& parts = memory_.bendings->parts;
  bentBooks_.resize(parts.size());
  reachBent(h);
  for (BendingPart& part : parts)
    if (part.fresh) storeReached(part, memory_.bendings->pointOf);
  reachPressed();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (!parts[k].fresh) continue;
    bentBooks_[k] = booksOf(parts[k], h);
    parts[k].newton = parts[k].newton || bentBooks_[k].astray;
    parts[k].fresh = false;
  }
  return std::any_of(bentBooks_.begin(), bentBooks_.end(),
                     [](const BentBooks& books) { return books.gained(); });
}

/// Whether the step is to be taken in halves: linear forces have no answer, or however often they
/// were found anew, they give more than contacts take.
bool Stepping::isToHalve(double h) {
  constexpr double kGiven = 1e-6;        // of the energies at both ends
  constexpr double kLeast = 1.0 / 64.0;  // of a step: shorter ones are taken as they are
  const bool divisible = h > kLeast * model_.def.stepping.step;
  if (!work_.crushed.empty()) {
    if (!divisible) return false;
    work_.crushed.clear();
    return true;
  }
  if (!gains(h)) return false;
  double taken = 0.0, size = 0.0;
  for (const BentBooks& books : bentBooks_) {
    taken += books.taken;
    size += books.size;
  }
  for (const IslandAnswer& answer : work_.answers)
    if (answer.head >= 0) {
      const IslandBooks& books = memory_.islands[answer.head].books;
      taken += books.lostImpact + books.lostFriction;
    }
  return taken < -kGiven * size && divisible;
}

/// The potential energy [J] of the bodies as they are. What bends has it already where it came to
/// be where its velocities led.
double Stepping::potentialNow() const {
  const Vec3& gravity = model_.def.gravity;
  double sum = potentialEnergy(gravity, memory_.bendings->others, state_.bodies);
  for (const BendingPart& part : memory_.bendings->parts) {
    bool there = !part.reachedAt.empty();
    for (std::size_t p = 0; p < part.reachedAt.size(); ++p) {
      const Vec3& x = state_.bodies[part.bodies[p]].x;
      there = there && (x - part.reachedAt[p]).lpNorm<Eigen::Infinity>() <= roundingAt(x);
    }
    if (!there) return potentialEnergy(gravity, model_.def.forces, state_.bodies);
    sum += part.reached;
  }
  return sum;
}

void Stepping::bookBent() {
  for (const BentBooks& books : bentBooks_) {
    state_.externalImpulse += books.external;
    report_.certificate.work_of_forces += books.led;
    report_.certificate.energy_lost_bending += books.taken - books.turned;
    report_.certificate.energy_added_repair += books.movedOut;
  }
}

}  // namespace tumble
