// Bodies that turn free of torque, and until when.
#pragma once

#include <vector>

#include "app/claim/claim.h"
#include "sim/body/mass_properties.h"

namespace tumble {

/// A body that forces leave free to turn.
struct Spinner {
  int body = 0;
  Vec3 acceleration = Vec3::Zero();  ///< [m/s²] of its centre of mass
  Mat3 inertia = Mat3::Identity();   ///< [kg m²] body frame
  Vec3 L = Vec3::Zero();             ///< [kg m²/s] at the start, world frame
  Vec3 omega_B = Vec3::Zero();       ///< [rad/s] at the start, body frame
  double end = 0.0;  ///< [s] of the first event that it takes part in, or of the run

  /// L [kg m²/s] that a sample shows, world frame.
  Vec3 momentum(const BodySample& seen) const;
  /// The most [rad/s] that the energy lets it turn with.
  double fastest() const;
  /// Whether small steps can lead from a sample to the next.
  bool canBeFollowed(const Recording& recording) const;
  /// The row of a body that cannot be followed; fails and says what to do.
  ClaimRow lost(const std::string& name) const;
};

/// Every body that moves, turns, and is free of torque at the start.
std::vector<Spinner> spinnersOf(const Scene& scene, const Recording& recording);

}  // namespace tumble
