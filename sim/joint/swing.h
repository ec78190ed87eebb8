// Chapter 8, joint: how fast what joints hold can swing under the forces that they carry.
#pragma once

#include "sim/contact/bonds.h"
#include "sim/joint/joint.h"
#include "sim/problem/problem.h"

namespace tumble {

/// What was found of the fastest swing when it was last looked for.
struct Swing {
  double bound = 0.0;   ///< [1/s²] its square is no higher, whatever holds the bodies; 0: never
  double square = 0.0;  ///< [1/s²]
};

/// The force across a rod that comes of moving its ends across it.
struct Tension {
  int a = 0, b = 0;  ///< b = the number of bodies: the world
  Vec3 ra, rb;       ///< [m] from the centres of mass to the ends
  Mat3 across;       ///< [N/m]
};

/// What fastestSwing works with and then forgets; kept for the sake of its storage.
struct SwingWork {
  std::vector<Mat3> turn;         ///< [N m] per body
  std::vector<Tension> tensions;  ///< of rods and ropes
  std::vector<Vec6> v;            ///< per body, the last one the world
  Bonds bonds;
  Problem problem;  ///< of what the joints allow
  Solution solution;
};

/// The highest frequency [rad/s] at which jointed bodies swing, or fall over, while the forces of
/// their joints keep their sizes and directions:
///   ω² = max |vᵀ K v| / vᵀ M v  over all v with J v = 0
/// where K is the geometric stiffness, (f·r) 1 − (f rᵀ + r fᵀ)/2 for the turn of a body under a
/// force f at r from its centre, and tension/length across a rod or rope. Andrews, Teichmann and
/// Kry, Geometric stiffness for real-time constrained multibody dynamics (2017), §3. Departures:
/// torques of joints are left out, and the frequency alone is used. By power iteration, whose
/// values come from below.
/// @param forces   of the joints now
/// @param atLeast  [rad/s] a frequency that is surely lower is told as 0
/// @param last     what was found before: where stiffness has hardly changed since, it is scaled
double fastestSwing(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                    std::span<const JointForce> forces, const Solver& solver, double atLeast,
                    Swing& last, SwingWork& work);

}  // namespace tumble
