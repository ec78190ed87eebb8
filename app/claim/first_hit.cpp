// The first hit of each body on a floor: parabola of the centre of mass, free rotation about it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/claim/free_body.h"
#include "app/claim/free_rotor.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

struct Hit {
  double t = std::numeric_limits<double>::infinity();
  Vec3 x = Vec3::Zero();  ///< centre of mass [m]
};

// Marches the smallest gap to any floor and bisects the step in which it closes.
Hit hitOf(const WorldDef& world, int index, const Vec3& acceleration) {
  constexpr double kStep = 1.0 / 4096.0;  // [s] the rotor's error is far below what is allowed
  const BodyDef& body = world.bodies[index];
  const Mat3 inertia = massOf(body).inertia;
  FreeRotor rotor{inertia.inverse(),
                  angularMomentum(inertia, body.orientation, body.angularVelocity),
                  body.orientation};
  const auto centre = [&](double t) -> Vec3 {
    return body.position + body.velocity * t + 0.5 * t * t * acceleration;
  };
  const auto gap = [&](double t, const Quat& q) {
    double least = std::numeric_limits<double>::infinity();
    for (const BodyDef& other : world.bodies)
      if (const HalfSpace* floor = std::get_if<HalfSpace>(&other.shape))
        least = std::min(
            least, floor->n.dot(centre(t)) - floor->d - reach(body.shape, q, Vec3(-floor->n)));
    return least;
  };
  // What touches from the start has no first hit.
  constexpr double kTouch = 1e-9;  // [m] of a scene's own rounding
  if (gap(0.0, rotor.q) <= kTouch) return {};
  for (double t = 0.0; t < world.duration; t += kStep) {
    const Quat next = rotor.after(kStep);
    if (gap(t + kStep, next) > 0.0) {
      rotor.q = next;
      continue;
    }
    double low = 0.0, high = kStep;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (gap(t + middle, rotor.after(middle)) > 0.0 ? low : high) = middle;
    }
    return {t + high, centre(t + high)};
  }
  return {};
}

}  // namespace

std::vector<ClaimRow> firstHitRows(const Scene& scene, const Recording& recording) {
  std::vector<ClaimRow> rows;
  for (int i = 0; i < static_cast<int>(scene.world.bodies.size()); ++i) {
    const BodyDef& body = scene.world.bodies[i];
    const std::optional<Vec3> acceleration =
        moves(body) ? freeAcceleration(scene.world, i) : std::nullopt;
    if (!acceleration) continue;
    const Hit exact = hitOf(scene.world, i, *acceleration);
    if (!std::isfinite(exact.t)) continue;
    double measured = std::numeric_limits<double>::infinity();
    for (const Event& event : recording.report.events)
      if (event.a == i || event.b == i) {
        measured = event.t;
        break;
      }
    rows.push_back(
        {body.name + ": first hit at / s", measured, exact.t, std::abs(measured - exact.t), 1e-6});
  }
  if (rows.empty()) rows.push_back(emptyClaim("no body in free flight hits a floor"));
  return rows;
}

}  // namespace tumble
