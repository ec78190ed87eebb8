#include "sim/method/exact/exact.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/collide/collide.h"
#include "sim/method/exact/approach.h"

namespace tumble {
namespace {

/// Gap of bodies that touch, in touching distances of methods with steps.
constexpr double kTouch = 1e-2;

/// The convex parts of a body. What has none of its own is watched by the box around it.
std::vector<Convex> partsOf(const Shape& shape) {
  std::vector<Convex> parts;
  for (const PosedPart& part : convexParts(shape))
    parts.push_back({part.solid, part.pose, outlineOf(part.solid, part.pose)});
  if (!parts.empty() || !touchesAnything(shape)) return parts;
  const Aabb box = boundingBox(shape, Pose{});
  const Pose pose{0.5 * (box.lo + box.hi), Quat::Identity()};
  const Shape around = Box{0.5 * (box.hi - box.lo)};
  return {{around, pose, outlineOf(around, pose)}};
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

}  // namespace

std::string digits(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

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
  if (state.flights.empty()) exact.takeOff();
  for (HeavyTop& top : state.tops) top.forget(state.lookedAt);
  for (std::vector<Flight>& flights : state.flights) {
    auto past = flights.begin();
    while (past + 1 < flights.end() && (past + 1)->start() <= state.lookedAt) ++past;
    flights.erase(flights.begin(), past);
  }
  while (state.holds.size() > 1 && state.holds[1].t <= state.lookedAt)
    state.holds.erase(state.holds.begin());
  while (state.t < t_end && !report.stopped) exact.next(t_end);
  state.lookedAt = t_end;
}

void lookExact(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
               std::vector<Contact>& contacts) {
  contacts.clear();
  if (bodies.size() != state.bodies.size()) bodies = state.bodies;
  for (std::size_t i = 0; i < state.flights.size(); ++i) {
    const std::vector<Flight>& flights = state.flights[i];
    std::size_t k = flights.size() - 1;
    while (k > 0 && flights[k].start() > t) --k;
    flights[k].at(t, bodies[i]);
  }
  for (std::size_t k = 0; k < state.tops.size(); ++k)
    state.tops[k].at(t, bodies[model.pivots[k].body]);
  std::size_t k = state.holds.size();
  while (k > 0 && state.holds[k - 1].t > t) --k;
  if (k == 0) return;
  contacts = state.holds[k - 1].contacts;
  for (Contact& c : contacts) follow(bodies[c.a], bodies[c.b], c);
}

Exact::Exact(const Model& model, State& state, Report& report)
    : model_(model),
      state_(state),
      report_(report),
      tolerance_(ContactTolerance::forSize(model.size)) {
  // Flights end at a touch to rounding, so that little more counts as touching.
  tolerance_.touch *= kTouch;
}

void Exact::takeOff() {
  // What acts on a body stays the same all the way.
  const std::size_t n = state_.bodies.size();
  sumForces(model_.def.gravity, model_.def.forces, state_.bodies);
  state_.flights.resize(n);
  state_.flightCount.assign(n, 0);
  state_.window.length = model_.def.duration;
  for (std::size_t i = 0; i < n; ++i) {
    const RigidBody& body = state_.bodies[i];
    state_.outer.push_back(body.force);
    state_.start.push_back(body.x);
    state_.startP.push_back(body.P);
    state_.parts.push_back(partsOf(model_.shapes[i]));
    state_.flights[i].emplace_back(body, body.invM * body.force, 0.0);
  }
  for (const Pivot& pivot : model_.pivots)
    state_.tops.emplace_back(state_.bodies[pivot.body], pivot, model_.def.gravity, 0.0);
  report_.certificate.evaluations = 1;
  report_.certificate.steps = model_.count();

  // The events of t = 0, one cluster of bodies after the other.
  openWindow();
  std::vector<char> settled(n, 0);
  for (const int i : model_.solid) {
    if (settled[i] || model_.fixed(i) || report_.stopped) continue;
    const int seeds[] = {i};
    Cluster cluster = gather(0.0, seeds);
    for (const int body : cluster.bodies) settled[body] = 1;
    if (cluster.contacts.empty()) continue;
    if (collides(cluster)) respond(0.0, cluster);
    hold(0.0, cluster);
  }
  keepBooks(0.0);
}

void Exact::next(double t_end) {
  if (state_.t >= state_.window.t1) openWindow();
  if (report_.stopped) return;
  dropStale();
  const double until = std::min(t_end, state_.window.t1);
  if (!state_.queue.empty() && state_.queue.front().t <= until) {
    const State::Touch touch = state_.queue.front();
    closeRests(touch.t);
    strike(touch.t, touch.a, touch.b);
    return;
  }
  closeRests(until);
  if (until == state_.window.t1 || until == model_.def.duration) keepBooks(until);
  state_.t = until;
}

}  // namespace tumble
