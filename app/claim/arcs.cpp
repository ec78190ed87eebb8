// Flight between hits, and what each hit does to momentum, spin and energy.
#include <algorithm>
#include <cmath>

#include "app/claim/flight_log.h"
#include "app/claim/free_body.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

// How far centre of mass, velocity and angular momentum stray from the log.
void addFlightRows(const Scene& scene, const Recording& recording, const FlightLog& log,
                   std::vector<ClaimRow>& rows) {
  const BodyDef& body = scene.world.bodies[log.body];
  const MassProperties mass = massOf(body);
  WorstRow path(body.name + ": off the parabolas / m", 1e-9);
  WorstRow speed(body.name + ": speed against impulses / (m/s)", 1e-9);
  WorstRow spin(body.name + ": spin against impulses", 1e-6);
  // Spin is told relative to the body's own, or to a thousandth of m r v where it has hardly any.
  const double radius = boundingRadius(body.shape);
  double scale = 0.0;
  for (const FlightState& arc : log.arcs)
    scale = std::max({scale, arc.L.norm(), 1e-3 * mass.mass * radius * arc.v.norm()});
  for (const Sample& sample : recording.samples)
    scale = std::max(scale, 1e-3 * mass.mass * radius * sample.bodies[log.body].v.norm());

  for (const Sample& sample : recording.samples) {
    if (sample.t >= log.end) break;
    const BodySample& seen = sample.bodies[log.body];
    const FlightState told = log.at(sample.t);
    const Vec3 L = angularMomentum(mass.inertia, seen.q, seen.omega);
    const double stray = (seen.x - told.x).norm();
    path.see(stray, 0.0, stray);
    speed.see(seen.v.norm(), told.v.norm(), (seen.v - told.v).norm());
    spin.see(L.norm(), told.L.norm(), (L - told.L).norm() / scale);
  }
  rows.push_back(path.row());
  rows.push_back(speed.row());
  rows.push_back(spin.row());
}

// Kinetic energy and the potential −m a·x of the uniform forces, of one body in a sample. [J]
double energyOf(const BodyDef& body, const Vec3& acceleration, const BodySample& seen) {
  const MassProperties mass = massOf(body);
  const Vec3 L = angularMomentum(mass.inertia, seen.q, seen.omega);
  return mass.mass * (0.5 * seen.v.squaredNorm() - acceleration.dot(seen.x)) +
         0.5 * seen.omega.dot(L);
}

// Energy of all bodies against what the hits take: each ½ (1 − e) j |vrel|, which is Newton's
// impact law for any number of points struck at once, by whatever lever.
std::vector<ClaimRow> energyRows(const Scene& scene, const Recording& recording,
                                 const std::vector<FlightLog>& logs) {
  WorstRow lost("energy lost in hits / J", 1e-6);
  WorstRow rise("energy gained between samples / J", 1e-6);
  double end = scene.world.duration;
  for (const FlightLog& log : logs) end = std::min(end, log.end);

  std::vector<double> energies;
  double scale = 0.0;
  for (const Sample& sample : recording.samples) {
    double energy = 0.0;
    for (const FlightLog& log : logs)
      energy += energyOf(scene.world.bodies[log.body], log.acceleration, sample.bodies[log.body]);
    energies.push_back(energy);
    scale = std::max(scale, sample.kinetic);
  }

  double taken = 0.0;
  std::size_t next = 0;
  const std::vector<Event>& events = recording.report.events;
  for (std::size_t k = 0; k < energies.size() && scale > 0.0; ++k) {
    const double t = recording.samples[k].t;
    for (; next < events.size() && events[next].t <= t; ++next) {
      const Event& hit = events[next];
      if (hit.kind != EventKind::Impact) continue;
      taken -= 0.5 * (1.0 - surfaceOf(scene.world, hit.a, hit.b).restitution) * hit.j * hit.vrel;
    }
    const double gained = k > 0 ? energies[k] - energies[k - 1] : 0.0;
    rise.see(std::max(0.0, gained), 0.0, gained / scale);
    const double gone = energies[0] - energies[k];
    if (t < end) lost.see(gone, taken, std::abs(gone - taken) / scale);
  }
  return {lost.row(), rise.row()};
}

}  // namespace

std::vector<ClaimRow> arcRows(const Scene& scene, const Recording& recording) {
  const std::vector<FlightLog> logs = flightLogs(scene, recording);
  const bool hit = std::any_of(logs.begin(), logs.end(),
                               [](const FlightLog& log) { return log.arcs.size() > 1; });
  if (!hit) return {emptyClaim("no body in free flight is hit")};
  std::vector<ClaimRow> rows;
  for (const FlightLog& log : logs) addFlightRows(scene, recording, log, rows);
  for (const ClaimRow& row : energyRows(scene, recording, logs)) rows.push_back(row);
  return rows;
}

std::vector<Curve> arcPaths(const Scene& scene, const Recording& recording) {
  constexpr double kSpacing = 1.0 / 240.0;  // [s]
  std::vector<Curve> curves;
  for (const FlightLog& log : flightLogs(scene, recording)) {
    Curve curve{log.body, {}};
    for (std::size_t k = 0; k < log.arcs.size(); ++k) {
      const double end = k + 1 < log.arcs.size() ? log.arcs[k + 1].t : log.end;
      for (double t = log.arcs[k].t; t < end; t += kSpacing) curve.points.push_back(log.at(t).x);
    }
    if (curve.points.size() > 1) curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace tumble
