#include "sim/elastic/solid.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tumble {
namespace {

/// Nine modes of F as its corners move along with them, and what each weighs.
struct Modes {
  Eigen::Matrix<double, 12, 9> q;
  Eigen::Matrix<double, 9, 1> weight;  ///< [Pa]
};

/// The three modes of the stretches themselves.
void findStretchModes(const Mat3& U, const StretchLaw& law, const std::array<Vec3, 4>& turned,
                      Modes& modes) {
  const Eigen::SelfAdjointEigenSolver<Mat3> own(law.curvature);
  for (int m = 0; m < 3; ++m) {
    modes.weight[m] = own.eigenvalues()[m];
    modes.q.col(m) = cornersOf(own.eigenvectors().col(m).asDiagonal(), U, turned);
  }
}

/// Those in which F turns or shears in the plane of two stretches.
void findPlaneModes(const Mat3& U, const StretchLaw& law, const std::array<Vec3, 4>& turned,
                    Modes& modes) {
  const double half = std::sqrt(0.5);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3, twist = 3 + 2 * k, flip = twist + 1;
    modes.weight[twist] = law.twist[k];
    modes.weight[flip] = law.flip[k];
    for (int c = 0; c < 4; ++c) {
      const Vec3 up = half * turned[c][j] * U.col(i), down = half * turned[c][i] * U.col(j);
      modes.q.col(twist).segment<3>(3 * c) = up - down;
      modes.q.col(flip).segment<3>(3 * c) = up + down;
    }
  }
}

}  // namespace

Vec3 stretchesAloneOf(const Mat3& F) {
  Vec3 sigma = Eigen::JacobiSVD<Mat3>(F).singularValues();
  if (F.determinant() < 0.0) sigma[2] *= -1.0;
  return sigma;
}

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

Stretches stretchesFor(ElementAsk ask, const Mat3& F) {
  if (ask != ElementAsk::Energy) return stretchesOf(F);
  return {Mat3::Identity(), Mat3::Identity(), stretchesAloneOf(F)};
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
  Modes modes;
  findStretchModes(stretches.U, law, turned, modes);
  findPlaneModes(stretches.U, law, turned, modes);
  if (ask == ElementAsk::Projected) modes.weight = modes.weight.cwiseMax(0.0);
  modes.weight *= cell.volume;
  setSquares(modes.q, modes.weight, terms.hessian);
  if (viscosity > 0.0) setViscosity(cell.gradient, cell.volume, viscosity, F, terms.damping);
}

}  // namespace tumble
