// What lies, slides or rolls on a plane that stands still: Coulomb's law, tan θ = μ.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "app/claim/free_body.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

constexpr double kStill = 1e-9;  // [m/s] slower than this nothing slides

// Allowed errors [m/s²], [s], [m/s]; measured 1e-10, 8e-11, 8e-15, and 4e-12 m/s in steps.
constexpr double kAcceleration = 1e-9, kInstant = 1e-9, kSpeed = 1e-9;

// Velocities of this method change once in so many seconds, and events end there.
double grain(const Scene& scene) {
  return scene.world.method == "stepping" ? scene.world.stepping.step : 0.0;
}

/// A body that one plane carries, at one sample.
struct Footing {
  int ground = kNoBody;      ///< the body below it; none: it touches none, several, a moving one
  Vec3 n = Vec3::UnitY();    ///< [1] out of the ground
  Vec3 slip = Vec3::Zero();  ///< [m/s] of the points that touch
  Vec3 downhill = Vec3::Zero();  ///< [m/s²] gravity along the plane
  double into = 0.0;             ///< [m/s²] gravity into the plane
  double mu = 0.0;
  double mobility = 1.0;  ///< 1 + m r²/I of a ball: so much faster does friction change its slip

  bool slides() const { return slip.norm() > kStill; }
  bool holds() const { return downhill.norm() <= mu * into * mobility; }
  double degrees() const { return std::atan2(downhill.norm(), into) * 180.0 / EIGEN_PI; }
  /// Slip keeps its direction only along the steepest line, or where the plane is level.
  bool straight() const {
    return slip.cross(downhill).norm() <= kStill * (slip.norm() + downhill.norm());
  }
  /// Of the centre of mass [m/s²]: g sin θ less μ g cos θ against the slip; stuck, a block rests
  /// and a ball rolls with g sin θ/(1 + I/(m r²)).
  Vec3 acceleration() const {
    if (slides()) return downhill - mu * into * slip.normalized();
    if (!holds()) return downhill - mu * into * downhill.normalized();
    return downhill * (mobility - 1.0) / mobility;
  }
  /// Until a slip that slows down has ended [s].
  double stops() const {
    const double rate = mu * into * mobility - downhill.dot(slip.normalized());
    return rate > 0.0 ? slip.norm() / rate : std::numeric_limits<double>::infinity();
  }
};

bool standsStill(const BodyDef& body) {
  return !moves(body) && body.velocity.isZero() && body.angularVelocity.isZero();
}

Footing footingOf(const Scene& scene, const Sample& sample, int body, const Vec3& gravity) {
  const BodyDef& def = scene.world.bodies[body];
  const BodySample& seen = sample.bodies[body];
  Footing footing;
  for (const ContactSample& contact : sample.contacts) {
    if (contact.a != body && contact.b != body) continue;
    const int other = contact.a == body ? contact.b : contact.a;
    const Vec3 n = contact.a == body ? contact.n : Vec3(-contact.n);
    const bool second = footing.ground != kNoBody &&
                        (footing.ground != other || footing.n.cross(n).norm() > kStill);
    if (second || !standsStill(scene.world.bodies[other])) return {};
    footing.ground = other;
    footing.n = n;
  }
  const Sphere* ball = std::get_if<Sphere>(&def.shape);
  if (footing.ground == kNoBody || (!ball && seen.omega.norm() > kStill)) return {};
  footing.into = -gravity.dot(footing.n);
  footing.downhill = gravity + footing.into * footing.n;
  footing.mu = surfaceOf(scene.world, body, footing.ground).friction;
  footing.slip = seen.v;
  if (ball) {
    footing.slip -= ball->r * seen.omega.cross(footing.n);
    const MassProperties mass = massOf(def);
    footing.mobility = 1.0 + mass.mass * ball->r * ball->r / mass.inertia(0, 0);
  }
  footing.slip -= footing.n * footing.n.dot(footing.slip);
  return footing;
}

/// The first event of a body after an instant; without one, at infinity.
Event nextEvent(const Recording& recording, int body, double t) {
  for (const Event& event : recording.report.events)
    if (event.t > t && (event.a == body || event.b == body)) return event;
  Event never;
  never.t = std::numeric_limits<double>::infinity();
  return never;
}

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
    Footing stuck = footing;
    stuck.slip.setZero();
    const Vec3 then = now.bodies[body].v + footing.acceleration() * footing.stops();
    const Vec3 seen = after->bodies[body].v - stuck.acceleration() * (after->t - told);
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
