#include "sim/method/exact/exact.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/collide/approach.h"
#include "sim/collide/collide.h"
#include "sim/method/exact/sustained.h"

namespace tumble {
namespace {

/// Gap of bodies that touch, in touching distances of methods with steps.
constexpr double kTouch = 1e-2;

/// The convex parts of a body. What has none of its own is watched by the box around it.
std::vector<Convex> partsOf(const Shape& shape) {
  std::vector<Convex> parts = outlinedParts(shape);
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

std::string crowdedAt(double t) {
  return "more events than can be followed crowd at t = " + digits(t) +
         " s; try method \"stepping\", or a little less restitution or friction";
}

std::string unheldAt(const Model& model, const Contact& c, double t, double deep) {
  const auto of = [&](int i) { return "\"" + model.def.bodies[i].name + "\""; };
  return "rounding drives " + of(c.a) + " " + shortNumber(deep) + " m into " + of(c.b) +
         " at t = " + shortNumber(t) +
         " s: the forces on them are too large for their masses; bring the masses of what touches "
         "closer together";
}

std::string crushedAt(const Model& model, const Contact& c, double t) {
  const int victim = model.fixed(c.a) ? c.b : c.a, other = victim == c.a ? c.b : c.a;
  return "\"" + model.def.bodies[victim].name + "\" is crushed by \"" +
         model.def.bodies[other].name + "\" at t = " + shortNumber(t) +
         " s: it has nowhere to go, and nothing that could push them apart is strong enough; give "
         "it room, or stop what moves";
}

namespace {

/// Stops where it takes too long, or where the scene may go on by a method that is better there.
void giveUp(const Model& model, const State& state, Report& report) {
  if (state.effort.spent()) {
    report.reason = spentBy(model, state);
  } else if (model.def.method == "auto" && state.exact.pace.level > 0 &&
             countMoving(state.bodies) > 1) {  // alone, one goes on well
    report.reason = "the exact method met more events than it could follow closely";
  } else {
    return;
  }
  report.stopped = true;
}

}  // namespace

void checkExact(const Model& model, std::span<const RigidBody>) {
  const std::vector<Force>& forces = model.def.forces;
  refuseWhatBends(model, "knows no closed form of what bends");
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
  std::optional<Sustained> sustained;
  if (state.exact.outer.empty()) exact.takeOff();
  for (HeavyTop& top : state.exact.tops) top.forget(state.exact.lookedAt);
  for (std::vector<Flight>& flights : state.exact.flights) {
    auto past = flights.begin();
    while (past + 1 < flights.end() && (past + 1)->start() <= state.exact.lookedAt) ++past;
    flights.erase(flights.begin(), past);
  }
  while (state.exact.holds.size() > 1 && state.exact.holds[1].t <= state.exact.lookedAt)
    state.exact.holds.erase(state.exact.holds.begin());
  while (state.t < t_end && !report.stopped) {
    if (state.exact.settled) exact.takeOff();
    state.exact.settled = false;
    if (!state.exact.sustained) {
      exact.next(t_end);
      if (!report.stopped && state.effort.spent()) giveUp(model, state, report);
    } else {
      if (!sustained) sustained.emplace(model, state, report);
      sustained->next();
      exact.closeRests(state.t);
      if (!report.stopped) giveUp(model, state, report);
    }
  }
  state.exact.lookedAt = t_end;
}

void lookExact(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
               std::vector<Contact>& contacts) {
  // At the end of such a stretch the bodies are where it left them: flights begin later.
  const bool sustained = std::any_of(state.trail.begin(), state.trail.end(),
                                     [&](const Segment& s) { return s.t0 <= t && t < s.t1; });
  if (sustained || ((state.exact.sustained || state.exact.settled) && t >= state.t))
    return lookSustained(model, state, t, bodies, contacts);
  contacts.clear();
  if (bodies.size() != state.bodies.size()) bodies = state.bodies;
  for (std::size_t i = 0; i < state.exact.flights.size(); ++i) {
    const std::vector<Flight>& flights = state.exact.flights[i];
    std::size_t k = flights.size() - 1;
    while (k > 0 && flights[k].start() > t) --k;
    flights[k].at(t, bodies[i]);
  }
  for (std::size_t k = 0; k < state.exact.tops.size(); ++k)
    state.exact.tops[k].at(t, bodies[model.pivots[k].body]);
  std::size_t k = state.exact.holds.size();
  while (k > 0 && state.exact.holds[k - 1].t > t) --k;
  if (k == 0) return;
  contacts = state.exact.holds[k - 1].contacts;
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
  const std::size_t n = state_.bodies.size();
  const double t = state_.t;
  const bool first = state_.exact.outer.empty();
  if (first) {
    // What acts on a body stays the same all the way.
    sumForces(model_.def.gravity, model_.def.forces, state_.bodies);
    for (const RigidBody& body : state_.bodies) state_.exact.outer.push_back(body.force);
    for (const Shape& shape : model_.shapes) state_.exact.parts.push_back(partsOf(shape));
    state_.exact.flights.resize(n);
    state_.exact.flightCount.assign(n, 0);
    state_.exact.bookedX.resize(n);
    state_.exact.bookedP.resize(n);
    report_.certificate.evaluations = 1;
  }
  state_.exact.window.length = model_.def.duration - t;
  for (std::size_t i = 0; i < n; ++i) {
    const RigidBody& body = state_.bodies[i];
    renew(t, static_cast<int>(i), body.invM * state_.exact.outer[i]);
    state_.exact.bookedX[i] = body.x;
    state_.exact.bookedP[i] = body.P;
  }
  state_.exact.booked = state_.exact.bookedHold = t;
  state_.exact.tops.clear();
  for (const Pivot& pivot : model_.pivots)
    state_.exact.tops.emplace_back(state_.bodies[pivot.body], pivot, model_.def.gravity, t);
  openWindow();
  if (!report_.stopped) settle();
  if (report_.stopped) return;
  if (state_.exact.sustained) return keepBooks(t);  // those that fly have been looked at elsewhere
  openWindow();                                     // contacts that lasted need not last any more
  if (!state_.exact.holds.empty() && state_.exact.holds.back().t < t)
    state_.exact.holds.push_back({t, state_.lasting});
  keepBooks(t);
}

void Exact::settle() {
  // What comes from a stretch in contact, or from a scene, touches less closely than what flew
  // here.
  const double touch = tolerance_.touch;
  tolerance_.touch = ContactTolerance::forSize(model_.size).touch;
  const auto held = [&](int body) {
    return std::any_of(state_.lasting.begin(), state_.lasting.end(),
                       [&](const Contact& c) { return c.a == body || c.b == body; });
  };
  std::vector<char> settled(state_.bodies.size(), 0);
  const std::size_t firstEvent = report_.events.size();
  ends_.clear();
  for (const int i : model_.solid) {
    if (settled[i] || model_.fixed(i) || report_.stopped) continue;
    const int seeds[] = {i};
    Cluster cluster = gather(state_.t, seeds);
    for (const int body : cluster.bodies) settled[body] = 1;
    noteOverlaps(cluster);
    if (cluster.contacts.empty() && !held(i)) continue;
    if (collides(cluster)) respond(state_.t, cluster);
    if (report_.stopped) break;
    hold(state_.t, cluster);
  }
  tolerance_.touch = touch;
  sortEvents(report_, firstEvent);
}

void Exact::next(double t_end) {
  if (state_.t >= state_.exact.window.t1) openWindow();
  if (report_.stopped) return;
  dropStale();
  const double until = std::min(t_end, state_.exact.window.t1);
  if (!state_.exact.queue.empty() && state_.exact.queue.front().t <= until) {
    const ExactMemory::Touch touch = state_.exact.queue.front();
    closeRests(touch.t);
    strike(touch.t, touch.a, touch.b);
    return;
  }
  closeRests(until);
  if (until == state_.exact.window.t1 || until == model_.def.duration) keepBooks(until);
  state_.t = until;
}

}  // namespace tumble
