// The motion that a run's impulses imply: from the scene's start, along parabolas, from hit to hit.
#pragma once

#include <vector>

#include "app/record/recording.h"

namespace tumble {

/// Linear motion and spin of one body at an instant. World frame, SI.
struct FlightState {
  double t = 0.0;
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();
  Vec3 L = Vec3::Zero();  ///< angular momentum about the centre of mass
};

/// A body's states after the start and after each hit, up to `end`.
struct FlightLog {
  int body = 0;
  Vec3 acceleration = Vec3::Zero();  ///< [m/s²]
  std::vector<FlightState> arcs;     ///< one for the beginning of each arc
  double end = 0.0;  ///< [s] of the first contact that lasts or rubs, or the duration

  /// The state at t ≤ end: x and v on the parabola of the arc that holds t, L that of the arc.
  FlightState at(double t) const;
};

/// Applies every impulse of the report to the scene's start, for each body in free flight:
///   x⁺ = x,  v⁺ = v ± j n/m,  L⁺ = L ± (p − x) × j n.
std::vector<FlightLog> flightLogs(const Scene& scene, const Recording& recording);

}  // namespace tumble
