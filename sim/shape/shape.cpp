// Chapter 2, shape: names, boxes and balls around shapes.
#include "sim/shape/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/shape/pieces.h"

namespace tumble {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Half the width [m] of a shape along each world axis, for a body with rotation matrix R.
Vec3 halfWidths(const Sphere& s, const Mat3&) {
  return Vec3::Constant(s.r);
}

Vec3 halfWidths(const Box& box, const Mat3& R) {
  return R.cwiseAbs() * box.half;
}

// A disc of radius r whose axis is u reaches r √(1 − uᵢ²) along world axis i.
Vec3 halfWidths(const Cylinder& c, const Mat3& R) {
  const Vec3 u = R.col(1);
  const Vec3 disc = c.r * (1.0 - u.array().square()).max(0.0).sqrt();
  return disc + 0.5 * c.h * u.cwiseAbs();
}

Vec3 halfWidths(const Capsule& c, const Mat3& R) {
  return Vec3::Constant(c.r) + 0.5 * c.h * R.col(1).cwiseAbs();
}

// The image of the unit ball under R diag(half).
Vec3 halfWidths(const Ellipsoid& e, const Mat3& R) {
  return (R * e.half.asDiagonal()).rowwise().norm();
}

Vec3 halfWidths(const HalfSpace&, const Mat3&) {
  return Vec3::Constant(kInfinity);
}

Vec3 halfWidths(const Particle& p, const Mat3&) {
  return Vec3::Constant(p.radius);
}

// Of points and parts that need not stand about the origin there is a box, not half a width.
template <class S>
Aabb boxOf(const S& shape, const Mat3& R) {
  const Vec3 width = halfWidths(shape, R);
  return {-width, width};
}

Aabb boxOf(const std::vector<Vec3>& points, const Vec3& origin, const Mat3& R) {
  Aabb box{Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)};
  for (const Vec3& point : points) {
    const Vec3 p = R * (point - origin);
    box = {box.lo.cwiseMin(p), box.hi.cwiseMax(p)};
  }
  return box;
}

Aabb boxOf(const Hull& hull, const Mat3& R) {
  return boxOf(hull.solid->points, hull.origin, R);
}

Aabb boxOf(const Mesh& mesh, const Mat3& R) {
  return boxOf(mesh.solid->points, mesh.origin, R);
}

Aabb boxOf(const Compound& compound, const Mat3& R) {
  Aabb box{Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)};
  for (const Part& part : compound.parts) {
    const Vec3 x = R * (part.pose.x - compound.origin);
    const Mat3 turn = R * part.pose.q.toRotationMatrix();
    const Aabb piece = std::visit([&](const auto& s) { return boxOf(s, turn); }, part.solid);
    box = {box.lo.cwiseMin(x + piece.lo), box.hi.cwiseMax(x + piece.hi)};
  }
  return box;
}

double radius(const Sphere& s) {
  return s.r;
}
double radius(const Box& box) {
  return box.half.norm();
}
double radius(const Cylinder& c) {
  return std::sqrt(c.r * c.r + 0.25 * c.h * c.h);
}
double radius(const Capsule& c) {
  return c.r + 0.5 * c.h;
}
double radius(const Ellipsoid& e) {
  return e.half.maxCoeff();
}
double radius(const HalfSpace&) {
  return kInfinity;
}
double radius(const Particle& p) {
  return p.radius;
}

double radius(const std::vector<Vec3>& points, const Vec3& origin) {
  double square = 0.0;
  for (const Vec3& point : points) square = std::max(square, (point - origin).squaredNorm());
  return std::sqrt(square);
}
double radius(const Hull& hull) {
  return radius(hull.solid->points, hull.origin);
}
double radius(const Mesh& mesh) {
  return radius(mesh.solid->points, mesh.origin);
}
double radius(const Compound& compound) {
  double far = 0.0;
  for (const Part& part : compound.parts) {
    // Corners one by one: a hull may stand far from its own origin.
    if (const Hull* hull = std::get_if<Hull>(&part.solid)) {
      for (const Vec3& p : hull->solid->points)
        far = std::max(far,
                       (part.pose.x - compound.origin + part.pose.q * (p - hull->origin)).norm());
      continue;
    }
    far = std::max(far, (part.pose.x - compound.origin).norm() +
                            std::visit([](const auto& s) { return radius(s); }, part.solid));
  }
  return far;
}

