#include "sim/problem/friction_block.h"

#include <cmath>

#include "sim/problem/cone.h"

namespace tumble {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr int kNewtonSteps = 12;
constexpr int kProjections = 60;
constexpr double kTurn = 1e-8;  ///< [rad] after such a turn Newton errs by rounding

/// d turned by the angle whose tangent is `tangent`.
Vec2 turned(const Vec2& d, double tangent) {
  const double square = tangent * tangent;
  const double shrink = square < 1e-8 ? 1.0 - 0.5 * square : 1.0 / std::sqrt(1.0 + square);
  return Vec2(d[0] - tangent * d[1], d[1] + tangent * d[0]) * shrink;
}

/// d turned in both lanes.
void turn(Lanes& x, Lanes& y, Lanes tangent) {
  const Lanes square = tangent * tangent;
  Lanes shrink = 1.0 - 0.5 * square;
  if (!both(square < Lanes{1e-8, 1e-8}))
    shrink = chosen(square < Lanes{1e-8, 1e-8}, shrink, 1.0 / root(1.0 + square));
  const Lanes turned = (x - tangent * y) * shrink;
  y = (y + tangent * x) * shrink;
  x = turned;
}

/// λ = W⁻¹ r by Cholesky; false if W is singular.
bool solveThree(const Mat3& W, const Vec3& r, Vec3& lambda) {
  constexpr double kFlat = 1e-14;  // of the trace
  const double floor = kFlat * (W(0, 0) + W(1, 1) + W(2, 2));
  if (!(W(0, 0) > floor)) return false;
  const double l10 = W(1, 0) / W(0, 0), l20 = W(2, 0) / W(0, 0);
  const double d1 = W(1, 1) - l10 * W(1, 0);
  if (!(d1 > floor)) return false;
  const double e21 = W(2, 1) - l20 * W(1, 0), l21 = e21 / d1;
  const double d2 = W(2, 2) - l20 * W(2, 0) - l21 * e21;
  if (!(d2 > floor)) return false;
  const double y1 = r[1] - l10 * r[0], y2 = r[2] - l20 * r[0] - l21 * y1;
  lambda[2] = y2 / d2;
  lambda[1] = y1 / d1 - l21 * lambda[2];
  lambda[0] = r[0] / W(0, 0) - l10 * lambda[1] - l20 * lambda[2];
  return true;
}

/// Slip direction d with u_n = 0 and u_t parallel to d: false if Newton does not find it.
bool slide(const Mat3& W, const Vec3& c, double mu, Vec2 d, double enough, Vec3& lambda) {
  const Vec2 coupling(W(0, 1), W(0, 2)), drift = Vec2(c[1], c[2]) * (1.0 / c[0]);
  const Eigen::Matrix2d tangential = W.bottomRightCorner<2, 2>();
  for (int step = 0; step < kNewtonSteps; ++step) {
    // Slip per unit of λn, with λn = −c_n/(W_nn − mu W_nt·d); h is its part across d.
    const Vec2 across(-d[1], d[0]);
    const double normal = W(0, 0) - mu * coupling.dot(d);
    if (!(normal > 0.0)) return false;
    const Vec2 slip = coupling - mu * (tangential * d) - drift * normal;
    const Vec2 rate = drift * (mu * coupling.dot(across)) - mu * (tangential * across);
    const double along = d.dot(slip), h = across.dot(slip), slope = across.dot(rate) - along;

    // Newton's turn; halfway to the slip where Newton leads elsewhere.
    if (!(slope < 0.0 && std::abs(h) < -slope)) {
      const Vec2 halfway = d + slip / slip.norm();
      const double size = halfway.norm();
      constexpr double kAgainst = 1e-3;  // of two unit directions
      if (!(size > kAgainst)) return false;
      d = halfway / size;
      continue;
    }
    const double turn = -h / slope;
    d = turned(d, turn);
    if (std::abs(turn) > enough) continue;
    if (along <= 0.0) return false;
    const double push = -c[0] / (W(0, 0) - mu * coupling.dot(d));
    lambda = Vec3(push, -mu * push * d[0], -mu * push * d[1]);
    return push >= 0.0;
  }
  return false;
}

/// The same from a first guess that points, of whatever length, against the slip.
bool slideFrom(const Mat3& W, const Vec3& c, double mu, const Vec2& against, double enough,
               Vec3& lambda) {
  const double size = std::sqrt(against[0] * against[0] + against[1] * against[1]);
  return size > 0.0 && slide(W, c, mu, against * (-1.0 / size), enough, lambda);
}

}  // namespace

