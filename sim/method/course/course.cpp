#include "sim/method/course/course.h"

#include <algorithm>

namespace tumble {
namespace {

/// Stands in where contacts do not offer what the chosen integrator needs.
constexpr const char* kStandIn = "rk4";

}  // namespace

void advanceCourse(const Model& model, State& state, double t_end, Report& report) {
  Course course(model, state, report);
  if (!state.course.settled) course.settle();
  state.course.settled = true;
  while (state.t < t_end && !report.stopped) {
    course.move();
    course.settle();
    account(model, state, report);
  }
}

void lookCourse(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
                std::vector<Contact>& contacts, std::vector<JointForce>& joints) {
  // The last stretch that begins at or before t; at the end of the trail, the state itself.
  const Segment* segment = nullptr;
  for (const Segment& s : state.trail)
    if (s.t0 <= t) segment = &s;
  const bool now = !segment || t >= state.t;
  bodies = now ? state.bodies : segment->start;
  CourseSystem system(model, bodies);
  system.begin(now ? state.lasting : segment->contacts, now ? state.limits : segment->limits);
  if (!now && t > segment->t0 && !segment->still) {
    std::vector<double> y(system.size());
    system.pack(bodies, y);
    CourseSteppers steppers(model, system);
    steppers.hurry = state.effort.hurries();
    steppers.of(system).step(system, segment->t0, t - segment->t0, y);
    system.unpack(y, bodies);
  }
  system.findForces(bodies);
  contacts = system.contacts();
  joints = system.jointForces(bodies);
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
      plan_(*findPlan(model.def.course.plan)),
      contact_(*findContactModel(model.def.course.contact)),
      trial_(state.bodies) {}

void Course::settle() {
  if (report_.stopped) return;
  const std::size_t firstEvent = report_.events.size();
  // Detection: what is near, and the contact points of what touches.
  findTouching();
  stopUntouchable();
  if (report_.stopped) return;
  // What the plan does with positions that are not legal.
  if (!plan_.backsUp) mend();
  // Response to what collides: a discontinuity of the velocities.
  if (contact_.impulses && collides()) {
    respond();
    if (report_.stopped) return;
    findNear();  // what was hit has a new way before it
  }
  // What rests takes part in the constraint and friction forces of the next update.
  if (contact_.impulses)
    chooseLasting();
  else
    chooseSprings();
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
  for (std::size_t k = 0; k < state_.near.size(); ++k)
    findNearContacts(model_, state_, k, tolerance_.touch, touching_, report_);
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

std::optional<double> Course::slipWhereStuck(const Contact& contact) const {
  for (const Contact& c : state_.lasting)
    if (c.a == contact.a && c.b == contact.b && c.point.feature == contact.point.feature &&
        !c.sliding)
      return pullTime(model_) * c.slipPull.norm();
  return std::nullopt;
}

bool Course::wasLasting(int a, int b) const {
  return std::any_of(state_.lasting.begin(), state_.lasting.end(),
                     [&](const Contact& c) { return c.a == a && c.b == b; });
}

}  // namespace tumble
