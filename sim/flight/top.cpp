#include "sim/flight/top.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/body/principal_axes.h"
#include "sim/math/rotation.h"

namespace tumble {
namespace {

/// Order at which an arc costs least per second, and the size of its last terms beside the first.
constexpr int kOrder = 24;
constexpr double kNegligible = 2e-17;
/// An arc that would have to be shorter than this beside the time itself ends the motion.
constexpr double kShortest = 1e-12;
constexpr double kLongest = 1e6;  ///< [s] an arc of a body at rest

Vec4 quaternionTimes(const Vec4& q, const Vec3& w) {
  const Vec3 u = q.tail<3>();
  Vec4 product;
  product[0] = -u.dot(w);
  product.tail<3>() = q[0] * w + u.cross(w);
  return product;
}

/// The longest step of which the last two terms of the series are negligible, to a tenth.
/// @param most  [kg m²/s] that H can come to
double arcLength(const std::vector<Vec4>& q, const std::vector<Vec3>& H, double most) {
  const auto negligible = [&](double h) {
    for (const int k : {kOrder - 1, kOrder}) {
      double term = std::max(q[k].norm(), most > 0.0 ? H[k].norm() / most : 0.0);
      for (int i = 0; i < k; ++i) term *= h;
      if (!(term <= kNegligible)) return false;
    }
    return true;
  };
  double h = 1.0;
  while (h < kLongest && negligible(h)) h *= 2.0;
  while (h > 0.0 && !negligible(h)) h *= 0.9;
  return h;
}

/// Horner's rule, from the smallest term to the largest.
template <class Vector>
Vector evaluate(const std::vector<Vector>& c, double s) {
  Vector sum = c[kOrder];
  for (int k = kOrder - 1; k >= 0; --k) sum = c[k] + s * sum;
  return sum;
}

}  // namespace

HeavyTop::HeavyTop(const RigidBody& start, const Pivot& pivot, const Vec3& gravity, double t0)
    : pivot_(pivot),
      gravity_(gravity),
      weight_(start.M * gravity.norm()),
      body_(start),
      q_(start.q.w(), start.q.x(), start.q.y(), start.q.z()),
      H_B_(start.R.transpose() * momentumAbout(pivot, start)),
      t0_(t0),
      end_(t0) {
  const Vec3 moments = principalAxes(pivot.Ibody).moments;
  const double least = moments.minCoeff();
  const double torque = weight_ * pivot.c_B.norm();
  const double energy = 0.5 * H_B_.dot(pivot.IbodyInv * H_B_) + 2.0 * torque;
  const double omega2 = 2.0 * energy / least;
  most_ = std::sqrt(2.0 * energy * moments.maxCoeff());
  bound_ = omega2 + (torque + (moments.maxCoeff() - least) * omega2) / least;
}

bool HeavyTop::addArc() {
  Arc arc{.t = end_, .h = 0.0, .q = {q_}, .H_B = {H_B_}};
  const Mat3 R = rotationMatrix(Quat(q_[0], q_[1], q_[2], q_[3]));
  std::vector<Vec3> omega, gamma = {R.transpose() * gravity_};
  for (int k = 0; k < kOrder; ++k) {
    omega.push_back(pivot_.IbodyInv * arc.H_B[k]);
    Vec3 H = -body_.M * pivot_.c_B.cross(gamma[k]), g = Vec3::Zero();
    Vec4 q = Vec4::Zero();
    for (int j = 0; j <= k; ++j) {
      H += arc.H_B[j].cross(omega[k - j]);
      g += gamma[j].cross(omega[k - j]);
      q += quaternionTimes(arc.q[j], omega[k - j]);
    }
    arc.H_B.push_back(H / (k + 1));
    gamma.push_back(g / (k + 1));
    arc.q.push_back(0.5 * q / (k + 1));
  }
  if (!arc.q[kOrder].allFinite() || !arc.H_B[kOrder].allFinite()) return false;
  arc.h = arcLength(arc.q, arc.H_B, most_);
  if (!(arc.h > kShortest * std::abs(end_))) return false;
  const double next = end_ + arc.h;
  arc.h = next - end_;  // so that the clock of the arcs does not round
  q_ = evaluate(arc.q, arc.h).normalized();
  H_B_ = evaluate(arc.H_B, arc.h);
  end_ = next;
  arcs_.push_back(std::move(arc));
  return true;
}

bool HeavyTop::reach(double t) {
  while (arcs_.empty() || end_ < t)
    if (!addArc()) return false;
  return true;
}

void HeavyTop::forget(double t) {
  auto keep = arcs_.begin();
  while (keep != arcs_.end() && keep + 1 != arcs_.end() && keep->t + keep->h < t) ++keep;
  arcs_.erase(arcs_.begin(), keep);
}

const HeavyTop::Arc& HeavyTop::arcAt(double t) const {
  assert(!arcs_.empty() && t <= end_);
  const auto after = std::upper_bound(arcs_.begin(), arcs_.end(), t,
                                      [](double time, const Arc& arc) { return time < arc.t; });
  return after == arcs_.begin() ? *after : *(after - 1);
}

void HeavyTop::at(double t, RigidBody& body) const {
  if (t == t0_) {
    body = body_;
    return;
  }
  const Arc& arc = arcAt(t);
  const Vec4 q = evaluate(arc.q, t - arc.t);
  body.q = Quat(q[0], q[1], q[2], q[3]).normalized();
  hold(pivot_, rotationMatrix(body.q) * evaluate(arc.H_B, t - arc.t), body);
}

Pose HeavyTop::pose(double t) const {
  RigidBody body = body_;
  at(t, body);
  return body.pose();
}

double HeavyTop::accelBound(double r) const {
  return (pivot_.c_B.norm() + r) * bound_;
}

}  // namespace tumble