Vec3 solveFrictionBlock(const Mat3& W, const Vec3& c, double mu, const Vec3& start) {
  if (c[0] >= 0.0) return Vec3::Zero();
  Vec3 stick = Vec3::Zero();
  if (mu > 0.0 && solveThree(W, -c, stick)) {
    const double held = std::sqrt(stick[1] * stick[1] + stick[2] * stick[2]);
    if (held <= mu * stick[0]) return stick;
  }
  return slideFrictionBlock(W, c, mu, start, stick, kTurn);
}

Vec3 slideFrictionBlock(const Mat3& W, const Vec3& c, double mu, const Vec3& start,
                        const Vec3& stick, double enough) {
  if (mu <= 0.0) return {-c[0] / W(0, 0), 0.0, 0.0};

  // Slip as before, against the force that would hold it, or as without friction.
  Vec3 lambda;
  if (slideFrom(W, c, mu, start.tail<2>(), enough, lambda)) return lambda;
  if (slideFrom(W, c, mu, stick.tail<2>(), enough, lambda)) return lambda;
  const Vec2 frictionless(W(0, 1) * c[0] / W(0, 0) - c[1], W(0, 2) * c[0] / W(0, 0) - c[2]);
  if (slideFrom(W, c, mu, frictionless, enough, lambda)) return lambda;

  const double rho = 1.0 / W.trace();
  lambda = start;
  for (int k = 0; k < kProjections; ++k) {
    Vec3 u = W * lambda + c;
    u[0] += mu * std::sqrt(u[1] * u[1] + u[2] * u[2]);
    lambda = projectOnFrictionCone(lambda - rho * u, mu);
  }
  return lambda;
}

LaneMask slideAbreast(const LanesSymmetric& W, const Lanes3& c, Lanes mu, const Lanes3& start,
                      double enough, LaneMask lanes, Lanes3& lambda) {
  // Line by line the arithmetic of slideFrom() and slide().
  const Lanes none{}, size = root(start.y * start.y + start.z * start.z), per = -1.0 / size;
  const Lanes inverse = 1.0 / c.x, driftX = c.y * inverse, driftY = c.z * inverse;
  const Lanes Txx = mu * W.yy, Txy = mu * W.yz, Tyy = mu * W.zz;
  Lanes x = start.y * per, y = start.z * per;
  LaneMask found{}, sought = lanes & (mu > none);
  for (int step = 0; step < kNewtonSteps && !neither(sought); ++step) {
    const Lanes normal = W.xx - mu * (W.xy * x + W.xz * y);
    const Lanes slipX = W.xy - (Txx * x + Txy * y) - driftX * normal;
    const Lanes slipY = W.xz - (Txy * x + Tyy * y) - driftY * normal;
    const Lanes sideways = mu * (W.xy * -y + W.xz * x);
    const Lanes rateX = driftX * sideways - (Txx * -y + Txy * x);
    const Lanes rateY = driftY * sideways - (Txy * -y + Tyy * x);
    const Lanes along = x * slipX + y * slipY, h = -y * slipX + x * slipY;
    const Lanes slope = -y * rateX + x * rateY - along;
    sought &= (normal > none) & (slope < none) & (sizeOf(h) < -slope);

    const Lanes tangent = chosen(sought, -h / slope, none);
    turn(x, y, tangent);
    const LaneMask last = sought & (sizeOf(tangent) <= Lanes{enough, enough});
    found |= last & (along > none);
    sought &= ~last;
  }
  const Lanes push = -c.x / (W.xx - mu * (W.xy * x + W.xz * y));
  lambda = {push, -mu * push * x, -mu * push * y};
  return found & (push >= none);
}

Mat3 inverseOfBlock(const Mat3& W) {
  Mat3 inverse;
  for (int k = 0; k < 3; ++k) {
    Vec3 column;
    if (!solveThree(W, Vec3::Unit(k), column)) return Mat3::Zero();
    inverse.col(k) = column;
    for (int i = 0; i < k; ++i) inverse(i, k) = inverse(k, i);
  }
  return inverse;
}

}  // namespace tumble
