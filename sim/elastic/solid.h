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

/// The terms of a cell whose energy density is that law at these stretches.
/// The Hessian has nine modes in closed form: three of stretches, three twists, three flips
/// (Smith, de Goes & Kim, Analytic Eigensystems for Isotropic Distortion Energies, 2019).
void differentiateSolid(const Cell& cell, double viscosity, const Mat3& F,
                        const Stretches& stretches, const StretchLaw& law, ElementAsk ask,
                        ElementTerms& terms);

}  // namespace tumble
