#include "app/claim/free_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/body/mass_properties.h"

namespace tumble {

std::optional<Vec3> freeAcceleration(const WorldDef& world, int body) {
  const double mass = bodyMass(world.bodies[body]);
  const auto holds = [&](const JointDef& joint) { return joint.a == body || joint.b == body; };
  if (std::any_of(world.joints.begin(), world.joints.end(), holds)) return {};
  Vec3 acceleration = world.gravity;
  for (const Force& force : world.forces) {
    if (const UniformWind* wind = std::get_if<UniformWind>(&force)) {
      if (wind->body == body || wind->body == kNoBody) acceleration += wind->force / mass;
    } else if (const PointForce* point = std::get_if<PointForce>(&force)) {
      if (point->body != body) continue;
      if (!point->point_B.isZero()) return {};
      acceleration += point->force / mass;
    } else if (const LinearDrag* drag = std::get_if<LinearDrag>(&force)) {
      if (drag->body == body || drag->body == kNoBody) return {};
    } else if (const CircularField* field = std::get_if<CircularField>(&force)) {
      if (field->body == body || field->body == kNoBody) return {};
    } else if (const Spring* spring = std::get_if<Spring>(&force)) {
      if (spring->a == body || spring->b == body) return {};
    }
  }
  return acceleration;
}

double reach(const Shape& shape, const Quat& q, const Vec3& n) {
  const Vec3 n_B = q.conjugate() * n;
  if (const Sphere* sphere = std::get_if<Sphere>(&shape)) return sphere->r;
  if (const Box* box = std::get_if<Box>(&shape)) return box->half.dot(n_B.cwiseAbs());
  if (const Particle* particle = std::get_if<Particle>(&shape)) return particle->radius;
  if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape))
    return 0.5 * cylinder->h * std::abs(n_B.y()) + cylinder->r * std::hypot(n_B.x(), n_B.z());
  if (const Capsule* capsule = std::get_if<Capsule>(&shape))
    return 0.5 * capsule->h * std::abs(n_B.y()) + capsule->r;
  if (const Ellipsoid* ellipsoid = std::get_if<Ellipsoid>(&shape))
    return ellipsoid->half.cwiseProduct(n_B).norm();
  double far = -std::numeric_limits<double>::infinity();
  const auto reachOf = [&](const auto& s) {
    for (const Vec3& point : s.solid->points) far = std::max(far, n_B.dot(point - s.origin));
    return far;
  };
  if (const Hull* hull = std::get_if<Hull>(&shape)) return reachOf(*hull);
  if (const Mesh* mesh = std::get_if<Mesh>(&shape)) return reachOf(*mesh);
  if (const Compound* compound = std::get_if<Compound>(&shape)) {
    for (const Part& part : compound->parts) {
      const Pose pose = poseInBody(*compound, part);
      far = std::max(far, n_B.dot(pose.x) + reach(shapeOf(part), pose.q, n_B));
    }
    return far;
  }
  return 0.0;
}

Vec3 angularMomentum(const Mat3& inertia, const Quat& q, const Vec3& omega) {
  const Vec3 omega_B = q.conjugate() * omega;
  const Vec3 L_B = inertia * omega_B;
  return q * L_B;
}

double spinRounding(const Mat3& inertia) {
  return 4e-16 * inertia.norm() * inertia.inverse().norm();
}

double untouchedUntil(const Scene& scene, const Recording& recording, int body) {
  double end = scene.world.duration;
  for (const Event& event : recording.report.events)
    if (event.a == body || event.b == body) end = std::min(end, event.t);
  return end;
}

WorldDef aloneOf(const Scene& scene, int body) {
  WorldDef def = scene.world;
  def.forces.clear();
  def.joints.clear();
  def.pairs.clear();
  def.bodies = {scene.world.bodies[body]};
  return def;
}

Surface surfaceOf(const WorldDef& world, int a, int b) {
  Model model;
  model.def.bodies = {world.bodies[a], world.bodies[b]};
  model.def.pairs = world.pairs;
  return model.surface(0, 1);
}

Surface actingSurface(const WorldDef& world, int body) {
  const Surface own{world.bodies[body].restitution, world.bodies[body].friction};
  std::optional<Surface> acting;
  for (int other = 0; other < static_cast<int>(world.bodies.size()); ++other) {
    if (other == body || moves(world.bodies[other])) continue;
    if (!touchesAnything(world.bodies[other].shape)) continue;
    const Surface met = surfaceOf(world, body, other);
    if (!acting) acting = met;
    if (met.restitution != acting->restitution) acting->restitution = own.restitution;
    if (met.friction != acting->friction) acting->friction = own.friction;
  }
  return acting.value_or(own);
}

}  // namespace tumble
