// Free rotation by small steps of Runge and Kutta: an oracle that shares nothing with closed forms.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// q̇ = ½ (0, ω) q  with  ω = R I⁻¹ Rᵀ L  and L constant.
struct FreeRotor {
  Mat3 inertiaInverse;  ///< [1/(kg m²)] body frame
  Vec3 L;               ///< [kg m²/s]
  Quat q;

  /// Angular velocity [rad/s] at an attitude of any length; world frame.
  Vec3 omega(const Quat& at) const;
  /// The attitude after one classical step of h [s].
  Quat after(double h) const;
  /// Turns for `time` [s] by steps of at most kTurn.
  /// @param fastest  [rad/s] the most that the body turns with
  void advance(double time, double fastest);
  static constexpr double kTurn = 2e-3;  ///< [rad]
};

/// Angle [rad] of the rotation from one attitude to the other, 0 to π.
double angleBetween(const Quat& p, const Quat& q);

}  // namespace tumble
