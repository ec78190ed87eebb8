#include "tests/stability/seen.h"

#include <algorithm>
#include <type_traits>

#include "sim/shape/convex_hull.h"

namespace tumble::test {
namespace {

/// Of a body that is mirrored: its own points.
Mat3 mirrorOf(const Seen& seen) {
  return Vec3(seen.mirrors() ? -1.0 : 1.0, 1.0, 1.0).asDiagonal();
}

Vec3 pointOf(const Seen& seen, const Vec3& p) {
  return seen.turn * p + seen.shift;
}

Vec3 spinOf(const Seen& seen, const Vec3& omega) {
  return seen.turn.determinant() * (seen.turn * omega);
}

Quat turned(const Mat3& by, const Quat& q, const Mat3& mirror) {
  return Quat(Mat3(by * q.toRotationMatrix() * mirror)).normalized();
}

Hull mirrored(const Hull& hull, const Mat3& mirror) {
  std::vector<Vec3> points = hull.solid->points;
  for (Vec3& p : points) p = mirror * p;
  return {.solid = std::make_shared<const Polyhedron>(convexHull(points)),
          .origin = mirror * hull.origin};
}

Shape mirrored(const Shape& shape, const Mat3& mirror) {
  if (const auto* hull = std::get_if<Hull>(&shape)) return mirrored(*hull, mirror);
  const auto* compound = std::get_if<Compound>(&shape);
  if (!compound) return shape;
  Compound result = *compound;
  result.origin = mirror * compound->origin;
  result.ready = {};
  for (Part& part : result.parts) {
    part.pose.x = mirror * part.pose.x;
    part.pose.q = turned(mirror, part.pose.q, mirror);
    if (const auto* hull = std::get_if<Hull>(&part.solid)) part.solid = mirrored(*hull, mirror);
  }
  return result;
}

BodyDef bodyOf(const Seen& seen, BodyDef body) {
  const Mat3 mirror = mirrorOf(seen);
  if (seen.mirrors()) body.shape = mirrored(body.shape, mirror);
  if (auto* plane = std::get_if<HalfSpace>(&body.shape)) {
    plane->n = (seen.turn * plane->n).normalized();
    plane->d += plane->n.dot(seen.shift);
    return body;
  }
  body.position = pointOf(seen, body.position);
  body.orientation = turned(seen.turn, body.orientation, mirror);
  body.velocity = seen.turn * body.velocity;
  body.angularVelocity = spinOf(seen, body.angularVelocity);
  return body;
}

/// @param place  of each body of the scene in the scene seen
Force forceOf(const Seen& seen, const Force& force, const std::vector<int>& place) {
  const Mat3 mirror = mirrorOf(seen);
  Force result = force;
  const auto at = [&](int body) { return body == kNoBody ? body : place[body]; };
  if (auto* wind = std::get_if<UniformWind>(&result)) {
    wind->body = at(wind->body);
    wind->force = seen.turn * wind->force;
  } else if (auto* drag = std::get_if<LinearDrag>(&result)) {
    drag->body = at(drag->body);
  } else if (auto* push = std::get_if<PointForce>(&result)) {
    push->body = at(push->body);
    push->point_B = mirror * push->point_B;
    push->force = seen.turn * push->force;
  } else if (auto* spring = std::get_if<Spring>(&result)) {
    const auto end = [&](int body, const Vec3& p) {
      return body == kNoBody ? pointOf(seen, p) : Vec3(mirror * p);
    };
    spring->anchorA_B = end(spring->a, spring->anchorA_B);
    spring->anchorB_B = end(spring->b, spring->anchorB_B);
    spring->a = at(spring->a);
    spring->b = at(spring->b);
  }
  return result;
}

}  // namespace

WorldDef seenFrom(const Seen& seen, const WorldDef& def) {
  WorldDef result = def;
  result.gravity = seen.turn * def.gravity;
  const int count = static_cast<int>(def.bodies.size());
  std::vector<int> place(def.bodies.size());
  for (int i = 0; i < count; ++i) {
    place[static_cast<std::size_t>(seen.bodyAt(i))] = i;
    result.bodies[static_cast<std::size_t>(i)] =
        bodyOf(seen, def.bodies[static_cast<std::size_t>(seen.bodyAt(i))]);
  }
  for (std::size_t k = 0; k < def.forces.size(); ++k)
    result.forces[k] = forceOf(seen, def.forces[k], place);
  for (JointDef& joint : result.joints) {
    joint.a = place[joint.a];
    if (joint.b != kNoBody) joint.b = place[joint.b];
    joint.anchorA = pointOf(seen, joint.anchorA);
    joint.anchorB = pointOf(seen, joint.anchorB);
    joint.axis = seen.turn * joint.axis;
  }
  return result;
}

BodySample asItIs(const Seen& seen, const BodySample& body) {
  BodySample result;
  const Mat3 back = seen.turn.transpose();
  result.x = back * (body.x - seen.shift);
  result.q = turned(back, body.q, mirrorOf(seen));
  result.v = back * body.v;
  result.omega = seen.turn.determinant() * (back * body.omega);
  return result;
}

}  // namespace tumble::test
