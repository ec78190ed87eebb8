// Bodies held by a hinge and a prop: which of the two pushes, and which pulls.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/claim/free_body.h"
#include "app/claim/rows.h"
#include "sim/math/frames.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

/// A body on a hinge to something fixed, and the prop that it lies on at the start.
struct Lever {
  int joint = 0, body = 0, prop = kNoBody;
};

// Where [m] a solid is highest, relative to its centre; the mean of all such points.
std::optional<Vec3> topOf(const Shape& shape, const Quat& q) {
  if (const Sphere* sphere = std::get_if<Sphere>(&shape)) return Vec3(0.0, sphere->r, 0.0);
  const Hull* hull = std::get_if<Hull>(&shape);
  if (!hull) return {};
  const double high = reach(shape, q, Vec3::UnitY());
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (const Vec3& point : hull->solid->points) {
    const Vec3 p = q * (point - hull->origin);
    if (p.y() < high - 1e-9 * boundingRadius(shape)) continue;
    sum += p;
    count += 1.0;
  }
  return Vec3(sum / count);
}

std::vector<Lever> leversOf(const Scene& scene, const Recording& recording) {
  const WorldDef& world = scene.world;
  const Vec3& g = world.gravity;
  std::vector<Lever> levers;
  for (std::size_t k = 0; k < world.joints.size(); ++k) {
    const JointDef& joint = world.joints[k];
    const bool held = joint.b == kNoBody || !moves(world.bodies[joint.b]);
    if (joint.kind != JointKind::Hinge || !held || !moves(world.bodies[joint.a])) continue;
    if (g.x() != 0.0 || g.z() != 0.0 || std::abs(joint.axis.y()) > 1e-9) continue;
    Lever& lever = levers.emplace_back(Lever{static_cast<int>(k), joint.a, kNoBody});
    for (const ContactSample& contact : recording.samples.front().contacts) {
      const int other = contact.a == joint.a ? contact.b : contact.a;
      if ((contact.a != joint.a && contact.b != joint.a) || moves(world.bodies[other])) continue;
      if (topOf(centredShape(world.bodies[other]), world.bodies[other].orientation))
        lever.prop = other;
    }
  }
  return levers;
}

/// What is known of a lever at one instant. Upward positive; arms [m] across the axis from the
/// hinge.
struct Balance {
  double weight = 0.0, weightArm = 0.0;  // [N], [m] signed as the prop's arm
  double pushes = 0.0, moment = 0.0;     // [N], [N m] of point forces
  double propArm = 0.0;                  // [m]
  // The force that the prop would need to give.
  double needed() const { return (weight * weightArm - moment) / propArm; }
};

Balance balanceOf(const Scene& scene, const Lever& lever, double t) {
  const WorldDef& world = scene.world;
  const JointDef& joint = world.joints[lever.joint];
  const BodyDef &body = world.bodies[lever.body], &prop = world.bodies[lever.prop];
  const Vec3 across = Vec3::UnitY().cross(joint.axis).normalized();
  const auto arm = [&](const Vec3& p) { return across.dot(p - joint.anchorA); };
  Balance balance;
  balance.weight = -bodyMass(body) * world.gravity.y();
  balance.weightArm = arm(body.position);
  for (const Force& force : world.forces) {
    const PointForce* point = std::get_if<PointForce>(&force);
    if (!point || point->body != lever.body) continue;
    const Vec3 p = body.position + body.orientation.normalized() * point->point_B;
    balance.pushes += point->force.y();
    balance.moment += point->force.y() * arm(p);
  }
  const Vec3 top = *topOf(centredShape(prop), prop.orientation.normalized());
  balance.propArm = arm(prop.position + t * prop.velocity + top);
  return balance;
}

// "d = 0.6 m, t = 1 s"
std::string instantOf(const Scene& scene, const Lever& lever, const Sample& sample) {
  const std::string t = fmt::format("t = {:.4g} s", sample.t);
  if (lever.prop == kNoBody) return t;
  const double d = std::abs(balanceOf(scene, lever, sample.t).propArm);
  return fmt::format("d = {:.4g} m, {}", d, t);
}

Vec3 contactForce(const Sample& sample, const Lever& lever) {
  Vec3 sum = Vec3::Zero();
  for (const ContactSample& c : sample.contacts) {
    if (c.a == lever.body && c.b == lever.prop) sum += c.force;
    if (c.b == lever.body && c.a == lever.prop) sum -= c.force;
  }
  return sum;
}

