// Bouncing without spin: apexes and the time to rest.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/claim/fall.h"
#include "app/claim/free_body.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

constexpr double kSmallApex = 1e-3;  // [m] below this apexes are compared absolutely
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Event> eventsOf(const Recording& recording, const Fall& fall, EventKind kind) {
  std::vector<Event> events;
  for (const Event& event : recording.report.events) {
    const bool pair = (event.a == fall.body && event.b == fall.floor) ||
                      (event.b == fall.body && event.a == fall.floor);
    if (pair && event.kind == kind) events.push_back(event);
  }
  return events;
}

void seeApex(WorstRow& worst, double measured, double exact) {
  worst.see(measured, exact, std::abs(measured - exact) / std::max(exact, kSmallApex));
}

// Apexes that the impulses promise: after the n-th hit the speed is vrel + j/m, whatever the law
// says.
void seeImpulses(const Fall& fall, const Recording& recording, double mass, double duration,
                 WorstRow& worst) {
  const std::vector<Event> hits = eventsOf(recording, fall, EventKind::Impact);
  for (int n = 1; fall.apexTime(n) <= duration; ++n) {
    if (n > 1 && fall.apex(n) < kSmallApex) break;
    if (n > static_cast<int>(hits.size())) {
      seeApex(worst, kInfinity, fall.apex(n));
      return;
    }
    const double leaving = std::max(0.0, hits[n - 1].vrel + hits[n - 1].j / mass);
    seeApex(worst, leaving * leaving / (2.0 * fall.g), fall.apex(n));
  }
}

// Apexes that the samples promise: height + v²/(2 g) is the same all along an arc.
void seeSamples(const Fall& fall, const Scene& scene, const Recording& recording, WorstRow& worst) {
  const BodyDef& body = scene.world.bodies[fall.body];
  const std::vector<Event> hits = eventsOf(recording, fall, EventKind::Impact);
  const double start = fall.normal.dot(body.position);
  for (const Sample& sample : recording.samples) {
    int n = 0;
    while (n < static_cast<int>(hits.size()) && hits[n].t <= sample.t) ++n;
    if (fall.apex(n) < kSmallApex) continue;
    const double h = fall.height + fall.normal.dot(sample.bodies[fall.body].x) - start;
    const double v = fall.normal.dot(sample.bodies[fall.body].v);
    seeApex(worst, h + v * v / (2.0 * fall.g), fall.apex(n));
  }
}

}  // namespace

std::vector<ClaimRow> bounceApexRows(const Scene& scene, const Recording& recording) {
  std::vector<ClaimRow> rows;
  for (const Fall& fall : fallsOf(scene)) {
    WorstRow worst(scene.world.bodies[fall.body].name + ": worst apex / m", 1e-6);
    const double mass = bodyMass(scene.world.bodies[fall.body]);
    seeImpulses(fall, recording, mass, scene.world.duration, worst);
    seeSamples(fall, scene, recording, worst);
    rows.push_back(worst.row());
  }
  if (rows.empty()) rows.push_back(emptyClaim("no body falls onto a floor without spin"));
  return rows;
}

