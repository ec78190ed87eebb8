// Free flight: when a spin about the middle axis flips, and how much it accelerates any point.
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/flight/flight.h"
#include "sim/math/root.h"
#include "tests/catch.h"
#include "tests/flight/random_body.h"

using namespace tumble;
using namespace tumble::test;

namespace {

/// Zeros of ω₂ in the body, in order.
std::vector<double> flips(const RigidBody& start, int count) {
  const Flight flight(start, Vec3::Zero(), 0.0);
  RigidBody body = start;
  const auto along = [&](double t) {
    flight.at(t, body);
    return body.R.col(1).dot(body.omega);
  };
  std::vector<double> found;
  double t = 0.0, before = along(0.0);
  while (static_cast<int>(found.size()) < count) {
    const double now = along(t + 0.01);
    if ((before > 0.0) != (now > 0.0)) {
      const Bracket bracket = findRoot(along, t, t + 0.01, before, now, 1e-16 * t);
      found.push_back(0.5 * (bracket.lo + bracket.hi));
    }
    t += 0.01;
    before = now;
  }
  return found;
}

}  // namespace

// Oracle: closed form, 2K/(L s₃) in quadruple precision; moments 1, 2, 3, ω = (wobble, 10, wobble).
// Measured 6e-16, allowed 1e-9.
TEST_CASE("a spin about the middle axis flips when elliptic functions say", "[figures]") {
  const double wobbles[] = {1e-3, 1e-6, 1e-9};
  const double exact[] = {3.550725303965848, 5.943641957898780, 8.336558579788674};
  for (int i = 0; i < 3; ++i) {
    const RigidBody start = spinning({1, 2, 3}, Quat::Identity(), {wobbles[i], 10.0, wobbles[i]});
    const std::vector<double> times = flips(start, 101);
    const double first = (times[1] - times[0]) / exact[i] - 1.0;
    const double hundred = (times[100] - times[0]) / (100.0 * exact[i]) - 1.0;
    WARN("flip time, wobble " << wobbles[i] << " rad/s: error " << std::abs(first)
                              << " relative, of a hundred flips " << std::abs(hundred));
    CHECK(std::abs(first) < 1e-9);
    CHECK(std::abs(hundred) < 1e-9);
  }
}

// Oracle: the acceleration itself, g + ω̇ × r + ω × (ω × r), at many instants and points. The proof
// that it cannot be more is at `Polhode::turning`; where it comes close the bound is worth having.
TEST_CASE("no point of any body is accelerated by more than its flight allows") {
  Random random(3);
  const Vec3 gravity(0.0, -9.81, 0.0);
  double closest = 0.0;
  for (int n = 0; n < 300; ++n) {
    const RigidBody start = n % 3 ? randomBody(random)
                                  : spinning({1, 2, 3}, Quat::Identity(), random.vector(-9.0, 9.0));
    const double r = random.uniform(0.0, 2.0);
    const Flight flight(start, gravity, 0.0);
    const double bound = flight.accelBound(r),
                 alone = Flight(start, Vec3::Zero(), 0.0).accelBound(r);
    RigidBody body = start;
    double most = 0.0, turning = 0.0;
    for (int k = 0; k < 300; ++k) {
      flight.at(random.uniform(0.0, 20.0), body);
      const Vec3 p = r * random.vector(-1.0, 1.0).normalized();
      const Vec3 change = body.Iinv * body.L.cross(body.omega);
      const Vec3 a = change.cross(p) + body.omega.cross(body.omega.cross(p));
      most = std::max(most, (a + gravity).norm());
      turning = std::max(turning, a.norm());
    }
    CHECK(most <= bound);
    CHECK(turning <= alone);
    closest = std::max(closest, turning / alone);
  }
  CHECK(closest > 0.99);
}
