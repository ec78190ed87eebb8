// The heavy top against the textbook, and against the black box.
#include "sim/flight/top.h"

#include <cmath>

#include "sim/body/body_system.h"
#include "sim/ode/integrator.h"
#include "tests/catch.h"
#include "tests/flight/held.h"

using namespace tumble;
using namespace tumble::test;

// Oracle: closed form,  I₁ cos θ Ω² − I₃ ω₃ Ω + M g l = 0  (Landau and Lifshitz, Mechanics, §35):
// a slow and a fast steady precession. Measured 2e-17 and 2.4e-15 relative, allowed 1e-9.
TEST_CASE("a top precesses steadily at the slow rate and at the fast one", "[figures]") {
  for (const double rate : {2.012633679076934460, 77.98736632092306554}) {
    const Held start = precessing(100.0, rate);
    HeavyTop top(start.body, start.pivot, kGravity, 0.0);
    // After a whole number of turns about the vertical the axis is back where it was.
    const double turns = std::round(10.0 * rate / 6.283185307179586);
    const double t = turns * 6.283185307179586 / rate;
    REQUIRE(top.reach(t));
    const Vec3 before = start.body.q * Vec3::UnitY(), after = top.pose(t).q * Vec3::UnitY();
    const double azimuth = std::atan2(before.z() * after.x() - before.x() * after.z(),
                                      before.x() * after.x() + before.z() * after.z());
    const double error = std::abs(azimuth) / (rate * t);
    WARN("precession at " << rate << " rad/s: off by " << error << " relative, height "
                          << after.y() - before.y());
    CHECK(error < 1e-9);
    CHECK(std::abs(after.y() - before.y()) < 1e-9);
  }
}

// Oracle: closed form. An upright top sleeps if  ω₃ > 2 √(M g l I₁)/I₃ = 44.2944691807 rad/s: a
// small lean p that is left to precess at I₃ ω₃/(2 I₁) goes as p cosh σt below, p cos |σ|t above,
//   σ² = (M g l)/I₁ − (I₃ ω₃/(2 I₁))²,
// linear in ω₃². Two spins, 0.1 % below and above, show σ²; the line through them crosses zero at
// the threshold. Measured 2.5e-11 relative, allowed 1e-9.
TEST_CASE("a top sleeps above its threshold and wakes below it", "[figures]") {
  constexpr double kLean = 1e-5, kTime = 2.0;  // [rad], [s]
  const double threshold = 2.0 * std::sqrt(1.0 * 9.81 * 0.1 * 0.0125) / 0.005;
  CHECK(std::abs(threshold - 44.2944691807) < 1e-10);
  const auto squaredRate = [&](double spin) {
    const Quat q = fromAxisAngle({0.0, 0.0, -1.0}, kLean);
    const Vec3 axis = q * Vec3::UnitY();
    const double rate = 0.005 * spin / (2.0 * 0.0125);
    const Held start =
        held(disc(), q, {0.0, -0.1, 0.0}, rate * Vec3::UnitY() + (spin - rate * axis.y()) * axis);
    HeavyTop top(start.body, start.pivot, kGravity, 0.0);
    REQUIRE(top.reach(kTime));
    const Vec3 now = top.pose(kTime).q * Vec3::UnitY();
    const double grown = std::hypot(now.x(), now.z()) / std::hypot(axis.x(), axis.z());
    const double angle = (grown > 1.0 ? std::acosh(grown) : std::acos(grown)) / kTime;
    return grown > 1.0 ? angle * angle : -angle * angle;
  };
  const double low = 0.999 * threshold, high = 1.001 * threshold;
  const double wakes = squaredRate(low), sleeps = squaredRate(high);
  CHECK(wakes > 0.0);
  CHECK(sleeps < 0.0);
  const double zero = std::sqrt(low * low + (high * high - low * low) * wakes / (wakes - sleeps));
  WARN("an upright top sleeps above " << zero << " rad/s: off by "
                                      << std::abs(zero / threshold - 1.0) << " relative");
  CHECK(std::abs(zero / threshold - 1.0) < 1e-9);
}

// Oracle: two independent methods. Measured 1.6e-9, of the adaptive row; allowed 4e-8.
TEST_CASE("the arcs of a top follow what the black box integrates") {
  const Quat q = fromAxisAngle({0.2, 0.1, 1.0}, 0.9);
  const Held start = held(tumblingBrick(), q, {0.05, -0.3, 0.02}, Vec3(2.0, -1.0, 3.0));
  const BodySystem system(kGravity, {}, {start.body}, {start.pivot});
  std::vector<double> y(kStateSize);
  system.toArray(y);
  findIntegrator("dopri5")->make(kStateSize)->step(system, 0.0, 3.0, y);
  HeavyTop top(start.body, start.pivot, kGravity, 0.0);
  REQUIRE(top.reach(3.0));
  RigidBody arc = start.body, box = start.body;
  top.at(3.0, arc);
  arrayToState(y, box);
  CHECK((arc.q.conjugate() * box.q).vec().norm() < 4e-8);
  CHECK((arc.x - box.x).norm() < 4e-8);
  CHECK((arc.P - box.P).norm() < 4e-7);
  CHECK((toWorld(arc.pose(), start.pivot.c_B) - start.pivot.p).norm() < 1e-15);
}

// Oracle: bit equality; where an arc begins does not depend on what was asked for.
TEST_CASE("a top does not care when it is looked at, nor what it has forgotten") {
  const Held start = precessing(60.0, 3.0);
  HeavyTop once(start.body, start.pivot, kGravity, 0.5), often = once;
  REQUIRE(once.reach(4.0));
  for (double t = 0.5; t <= 4.0; t += 0.1) {
    often.reach(t);
    often.forget(t - 0.3);
  }
  often.reach(4.0);
  CHECK(once.pose(3.9).q.coeffs() == often.pose(3.9).q.coeffs());
  CHECK(often.arcs() < once.arcs());
  CHECK((once.pose(0.5).q.coeffs() - start.body.q.coeffs()).norm() < 1e-15);
}

// Oracle: bound, by second differences of the farthest point of the disc's rim.
TEST_CASE("no point of a top accelerates beyond its bound") {
  const Held start = precessing(30.0, 4.0);
  HeavyTop top(start.body, start.pivot, kGravity, 0.0);
  REQUIRE(top.reach(2.1));
  const double h = 1e-4;
  double most = 0.0;
  for (double t = h; t < 2.0; t += 0.003) {
    const Vec3 rim(0.1, 0.0, 0.0);
    const Vec3 a = (toWorld(top.pose(t + h), rim) - 2.0 * toWorld(top.pose(t), rim) +
                    toWorld(top.pose(t - h), rim)) /
                   (h * h);
    most = std::max(most, a.norm());
  }
  CHECK(most <= top.accelBound(0.1));
  CHECK(most > 0.1 * top.accelBound(0.1));
}
