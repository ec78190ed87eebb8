#include "sim/collide/witness.h"

#include <cmath>
#include <limits>

namespace tumble {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Outermost height [m] of a shape above its origin along n, body frame.
double reach(const Sphere& s, const Vec3&) {
  return s.r;
}
double reach(const Box& box, const Vec3& n) {
  return n.cwiseAbs().dot(box.half);
}
double reach(const Cylinder& c, const Vec3& n) {
  return c.r * std::sqrt(n.x() * n.x() + n.z() * n.z()) + 0.5 * c.h * std::abs(n.y());
}
double reach(const Capsule& c, const Vec3& n) {
  return c.r + 0.5 * c.h * std::abs(n.y());
}
double reach(const Ellipsoid& e, const Vec3& n) {
  return e.half.cwiseProduct(n).norm();
}
double reach(const Hull& hull, const Vec3& n) {
  double far = -kInfinity;
  for (const Vec3& p : hull.solid->points) far = std::max(far, n.dot(p));
  return far - n.dot(hull.origin);
}
double reach(const Particle& p, const Vec3&) {
  return p.radius;
}
double reach(const HalfSpace&, const Vec3&) {
  return kInfinity;
}
double reach(const Mesh&, const Vec3&) {
  return kInfinity;
}
double reach(const Compound& compound, const Vec3& n) {
  double far = -kInfinity;
  for (const Part& part : compound.parts) {
    const Pose at = poseInBody(compound, part);
    const Vec3 n_P = at.q.conjugate() * n;
    const double own = std::visit([&](const auto& s) { return reach(s, n_P); }, part.solid);
    far = std::max(far, n.dot(at.x) + own);
  }
  return far;
}

double reach(const Shape& shape, const Quat& q, const Vec3& n) {
  return reachAlong(shape, q.conjugate() * n);
}

}  // namespace

double reachAlong(const Shape& shape, const Vec3& n) {
  return std::visit([&](const auto& s) { return reach(s, n); }, shape);
}

[[gnu::flatten]] Witness witnessOf(const ContactPoint& plane, const Pose& poseA,
                                   const Pose& poseB) {
  Witness witness{.known = plane.separation > 0.0, .tie = plane.tie};
  if (!witness.known) return witness;
  const bool onA = plane.tie == NormalTie::FaceOfA || plane.tie == NormalTie::EdgeOfA;
  witness.n_B = (onA ? poseA.q : poseB.q).conjugate() * plane.n;
  if (plane.tie == NormalTie::Edges) {
    witness.ea_B = poseA.q.conjugate() * plane.ea;
    witness.eb_B = poseB.q.conjugate() * plane.eb;
  }
  return witness;
}

Vec3 normalOf(const Witness& w, const Quat& qa, const Quat& qb) {
  switch (w.tie) {
    case NormalTie::FaceOfA:
    case NormalTie::EdgeOfA:
      return qa * w.n_B;
    case NormalTie::Edges: {
      const Vec3 product = (qa * w.ea_B).cross(qb * w.eb_B).normalized();
      return product.dot(qb * w.n_B) < 0.0 ? Vec3(-product) : product;
    }
    default:
      return qb * w.n_B;
  }
}

double gapAlong(const Witness& w, const Shape& a, const Pose& poseA, const Shape& b,
                const Pose& poseB) {
  // A half-space has but one plane.
  if (const HalfSpace* floor = std::get_if<HalfSpace>(&b))
    return floor->n.dot(poseA.x) - floor->d - reach(a, poseA.q, -floor->n);
  if (const HalfSpace* floor = std::get_if<HalfSpace>(&a))
    return floor->n.dot(poseB.x) - floor->d - reach(b, poseB.q, -floor->n);
  const Vec3 n = normalOf(w, poseA.q, poseB.q);
  return n.dot(poseA.x - poseB.x) - reach(a, poseA.q, -n) - reach(b, poseB.q, n);
}

bool showsApart(const Witness& w, const Shape& a, const Pose& poseA, const Shape& b,
                const Pose& poseB, double margin) {
  return w.known && showsApart(w, a, poseA, boundingRadius(a), b, poseB, boundingRadius(b), margin);
}

bool showsApart(const Witness& w, const Shape& a, const Pose& poseA, double radiusA, const Shape& b,
                const Pose& poseB, double radiusB, double margin) {
  // Manifolds take what lies on a side to 1e-9 of the size, and are rounded themselves.
  constexpr double kSlack = 1e-8;
  if (!w.known) return false;
  const double size = (std::isfinite(radiusA) ? radiusA : 0.0) +
                      (std::isfinite(radiusB) ? radiusB : 0.0) + (poseA.x - poseB.x).norm();
  return gapAlong(w, a, poseA, b, poseB) > margin + kSlack * size;
}

}  // namespace tumble
