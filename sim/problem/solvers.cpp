#include "sim/problem/solvers.h"

#include <array>

namespace tumble {

std::span<const Solver> solvers() {
  static constexpr std::array kTable = {
      Solver{"newton", "augmented Lagrangian by semismooth Newton steps: exact at any size",
             solveNewton, true},
      Solver{"pivoting", "dense Dantzig pivoting: exact, for small problems", solvePivoting},
      Solver{"admm", "one factor of the masses and contacts, then forces and velocities in turn",
             solveAdmm},
      Solver{"pgs", "projected Gauss-Seidel with the true friction cone", solvePgs},
  };
  return kTable;
}

std::span<const SolverPreset> solverPresets() {
  static constexpr std::array kTable = {
      SolverPreset{"auto",
                   "to rounding, but crowds that move to a thousandth",
                   "newton",
                   {1e-12, 4000},
                   "pgs",
                   {1e-3, 100},
                   false,
                   0.1},
      SolverPreset{
          "exact", "contacts hold to rounding", "newton", {1e-12, 4000}, "newton", {1e-12, 4000}},
      SolverPreset{"balanced",
                   "to a thousand-millionth, crowds that move to a ten-thousandth",
                   "newton",
                   {1e-9, 4000},
                   "pgs",
                   {1e-4, 200}},
      SolverPreset{"fast",
                   "to a millionth, crowds that move by twenty sweeps, whatever they leave",
                   "newton",
                   {1e-6, 4000},
                   "pgs",
                   {1e-2, 20},
                   true,
                   0.1,
                   true,
                   1e-3},
      SolverPreset{
          "draft",
          "as fast, but no step is divided, few are gone over, and ten times as much stays open",
          "newton",
          {1e-6, 4000},
          "pgs",
          {1e-2, 28},
          true,
          1.0,
          false,
          1e-2},
  };
  return kTable;
}

const SolverPreset* findSolverPreset(std::string_view name) {
  for (const SolverPreset& preset : solverPresets())
    if (preset.name == name) return &preset;
  return nullptr;
}

const Solver* findSolver(std::string_view name) {
  for (const Solver& solver : solvers())
    if (solver.name == name) return &solver;
  return nullptr;
}

}  // namespace tumble
