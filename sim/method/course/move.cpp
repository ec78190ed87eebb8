// One stretch of motion: try a step; if something happens inside it, back up to that instant.
#include <algorithm>
#include <cmath>

#include "sim/collide/collide.h"
#include "sim/contact/jam.h"
#include "sim/joint/joint_rows.h"
#include "sim/math/root.h"
#include "sim/method/came_apart.h"
#include "sim/method/course/course.h"

namespace tumble {
namespace {

/// The store of located events is refilled by kRefill in every step; beyond it, and after kPatience
/// events in a row that move time by nothing, an event may be seen late by a share kLate of the
/// step.
constexpr int kRefill = 20, kPatience = 50;
constexpr double kLate = 0.05;
/// What is followed less closely has a store so many times smaller.
constexpr int kHasty = 10;
/// Share of the slack by which a pair that has used it up may sink on.
constexpr double kSink = 1e-3;
/// Part of the way to its floor up to which nothing has a say in where another thing ends.
constexpr double kFar = 0.5;
/// Of the overlap that dates a collision, and of the way to a floor: what is so near has come to
/// it.
constexpr double kThere = 0.1;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool allFinite(std::span<const double> y) {
  return std::all_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

void Course::begin(double grid) {
  state_.trail.push_back(
      {.t0 = state_.t, .t1 = grid, .start = state_.bodies, .end = {}, .contacts = state_.lasting});
  state_.trail.back().limits = state_.limits;

  system_.begin(state_.lasting, state_.limits);
  system_.effort = state_.effort;
  steppers_.hurry = state_.effort.hurries();
  if (!steppers_.hurry) system_.effort.most = std::min(state_.effort.most, state_.effort.close);
  if (steppers_.hurry)
    report_.note("more than the exact method can follow closely went on in steps of rk4");
  else if (steppers_.stands(system_))
    report_.note("while contacts last, rk4 stands in for an integrator that cannot have them");
  y0_.resize(system_.size());
  y_.resize(system_.size());
  system_.pack(state_.bodies, y0_);
  yAllowed_ = y0_;
  allowed_ = 0.0;
}

void Course::move() {
  const double grid = gridTime(model_, state_.gridIndex, model_.def.course.step);
  const double span = grid - state_.t;
  begin(grid);
  if (rests()) {
    y_ = y0_;
    state_.trail.back().still = true;
    return commit(grid);
  }

  // Try as much of the step as can be foreseen; if something collides, or a slip ends, back up to
  // that instant.
  setFloors();
  double h = locates() ? foresee(span) : span;
  if (const double tooFar = allowance(h); tooFar < 0.0) {
    noteMissteps(trial_, state_.t + h);
    h = backUp(h, tooFar);
    allowance(h);
    closeMissteps(trial_, state_.t + h);
  }
  if (!contact_.impulses) h = firstTouch(h);
  if (system_.effort.spent() && system_.effort.most < state_.effort.most) {  // the same, in a hurry
    state_.effort.done = system_.effort.done;
    state_.trail.pop_back();
    return move();
  }
  // Where lasting contacts have no forces, an impulse ends a slip, and all begins anew.
  if (system_.residual() > kNoForces && endJam()) {
    state_.effort.done = system_.effort.done;
    state_.trail.pop_back();
    return;
  }
  commit(h < span ? state_.t + h : grid);
}

void Course::setFloors() {
  gaps_.clear();
  floors_.clear();
  const auto add = [&](double height, double way) {
    floors_.push_back({height, way, kThere * std::min(tolerance_.root, way)});
  };
  const auto setFloor = [&](double now, double slack) {
    const double floor = locates() ? std::min(-slack, now - kSink * slack) : -kInfinity;
    add(floor, now - floor);
  };
  for (const auto& [b, a] : state_.near) {
    gaps_.push_back(separation(model_.shapes[a], state_.bodies[a].pose(), model_.shapes[b],
                               state_.bodies[b].pose()));
    setFloor(gaps_.back(), wasLasting(a, b) ? tolerance_.drift : tolerance_.root);
  }
  // Limits of joints are surfaces too.
  lookAtLimits(state_.bodies);
  for (const JointRow& row : limits_) {
    const double now = row.arm * row.gap;
    setFloor(now, now <= tolerance_.touch ? tolerance_.drift : tolerance_.root);
  }
  for (const Contact& c : state_.lasting)
    if (c.mayStick) add(0.0, slipAlong(state_.bodies, c));
  allowanceNow_ = kFar;
  for (const Floor& floor : floors_)
    allowanceNow_ = std::min(allowanceNow_, floor.leeway(floor.height + floor.now));
}

double Course::slipAlong(std::span<const RigidBody> bodies, const Contact& c) {
  return slipVelocity(bodies[c.a], bodies[c.b], c.point).dot(c.slipDirection);
}

double Course::Floor::leeway(double value) const {
  if (!std::isfinite(height)) return kFar;
  const double left = value - height;
  if (std::abs(left) <= there) return 0.0;
  return std::min(kFar, now > 0.0 ? left / now : left);
}

void Course::lookAtLimits(std::span<const RigidBody> bodies) {
  limits_.clear();
  std::vector<JointRow> rows;
  for (const Joint& joint : model_.joints) {
    jointRows(bodies, joint, rows);
    for (const JointRow& row : rows)
      if (row.limit >= 0) limits_.push_back(row);
  }
}

double Course::allowance(double h) {
  const bool goesOn = steppers_.adaptive(system_) && h >= allowed_;
  y_ = goesOn ? yAllowed_ : y0_;
  const double from = goesOn ? allowed_ : 0.0;
  if (h > from) steppers_.of(system_).step(system_, state_.t + from, h - from, y_);
  if (!allFinite(y_)) return 0.0;  // commit() reports it
  system_.unpack(y_, trial_);
  double least = kFar;
  auto floor = floors_.begin();
  for (std::size_t k = 0; k < state_.near.size(); ++k, ++floor) {
    if (!std::isfinite(floor->height)) continue;
    const auto& [b, a] = state_.near[k];
    // A gap is at least 1/√3 of the distance: a plane this wide leaves the least as it is.
    const double enough = std::max(0.0, least * floor->now + floor->height);
    if (planeShowsApart(model_, state_, trial_, k, 2.0 * enough, report_)) continue;
    least = std::min(least, floor->leeway(separation(model_.shapes[a], trial_[a].pose(),
                                                     model_.shapes[b], trial_[b].pose())));
  }
  if (!limits_.empty()) lookAtLimits(trial_);
  for (const JointRow& row : limits_) least = std::min(least, (floor++)->leeway(row.arm * row.gap));
  for (Contact c : state_.lasting) {
    if (!c.mayStick) continue;
    follow(trial_[c.a], trial_[c.b], c);
    least = std::min(least, (floor++)->leeway(slipAlong(trial_, c)));
  }
  if (goesOn && least >= 0.0) {
    allowed_ = h;
    yAllowed_ = y_;
  }
  return least;
}

double Course::backUp(double span, double tooFar) {
  const double instant = instantNear(state_.t);
  const auto allowed = [&](double h) { return allowance(h); };
  const double h = findRoot(allowed, 0.0, span, allowanceNow_, tooFar, instant, 0.0).lo;
  ++state_.course.recentBackUps;
  state_.course.stalled = h > instant ? 0 : state_.course.stalled + 1;
  const int store = steppers_.hurry ? kBackUps / kHasty : kBackUps;
  if (++state_.course.backUpsSpent <= store && state_.course.stalled < kPatience)
    return std::max(h, instant);

  // The store is used up: from here to the end of the step events are seen late rather than never.
  report_.note("more events than a step can hold were seen late; max_penetration has the cost");
  return std::min(span, std::max(h, kLate * model_.def.course.step));
}

void Course::stop(const std::string& why) {
  report_.stopped = true;
  report_.reason = why;
  state_.trail.pop_back();
}

void Course::commit(double t1) {
  Certificate& books = report_.certificate;
  state_.effort.done = system_.effort.done;
  if (!allFinite(y_))
    return stop(state_.effort.spent()
                    ? spentBy(model_, state_)
                    : "the motion left the range of numbers; try a smaller course.step");
  if (!model_.joints.empty()) {
    system_.unpack(y_, trial_);
    if (const std::string apart = cameApart(model_, trial_, "course.step"); !apart.empty())
      return stop(apart);
  }
  system_.unpack(y_, state_.bodies);
  const Ledger ledger = system_.ledger(y_);
  books.work_of_forces += ledger.work;
  (contact_.impulses ? books.energy_lost_friction : books.energy_lost_impact) += ledger.taken;
  books.max_complementarity = std::max(books.max_complementarity, system_.residual());
  if (system_.unsolved())
    report_.note("some resting forces were left unsolved; max_complementarity has the worst");
  state_.externalImpulse += ledger.impulse;
  state_.trail.back().t1 = t1;
  state_.trail.back().end = state_.bodies;
  state_.t = t1;
  jams_ = 0;
  ++books.steps;
  books.evaluations += system_.evaluations() - counted_;
  counted_ = system_.evaluations();
  if (t1 == gridTime(model_, state_.gridIndex, model_.def.course.step)) {
    ++state_.gridIndex;
    state_.course.recentImpacts.clear();
    state_.course.recentBackUps = 0;
    const int part = steppers_.hurry ? kHasty : 1;
    state_.course.backUpsSpent =
        std::max(0, std::min(state_.course.backUpsSpent, kBackUps / part) - kRefill / part);
  }
}

}  // namespace tumble
