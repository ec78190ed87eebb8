// A solid as of rubber.
#include <Eigen/Eigenvalues>

#include "sim/elastic/solid.h"

namespace tumble {

void differentiate(const NeoHookean& solid, const ElementPlaces& x, ElementAsk ask,
                   ElementTerms& terms) {
  const Mat3 F = deformation(solid.cell, x);
  const Stretches stretches = stretchesFor(ask, F);
  const auto [mu, lambda, viscosity] = solid.solid;
  const Vec3& s = stretches.sigma;
  // By strains e = σ − 1, whose first order cancels:  |F|² − 3 = 2 Σ e + |e|²,
  // J − 1 = Σ e + Σ e_i e_j + e₀ e₁ e₂.
  const Vec3 e = s - Vec3::Ones();
  const double higher = e[0] * e[1] + e[1] * e[2] + e[2] * e[0] + e[0] * e[1] * e[2];
  const double grown = e.sum() + higher, bulk = lambda + mu;
  const double pressure = bulk * grown - mu;               // ∂Ψ/∂J
  const Vec3 J = {s[1] * s[2], s[2] * s[0], s[0] * s[1]};  // ∂J/∂σ
  StretchLaw law;
  law.energy = mu * (0.5 * e.squaredNorm() - higher) + 0.5 * bulk * grown * grown;
  law.slope = mu * s + pressure * J;
  Mat3 curvature = mu * Mat3::Identity() + bulk * J * J.transpose();
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    curvature(i, j) += pressure * s[k];
    curvature(j, i) += pressure * s[k];
    law.flip[k] = mu - pressure * s[k];
    law.twist[k] = mu + pressure * s[k];
  }
  if (ask == ElementAsk::Matrices || ask == ElementAsk::Projected) {
    const Eigen::SelfAdjointEigenSolver<Mat3> own(curvature);
    law.way = own.eigenvectors();
    law.weight = own.eigenvalues();
  }
  differentiateSolid(solid.cell, viscosity, F, stretches, law, ask, terms);
}

}  // namespace tumble
