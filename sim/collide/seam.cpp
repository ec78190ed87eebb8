#include "sim/collide/seam.h"

#include <algorithm>
#include <cmath>

#include "sim/collide/convex.h"
#include "sim/collide/witness.h"
#include "sim/math/frames.h"

namespace tumble {
namespace {

// How far from a contact its feature is looked at, in widths of what counts as flush; and at most,
// per size of its part.
constexpr double kReach = 1e3, kFarthest = 1e-2;
// Points of a part that are off its face by no more than this, per size and place, are on it.
constexpr double kOnFace = 1e-13;

// Whether a solid holds the point p to `slack` [m], own frame.
bool holds(const Sphere& s, const Vec3& p, double slack) {
  return p.norm() <= s.r + slack;
}
bool holds(const Box& box, const Vec3& p, double slack) {
  return (p.cwiseAbs() - box.half).maxCoeff() <= slack;
}
bool holds(const Cylinder& c, const Vec3& p, double slack) {
  return std::abs(p.y()) <= 0.5 * c.h + slack &&
         std::sqrt(p.x() * p.x() + p.z() * p.z()) <= c.r + slack;
}
bool holds(const Capsule& c, const Vec3& p, double slack) {
  const double beyond = std::max(std::abs(p.y()) - 0.5 * c.h, 0.0);
  return Vec3(p.x(), beyond, p.z()).norm() <= c.r + slack;
}
bool holds(const Ellipsoid& e, const Vec3& p, double slack) {
  return p.cwiseQuotient(e.half + Vec3::Constant(slack)).norm() <= 1.0;
}
bool holds(const Hull& hull, const Vec3& p, double slack) {
  const Polyhedron& solid = *hull.solid;
  const Vec3 q = p + hull.origin;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Vec3& foot = solid.points[static_cast<std::size_t>(solid.faces[f][0])];
    if (solid.normals[f].dot(q - foot) > slack) return false;
  }
  return true;
}
template <class S>
bool holds(const S&, const Vec3&, double) {
  return false;
}

bool holds(const PosedPart& part, const Vec3& p, double slack) {
  const Vec3 p_P = toBody(part.pose, p);
  return std::visit([&](const auto& s) { return holds(s, p_P, slack); }, part.solid);
}

// Greatest height of a part along n.
double topOf(const PosedPart& part, const Vec3& n) {
  return n.dot(part.pose.x) + reachAlong(part.solid, part.pose.q.conjugate() * n);
}

// Whether a part has points above the plane through q square to n.
bool rises(const PosedPart& part, const Vec3& q, const Vec3& n, double slack) {
  return topOf(part, n) - n.dot(q) > slack;
}

bool isFree(const Parts& parts, int part, const Vec3& q, const Vec3& n) {
  const std::vector<int>& beside = parts.beside[static_cast<std::size_t>(part)];
  return std::none_of(beside.begin(), beside.end(), [&](int k) {
    const PosedPart& other = parts.list[static_cast<std::size_t>(k)];
    return rises(other, q, n, parts.flush) && holds(other, q, parts.flush);
  });
}

// A direction across n.
Vec3 across(const Vec3& n) {
  int least = 0;
  n.cwiseAbs().minCoeff(&least);
  return n.cross(Vec3::Unit(least)).normalized();
}

bool mayBeCovered(const PartView& side, int part) {
  return side.parts() && !side.parts()->beside[static_cast<std::size_t>(part)].empty();
}

// The surface point of one side of a contact, seen by its body.
bool showsOn(const PartView& side, int part, const Vec3& p, const Vec3& n, const Vec3& edge) {
  if (!mayBeCovered(side, part)) return true;
  const Quat back = side.pose().q.conjugate();
  return isExposed(*side.parts(), part, toBody(side.pose(), p), back * n, back * edge);
}

bool shows(const PartView& a, int i, const PartView& b, int j, const ContactPoint& c) {
  return showsOn(a, i, c.pa - c.ra * c.n, -c.n, c.ea) &&
         showsOn(b, j, c.pb + c.rb * c.n, c.n, c.eb);
}

// The points along the widest plane of a face of either part that is a contact of the solids.
void findExposed(const PartView& a, int i, const PartView& b, int j, double margin,
                 Manifold& found) {
  const Pose poseA = a.poseOf(i), poseB = b.poseOf(j);
  if (!convex::hasCore(a.solid(i)) || !convex::hasCore(b.solid(j))) return;
  const Mat3 R = poseB.q.toRotationMatrix();
  const convex::Core coreA = convex::coreOf(a.solid(i), R.transpose() * poseA.q.toRotationMatrix(),
                                            R.transpose() * (poseA.x - poseB.x));
  const convex::Core coreB = convex::coreOf(b.solid(j), Mat3::Identity(), Vec3::Zero());
  std::vector<convex::Plane> planes;
  const auto offer = [&](NormalTie tie, int face, const Vec3& n) {
    convex::Plane& plane = planes.emplace_back();
    plane.tie = tie;
    (tie == NormalTie::FaceOfA ? plane.i : plane.j) = face;
    plane.n = n;
    plane.gap = coreGap(coreA, coreB, n);
  };
  for (std::size_t f = 0; f < coreB.normals.size(); ++f)
    offer(NormalTie::FaceOfB, static_cast<int>(f), coreB.normals[f]);
  for (std::size_t f = 0; f < coreA.normals.size(); ++f)
    offer(NormalTie::FaceOfA, static_cast<int>(f), -coreA.normals[f]);
  std::stable_sort(planes.begin(), planes.end(),
                   [](const auto& p, const auto& q) { return p.gap > q.gap; });
  for (const convex::Plane& plane : planes) {
    found.clear();
    convex::clipFacets(coreA, coreB, plane, a.parts() ? a.parts()->flush : b.parts()->flush, margin,
                       found);
    for (ContactPoint& c : found) convex::toWorld(R, poseB.x, c);
    std::erase_if(found, [&](const ContactPoint& c) { return !shows(a, i, b, j, c); });
    if (!found.empty()) return;
  }
}

}  // namespace

