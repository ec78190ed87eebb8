// Chapter 6, problem: the equalities of a problem as one block.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/math/least_squares.h"
#include "sim/problem/problem.h"

namespace tumble {

/// Finds the λ of all equalities at once, all others kept: by Cholesky, or the smallest by least
/// squares where rows depend on each other. Keeps its storage, which only grows.
class Equalities {
 public:
  /// Of a problem without couplings.
  /// @param dependent  SolveSettings::dependent
  /// @return whether λ can be found; not where too many depend on each other
  bool factor(const Problem& problem, double dependent);
  /// The same, only if no row depends on others.
  bool factorRegular(const Problem& problem, double dependent);

  /// Changes the λ of the equalities such that their u = 0, to what rounding leaves: again it is
  /// less. @param lambda  per row of the problem that was factored
  void solve(const Problem& problem, std::span<double> lambda);

 private:
  static constexpr std::size_t kMostDependent = 60;  ///< rows that depend on each other

  std::vector<int> places_;  ///< of their rows
  std::vector<double> A_, L_, u_, arms_;
  std::vector<Vec6> v_;
  LeastSquares* dependent_ = nullptr;                              ///< null if no row depends
  std::array<LeastSquares, kMostDependent + 1> leastOfSize_ = {};  ///< per number of rows
};

}  // namespace tumble
