#include "sim/body/mass_properties.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "sim/body/mass_surface.h"
#include "sim/math/frames.h"
#include "sim/math/rotation.h"

namespace tumble {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

void requireMass(double mass) {
  if (!(mass > 0.0 && mass < kInfinity)) {
    throw std::invalid_argument("mass: must be positive and finite");
  }
}

double volumeOf(const Sphere& s) {
  return 4.0 / 3.0 * kPi * s.r * s.r * s.r;
}
double volumeOf(const Box& b) {
  return 8.0 * b.half.x() * b.half.y() * b.half.z();
}
double volumeOf(const Cylinder& c) {
  return kPi * c.r * c.r * c.h;
}
double volumeOf(const Capsule& c) {
  return kPi * c.r * c.r * (c.h + 4.0 / 3.0 * c.r);
}
double volumeOf(const Hull& hull) {
  return integrate(*hull.solid).volume;
}
double volumeOf(const Ellipsoid& e) {
  return 4.0 / 3.0 * kPi * e.half.prod();
}
double volumeOf(const HalfSpace&) {
  return kInfinity;
}
double volumeOf(const Mesh& mesh) {
  return integrate(*mesh.solid).volume;
}
double volumeOf(const Compound& compound) {
  double sum = 0.0;
  for (const Part& part : compound.parts)
    sum += std::visit([](const auto& s) { return volumeOf(s); }, part.solid);
  return sum;
}

double volumeOf(const Particle&) {
  return 0.0;
}

/// Principal moments [m²] about the body axes, per mass.
Vec3 momentsOf(const Sphere& s) {
  return Vec3::Constant(0.4 * s.r * s.r);
}

Vec3 momentsOf(const Box& box) {
  const Vec3 squares = (2.0 * box.half).cwiseAbs2();
  return Vec3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y()) /
         12.0;
}

Vec3 momentsOf(const Cylinder& c) {
  const double along = 0.5 * c.r * c.r;
  const double across = (3.0 * c.r * c.r + c.h * c.h) / 12.0;
  return {across, along, across};
}

/// The caps are two half-balls whose centres of mass stand h/2 + 3/8 r from the middle.
Vec3 momentsOf(const Capsule& c) {
  const double caps = 4.0 / 3.0 * c.r / (c.h + 4.0 / 3.0 * c.r), middle = 1.0 - caps;
  const double square = c.r * c.r;
  const double along = (0.5 * middle + 0.4 * caps) * square;
  const double across = middle * (3.0 * square + c.h * c.h) / 12.0 +
                        caps * (0.4 * square + c.h * (0.25 * c.h + 0.375 * c.r));
  return {across, along, across};
}

/// ∫ x² dV / V = a²/5: a ball, stretched.
Vec3 momentsOf(const Ellipsoid& e) {
  const Vec3 squares = e.half.cwiseAbs2();
  return 0.2 *
         Vec3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
}

Vec3 momentsOf(const HalfSpace&) {
  throw std::invalid_argument("shape: a half-space has no finite mass");
}

Vec3 momentsOf(const Particle&) {
  return Vec3::Zero();
}

/// Shapes whose body axes are principal and meet at their centre of mass.
template <class S>
MassProperties weigh(const S& shape, double mass) {
  return {mass, (mass * momentsOf(shape)).asDiagonal()};
}

MassProperties weighSurface(const Polyhedron& solid, double mass) {
  const VolumeIntegrals integrals = integrate(solid);
  return {mass, (mass / integrals.volume) * integrals.inertia, integrals.centre};
}

MassProperties weigh(const Hull& hull, double mass) {
  return weighSurface(*hull.solid, mass);
}

MassProperties weigh(const Mesh& mesh, double mass) {
  return weighSurface(*mesh.solid, mass);
}

/// Inertia of a mass at a point that is d away [m].
Mat3 steiner(double mass, const Vec3& d) {
  return mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
}

MassProperties weigh(const Compound& compound, double mass) {
  const double density = mass / volumeOf(compound);
  std::vector<MassProperties> parts;
  MassProperties sum{mass, Mat3::Zero()};
  for (const Part& part : compound.parts) {
    const Shape solid = shapeOf(part);
    parts.push_back(solidMass(solid, density * volume(solid)));
    parts.back().centre = toWorld(part.pose, parts.back().centre - originOf(solid));
    sum.centre += parts.back().mass / mass * parts.back().centre;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Mat3 R = rotationMatrix(compound.parts[i].pose.q);
    sum.inertia +=
        R * parts[i].inertia * R.transpose() + steiner(parts[i].mass, parts[i].centre - sum.centre);
  }
  // Rounding of the products must not make the tensor lopsided.
  sum.inertia = 0.5 * (sum.inertia + sum.inertia.transpose()).eval();
  return sum;
}

/// Symmetric and positive definite.
bool isInertia(const Mat3& I) {
  return I.allFinite() && I.isApprox(I.transpose()) && Eigen::LLT<Mat3>(I).info() == Eigen::Success;
}

}  // namespace

Mat3 inverseInertia(const Mat3& I) {
  if (I.isDiagonal(0.0)) return Vec3(I.diagonal().cwiseInverse()).asDiagonal();
  return I.inverse();
}

double volume(const Shape& shape) {
  return std::visit([](const auto& s) { return volumeOf(s); }, shape);
}

MassProperties solidMass(const Shape& shape, double mass) {
  requireMass(mass);
  return std::visit([&](const auto& s) { return weigh(s, mass); }, shape);
}

RigidBody makeBody(const MassProperties& mass) {
  requireMass(mass.mass);
  if (!isInertia(mass.inertia)) {
    throw std::invalid_argument("inertia: must be symmetric and positive definite");
  }
  RigidBody body;
  body.M = mass.mass;
  body.invM = 1.0 / mass.mass;
  body.Ibody = mass.inertia;
  body.IbodyInv = inverseInertia(mass.inertia);
  updateDerived(body);
  return body;
}

RigidBody makeParticle(double mass) {
  requireMass(mass);
  RigidBody body;
  body.particle = true;
  body.M = mass;
  body.invM = 1.0 / mass;
  body.Ibody.setZero();
  body.IbodyInv.setZero();
  body.Iinv.setZero();
  return body;
}

RigidBody makeFixedBody(const Pose& pose, const Vec3& v, const Vec3& omega) {
  RigidBody body;
  body.M = kInfinity;
  body.invM = 0.0;
  body.Ibody = kInfinity * Mat3::Identity();
  body.IbodyInv.setZero();
  body.x = pose.x;
  body.q = pose.q;
  setVelocity(body, v, omega);
  return body;
}

}  // namespace tumble
