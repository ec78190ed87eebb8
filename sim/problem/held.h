// Chapter 6, problem: an implicit step of points that bend, in which some must move as they are
// told: the three ways of the course to hold that exactly.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "sim/problem/block_cholesky.h"

namespace tumble {

/// A point held along a direction: n·Δv = value.
struct Hold {
  int point = 0;
  Vec3 n = Vec3::UnitY();  ///< unit; those of one point are at right angles to each other
  double value = 0.0;      ///< [m/s]
};

/// A Δv = b + Σ λ n, where A is symmetric and positive definite.
struct HeldProblem {
  std::vector<Mat3> own;         ///< [kg] blocks of A: of points,
  std::vector<BlockEdge> edges;  ///< and of pairs of points, row first < second
  std::vector<Mat3> off;
  std::vector<Vec3> b;  ///< [N·s]
  std::vector<Hold> holds;
};

struct HeldAnswer {
  std::vector<Vec3> dv = {};      ///< [m/s]
  std::vector<double> pull = {};  ///< [N·s] λ per hold, from the residual; < 0: it wants to let go
  int count = 0;                  ///< iterations, or factors
  double residual = 0.0;  ///< largest part of A Δv − b that no hold takes, of the largest of b
};

/// Conjugate gradients on the directions that are free (Baraff and Witkin, Large Steps in Cloth
/// Simulation, 1998, §5), preconditioned by the blocks of points. Departure: the start obeys the
/// holds and the right side is filtered after it is moved over, as Ascher and Boxerman correct it
/// (On the Modified Conjugate Gradient Method in Cloth Simulation, 2003, §3).
HeldAnswer solveFiltered(const HeldProblem& problem, double tolerance);

/// Lagrange's multipliers: (J A⁻¹ Jᵀ) λ = c − J A⁻¹ b, by one factor of A.
HeldAnswer solveMultipliers(const HeldProblem& problem, double tolerance);

/// Free directions as variables: Nᵀ A N y = Nᵀ (b − A z), Δv = z + N y. Held ones keep a row of
/// their own, so that the blocks stay where they are.
HeldAnswer solveReduced(const HeldProblem& problem, double tolerance);

struct HeldSolver {
  std::string_view name, summary;
  std::function<HeldAnswer(const HeldProblem&, double tolerance)> solve;
};
std::span<const HeldSolver> heldSolvers();

}  // namespace tumble
