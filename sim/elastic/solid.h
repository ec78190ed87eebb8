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
  Vec3 slope = Vec3::Zero();    ///< ψ
  Mat3 way = Mat3::Identity();  ///< columns: eigenvectors of ∂²Ψ/∂σ∂σ
  Vec3 weight = Vec3::Zero();   ///< and its eigenvalues
  Vec3 twist = Vec3::Zero(), flip = Vec3::Zero();
  double base = 0.0;  ///< what many modes weigh: Ψ is base/2 |F|² and something of the others
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

/// Sets the blocks of a symmetric matrix of N points to what `blockOf` gives for i ≤ j.
template <int N, class BlockOf>
void setBlocks(ElementMatrix& A, const BlockOf& blockOf) {
  for (int i = 0; i < N; ++i)
    for (int j = i; j < N; ++j) {
      const Mat3 block = blockOf(i, j);
      A.block<3, 3>(3 * i, 3 * j) = block;
      if (j > i) A.block<3, 3>(3 * j, 3 * i) = block.transpose();
    }
}

/// D of a stress 2 η Ė with Ė = ½ d(FᵀF)/dt, which no rigid motion changes:
///   vᵀ D v = 2 η V |Ė|²,   D_ij = η V ((g_i·g_j) F Fᵀ + (F g_j)(F g_i)ᵀ).
/// @param gradient  [1/m] g per corner
template <std::size_t N>
void setViscosity(const std::array<Vec3, N>& gradient, double volume, double viscosity,
                  const Mat3& F, ElementMatrix& D) {
  const Mat3 FFt = F.lazyProduct(F.transpose());
  std::array<Vec3, N> Fg;
  for (std::size_t i = 0; i < N; ++i) Fg[i] = F * gradient[i];
  setBlocks<static_cast<int>(N)>(D, [&](int i, int j) {
    return Mat3(viscosity * volume *
                (gradient[i].dot(gradient[j]) * FFt + Fg[j] * Fg[i].transpose()));
  });
}

/// The terms of a cell whose energy density is that law at these stretches.
/// The Hessian has nine modes in closed form: three of stretches, three twists, three flips
/// (Smith, de Goes & Kim, Analytic Eigensystems for Isotropic Distortion Energies, 2019).
void differentiateSolid(const Cell& cell, double viscosity, const Mat3& F,
                        const Stretches& stretches, const StretchLaw& law, ElementAsk ask,
                        ElementTerms& terms);

}  // namespace tumble
