// Chapter 11: from a definition to a world at its start; what cannot be simulated is refused here.
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "sim/collide/overlap.h"
#include "sim/collide/parts.h"
#include "sim/contact/impact.h"
#include "sim/joined.h"
#include "sim/method/auto.h"
#include "sim/origin.h"
#include "sim/world_parts.h"

namespace tumble {
namespace {

/// Error of a substep, where the exact method has to make steps.
constexpr double kJointTolerance = 1e-13;
/// Times the effort that `auto` grants the exact method, where that is asked for by name.
constexpr long kAsked = 6;

std::string bodyPath(std::size_t i, const char* field = "") {
  return "bodies[" + std::to_string(i) + "]" + field;
}

void need(bool holds, const std::string& where, const std::string& what) {
  if (!holds) throw Refusal(where, what);
}

/// What the inertia method of a body finds.
template <class Find>
auto byMethod(const BodyDef& def, std::size_t i, Find find) {
  need(findInertiaMethod(def.inertiaBy), bodyPath(i, ".inertia_by"),
       "no inertia method is called \"" + def.inertiaBy + "\"");
  need(def.samples > 0, bodyPath(i, ".samples"), "samples must be 1 or more");
  try {
    return find(def);
  } catch (const std::invalid_argument& reason) {
    throw Refusal(bodyPath(i, ".samples"), "\"" + def.name + "\": " + reason.what());
  }
}

/// Mass and inertia as the author wants them; mass wins over density, inertia over the shape's.
MassProperties checkedMass(const BodyDef& def, std::size_t i) {
  need(def.mass || def.density, bodyPath(i),
       "body \"" + def.name + "\" moves, so it needs a mass or a material with a density");
  const double mass = bodyMass(def);
  need(mass > 0.0 && std::isfinite(mass), bodyPath(i, ".mass"),
       "the mass of \"" + def.name + "\" must be a positive number of kg");
  if (def.inertia) {
    need(def.inertia->allFinite() && def.inertia->minCoeff() > 0.0, bodyPath(i, ".inertia"),
         "the inertia of \"" + def.name + "\" must be three positive numbers in kg m²");
  }
  return byMethod(def, i, massOf);
}

/// A particle has a mass of its own, and nothing that turns.
RigidBody particleOf(const BodyDef& def, std::size_t i) {
  const std::string name = "particle \"" + def.name + "\" ";
  need(def.mass.has_value(), bodyPath(i), name + "needs a mass");
  need(*def.mass > 0.0 && std::isfinite(*def.mass), bodyPath(i, ".mass"),
       "the mass of " + name + "must be a positive number of kg");
  need(!def.inertia, bodyPath(i, ".inertia"), name + "has no inertia");
  RigidBody body = makeParticle(*def.mass);
  body.x = def.position;
  setVelocity(body, def.velocity, Vec3::Zero());
  return body;
}

/// A solid at rest. A surface with pieces inside out takes mass away where there is none.
RigidBody solidOf(const BodyDef& def, std::size_t i) {
  const MassProperties mass = checkedMass(def, i);
  try {
    return makeBody(mass);
  } catch (const std::invalid_argument& reason) {
    throw Refusal(bodyPath(i, ".shape"), "\"" + def.name + "\" is no solid: " + reason.what());
  }
}

RigidBody bodyOf(const BodyDef& def, std::size_t i) {
  need(def.position.allFinite(), bodyPath(i, ".position"), "a position must be finite");
  need(def.velocity.allFinite(), bodyPath(i, ".velocity"), "a velocity must be finite");
  need(def.angularVelocity.allFinite(), bodyPath(i, ".angular_velocity"),
       "an angular velocity must be finite");
  need(def.restitution >= 0.0 && def.restitution <= 1.0, bodyPath(i, ".restitution"),
       "restitution must lie in [0, 1]");
  need(def.friction >= 0.0 && std::isfinite(def.friction), bodyPath(i, ".friction"),
       "friction must be 0 or more");
  need(def.orientation.coeffs().allFinite() && def.orientation.norm() > 0.0,
       bodyPath(i, ".orientation"), "an orientation must be a quaternion that is not zero");
  if (std::holds_alternative<Particle>(def.shape)) {
    need(def.angularVelocity.isZero(0.0), bodyPath(i, ".angular_velocity"),
         "a particle does not turn");
    need(def.orientation.vec().isZero(0.0), bodyPath(i, ".orientation"),
         "a particle has no orientation");
  }
  const Pose pose{def.position, def.orientation.normalized()};
  if (const HalfSpace* plane = std::get_if<HalfSpace>(&def.shape)) {
    need(def.fixed, bodyPath(i, ".fixed"), "a plane is always fixed");
    const double scale = def.velocity.norm() + def.angularVelocity.norm();
    need(std::abs(plane->n.dot(def.velocity)) <= 1e-12 * scale &&
             plane->n.cross(def.angularVelocity).norm() <= 1e-12 * scale,
         bodyPath(i, ".velocity"),
         "a plane can only move within itself, and turn about its normal");
  }
  if (def.fixed) return makeFixedBody(pose, def.velocity, def.angularVelocity);
  if (std::holds_alternative<Particle>(def.shape)) return particleOf(def, i);
  RigidBody body = solidOf(def, i);
  body.x = pose.x;
  body.q = pose.q;
  updateDerived(body);
  setVelocity(body, def.velocity, def.angularVelocity);
  return body;
}

/// Lengths of a shape are positive and finite; a plane has a direction.
void checkShape(const Shape& shape, std::size_t i) {
  const bool sound = std::visit(
      [](const auto& s) {
        using S = std::decay_t<decltype(s)>;
        const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
        if constexpr (std::is_same_v<S, Sphere>) return positive(s.r);
        if constexpr (std::is_same_v<S, Box>)
          return positive(s.half.minCoeff()) && s.half.allFinite();
        if constexpr (std::is_same_v<S, Ellipsoid>)
          return positive(s.half.minCoeff()) && s.half.allFinite();
        if constexpr (std::is_same_v<S, Cylinder> || std::is_same_v<S, Capsule>)
          return positive(s.r) && positive(s.h);
        if constexpr (std::is_same_v<S, HalfSpace>)
          return std::abs(s.n.norm() - 1.0) < 1e-9 && std::isfinite(s.d);
        if constexpr (std::is_same_v<S, Particle>)
          return s.radius >= 0.0 && std::isfinite(s.radius);
        if constexpr (std::is_same_v<S, Hull> || std::is_same_v<S, Mesh>) return s.solid != nullptr;
        if constexpr (std::is_same_v<S, Compound>) return !s.parts.empty();
      },
      shape);
  need(sound, bodyPath(i, ".shape"), "lengths of a shape must be positive, a plane's normal unit");
}

/// The parts of a compound share no volume, or it would be weighed twice.
void checkParts(const BodyDef& def, std::size_t i) {
  const Compound* compound = std::get_if<Compound>(&def.shape);
  if (!compound) return;
  need(compound->parts.size() <= kMostParts, bodyPath(i, ".shape"),
       "\"" + def.name + "\" has " + std::to_string(compound->parts.size()) +
           " parts; one body has room for " + std::to_string(kMostParts) +
           ", so cut it into several");
  const auto [a, b] = overlappingParts(*compound);
  need(a < 0, bodyPath(i, ".shape"),
       "parts " + std::to_string(a + 1) + " and " + std::to_string(b + 1) + " of \"" + def.name +
           "\" overlap; the parts of a compound may touch at most");
}

/// The bodies that forces name exist.
void checkForces(const WorldDef& def) {
  const int count = static_cast<int>(def.bodies.size());
  for (std::size_t k = 0; k < def.forces.size(); ++k) {
    const auto exists = [&](int body, bool orNone) {
      const bool known = body >= 0 && body < count;
      need(known || (orNone && body == kNoBody), "forces[" + std::to_string(k) + "]",
           "a force names a body that is not there");
    };
    const Force& force = def.forces[k];
    if (const auto* wind = std::get_if<UniformWind>(&force)) exists(wind->body, true);
    if (const auto* drag = std::get_if<LinearDrag>(&force)) exists(drag->body, true);
    if (const auto* point = std::get_if<PointForce>(&force)) exists(point->body, false);
    if (const auto* field = std::get_if<CircularField>(&force)) exists(field->body, true);
    if (const auto* bending = std::get_if<Bending>(&force))
      for (const int body : bending->body->bodies) exists(body, false);
    if (const auto* spring = std::get_if<Spring>(&force)) {
      exists(spring->a, false);
      exists(spring->b, true);
    }
  }
}

/// The pivots of bodies that have one, which begin without moving there.
void addPivots(Model& model, std::vector<RigidBody>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyDef& def = model.def.bodies[i];
    if (!def.pivot_B) continue;
    const std::string where = bodyPath(i, ".pivot_body"), name = "\"" + def.name + "\"";
    need(def.pivot_B->allFinite(), where, "a pivot must be a finite point");
    need(!def.fixed, where, name + " is fixed; leave out the pivot or let it move");
    need(!bodies[i].particle, where, name + " is a particle, which cannot turn about a pivot");
    need(def.velocity.isZero(0.0), bodyPath(i, ".velocity"),
         name + " turns about its pivot: give it an angular velocity alone");
    const Pivot pivot = makePivot(bodies[i], static_cast<int>(i), *def.pivot_B);
    setVelocity(bodies[i], def.angularVelocity.cross(-(bodies[i].R * pivot.c_B)),
                def.angularVelocity);
    model.pivots.push_back(pivot);
  }
}

/// What keeps cloths apart.
void addLayers(Model& model) {
  std::vector<std::shared_ptr<const ElasticBody>> cloths;
  for (const Force& force : model.def.forces)
    if (const auto* bending = std::get_if<Bending>(&force)) cloths.push_back(bending->body);
  const auto layers = std::make_shared<const Layers>(cloths);
  if (!layers->empty()) model.def.forces.push_back(Layering{layers});
}

/// Which bodies are points of what bends.
void addBending(Model& model) {
  for (std::size_t k = 0; k < model.def.forces.size(); ++k) {
    const auto* bending = std::get_if<Bending>(&model.def.forces[k]);
    if (!bending) continue;
    if (model.bending.empty()) model.bending.assign(model.shapes.size(), -1);
    const std::string where = "forces[" + std::to_string(k) + "]";
    const int number = *std::max_element(model.bending.begin(), model.bending.end()) + 1;
    for (const int i : bending->body->bodies) {
      need(std::holds_alternative<Particle>(model.def.bodies[i].shape), where,
           "\"" + model.def.bodies[i].name +
               "\" is no particle, so nothing bends between it and others");
      need(model.bending[i] < 0, where,
           "\"" + model.def.bodies[i].name + "\" is a point of two things that bend");
      model.bending[i] = number;
    }
    for (const Element& element : bending->body->elements)
      for (int p = 0; p < element.count; ++p)
        need(model.bending[element.points[p]] == number, where,
             "\"" + bending->body->name + "\" has an element with points that are not its own");
  }
  if (model.bending.empty()) return;
  addLayers(model);
  for (const int i : model.solid) model.solidBends.push_back(model.bends(i));
}

/// Where a scene stands, and what stands in it, near or far off, tells nothing of its contacts
/// until rounding of places does.
double sizeOf(const Model& model) {
  constexpr double kFar = 1e-2;
  double size = 0.0, way = 0.0;
  for (std::size_t i = 0; i < model.def.bodies.size(); ++i) {
    const BodyDef& body = model.def.bodies[i];
    const double radius = model.radius[i], t = model.def.duration;
    if (std::isfinite(radius)) {
      const double own = body.fixed ? std::min(ContactTolerance::kSmall, radius) : radius;
      size = std::max({size, own, kFar * (radius + body.position.norm())});
    }
    way = std::max(way, t * (body.velocity.norm() + 0.5 * t * model.def.gravity.norm()));
  }
  // Places that small bodies may fall to are rounded as those of larger ones are.
  size = std::max(size, std::min(ContactTolerance::kSmall, kFar * way));
  return size > 0.0 ? size : 1.0;
}

}  // namespace

