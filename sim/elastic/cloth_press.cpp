// Cloth that presses on cloth: points on triangles, and edges on edges.
#include <algorithm>

#include "sim/elastic/element.h"

namespace tumble {
namespace {

using Corners = std::array<Vec3, 4>;

/// The span of known weights.
ClothGap found(const Corners& x, const Vec4& weight) {
  ClothGap nearest{.weight = weight};
  for (int i = 0; i < 4; ++i)
    if (weight[i] != 0.0) nearest.span += weight[i] * x[i];
  return nearest;
}

void slides(ClothGap& nearest, const Vec4& along) {
  nearest.slide.col(nearest.ways++) = along;
}

/// Of point 0 with the edge between two corners, at a share of its length.
ClothGap onEdge(const Corners& x, int from, int to, double share) {
  Vec4 weight = Vec4::UnitX(), along = Vec4::Zero();
  weight[from] = share - 1.0;
  weight[to] = -share;
  along[from] = 1.0;
  along[to] = -1.0;
  ClothGap nearest = found(x, weight);
  slides(nearest, along);
  return nearest;
}

ClothGap onCorner(const Corners& x, int corner) {
  Vec4 weight = Vec4::UnitX();
  weight[corner] = -1.0;
  return found(x, weight);
}

/// E, its gradient and Hessian from where the two are nearest. With r = Σ w_i x_i, c = ∂w/∂α of
/// the ways α that they slide and T = Σ c_i x_i, stationary there,
///   ∂d/∂x_i = w_i n,   d ∂²d/∂x_i∂x_j = w_i w_j (1 − n nᵀ) − Σ (w_i T + c_i r) (TᵀT)⁻¹ (w_j T +
///   c_j r)ᵀ.
void press(double stiffness, double thickness, const Corners& x, const ClothGap& nearest,
           ElementAsk ask, ElementTerms& terms) {
  const double d = nearest.span.norm();
  if (d >= thickness) return;
  const double push = stiffness * (thickness - d);
  terms.energy = 0.5 * push * (thickness - d);
  // Without a distance it has no direction and pushes nothing.
  if (ask == ElementAsk::Energy || d == 0.0) return;
  const Vec3 n = nearest.span / d;
  const Vec4& w = nearest.weight;
  for (int i = 0; i < 4; ++i) terms.gradient.segment<3>(3 * i) = -push * w[i] * n;
  if (ask == ElementAsk::Forces) return;
  const Mat3 outer = n * n.transpose();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      terms.hessian.block<3, 3>(3 * i, 3 * j) = stiffness * w[i] * w[j] * outer;
  if (ask == ElementAsk::Projected) return;

  const int ways = nearest.ways;
  Eigen::Matrix<double, 3, 2> T = Eigen::Matrix<double, 3, 2>::Zero();
  for (int i = 0; i < 4; ++i) T += x[i] * nearest.slide.row(i);
  Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();
  if (ways == 1) inverse(0, 0) = 1.0 / T.col(0).squaredNorm();
  if (ways == 2) inverse = (T.transpose() * T).inverse();
  const auto slope = [&](int i) -> Eigen::Matrix<double, 3, 2> {
    return w[i] * T + nearest.span * nearest.slide.row(i);
  };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const Mat3 bend =
          w[i] * w[j] * (Mat3::Identity() - outer) - slope(i) * inverse * slope(j).transpose();
      terms.hessian.block<3, 3>(3 * i, 3 * j) -= push / d * bend;
    }
}

Corners cornersOf(const ElementPlaces& x) {
  return {x[0], x[1], x[2], x[3]};
}

}  // namespace

ClothGap nearestOnTriangle(const Corners& x) {
  const Vec3 &p = x[0], &a = x[1], &b = x[2], &c = x[3];
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return onCorner(x, 1);
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return onCorner(x, 2);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return onEdge(x, 1, 2, d1 / (d1 - d3));
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return onCorner(x, 3);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return onEdge(x, 1, 3, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return onEdge(x, 2, 3, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double v = vb / (va + vb + vc), w = vc / (va + vb + vc);
  ClothGap nearest = found(x, {1.0, v + w - 1.0, -v, -w});
  slides(nearest, {0.0, 1.0, -1.0, 0.0});
  slides(nearest, {0.0, 1.0, 0.0, -1.0});
  return nearest;
}

ClothGap nearestOfEdges(const Corners& x) {
  const Vec3 first = x[1] - x[0], second = x[3] - x[2], r = x[0] - x[2];
  const double a = first.squaredNorm(), e = second.squaredNorm(), f = second.dot(r);
  const double b = first.dot(second), c = first.dot(r), square = a * e - b * b;
  // Of parallel ones the middle of where they lie side by side, whichever way round they are told.
  constexpr double kParallel = 1e-12;
  if (square <= kParallel * a * e && a > 0.0) {
    const double p = -c / a, q = (b - c) / a;  // the second's ends along the first
    const double lo = std::clamp(std::min(p, q), 0.0, 1.0),
                 hi = std::clamp(std::max(p, q), 0.0, 1.0);
    const double middle = 0.5 * (lo + hi);
    const double u = e > 0.0 ? std::clamp((b * middle + f) / e, 0.0, 1.0) : 0.0;
    return found(x, {1.0 - middle, middle, u - 1.0, -u});
  }
  double s = std::clamp((b * f - c * e) / square, 0.0, 1.0);
  double u = e > 0.0 ? (b * s + f) / e : 0.0;
  if (u < 0.0 || u > 1.0) {
    u = u < 0.0 ? 0.0 : 1.0;
    s = a > 0.0 ? std::clamp((u * b - c) / a, 0.0, 1.0) : 0.0;
  }
  ClothGap nearest = found(x, {1.0 - s, s, u - 1.0, -u});
  if (s > 0.0 && s < 1.0) slides(nearest, {-1.0, 1.0, 0.0, 0.0});
  if (u > 0.0 && u < 1.0) slides(nearest, {0.0, 0.0, 1.0, -1.0});
  return nearest;
}

void differentiate(const ClothPoint& point, const ElementPlaces& x, ElementAsk ask,
                   ElementTerms& terms) {
  terms.clear(ask);
  const Corners at = cornersOf(x);
  press(point.stiffness, point.thickness, at, nearestOnTriangle(at), ask, terms);
}

void differentiate(const ClothEdges& edges, const ElementPlaces& x, ElementAsk ask,
                   ElementTerms& terms) {
  terms.clear(ask);
  const Corners at = cornersOf(x);
  press(edges.stiffness, edges.thickness, at, nearestOfEdges(at), ask, terms);
}

}  // namespace tumble
