#include "sim/elastic/solid.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tumble {
namespace {

/// Adds the modes in which F turns or shears in the plane of two stretches.
void addPlaneModes(const Mat3& U, const StretchLaw& law, bool projected, double volume,
                   const std::array<Vec3, 4>& turned, ElementMatrix& H) {
  const double half = std::sqrt(0.5);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    for (const double sign : {-1.0, 1.0}) {
      double value = sign < 0.0 ? law.twist[k] : law.flip[k];
      if (projected) value = std::max(value, 0.0);
      if (value == 0.0) continue;
      Mat3 mode = Mat3::Zero();
      mode(i, j) = half;
      mode(j, i) = sign * half;
      const FewVector q = cornersOf(mode, U, turned);
      H.topLeftCorner<12, 12>().noalias() += volume * value * q * q.transpose();
    }
  }
}

/// Adds the three modes of the stretches themselves.
void addStretchModes(const Mat3& U, const StretchLaw& law, bool projected, double volume,
                     const std::array<Vec3, 4>& turned, ElementMatrix& H) {
  const Eigen::SelfAdjointEigenSolver<Mat3> own(law.curvature);
  for (int m = 0; m < 3; ++m) {
    const double value = projected ? std::max(own.eigenvalues()[m], 0.0) : own.eigenvalues()[m];
    const Mat3 mode = own.eigenvectors().col(m).asDiagonal();
    const FewVector q = cornersOf(mode, U, turned);
    H.topLeftCorner<12, 12>().noalias() += volume * value * q * q.transpose();
  }
}

}  // namespace

Stretches stretchesOf(const Mat3& F) {
  const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Stretches s{svd.matrixU(), svd.matrixV(), svd.singularValues()};
  if (s.U.determinant() < 0.0) {
    s.U.col(2) *= -1.0;
    s.sigma[2] *= -1.0;
  }
  if (s.V.determinant() < 0.0) {
    s.V.col(2) *= -1.0;
    s.sigma[2] *= -1.0;
  }
  return s;
}

Cell cellOf(const std::array<Vec3, 4>& x) {
  Mat3 edges;
  edges << x[1] - x[0], x[2] - x[0], x[3] - x[0];
  const double six = edges.determinant();
  if (!(six > 0.0)) throw std::invalid_argument("a tetrahedron without volume, or inside out");
  Cell cell;
  cell.volume = six / 6.0;
  for (int i = 0; i < 3; ++i)
    cell.gradient[i + 1] = edges.col((i + 1) % 3).cross(edges.col((i + 2) % 3)) / six;
  cell.gradient[0] = -(cell.gradient[1] + cell.gradient[2] + cell.gradient[3]);
  return cell;
}

Solidity solidityOf(double young, double poisson, double viscosity) {
  if (!(young > 0.0) || !(poisson >= 0.0) || !(poisson < 0.5))
    throw std::invalid_argument("a solid needs E > 0 and Poisson's ratio in [0, 0.5)");
  return {.mu = 0.5 * young / (1.0 + poisson),
          .lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
          .viscosity = viscosity};
}

Mat3 deformation(const Cell& cell, const ElementPlaces& x) {
  Mat3 F = Mat3::Zero();
  for (int i = 0; i < 4; ++i) F.noalias() += x[i] * cell.gradient[i].transpose();
  return F;
}

void differentiateSolid(const Cell& cell, double viscosity, const Mat3& F,
                        const Stretches& stretches, const StretchLaw& law, ElementAsk ask,
                        ElementTerms& terms) {
  terms.energy = cell.volume * law.energy;
  if (ask == ElementAsk::Energy) return;
  std::array<Vec3, 4> turned;
  for (int i = 0; i < 4; ++i) turned[i] = stretches.V.transpose() * cell.gradient[i];
  // P = U diag(ψ) Vᵀ.
  terms.gradient.head<12>() = cell.volume * cornersOf(law.slope.asDiagonal(), stretches.U, turned);
  if (ask == ElementAsk::Forces) return;
  const bool projected = ask == ElementAsk::Projected;
  addStretchModes(stretches.U, law, projected, cell.volume, turned, terms.hessian);
  addPlaneModes(stretches.U, law, projected, cell.volume, turned, terms.hessian);
  if (viscosity > 0.0) addViscosity(cell.gradient, cell.volume, viscosity, F, terms.damping);
}

}  // namespace tumble
