#include "sim/method/stepping/stepping.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/body/force.h"
#include "sim/math/rotation.h"
#include "sim/method/came_apart.h"

namespace tumble {
namespace {

/// What bends needs a solver that knows couplings, and is driven by gravity and winds alone.
void checkBending(const Model& model) {
  if (model.bending.empty()) return;
  const SteppingSettings& stepping = model.def.stepping;
  if (!findSolver(stepping.solver)->couples)
    throw Refusal("stepping.solver", "\"" + stepping.solver +
                                         "\" needs a block-diagonal mass, which what bends has "
                                         "not; take \"newton\"");
  for (std::size_t k = 0; k < model.def.forces.size(); ++k) {
    const Force& force = model.def.forces[k];
    const auto on = [&](int body) { return body == kNoBody || model.bends(body); };
    const auto* drag = std::get_if<LinearDrag>(&force);
    const auto* field = std::get_if<CircularField>(&force);
    const auto* spring = std::get_if<Spring>(&force);
    const auto* point = std::get_if<PointForce>(&force);
    if ((point && model.bends(point->body)) || (drag && on(drag->body)) ||
        (field && on(field->body)) ||
        (spring && (model.bends(spring->a) || (spring->b != kNoBody && model.bends(spring->b)))))
      throw Refusal("forces[" + std::to_string(k) + "]",
                    "\"stepping\" drives points of what bends by gravity and wind alone; name the "
                    "bodies that this force is for, none that is such a point");
  }
}

}  // namespace

void checkStepping(const Model& model, std::span<const RigidBody> /*bodies*/) {
  const SteppingSettings& stepping = model.def.stepping;
  if (!findSolver(stepping.solver))
    throw Refusal("stepping.solver", "no solver is called \"" + stepping.solver + "\"");
  requireStep("stepping.step", stepping.step, model.def.duration);
  if (!(stepping.tolerance > 0.0) || !std::isfinite(stepping.tolerance))
    throw Refusal("stepping.tolerance", "a tolerance must be a positive number");
  if (!findPointPlan(stepping.points))
    throw Refusal("stepping.points", "no plan for points is called \"" + stepping.points + "\"");
  checkBending(model);
  if (!model.pivots.empty())
    throw Refusal(
        "bodies[" + std::to_string(model.pivots[0].body) + "].pivot_body",
        std::string("\"stepping\" knows no pivots; leave it out, a ball joint to the world "
                    "holds the same point") +
            (model.bending.empty() ? ", or take method = \"course\"" : ""));
}

void advanceStepping(const Model& model, State& state, double t_end, Report& report) {
  Stepping stepping(model, state, report);
  // The forces at t = 0 are those of the first step.
  while ((state.t < t_end || state.trail.empty()) && !report.stopped) stepping.step();
}

Stepping::Stepping(const Model& model, State& state, Report& report)
    : model_(model),
      state_(state),
      report_(report),
      memory_(state.stepping),
      work_(state.stepping.work),
      tolerance_(ContactTolerance::forSize(model.size)),
      gravity_(model.def.gravity.norm()),
      solver_(*findSolver(model.def.stepping.solver)),
      points_(*findPointPlan(model.def.stepping.points)) {
  if (!memory_.drives) {
    memory_.drives = drivesOf(model, state.bodies);
    findTied();
  }
  memory_.islands.resize(state.bodies.size());
  memory_.left.resize(state.bodies.size(), 0.0);
  memory_.spins.resize(state.bodies.size());
  memory_.pushes.resize(state.bodies.size());
  work_.touched.resize(state.bodies.size());
  work_.held.resize(state.bodies.size() + 1, 0);
  work_.islands.resize(std::max<std::size_t>(1, work_.islands.size()));
  activateAll();
  if (!memory_.bendings) memory_.bendings = std::make_shared<Bendings>(bendingsOf(model));
}

namespace {

Vec6 twistOf(const RigidBody& body) {
  Vec6 twist;
  twist << body.v, body.omega;
  return twist;
}

}  // namespace

bool Stepping::finite() const {
  return std::all_of(work_.active.begin(), work_.active.end(), [&](int i) {
    const RigidBody& body = state_.bodies[i];
    return body.x.allFinite() && body.q.coeffs().allFinite() && body.v.allFinite() &&
           body.omega.allFinite();
  });
}

void Stepping::stop(const std::string& what) {
  report_.stopped = true;
  report_.reason = what;
  if (parted_) return;  // until the clusters are one again
  state_.bodies = state_.trail.back().start;
  state_.trail.pop_back();
}

void Stepping::step() {
  const double t0 = state_.t, t1 = gridTime(model_, state_.gridIndex, model_.def.stepping.step);
  const double whole = lengthTo(t1);
  if (memory_.division == 0) divideFirst(whole);
  const double h = whole / memory_.division;
  memory_.missed = 0.0;
  for (int k = 1; k <= memory_.division && !report_.stopped; ++k)
    stepTo(k == memory_.division ? t1 : t0 + k * h, h);
  if (report_.stopped) return;
  ++state_.gridIndex;
  divideNext(whole);
}

void Stepping::stepTo(double t1, double h) {
  findOut(h);
  if (report_.stopped) return;
  work_.met.clear();
  findCrowds();
  if ((divides() || mixed_) && findClusters(h))
    stepClusters(t1, h);
  else
    go(t1, h);
  if (!std::exchange(misses_, false)) return;
  stepInHalves(t1);
}

void Stepping::stepInHalves(double t1) {
  const double half = 0.5 * (t1 - state_.t);
  stepTo(state_.t + half, half);
  if (!report_.stopped) stepTo(t1, t1 - state_.t);
}

/// First for every hit, then for those that rebound for longer than a step, while the pairs of
/// bodies that could be looked at are few.
int Stepping::go(double t1, double h) {
  constexpr int kFew = 2, kMany = 16, kBodies = 256;
  constexpr double kPairs = 2e4;
  constexpr double kShort = 1e-10;  // of a step: there rounding of a joint's gap is a velocity
  const double shortest = kShort * model_.def.stepping.step;
  const int n = std::max(1, static_cast<int>(work_.solids.size()));
  const int every = std::clamp(kBodies / n, kFew, kMany);
  const int most = std::max(every, static_cast<int>(kPairs / n / n));
  findCrowds();
  divided_ = false;
  int parts = 1;
  for (; !halted(); ++parts) {
    const bool all = n == 1 && parts <= every;
    const double part = meet(h, !divides() || strikesAsCrowd() || parts > most ? Hits::None
                                : all                                          ? Hits::All
                                                                               : Hits::Fast);
    if (part >= h - shortest) break;
    divided_ = true;
    moveTo(state_.t + part, part);
    h -= part;
  }
  if (!halted()) moveTo(t1, h);
  return parts;
}

void Stepping::moveTo(double t1, double h) {
  beginPart(t1);
  solveSteadily(h);
  struck_ = false;
  if (misses_) {
    if (!parted_) state_.trail.pop_back();
    return;
  }
  if (report_.stopped) return stop(report_.reason);
  if (!work_.crushed.empty()) return stop(work_.crushed);
  if (bends()) turnBent(h);
  const double powerBefore = steadyPower();
  applyTwists(h);
  recordEvents(t1);
  moveBodies(h);
  bookSprings(h);
  if (bends()) bookBent();
  if (bends() && !points_.foresees) moveOut(h);
  if (!finite()) return stop("the motion left the range of numbers; try a smaller stepping.step");
  if (!project())
    if (const std::string apart = cameApart(model_, state_.bodies, "stepping.step"); !apart.empty())
      return stop(apart);
  pushAgain(h);
  meetJoints(h);
  report_.certificate.work_of_forces += 0.5 * h * (powerBefore + steadyPower());
  bookHalves(h);
  endPart(t1);
}

/// The length [s] of a step: that of the grid, free of the rounding of its ends, but for a shorter
/// one at the end of the run, and at the start of one that another method began.
double Stepping::lengthTo(double t1) const {
  const double h = model_.def.stepping.step;
  const double k = static_cast<double>(state_.gridIndex);
  const bool whole = state_.t == k * h && t1 == (k + 1.0) * h;
  return whole ? h : t1 - state_.t;
}

void Stepping::beginSegment(double t1) {
  if (state_.spareTrail.empty()) {
    state_.trail.emplace_back();
  } else {
    state_.trail.push_back(std::move(state_.spareTrail.back()));
    state_.spareTrail.pop_back();
  }
  Segment& segment = state_.trail.back();
  segment.t0 = state_.t;
  segment.t1 = t1;
  segment.start = state_.bodies;
  segment.contacts.clear();
  segment.pieces.clear();
  segment.still = false;
  segment.steps = 1;

  const std::size_t n = state_.bodies.size();
  work_.before.resize(n + 1);  // the last is the world, for joints
  work_.star.resize(n + 1);
  work_.after.resize(n + 1);
  for (std::vector<Vec6>* twists : {&work_.before, &work_.star, &work_.after})
    (*twists)[n].setZero();
  for (std::size_t i = 0; i < n; ++i)
    work_.before[i] = work_.star[i] = work_.after[i] = twistOf(state_.bodies[i]);
}

void Stepping::beginPart(double t1) {
  partStart_ = state_.t;
  if (!parted_) beginSegment(t1);
  for (const int i : work_.active) {
    const RigidBody& body = state_.bodies[i];
    if (parted_) work_.before[i] = twistOf(body);
    memory_.pushes[i].P0 = body.P;
    memory_.pushes[i].L0 = body.L;
  }
  if (!parted_ || !divided_) return;
  ClusterPart& piece = state_.trail.back().pieces.emplace_back();
  piece.t0 = state_.t;
  piece.t1 = t1;
  piece.bodies = work_.active;
  for (const int i : work_.active) piece.start.push_back(state_.bodies[i]);
}

void Stepping::endPart(double t1) {
  for (const int i : work_.active) {
    Push& push = memory_.pushes[i];
    push.t0 = partStart_;
    push.t1 = t1;
    push.P1 = state_.bodies[i].P;
    push.L1 = state_.bodies[i].L;
  }
  if (!parted_) return endSegment(t1);
  stray(t1);
  state_.t = t1;
  if (!divided_) return;
  ClusterPart& piece = state_.trail.back().pieces.back();
  for (const int i : work_.active) piece.end.push_back(state_.bodies[i]);
}

void Stepping::endSegment(double t1) {
  Segment& segment = state_.trail.back();
  segment.end = state_.bodies;
  state_.t = t1;
  ++report_.certificate.steps;
  ++report_.certificate.evaluations;
  account(model_, state_, report_, potentialNow());
  joinStill();
}

namespace {

/// Whether nothing changes from one state to another: what still moves is lost in rounding.
bool sameState(const RigidBody& p, const RigidBody& q) {
  return p.x == q.x && p.q.coeffs() == q.q.coeffs() && p.P == q.P && p.L == q.L && p.v == q.v &&
         p.omega == q.omega;
}

bool sameForce(const Contact& p, const Contact& q) {
  return p.a == q.a && p.b == q.b && p.force == q.force && p.point.p == q.point.p &&
         p.point.separation == q.point.separation;
}

}  // namespace

/// Steps in which nothing changes, nor any force, are one stretch, from the third of them in an
/// advance on: what rests for an hour takes no memory for it.
void Stepping::joinStill() {
  std::vector<Segment>& trail = state_.trail;
  Segment& now = trail.back();
  now.still = allKept_ && !divided_ && now.pieces.empty() && now.joints.empty() &&
              std::equal(now.start.begin(), now.start.end(), now.end.begin(), sameState);
  if (!now.still || stillSteps_ == 0) {
    stillSteps_ = now.still ? 1 : 0;
    return;
  }
  Segment& before = trail[trail.size() - 2];
  const bool goesOn = std::equal(now.contacts.begin(), now.contacts.end(), before.contacts.begin(),
                                 before.contacts.end(), sameForce);
  stillSteps_ = goesOn ? stillSteps_ + 1 : 1;
  if (stillSteps_ < 3) return;
  before.t1 = now.t1;
  ++before.steps;
  state_.spareTrail.push_back(std::move(now));
  trail.pop_back();
}

/// Momenta at the end of the step: those of the forces, and what contacts changed.
[[gnu::flatten]] void Stepping::applyTwists(double h) {
  for (const int i : work_.active) {
    RigidBody& body = state_.bodies[i];
    if (body.fixed() || work_.flown[i]) continue;
    if (model_.bends(static_cast<int>(i))) {
      state_.externalImpulse += h * body.force;
      setVelocity(body, work_.after[i].head<3>(), Vec3::Zero());
      continue;
    }
    const bool halved = isHalved(i);
    if (memory_.drives->dragOf[i] >= 0 && !halved) {
      applyDragged(i, h);
      continue;
    }
    const double part = halved ? 0.5 * h : h;
    body.P += part * body.force;
    body.L += part * body.torque;
    state_.externalImpulse += part * body.force;
    if (work_.touched[i]) {
      const Vec6 change = work_.after[i] - work_.star[i];
      const Vec3 turn = change.tail<3>();
      body.P += body.M * change.head<3>();
      if (!body.particle && !turn.isZero(0.0))
        body.L += body.R * (body.Ibody * (body.R.transpose() * turn));
    }
    updateVelocities(body);
  }
}

// The rotor by the midpoint rule, in turns small enough for it: its energy stays, however fast it
// spins.
void Stepping::turn(RigidBody& body, const Vec3& L, double h) const {
  constexpr double kTurn = 0.05;  // [rad]
  constexpr int kMostTurns = 1000;
  if (body.particle || L.isZero(0.0)) return body.q.normalize();
  const double turns =
      std::min(std::ceil(h * Vec3(body.Iinv * L).norm() / kTurn), double{kMostTurns});
  const double part = h / std::max(1.0, turns);
  for (int k = 0; k < std::max(1.0, turns); ++k) {
    const Vec3 first = k == 0 ? Vec3(body.Iinv * L) : angularVelocityAt(body, body.q, L);
    const Quat middle = rotated(body.q, 0.5 * part * first);
    body.q = rotated(body.q, part * angularVelocityAt(body, middle, L)).normalized();
  }
}

[[gnu::flatten]] void Stepping::moveBodies(double h) {
  flyGroups(h);
  for (const int i : work_.active) {
    RigidBody& body = state_.bodies[i];
    if (work_.flown[i]) continue;
    if (body.fixed() && body.v.isZero(0.0) && body.omega.isZero(0.0)) continue;
    const Quat before = body.q;
    if (body.fixed()) {
      body.x += h * body.v;
      body.q = rotated(body.q, h * body.omega);
    } else if (model_.bends(static_cast<int>(i))) {
      const BendingPart& part = memory_.bendings->partWith(i);
      if (part.placed)
        body.x = part.reachedAt[memory_.bendings->pointOf[i]];
      else
        body.x += h * (body.v - work_.falls[i]);
    } else if (work_.touched[i] && work_.smooth[i]) {
      const Push& push = memory_.pushes[i];
      body.x += 0.5 * h * body.invM * (push.P0 + body.P);
      turn(body, 0.5 * (push.L0 + body.L), h);
    } else if (work_.touched[i]) {  // with the velocity that the contact problem found
      body.x += h * (body.v - work_.later[i] * body.invM * body.force - work_.falls[i]);
      turn(body, body.L - work_.later[i] * body.torque, h);
    } else {
      coast(i, h);
    }
    if (body.fixed() || work_.touched[i]) body.q.normalize();
    // What is derived follows from q and from momenta, which stay.
    if (body.q.coeffs() != before.coeffs()) updateDerived(body);
  }
}

}  // namespace tumble
