// How far a body gets on the plane that carries it at the start, how fast, and when its slip ends.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/claim/footing.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

// Allowed of place [m], instant [s] and speed [m/s]; measured 5e-10, 5e-16 and 1e-9, where a block
// of `course` turns round: friction changes its side somewhere within kStill. In steps a change of
// speed comes up to two of them early or late.
constexpr double kWay = 1e-9, kSpeed = 10.0 * Footing::kStill, kLate = 2.0;

/// A stretch of the way with constant acceleration; the next one begins where it ends.
struct Stretch {
  double start = 0.0;  ///< [s]
  Vec3 x, v, a;        ///< at its start
  Vec3 place(double t) const { return x + (t - start) * (v + 0.5 * (t - start) * a); }
  Vec3 velocity(double t) const { return v + (t - start) * a; }
};

// As it slides at first; then as it rolls, lies, or turns round and slides down.
std::vector<Stretch> stretchesOf(const Footing& footing, const BodySample& start) {
  std::vector<Stretch> way = {{0.0, start.x, start.v, footing.acceleration()}};
  if (!footing.slides()) return way;
  const double end = footing.stops();
  if (end == std::numeric_limits<double>::infinity()) return way;
  Stretch next{end, way[0].place(end), way[0].velocity(end), footing.stuck().acceleration()};
  if (footing.mobility == 1.0) next.v.setZero();
  way.push_back(next);
  return way;
}

// When it first hits something, or leaves the plane.
double undisturbedUntil(const Recording& recording, int body) {
  for (const Event& event : recording.report.events) {
    const bool its = event.a == body || event.b == body;
    if (its && (event.kind == EventKind::Impact || event.kind == EventKind::Separate))
      return event.t;
  }
  return std::numeric_limits<double>::infinity();
}

// The end of the slip, where the run comes to it; what turns round at once has none.
void addEnd(const Recording& recording, int body, double told, double until, WorstRow row,
            std::vector<ClaimRow>& rows) {
  if (told >= std::min(until, recording.samples.back().t)) return;
  for (const Event& event : recording.report.events)
    if (event.kind == EventKind::Stick && (event.a == body || event.b == body)) {
      row.see(event.t, told, std::abs(event.t - told));
      break;
    }
  rows.push_back(row.row());
}

void addWay(const Scene& scene, const Recording& recording, int body, const Footing& footing,
            std::vector<ClaimRow>& rows) {
  const std::string& name = scene.world.bodies[body].name;
  const std::vector<Stretch> way = stretchesOf(footing, recording.samples.front().bodies[body]);
  const double until = undisturbedUntil(recording, body), late = kLate * grain(scene);
  double fastest = 0.0, hardest = 0.0;
  for (const Stretch& stretch : way) {
    hardest = std::max(hardest, stretch.a.norm());
    for (const double t : {stretch.start, recording.samples.back().t})
      fastest = std::max(fastest, stretch.velocity(t).norm());
  }
  WorstRow place(name + ": its place / m", kWay + late * fastest);
  WorstRow speed(name + ": its speed / (m/s)", kSpeed + late * hardest);
  for (const Sample& sample : recording.samples) {
    if (sample.t >= until) break;
    const Stretch& now = sample.t < way.back().start ? way.front() : way.back();
    const BodySample& seen = sample.bodies[body];
    place.see((seen.x - way[0].x).norm(), (now.place(sample.t) - way[0].x).norm(),
              (seen.x - now.place(sample.t)).norm());
    speed.see(seen.v.norm(), now.velocity(sample.t).norm(),
              (seen.v - now.velocity(sample.t)).norm());
  }
  rows.push_back(place.row());
  rows.push_back(speed.row());
  if (way.size() > 1 && footing.holds())
    addEnd(recording, body, way.back().start, until, {name + ": its slip ends / s", kWay + late},
           rows);
}

}  // namespace

std::vector<ClaimRow> wayRows(const Scene& scene, const Recording& recording) {
  std::vector<ClaimRow> rows;
  for (int body = 0; body < static_cast<int>(scene.world.bodies.size()); ++body) {
    if (!moves(scene.world.bodies[body])) continue;
    const std::optional<Vec3> gravity = freeAcceleration(scene.world, body);
    if (!gravity || recording.samples.empty()) continue;
    const Footing footing = footingOf(scene, recording.samples.front(), body, *gravity);
    if (footing.ground == kNoBody || !footing.straight()) continue;
    addWay(scene, recording, body, footing, rows);
  }
  if (rows.empty()) return {emptyClaim("no body lies on a plane that stands still at the start")};
  return rows;
}

}  // namespace tumble
