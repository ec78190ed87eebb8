#include "app/claim/spinner.h"

#include <cmath>

#include "app/claim/free_body.h"

namespace tumble {

Vec3 Spinner::momentum(const BodySample& seen) const {
  return angularMomentum(inertia, seen.q, seen.omega);
}

double Spinner::fastest() const {
  const Mat3 inverse = inertia.inverse();
  // ω² ≤ 2 T/I_min, and 1/I_min ≤ |I⁻¹|.
  return std::sqrt(omega_B.dot(inertia * omega_B) * inverse.norm());
}

bool Spinner::canBeFollowed(const Recording& recording) const {
  constexpr double kBetween = 2000.0;  // [rad]
  return fastest() / recording.rate <= kBetween;
}

ClaimRow Spinner::lost(const std::string& name) const {
  return emptyClaim(name + " turns too far between samples to be followed; raise image.rate");
}

std::vector<Spinner> spinnersOf(const Scene& scene, const Recording& recording) {
  std::vector<Spinner> spinners;
  for (int body = 0; body < static_cast<int>(scene.world.bodies.size()); ++body) {
    const BodyDef& def = scene.world.bodies[body];
    if (!moves(def) || def.pivot_B || def.angularVelocity.isZero(0.0)) continue;
    const std::optional<Vec3> acceleration = freeAcceleration(scene.world, body);
    if (!acceleration) continue;
    const Mat3 inertia = massOf(def).inertia;
    spinners.push_back({body, *acceleration, inertia,
                        angularMomentum(inertia, def.orientation, def.angularVelocity),
                        def.orientation.conjugate() * def.angularVelocity,
                        untouchedUntil(scene, recording, body)});
  }
  return spinners;
}

}  // namespace tumble
