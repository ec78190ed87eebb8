// Chapter 5, collide: any convex solid against a half-space, vertex by vertex; of a cylinder, eight
// points of the rim of each cap, and the lowest.
#include <algorithm>
#include <cmath>

#include "sim/collide/core.h"
#include "sim/collide/facet.h"
#include "sim/collide/pairs.h"

namespace tumble::pairs {
namespace {

using convex::Core;

// A cylinder whose axis is level to this lies on its side.
constexpr double kLying = 1e-9;

// World axes about the body's centre, so that nothing is lost far from the origin.
Core turned(const Shape& a, const Pose& poseA) {
  return convex::coreOf(a, poseA.q.toRotationMatrix(), Vec3::Zero());
}

ContactPoint pointAt(const Core& core, const Vec3& p, double round, std::uint32_t code,
                     const Pose& poseA, const HalfSpace& b) {
  ContactPoint c;
  c.n = b.n;
  c.tie = NormalTie::FaceOfB;
  c.ra = core.radius + round;
  const double height = (b.n.dot(poseA.x) - b.d) + b.n.dot(p);
  c.separation = height - c.ra;
  c.feature = featurePair(code, faceCode(1, true));
  c.pa = poseA.x + p;
  c.pb = c.pa - height * b.n;
  c.p = c.pb + 0.5 * c.separation * b.n;
  return c;
}

// All points of a solid that could be the lowest.
template <class Visit>
void visitPoints(const Core& core, const Pose& poseA, const HalfSpace& b, Visit visit) {
  if (!core.isCylinder()) {
    for (std::size_t k = 0; k < core.points.size(); ++k)
      visit(pointAt(core, core.points[k], 0.0, convex::vertexCode(static_cast<int>(k)), poseA, b));
    return;
  }
  const Vec3 u = core.axis();
  if (std::abs(u.dot(b.n)) < kLying) {
    for (const int k : {0, 1})
      visit(pointAt(core, core.points[k], core.disc, convex::vertexCode(18 + k), poseA, b));
    return;
  }
  for (const double side : {-1.0, 1.0}) {
    const Vec3 cap = side * u;
    // The rim as the facet shows it: eight points, and the lowest if the cap leans.
    const convex::Facet rim = convex::capOf(core, -b.n, cap);
    for (std::size_t k = 0; k < rim.corners.size(); ++k)
      visit(pointAt(core, rim.corners[k], 0.0, rim.cornerCodes[k], poseA, b));
  }
}

ContactPoint lowest(const Shape& a, const Pose& poseA, const HalfSpace& b) {
  const Core core = turned(a, poseA);
  ContactPoint low;
  low.separation = std::numeric_limits<double>::infinity();
  visitPoints(core, poseA, b, [&](const ContactPoint& c) {
    if (c.separation < low.separation) low = c;
  });
  return low;
}

}  // namespace

double convexSeparation(const Shape& a, const Pose& poseA, const HalfSpace& b) {
  return lowest(a, poseA, b).separation;
}

ContactPoint convexPlane(const Shape& a, const Pose& poseA, const HalfSpace& b) {
  return lowest(a, poseA, b);
}

void convexCollide(const Shape& a, const Pose& poseA, const HalfSpace& b, double margin,
                   Manifold& out) {
  visitPoints(turned(a, poseA), poseA, b, [&](const ContactPoint& c) {
    if (c.separation <= margin) out.push_back(c);
  });
}

}  // namespace tumble::pairs
