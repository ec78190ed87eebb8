#include "sim/method/course/course.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collide/collide.h"
#include "sim/math/root.h"

namespace tumble {
namespace {

/// Events that are located exactly come out of a store of kBackUps, which every step refills by
/// kRefill; beyond, and after kPatience events in a row that move time by nothing, an event may be
/// seen late by a share kLate of the step.
constexpr int kBackUps = 400, kRefill = 20, kPatience = 50;
constexpr double kLate = 0.05;
/// Share of the slack by which a pair that has used it up may sink on.
constexpr double kSink = 1e-3;

/// Stands in where contacts do not offer what the chosen integrator needs.
constexpr const char* kStandIn = "rk4";

bool allFinite(std::span<const double> y) {
  return std::all_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

void checkCourse(const Model& model, std::span<const RigidBody> bodies) {
  const CourseSettings& course = model.def.course;
  const Integrator* row = findIntegrator(course.integrator);
  if (!row)
    throw Refusal("course.integrator", "no integrator is called \"" + course.integrator + "\"");
  requireStep("course.step", course.step, model.def.duration);
  if (course.plan != "backstep")
    throw Refusal("course.plan", "no plan is called \"" + course.plan + "\"; there is: backstep");
  if (course.contact != "constraint")
    throw Refusal("course.contact",
                  "no contact model is called \"" + course.contact + "\"; there is: constraint");
  if (course.order < 1 || course.order > kHighestOrder)
    throw Refusal("course.order",
                  "an order must be a whole number from 1 to " + std::to_string(kHighestOrder));
  if (!(course.tolerance >= kLeastTolerance && course.tolerance <= 1.0))
    throw Refusal("course.tolerance", "a tolerance must be a number from 1e-14 to 1");
  if (course.attitude != "quaternion" && course.attitude != "matrix")
    throw Refusal("course.attitude", "no attitude is called \"" + course.attitude +
                                         "\"; there are: quaternion, matrix");
  const CourseSystem system(model, bodies);
  if (const std::string_view lack = missing(system.offers(), row->needs); !lack.empty())
    throw Refusal("course.integrator", "\"" + course.integrator + "\" needs " + std::string(lack) +
                                           ", which this scene does not offer");
}

void advanceCourse(const Model& model, State& state, double t_end, Report& report) {
  Course course(model, state, report);
  if (state.trail.empty()) course.settle();
  while (state.t < t_end && !report.stopped) {
    course.move();
    course.settle();
    account(model, state, report);
  }
}

void lookCourse(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
                std::vector<Contact>& contacts) {
  // The last stretch that begins at or before t; at the end of the trail, the state itself.
  const Segment* segment = nullptr;
  for (const Segment& s : state.trail)
    if (s.t0 <= t) segment = &s;
  const bool now = !segment || t >= state.t;
  bodies = now ? state.bodies : segment->start;
  CourseSystem system(model, bodies);
  system.begin(now ? state.lasting : segment->contacts);
  if (!now && t > segment->t0) {
    std::vector<double> y(system.size());
    system.pack(bodies, y);
    CourseSteppers(model, system).of(system).step(system, segment->t0, t - segment->t0, y);
    system.unpack(y, bodies);
  }
  system.findForces(bodies);
  contacts = system.contacts();
}

CourseSteppers::CourseSteppers(const Model& model, const System& system)
    : row_(*findIntegrator(model.def.course.integrator)),
      chosen_(row_.make(system.size(), {model.def.course.order, model.def.course.tolerance})),
      standIn_(findIntegrator(kStandIn)->make(system.size())) {}

Course::Course(const Model& model, State& state, Report& report)
    : model_(model),
      state_(state),
      report_(report),
      tolerance_(ContactTolerance::forSize(model.size)),
      system_(model, state.bodies),
      steppers_(model, system_),
      rest_(pullTime(model)),
      trial_(state.bodies) {}

void Course::settle() {
  if (report_.stopped) return;
  const std::size_t firstEvent = report_.events.size();
  findTouching();
  stopUntouchable();
  if (report_.stopped) return;
  if (collides()) {
    respond();
    findNear();  // what was hit has a new way before it
  }
  chooseLasting();
  sortEvents(report_, firstEvent);
}

void Course::findNear() {
  const double h = gridTime(model_, state_.gridIndex, model_.def.course.step) - state_.t;
  sumForces(model_.def.gravity, model_.def.forces, state_.bodies);
  std::vector<Aabb> boxes;
  sweptBoxes(model_, state_.bodies, h, accelerationScale(), tolerance_.touch, boxes);
  state_.near = nearPairs(model_, state_, boxes);
  stopAtUnknownPair(model_, state_.near, report_);
}

void Course::findTouching() {
  findNear();
  touching_.clear();
  for (const auto& pair : state_.near)
    findContacts(model_, state_.bodies, pair, tolerance_.touch, touching_);
  for (const Contact& c : touching_)
    report_.certificate.max_penetration =
        std::max(report_.certificate.max_penetration, -c.point.separation);
}

void Course::stopUntouchable() {
  const bool matrix = model_.def.course.attitude == "matrix";
  const auto held = [&](int body) {
    return std::any_of(model_.pivots.begin(), model_.pivots.end(),
                       [&](const Pivot& pivot) { return pivot.body == body; });
  };
  for (const Contact& c : touching_) {
    if (!matrix && !held(c.a) && !held(c.b)) continue;
    const std::string &a = model_.def.bodies[c.a].name, &b = model_.def.bodies[c.b].name;
    report_.stopped = true;
    report_.reason = "\"" + a + "\" touches \"" + b + "\" at " + shortNumber(state_.t) + " s; " +
                     (matrix ? "with attitude = \"matrix\" nothing may touch"
                             : "a body with a pivot has no contacts");
    return;
  }
}

double Course::accelerationScale() const {
  double a = model_.def.gravity.norm();
  for (const RigidBody& body : state_.bodies) a = std::max(a, body.invM * body.force.norm());
  return a;
}

bool Course::wasLasting(int a, int b) const {
  return std::any_of(state_.lasting.begin(), state_.lasting.end(),
                     [&](const Contact& c) { return c.a == a && c.b == b; });
}

void Course::move() {
  const double step = model_.def.course.step;
  const double grid = gridTime(model_, state_.gridIndex, step);
  state_.trail.push_back(
      {.t0 = state_.t, .t1 = grid, .start = state_.bodies, .end = {}, .contacts = state_.lasting});

  system_.begin(state_.lasting);
  if (steppers_.stands(system_))
    report_.note("while contacts last, rk4 stands in for an integrator that cannot have them");
  y0_.resize(system_.size());
  y_.resize(system_.size());
  system_.pack(state_.bodies, y0_);

  // A pair may come as close as touching, to a slack, or stay as deep as rounding has brought it.
  // The slack must not be granted anew at each event, or every bounce would start a little deeper.
  gaps_.clear();
  floor_.clear();
  allowanceNow_ = std::numeric_limits<double>::infinity();
  for (const auto& [b, a] : state_.near) {
    const double now = separation(model_.shapes[a], state_.bodies[a].pose(), model_.shapes[b],
                                  state_.bodies[b].pose());
    const double slack = wasLasting(a, b) ? tolerance_.drift : tolerance_.root;
    gaps_.push_back(now);
    floor_.push_back(std::min(-slack, now - kSink * slack));
    allowanceNow_ = std::min(allowanceNow_, now - floor_.back());
  }
  for (const Contact& c : state_.lasting)
    if (c.mayStick)
      allowanceNow_ = std::min(
          allowanceNow_,
          slipVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point).dot(c.slipDirection));

  // Try as much of the step as can be foreseen; if something collides, or a slip ends, back up to
  // that instant.
  const double span = grid - state_.t;
  double h = foresee(span);
  if (const double tooFar = allowance(h); tooFar < 0.0) {
    h = backUp(h, tooFar);
    allowance(h);
  }
  commit(h < span ? state_.t + h : grid);
}

double Course::allowance(double h) {
  y_ = y0_;
  steppers_.of(system_).step(system_, state_.t, h, y_);
  if (!allFinite(y_)) return 0.0;  // commit() reports it
  system_.unpack(y_, trial_);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < state_.near.size(); ++k) {
    const auto& [b, a] = state_.near[k];
    const double gap =
        separation(model_.shapes[a], trial_[a].pose(), model_.shapes[b], trial_[b].pose());
    least = std::min(least, gap - floor_[k]);
  }
  for (Contact c : state_.lasting) {
    if (!c.mayStick) continue;
    follow(trial_[c.a], trial_[c.b], c);
    least = std::min(least, slipVelocity(trial_[c.a], trial_[c.b], c.point).dot(c.slipDirection));
  }
  return least;
}

double Course::backUp(double span, double tooFar) {
  // The width of the bracket that is left: what a clock at t can still tell apart.
  const double instant = std::max(1e-15, std::numeric_limits<double>::epsilon() * state_.t);
  const auto allowed = [&](double h) { return allowance(h); };
  const double h = findRoot(allowed, 0.0, span, allowanceNow_, tooFar, instant).lo;
  ++state_.recentBackUps;
  state_.stalled = h > instant ? 0 : state_.stalled + 1;
  if (++state_.backUpsSpent <= kBackUps && state_.stalled < kPatience) return std::max(h, instant);

  // The store is used up: from here to the end of the step events are seen late rather than never.
  report_.note("more events than a step can hold were seen late; max_penetration has the cost");
  return std::min(span, std::max(h, kLate * model_.def.course.step));
}

void Course::commit(double t1) {
  Certificate& books = report_.certificate;
  if (!allFinite(y_)) {
    report_.stopped = true;
    report_.reason = "the motion left the range of numbers; try a smaller course.step";
    state_.trail.pop_back();
    return;
  }
  system_.unpack(y_, state_.bodies);
  const Ledger ledger = system_.ledger(y_);
  books.work_of_forces += ledger.work;
  books.energy_lost_friction += ledger.friction;
  books.max_complementarity = std::max(books.max_complementarity, system_.residual());
  if (system_.unsolved())
    report_.note("some resting forces were left unsolved; max_complementarity has the worst");
  state_.externalImpulse += ledger.impulse;
  state_.trail.back().t1 = t1;
  state_.t = t1;
  ++books.steps;
  books.evaluations += system_.evaluations() - counted_;
  counted_ = system_.evaluations();
  if (t1 == gridTime(model_, state_.gridIndex, model_.def.course.step)) {
    ++state_.gridIndex;
    state_.recentImpacts.clear();
    state_.recentBackUps = 0;
    state_.backUpsSpent = std::max(0, std::min(state_.backUpsSpent, kBackUps) - kRefill);
  }
}

}  // namespace tumble
