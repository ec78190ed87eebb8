// Heavy tops: attitude, energy, angular momentum and the point that holds them.
#include <algorithm>
#include <cmath>

#include "app/claim/free_body.h"
#include "app/claim/free_rotor.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

// What is allowed to a method that takes steps, and to one that does not.
struct Allowed {
  double attitude, conserved, place;  // [rad], relative, [m]
};
constexpr Allowed kStepped{1e-3, 1e-6, 1e-9}, kExact{1e-9, 1e-12, 1e-12};

/// A body that turns about one of its points under gravity alone.
struct Top {
  int body = 0;
  double mass = 0.0;                ///< [kg]
  Vec3 gravity = Vec3::Zero();      ///< [m/s²]
  Vec3 c_B = Vec3::Zero();          ///< [m] the point that is held, from the centre of mass
  Vec3 p = Vec3::Zero();            ///< [m] where it is held
  Mat3 inertia = Mat3::Identity();  ///< [kg m²] about that point, body frame
  double end = 0.0;                 ///< [s] of the first event that it takes part in, or of the run

  /// H [kg m²/s] about the point that is held.
  Vec3 momentum(const BodySample& seen) const {
    return angularMomentum(inertia, seen.q, seen.omega);
  }
  double energy(const BodySample& seen) const {  ///< [J] 0 with the centre of mass at p, at rest
    return 0.5 * seen.omega.dot(momentum(seen)) + mass * gravity.dot(seen.q * c_B);
  }
  double weightEnergy() const { return mass * gravity.norm() * c_B.norm(); }  ///< [J]
};

std::vector<Top> topsOf(const Scene& scene, const Recording& recording) {
  std::vector<Top> tops;
  for (int body = 0; body < static_cast<int>(scene.world.bodies.size()); ++body) {
    const BodyDef& def = scene.world.bodies[body];
    if (!moves(def) || !def.pivot_B) continue;
    if (freeAcceleration(scene.world, body) != scene.world.gravity) continue;
    const MassProperties mass = massOf(def);
    const Vec3 c = *def.pivot_B;
    const Mat3 shift = c.squaredNorm() * Mat3::Identity() - c * c.transpose();
    Top top{body,
            mass.mass,
            scene.world.gravity,
            c,
            def.position + def.orientation * c,
            mass.inertia + mass.mass * shift,
            untouchedUntil(scene, recording, body)};
    tops.push_back(top);
  }
  return tops;
}

// The most [rad/s] that the top can come to turn with.
double fastest(const Top& top, const BodySample& start) {
  const double kinetic = 0.5 * start.omega.dot(top.momentum(start));
  const double least = 1.0 / top.inertia.inverse().norm();
  return std::sqrt(2.0 * (kinetic + 2.0 * top.weightEnergy()) / least);
}

// The top alone, by another way than the scene's: the exact method, and against that the course
// with series of order 20.
World otherWay(const Scene& scene, const Top& top, double rate) {
  constexpr double kTurn = 0.5;  // [rad] a step: small enough for order 20, and few roundings
  WorldDef def = aloneOf(scene, top.body);
  def.method = scene.world.method == "exact" ? "course" : "exact";
  def.course = CourseSettings{.integrator = "taylor", .order = 20};
  if (rate > 0.0) def.course.step = std::min(def.course.step, kTurn / rate);
  return World(def);
}

void seeAttitude(const Scene& scene, const Recording& recording, const Top& top, WorstRow& worst) {
  constexpr double kLongest = 1e5;  // [rad] that are followed
  const double rate = fastest(top, recording.samples.front().bodies[top.body]);
  World other = otherWay(scene, top, rate);
  for (const Sample& sample : recording.samples) {
    if (sample.t > top.end || rate * sample.t > kLongest) break;
    other.advance(sample.t);
    const double error =
        angleBetween(sample.bodies[top.body].q, other.sample(sample.t).bodies[0].q);
    worst.see(error, 0.0, error);
  }
}

void addKept(const Recording& recording, const Top& top, const std::string& name, double relative,
             double away_m, std::vector<ClaimRow>& rows) {
  WorstRow energy(name + ": energy / J", relative);
  WorstRow momentum(name + ": angular momentum along gravity / (kg m²/s)", relative);
  WorstRow place(name + ": way of the point that is held / m, beside its place", away_m);
  const BodySample& start = recording.samples.front().bodies[top.body];
  const Vec3 down = top.gravity.normalized();  // without gravity zero
  const double E = top.energy(start), H = top.momentum(start).dot(down);
  const double energyScale = std::abs(E) + top.weightEnergy();
  const double momentumScale =
      std::max(top.momentum(start).norm(), std::sqrt(top.inertia.trace() * energyScale));
  for (const Sample& sample : recording.samples) {
    if (sample.t > top.end) break;
    const BodySample& seen = sample.bodies[top.body];
    energy.see(top.energy(seen), E, std::abs(top.energy(seen) - E) / energyScale);
    const double now = top.momentum(seen).dot(down);
    momentum.see(now, H, std::abs(now - H) / momentumScale);
    const double away = (seen.x + seen.q * top.c_B - top.p).norm();
    place.see(away, 0.0, away / std::max(1.0, top.p.norm()));
  }
  for (const WorstRow* row : {&energy, &momentum, &place}) rows.push_back(row->row());
}

}  // namespace

std::vector<ClaimRow> topRows(const Scene& scene, const Recording& recording) {
  const bool exact = scene.world.method == "exact";
  const Allowed& allowed = exact ? kExact : kStepped;
  std::vector<ClaimRow> rows;
  for (const Top& top : topsOf(scene, recording)) {
    const std::string& name = scene.world.bodies[top.body].name;
    const double rounding = spinRounding(top.inertia);
    const double turned =
        1.0 + fastest(top, recording.samples.front().bodies[top.body]) * scene.world.duration;
    WorstRow attitude(name + ": attitude / rad", std::max(allowed.attitude, rounding * turned));
    seeAttitude(scene, recording, top, attitude);
    rows.push_back(attitude.row());
    addKept(recording, top, name, std::max(allowed.conserved, rounding), allowed.place, rows);
  }
  if (rows.empty())
    rows.push_back(emptyClaim("no body turns about a held point under gravity alone"));
  return rows;
}

}  // namespace tumble