std::vector<Curve> bouncePaths(const Scene& scene, const Recording&) {
  constexpr int kPointsPerSecond = 240;
  std::vector<Curve> curves;
  for (const Fall& fall : fallsOf(scene)) {
    const BodyDef& body = scene.world.bodies[fall.body];
    // Friction bends the path sideways; then only the height is known.
    if (fall.rubs()) continue;
    Curve curve{fall.body, {}};
    const int count = static_cast<int>(scene.world.duration * kPointsPerSecond);
    for (int k = 0; k <= count; ++k) {
      const double t = static_cast<double>(k) / kPointsPerSecond;
      curve.points.push_back(body.position + fall.glide * t + 0.5 * t * t * fall.glideAcceleration +
                             (fall.heightAt(t) - fall.height) * fall.normal);
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

namespace {

// The impact nearest to each true one; nothing for methods whose contacts are no impacts.
void addHitTimes(const Scene& scene, const Recording& recording, const Fall& fall,
                 std::vector<ClaimRow>& rows) {
  const std::vector<Event> hits = eventsOf(recording, fall, EventKind::Impact);
  if (hits.empty()) return;
  WorstRow worst(scene.world.bodies[fall.body].name + ": worst instant of a hit / s", 1e-8);
  for (int n = 1; fall.hitTime(n) < scene.world.duration && fall.apex(n - 1) >= kSmallApex; ++n) {
    const double exact = fall.hitTime(n);
    const auto near =
        std::min_element(hits.begin(), hits.end(), [&](const Event& one, const Event& other) {
          return std::abs(one.t - exact) < std::abs(other.t - exact);
        });
    worst.see(near->t, exact, std::abs(near->t - exact));
  }
  rows.push_back(worst.row());
}

}  // namespace

std::vector<ClaimRow> bouncingRows(const Scene& scene, const Recording& recording) {
  std::vector<ClaimRow> rows;
  for (const Fall& fall : fallsOf(scene)) {
    const BodyDef& body = scene.world.bodies[fall.body];
    WorstRow worst(body.name + ": worst height, of the first", 1e-8);
    double height = 0.0, speed = 0.0;
    for (const Sample& sample : recording.samples) {
      const BodySample& now = sample.bodies[fall.body];
      height = fall.height + fall.normal.dot(now.x - body.position);
      speed = fall.normal.dot(now.v);
      const double exact = fall.heightAt(sample.t);
      worst.see(height, exact, std::abs(height - exact) / fall.apex(0));
    }
    rows.push_back(worst.row());

    // The energy at the end, as the height that it reaches.
    double exact = 0.0;
    if (const double end = scene.world.duration; end < fall.restTime()) {
      int n = 0;
      while (fall.hitTime(n + 1) <= end) ++n;
      exact = fall.apex(n) / fall.apex(0);
    }
    const double energy = (height + speed * speed / (2.0 * fall.g)) / fall.apex(0);
    rows.push_back({body.name + ": energy at the end, of the first", energy, exact,
                    std::abs(energy - exact), 1e-8});
    addHitTimes(scene, recording, fall, rows);
  }
  if (rows.empty()) rows.push_back(emptyClaim("no body falls onto a floor without spin"));
  return rows;
}

std::vector<ClaimRow> restTimeRows(const Scene& scene, const Recording& recording) {
  std::vector<ClaimRow> rows;
  for (const Fall& fall : fallsOf(scene)) {
    const std::string name = scene.world.bodies[fall.body].name;
    const std::vector<Event> rests = eventsOf(recording, fall, EventKind::Rest);
    const std::vector<Event> hits = eventsOf(recording, fall, EventKind::Impact);
    const double exact = fall.restTime();
    if (fall.firstHit() >= scene.world.duration) continue;  // in the air to the end
    // A contact that lasts is found while the last bounces are below what a hit can tell: the time
    // that these would still take grows as 1/(1 − e).
    const double allowed = fall.e <= 0.8 ? 1e-3 : 2e-4 / (1.0 - fall.e);
    if (exact > scene.world.duration) {
      if (exact - scene.world.duration < allowed) continue;
      const double count = static_cast<double>(rests.size());
      rows.push_back({name + ": comings to rest before the end", count, 0.0, count, 0.0});
      continue;
    }
    const bool forGood = !rests.empty() && (hits.empty() || hits.back().t <= rests.back().t);
    const double measured = forGood ? rests.back().t : kInfinity;
    rows.push_back({name + ": rests at / s", measured, exact, std::abs(measured - exact), allowed});
  }
  if (rows.empty())
    rows.push_back(emptyClaim("no body falls onto a floor without spin before the end"));
  return rows;
}

}  // namespace tumble
