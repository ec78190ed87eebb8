#include "sim/collide/approach.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/collide/align.h"
#include "sim/collide/collide.h"
#include "sim/collide/gjk.h"
#include "sim/math/first_zero.h"
#include "sim/math/frames.h"

namespace tumble {
namespace {

/// Balls further apart than this part of their radii need no look at the points inside.
constexpr double kFar = 0.1;
/// Steps at less than the touching distance before bodies that hover there count as touching, and
/// steps in which bodies that touch at the start must have parted.
constexpr int kPatience = 10'000, kParting = 100;
/// Of the size: a plane that keeps bodies further apart than this is found fast.
constexpr double kNear = 1e-4;
/// [s] the first span for which a turning plane is tried.
constexpr double kShortest = 1e-9;
/// Passes down the parabolas before the chord, which is never too long, ends the search.
constexpr int kPasses = 32;
/// Bodies that leave each other along an exact parabola are back when it says, if they rise less
/// than this part of their size: what rounding leaves of the gap at the start would weigh more.
constexpr double kLow = 1e-6;
/// The instant for which bodies that touch are not watched: in it their paths bend by less than
/// kRounding of their size, and it is no longer than kInstant [s].
constexpr double kRounding = 1e-13, kInstant = 1e-6;

}  // namespace

Approach::Approach(const Flyer& a, const Flyer& b, double touch) : touch_(touch) {
  side_[0].flyer = a;
  side_[1].flyer = b;
  if (std::holds_alternative<HalfSpace>(a.convex->shape)) std::swap(side_[0], side_[1]);
  plane_ = std::get_if<HalfSpace>(&side_[1].flyer.convex->shape);
  acceleration_.setZero();
  for (Side& side : side_) {
    if (&side == &side_[1] && plane_) continue;
    const Outline& outline = side.flyer.convex->outline;
    side.corner = outline.corner;
    side.round = outline.round;
    side.isPoint = outline.points.size() == 1 && outline.rims.empty();
    if (const HeavyTop* top = side.flyer.top) {
      side.slack = top->accelBound(0.0);
      side.turning = top->accelBound(1.0) - side.slack;
      continue;
    }
    constexpr double kWider = 1e-12;
    side.turning = side.flyer.flight->turning() * (1.0 + kWider);
    const Vec3& fall = side.flyer.flight->path().g;
    acceleration_ += &side == &side_[0] ? fall : Vec3(-fall);
  }
  size_ = side_[0].corner + side_[0].round + side_[1].corner + side_[1].round;
}

void Approach::lookAt(double t) {
  ++evaluations_;
  // A top is where it is; any other centre runs along its parabola.
  const auto centre = [t](const Flyer& flyer, Vec3& x, Vec3& v) {
    if (flyer.top) {
      flyer.top->at(t, *flyer.body);
      x = flyer.body->x;
      v = flyer.body->v;
    } else {
      const double s = t - flyer.flight->start();
      x = flyer.flight->path().position(s);
      v = flyer.flight->path().velocity(s);
    }
  };
  const Flyer &a = side_[0].flyer, &b = side_[1].flyer;
  centre(a, offset_, velocity_);
  if (plane_) {
    ballNormal_ = plane_->n;
    ballGap_ = ballNormal_.dot(offset_) - plane_->d - side_[0].corner - side_[0].round;
    return;
  }
  if (a.top || b.top || a.flight->start() != b.flight->start()) {
    Vec3 x, v;
    centre(b, x, v);
    offset_ -= x;
    velocity_ -= v;
  } else {
    // Differences first: bodies far from the origin, or long under way, lose nothing.
    const Parabola &p = a.flight->path(), &q = b.flight->path();
    const Parabola apart{p.x0 - q.x0, p.v0 - q.v0, acceleration_};
    const double s = t - a.flight->start();
    offset_ = apart.position(s);
    velocity_ = apart.velocity(s);
  }
  const double distance = offset_.norm();
  ballNormal_ = distance > 0.0 ? Vec3(offset_ / distance) : Vec3::UnitY();
  ballGap_ = distance - size_;
}

double Approach::ballStep() const {
  if (!(ballGap_ > 0.0)) return 0.0;
  return firstZero(ballGap_, ballNormal_.dot(velocity_),
                   ballNormal_.dot(acceleration_) - side_[0].slack - side_[1].slack);
}

void Approach::place(double t) {
  for (Side& side : side_) {
    const Flyer& flyer = side.flyer;
    if (flyer.top || (&side == &side_[1] && plane_) || (flyer.when && *flyer.when == t)) continue;
    flyer.flight->at(t, *flyer.body);
    if (flyer.when) *flyer.when = t;
  }
}

bool Approach::staysApart(double limit) const {
  if (plane_) return false;
  const auto outermostAlong = [&](const Side& side, const Vec3& n) {
    const Mat3& R = side.flyer.body->R;
    return Vec3(R * tumble::outermost(side.flyer.convex->outline, R.transpose() * n));
  };
  const auto support = [&](const Vec3& n) {
    return gjk::Outermost{offset_ + outermostAlong(side_[0], -n), outermostAlong(side_[1], n)};
  };
  const Vec3 start = offset_.isZero(0.0) ? Vec3(Vec3::UnitY()) : offset_;
  const double enough = std::max(touch_, speedWithin(limit) * limit);
  const gjk::Nearest nearest = gjk::nearest(support, start, kNear * size_, enough);
  if (nearest.lower > enough) return true;
  if (nearest.inside || !(nearest.lower > touch_)) return false;
  return stepAlong(nearest.v.normalized(), Vec3::Zero(), limit, false) >= limit;
}

void Approach::findPlane() {
  const Flyer &a = side_[0].flyer, &b = side_[1].flyer;
  wide_ = separatingPlane(a.convex->shape, toWorld(Pose{offset_, a.body->q}, a.convex->pose),
                          b.convex->shape,
                          plane_ ? Pose{} : toWorld(Pose{Vec3::Zero(), b.body->q}, b.convex->pose));
}

/// Angular velocity [rad/s] at which the plane turns with what it is tied to.
Vec3 Approach::planeTurn() const {
  const Vec3 &a = side_[0].flyer.body->omega, &b = side_[1].flyer.body->omega;
  switch (wide_.tie) {
    case NormalTie::FaceOfA:
      return a;
    case NormalTie::FaceOfB:
      return b;
    case NormalTie::EdgeOfA:
      return edgeTurn(wide_.ea, a, b, wide_.ra, rimOfB(wide_));
    case NormalTie::EdgeOfB:
      return edgeTurn(wide_.eb, b, a, wide_.rb, rimOfA(wide_));
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

/// Of a point of one body, which may wander along a rim, against an edge e of another: n stays
/// across the edge, and on the line between the two,  t·(pa − pb) = 0,  t = e × n:
///   Ω = ω − (ω·e) e + φ e,   (reach + bend (along·t)²) φ = t·(va − vb) − bend (along·t) along·w,
///   w = (ω − (ω·e) e − ω') × n
/// @param omega, other  [rad/s] of the body of the edge, and of that of the point
/// @param round         [m] radius of the edge: about a sharp one n turns as fast as the point
///                      passes it, which does not help
Vec3 Approach::edgeTurn(const Vec3& e, const Vec3& omega, const Vec3& other, double round,
                        const RimPoint& rim) const {
  if (round == 0.0 && rim.bend == 0.0) return omega;
  const Vec3& n = wide_.n;
  const Vec3 t = e.cross(n), tilt = omega - omega.dot(e) * e;
  const double along = rim.along.dot(t), reach = wide_.separation + wide_.ra + wide_.rb;
  const double passes = t.dot(velocity_ + side_[0].flyer.body->omega.cross(wide_.pa - offset_) -
                              side_[1].flyer.body->omega.cross(wide_.pb));
  const double wanders = rim.bend * along * rim.along.dot((tilt - other).cross(n));
  const Vec3 turn = tilt + (passes - wanders) / (reach + rim.bend * along * along) * e;
  return turn.allFinite() ? turn : omega;
}

// A point p of the body moves along the turning n at  p·(ṅ + n × ω) = p·((Ω − ω) × n).
Approach::Seen Approach::see(const Side& side, const Vec3& n, const Vec3& turn) const {
  if (side.isPoint && side.corner == 0.0) return {n, Vec3::Zero()};
  const RigidBody& body = *side.flyer.body;
  return {body.R.transpose() * n, body.R.transpose() * (turn - body.omega).cross(n)};
}

Approach::Reach Approach::outermost(const Side& side, const Seen& seen, double s,
                                    double sign) const {
  if (side.isPoint && side.corner == 0.0) return {sign * side.round, 0.0};
  const Outline& outline = side.flyer.convex->outline;
  const Vec3 m = seen.n + s * seen.rate;
  double most = -std::numeric_limits<double>::infinity();
  Vec3 best = Vec3::Zero();
  for (const Vec3& p : outline.points) {
    const double height = sign * m.dot(p);
    if (height > most) most = height, best = p;
  }
  for (const Outline::Rim& rim : outline.rims) {
    const double x = sign * m.dot(rim.u), y = sign * m.dot(rim.v);
    const double length = std::sqrt(x * x + y * y);
    const double height = sign * m.dot(rim.centre) + rim.r * length;
    if (height <= most) continue;
    most = height;
    best = rim.centre + (length > 0.0 ? rim.r / length : 0.0) * (x * rim.u + y * rim.v);
  }
  for (const Outline::Oval& oval : outline.ovals) {
    const Vec3 x = oval.E.transpose() * (sign * m);
    const double length = x.norm(), height = sign * m.dot(oval.centre) + length;
    if (height <= most) continue;
    most = height;
    best = oval.centre + oval.E * (length > 0.0 ? Vec3(x / length) : x);
  }
  return {seen.n.dot(best) + sign * side.round, seen.rate.dot(best)};
}

/// Whether one parabola is all there is: against a plane, and nothing that turns a point of it.
bool Approach::isExact() const {
  return plane_ && side_[0].bend() == 0.0;
}

/// Bounds on how fast [m/s] centres gain speed, and points of the two come nearer within `limit`
/// [s].
double Approach::fall() const {
  return acceleration_.norm() + side_[0].slack + side_[1].slack;
}
double Approach::speedWithin(double limit) const {
  const Side &a = side_[0], &b = side_[1];
  return velocity_.norm() + fall() * limit + a.corner * std::sqrt(a.turning) +
         b.corner * std::sqrt(b.turning);
}

/// The curvature c [m/s²] of the parabolas below which no point gets within `limit` [s].
double Approach::bound(const Vec3& n, double spin, double limit) const {
  const Side &a = side_[0], &b = side_[1];
  const double bend = a.bend() + b.bend();
  if (spin == 0.0) return n.dot(acceleration_) - bend;
  const double speed = speedWithin(limit);
  const double distance = offset_.norm() + a.corner + b.corner + speed * limit;
  return -fall() - bend - spin * (spin * distance + 2.0 * speed);
}

double Approach::stepAlong(const Vec3& n, const Vec3& turn, double limit, bool begins) const {
  const Vec3 rate = turn.cross(n);
  const Seen seenA = see(side_[0], n, turn), seenB = see(side_[1], n, turn);
  const double offset = n.dot(offset_) - (plane_ ? plane_->d : 0.0);
  const double offsetRate = n.dot(velocity_) + (plane_ ? 0.0 : rate.dot(offset_));
  const auto lowestAt = [&](double s) -> Reach {
    const Reach a = outermost(side_[0], seenA, s, -1.0);
    const Reach b = plane_ ? Reach{} : outermost(side_[1], seenB, s, 1.0);
    return {offset + a.at - b.at, offsetRate + a.rate - b.rate};
  };
  double c = bound(n, turn.norm(), limit);
  const Reach now = lowestAt(0.0);
  // What touches at the start to rounding starts from zero.
  const double lift = begins && now.at <= kRounding * size_ ? -now.at : 0.0;
  if (now.at + lift < 0.0) return 0.0;
  if (seenA.rate.isZero(0.0) && seenB.rate.isZero(0.0))
    return std::min(limit, firstZero(now.at + lift, now.rate, c));

  c = std::min(c, 0.0);
  double s = limit;
  for (int pass = 0; pass < kPasses; ++pass) {
    const Reach low = lowestAt(s);
    const double alpha = low.at + lift, height = alpha + s * (low.rate + 0.5 * c * s);
    if (height >= 0.0) return s;
    const double zero = alpha < 0.0 ? 0.0 : firstZero(alpha, low.rate, c);
    if (zero >= s) return s;  // only rounding is left
    s = zero;
  }
  const Reach low = lowestAt(s);
  const double height = low.at + lift + s * (low.rate + 0.5 * c * s);
  return s * (now.at + lift) / (now.at + lift - std::min(height, 0.0));
}

/// Angular velocity [rad/s] of a cap whose rim lies flat in the plane, which may lead it; or 0.
Vec3 Approach::capTurn() const {
  constexpr double kFlat = 1e-3;  // [1] of its lean
  if (wide_.tie == NormalTie::EdgeOfB && !(rimOfA(wide_).lean > kFlat))
    return side_[0].flyer.body->omega;
  if (wide_.tie == NormalTie::EdgeOfA && !(rimOfB(wide_).lean > kFlat))
    return side_[1].flyer.body->omega;
  return Vec3::Zero();
}

/// The longest step with a plane that turns; as a steady one if that is longer.
double Approach::stepTurning(const Vec3& turn, double steady, double limit, bool begins) const {
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

double Approach::cornerStep(double limit, bool begins) const {
  const double steady = stepAlong(wide_.n, Vec3::Zero(), limit, begins);
  if (steady >= limit || plane_) return steady;
  return std::max(stepTurning(planeTurn(), steady, limit, begins),
                  stepTurning(capTurn(), steady, limit, begins));
}

std::optional<double> Approach::firstTouch(double t0, double t1, bool begins) {
  double t = t0, deepest = 0.0, back = t0;
  int hovering = 0;
  bool fresh = true;
  while (t < t1) {
    // While the balls around them are well apart, only the centres matter.
    lookAt(t);
    const double balls = ballStep();
    if (balls >= t1 - t) return std::nullopt;
    if (ballGap_ > touch_) begins = false;
    if (ballGap_ > kFar * size_ && t + balls > t) {
      t += balls;
      continue;
    }
    place(t);
    if (std::exchange(fresh, false) && staysApart(t1 - t)) return std::nullopt;
    findPlane();
    // What hovers at the start may still be about to part.
    if (wide_.separation > (t == t0 ? touch_ : 0.0)) begins = false;
    if (!begins && wide_.separation <= 0.0) return t;
    if (begins && t == t0) deepest = std::min(wide_.separation, 0.0) - 4.0 * kRounding * size_;
    if (begins && (wide_.separation < deepest || ++hovering > kParting)) return back;
    double step = cornerStep(t1 - t, begins);
    if (begins && t == t0 && isExact() && step > 0.0 && wide_.separation <= kRounding * size_) {
      const double rise = -0.125 * wide_.n.dot(acceleration_) * step * step;
      if (step < t1 - t && rise < kLow * size_) return t + step;
    }
    if (begins && t == t0) back = t0 + step;
    if (begins && step < t1 - t) {
      // Half way they have parted most; what is shorter than an instant is not watched.
      const double bend = std::abs(bound(wide_.n, planeTurn().norm(), kInstant));
      step = std::max(0.5 * step, std::min(kInstant, std::sqrt(kRounding * size_ / bend)));
    }
    if (!begins) step = std::max(step, balls);
    const double next = t + step;
    if (next >= t1) return std::nullopt;
    if (next <= t) return t;
    if (!begins && wide_.separation <= touch_ && ++hovering >= kPatience) return t;
    t = next;
  }
  return std::nullopt;
}

double firstTouch(const FlyingBody& a, const FlyingBody& b, double touch, double h) {
  double first = h, whenA = std::nan(""), whenB = whenA;
  for (const Convex& partA : a.parts)
    for (const Convex& partB : b.parts) {
      Approach approach({&a.flight, &partA, &a.body, &whenA}, {&b.flight, &partB, &b.body, &whenB},
                        touch);
      if (const auto t = approach.firstTouch(0.0, first, true)) first = *t;
    }
  return first;
}

}  // namespace tumble
