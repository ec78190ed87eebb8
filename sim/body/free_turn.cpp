#include "sim/body/free_turn.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "sim/math/rotation.h"

namespace tumble {
namespace {

/// Turns q about a principal axis by h · excess · (L along that axis).
void turnAbout(int axis, double excess, const Vec3& L, double h, Quat& q) {
  if (excess == 0.0) return;
  const Vec3 e = Vec3::Unit(axis);
  q = rotated(q, h * excess * (q * e).dot(L) * (q * e));
}

}  // namespace

FreeTurn::FreeTurn(const Mat3& IbodyInv) {
  Vec3 inverse = IbodyInv.diagonal();
  if (!IbodyInv.isDiagonal(0.0)) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(IbodyInv);
    Mat3 axes = solver.eigenvectors();
    if (axes.determinant() < 0.0) axes.col(0) = -axes.col(0);
    axes_ = Quat(axes).normalized();
    inverse = solver.eigenvalues();
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double gap = std::abs(inverse[j] - inverse[i]);
    if (gap >= nearest) continue;
    nearest = gap;
    restAxis_ = j;
    topAxis_ = k;
    round_ = inverse[i];
    top_ = inverse[k] - inverse[i];
    rest_ = inverse[j] - inverse[i];
  }
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * inverse.maxCoeff();
  if (std::abs(rest_) <= rounding) rest_ = 0.0;
}

Quat FreeTurn::operator()(const Quat& q, const Vec3& L, double h) const {
  Quat turn = q * axes_;
  turnAbout(restAxis_, rest_, L, 0.5 * h, turn);
  // The symmetric body: about its axis, which then precesses about L.
  turnAbout(topAxis_, top_, L, h, turn);
  turn = rotated(turn, h * round_ * L);
  turnAbout(restAxis_, rest_, L, 0.5 * h, turn);
  return turn * axes_.conjugate();
}

}  // namespace tumble
