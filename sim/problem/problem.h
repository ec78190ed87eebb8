// Chapter 6, problem: the one problem behind rest, impact, step and projection.
// Knows rows and cones only: no shapes, contacts or joints.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "sim/math/vec.h"

namespace tumble {

/// One scalar row of the Jacobian J:
///   u = linear·(va − vb) + angularA·ωa + angularB·ωb + bias + compliance λ.
struct Row {
  int a = 0, b = 0;              ///< bodies
  Vec3 linear = Vec3::Zero();    ///< +n for a contact normal
  Vec3 angularA = Vec3::Zero();  ///< (p − xa) × n
  Vec3 angularB = Vec3::Zero();  ///< −(p − xb) × n
  double bias = 0.0;
  double compliance = 0.0;  ///< [1/kg] ≥ 0, of an Equality row: what yields as a spring does
};

/// Which multipliers are allowed, and what their rows must then do.
enum class ConeKind {
  Push,      ///< one row:  λ ≥ 0, u ≥ 0, λ u = 0
  Friction,  ///< three rows n, t1, t2:  Push on n;  |λt| ≤ mu λn;  u_t = 0, or λt = −mu λn
             ///< u_t/|u_t|
  Slide,     ///< two rows n, t with t along the slip velocity:  Push on n;  λt = −mu λn
  Equality,  ///< one row:  u = 0, λ free
};

struct Cone {
  ConeKind kind = ConeKind::Push;
  int row = 0;      ///< its first row
  double mu = 0.0;  ///< [1] coefficient of friction
};

/// What ties the velocities of two bodies to each other whatever they touch, as something that
/// bends between them does: a block of K, which has no negative eigenvalue, for their linear
/// velocities.
struct Coupling {
  int a = 0, b = 0;           ///< bodies that move, or one body twice: a block of the diagonal
  Mat3 block = Mat3::Zero();  ///< [kg] row a, column b; that of (b, a) is its transpose
};

/// Find v and λ with  A (v − vStar) = Jᵀ λ,  u = J v + bias + C λ,  and every cone satisfied, where
/// A = M + K and C is diagonal and has the compliances. At velocity level v is in m/s and λ an
/// impulse in N·s; at acceleration level v is an acceleration, λ a force in N. Twists are (linear,
/// angular), world frame, about each centre of mass.
struct Problem {
  std::vector<double> invM;  ///< [1/kg] per body; 0 = immovable
  std::vector<Mat3> Iinv;    ///< [1/(kg m²)] per body, world frame
  std::vector<Vec6> vStar;   ///< per body: the motion without the unknown λ
  std::vector<Row> rows;
  std::vector<Cone> cones;
  std::vector<Coupling> couplings =
      {};  ///< of K, each pair of bodies once; most problems have none
};

struct Solution {
  std::vector<double> lambda;  ///< per row
  std::vector<Vec6> v;         ///< per body
  std::vector<double> pull;    ///< per row, or empty: λ by the law of springs before cones cut it
};

/// Solved: the residual is within tolerance, or as small as rounding lets it be (roundingFloor).
/// NotConverged: the iterations are spent; the answer is the best so far, and its residual says how
/// good that is.
enum class SolveStatus { Solved, NotConverged, Infeasible };

struct SolveReport {
  SolveStatus status = SolveStatus::Solved;
  double residual =
      0.0;  ///< largest entry of the natural map, in units of u, over the largest |J vStar + bias|
  int iterations = 0;  ///< sweeps, pivots or factorizations
  double balance = 0.0;  ///< largest entry of A (v − vStar) − Jᵀ λ, over the sum of the sizes of
                         ///< the terms of its body; 0 where v is what λ gives
  double scale = 0.0;  ///< velocityScale of the problem, where the solver asked for it; else 0
};

struct SolveSettings {
  double tolerance = 1e-12;   ///< on SolveReport::residual
  int maxIterations = 20000;  ///< sweeps or pivots
  /// Where Solution::pull is expected, per row, NaN where it is not known; or empty. An answer that
  /// is the only one does not depend on it.
  std::span<const double> pull = {};
  /// Equalities that follow from others but for this share of the largest, or for rounding, count
  /// as following exactly.
  double dependent = 0.0;
};

/// A row of the table of solvers. λ in `solution` (if of the right length) is the starting point.
struct Solver {
  std::string_view name;
  std::string_view summary;
  SolveReport (*solve)(const Problem&, const SolveSettings&, Solution&);
  bool couples = false;  ///< it solves problems with couplings; others need a block-diagonal mass
};

/// All solvers. To add one: write `sim/problem/<name>.cpp` and add its row in solvers.cpp.
std::span<const Solver> solvers();
const Solver* findSolver(std::string_view name);

/// A row of the table of presets: a solver, and how far it goes.
struct SolverPreset {
  std::string_view name;
  std::string_view summary;
  std::string_view solver;
  SolveSettings settings;
  std::string_view crowdSolver;  ///< for islands of many contacts that move
  SolveSettings crowd;
  bool anyCrowd = true;  ///< such islands are of crowds without restitution, too
  double open = 0.0;     ///< part of what `crowd` may leave in a step that is not lifted at once
  bool divides = true;   ///< hits divide steps; else each is struck when its step begins
  double bent = 0.0;     ///< part of the speeds of what bends that sweeps may leave; 0: as all else
};

std::span<const SolverPreset> solverPresets();
const SolverPreset* findSolverPreset(std::string_view name);

/// J v of one row, without bias, at the twists of its two bodies.
inline double rowSpeed(const Row& row, const Vec6& va, const Vec6& vb) {
  return row.linear.dot(va.head<3>() - vb.head<3>()) + row.angularA.dot(va.tail<3>()) +
         row.angularB.dot(vb.tail<3>());
}

/// J v + bias for every row, at the given v: u but for what compliance adds.
void rowVelocities(const Problem& problem, std::span<const Vec6> v, std::span<double> u);

/// v = vStar + M⁻¹ Jᵀ λ, of a problem without couplings.
void velocitiesFromLambda(const Problem& problem, std::span<const double> lambda,
                          std::span<Vec6> v);

/// The largest |J vStar + bias| of all rows: what residuals are measured by. Where its terms cancel
/// to rounding, as of bodies that fall as one, 2e-8 of the largest sum of their sizes; 1 if all are
/// 0.
double velocityScale(const Problem& problem);

/// Natural-map residual of (λ, v) as in SolveReport: per cone |λ − Π_K(λ − ρ û)|/ρ with
/// ρ = 1/(largest diagonal entry of J M⁻¹ Jᵀ in the cone), û = u + mu |u_t| n for friction.
double naturalResidual(const Problem& problem, const Solution& solution);
/// The same where velocityScale is known. Above `most` it is not asked how much more it is.
double naturalResidual(const Problem& problem, const Solution& solution, double scale,
                       double most = std::numeric_limits<double>::infinity());

/// What rounding alone may leave of naturalResidual: machine epsilon times the sum of the sizes of
/// all terms of a row of J (vStar + M⁻¹ Jᵀ λ) + bias, the largest of them, over velocityScale.
double roundingFloor(const Problem& problem, const Solution& solution);

/// Whether a residual of this solution is as small as rounding lets it be.
inline bool atRounding(const Problem& problem, const Solution& solution, double residual) {
  constexpr double kMost = 1e-6;
  return residual <= kMost && residual <= 2.0 * roundingFloor(problem, solution);
}

/// Root of a body in a forest that joins bodies to islands; halves the path on its way.
int islandRoot(std::vector<int>& parent, int body);

/// Connected components of bodies through rows; immovable bodies do not connect.
/// Each island is a list of cone indices in ascending order; islands in order of their first cone.
std::vector<std::vector<int>> islands(const Problem& problem);

/// Solves island by island with the given solver; the report is the worst of them.
SolveReport solveByIslands(const Solver& solver, const Problem& problem,
                           const SolveSettings& settings, Solution& solution);

}  // namespace tumble
