#include "sim/audit/joint_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tumble {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// How far a value lies beyond its limits.
double beyond(double value, double lo, double hi) {
  return std::max({lo - value, value - hi, 0.0});
}

/// The turn [rad] about a unit axis, next to the middle of two limits.
double turnAbout(const Quat& q, const Vec3& axis, double lo, double hi) {
  constexpr double kRound = 6.283185307179586;
  double turn = 2.0 * std::atan2(q.vec().dot(axis), q.w());
  const double middle = 0.5 * (lo + hi);
  if (std::isfinite(middle)) turn -= kRound * std::round((turn - middle) / kRound);
  return turn;
}

}  // namespace

Bond::Bond(const Model& model, std::size_t k, std::span<const Recorded> start)
    : lo_(model.def.joints[k].lo), hi_(model.def.joints[k].hi), arm_(model.joints[k].arm) {
  const JointDef& def = model.def.joints[k];
  a = def.a;
  b = def.b;
  kind_ = def.kind;
  const Recorded atA = at(a, start), atB = at(b, start);
  anchorA_B_ = atA.q.conjugate() * (def.anchorA - atA.x);
  anchorB_B_ = atB.q.conjugate() * (def.anchorB - atB.x);
  axisA_B_ = atA.q.conjugate() * def.axis.stableNormalized();
  axis_B_ = atB.q.conjugate() * def.axis.stableNormalized();
  held_ = atB.q.conjugate() * atA.q;
  length_ = (def.anchorA - def.anchorB).norm();
}

Bond::Bond(const Pivot& pivot)
    : a(pivot.body), anchorA_B_(pivot.c_B), anchorB_B_(pivot.p), lo_(-kInfinity), hi_(kInfinity) {}

double Bond::gap(std::span<const Recorded> now) const {
  const Recorded atA = at(a, now), atB = at(b, now);
  const Vec3 apart = atA.x + atA.q * anchorA_B_ - atB.x - atB.q * anchorB_B_;
  const Vec3 axis = atB.q * axis_B_;
  const Quat turned = atB.q.conjugate() * atA.q * held_.conjugate();
  const double size = apart.norm(), turn = 2.0 * arm_ * turned.vec().norm();
  switch (kind_) {
    case JointKind::Ball:
      return size;
    case JointKind::Fixed:
      return std::max(size, turn);
    case JointKind::Hinge:
      return std::max({size, arm_ * (atA.q * axisA_B_ - axis).norm(),
                       arm_ * beyond(turnAbout(turned, axis_B_, lo_, hi_), lo_, hi_)});
    case JointKind::Slider: {
      const double along = apart.dot(axis);
      return std::max({(apart - along * axis).norm(), turn, beyond(along, lo_, hi_)});
    }
    case JointKind::Distance:
      break;
  }
  const bool rod = !std::isfinite(lo_) && !std::isfinite(hi_);
  return rod ? std::abs(size - length_) : beyond(size, lo_, hi_);
}

}  // namespace tumble