std::string_view name(const Sphere&) {
  return "sphere";
}
std::string_view name(const Box&) {
  return "box";
}
std::string_view name(const Cylinder&) {
  return "cylinder";
}
std::string_view name(const Capsule&) {
  return "capsule";
}
std::string_view name(const Hull&) {
  return "hull";
}
std::string_view name(const HalfSpace&) {
  return "half-space";
}
std::string_view name(const Particle&) {
  return "particle";
}

std::string_view name(const Mesh&) {
  return "mesh";
}
std::string_view name(const Compound&) {
  return "compound";
}
std::string_view name(const Ellipsoid&) {
  return "ellipsoid";
}

}  // namespace

std::string_view shapeName(const Shape& shape) {
  return std::visit([](const auto& s) { return name(s); }, shape);
}

[[gnu::flatten]] Aabb boundingBox(const Shape& shape, const Pose& pose, double margin) {
  // Each for itself: some need no R.
  const Aabb box =
      std::visit([&](const auto& s) { return boxOf(s, pose.q.toRotationMatrix()); }, shape);
  const Vec3 more = Vec3::Constant(margin);
  return {pose.x + (box.lo - more), pose.x + (box.hi + more)};
}

Shape contactShape(const Shape& shape) {
  if (const Particle* particle = std::get_if<Particle>(&shape); particle && particle->radius > 0.0)
    return Sphere{particle->radius};
  const Mesh* mesh = std::get_if<Mesh>(&shape);
  if (!mesh || !mesh->pieces) return shape;
  Compound compound;
  compound.origin = mesh->origin;
  compound.slack = mesh->pieces->slack;
  for (const Hull& hull : mesh->pieces->hulls) {
    // About its own middle, so that a ball around it is small.
    const Aabb box = boxOf(hull, Mat3::Identity());
    const Vec3 middle = hull.origin + 0.5 * (box.lo + box.hi);
    compound.parts.push_back({Hull{hull.solid, middle}, {middle - hull.origin}});
  }
  return compound;
}

bool touchesAnything(const Shape& shape) {
  const Particle* particle = std::get_if<Particle>(&shape);
  return !particle || particle->radius > 0.0;
}

double boundingRadius(const Shape& shape) {
  return std::visit([](const auto& s) { return radius(s); }, shape);
}

bool hasOwnFrame(const Shape& shape) {
  return std::holds_alternative<Hull>(shape) || std::holds_alternative<Mesh>(shape) ||
         std::holds_alternative<Compound>(shape);
}

Shape withOrigin(Shape shape, const Vec3& origin) {
  if (Hull* hull = std::get_if<Hull>(&shape)) hull->origin = origin;
  if (Mesh* mesh = std::get_if<Mesh>(&shape)) mesh->origin = origin;
  if (Compound* compound = std::get_if<Compound>(&shape)) {
    compound->origin = origin;
    compound->ready = nullptr;
  }
  return shape;
}

Vec3 originOf(const Shape& shape) {
  if (const Hull* hull = std::get_if<Hull>(&shape)) return hull->origin;
  if (const Mesh* mesh = std::get_if<Mesh>(&shape)) return mesh->origin;
  if (const Compound* compound = std::get_if<Compound>(&shape)) return compound->origin;
  return Vec3::Zero();
}

Shape shapeOf(const Part& part) {
  return std::visit([](const auto& solid) { return Shape(solid); }, part.solid);
}

Pose poseInBody(const Compound& compound, const Part& part) {
  return {part.pose.x - compound.origin, part.pose.q};
}

std::vector<PosedPart> convexParts(const Shape& shape) {
  if (const Mesh* mesh = std::get_if<Mesh>(&shape); mesh && mesh->pieces)
    return convexParts(contactShape(shape));
  std::vector<PosedPart> parts;
  if (const Compound* compound = std::get_if<Compound>(&shape)) {
    for (const Part& part : compound->parts)
      parts.push_back({shapeOf(part), poseInBody(*compound, part)});
  } else if (touchesAnything(shape) && !std::holds_alternative<Mesh>(shape)) {
    parts.push_back({contactShape(shape), Pose{}});
  }
  return parts;
}

}  // namespace tumble
