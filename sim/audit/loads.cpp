#include "sim/audit/loads.h"

#include <algorithm>

namespace tumble {
namespace {

bool actsOn(int index, int body) {
  return index == kNoBody || index == body;
}

/// One end of a spring at one instant.
struct SpringEnd {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero(), arm = Vec3::Zero();
};

SpringEnd springEnd(std::span<const PathPoint> points, int body, const Vec3& anchor) {
  if (body == kNoBody) return {.p = anchor};
  const PathPoint& at = points[body];
  const Vec3 arm = at.q * anchor;
  return {at.x + arm, at.v + at.omega.cross(arm), arm};
}

void pull(const Spring& spring, std::span<const RigidBody> bodies,
          std::span<const PathPoint> points, Loads& loads) {
  const SpringEnd a = springEnd(points, spring.a, spring.anchorA_B);
  const SpringEnd b = springEnd(points, spring.b, spring.anchorB_B);
  const double length = (a.p - b.p).norm();
  if (length == 0.0) return;
  const Vec3 along = (a.p - b.p) / length;
  const double rate = along.dot(a.v - b.v);
  const Vec3 f = -(spring.stiffness * (length - spring.rest) + spring.damping * rate) * along;
  const int bearer = bearerOf(spring, bodies);
  if (bearer == kNoBody) return;
  double& power = loads.power[bearer];
  power -= spring.damping * rate * rate;
  const auto push = [&](int body, const SpringEnd& end, const Vec3& force) {
    if (body != kNoBody && !bodies[body].fixed()) {
      loads.force[body] += force;
      loads.torque[body] += end.arm.cross(force);
    } else {
      power -= force.dot(end.v);  // who leads an end gives what that takes
    }
  };
  push(spring.a, a, f);
  push(spring.b, b, -f);
}

void push(const Force& force, int i, const RigidBody& body, const PathPoint& at, Loads& loads) {
  if (const auto* wind = std::get_if<UniformWind>(&force); wind && actsOn(wind->body, i)) {
    loads.force[i] += wind->force;
    loads.power[i] += wind->force.dot(at.v);
  }
  if (const auto* drag = std::get_if<LinearDrag>(&force); drag && actsOn(drag->body, i)) {
    loads.force[i] -= drag->linear * at.v;
    loads.torque[i] -= drag->angular * at.omega;
    loads.power[i] -= drag->linear * at.v.squaredNorm() + drag->angular * at.omega.squaredNorm();
  }
  if (const auto* point = std::get_if<PointForce>(&force); point && point->body == i) {
    const Vec3 arm = at.q * point->point_B;
    loads.force[i] += point->force;
    loads.torque[i] += arm.cross(point->force);
    loads.power[i] += point->force.dot(at.v + at.omega.cross(arm));
  }
  if (const auto* field = std::get_if<CircularField>(&force); field && actsOn(field->body, i))
    loads.force[i] += body.M * field->rotation.cross(field->rotation.cross(at.x - field->centre));
}

}  // namespace

int bearerOf(const Spring& spring, std::span<const RigidBody> bodies) {
  for (const int end : {spring.a, spring.b})
    if (end != kNoBody && !bodies[end].fixed()) return end;
  return kNoBody;
}

void Loads::sum(std::span<const Force> forces, std::span<const RigidBody> bodies,
                std::span<const PathPoint> points) {
  force.assign(bodies.size(), Vec3::Zero());
  torque.assign(bodies.size(), Vec3::Zero());
  power.assign(bodies.size(), 0.0);
  for (const Force& f : forces) {
    if (const Spring* spring = std::get_if<Spring>(&f)) {
      pull(*spring, bodies, points, *this);
      continue;
    }
    if (std::holds_alternative<Bending>(f) || std::holds_alternative<Layering>(f))
      continue;  // a potential, as gravity is
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (!bodies[i].fixed()) push(f, static_cast<int>(i), bodies[i], points[i], *this);
  }
}

namespace {

double storedIn(const ElasticBody& body, std::span<const Recorded> states) {
  double sum = 0.0;
  ElementTerms terms;
  for (const Element& element : body.elements) {
    ElementPlaces x;
    x.fill(Vec3::Zero());
    for (int k = 0; k < element.count; ++k) x[k] = states[element.points[k]].x;
    differentiate(element.energy, x, ElementAsk::Energy, terms);
    sum += terms.energy;
  }
  return sum;
}

}  // namespace

double storedIn(const Force& force, std::span<const RigidBody> bodies,
                std::span<const Recorded> states, int of) {
  if (const auto* field = std::get_if<CircularField>(&force)) {
    if (!actsOn(field->body, of)) return 0.0;
    return 0.5 * bodies[of].M * field->rotation.cross(states[of].x - field->centre).squaredNorm();
  }
  if (const auto* bending = std::get_if<Bending>(&force)) {
    // All of it with the first of its points that moves.
    const std::vector<int>& points = bending->body->bodies;
    const auto first =
        std::find_if(points.begin(), points.end(), [&](int i) { return !bodies[i].fixed(); });
    return first != points.end() && *first == of ? storedIn(*bending->body, states) : 0.0;
  }
  const Spring* spring = std::get_if<Spring>(&force);
  if (!spring || bearerOf(*spring, bodies) != of) return 0.0;
  const auto end = [&](int body, const Vec3& anchor) {
    return body == kNoBody ? anchor : Vec3(states[body].x + states[body].q * anchor);
  };
  const double length =
      (end(spring->a, spring->anchorA_B) - end(spring->b, spring->anchorB_B)).norm();
  return 0.5 * spring->stiffness * (length - spring->rest) * (length - spring->rest);
}

}  // namespace tumble
