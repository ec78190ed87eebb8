// Chapter 6, problem: visits of a sweep to the cones between two bodies. Used by sweep.cpp alone.
//
// Bodies go by y, with  v = vStar + B y  and  M⁻¹ = B Bᵀ.  Then one matrix K = J B says both how
// fast the rows are, u = K y + c, and what their multipliers do, y = Kᵀ λ.  Rows know the centres
// of a pair by their relative motion alone, so that nine numbers are all they see of its two y.
#pragma once

#include <span>

#include "sim/problem/lanes.h"
#include "sim/problem/problem.h"

namespace tumble {

/// A cone of any kind with all that one visit reads and no more.
struct SweptCone {
  ConeKind kind;
  int row;
  double mu;
  double mobility;                 ///< largest diagonal entry of W [1/kg]
  double compliance;               ///< [1/kg] of its first row
  Vec3 c;                          ///< J vStar + bias
  Eigen::Matrix<double, 10, 3> K;  ///< columns: what a unit of each λ does to y of the pair: of its
                                   ///< centres, of a's turning, of b's, 0; 0 beyond its rows
  Mat3 W;     ///< K Kᵀ: block of J M⁻¹ Jᵀ + C [1/kg]
  Mat3 hold;  ///< W⁻¹, symmetric; 0 where W is singular
};

/// Two pairs of bodies, in a lane each; no body that moves is of both. A pair that is alone has
/// lane 0.
struct TwinBodies {
  Vec6 *a[2], *b[2];
  Lanes shareA, shareB;  ///< roots of the two parts of the pair's 1/m
};

/// y += Kᵀ λ at the two bodies, cone after cone.
void takeCones(std::span<const SweptCone> cones, const double* lambda, const TwinBodies& bodies);

/// Solves cone after cone for its own λ, all others kept, forwards or backwards. Returns the
/// largest change of λ in units of u.
double sweepCones(std::span<const SweptCone> cones, bool forwards, double* lambda,
                  const TwinBodies& bodies);

/// A contact with friction of each of two pairs of bodies, by the same arithmetic as a SweptCone.
struct TwinCone {
  struct Motion {
    Lanes3 linear, angularA, angularB;
  };

  void set(int lane, const SweptCone& cone);

  int row[2];
  Lanes mu, mobility;
  Lanes3 c;
  Motion K[3];  ///< columns
  LanesSymmetric W, hold;
};

/// As takeCones and sweepCones, in both lanes.
void takeTwins(std::span<const TwinCone> cones, const double* lambda, const TwinBodies& bodies);
double sweepTwins(std::span<const TwinCone> cones, bool forwards, double* lambda,
                  const TwinBodies& bodies);

}  // namespace tumble
