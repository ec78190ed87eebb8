// What lies, slides or rolls on a plane that stands still: Coulomb's law, tan θ = μ.
#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "app/claim/footing.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

// Allowed errors [m/s²], [s], [m/s]; measured 1e-10, 8e-11, 8e-15, and 4e-12 m/s in steps.
constexpr double kAcceleration = 1e-9, kInstant = 1e-9, kSpeed = 1e-9;

// Two samples may have a step more or less between them than fits.
void seeChange(const Vec3& change, const Vec3& told, double time, double step, WorstRow& row) {
  double best = time;
  for (const double other : {time - step, time + step})
    if ((change - told * other).norm() < (change - told * best).norm()) best = other;
  row.see(change.norm() / best, told.norm(), (change / best - told).norm());
}

// From sample to sample without an event between, the velocity changes as the plane lets it.
std::vector<ClaimRow> accelerationRows(const Scene& scene, const Recording& recording, int body,
                                       const Vec3& gravity) {
  std::map<std::string, WorstRow> rows;
  for (std::size_t k = 0; k + 1 < recording.samples.size(); ++k) {
    const Sample &now = recording.samples[k], &next = recording.samples[k + 1];
    const Footing footing = footingOf(scene, now, body, gravity);
    if (footing.ground == kNoBody || !footing.straight()) continue;
    if (nextEvent(recording, body, now.t).t <= next.t) continue;
    const bool ball = footing.mobility > 1.0;
    const bool slides = footing.slides() || !footing.holds();
    const std::string label =
        fmt::format("{} {} at {:.3g}°: acceleration / (m/s²)", scene.world.bodies[body].name,
                    slides ? "slides"
                    : ball ? "rolls"
                           : "stays",
                    footing.degrees());
    const Vec3 told = footing.acceleration();
    const Vec3 change = next.bodies[body].v - now.bodies[body].v;
    WorstRow& row = rows.try_emplace(label, label, kAcceleration).first->second;
    seeChange(change, told, next.t - now.t, grain(scene), row);
  }
  std::vector<ClaimRow> found;
  for (const auto& [label, row] : rows) found.push_back(row.row());
  return found;
}

// Where a slip ends, and how fast the body is then: 2 v/(7 μ g) and 5/7 v for a ball thrown flat.
void addStops(const Scene& scene, const Recording& recording, int body, const Vec3& gravity,
              std::vector<ClaimRow>& rows) {
  const std::string& name = scene.world.bodies[body].name;
  WorstRow instant(name + ": its slip ends at / s", kInstant + 2.0 * grain(scene));
  WorstRow speed(name + ": its speed then / (m/s)", kSpeed);
  bool any = false;
  for (const Sample& now : recording.samples) {
    const Footing footing = footingOf(scene, now, body, gravity);
    if (footing.ground == kNoBody || !footing.slides() || !footing.straight()) continue;
    const Event end = nextEvent(recording, body, now.t);
    const double told = now.t + footing.stops();
    if (std::min(told, end.t) > recording.samples.back().t) continue;
    if (end.t < told && end.kind != EventKind::Stick) continue;  // it hit something, or flew
    instant.see(end.t, told, std::abs(end.t - told));
    any = true;
    const auto after = std::find_if(recording.samples.begin(), recording.samples.end(),
                                    [&](const Sample& s) { return s.t >= end.t; });
    if (after == recording.samples.end()) continue;
    const Vec3 then = now.bodies[body].v + footing.acceleration() * footing.stops();
    const Vec3 seen = after->bodies[body].v - footing.stuck().acceleration() * (after->t - told);
    speed.see(seen.norm(), then.norm(), (seen - then).norm());
  }
  if (!any) return;
  rows.push_back(instant.row());
  rows.push_back(speed.row());
}

}  // namespace

std::vector<ClaimRow> slidingRows(const Scene& scene, const Recording& recording) {
  std::vector<ClaimRow> rows;
  for (int body = 0; body < static_cast<int>(scene.world.bodies.size()); ++body) {
    if (!moves(scene.world.bodies[body])) continue;
    const std::optional<Vec3> gravity = freeAcceleration(scene.world, body);
    if (!gravity) continue;
    for (const ClaimRow& row : accelerationRows(scene, recording, body, *gravity))
      rows.push_back(row);
    addStops(scene, recording, body, *gravity, rows);
  }
  if (rows.empty()) return {emptyClaim("no body lies on a plane that stands still")};
  return rows;
}

}  // namespace tumble