void World::Parts::place(const WorldDef& def) {
  origin = originOf(def);
  build(origin.isZero(0.0) ? def : shifted(def, -origin));
}

Vec3 World::Parts::weight() const {
  double mass = 0.0;
  for (const RigidBody& body : now->state.bodies) mass += body.fixed() ? 0.0 : body.M;
  return mass * model.def.gravity;
}

Sample World::Parts::told(Sample here) const {
  return origin.isZero(0.0) ? here : shifted(std::move(here), origin, weight());
}

Sample World::Parts::here(Sample told) const {
  return origin.isZero(0.0) ? told : shifted(std::move(told), -origin, weight());
}

void World::Parts::tellAnew() {
  if (seenReport) *seenReport = shifted(now->report, origin, weight());
}

void World::Parts::build(const WorldDef& def) {
  State& state = now->state;
  model.def = def;
  method = findMethod(def.method);
  need(method, "method", "no method is called \"" + def.method + "\"");
  need(findImpactLaw(def.impact), "impact", "no impact law is called \"" + def.impact + "\"");
  need(def.duration > 0.0 && std::isfinite(def.duration), "duration",
       "a duration must be a positive number of seconds");
  need(def.gravity.allFinite(), "gravity", "gravity must be finite");
  need(!def.bodies.empty(), "bodies", "a scene needs at least one body");
  for (std::size_t i = 0; i < def.bodies.size(); ++i) {
    checkShape(def.bodies[i].shape, i);
    checkParts(def.bodies[i], i);
    model.shapes.push_back(readyShape(contactShape(byMethod(def.bodies[i], i, centredShape))));
    model.radius.push_back(boundingRadius(model.shapes[i]));
    if (touchesAnything(def.bodies[i].shape)) model.solid.push_back(static_cast<int>(i));
    state.bodies.push_back(bodyOf(def.bodies[i], i));
  }
  checkForces(def);
  addBending(model);
  addPivots(model, state.bodies);
  model.size = sizeOf(model);
  joinBodies(model, state.bodies);
  model.runs = method->name;
  if (def.method == "auto") {
    model.runs = chooseMethod(model, state.bodies);
  }
  if (model.runs == "exact") {
    const long most = mostEffort(model);
    state.effort.most = def.method == "auto" ? most : kAsked * most;
    state.effort.close = most;
  }
  if (model.runs == "exact" && !model.joints.empty()) {
    // Where the closed forms end, the most accurate steps that there are.
    model.def.course = {.integrator = "extrapolation", .tolerance = kJointTolerance};
  }
  method->check(model, state.bodies);
}

}  // namespace tumble
