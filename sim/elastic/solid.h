// Chapter 2, elastic: what isotropic solids share. An energy density of the stretches σ of
// F = U diag(σ) Vᵀ alone has forces and Hessian in closed form on U and V.
#pragma once

#include "sim/elastic/element.h"

namespace tumble {

/// F = U diag(σ) Vᵀ with U and V rotations, so that the last σ is negative inside out.
struct Stretches {
  Mat3 U, V;
  Vec3 sigma;
};
Stretches stretchesOf(const Mat3& F);
/// σ by itself, for half the work.
Vec3 stretchesAloneOf(const Mat3& F);
/// U and V where more than an energy is asked for.
Stretches stretchesFor(ElementAsk ask, const Mat3& F);

/// Ψ(σ) [Pa] and what it takes to differentiate it by F. With the pairs (i, j) = (1,2), (2,0),
/// (0,1) of `twist[k]`, k the third:
///   twist = (ψ_i + ψ_j)/(σ_i + σ_j),   flip = (ψ_i − ψ_j)/(σ_i − σ_j),   where ψ_i = ∂Ψ/∂σ_i.
struct StretchLaw {
  double energy = 0.0;
  Vec3 slope = Vec3::Zero();      ///< ψ
  Mat3 curvature = Mat3::Zero();  ///< ∂²Ψ/∂σ∂σ
  Vec3 twist = Vec3::Zero(), flip = Vec3::Zero();
};

/// F of a cell with its corners at x.
Mat3 deformation(const Cell& cell, const ElementPlaces& x);

/// F of a cell of a box, in the mean.
Mat3 deformation(const ShapeMatch& match, const ElementPlaces& x);

/// How a mode of F, in the frames of U and V, moves along with each corner.
/// @param turned  per corner Vᵀ ∂F/∂x_i
template <std::size_t N>
Eigen::Matrix<double, 3 * static_cast<int>(N), 1> cornersOf(const Mat3& mode, const Mat3& U,
                                                            const std::array<Vec3, N>& turned) {
  Eigen::Matrix<double, 3 * static_cast<int>(N), 1> q;
  for (std::size_t i = 0; i < N; ++i) q.template segment<3>(3 * i) = U * (mode * turned[i]);
  return q;
}

/// Σ w_m q_m q_mᵀ, in the first rows and columns of A.
template <int N, int M>
void setSquares(const Eigen::Matrix<double, N, M>& q, const Eigen::Matrix<double, M, 1>& weight,
                ElementMatrix& A) {
  const Eigen::Matrix<double, N, M> weighed = q * weight.asDiagonal();
  A.topLeftCorner<N, N>() = weighed.lazyProduct(q.transpose());
}

/// D of a stress 2 η Ė with Ė = ½ d(FᵀF)/dt, which no rigid motion changes.
/// @param gradient  [1/m] per corner
template <std::size_t N>
void setViscosity(const std::array<Vec3, N>& gradient, double volume, double viscosity,
                  const Mat3& F, ElementMatrix& D) {
  Eigen::Matrix<double, 3 * static_cast<int>(N), 6> rates;  // of Ė_ab by the corners' velocities
  Eigen::Matrix<double, 6, 1> weights;
  int m = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b, ++m) {
      for (std::size_t i = 0; i < N; ++i)
        rates.col(m).template segment<3>(3 * i) =
            0.5 * (F.col(a) * gradient[i][b] + F.col(b) * gradient[i][a]);
      weights[m] = 2.0 * viscosity * volume * (a == b ? 1.0 : 2.0);
    }
  setSquares(rates, weights, D);
}

/// The terms of a cell whose energy density is that law at these stretches.
/// The Hessian has nine modes in closed form: three of stretches, three twists, three flips
/// (Smith, de Goes & Kim, Analytic Eigensystems for Isotropic Distortion Energies, 2019).
void differentiateSolid(const Cell& cell, double viscosity, const Mat3& F,
                        const Stretches& stretches, const StretchLaw& law, ElementAsk ask,
                        ElementTerms& terms);

}  // namespace tumble
