#include "sim/problem/solvers.h"

#include <array>

namespace tumble {

std::span<const Solver> solvers() {
  static constexpr std::array kTable = {
      Solver{"newton", "augmented Lagrangian by semismooth Newton steps: exact at any size",
             solveNewton},
      Solver{"pivoting", "dense Dantzig pivoting: exact, for small problems", solvePivoting},
      Solver{"pgs", "projected Gauss-Seidel with the true friction cone", solvePgs},
  };
  return kTable;
}

const Solver* findSolver(std::string_view name) {
  for (const Solver& solver : solvers())
    if (solver.name == name) return &solver;
  return nullptr;
}

}  // namespace tumble
