// Orbits in a circular field: an oscillation across the axis, a parabola along it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/claim/free_body.h"
#include "app/claim/rows.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

/// The exact motion of a centre of mass under one circular field and a constant acceleration a:
///   x = m + u (u·v₀ t + ½ u·a t²) + r₀ cos Ωt + w₀ sin Ωt,
/// with u the axis, m the point at rest beside the start, r₀ the start across the axis from it,
/// w₀ = v₀⊥/Ω. World frame, SI.
struct Orbit {
  int body = 0;
  double end = 0.0;   ///< [s] of the first contact, or the duration
  double rate = 1.0;  ///< [rad/s] Ω > 0
  Vec3 axis = Vec3::UnitY(), middle = Vec3::Zero();
  Vec3 r0 = Vec3::Zero(), w0 = Vec3::Zero();  ///< [m]
  double speed = 0.0, acceleration = 0.0;     ///< along the axis

  Vec3 across(const Vec3& v) const { return v - axis.dot(v) * axis; }
  Vec3 radius(double t) const {
    double s = 0.0, c = 1.0;
    sinCos(rate * t, s, c);
    return c * r0 + s * w0;
  }
  Vec3 at(double t) const {
    return middle + (speed * t + 0.5 * acceleration * t * t) * axis + radius(t);
  }
  /// Root of the mean square of |radius| over a turn [m]; of a circle its radius.
  double amplitude() const { return std::sqrt(0.5 * (r0.squaredNorm() + w0.squaredNorm())); }
};

Orbit orbitOf(const BodyDef& def, const CircularField& field, const Vec3& a) {
  Orbit orbit;
  orbit.rate = field.rotation.norm();
  orbit.axis = field.rotation / orbit.rate;
  const Vec3 x = def.position - field.centre;
  const Vec3 shift = orbit.across(a) / (orbit.rate * orbit.rate);
  orbit.r0 = orbit.across(x) - shift;
  orbit.w0 = orbit.across(def.velocity) / orbit.rate;
  orbit.middle = def.position - orbit.r0;
  orbit.speed = orbit.axis.dot(def.velocity);
  orbit.acceleration = orbit.axis.dot(a);
  return orbit;
}

/// Every body that one circular field and otherwise constant forces move.
std::vector<Orbit> orbitsOf(const Scene& scene, const Recording& recording) {
  WorldDef others = scene.world;
  std::erase_if(others.forces,
                [](const Force& f) { return std::holds_alternative<CircularField>(f); });
  std::vector<std::vector<const CircularField*>> fields(others.bodies.size());
  for (const Force& force : scene.world.forces) {
    const CircularField* field = std::get_if<CircularField>(&force);
    for (std::size_t i = 0; field && i < fields.size(); ++i)
      if (field->body == kNoBody || field->body == static_cast<int>(i)) fields[i].push_back(field);
  }

  std::vector<Orbit> orbits;
  for (int i = 0; i < static_cast<int>(fields.size()); ++i) {
    if (fields[i].size() != 1 || !moves(others.bodies[i])) continue;
    const std::optional<Vec3> a = freeAcceleration(others, i);
    if (!a || fields[i][0]->rotation.isZero(0.0)) continue;
    Orbit orbit = orbitOf(others.bodies[i], *fields[i][0], *a);
    orbit.body = i;
    orbit.end = untouchedUntil(scene, recording, i);
    if (orbit.amplitude() > 0.0) orbits.push_back(orbit);
  }
  return orbits;
}

}  // namespace

std::vector<ClaimRow> orbitRows(const Scene& scene, const Recording& recording) {
  const std::vector<Orbit> orbits = orbitsOf(scene, recording);
  if (orbits.empty()) return {emptyClaim("no body runs in a circular field alone")};
  WorstRow size("radius of the orbit", 1e-9);
  WorstRow phase("phase of the orbit / rad", 1e-9);
  for (const Sample& sample : recording.samples) {
    for (const Orbit& orbit : orbits) {
      if (sample.t > orbit.end) continue;
      const Vec3 r = orbit.radius(sample.t);
      const Vec3 seen = orbit.across(sample.bodies[orbit.body].x - orbit.middle);
      const double amplitude = orbit.amplitude();
      size.see(seen.norm(), r.norm(), std::abs(seen.norm() - r.norm()) / amplitude);
      // The angle, times how far out it is: an ellipse may pass close to its middle.
      const double lag = std::atan2(seen.cross(r).norm(), seen.dot(r)) * r.norm() / amplitude;
      phase.see(lag, 0.0, lag);
    }
  }
  return {size.row(), phase.row()};
}

std::vector<Curve> orbitPaths(const Scene& scene, const Recording& recording) {
  constexpr double kSpacing = 1.0 / 240.0;  // [s]
  std::vector<Curve> curves;
  for (const Orbit& orbit : orbitsOf(scene, recording)) {
    Curve curve{orbit.body, {}};
    // What closes is drawn once.
    const double period = 2.0 * std::numbers::pi / orbit.rate;
    const bool closed = orbit.speed == 0.0 && orbit.acceleration == 0.0;
    const double end = closed ? std::min(orbit.end, period) : orbit.end;
    for (double t = 0.0; t <= end; t += kSpacing) curve.points.push_back(orbit.at(t));
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace tumble
