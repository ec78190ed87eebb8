// Chapter 6, problem: points of mass that bend together and touch nothing that moves.
#pragma once

#include <limits>
#include <span>

#include "sim/problem/problem.h"

namespace tumble {

/// How far sweeps go.
struct SweepSettings {
  double enough = 0.0;  ///< [m/s] by which the last sweep may change a velocity
  int most = 200;       ///< sweeps
  /// Of the kinetic energies, with no speed below `still` [m/s]: the power times the step that the
  /// momentum left open may have. Stiff ones change little in a sweep and are far off yet.
  double open = std::numeric_limits<double>::infinity();
  double still = 0.0;
  bool settles = true;  ///< all points together end with the momentum that they are given
};

/// Velocities of points of mass whose cones push against what does not move:
///   A v = b + Jᵀ λ,   u = J v + bias,
/// with A = M + K. One point after the other, there and back, moves to where its own row of A holds
/// and all its cones (Gauss–Seidel); in between neighbours move together. Such sweeps are steps of
/// a method of conjugate gradients (Silcowitz, Niebe & Erleben, A nonsmooth nonlinear conjugate
/// gradient method for interactive contact force problems, 2010, §3; departure: it goes in v, not
/// in λ, and with the change that a sweep makes, measured by the blocks of A, for the gradient). It
/// needs no factor. Cones are satisfied however early it ends, and all points together have the
/// momentum that b and λ give them: what is left is in the balance of single points.
/// @param problem   Push and Friction cones, each between a body that moves and one that does not
/// @param side      [N s] b, per body
/// @param solution  v and λ to start from
/// @return residual: the last change over velocityScale; iterations: sweeps; NotConverged where
///         more sweeps than the most were needed
SolveReport sweepNodes(const Problem& problem, std::span<const Vec3> side,
                       const SweepSettings& settings, Solution& solution);

}  // namespace tumble
