// A strand that turns from one piece to the next.
#include <algorithm>

#include "sim/elastic/element.h"

namespace tumble {

void differentiate(const StrandBend& strand, const ElementPlaces& x, ElementAsk ask,
                   ElementTerms& terms) {
  terms.clear<3>(ask);
  const Vec3 e0 = x[1] - x[0], e1 = x[2] - x[1];
  const double l0 = e0.norm(), l1 = e1.norm(), k = strand.stiffness / strand.length;
  if (l0 == 0.0 || l1 == 0.0) return;  // a piece without length has no direction
  const Vec3 t0 = e0 / l0, t1 = e1 / l1;
  const double cosine = t0.dot(t1);
  terms.energy = 0.5 * k * (t1 - t0).squaredNorm();
  if (ask == ElementAsk::Energy) return;

  // By the pieces:  ∂(t₀·t₁)/∂e₀ = P₀ t₁/l₀  with  P = 1 − t tᵀ.
  const Vec3 across0 = t1 - cosine * t0, across1 = t0 - cosine * t1;
  const Vec3 g0 = -k / l0 * across0, g1 = -k / l1 * across1;
  terms.gradient.segment<3>(0) = -g0;
  terms.gradient.segment<3>(3) = g0 - g1;
  terms.gradient.segment<3>(6) = g1;
  if (ask == ElementAsk::Forces) return;

  const Mat3 P0 = Mat3::Identity() - t0 * t0.transpose();
  const Mat3 P1 = Mat3::Identity() - t1 * t1.transpose();
  Mat6 H;
  if (ask == ElementAsk::Projected) {
    // Gauss and Newton's: k |t₁ − t₀|²/2 with the tangents linear in the pieces.
    H.block<3, 3>(0, 0) = k / (l0 * l0) * P0;
    H.block<3, 3>(3, 3) = k / (l1 * l1) * P1;
  } else {
    const Mat3 mix0 = t0 * across0.transpose(), mix1 = t1 * across1.transpose();
    H.block<3, 3>(0, 0) = k / (l0 * l0) * (mix0 + mix0.transpose() + cosine * P0);
    H.block<3, 3>(3, 3) = k / (l1 * l1) * (mix1 + mix1.transpose() + cosine * P1);
  }
  H.block<3, 3>(0, 3) = -k / (l0 * l1) * P0 * P1;
  H.block<3, 3>(3, 0) = H.block<3, 3>(0, 3).transpose();
  // From pieces to points: e₀ = x₁ − x₀, e₁ = x₂ − x₁.
  Eigen::Matrix<double, 9, 6> half;
  half << -H.topRows<3>(), H.topRows<3>() - H.bottomRows<3>(), H.bottomRows<3>();
  const auto first = half.leftCols<3>(), second = half.rightCols<3>();
  terms.hessian.topLeftCorner<9, 9>() << -first, first - second, second;
}

}  // namespace tumble
