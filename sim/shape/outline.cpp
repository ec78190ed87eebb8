#include "sim/shape/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/math/rotation.h"

namespace tumble {
namespace {

void put(const Sphere& s, Outline& out) {
  out.points = {Vec3::Zero()};
  out.round = s.r;
}

void put(const Box& box, Outline& out) {
  for (int k = 0; k < 8; ++k)
    out.points.emplace_back(k & 1 ? box.half.x() : -box.half.x(),
                            k & 2 ? box.half.y() : -box.half.y(),
                            k & 4 ? box.half.z() : -box.half.z());
}

void put(const Cylinder& c, Outline& out) {
  for (const double y : {-0.5 * c.h, 0.5 * c.h})
    out.rims.push_back({.centre = {0.0, y, 0.0}, .r = c.r});
}

void put(const Capsule& c, Outline& out) {
  out.points = {{0.0, -0.5 * c.h, 0.0}, {0.0, 0.5 * c.h, 0.0}};
  out.round = c.r;
}

void put(const Hull& hull, Outline& out) {
  for (const Vec3& p : hull.solid->points) out.points.push_back(p - hull.origin);
}

void put(const Particle& p, Outline& out) {
  put(Sphere{p.radius}, out);
}

void put(const Ellipsoid& e, Outline& out) {
  out.ovals.push_back({.E = e.half.asDiagonal()});
}

// Half-spaces have no outermost points; compounds and meshes are no convex solids.
void put(const HalfSpace&, Outline&) {}
void put(const Mesh&, Outline&) {}
void put(const Compound&, Outline&) {}

}  // namespace

Vec3 outermost(const Outline& outline, const Vec3& m) {
  double most = -std::numeric_limits<double>::infinity();
  Vec3 best = Vec3::Zero();
  for (const Vec3& p : outline.points) {
    if (m.dot(p) <= most) continue;
    most = m.dot(p);
    best = p;
  }
  for (const Outline::Rim& rim : outline.rims) {
    const double x = m.dot(rim.u), y = m.dot(rim.v), length = std::sqrt(x * x + y * y);
    const double height = m.dot(rim.centre) + rim.r * length;
    if (height <= most) continue;
    most = height;
    best = rim.centre;
    if (length > 0.0) best += rim.r / length * (x * rim.u + y * rim.v);
  }
  for (const Outline::Oval& oval : outline.ovals) {
    const Vec3 x = oval.E.transpose() * m;
    const double length = x.norm(), height = m.dot(oval.centre) + length;
    if (height <= most) continue;
    most = height;
    best = oval.centre;
    if (length > 0.0) best += oval.E * (x / length);
  }
  return best + outline.round * m.normalized();
}

Outline outlineOf(const Shape& shape, const Pose& pose) {
  Outline out;
  std::visit([&](const auto& s) { put(s, out); }, shape);
  const Mat3 R = rotationMatrix(pose.q);
  for (Vec3& p : out.points) {
    p = pose.x + R * p;
    out.corner = std::max(out.corner, p.norm());
  }
  for (Outline::Rim& rim : out.rims) {
    rim.centre = pose.x + R * rim.centre;
    rim.u = R * rim.u;
    rim.v = R * rim.v;
    out.corner = std::max(out.corner, rim.centre.norm() + rim.r);
  }
  for (Outline::Oval& oval : out.ovals) {
    out.corner = std::max(out.corner, pose.x.norm() + oval.E.diagonal().maxCoeff());
    oval = {pose.x, R * oval.E};
  }
  return out;
}

std::vector<Convex> outlinedParts(const Shape& shape) {
  std::vector<Convex> parts;
  for (const PosedPart& part : convexParts(shape))
    parts.push_back({part.solid, part.pose, outlineOf(part.solid, part.pose)});
  return parts;
}

}  // namespace tumble
