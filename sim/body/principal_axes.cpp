#include "sim/body/principal_axes.h"

#include <cmath>
#include <limits>
#include <utility>

namespace tumble {
namespace {

constexpr int kMostSweeps = 30;  // five are enough for any tensor met so far

/// Turns the plane of axes p and q so that A(p, q) becomes 0. False if it is 0 beside the moments.
bool rotate(Mat3& A, Mat3& axes, int p, int q) {
  const double product = A(p, q);
  const double scale = std::sqrt(std::abs(A(p, p))) * std::sqrt(std::abs(A(q, q)));
  if (std::abs(product) <= 0.25 * std::numeric_limits<double>::epsilon() * scale) return false;

  // The smaller root t = s/c of  t² + 2 cot t − 1 = 0.
  const double cot = (A(q, q) - A(p, p)) / (2.0 * product);
  const double t = (cot < 0.0 ? -1.0 : 1.0) / (std::abs(cot) + std::sqrt(cot * cot + 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
  const int r = 3 - p - q;
  A(p, p) -= t * product;
  A(q, q) += t * product;
  A(p, q) = A(q, p) = 0.0;
  const double rp = A(r, p), rq = A(r, q);
  A(r, p) = A(p, r) = c * rp - s * rq;
  A(r, q) = A(q, r) = s * rp + c * rq;
  const Vec3 axisP = axes.col(p), axisQ = axes.col(q);
  axes.col(p) = c * axisP - s * axisQ;
  axes.col(q) = s * axisP + c * axisQ;
  return true;
}

}  // namespace

PrincipalAxes principalAxes(const Mat3& inertia) {
  Mat3 A = inertia;
  PrincipalAxes result;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool turned = false;
    for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)})
      turned = rotate(A, result.axes, p, q) || turned;
    if (!turned) break;
  }
  result.moments = A.diagonal();
  return result;
}

}  // namespace tumble
