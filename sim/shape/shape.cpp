// Chapter 2, shape: names, boxes and balls around shapes.
#include "sim/shape/shape.h"

#include <cmath>
#include <limits>

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

Vec3 halfWidths(const HalfSpace&, const Mat3&) {
  return Vec3::Constant(kInfinity);
}

Vec3 halfWidths(const Particle& p, const Mat3&) {
  return Vec3::Constant(p.radius);
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
double radius(const HalfSpace&) {
  return kInfinity;
}
double radius(const Particle& p) {
  return p.radius;
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
std::string_view name(const HalfSpace&) {
  return "half-space";
}
std::string_view name(const Particle&) {
  return "particle";
}

}  // namespace

std::string_view shapeName(const Shape& shape) {
  return std::visit([](const auto& s) { return name(s); }, shape);
}

Aabb boundingBox(const Shape& shape, const Pose& pose, double margin) {
  const Mat3 R = pose.q.toRotationMatrix();
  const Vec3 width = std::visit([&](const auto& s) { return halfWidths(s, R); }, shape);
  const Vec3 reach = width + Vec3::Constant(margin);
  return {pose.x - reach, pose.x + reach};
}

Shape contactShape(const Shape& shape) {
  const Particle* particle = std::get_if<Particle>(&shape);
  return particle && particle->radius > 0.0 ? Shape(Sphere{particle->radius}) : shape;
}

bool touchesAnything(const Shape& shape) {
  const Particle* particle = std::get_if<Particle>(&shape);
  return !particle || particle->radius > 0.0;
}

double boundingRadius(const Shape& shape) {
  return std::visit([](const auto& s) { return radius(s); }, shape);
}

}  // namespace tumble
