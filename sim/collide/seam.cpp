#include "sim/collide/seam.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collide/convex.h"
#include "sim/collide/features.h"
#include "sim/collide/witness.h"
#include "sim/math/frames.h"

namespace tumble {
namespace {

// How far from a contact its feature is looked at, in widths of what counts as flush; and at most,
// per size of its part.
constexpr double kReach = 1e3, kFarthest = 1e-2;
// Points of a part that are off its face by no more than this, per size and place, are on it.
constexpr double kOnFace = 1e-13;
// Normals of a ball that lean by less against each other are not told apart by what its part shows.
constexpr double kAlike = 1e-6;

// How far [m] a solid must grow at least to hold the point p, own frame; < 0 inside. Of a hull no
// more is asked once it is over `enough`.
double outsideOf(const Sphere& s, const Vec3& p, double) {
  return p.norm() - s.r;
}
double outsideOf(const Box& box, const Vec3& p, double) {
  return (p.cwiseAbs() - box.half).maxCoeff();
}
double outsideOf(const Cylinder& c, const Vec3& p, double) {
  return std::max(std::abs(p.y()) - 0.5 * c.h, std::sqrt(p.x() * p.x() + p.z() * p.z()) - c.r);
}
double outsideOf(const Capsule& c, const Vec3& p, double) {
  const double beyond = std::max(std::abs(p.y()) - 0.5 * c.h, 0.0);
  return Vec3(p.x(), beyond, p.z()).norm() - c.r;
}
double outsideOf(const Ellipsoid& e, const Vec3& p, double) {
  return (p.cwiseQuotient(e.half).norm() - 1.0) * e.half.minCoeff();
}
double outsideOf(const Hull& hull, const Vec3& p, double enough) {
  const Polyhedron& solid = *hull.solid;
  const Vec3 q = p + hull.origin;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < solid.faces.size() && !(most > enough); ++f) {
    const Vec3& foot = solid.points[static_cast<std::size_t>(solid.faces[f][0])];
    most = std::max(most, solid.normals[f].dot(q - foot));
  }
  return most;
}
template <class S>
double outsideOf(const S&, const Vec3&, double) {
  return std::numeric_limits<double>::infinity();
}
// A plane stands in the world, whatever pose it has.
double outsideOf(const Shape& solid, const Pose& pose, const Vec3& p, double enough) {
  if (const HalfSpace* plane = std::get_if<HalfSpace>(&solid)) return plane->n.dot(p) - plane->d;
  const Vec3 p_P = toBody(pose, p);
  return std::visit([&](const auto& s) { return outsideOf(s, p_P, enough); }, solid);
}

// Whether a solid holds the point p to `slack` [m], own frame.
bool holds(const Shape& solid, const Pose& pose, const Vec3& p, double slack) {
  return outsideOf(solid, pose, p, slack) <= slack;
}
bool holds(const PosedPart& part, const Vec3& p, double slack) {
  return holds(part.solid, part.pose, p, slack);
}

// Greatest height of a part along n.
double topOf(const PosedPart& part, const Vec3& n) {
  return n.dot(part.pose.x) + reachAlong(part.solid, part.pose.q.conjugate() * n);
}

// Whether a part covers q, along n, over the plane through `top`: it holds q to what is flush, and
// rises above the plane near by. One that q is `out` outside of is up to there as far below, and
// comes up to its height H over the plane on a way no longer than itself: in a valley it does so
// far away, or at once. On its face it is not below: what rounding has of `out` must not tell.
bool covers(const Parts& parts, int part, const Vec3& q, const Vec3& top, const Vec3& n) {
  const PosedPart& other = parts.list[static_cast<std::size_t>(part)];
  const double out = outsideOf(other.solid, other.pose, q, parts.flush);
  if (!(out <= parts.flush)) return false;
  const double height = topOf(other, n) - n.dot(top);
  if (!(height > parts.flush)) return false;
  const double way = 2.0 * parts.radius[static_cast<std::size_t>(part)],
               off = kOnFace * (parts.size[static_cast<std::size_t>(part)] + q.norm());
  return out <= off || out * way <= kReach * parts.flush * (height + out);
}

// Whether no other part covers q over the plane through `top` square to n.
bool isFree(const Parts& parts, int part, const Vec3& q, const Vec3& top, const Vec3& n) {
  const std::vector<int>& beside = parts.beside[static_cast<std::size_t>(part)];
  return std::none_of(beside.begin(), beside.end(),
                      [&](int k) { return covers(parts, k, q, top, n); });
}
bool isFree(const Parts& parts, int part, const Vec3& q, const Vec3& n) {
  return isFree(parts, part, q, q, n);
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
  if (!parts) return holds(side.solid(part), side.pose(), p, kOnFace * (size + p.norm()));
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

// How high [m] a step between parts of one side is none.
double levelOf(const PartView& side) {
  return side.parts() ? side.parts()->level : 0.0;
}

// How wide [m] the seams of one side are.
double seamWidth(const PartView& side) {
  return side.parts() ? side.parts()->flush : 0.0;
}

// Whether a point in the world is on the surface of one side, with nothing of it higher over the
// plane square to n.
bool isOn(const PartView& side, int part, const Vec3& q, const Vec3& n, double slack) {
  if (!side.parts()) return holds(side.solid(part), side.pose(), q, slack);
  const Parts& parts = *side.parts();
  const Vec3 q_B = toBody(side.pose(), q), n_B = side.pose().q.conjugate() * n;
  const auto holdsIt = [&](int k) {
    return holds(parts.list[static_cast<std::size_t>(k)], q_B, slack);
  };
  const std::vector<int>& beside = parts.beside[static_cast<std::size_t>(part)];
  return isFree(parts, part, q_B, n_B) &&
         (holdsIt(part) || std::any_of(beside.begin(), beside.end(), holdsIt));
}

// Whether the surface of one side goes on from a point in the world both ways along `way`, at its
// own height over the plane square to n.
bool goesOn(const PartView& side, int part, const Vec3& p, const Vec3& n, const Vec3& way,
            double slack) {
  return isOn(side, part, p + way, n, slack) && isOn(side, part, p - way, n, slack);
}

// Whether test(direction [1]) holds for the edge of a solid that a point is named after, or for one
// of those at its corner; own frame.
template <class Test>
bool anyEdgeAt(const Shape& solid, std::uint32_t code, const Test& test) {
  const std::uint32_t kind = code & kKindCode, number = code & (kEdgeCode - 1);
  const bool isEdge = kind == kEdgeCode;
  if (!isEdge && kind != 0) return false;
  if (std::holds_alternative<Capsule>(solid)) return isEdge && test(Vec3(Vec3::UnitY()));
  if (std::holds_alternative<Box>(solid))
    return isEdge ? test(Vec3(Vec3::Unit(static_cast<int>(number >> 2))))
                  : test(Vec3(Vec3::UnitX())) || test(Vec3(Vec3::UnitY())) ||
                        test(Vec3(Vec3::UnitZ()));
  const Hull* hull = std::get_if<Hull>(&solid);
  if (!hull) return false;
  const Polyhedron& own = *hull->solid;
  const auto along = [&](const Polyhedron::Edge& e) {
    const Vec3 way =
        own.points[static_cast<std::size_t>(e.to)] - own.points[static_cast<std::size_t>(e.from)];
    return test(Vec3(way.normalized()));
  };
  if (isEdge) return along(own.edges[number]);
  const int corner = static_cast<int>(number);
  return std::any_of(own.edges.begin(), own.edges.end(), [&](const Polyhedron::Edge& e) {
    return (e.from == corner || e.to == corner) && along(e);
  });
}

// One side of a contact of a face.
struct Side {
  const PartView& view;
  int part;
  std::uint32_t code;  // of its feature
  Vec3 p, n;           // [m] on its surface; [1] out of it
  double radius;       // [m] about the point that touches
  Vec3 e;              // [1] as the contact has it where edges cross, with the radius of a rim [m]
  double rim;

  // Whether the solid goes on all around, `way` [m] and across it.
  bool isWithin(const Vec3& way, double slack) const {
    return radius == 0.0 && goesOn(view, part, p, n, way, slack) &&
           goesOn(view, part, p, n, n.cross(way), slack);
  }
};

// Whether a corner of what two faces share is none: it is within the face of one solid, and on the
// other an edge that it is on goes on both ways.
bool isBetween(const PartView& a, int i, const PartView& b, int j, const ContactPoint& c) {
  if (c.tie != NormalTie::FaceOfA && c.tie != NormalTie::FaceOfB) return false;
  const Side ofA{a, i, featureOfA(c.feature), c.pa - c.ra * c.n, -c.n, c.ra, c.ea, c.rimA};
  const Side ofB{b, j, featureOfB(c.feature), c.pb + c.rb * c.n, c.n, c.rb, c.eb, c.rimB};
  const double slack = std::max(levelOf(a), levelOf(b)), reach = kReach * slack;
  const auto isBetweenOn = [&](const Side& on, const Side& within) {
    const double far = kFarthest * on.view.radiusOf(on.part);
    // What bends by a hair goes on nearby, and is off by a hair's share of the way further on: a
    // corner, and it may be the lowest. What is off by more has ended on the way.
    const auto bends = [&](const Vec3& way) {
      return on.rim == 0.0 && on.radius == 0.0 &&
             !isOn(on.view, on.part, on.p + way, on.n, slack) &&
             isOn(on.view, on.part, on.p + way, on.n, far / kReach);
    };
    const auto goesAlong = [&](const Vec3& edge) {
      const Vec3 way = reach * edge;
      return goesOn(on.view, on.part, on.p, on.n, way, slack) && within.isWithin(way, slack) &&
             !(bends(far * edge) || bends(-far * edge));
    };
    if (c.crosses) return goesAlong(on.rim > 0.0 ? Vec3(c.n.cross(on.e).normalized()) : on.e);
    const Quat q = on.view.poseOf(on.part).q;
    return anyEdgeAt(on.view.solid(on.part), on.code,
                     [&](const Vec3& edge) { return goesAlong(q * edge); });
  };
  return isBetweenOn(ofA, ofB) || isBetweenOn(ofB, ofA);
}

void leaveBetween(const PartView& a, int i, const PartView& b, int j, std::size_t first,
                  Manifold& out) {
  out.erase(std::remove_if(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                           [&](const ContactPoint& c) { return isBetween(a, i, b, j, c); }),
            out.end());
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
    return !(sought.apart ? isNear(partA, partB, c, std::max(sought.within, kReach * flush))
                          : overlaps(a, i, b, j, c)) ||
           !shows(a, i, b, j, c, sought.within);
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
      if (std::any_of(found.begin(), found.end(), [&](const ContactPoint& c) {
            return c.separation <= gap + flush && !isWrong(c);
          })) {
        std::erase_if(found, isWrong);
        const std::size_t first = out.size();
        out.insert(out.end(), found.begin(), found.end());
        leaveBetween(a, i, b, j, first, out);
        return;
      }
    }
  }
}

