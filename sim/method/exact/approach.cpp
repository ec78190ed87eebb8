#include "sim/method/exact/approach.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sim/collide/collide.h"
#include "sim/contact/contact.h"
#include "sim/method/exact/quadratic.h"

namespace tumble {
namespace {

/// Balls further apart than this part of their radii need no look at the corners.
constexpr double kFar = 0.1;
/// Steps at less than the touching distance before bodies that hover there count as touching, and
/// steps in which bodies that touch at the start must have parted.
constexpr int kPatience = 10'000, kParting = 100;
/// [s] the first span for which a turning plane is tried.
constexpr double kShortest = 1e-9;

/// Corners in the body frame; a ball is a corner with a radius.
int cornersOf(const Shape& shape, Vec3* corners, double& round) {
  if (const Sphere* sphere = std::get_if<Sphere>(&shape)) {
    corners[0].setZero();
    round = sphere->r;
    return 1;
  }
  const Box* box = std::get_if<Box>(&shape);
  if (!box) return 0;
  for (int k = 0; k < 8; ++k)
    corners[k] = {k & 1 ? box->half.x() : -box->half.x(), k & 2 ? box->half.y() : -box->half.y(),
                  k & 4 ? box->half.z() : -box->half.z()};
  return 8;
}

}  // namespace

Approach::Approach(const Flyer& a, const Flyer& b, double touch) : touch_(touch) {
  side_[0].flyer = a;
  side_[1].flyer = b;
  if (std::holds_alternative<HalfSpace>(*a.shape)) std::swap(side_[0], side_[1]);
  plane_ = std::get_if<HalfSpace>(side_[1].flyer.shape);
  acceleration_ = side_[0].flyer.path->g;  // a top's is its slack
  if (!plane_) acceleration_ -= side_[1].flyer.path->g;
  for (Side& side : side_) {
    if (&side == &side_[1] && plane_) continue;
    side.radius = boundingRadius(*side.flyer.shape);
    side.count = cornersOf(*side.flyer.shape, side.corners_B, side.round);
    for (int k = 0; k < side.count; ++k)
      side.corner = std::max(side.corner, side.corners_B[k].norm());
    if (const HeavyTop* top = side.flyer.top) {
      side.slack = top->accelBound(0.0);
      side.turning = top->accelBound(1.0) - side.slack;
      continue;
    }
    // What the bound leaves when the fall of the centre is taken off, rounding included.
    const double all = side.flyer.flight->accelBound(1.0), fall = side.flyer.path->g.norm();
    side.turning = std::max(0.0, all - fall) + 1e-15 * all;
    if (side.flyer.body->omega.isZero(0.0)) side.turning = 0.0;
  }
}

void Approach::lookAt(double t) {
  // A top is where it is; any other centre runs along its parabola.
  const auto centre = [t](const Flyer& flyer, Vec3& x, Vec3& v) {
    if (flyer.top) flyer.top->at(t, *flyer.body);
    x = flyer.top ? flyer.body->x : flyer.path->position(t);
    v = flyer.top ? flyer.body->v : flyer.path->velocity(t);
  };
  const Flyer &a = side_[0].flyer, &b = side_[1].flyer;
  centre(a, offset_, velocity_);
  if (plane_) {
    ballNormal_ = plane_->n;
    ballGap_ = ballNormal_.dot(offset_) - plane_->d - side_[0].radius;
    return;
  }
  if (a.top || b.top) {
    Vec3 x, v;
    centre(b, x, v);
    offset_ -= x;
    velocity_ -= v;
  } else {
    // Differences first: bodies far from the origin, or long under way, lose nothing.
    const Parabola apart{a.path->x0 - b.path->x0, a.path->v0 - b.path->v0, acceleration_};
    offset_ = apart.position(t);
    velocity_ = apart.velocity(t);
  }
  const double distance = offset_.norm();
  ballNormal_ = distance > 0.0 ? Vec3(offset_ / distance) : Vec3::UnitY();
  ballGap_ = distance - side_[0].radius - side_[1].radius;
}

double Approach::ballStep() const {
  if (!(ballGap_ > 0.0)) return 0.0;
  return firstZero(ballGap_, ballNormal_.dot(velocity_),
                   ballNormal_.dot(acceleration_) - side_[0].slack - side_[1].slack);
}

void Approach::placeCorners(double t) {
  for (Side& side : side_) {
    if (side.count == 0) continue;
    RigidBody& body = *side.flyer.body;
    if (!side.flyer.top) side.flyer.flight->at(t, body);
    for (int k = 0; k < side.count; ++k) {
      side.corners[k] = body.R * side.corners_B[k];
      side.rates[k] = body.omega.cross(side.corners[k]);
    }
  }
  const RigidBody &a = *side_[0].flyer.body, &b = *side_[1].flyer.body;
  wide_ = separatingPlane(*side_[0].flyer.shape, {offset_, a.q}, *side_[1].flyer.shape,
                          {Vec3::Zero(), plane_ ? Quat::Identity() : b.q});
}

/// Angular velocity [rad/s] at which the plane turns with what it is tied to.
Vec3 Approach::planeTurn() const {
  const Vec3 &a = side_[0].flyer.body->omega, &b = side_[1].flyer.body->omega;
  switch (wide_.tie) {
    case NormalTie::FaceOfA:
    case NormalTie::EdgeOfA:
      return a;
    case NormalTie::FaceOfB:
    case NormalTie::EdgeOfB:
      return b;
    case NormalTie::Points:
      return Vec3::Zero();
    case NormalTie::Edges:
      break;
  }
  // n = ± ea×eb / |ea×eb|, and Ω = n × ṅ. Edges that are nearly parallel turn it wildly, and then
  // the turn does not help.
  const Vec3 rate = a.cross(wide_.ea).cross(wide_.eb) + wide_.ea.cross(b.cross(wide_.eb));
  const double product = wide_.ea.cross(wide_.eb).dot(wide_.n);
  const Vec3 turn = wide_.n.cross(rate / product);
  return turn.allFinite() ? turn : Vec3::Zero();
}

Approach::Heights Approach::heights(int which, const Vec3& n, const Vec3& rate) const {
  const Side& side = side_[which];
  Heights h;
  if (side.count == 0) {  // a plane stands where it is
    h.at[0] = plane_->d;
    h.rate[0] = 0.0;
    h.count = 1;
    return h;
  }
  const bool isA = which == 0;
  const double round = isA ? -side.round : side.round;
  const double centre = isA ? n.dot(offset_) : 0.0;
  const double centreRate = isA ? n.dot(velocity_) + rate.dot(offset_) : 0.0;
  for (int k = 0; k < side.count; ++k) {
    h.at[k] = centre + n.dot(side.corners[k]) + round;
    h.rate[k] = centreRate + n.dot(side.rates[k]) + rate.dot(side.corners[k]);
  }
  h.count = side.count;
  return h;
}

double Approach::stepAlong(const Vec3& n, const Vec3& turn, double limit, bool begins) const {
  const Vec3 rate = turn.cross(n);
  const Heights a = heights(0, n, rate), b = heights(1, n, rate);
  const Side &sideA = side_[0], &sideB = side_[1];
  const double bend = sideA.bend() + sideB.bend();
  const double spin = turn.norm();
  double c = n.dot(acceleration_) - bend;
  if (spin > 0.0) {
    const double fall = acceleration_.norm() + sideA.slack + sideB.slack;
    const double speed = velocity_.norm() + fall * limit + sideA.corner * std::sqrt(sideA.turning) +
                         sideB.corner * std::sqrt(sideB.turning);
    const double distance = offset_.norm() + sideA.corner + sideB.corner + speed * limit;
    c = -fall - bend - spin * (spin * distance + 2.0 * speed);
  }
  double first = limit;
  for (int k = 0; k < a.count; ++k) {
    for (int l = 0; l < b.count; ++l) {
      double alpha = a.at[k] - b.at[l];
      const double beta = a.rate[k] - b.rate[l];
      // Corners that touch at the start must not come nearer; others must not touch.
      if (begins && alpha <= touch_) alpha = 0.0;
      if (alpha < 0.0) return 0.0;
      if (c <= 0.0 && alpha + first * (beta + 0.5 * c * first) > 0.0) continue;
      first = std::min(first, firstZero(alpha, beta, c));
    }
  }
  return first;
}

double Approach::cornerStep(double limit, bool begins) const {
  const double steady = stepAlong(wide_.n, Vec3::Zero(), limit, begins);
  if (steady >= limit || plane_) return steady;
  const Vec3 turn = planeTurn();
  if (turn.isZero(0.0)) return steady;
  // The bounds of a turning plane grow with the time they must hold for: begin with a short one.
  double longest = steady;
  for (double span = std::max(4.0 * steady, kShortest);; span *= 4.0) {
    const double reach = std::min(span, limit);
    const double step = stepAlong(wide_.n, turn, reach, begins);
    longest = std::max(longest, step);
    if (step < reach || reach == limit) return longest;
  }
}

std::optional<double> Approach::firstTouch(double t0, double t1, bool begins) {
  double t = t0;
  int hovering = 0;
  while (t < t1) {
    // While the balls around them are well apart, only the centres matter.
    lookAt(t);
    const double balls = ballStep();
    if (balls >= t1 - t) return std::nullopt;
    if (ballGap_ > touch_) begins = false;
    if (ballGap_ > kFar * (side_[0].radius + side_[1].radius) && t + balls > t) {
      t += balls;
      continue;
    }
    placeCorners(t);
    if (wide_.separation > touch_) begins = false;
    if (!begins && wide_.separation <= 0.0) return t;
    double step = cornerStep(t1 - t, begins);
    if (begins) step = step < t1 - t ? 0.5 * step : step;  // half way they have parted most
    if (!begins) step = std::max(step, balls);
    const double next = t + step;
    if (next >= t1) return std::nullopt;
    if (next <= t || (begins && hovering >= kParting)) return begins ? t0 : t;
    if (wide_.separation <= touch_ && ++hovering >= kPatience) return t;
    t = next;
  }
  return std::nullopt;
}

}  // namespace tumble
