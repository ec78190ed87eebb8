// Hard cases of forces: springs and dampers from soft to stiff, against their closed forms.
#include <algorithm>
#include <cstdio>

#include "tests/stability/hard_case.h"

namespace tumble::test {
namespace {

using namespace scenes;

constexpr double kRate = 240.0;  // [1/s] steps of `stepping`

/// A ball of 1 kg that swings by 0.1 m along a spring at whose end there is nothing but the world.
WorldDef swing(double stiffness, double damping, double t) {
  WorldDef def = worldOf("auto", t, {ball("ball", 0.05, {1.1, 0.0, 0.0})});
  def.gravity = Vec3::Zero();
  def.forces.push_back(Spring{.a = 0, .stiffness = stiffness, .damping = damping, .rest = 1.0});
  return def;
}

/// Over ten periods, the largest distance from x₀ cos ωt at ends of steps, in x₀.
double swings(double stiffness) {
  const double omega = std::sqrt(stiffness), t = 20.0 * std::numbers::pi / omega;
  World world(swing(stiffness, 0.0, t));
  double worst = 0.0;
  for (int k = 1; k <= 40; ++k) {
    const double now = std::floor(t * k / 40.0 * kRate) / kRate;
    world.advance(now);
    worst = std::max(
        worst,
        std::abs(world.sample(now).bodies[0].x.x() - 1.0 - 0.1 * std::cos(omega * now)) / 0.1);
  }
  return unlessStopped(world, worst);
}

/// In a second by the clock, the energy that it has above that of its start, as a share of it.
double energyGain(double stiffness) {
  World world(swing(stiffness, 0.0, 1.0));
  const double first = 0.5 * stiffness * 0.01;
  double gain = 0.0;
  for (int k = 1; k <= 60; ++k) {
    world.advance(k / 60.0);
    const Sample now = world.sample(k / 60.0);
    gain = std::max(gain, (now.kinetic + now.potential) / first - 1.0);
  }
  return unlessStopped(world, gain);
}

/// A ball of 1 kg and 1 m/s in air of so much drag: how far it comes in 1 s, (1 − e^{−c})/c.
double drag(double c) {
  BodyDef def = ball("ball", 0.05, Vec3::Zero());
  def.velocity = {1.0, 0.0, 0.0};
  WorldDef world = worldOf("auto", 1.0, {def});
  world.gravity = Vec3::Zero();
  world.forces.push_back(LinearDrag{.body = 0, .linear = c});
  const World ran = ranTo(world, 1.0);
  return unlessStopped(ran,
                       std::abs(ran.sample(1.0).bodies[0].x.x() / (-std::expm1(-c) / c) - 1.0));
}

/// A spring so much damped that it creeps: after 1 s, against the sum of its two exponentials, in
/// x₀.
double creeps(double damping) {
  const double k = 100.0, root = std::sqrt(0.25 * damping * damping - k);
  const double fast = -0.5 * damping - root, slow = k / fast;
  const World world = ranTo(swing(k, damping, 1.0), 1.0);
  const double due = 0.1 * (fast * std::exp(slow) - slow * std::exp(fast)) / (fast - slow);
  return unlessStopped(world, std::abs(world.sample(1.0).bodies[0].x.x() - 1.0 - due) / 0.1);
}

}  // namespace

std::vector<HardCase> hardForces() {
  std::vector<HardCase> cases;
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return std::string(text);
  };
  for (const double k : {1e-2, 1.0, 1e2, 1e4})
    cases.push_back({"spring of " + number(k) + " N/m, ten periods", "cosine", "1", 1e-9,
                     [=] { return swings(k); }});
  for (const double k : {1e6, 1e8, 1e10})
    cases.push_back({"spring of " + number(k) + " N/m: energy gained in 1 s", "none", "1", 1e-9,
                     [=] { return energyGain(k); }});
  for (const double c : {1e-3, 1.0, 1e3, 1e6})
    cases.push_back({"drag of " + number(c) + " N s/m, way in 1 s", "exponential", "1", 1e-9,
                     [=] { return drag(c); }});
  // Dampers that are too fast for a step are followed to first order, at the rate k/c of the creep.
  cases.push_back({"spring with a damper of 30 N s/m, after 1 s", "two exponentials", "1", 1e-9,
                   [] { return creeps(30.0); }});
  for (const double c : {1e3, 1e5})
    cases.push_back({"spring with a damper of " + number(c) + " N s/m, after 1 s", "to h k/c", "1",
                     100.0 / c / kRate, [=] { return creeps(c); }});
  return cases;
}

}  // namespace tumble::test
