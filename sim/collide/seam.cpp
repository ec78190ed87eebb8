#include "sim/collide/seam.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
bool showsOn(const PartView& side, int part, const Vec3& p, const Vec3& n, const Vec3& edge,
             double within) {
  if (!mayBeCovered(side, part)) return true;
  const Quat back = side.pose().q.conjugate();
  return isExposed(*side.parts(), part, toBody(side.pose(), p), back * n, back * edge, within);
}

bool shows(const PartView& a, int i, const PartView& b, int j, const ContactPoint& c,
           double within) {
  return showsOn(a, i, c.pa - c.ra * c.n, -c.n, c.ea, within) &&
         showsOn(b, j, c.pb + c.rb * c.n, c.n, c.eb, within);
}

// Whether the solid of one side holds a point in the world.
bool holds(const PartView& side, int part, const Vec3& p) {
  const Parts* parts = side.parts();
  const double size = boundingRadius(side.solid(part));
  if (!parts)
    return holds(PosedPart{side.solid(part), side.pose()}, p, kOnFace * (size + p.norm()));
  const Vec3 p_B = toBody(side.pose(), p);
  return std::any_of(parts->list.begin(), parts->list.end(),
                     [&](const PosedPart& other) { return holds(other, p_B, parts->flush); });
}

// Whether both points of a contact are on their solids, and one of them is in the other: a feature
// that shows elsewhere, or the far side of a solid, is not what touches.
bool overlaps(const PartView& a, int i, const PartView& b, int j, const ContactPoint& c) {
  const Vec3 pa = c.pa - c.ra * c.n, pb = c.pb + c.rb * c.n;
  const bool ofA = holds(a, i, pb), ofB = holds(b, j, pa);
  return (ofA || ofB) && holds(a, i, pa) && holds(b, j, pb);
}

// How wide [m] the seams of one side are.
double seamWidth(const PartView& side) {
  return side.parts() ? side.parts()->flush : 0.0;
}

// Whether both points of a contact are on these parts, or hardly past their ends.
bool isNear(const PosedPart& a, const PosedPart& b, const ContactPoint& c, double past) {
  return holds(a, c.pa - c.ra * c.n, past) && holds(b, c.pb + c.rb * c.n, past);
}

}  // namespace

void findExposed(const PartView& a, int i, const PartView& b, int j, const Sought& sought,
                 Manifold& out) {
  if (!convex::hasCore(a.solid(i)) || !convex::hasCore(b.solid(j))) return;
  const PosedPart partA{a.solid(i), a.poseOf(i)}, partB{b.solid(j), b.poseOf(j)};
  const Mat3 R = partB.pose.q.toRotationMatrix();
  const convex::Core coreA =
      convex::coreOf(partA.solid, R.transpose() * partA.pose.q.toRotationMatrix(),
                     R.transpose() * (partA.pose.x - partB.pose.x));
  const convex::Core coreB = convex::coreOf(partB.solid, Mat3::Identity(), Vec3::Zero());
  const double flush = std::max(seamWidth(a), seamWidth(b));
  const auto isWrong = [&](const ContactPoint& c) {
    return !shows(a, i, b, j, c, sought.within) ||
           !(sought.apart ? isNear(partA, partB, c, std::max(sought.within, kReach * flush))
                          : overlaps(a, i, b, j, c));
  };
  // Both keep their storage from call to call.
  thread_local std::vector<convex::Plane> planes;
  thread_local Manifold found;
  convex::allAxes(coreA, coreB, planes);
  for (const convex::Plane& plane : planes) {
    const double gap = plane.gap - coreA.radius - coreB.radius;
    if (gap > sought.margin) continue;
    if (gap < -sought.deepest) return;
    // All points along the plane; or the one that it is fixed to, which may be beside the facets.
    for (const bool one : {false, true}) {
      found.clear();
      if (one)
        found.push_back(convex::pointOf(plane, coreA, coreB));
      else
        convex::clipFacets(coreA, coreB, plane, flush, sought.margin, found);
      for (ContactPoint& c : found) convex::toWorld(R, partB.pose.x, c);
      std::erase_if(found, isWrong);
      if (std::any_of(found.begin(), found.end(),
                      [&](const ContactPoint& c) { return c.separation <= gap + flush; })) {
        out.insert(out.end(), found.begin(), found.end());
        return;
      }
    }
  }
}

bool isExposed(const Parts& parts, int part, const Vec3& p, const Vec3& n, const Vec3& edge,
               double within) {
  if (isFree(parts, part, p, n)) return true;
  const PosedPart& own = parts.list[static_cast<std::size_t>(part)];
  const double size = parts.size[static_cast<std::size_t>(part)];
  const double reach = std::min(std::max(kReach * parts.flush, within), kFarthest * size);
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

Left leaveCovered(const PartView& a, int i, const PartView& b, int j, std::size_t first,
                  Manifold& out) {
  if (out.size() == first || !(mayBeCovered(a, i) || mayBeCovered(b, j))) return Left::Enough;
  const auto deepest = [&] {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = first; k < out.size(); ++k) least = std::min(least, out[k].separation);
    return least;
  };
  const double before = deepest();
  const auto begin = out.begin() + static_cast<std::ptrdiff_t>(first);
  out.erase(std::remove_if(begin, out.end(),
                           [&](const ContactPoint& c) { return !shows(a, i, b, j, c, 0.0); }),
            out.end());
  if (!(before < deepest())) return Left::Enough;
  return before < 0.0 ? Left::NotDeepest : Left::NotNearest;
}

}  // namespace tumble
