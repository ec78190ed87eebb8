#include "sim/method/stepping/stepping.h"

#include <algorithm>
#include <cmath>

#include "sim/body/force.h"
#include "sim/contact/rows.h"
#include "sim/math/rotation.h"
#include "sim/problem/cone.h"

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
      tolerance_(ContactTolerance::forSize(model.size)) {}

bool Stepping::finite() const {
  return std::all_of(state_.bodies.begin(), state_.bodies.end(), [](const RigidBody& body) {
    return body.x.allFinite() && body.q.coeffs().allFinite() && body.v.allFinite() &&
           body.omega.allFinite();
  });
}

void Stepping::stop() {
  report_.stopped = true;
  report_.reason = "the motion left the range of numbers; try a smaller stepping.step";
  state_.bodies = state_.trail.back().start;
  state_.trail.pop_back();
}

void Stepping::step() {
  const double t1 = gridTime(model_, state_.gridIndex, model_.def.stepping.step);
  const double h = t1 - state_.t;
  state_.trail.push_back(
      {.t0 = state_.t, .t1 = t1, .start = state_.bodies, .end = {}, .contacts = {}});

  sumForces(model_.def.gravity, model_.def.forces, state_.bodies);
  findNear(h);
  buildProblem(h);
  solve();
  applyImpulses(h);
  moveBodies(h);
  if (!finite()) return stop();
  project();

  recordEvents(t1);
  state_.trail.back().end = state_.bodies;
  state_.t = t1;
  ++state_.gridIndex;
  ++report_.certificate.steps;
  ++report_.certificate.evaluations;
  account(model_, state_, report_);
}

void Stepping::findNear(double h) {
  std::vector<Aabb> boxes;
  const double g = model_.def.gravity.norm();
  sweptBoxes(model_, state_.bodies, h, g, tolerance_.touch, boxes);
  state_.near = nearPairs(model_, state_, boxes);
  if (stopAtUnknownPair(model_, state_.near, report_)) return;
  contacts_.clear();
  for (std::size_t k = 0; k < state_.near.size(); ++k) {
    const auto& pair = state_.near[k];
    // As far as the two surfaces can come towards each other within the step.
    const RigidBody &b = state_.bodies[pair.first], &a = state_.bodies[pair.second];
    double speed = (a.v - b.v).norm();
    for (int i : {pair.first, pair.second}) {
      const double radius = boundingRadius(model_.shapes[i]);
      if (std::isfinite(radius)) speed += state_.bodies[i].omega.norm() * radius;
    }
    findNearContacts(model_, state_, k, h * speed + 2.0 * g * h * h + tolerance_.touch, contacts_,
                     report_);
  }
}

void Stepping::buildProblem(double h) {
  beginVelocityProblem(state_.bodies, problem_);
  before_ = problem_.vStar;
  for (std::size_t i = 0; i < state_.bodies.size(); ++i) {
    const RigidBody& body = state_.bodies[i];
    if (body.fixed()) continue;
    problem_.vStar[i] << body.v + h * body.invM * body.force,
        body.Iinv * (body.L + h * body.torque);
  }
  solution_.lambda.clear();
  rebounds_.clear();
  approach_.clear();
  for (const Contact& contact : contacts_) addContact(contact, h);
}

void Stepping::addContact(const Contact& contact, double h) {
  const RigidBody &a = state_.bodies[contact.a], &b = state_.bodies[contact.b];
  const ContactPoint& c = contact.point;
  Row normal = pointRow(state_.bodies, contact.a, contact.b, c.p, c.n, 0.0);

  // A gap may be closed by the end of the step and no further. The step after, on the surface, the
  // hit rebounds with the speed at which it came: so a bounce starts where it should and gains no
  // height.
  const auto along = [&](const std::vector<Vec6>& v) {
    return normal.linear.dot(v[contact.a].head<3>() - v[contact.b].head<3>()) +
           normal.angularA.dot(v[contact.a].tail<3>()) +
           normal.angularB.dot(v[contact.b].tail<3>());
  };
  const double vrel = along(before_);
  const auto arrival = state_.arrivals.find({contact.a, contact.b, c.feature});
  const double known = arrival == state_.arrivals.end() ? 0.0 : arrival->second.approach;
  const double approach = std::max(known, -vrel);
  const bool arrived = c.separation <= tolerance_.touch;
  const bool hits = c.separation + h * along(problem_.vStar) < 0.0;
  const bool rebounds = arrived && hits && approach > 0.0 && contact.restitution > 0.0;
  normal.bias = rebounds ? -contact.restitution * approach : std::max(0.0, c.separation) / h;
  approach_.push_back(approach);
  rebounds_.push_back(rebounds && normal.bias < landingSpeed());

  const auto warm = state_.warm.find({contact.a, contact.b, c.feature});
  const Vec3 guess = warm == state_.warm.end() ? Vec3(Vec3::Zero()) : warm->second;
  Cone cone{.kind = ConeKind::Push, .row = static_cast<int>(problem_.rows.size())};
  problem_.rows.push_back(normal);
  solution_.lambda.push_back(std::max(0.0, guess.dot(c.n)));
  if (contact.friction > 0.0) {
    cone.kind = ConeKind::Friction;
    cone.mu = contact.friction;
    Vec3 t1, t2;
    tangents(c.n, slipVelocity(a, b, c), t1, t2);
    for (const Vec3& t : {t1, t2}) {
      problem_.rows.push_back(pointRow(state_.bodies, contact.a, contact.b, c.p, t, 0.0));
      solution_.lambda.push_back(guess.dot(t));
    }
  }
  problem_.cones.push_back(cone);
}

