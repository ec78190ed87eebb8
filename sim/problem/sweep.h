// Chapter 6, problem: a contact problem laid out for sweeps over its cones. Used by pgs.cpp alone.
#pragma once

#include <span>
#include <vector>

#include "sim/problem/problem.h"

namespace tumble {

/// A cone with all that one visit reads and no more.
struct SweptCone {
  using Mat63 = Eigen::Matrix<double, 6, 3>;

  Mat63 Ka, Kb;  ///< columns: what a unit of each λ does to y of the two bodies; 0 beyond its rows
  Mat3 W;        ///< block of K Kᵀ = J M⁻¹ Jᵀ [1/kg]
  Mat3 hold;     ///< W⁻¹; 0 where W is singular
  Vec3 c;        ///< J vStar + bias
  double mu;
  double mobility;  ///< largest diagonal entry of W [1/kg]
  int row, a, b;
  ConeKind kind;
};

/// Bodies go by y, with  v = vStar + B y  and  M⁻¹ = B Bᵀ.  Then one matrix K = J B says both how
/// fast the rows are, u = K y + c, and what their multipliers do, y = Kᵀ λ.
class ConeSweeps {
 public:
  void prepare(const Problem& problem);

  /// y = Kᵀ λ.
  void take(const VecX& lambda);
  /// Solves cone after cone for its own λ, all others kept, forwards or backwards. Returns the
  /// largest change of λ in units of u.
  double pass(bool forwards, VecX& lambda);

  /// Per row: diagonal entry of W, or 1 if that is 0.
  const VecX& mobility() const { return mobility_; }

 private:
  void layOut(const Problem& problem, const Cone& from, SweptCone& cone);
  double visit(const SweptCone& cone, double* lambda);

  std::vector<SweptCone> cones_;
  std::vector<Mat3> roots_;  ///< per body: lower triangle with B = (√invM, root)
  std::vector<Vec6> y_;
  VecX mobility_;
};

}  // namespace tumble
