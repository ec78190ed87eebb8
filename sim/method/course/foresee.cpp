// Where inside a step the motion must be looked at, so that no collision slips through between.
#include <algorithm>
#include <cmath>

#include "sim/method/course/course.h"

namespace tumble {
namespace {

/// Distance [m] of the nearest face from a point of the polyhedron's frame.
double innerRadius(const Polyhedron& solid, const Vec3& middle) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::vector<int>& face : solid.faces) {
    const Vec3 p = solid.points[static_cast<std::size_t>(face[0])] - middle;
    least = std::min(least, areaVector(solid, face).normalized().dot(p));
  }
  return least;
}

/// The origin of a part need not be inside it.
double innerRadius(const Part& part);

/// Radius [m] of a ball that fits inside a shape; of a compound, inside each of its parts.
double innerRadius(const Shape& shape) {
  if (const Sphere* sphere = std::get_if<Sphere>(&shape)) return sphere->r;
  if (const Box* box = std::get_if<Box>(&shape)) return box->half.minCoeff();
  if (const Cylinder* c = std::get_if<Cylinder>(&shape)) return std::min(c->r, 0.5 * c->h);
  if (const Capsule* capsule = std::get_if<Capsule>(&shape)) return capsule->r;
  if (const Ellipsoid* e = std::get_if<Ellipsoid>(&shape)) return e->half.minCoeff();
  if (const Hull* hull = std::get_if<Hull>(&shape)) return innerRadius(*hull->solid, hull->origin);
  double least = std::numeric_limits<double>::infinity();
  if (const Compound* compound = std::get_if<Compound>(&shape))
    for (const Part& part : compound->parts) least = std::min(least, innerRadius(part));
  return least;
}

double innerRadius(const Part& part) {
  const Hull* hull = std::get_if<Hull>(&part.solid);
  if (!hull) return innerRadius(shapeOf(part));
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : hull->solid->points) middle += p;
  return innerRadius(*hull->solid, middle / static_cast<double>(hull->solid->points.size()));
}

/// Largest speed [m/s] and centripetal acceleration [m/s²] of the turning points of a body.
double turningSpeed(const RigidBody& body, const Shape& shape) {
  const double radius = boundingRadius(shape);
  return std::isfinite(radius) ? body.omega.norm() * radius : 0.0;
}

}  // namespace

double Course::foresee(double span) const {
  constexpr double kShortest = 1e-3;  // no pair may slow the others down for ever
  // [rad] of a body, or of a contact round its rim, in one stretch: integrators lose a larger one
  constexpr double kTurn = 0.1;
  const double shortest = kShortest * span;
  double safe = span;
  if (state_.near.empty()) return safe;  // nothing can be met: the step is the author's
  for (const RigidBody& body : state_.bodies)
    if (const double spin = body.omega.norm(); spin * safe > kTurn && !body.fixed())
      safe = std::max(shortest, kTurn / spin);
  for (const Contact& c : state_.lasting)
    if (const double runs = runsRound(state_.bodies[c.a], state_.bodies[c.b], c.point);
        runs * safe > kTurn)
      safe = std::max(shortest, kTurn / runs);
  std::vector<Contact> points;
  for (std::size_t k = 0; k < state_.near.size(); ++k) {
    const auto& [b, a] = state_.near[k];
    const RigidBody &bodyA = state_.bodies[a], &bodyB = state_.bodies[b];
    const double turnA = turningSpeed(bodyA, model_.shapes[a]);
    const double turnB = turningSpeed(bodyB, model_.shapes[b]);
    const double bend =
        accelerationScale() + bodyA.omega.norm() * turnA + bodyB.omega.norm() * turnB;
    const double speed = (bodyA.v - bodyB.v).norm() + turnA + turnB + bend * span;
    if (gaps_[k] > speed * span) continue;

    // Thin bodies must not pass through each other: half their thickness is the longest way inside.
    const double thickness = innerRadius(model_.shapes[a]) + innerRadius(model_.shapes[b]);
    if (speed * safe > 0.5 * thickness) {
      safe = std::max(shortest, 0.5 * thickness / speed);
      if (const double closing = closingSpeed(k); closing * safe > gaps_[k] + 0.5 * thickness)
        safe = (std::max(0.0, gaps_[k]) + 0.5 * thickness) / closing;
    }

    // Features that could dip in and come out again are near.
    const double depth = 0.5 * bend * span * span;
    if (gaps_[k] < depth) findContacts(model_, state_.bodies, state_.near[k], depth, points);
  }
  return points.empty() ? safe : lowestPoint(points, safe);
}

/// How fast [m/s] the nearest points of a near pair come towards each other.
double Course::closingSpeed(std::size_t pair) const {
  constexpr double kBeside = 1.0 + 1e-6;
  std::vector<Contact> points;
  findContacts(model_, state_.bodies, state_.near[pair],
               kBeside * std::max(0.0, gaps_[pair]) + tolerance_.touch, points);
  double closing = 0.0;
  for (const Contact& c : points)
    closing = std::max(closing, -approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point));
  return closing;
}

double Course::lowestPoint(std::span<const Contact> points, double span) const {
  std::vector<RigidBody> bodies = state_.bodies;
  system_.findForces(bodies);
  double soonest = span;
  for (const Contact& c : points) {
    const RigidBody &a = bodies[c.a], &b = bodies[c.b];
    if (wasLasting(c.a, c.b) && c.point.separation < tolerance_.touch) continue;
    const double v = approachVelocity(a, b, c.point);
    const double up =
        c.point.n.dot(pointAcceleration(a, c.point.pa) - pointAcceleration(b, c.point.pb)) +
        normalAccelerationBias(a, b, c.point);
    if (v >= -tolerance_.keep || up <= 0.0) continue;
    const double turn = -v / up;  // [s] when it turns back
    if (turn < soonest && c.point.separation + 0.5 * v * turn < 0.0) soonest = turn;
  }
  return soonest;
}

}  // namespace tumble
