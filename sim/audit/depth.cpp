#include "sim/audit/depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/collide/collide.h"
#include "sim/collide/gjk.h"

namespace tumble {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// What rounding leaves between two ways to measure one gap, of the size.
constexpr double kRounding = 1e-12;

double reachInBody(const Sphere& s, const Vec3& d) {
  return s.r * d.norm();
}
double reachInBody(const Box& box, const Vec3& d) {
  return box.half.dot(d.cwiseAbs());
}
double reachInBody(const Cylinder& c, const Vec3& d) {
  return 0.5 * c.h * std::abs(d.y()) + c.r * std::sqrt(d.x() * d.x() + d.z() * d.z());
}
double reachInBody(const Capsule& c, const Vec3& d) {
  return 0.5 * c.h * std::abs(d.y()) + c.r * d.norm();
}
double reachInBody(const Ellipsoid& e, const Vec3& d) {
  return e.half.cwiseProduct(d).norm();
}
double reachInBody(const Hull& hull, const Vec3& d) {
  double most = -kInfinity;
  for (const Vec3& p : hull.solid->points) most = std::max(most, d.dot(p - hull.origin));
  return most;
}
template <class Other>
double reachInBody(const Other&, const Vec3&) {
  return kInfinity;
}

Pose posed(const Pose& body, const Pose& part) {
  return {body.x + body.q * part.x, body.q * part.q};
}

double sizeOf(const Shape& solid) {
  const double radius = boundingRadius(solid);
  return std::isfinite(radius) ? radius : 0.0;
}

/// The widest gap near n, by turning it to all sides, by ever less.
double widened(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, Vec3 n,
               double gap) {
  constexpr double kFirst = 0.1, kLast = 1e-9;  // [rad]
  for (double turn = kFirst; turn > kLast; turn *= 0.5) {
    const Vec3 t1 = n.unitOrthogonal(), t2 = n.cross(t1);
    for (const Vec3& side : {t1, t2, Vec3(-t1), Vec3(-t2)}) {
      const Vec3 turned = (n + turn * side).normalized();
      const double wider = gapAlong(a, poseA, b, poseB, turned);
      if (wider > gap) gap = wider, n = turned;
    }
  }
  return gap;
}

double provenGapOf(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  const ContactPoint plane = separatingPlane(a, poseA, b, poseB);
  if (!std::isfinite(plane.separation)) return kInfinity;
  const double gap = gapAlong(a, poseA, b, poseB, plane.n);
  const double rounding = kRounding * (sizeOf(a) + sizeOf(b));
  if (gap >= std::min(0.0, plane.separation) - rounding) return gap;
  return widened(a, poseA, b, poseB, plane.n, gap);
}

/// A part in the world, and the radius [m] of a ball around it.
struct Placed {
  const Shape& solid;
  Pose at;
  double radius;
};

void place(std::span<const PosedPart> parts, const Pose& body, std::vector<Placed>& placed) {
  placed.clear();
  for (const PosedPart& part : parts)
    placed.push_back({part.solid, posed(body, part.pose), boundingRadius(part.solid)});
}

/// The point of a hull farthest along d.
Vec3 farthest(const Hull& hull, const Pose& at, const Vec3& d) {
  const Vec3 d_B = at.q.conjugate() * d;
  const Vec3* most = &hull.solid->points[0];
  for (const Vec3& p : hull.solid->points)
    if (d_B.dot(p) > d_B.dot(*most)) most = &p;
  return at.x + at.q * (*most - hull.origin);
}

/// Whether a direction that is soon found shows two hulls to be more than `least` [m] apart.
bool isWider(const Placed& p, const Placed& q, double least) {
  const Hull *a = std::get_if<Hull>(&p.solid), *b = std::get_if<Hull>(&q.solid);
  const Vec3 start = p.at.x - q.at.x;
  if (!a || !b || !(least < kInfinity) || start.isZero(0.0)) return false;
  const auto outermost = [&](const Vec3& n) {
    return gjk::Outermost{farthest(*a, p.at, -n), farthest(*b, q.at, n)};
  };
  constexpr double kSoon = 1e-3;  // of the size: nearer, it is not soon
  const double size = p.radius + q.radius, enough = std::max(least, 0.0) + kRounding * size;
  const gjk::Nearest nearest = gjk::nearest(outermost, start, kSoon * size, enough);
  return nearest.lower > enough;
}

}  // namespace

double reachOf(const Shape& solid, const Pose& pose, const Vec3& d, const Vec3& from) {
  const Vec3 d_B = pose.q.conjugate() * d;
  return d.dot(pose.x - from) +
         std::visit([&](const auto& s) { return reachInBody(s, d_B); }, solid);
}

double gapAlong(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB,
                const Vec3& n) {
  // Of a half-space there is one plane alone.
  if (const HalfSpace* plane = std::get_if<HalfSpace>(&b))
    return -reachOf(a, poseA, -plane->n, Vec3::Zero()) - plane->d;
  if (const HalfSpace* plane = std::get_if<HalfSpace>(&a))
    return -reachOf(b, poseB, -plane->n, Vec3::Zero()) - plane->d;
  return -reachOf(a, poseA, -n, poseB.x) - reachOf(b, poseB, n, poseB.x);
}

double provenGap(std::span<const PosedPart> a, const Pose& poseA, std::span<const PosedPart> b,
                 const Pose& poseB) {
  // All keep their storage from call to call.
  thread_local std::vector<Placed> ofA, ofB;
  thread_local std::vector<std::pair<const Placed*, const Placed*>> near;
  place(a, poseA, ofA);
  place(b, poseB, ofB);
  near.clear();
  double least = kInfinity;
  for (const Placed& p : ofA)
    for (const Placed& q : ofB) {
      const double balls = (p.at.x - q.at.x).norm() - p.radius - q.radius;
      if (balls > 0.0)
        least = std::min(least, balls);
      else
        near.emplace_back(&p, &q);
    }
  for (const auto& [p, q] : near)
    if (!isWider(*p, *q, least))
      least = std::min(least, provenGapOf(p->solid, p->at, q->solid, q->at));
  return least;
}

}  // namespace tumble
