// Chapter 3, body: the forces that act from outside (slides SD13, SD21; wind, drag, springs).
#pragma once

#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "sim/body/rigid_body.h"
#include "sim/elastic/elastic_body.h"
#include "sim/elastic/layers.h"

namespace tumble {

/// Index that stands for "every body that is not fixed" (wind, drag) or "the world" (end of a
/// spring).
inline constexpr int kNoBody = -1;

/// The same force [N] on the centre of mass of one body, or of each.
struct UniformWind {
  int body = kNoBody;
  Vec3 force = Vec3::Zero();
};

/// f = −linear v,  τ = −angular ω, on one body or on each. [N s/m], [N m s]
struct LinearDrag {
  int body = kNoBody;
  double linear = 0.0, angular = 0.0;
};

/// A force [N], constant in the world frame, that grips one point of a body [m, body frame].
struct PointForce {
  int body = 0;
  Vec3 point_B = Vec3::Zero();
  Vec3 force = Vec3::Zero();
};

/// f = −(stiffness (l − rest) + damping l̇) along the line between two anchors, on each end.
/// The anchor of kNoBody is a world point. While l = 0 it has no direction and pulls at nothing.
struct Spring {
  int a = 0, b = kNoBody;
  Vec3 anchorA_B = Vec3::Zero(), anchorB_B = Vec3::Zero();  ///< [m]
  double stiffness = 0.0;                                   ///< [N/m]
  double damping = 0.0;                                     ///< [N s/m]
  double rest = 0.0;                                        ///< [m]
};

/// The field whose particles run in circles about an axis (slides SD5, SF4), as a force on the
/// centre of mass of one body, or of each:
///   f = m Ω × (Ω × (x − c)) = −m |Ω|² r⊥,   potential ½ m |Ω × (x − c)|².
/// Every orbit across the axis has the period 2π/|Ω|; where v = Ω × r it is a circle.
struct CircularField {
  int body = kNoBody;
  Vec3 centre = Vec3::Zero();     ///< [m] c, a point of the axis
  Vec3 rotation = Vec3::UnitZ();  ///< [rad/s] Ω, along the axis
};

/// Acceleration [m/s²] that the field gives at x [m]; linear in x − c.
Vec3 acceleration(const CircularField& field, const Vec3& x);

/// What bends between bodies that are points of mass:  f = −∂E/∂x − D v  of all its energies.
struct Bending {
  std::shared_ptr<const ElasticBody> body;
};

/// What keeps cloths from passing through themselves and each other:  f = −∂E/∂x  of all that press
/// on each other. A world adds it where it has such cloths.
struct Layering {
  std::shared_ptr<const Layers> layers;
};

using Force =
    std::variant<UniformWind, LinearDrag, PointForce, Spring, CircularField, Bending, Layering>;

/// True if the force changes with velocities: drag, and springs and what bends with damping.
bool dependsOnVelocity(const Force& force);

/// Sets force and torque of every body to gravity [m/s²] plus the listed forces. Fixed bodies get
/// none.
void sumForces(const Vec3& gravity, std::span<const Force> forces, std::span<RigidBody> bodies);

/// Σ (½ M v² + ½ ω·I ω) [J].
double kineticEnergy(std::span<const RigidBody> bodies);

/// Σ −m g·x + Σ ½ k (l − rest)² + Σ ½ m |Ω × (x − c)|² + Σ E of what bends or lies on itself [J].
double potentialEnergy(const Vec3& gravity, std::span<const Force> forces,
                       std::span<const RigidBody> bodies);

/// Power [W] of all forces that have no potential here: wind, drag, point forces, dampers of
/// springs and of what bends, and of the fixed bodies that lead an end of these along. With it
///   d/dt (kinetic + potential) = power  for bodies that touch nothing.
double powerOfForces(std::span<const Force> forces, std::span<const RigidBody> bodies);

}  // namespace tumble
