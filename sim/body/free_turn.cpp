#include "sim/body/free_turn.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/body/principal_axes.h"
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
  const PrincipalAxes principal = principalAxes(IbodyInv);
  const Vec3& inverse = principal.moments;
  axes_ = Quat(principal.axes);
  // The middle moment belongs to the symmetric body, and the one nearer to it is what is taken for
  // equal.
  int order[] = {0, 1, 2};
  std::sort(order, order + 3, [&](int i, int j) { return inverse[i] < inverse[j]; });
  const auto [low, middle, high] = order;
  const bool below = inverse[middle] - inverse[low] <= inverse[high] - inverse[middle];
  restAxis_ = below ? low : high;
  topAxis_ = below ? high : low;
  round_ = inverse[middle];
  top_ = inverse[topAxis_] - round_;
  rest_ = inverse[restAxis_] - round_;
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
