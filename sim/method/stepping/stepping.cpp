#include "sim/method/stepping/stepping.h"

#include <algorithm>
#include <cmath>

#include "sim/body/force.h"
#include "sim/math/rotation.h"

namespace tumble {
void checkStepping(const Model& model, std::span<const RigidBody> /*bodies*/) {
  const SteppingSettings& stepping = model.def.stepping;
  if (!findSolver(stepping.solver))
    throw Refusal("stepping.solver", "no solver is called \"" + stepping.solver + "\"");
  requireStep("stepping.step", stepping.step, model.def.duration);
  if (!(stepping.tolerance > 0.0) || !std::isfinite(stepping.tolerance))
    throw Refusal("stepping.tolerance", "a tolerance must be a positive number");
  if (!model.pivots.empty())
    throw Refusal("bodies[" + std::to_string(model.pivots[0].body) + "].pivot_body",
                  "\"stepping\" knows no pivots; take method = \"course\" or leave it out");
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
      solver_(*findSolver(model.def.stepping.solver)) {
  if (!memory_.drives) memory_.drives = drivesOf(model, state.bodies);
}

bool Stepping::finite() const {
  return std::all_of(state_.bodies.begin(), state_.bodies.end(), [](const RigidBody& body) {
    return body.x.allFinite() && body.q.coeffs().allFinite() && body.v.allFinite() &&
           body.omega.allFinite();
  });
}

void Stepping::stop(const std::string& what) {
  report_.stopped = true;
  report_.reason = what;
  state_.bodies = state_.trail.back().start;
  state_.trail.pop_back();
}

void Stepping::step() {
  const double t0 = state_.t, t1 = gridTime(model_, state_.gridIndex, model_.def.stepping.step);
  const double whole = lengthTo(t1), h = whole / memory_.parts;
  for (int k = 1; k <= memory_.parts && !report_.stopped; ++k)
    stepTo(k == memory_.parts ? t1 : t0 + k * h, h);
  if (report_.stopped) return;
  ++state_.gridIndex;
  divideNext(whole);
}

/// In as many parts as impacts ask for: first for every hit, then for those that rebound for longer
/// than a step, while the pairs of bodies that could be looked at are few.
void Stepping::stepTo(double t1, double h) {
  constexpr int kFew = 2, kMany = 16, kBodies = 256;
  constexpr double kPairs = 2e4;
  const int n = static_cast<int>(std::count_if(model_.solid.begin(), model_.solid.end(),
                                               [&](int i) { return !model_.fixed(i); }));
  const int every = std::clamp(kBodies / model_.count(), kFew, kMany);
  const int most = std::max(every, static_cast<int>(kPairs / std::max(1, n) / std::max(1, n)));
  for (int k = 0; !report_.stopped; ++k) {
    const double part = meet(h, k < every ? Hits::All : k < most ? Hits::Fast : Hits::None);
    if (part >= h) break;
    moveTo(state_.t + part, part);
    h -= part;
  }
  if (!report_.stopped) moveTo(t1, h);
}

void Stepping::moveTo(double t1, double h) {
  beginSegment(t1);
  solveSteadily(h);
  if (report_.stopped) return stop(report_.reason);
  if (!work_.crushed.empty()) return stop(work_.crushed);
  applyTwists(h);
  recordEvents(t1);
  moveBodies(h);
  bookSprings(h);
  if (!finite()) return stop("the motion left the range of numbers; try a smaller stepping.step");
  if (!project()) {
    if (const Joint* open = brokenJoint()) {
      const std::string& name = model_.def.joints[open - model_.joints.data()].name;
      return stop("joint \"" + name + "\" came apart; try a smaller stepping.step");
    }
  }
  meetJoints(h);
  endSegment(t1);
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

  const std::size_t n = state_.bodies.size();
  work_.before.resize(n + 1);  // the last is the world, for joints
  work_.star.resize(n + 1);
  work_.before[n].setZero();
  work_.star[n].setZero();
  for (std::size_t i = 0; i < n; ++i) {
    work_.before[i].head<3>() = state_.bodies[i].v;
    work_.before[i].tail<3>() = state_.bodies[i].omega;
  }
}

void Stepping::endSegment(double t1) {
  Segment& segment = state_.trail.back();
  segment.end = state_.bodies;
  state_.t = t1;
  ++report_.certificate.steps;
  ++report_.certificate.evaluations;
  account(model_, state_, report_);
}

/// Momenta at the end of the step: those of the forces, and what contacts changed.
[[gnu::flatten]] void Stepping::applyTwists(double h) {
  Certificate& books = report_.certificate;
  const double powerBefore = steadyPower();
  for (std::size_t i = 0; i < state_.bodies.size(); ++i) {
    RigidBody& body = state_.bodies[i];
    if (body.fixed() || work_.flown[i]) continue;
    if (memory_.drives->dragOf[i] >= 0) {
      applyDragged(static_cast<int>(i), h);
      continue;
    }
    body.P += h * body.force;
    body.L += h * body.torque;
    state_.externalImpulse += h * body.force;
    if (work_.touched[i]) {
      const Vec6 change = work_.after[i] - work_.star[i];
      const Vec3 turn = change.tail<3>();
      body.P += body.M * change.head<3>();
      if (!body.particle && !turn.isZero(0.0))
        body.L += body.R * (body.Ibody * (body.R.transpose() * turn));
    }
    updateVelocities(body);
  }
  books.work_of_forces += 0.5 * h * (powerBefore + steadyPower());
}

// The rotor by the midpoint rule, in turns small enough for it: its energy stays, however fast it
// spins.
void Stepping::turn(RigidBody& body, const Vec3& L, double h) const {
  constexpr double kTurn = 0.05;  // [rad]
  constexpr int kMostTurns = 1000;
  if (body.particle || L.isZero(0.0)) return body.q.normalize();
  const double turns = std::min(std::ceil(h * body.omega.norm() / kTurn), double{kMostTurns});
  const double part = h / std::max(1.0, turns);
  for (int k = 0; k < std::max(1.0, turns); ++k) {
    const Vec3 first = k == 0 ? Vec3(body.Iinv * L) : angularVelocityAt(body, body.q, L);
    const Quat middle = rotated(body.q, 0.5 * part * first);
    body.q = rotated(body.q, part * angularVelocityAt(body, middle, L)).normalized();
  }
}

[[gnu::flatten]] void Stepping::moveBodies(double h) {
  flyGroups(h);
  for (std::size_t i = 0; i < state_.bodies.size(); ++i) {
    RigidBody& body = state_.bodies[i];
    if (work_.flown[i]) continue;
    if (body.fixed() && body.v.isZero(0.0) && body.omega.isZero(0.0)) continue;
    const Quat before = body.q;
    if (body.fixed()) {
      body.x += h * body.v;
      body.q = rotated(body.q, h * body.omega);
    } else if (work_.touched[i]) {  // with the velocity that the contact problem found
      body.x += h * (body.v - work_.later[i] * body.invM * body.force);
      turn(body, body.L - work_.later[i] * body.torque, h);
    } else {
      coast(static_cast<int>(i), h);
    }
    if (body.fixed() || work_.touched[i]) body.q.normalize();
    // What is derived follows from q and from momenta, which stay.
    if (body.q.coeffs() != before.coeffs()) updateDerived(body);
  }
}

}  // namespace tumble
