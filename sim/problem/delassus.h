// Chapter 6, problem: a problem with its bodies eliminated.
#pragma once

#include "sim/problem/problem.h"

namespace tumble {

/// u = A λ + b  with  A = J M⁻¹ Jᵀ,  b = J vStar + bias: the matrix and vector of Baraff, Rigid
/// Body Simulation II, §9, for all rows. A is symmetric to the last bit.
struct Delassus {
  MatX A;
  VecX b;
};

Delassus delassus(const Problem& problem);

/// The same into A (n × n) and b (n), for n rows.
void delassus(const Problem& problem, Eigen::Ref<MatX> A, Eigen::Ref<VecX> b);

/// A alone (n × n), of n of the rows.
void delassus(const Problem& problem, std::span<const int> rows, Eigen::Ref<MatX> A);

}  // namespace tumble