bool isExposed(const Parts& parts, int part, const Vec3& p, const Vec3& n, const Vec3& edge,
               double within) {
  const PosedPart& own = parts.list[static_cast<std::size_t>(part)];
  const double size = parts.size[static_cast<std::size_t>(part)];
  const double reach = std::min(std::max(kReach * parts.flush, within), kFarthest * size);
  const double off = kOnFace * (size + p.norm());
  // From the point itself, but on the plane that just touches the part, so that what n leans shows.
  const Vec3 foot = p + (topOf(own, n) - n.dot(p)) * n;
  // What rises no higher than the part itself does not cover it: a part that shares one of its
  // edges leans as it does.
  if (isFree(parts, part, p, foot, n)) return true;
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

void leaveBeside(const PartView& a, const PartView& b, Manifold& out) {
  const double reach = kReach * std::max(levelOf(a), levelOf(b));
  const auto isFace = [](const ContactPoint& c) {
    return c.tie == NormalTie::FaceOfA || c.tie == NormalTie::FaceOfB;
  };
  const auto isBeside = [&](const ContactPoint& c) {
    return !isFace(c) && c.ra + c.rb > 0.0 &&
           std::any_of(out.begin(), out.end(), [&](const ContactPoint& d) {
             return isFace(d) && (c.p - d.p).norm() <= reach && (c.n - d.n).norm() <= kAlike;
           });
  };
  std::erase_if(out, isBeside);  // faces stay, and they alone decide
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
  const bool enough = !(before < deepest());
  leaveBetween(a, i, b, j, first, out);
  if (enough) return Left::Enough;
  return before < 0.0 ? Left::NotDeepest : Left::NotNearest;
}

}  // namespace tumble
