// Hard cases of what moves: rocking, jamming, endless bounces, tops that no formula in common
// functions knows.
#include <algorithm>
#include <limits>

#include "tests/gravity.h"
#include "tests/stability/hard_case.h"

namespace tumble::test {
namespace {

using namespace scenes;

/// Housner's block, 1 m × 4 m, lets go at a tilt: after the blow of its other foot it has r² of its
/// energy, r = 1 − 3/2 sin² α (Housner, The behavior of inverted pendulum structures during
/// earthquakes, 1963).
double housner() {
  const double b = 1.0, h = 4.0, tilt = 0.1, mu = 5.0;
  const double R = 0.5 * std::hypot(b, h), alpha = std::atan2(b, h),
               inertia = 4.0 / 3.0 * R * R;  // per mass
  const auto energy = [&](double angle, double rate) {
    return 0.5 * inertia * rate * rate +
           kG * R * (std::cos(alpha - std::abs(angle)) - std::cos(alpha));
  };
  const Quat turn = fromAxisAngle({0.0, 0.0, 1.0}, -tilt);
  BodyDef block = box("block", {b, h, b}, Vec3::Zero(), 0.0, mu);
  block.orientation = turn;
  block.position = Vec3(0.5 * b, 0.0, 0.0) + turn * Vec3(-0.5 * b, 0.5 * h, 0.0);
  const WorldDef def = worldOf("auto", 3.0, {ground(0.0, mu), block});
  World world(def);
  const double r = 1.0 - 1.5 * std::pow(std::sin(alpha), 2);
  for (double t = 0.05; t < 3.0; t += 0.05) {
    world.advance(t);
    const BodySample now = world.sample(t).bodies[1];
    const double angle = 2.0 * std::atan2(now.q.z(), now.q.w());
    if (angle > 0.01)  // it stands on its other foot
      return unlessStopped(world,
                           std::abs(energy(angle, now.omega.z()) / energy(tilt, 0.0) - r * r));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// The instant at which a ball that falls 1 m lies still: t₁ (1 + e)/(1 − e).
double zeno(double e) {
  const double fall = std::sqrt(2.0 / kG), end = fall * (1.0 + e) / (1.0 - e);
  const World world = ranTo(
      worldOf("auto", 1.1 * end, {ground(e), ball("ball", 0.1, {0.0, 1.1, 0.0}, e)}), 1.1 * end);
  for (const Event& event : world.report().events)
    if (event.kind == EventKind::Rest) return unlessStopped(world, std::abs(event.t - end) / end);
  return std::numeric_limits<double>::quiet_NaN();
}

/// Painlevé's rod: tan θ = 2, μ = 1.5, where no finite force holds the foot that slides ahead.
/// Energy may only fall.
double painleve(double direction) {
  const double lean = std::atan(2.0), length = 1.0, mu = 1.5;
  BodyDef rod = ball("rod", 0.01, Vec3::Zero(), 0.0, mu);
  rod.shape = Capsule{0.01, length};
  rod.orientation = fromAxisAngle({0.0, 0.0, 1.0}, lean - 0.5 * std::numbers::pi);
  rod.position = {0.0, 0.01 + 0.5 * length * std::sin(lean), 0.0};
  rod.velocity = {3.0 * direction, 0.0, 0.0};
  World world(worldOf("auto", 2.0, {ground(0.0, mu), rod}));
  double gain = 0.0, before = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= 100; ++k) {
    world.advance(0.02 * k);
    const Sample now = world.sample(0.02 * k);
    const double energy = now.kinetic + now.potential;
    gain = std::max(gain, energy - before);
    before = energy;
  }
  return unlessStopped(world, gain / 4.5);
}

/// Kovalevskaya's top, A = B = 2C with its centre of mass in the plane of A and B: her fourth
/// integral
///   |(ω₁ + i ω₂)² + c (γ₁ + i γ₂)|²,   c = m g l/C, γ the direction of gravity,
/// held at a point of the body's first axis.
double kovalevskaya() {
  const double m = 1.0, l = 0.5, C = 1.0, c = m * kG * l / C;
  BodyDef top = ball("top", 0.1, {l, 0.0, 0.0});
  top.mass = m;
  top.inertia = Vec3(2.0 * C, 2.0 * C - m * l * l, C - m * l * l);
  top.pivot_B = Vec3(-l, 0.0, 0.0);
  top.orientation = fromAxisAngle({1.0, 2.0, 3.0}, 0.7);
  top.position = top.orientation * Vec3(l, 0.0, 0.0);
  top.angularVelocity = {1.0, 2.0, 4.0};
  World world(worldOf("auto", 10.0, {top}));
  const auto integral = [&](const BodySample& now) {
    const Vec3 w = now.q.conjugate() * now.omega, g = now.q.conjugate() * Vec3(0.0, -1.0, 0.0);
    return std::pow(w.x() * w.x() - w.y() * w.y() + c * g.x(), 2) +
           std::pow(2.0 * w.x() * w.y() + c * g.y(), 2);
  };
  double worst = 0.0;
  const double first = integral(world.sample(0.0).bodies[0]);
  for (int k = 1; k <= 100; ++k) {
    world.advance(0.1 * k);
    worst = std::max(worst, std::abs(integral(world.sample(0.1 * k).bodies[0]) / first - 1.0));
  }
  return unlessStopped(world, worst);
}

/// A cube of 0.2 m at 1000 m/s against a plate of a tenth of a millimetre, 5 m off: the instant of
/// the hit.
double bullet() {
  BodyDef plate = box("plate", {2.0, 2.0, 1e-4}, Vec3::Zero());
  plate.fixed = true;
  BodyDef cube = box("cube", {0.2, 0.2, 0.2}, {0.0, 0.0, 5.0});
  cube.velocity = {0.0, 0.0, -1000.0};
  WorldDef def = worldOf("auto", 0.1, {plate, cube});
  def.gravity = Vec3::Zero();
  const World world = ranTo(def, 0.1);
  const double due = (5.0 - 0.1 - 0.5e-4) / 1000.0;
  if (world.report().events.empty()) return std::numeric_limits<double>::infinity();
  return unlessStopped(world, std::abs(world.report().events.front().t / due - 1.0));
}

}  // namespace

std::vector<HardCase> hardMotions() {
  return {
      {"Housner's block, energy after its first blow", "(1 − 3/2 sin² α)²", "1", 1e-9, housner},
      {"ball of e 0.5, when it lies still", "t₁ (1 + e)/(1 − e)", "1", 1e-9,
       [] { return zeno(0.5); }},
      {"ball of e 0.9, when it lies still", "the same", "1", 1e-9, [] { return zeno(0.9); }},
      {"ball of e 0.99, when it lies still", "the same", "1", 1e-9, [] { return zeno(0.99); }},
      {"Painlevé's rod, pushed ahead: energy gained", "none", "1", 1e-12,
       [] { return painleve(1.0); }},
      {"Painlevé's rod, pulled behind: energy gained", "none", "1", 1e-12,
       [] { return painleve(-1.0); }},
      {"Kovalevskaya's top, her integral over 10 s", "constant", "1", 1e-9, kovalevskaya},
      {"cube of 1000 m/s on a plate of 0.1 mm, instant", "way over speed", "1", 1e-12, bullet},
  };
}

}  // namespace tumble::test