// As long as the body lies as it began, moments about the hinge give f, and the hinge what is left.
void addHeld(const Scene& scene, const Recording& recording, const Lever& lever,
             std::vector<ClaimRow>& rows) {
  const BodyDef& body = scene.world.bodies[lever.body];
  WorstRow push(body.name + ": force of the prop, f = m g L/(2 d) / N", 3e-12);
  WorstRow hinge(body.name + ": force of the hinge, m g - f / N, error / the larger force", 3e-12);
  for (const Sample& sample : recording.samples) {
    const BodySample& now = sample.bodies[lever.body];
    if ((now.x - body.position).norm() > 1e-12 || now.omega.norm() > 1e-12) continue;
    const Balance balance = balanceOf(scene, lever, sample.t);
    const double f = balance.needed(), rest = balance.weight - balance.pushes - f;
    const Vec3 found = contactForce(sample, lever), held = sample.joints[lever.joint].force;
    const std::string where = instantOf(scene, lever, sample);
    push.see(found.y(), f, (found - Vec3(0.0, f, 0.0)).norm() / f, where);
    hinge.see(held.y(), rest, (held - Vec3(0.0, rest, 0.0)).norm() / std::max(f, balance.weight),
              where);
  }
  rows.push_back(push.row());
  rows.push_back(hinge.row());
}

// Another force obeys a f + b >= 0 and f >= 0 as well, and lifts the body: then the prop gives
// nothing.
void addLifted(const Scene& scene, const Recording& recording, const Lever& lever,
               std::vector<ClaimRow>& rows) {
  const BodyDef& body = scene.world.bodies[lever.body];
  const Sample& start = recording.samples.front();
  const double f = contactForce(start, lever).norm();
  rows.push_back({body.name + ": force of the prop while another lifts / N, at " +
                      instantOf(scene, lever, start),
                  f, 0.0, f, 1e-12});
  double risen = 0.0;
  for (const Sample& sample : recording.samples)
    risen = std::max(risen, sample.bodies[lever.body].x.y() - body.position.y());
  const double lifted = risen > 1e-3 ? 1.0 : 0.0;
  rows.push_back(
      {body.name + ": is lifted, though a f + b >= 0 and f >= 0", lifted, 1.0, 1.0 - lifted, 0.0});
}

// What a step leaves of the gap of the hinge is drawn back with gap/tau^2 [m/s²], tau = 4 steps.
double drawnBack(const WorldDef& world, const Recording& recording) {
  const double tau = 4.0 * world.course.step;
  return recording.report.certificate.max_joint_gap / (tau * tau);
}

// However it moves, the hinge gives what contacts and weight leave of m x'':
//   F = m (alpha x r - omega^2 r) - m g - sum f,  alpha I = the moments about the hinge.
void addRemainder(const Scene& scene, const Recording& recording, const Lever& lever,
                  std::vector<ClaimRow>& rows) {
  const WorldDef& world = scene.world;
  const BodyDef& body = world.bodies[lever.body];
  const JointDef& joint = world.joints[lever.joint];
  const double mass = bodyMass(body);
  const Mat3 Ibody = massOf(body).inertia;
  const Vec3 axis = joint.axis.normalized();
  WorstRow row(body.name + ": force of the hinge, what is left of m x'' / N, error / the largest",
               1e-12 + 10.0 * drawnBack(world, recording) / world.gravity.norm());
  for (const Sample& sample : recording.samples) {
    const BodySample& now = sample.bodies[lever.body];
    const Vec3 r = now.x - joint.anchorA;
    const Mat3 R = rotationMatrix(now.q);
    const double inertia =
        axis.dot(R * Ibody * R.transpose() * axis) + mass * (r - axis.dot(r) * axis).squaredNorm();
    Vec3 force = mass * world.gravity, moment = r.cross(force);
    double largest = force.norm();
    const auto add = [&](const Vec3& f, const Vec3& p) {
      force += f;
      moment += (p - joint.anchorA).cross(f);
      largest = std::max(largest, f.norm());
    };
    for (const ContactSample& c : sample.contacts) {
      if (c.a == lever.body) add(c.force, c.p);
      if (c.b == lever.body) add(-c.force, c.p);
    }
    for (const Force& f : world.forces) {
      const PointForce* point = std::get_if<PointForce>(&f);
      if (point && point->body == lever.body)
        add(point->force, toWorld({now.x, now.q}, point->point_B));
    }
    const Vec3 turn = moment.dot(axis) / inertia * axis;
    const Vec3 exact = mass * (turn.cross(r) + now.omega.cross(now.omega.cross(r))) - force;
    const Vec3 found = sample.joints[lever.joint].force;
    row.see(found.y(), exact.y(), (found - exact).norm() / std::max(largest, exact.norm()),
            instantOf(scene, lever, sample));
  }
  rows.push_back(row.row());
}

}  // namespace

std::vector<ClaimRow> leverRows(const Scene& scene, const Recording& recording) {
  if (recording.samples.empty()) return {emptyClaim("the run has no samples")};
  std::vector<ClaimRow> rows;
  for (const Lever& lever : leversOf(scene, recording)) {
    addRemainder(scene, recording, lever, rows);
    if (lever.prop == kNoBody) continue;
    if (balanceOf(scene, lever, 0.0).needed() > 0.0)
      addHeld(scene, recording, lever, rows);
    else
      addLifted(scene, recording, lever, rows);
  }
  if (rows.empty()) return {emptyClaim("no body hangs on a level hinge")};
  return rows;
}

}  // namespace tumble
