// Chapter 5, collide: any convex solid against any other, and against a half-space.
#include "sim/collide/convex.h"

#include <cmath>

#include "sim/collide/facet.h"
#include "sim/collide/pairs.h"
#include "sim/math/frames.h"

namespace tumble::convex {

void toWorld(const Mat3& Rb, const Vec3& xb, ContactPoint& c) {
  c.n = Rb * c.n;
  c.pb = xb + Rb * c.pb;
  c.pa = c.pb + (c.separation + c.ra + c.rb) * c.n;
  c.p = c.pb + (c.rb + 0.5 * c.separation) * c.n;
  c.ea = Rb * c.ea;
  c.eb = Rb * c.eb;
}

}  // namespace tumble::convex

namespace tumble::pairs {
namespace {

using convex::Core;
using convex::Plane;

// Differences below this part of the solids' size are rounding.
constexpr double kRelativeTolerance = 1e-9;

// Only the difference of the centres enters, so that solids far from the world's origin lose
// nothing but the rounding of their own positions.
struct SeenFromB {
  Mat3 Rb;
  Core a, b;

  SeenFromB(const Shape& shapeA, const Pose& poseA, const Shape& shapeB, const Pose& poseB)
      : Rb(poseB.q.toRotationMatrix()),
        a(convex::coreOf(shapeA, Rb.transpose() * poseA.q.toRotationMatrix(),
                         Rb.transpose() * (poseA.x - poseB.x))),
        b(convex::coreOf(shapeB, Mat3::Identity(), Vec3::Zero())) {}

  double tolerance() const {
    return kRelativeTolerance * std::sqrt((a.size + a.radius) * (b.size + b.radius));
  }
  double gap(const Plane& plane) const { return plane.gap - (a.radius + b.radius); }
};

}  // namespace

double convexSeparation(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  const SeenFromB seen(a, poseA, b, poseB);
  return seen.gap(convex::widestPlane(seen.a, seen.b, 0.0));
}

ContactPoint convexPlane(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  const SeenFromB seen(a, poseA, b, poseB);
  ContactPoint c = convex::pointOf(convex::widestPlane(seen.a, seen.b, 0.0), seen.a, seen.b);
  convex::toWorld(seen.Rb, poseB.x, c);
  return c;
}

void convexCollide(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB,
                   double margin, Manifold& out) {
  const SeenFromB seen(a, poseA, b, poseB);
  const Plane plane =
      convex::widestPlane(seen.a, seen.b, seen.tolerance(), margin + seen.a.radius + seen.b.radius);
  if (seen.gap(plane) > margin) return;
  const std::size_t first = out.size();
  convex::clipFacets(seen.a, seen.b, plane, seen.tolerance(), margin, out);
  for (std::size_t k = first; k < out.size(); ++k) convex::toWorld(seen.Rb, poseB.x, out[k]);
}

}  // namespace tumble::pairs
