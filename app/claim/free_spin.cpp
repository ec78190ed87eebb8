// Free rotation: attitude, energy and angular momentum of every body that no torque acts on.
#include <algorithm>
#include <cmath>

#include "app/claim/free_body.h"
#include "app/claim/free_rotor.h"
#include "app/claim/rows.h"
#include "app/claim/spinner.h"

namespace tumble {

namespace {

// What is allowed to a method that takes steps, and to one that does not.
struct Allowed {
  double attitude, energy, momentum;  // [rad], relative, relative
};
constexpr Allowed kStepped{1e-3, 1e-6, 1e-9}, kExact{1e-9, 1e-12, 1e-12};

// The body alone, in closed form.
World alone(const Scene& scene, const Spinner& spinner) {
  WorldDef def = aloneOf(scene, spinner.body);
  def.method = "exact";
  def.gravity = spinner.acceleration;
  World world(def);
  world.advance(def.duration);
  return world;
}

void seeAgainstFlight(const Scene& scene, const Recording& recording, const Spinner& spinner,
                      WorstRow& worst) {
  const World exact = alone(scene, spinner);
  for (const Sample& sample : recording.samples) {
    if (sample.t > spinner.end) break;
    const BodySample told = exact.sample(sample.t).bodies[0];
    const double error = angleBetween(sample.bodies[spinner.body].q, told.q);
    worst.see(error, 0.0, error);
  }
}

// A run in closed form is held to the equation of motion itself: from each sample, small steps must
// lead to the next. Their own error, (|ω| h)⁴ of the angle, is far below what is allowed.
void seeStepByStep(const Recording& recording, const Spinner& spinner, WorstRow& worst) {
  constexpr double kSteps = 4e6;      // of all intervals together
  constexpr std::size_t kMost = 400;  // intervals a body
  const std::vector<Sample>& samples = recording.samples;
  const Mat3 inverse = spinner.inertia.inverse();
  const double each = 1.0 + spinner.fastest() / recording.rate / FreeRotor::kTurn;  // steps
  const std::size_t most =
      std::clamp(static_cast<std::size_t>(kSteps / each), std::size_t{1}, kMost);
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / most);
  for (std::size_t k = 0; k + 1 < samples.size(); k += stride) {
    const double h = samples[k + 1].t - samples[k].t;
    if (samples[k + 1].t > spinner.end) break;
    const BodySample& from = samples[k].bodies[spinner.body];
    FreeRotor rotor{inverse, spinner.momentum(from), from.q};
    rotor.advance(h, spinner.fastest());
    const double error = angleBetween(rotor.q, samples[k + 1].bodies[spinner.body].q);
    worst.see(error, 0.0, error);
  }
}

void addConserved(const Scene& scene, const Recording& recording, const Spinner& spinner,
                  const Allowed& allowed, std::vector<ClaimRow>& rows) {
  const std::string& name = scene.world.bodies[spinner.body].name;
  const double rounding = spinRounding(spinner.inertia);
  WorstRow energy(name + ": energy of rotation / J", std::max(allowed.energy, rounding));
  WorstRow momentum(name + ": |L| / (kg m²/s)", std::max(allowed.momentum, rounding));
  const BodyDef& def = scene.world.bodies[spinner.body];
  const double start = 0.5 * def.angularVelocity.dot(spinner.L), L = spinner.L.norm();
  for (const Sample& sample : recording.samples) {
    if (sample.t > spinner.end) break;
    const BodySample& seen = sample.bodies[spinner.body];
    const Vec3 now = spinner.momentum(seen);
    const double rotation = 0.5 * seen.omega.dot(now);
    energy.see(rotation, start, std::abs(rotation - start) / start);
    momentum.see(now.norm(), L, (now - spinner.L).norm() / L);
  }
  rows.push_back(energy.row());
  rows.push_back(momentum.row());
}

}  // namespace

std::vector<ClaimRow> freeSpinRows(const Scene& scene, const Recording& recording) {
  const bool exact = scene.world.method == "exact";
  const Allowed& allowed = exact ? kExact : kStepped;
  std::vector<ClaimRow> rows;
  for (const Spinner& spinner : spinnersOf(scene, recording)) {
    const std::string& name = scene.world.bodies[spinner.body].name;
    if (exact && !spinner.canBeFollowed(recording)) {
      rows.push_back(spinner.lost(name));
      continue;
    }
    const double angle = 1.0 + spinner.fastest() / recording.rate;  // [rad] between samples
    WorstRow attitude(
        name + (exact ? ": attitude from sample to sample / rad" : ": attitude / rad"),
        std::max(allowed.attitude, spinRounding(spinner.inertia) * angle));
    if (exact)
      seeStepByStep(recording, spinner, attitude);
    else
      seeAgainstFlight(scene, recording, spinner, attitude);
    rows.push_back(attitude.row());
    addConserved(scene, recording, spinner, allowed, rows);
  }
  if (rows.empty()) rows.push_back(emptyClaim("no body turns free of torque"));
  return rows;
}

}  // namespace tumble
