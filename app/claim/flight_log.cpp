#include "app/claim/flight_log.h"

#include "app/claim/free_body.h"

namespace tumble {

FlightState FlightLog::at(double t) const {
  std::size_t k = 0;
  while (k + 1 < arcs.size() && arcs[k + 1].t <= t) ++k;
  const FlightState& begin = arcs[k];
  const double s = t - begin.t;
  return {t, begin.x + begin.v * s + 0.5 * s * s * acceleration, begin.v + acceleration * s,
          begin.L};
}

namespace {

FlightLog logOf(const Scene& scene, const Recording& recording, int body,
                const Vec3& acceleration) {
  const BodyDef& def = scene.world.bodies[body];
  const MassProperties mass = massOf(def);
  FlightLog log{body, acceleration, {}, scene.world.duration};
  log.arcs.push_back({0.0, def.position, def.velocity,
                      angularMomentum(mass.inertia, def.orientation, def.angularVelocity)});
  for (const Event& event : recording.report.events) {
    if (event.a != body && event.b != body) continue;
    if (event.kind != EventKind::Impact ||
        surfaceOf(scene.world, event.a, event.b).friction > 0.0) {
      log.end = event.t;
      break;
    }
    const Vec3 impulse = (event.a == body ? event.j : -event.j) * event.n;
    FlightState after = log.at(event.t);
    after.v += impulse / mass.mass;
    after.L += (event.p - after.x).cross(impulse);
    log.arcs.push_back(after);
  }
  return log;
}

}  // namespace

std::vector<FlightLog> flightLogs(const Scene& scene, const Recording& recording) {
  std::vector<FlightLog> logs;
  for (int body = 0; body < static_cast<int>(scene.world.bodies.size()); ++body) {
    if (!moves(scene.world.bodies[body])) continue;
    if (const std::optional<Vec3> acceleration = freeAcceleration(scene.world, body))
      logs.push_back(logOf(scene, recording, body, *acceleration));
  }
  return logs;
}

}  // namespace tumble
