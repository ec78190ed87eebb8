// Chapter 3, body: one rigid body under the notes' four headings, and its way into an array and
// back.
#pragma once

#include <span>

#include "sim/math/vec.h"

namespace tumble {

/// A rigid body (slides SD11–SD22; Baraff, Rigid Body Simulation I, §2). World frame, SI, unless
/// a name ends in _B. Only integrators and impulses write state; only `updateDerived` writes
/// derived.
struct RigidBody {
  // Constant quantities.
  double invM = 1.0;              ///< [1/kg] 1/mass; 0 for a fixed body
  double M = 1.0;                 ///< [kg] infinity for a fixed body
  Mat3 Ibody = Mat3::Identity();  ///< [kg m²] inertia tensor about the centre of mass, body frame
  Mat3 IbodyInv = Mat3::Identity();  ///< [1/(kg m²)] its inverse; 0 for a fixed body and a particle
  bool particle = false;             ///< has x and P alone: never turns, q stays, L is 0

  // State variables.
  Vec3 x = Vec3::Zero();      ///< [m] centre of mass
  Quat q = Quat::Identity();  ///< [1] unit, body to world
  Vec3 P = Vec3::Zero();      ///< [kg m/s] linear momentum
  Vec3 L = Vec3::Zero();      ///< [kg m²/s] angular momentum about the centre of mass

  // Derived quantities. A fixed body keeps the v and omega it was given.
  Mat3 R = Mat3::Identity();     ///< rotation matrix of q
  Mat3 Iinv = Mat3::Identity();  ///< [1/(kg m²)] R IbodyInv Rᵀ
  Vec3 v = Vec3::Zero();         ///< [m/s] P/M
  Vec3 omega = Vec3::Zero();     ///< [rad/s] Iinv L

  // Computed quantities.
  Vec3 force = Vec3::Zero();   ///< [N] sum of the forces
  Vec3 torque = Vec3::Zero();  ///< [N m] sum of the torques about x

  bool fixed() const { return invM == 0.0; }
  Pose pose() const { return {x, q}; }
};

/// How Y carries the attitude of a body: as the unit quaternion q, or, as the course has it first,
/// as the nine numbers of R, which need not stay a rotation.
enum class Attitude { Quaternion, Matrix };

/// Length of a rigid body's share of Y: x (3), q (4, w first), P (3), L (3).
inline constexpr int kStateSize = 13;
/// The same with R (9, row by row) in place of q.
inline constexpr int kMatrixStateSize = 18;
/// The same for a particle: x (3), P (3).
inline constexpr int kParticleStateSize = 6;

/// Length of this body's share of Y.
inline int stateSize(const RigidBody& body, Attitude attitude = Attitude::Quaternion) {
  if (body.particle) return kParticleStateSize;
  return attitude == Attitude::Matrix ? kMatrixStateSize : kStateSize;
}

/// Brings R, Iinv, v and omega up to date with x, q, P and L.
void updateDerived(RigidBody& body);

/// The same for a matrix R that stands for itself: Iinv = R IbodyInv Rᵀ whatever R is, and q
/// becomes the rotation nearest to R.
void updateDerived(RigidBody& body, const Mat3& R);

/// Brings v and omega up to date with P and L, where R and Iinv are.
void updateVelocities(RigidBody& body);

/// ω [rad/s] of a body that has the angular momentum L [kg m²/s] at the attitude q:
///   ω = R IbodyInv Rᵀ L.
Vec3 angularVelocityAt(const RigidBody& body, const Quat& q, const Vec3& L);

/// Copies the state into y[0..stateSize).
void stateToArray(const RigidBody& body, std::span<double> y,
                  Attitude attitude = Attitude::Quaternion);

/// Copies y[0..stateSize) into the state and updates what is derived. q is taken as it stands, not
/// normalised.
void arrayToState(std::span<const double> y, RigidBody& body,
                  Attitude attitude = Attitude::Quaternion);

/// dY/dt of one body from its derived and computed quantities:
///   ẋ = v,  q̇ = ½ (0, ω) q  or  Ṙ = ω* R,  Ṗ = F,  L̇ = τ.
void stateDerivative(const RigidBody& body, std::span<double> ydot,
                     Attitude attitude = Attitude::Quaternion);

/// Velocity [m/s] of the material point that is at world point p [m]:  ṗ = v + ω × (p − x).
inline Vec3 pointVelocity(const RigidBody& body, const Vec3& p) {
  return body.v + body.omega.cross(p - body.x);
}

/// Adds the impulse J [N·s] at world point p [m]:  P += J,  L += (p − x) × J. A fixed body ignores
/// it, a particle its moment.
void applyImpulse(RigidBody& body, const Vec3& p, const Vec3& J);

/// Adds the force f [N] at world point p [m] to force and torque. A fixed body ignores it,
/// a particle its torque.
void applyForce(RigidBody& body, const Vec3& p, const Vec3& f);

/// Sets P and L so that v and omega become the given ones, and updates what is derived.
void setVelocity(RigidBody& body, const Vec3& v, const Vec3& omega);

/// ½ M v² + ½ ω·I ω [J]; 0 for a fixed body.
double kineticEnergy(const RigidBody& body);

}  // namespace tumble
