#include "sim/method/exact/exact.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/collide/collide.h"
#include "sim/method/exact/approach.h"

namespace tumble {
namespace {

/// The shortest digits that give the same number again, the same in every locale.
std::string digits(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// The shape itself where bodies can meet it; for any other the box around it, in the body frame.
Shape hullOf(const Shape& shape) {
  if (canCollide(shape, Sphere{})) return shape;
  const Aabb box = boundingBox(shape, Pose{});
  return Box{box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs())};
}

/// Whether a force leaves the acceleration of a body constant and its spin free.
bool fliesUnder(const Force& force) {
  if (std::holds_alternative<UniformWind>(force)) return true;
  const PointForce* point = std::get_if<PointForce>(&force);
  return point && point->point_B.isZero(0.0);
}

/// Whether a force that bodies fly under acts on this one.
bool pushes(const Force& force, int body) {
  if (const PointForce* point = std::get_if<PointForce>(&force)) return point->body == body;
  const UniformWind* wind = std::get_if<UniformWind>(&force);
  return wind && (wind->body == kNoBody || wind->body == body);
}

/// Every body at t, by its flight or as a top.
void bodiesAt(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies) {
  const std::vector<Flight>& flights = state.trail.back().flights;
  for (std::size_t i = 0; i < bodies.size(); ++i) flights[i].at(t, bodies[i]);
  for (std::size_t k = 0; k < state.tops.size(); ++k)
    state.tops[k].at(t, bodies[model.pivots[k].body]);
}

bool isFinite(const RigidBody& body) {
  return body.x.allFinite() && body.q.coeffs().allFinite() && body.v.allFinite() &&
         body.omega.allFinite();
}

}  // namespace

void checkExact(const Model& model, std::span<const RigidBody>) {
  const std::vector<Force>& forces = model.def.forces;
  for (std::size_t k = 0; k < forces.size(); ++k)
    if (!fliesUnder(forces[k]))
      throw Refusal("forces[" + std::to_string(k) + "]",
                    "the exact method flies bodies under gravity, uniform wind and forces at their "
                    "centre of mass; for this force use method \"course\" or \"stepping\"");
  for (const Pivot& pivot : model.pivots)
    for (std::size_t k = 0; k < forces.size(); ++k)
      if (pushes(forces[k], pivot.body))
        throw Refusal("forces[" + std::to_string(k) + "]",
                      "the exact method turns \"" + model.def.bodies[pivot.body].name +
                          "\" about its pivot under gravity alone; for this force use method "
                          "\"course\"");
}

void advanceExact(const Model& model, State& state, double t_end, Report& report) {
  Exact exact(model, state, report);
  if (state.trail.empty()) exact.takeOff();
  for (HeavyTop& top : state.tops) top.forget(state.lookedAt);
  while (state.t < t_end && !state.touch && !report.stopped) exact.fly();
  if (state.touch && state.touch->t <= t_end) exact.stop();
  state.lookedAt = t_end;
}

void lookExact(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
               std::vector<Contact>& contacts) {
  if (state.trail.empty()) {  // nothing has moved yet
    bodies = state.bodies;
    contacts.clear();
    return;
  }
  const Segment& segment = state.trail.back();
  if (bodies.size() != segment.start.size()) bodies = segment.start;
  bodiesAt(model, state, t, bodies);
  contacts.clear();
}

Exact::Exact(const Model& model, State& state, Report& report)
    : model_(model), state_(state), report_(report) {}

void Exact::takeOff() {
  // What acts besides gravity stays the same all the way.
  sumForces(Vec3::Zero(), model_.def.forces, state_.bodies);
  Segment segment;
  segment.start = state_.bodies;
  segment.flights.reserve(state_.bodies.size());
  for (const RigidBody& body : state_.bodies) {
    const Vec3 acceleration =
        body.fixed() ? Vec3(Vec3::Zero()) : Vec3(model_.def.gravity + body.invM * body.force);
    segment.flights.emplace_back(body, acceleration, 0.0);
    state_.paths.push_back({body.x, body.v, acceleration});
  }
  state_.trail.push_back(std::move(segment));
  for (const Pivot& pivot : model_.pivots) {
    state_.tops.emplace_back(state_.bodies[pivot.body], pivot, model_.def.gravity, 0.0);
    state_.paths[pivot.body] = {pivot.p, Vec3::Zero(), Vec3::Zero()};
  }
  state_.window = model_.def.duration;
  for (const Shape& shape : model_.shapes) state_.hulls.push_back(hullOf(shape));
  report_.certificate.steps = model_.count();
  report_.certificate.evaluations = 1;
}

void Exact::fly() {
  choosePairs();
  spinTops();
  if (report_.stopped) return;
  double t1 = t1_;
  for (const int plane : planes_)
    for (const int body : finite_)
      if (!model_.fixed(body)) lookFor(std::minmax(plane, body), t1);
  for (const Pair& pair : pairs_) lookFor(pair, t1);
  moveTo(t1);
}

void Exact::lookFor(Pair pair, double& t1) {
  const auto flyer = [&](int i) -> Flyer {
    Flyer flyer{&state_.trail.back().flights[i], &state_.paths[i], &state_.hulls[i],
                &state_.bodies[i]};
    for (std::size_t k = 0; k < state_.tops.size(); ++k)
      if (model_.pivots[k].body == i) flyer.top = &state_.tops[k];
    return flyer;
  };
  const auto [b, a] = pair;
  const double touch = ContactTolerance::forSize(model_.size).touch;
  Approach approach(flyer(a), flyer(b), touch);
  if (const auto t = approach.firstTouch(state_.t, t1, state_.t == 0.0)) {
    state_.touch = {*t, a, b};
    t1 = *t;
  }
}

void Exact::spinTops() {
  for (std::size_t k = 0; k < state_.tops.size() && !report_.stopped; ++k) {
    if (state_.tops[k].reach(t1_)) continue;
    report_.stopped = true;
    report_.reason = "\"" + model_.def.bodies[model_.pivots[k].body].name +
                     "\" leaves the range of numbers before t = " + digits(t1_) + " s";
  }
}

void Exact::moveTo(double t) {
  bodiesAt(model_, state_, t, state_.bodies);
  for (int i = 0; i < model_.count(); ++i) {
    if (isFinite(state_.bodies[i])) continue;
    report_.stopped = true;
    report_.reason = "\"" + model_.def.bodies[i].name +
                     "\" leaves the range of numbers before t = " + digits(t) + " s";
    return;
  }
  state_.t = t;
  state_.trail.back().t1 = t;
  keepBooks(t);
}

void Exact::keepBooks(double t) {
  const Segment& segment = state_.trail.back();
  state_.externalImpulse.setZero();
  double work = 0.0;
  for (std::size_t i = 0; i < segment.start.size(); ++i) {
    const RigidBody& start = segment.start[i];
    if (start.fixed()) continue;
    const Parabola& path = state_.paths[i];
    state_.externalImpulse += t * (start.M * path.g);
    if (model_.def.bodies[i].pivot_B)  // the pivot gives what momentum it gains, and no work
      state_.externalImpulse += state_.bodies[i].P - start.P;
    work += t * start.force.dot(path.v0 + 0.5 * t * path.g);  // none for a top
  }
  report_.certificate.work_of_forces = work;
  account(model_, state_, report_);
}

void Exact::stop() {
  const auto [t, a, b] = *state_.touch;
  const bool known = canCollide(model_.shapes[a], model_.shapes[b]);
  report_.stopped = true;
  report_.reason = "\"" + model_.def.bodies[a].name +
                   (known ? "\" touches \"" : "\" comes near \"") + model_.def.bodies[b].name +
                   "\" at t = " + digits(t) + " s";
  report_.reason += known ? "; the exact method knows free flight alone, so use method \"course\" "
                            "or \"stepping\""
                          : ", and there is no contact rule for " +
                                std::string(shapeName(model_.shapes[a])) + " and " +
                                std::string(shapeName(model_.shapes[b])) + "; keep them apart";
}

}  // namespace tumble
