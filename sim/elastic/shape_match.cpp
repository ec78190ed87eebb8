// A cell of a box that is drawn to its shape at rest, wherever that fits best.
#include <algorithm>

#include "sim/elastic/solid.h"

namespace tumble {
namespace {

/// Axes whose signs one of the four ways is a product of, by bits.
constexpr int kWays[4] = {3, 5, 6, 7};

/// Sign of a corner along an axis, and the product over some axes.
double signOf(int corner, int axis) {
  return corner >> axis & 1 ? 1.0 : -1.0;
}
double signsOf(int corner, int axes) {
  double sign = 1.0;
  for (int axis = 0; axis < 3; ++axis)
    if (axes >> axis & 1) sign *= signOf(corner, axis);
  return sign;
}

std::array<Vec3, 8> gradientOf(const ShapeMatch& match) {
  std::array<Vec3, 8> gradient;
  for (int i = 0; i < 8; ++i)
    gradient[i] = Vec3(signOf(i, 0), signOf(i, 1), signOf(i, 2)).cwiseQuotient(8.0 * match.half);
  return gradient;
}

/// κ of a way.
double stiffnessOf(const ShapeMatch& match, int axes) {
  double sum = 0.0, count = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(axes >> axis & 1)) continue;
    sum += 1.0 / (match.half[axis] * match.half[axis]);
    count += 1.0;
  }
  return 2.0 * match.mu * 8.0 * match.half.prod() * sum / count;
}

/// The ways that F does not see: no rigid motion changes how long x_m is.
void addWays(const ShapeMatch& match, const ElementPlaces& x, Eigen::Matrix<double, 8, 8>& stiff,
             ElementTerms& terms) {
  for (const int axes : kWays) {
    const double kappa = stiffnessOf(match, axes);
    Eigen::Matrix<double, 8, 1> share;
    Vec3 way = Vec3::Zero();
    for (int i = 0; i < 8; ++i) {
      share[i] = 0.125 * signsOf(i, axes);
      way += share[i] * x[i];
    }
    terms.energy += 0.5 * kappa * way.squaredNorm();
    for (int i = 0; i < 8; ++i) terms.gradient.segment<3>(3 * i) += kappa * share[i] * way;
    stiff += kappa * share * share.transpose();
  }
}

/// The turn of R gives way: of 2 μ V |δF|² what lies in a plane of two stretches and turns there is
/// taken back, 2/(σ_i + σ_j) of it, and all of it at most if projected.
void addTurns(const Stretches& stretches, double stiffness, bool projected,
              const std::array<Vec3, 8>& turned, ElementMatrix& H) {
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double sum = stretches.sigma[i] + stretches.sigma[j];
    if (sum == 0.0) continue;  // any turn is as good: none is told apart
    const double share = projected ? std::min(2.0 / sum, 1.0) : 2.0 / sum;
    Mat3 mode = Mat3::Zero();
    mode(i, j) = 1.0;
    mode(j, i) = -1.0;
    const ElementVector q = cornersOf(mode, stretches.U, turned);
    H.noalias() -= 0.5 * stiffness * share * q * q.transpose();
  }
}

}  // namespace

Mat3 deformation(const ShapeMatch& match, const ElementPlaces& x) {
  const std::array<Vec3, 8> gradient = gradientOf(match);
  Mat3 F = Mat3::Zero();
  for (int i = 0; i < 8; ++i) F.noalias() += x[i] * gradient[i].transpose();
  return F;
}

void differentiate(const ShapeMatch& match, const ElementPlaces& x, ElementAsk ask,
                   ElementTerms& terms) {
  terms.clear<8>(ask);
  const std::array<Vec3, 8> gradient = gradientOf(match);
  const Mat3 F = deformation(match, x);
  const Stretches stretches = stretchesOf(F);
  const double volume = 8.0 * match.half.prod(), stiffness = 2.0 * match.mu * volume;
  const Vec3 strain = stretches.sigma - Vec3::Ones();  // F − R = U diag(strain) Vᵀ
  terms.energy = 0.5 * stiffness * strain.squaredNorm();
  std::array<Vec3, 8> turned;
  for (int i = 0; i < 8; ++i) turned[i] = stretches.V.transpose() * gradient[i];
  terms.gradient = stiffness * cornersOf(strain.asDiagonal(), stretches.U, turned);
  Eigen::Matrix<double, 8, 8> stiff = Eigen::Matrix<double, 8, 8>::Zero();
  addWays(match, x, stiff, terms);
  if (ask == ElementAsk::Energy || ask == ElementAsk::Forces) return;

  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      terms.hessian.block<3, 3>(3 * i, 3 * j).diagonal().array() =
          stiff(i, j) + stiffness * gradient[i].dot(gradient[j]);
  addTurns(stretches, stiffness, ask == ElementAsk::Projected, turned, terms.hessian);
  if (match.viscosity > 0.0) setViscosity(gradient, volume, match.viscosity, F, terms.damping);
}

}  // namespace tumble