bool isExposed(const Parts& parts, int part, const Vec3& p, const Vec3& n, const Vec3& edge) {
  if (isFree(parts, part, p, n)) return true;
  const PosedPart& own = parts.list[static_cast<std::size_t>(part)];
  const double size = parts.size[static_cast<std::size_t>(part)];
  const double reach = std::min(kReach * parts.flush, kFarthest * size);
  const double off = kOnFace * (size + p.norm());
  // From the point itself, but on the plane that just touches the part, so that what n leans shows.
  const Vec3 foot = p + (topOf(own, n) - n.dot(p)) * n;
  const auto freeAt = [&](const Vec3& way) {
    const Vec3 q = foot + reach * way;
    return holds(own, q, off) && isFree(parts, part, q, n);
  };
  if (!edge.isZero(0.0) && (freeAt(edge) || freeAt(-edge))) return true;
  // All around in the plane, in eighths and between.
  constexpr double kCosine[] = {1.0, 0.92387953251128674, 0.70710678118654752, 0.38268343236508977};
  const Vec3 u = across(n), v = n.cross(u);
  for (int k = 0; k < 16; ++k) {
    const int m = k % 4;
    const double c = kCosine[m], s = m == 0 ? 0.0 : kCosine[4 - m];
    const int turn = k / 4;
    const double x = turn == 0 ? c : turn == 1 ? -s : turn == 2 ? -c : s;
    const double y = turn == 0 ? s : turn == 1 ? c : turn == 2 ? -s : -c;
    if (freeAt(x * u + y * v)) return true;
  }
  return false;
}

void leaveCovered(const PartView& a, int i, const PartView& b, int j, double margin,
                  std::size_t first, Manifold& out) {
  if (out.size() == first || !(mayBeCovered(a, i) || mayBeCovered(b, j))) return;
  double deepest = 0.0;
  for (std::size_t k = first; k < out.size(); ++k) deepest = std::min(deepest, out[k].separation);
  const auto begin = out.begin() + static_cast<std::ptrdiff_t>(first);
  out.erase(std::remove_if(begin, out.end(),
                           [&](const ContactPoint& c) { return !shows(a, i, b, j, c); }),
            out.end());
  if (out.size() > first || deepest == 0.0) return;
  Manifold found;
  findExposed(a, i, b, j, margin, found);
  out.insert(out.end(), found.begin(), found.end());
}

}  // namespace tumble
