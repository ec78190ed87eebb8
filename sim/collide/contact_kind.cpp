#include "sim/collide/contact_kind.h"

#include <algorithm>
#include <vector>

#include "sim/collide/core.h"
#include "sim/math/frames.h"

namespace tumble {
namespace {

using convex::Core;

double distanceFromSegment(const Vec3& p, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double t = std::clamp((p - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (p - (from + t * way)).norm();
}

// Points of one straight line.
bool collinear(const std::vector<Vec3>& points, double tolerance) {
  Vec3 far = points[0];
  for (const Vec3& p : points)
    if ((p - points[0]).norm() > (far - points[0]).norm()) far = p;
  if ((far - points[0]).norm() <= tolerance) return true;
  return std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
    return distanceFromSegment(p, points[0], far) <= tolerance ||
           (p - points[0]).cross(far - points[0]).norm() <= tolerance * (far - points[0]).norm();
  });
}

// 0 a vertex, 1 an edge, 2 a face: the least that holds all points, body frame.
int dimension(const Shape& shape, const std::vector<Vec3>& points, double tolerance) {
  if (!convex::hasCore(shape)) return 2;
  const Core core = convex::coreOf(shape, Mat3::Identity(), Vec3::Zero());
  const auto all = [&](auto near) { return std::all_of(points.begin(), points.end(), near); };
  if (core.isEllipsoid()) return 0;
  if (core.isCylinder()) return collinear(points, tolerance) ? 1 : 2;
  for (const Vec3& vertex : core.points)
    if (all([&](const Vec3& p) { return (p - vertex).norm() <= tolerance; })) return 0;
  for (const Polyhedron::Edge& e : core.edges)
    if (all([&](const Vec3& p) {
          return distanceFromSegment(p, core.points[e.from], core.points[e.to]) <= tolerance;
        }))
      return 1;
  return 2;
}

}  // namespace

std::string_view contactKindName(ContactKind kind) {
  switch (kind) {
    case ContactKind::VertexVertex:
      return "vertex-vertex";
    case ContactKind::VertexEdge:
      return "vertex-edge";
    case ContactKind::VertexFace:
      return "vertex-face";
    case ContactKind::EdgeEdge:
      return "edge-edge";
    case ContactKind::EdgeFace:
      return "edge-face";
    default:
      return "face-face";
  }
}

ContactKind contactKind(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB,
                        std::span<const ContactPoint> manifold, double tolerance) {
  std::vector<Vec3> onA, onB;
  for (const ContactPoint& c : manifold) {
    onA.push_back(toBody(poseA, c.pa));
    onB.push_back(toBody(poseB, c.pb));
  }
  const int ofA = dimension(a, onA, tolerance), ofB = dimension(b, onB, tolerance);
  const int less = std::min(ofA, ofB), more = std::max(ofA, ofB);
  constexpr ContactKind kinds[3][3] = {
      {ContactKind::VertexVertex, ContactKind::VertexEdge, ContactKind::VertexFace},
      {ContactKind::VertexEdge, ContactKind::EdgeEdge, ContactKind::EdgeFace},
      {ContactKind::VertexFace, ContactKind::EdgeFace, ContactKind::FaceFace}};
  return kinds[less][more];
}

}  // namespace tumble
