// Chapter 10, audit: how far joints are from being met, told from how they were at the start.
#pragma once

#include <span>
#include <vector>

#include "sim/audit/recorded.h"
#include "sim/method/model.h"

namespace tumble {

/// What the definition of a joint, or of a pivot, keeps of its two bodies.
class Bond {
 public:
  Bond(const Model& model, std::size_t joint, std::span<const Recorded> start);
  Bond(const Pivot& pivot);

  /// How far [m] it is from being met: anchors apart, turns that it does not allow times its arm,
  /// and what lies beyond its limits.
  double gap(std::span<const Recorded> now) const;

  int a = 0, b = kNoBody;  ///< kNoBody: the world

 private:
  Recorded at(int body, std::span<const Recorded> now) const {
    return body == kNoBody ? Recorded{} : now[body];
  }

  JointKind kind_ = JointKind::Ball;
  Vec3 anchorA_B_, anchorB_B_;    ///< [m]
  Vec3 axis_B_ = Vec3::UnitZ();   ///< in b, and
  Vec3 axisA_B_ = Vec3::UnitZ();  ///< in a
  Quat held_ = Quat::Identity();  ///< from a to b, at the start
  double lo_, hi_, length_ = 0.0, arm_ = 1.0;
};

}  // namespace tumble
