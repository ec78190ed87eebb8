// Chapter 5, collide: any convex solid against a half-space, vertex by vertex; of a cylinder, the
// lowest point of the rim of each cap, and of one that faces the plane others around it.
#include "sim/collide/core.h"
#include "sim/collide/ellipsoid.h"
#include "sim/collide/facet.h"
#include "sim/collide/pairs.h"
#include "sim/collide/rim_points.h"

namespace tumble::pairs {
namespace {

using convex::Core;

// World axes about the body's centre, so that nothing is lost far from the origin.
Core turned(const Shape& a, const Pose& poseA) {
  return convex::coreOf(a, poseA.q.toRotationMatrix(), Vec3::Zero());
}

ContactPoint pointAt(const Core& core, const Vec3& p, std::uint32_t code, const Pose& poseA,
                     const HalfSpace& b) {
  ContactPoint c;
  c.n = b.n;
  c.tie = NormalTie::FaceOfB;
  c.ra = core.radius;
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
  if (core.isEllipsoid()) {
    const Osculating torus = osculatingTorus(core.half, core.axes, -b.n);
    const Vec3 low = outermostOnEllipsoid(core.half, core.axes, -b.n);
    ContactPoint c = pointAt(core, low + torus.round * b.n, convex::vertexCode(0), poseA, b);
    c.separation = (b.n.dot(poseA.x) - b.d) + b.n.dot(low);
    c.ra = torus.round;
    c.pb = c.pa - (c.separation + c.ra) * b.n;
    c.p = c.pb + 0.5 * c.separation * b.n;
    c.rimA = torus.rim;
    c.ea = torus.axis;
    c.halfA = core.half;
    visit(c);
    return;
  }
  if (!core.isCylinder()) {
    for (std::size_t k = 0; k < core.points.size(); ++k)
      visit(pointAt(core, core.points[k], convex::vertexCode(static_cast<int>(k)), poseA, b));
    return;
  }
  for (const int cap : {0, 1})
    convex::visitRim(core, cap, -b.n, [&](const convex::RimSpot& spot) {
      ContactPoint c = pointAt(core, spot.p, spot.code, poseA, b);
      if (spot.follows) c.rimA = core.disc, c.ea = core.axis();
      visit(c);
    });
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