void Stepping::solve() {
  const SteppingSettings& settings = model_.def.stepping;
  constexpr int kSweeps = 2000;  // more bring little; what is left is in the certificate
  const SolveReport solved =
      solveByIslands(*findSolver(settings.solver), problem_,
                     {.tolerance = settings.tolerance, .maxIterations = kSweeps}, solution_);
  Certificate& books = report_.certificate;
  books.max_complementarity = std::max(books.max_complementarity, solved.residual);
  if (solved.status != SolveStatus::Solved)
    report_.note("some steps were left above the tolerance; max_complementarity has the worst");
}

void Stepping::applyImpulses(double h) {
  Certificate& books = report_.certificate;
  std::vector<RigidBody>& bodies = state_.bodies;
  touched_.assign(bodies.size(), 0);
  impulse_.assign(contacts_.size(), Vec3::Zero());
  const double powerBefore = powerOfForces(model_.def.forces, bodies);
  for (RigidBody& body : bodies) {
    if (body.fixed()) continue;
    body.P += h * body.force;
    body.L += h * body.torque;
    state_.externalImpulse += h * body.force;
  }

  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    const Cone& cone = problem_.cones[i];
    for (int r = cone.row; r < cone.row + coneRows(cone.kind); ++r) {
      const Row& row = problem_.rows[r];
      const double lambda = solution_.lambda[r];
      impulse_[i] += lambda * row.linear;
      // Work over the step is λ times the mean of the velocities before and after.
      const Vec6 a = 0.5 * (before_[row.a] + solution_.v[row.a]);
      const Vec6 b = 0.5 * (before_[row.b] + solution_.v[row.b]);
      const double ofA = row.linear.dot(a.head<3>()) + row.angularA.dot(a.tail<3>());
      const double ofB = -row.linear.dot(b.head<3>()) + row.angularB.dot(b.tail<3>());
      (r == cone.row ? books.energy_lost_impact : books.energy_lost_friction) -=
          lambda * (ofA + ofB);
      if (bodies[row.a].fixed()) books.work_of_forces -= lambda * ofA;
      if (bodies[row.b].fixed()) books.work_of_forces -= lambda * ofB;
    }
    if (impulse_[i].isZero(0.0)) continue;
    applyImpulse(bodies[contact.a], contact.point.p, impulse_[i]);
    applyImpulse(bodies[contact.b], contact.point.p, -impulse_[i]);
    touched_[contact.a] = touched_[contact.b] = 1;
    if (bodies[contact.b].fixed()) state_.externalImpulse += impulse_[i];
    if (bodies[contact.a].fixed()) state_.externalImpulse -= impulse_[i];
  }
  for (RigidBody& body : bodies) updateDerived(body);
  books.work_of_forces += 0.5 * h * (powerBefore + powerOfForces(model_.def.forces, bodies));
}

void Stepping::coast(RigidBody& body, const Vec3& before, double h) const {
  // The parabola, where the force is constant; a spring must not be met with the mean velocity,
  // which would feed its oscillation.
  const auto pulls = [&](const Force& force) {
    const Spring* spring = std::get_if<Spring>(&force);
    return spring && (&state_.bodies[spring->a] == &body ||
                      (spring->b != kNoBody && &state_.bodies[spring->b] == &body));
  };
  const bool sprung = std::any_of(model_.def.forces.begin(), model_.def.forces.end(), pulls);
  body.x += sprung ? Vec3(h * body.v) : Vec3(0.5 * h * (before + body.v));

  // The rotor by the midpoint rule, in turns small enough for it.
  constexpr double kTurn = 0.05;  // [rad]
  constexpr int kMostTurns = 1000;
  const double turns = std::min(std::ceil(h * body.omega.norm() / kTurn), double{kMostTurns});
  const double part = h / std::max(1.0, turns);
  RigidBody middle = body;
  middle.L -= 0.5 * h * body.torque;
  for (int k = 0; k < std::max(1.0, turns); ++k) {
    middle.q = body.q;
    updateDerived(middle);
    middle.q = rotated(body.q, 0.5 * part * middle.omega);
    updateDerived(middle);
    body.q = rotated(body.q, part * middle.omega).normalized();
  }
}

void Stepping::moveBodies(double h) {
  for (std::size_t i = 0; i < state_.bodies.size(); ++i) {
    RigidBody& body = state_.bodies[i];
    if (body.fixed() && body.v.isZero(0.0) && body.omega.isZero(0.0)) continue;
    if (touched_[i] || body.fixed()) {  // as the contact problem foresaw it
      body.x += h * body.v;
      body.q = rotated(body.q, h * body.omega);
    } else {
      coast(body, before_[i].head<3>(), h);
    }
    body.q.normalize();
    updateDerived(body);
  }
}

}  // namespace tumble
