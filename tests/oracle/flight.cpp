// How exact free flight is, against quadruple precision: thousands of unlike bodies, and sweeps
// through every limit.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/flight/flight.h"
#include "tests/catch.h"
#include "tests/flight/random_body.h"
#include "tests/oracle/theta_reference.h"

using namespace tumble;
using namespace tumble::test;

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kTime = 10.0;

/// Error of the attitude after 10 s, in units of ε|ω|T.
double error(const RigidBody& start) {
  const Quat q = Flight(start, Vec3::Zero(), 0.0).pose(kTime).q;
  const auto exact = ThetaTop(freeTop<Quad>(start)).attitude(Quad(kTime));
  return angleTo(exact, q) / (kEpsilon * start.omega.norm() * kTime);
}

/// The floor of the error, in the same units: what half a unit in the last place of every number of
/// the start changes, and ε, what rounding the attitude itself may.
double conditioning(const RigidBody& start, Random& random) {
  const FreeTop<Quad> top = freeTop<Quad>(start);
  const auto exact = ThetaTop(top).attitude(Quad(kTime));
  double most = kEpsilon;
  for (int n = 0; n < 3; ++n) {
    FreeTop<Quad> other = top;
    for (Quad& I : other.I) I *= 1 + Quad(random.uniform(0, 1) < 0.5 ? -0.5 : 0.5) * kEpsilon;
    for (Quad& L : other.L) L *= 1 + Quad(random.uniform(0, 1) < 0.5 ? -0.5 : 0.5) * kEpsilon;
    const auto q = ThetaTop(other).attitude(Quad(kTime));
    Quad square = 0;
    for (int i = 0; i < 4; ++i) square += (q[i] - exact[i]) * (q[i] - exact[i]);
    most = std::max(most, 2.0 * static_cast<double>(sqrt(square)));
  }
  return most / (kEpsilon * start.omega.norm() * kTime);
}

void compareRandomBodies(int count) {
  Random random(42);
  std::vector<double> errors;
  double worst = 0.0;
  for (int n = 0; n < count; ++n) {
    const RigidBody start = randomBody(random);
    errors.push_back(error(start));
    worst = std::max(worst, errors.back() / conditioning(start, random));
    REQUIRE(std::isfinite(errors.back()));
  }
  std::sort(errors.begin(), errors.end());
  const double median = errors[count / 2], percentile = errors[count * 99 / 100];
  WARN(count << " random bodies, 10 s, in eps |omega| T: median " << median << ", 99 % "
             << percentile << ", most " << errors.back() << "; at most " << worst
             << " times the conditioning floor");
  CHECK(median < 2.0);
  CHECK(percentile < 20.0);
  CHECK(worst < 100.0);
}

/// The greatest error over a sweep, in units of ε|ω|T.
struct Sweep {
  double most = 0.0;
  int points = 0;
  void add(const RigidBody& start) {
    const double now = error(start);
    INFO("moments " << start.Ibody.diagonal().transpose() << ", L " << start.L.transpose());
    REQUIRE(std::isfinite(now));
    most = std::max(most, now);
    ++points;
  }
};

}  // namespace

// Oracle: Taylor series in quadruple precision. Measured 1e-30, allowed 1e-27.
TEST_CASE("the theta functions of the literature solve Euler's equations") {
  Random random(7);
  for (int n = 0; n < 6; ++n) {
    Vec3 moments(random.uniform(1, 2), random.uniform(2, 3), random.uniform(3, 4));
    std::swap(moments[n % 3], moments[n / 2]);
    const RigidBody start = spinning(moments, tumblingBrick().q, random.vector(-5.0, 5.0));
    const auto exact = taylorFlight(freeTop<Quad>(start), Quad(2)).q;
    const auto theta = ThetaTop(freeTop<Quad>(start)).attitude(Quad(2));
    Quad same = 0, square = 0;
    for (int i = 0; i < 4; ++i) same += exact[i] * theta[i];
    for (int i = 0; i < 4; ++i) {
      const Quad difference = exact[i] - (same < 0 ? -theta[i] : theta[i]);
      square += difference * difference;
    }
    CHECK(static_cast<double>(sqrt(square)) < 1e-27);
  }
}

// Oracle: Taylor series in quadruple precision. Measured 1.1e-14 rad (ε|ω|T is 2.2e-14), allowed
// 2e-13.
TEST_CASE("a brick that flips about its middle axis is where it should be after 10 s",
          "[figures]") {
  const RigidBody start = spinning(solidMass(Box{{0.05, 0.1, 0.15}}, 1.0).inertia.diagonal(),
                                   fromAxisAngle({1.0, 2.0, -0.5}, 0.8), {1e-3, 10.0, 0.0});
  const Flight flight(start, Vec3::Zero(), 0.0);
  FreeTop<Quad> reference = freeTop<Quad>(start);
  double angle = 0.0;
  for (int n = 1; n <= 20; ++n) {
    reference = taylorFlight(reference, Quad(0.5));
    angle = std::max(angle, angleTo(reference.q, flight.pose(0.5 * n).q));
  }
  WARN("flipping brick, 10 s: attitude error " << angle << " rad");
  CHECK(angle < 2e-13);
}

// Oracle: quadruple precision. Measured median 0.6 ε|ω|T, 99 % 2.5; allowed 2 and 20.
TEST_CASE("random bodies are where they should be, to a few roundings of their angle") {
  compareRandomBodies(200);
}

TEST_CASE("ten thousand random bodies are, too", "[long][figures]") {
  compareRandomBodies(10000);
}

// Oracle: quadruple precision. No step: the error by a limit is that of any other body.
// Measured 2.0, 2.1 and 3.6 ε|ω|T in the three sweeps, allowed 6.
TEST_CASE("the error has no step as a wobble vanishes", "[figures]") {
  Sweep sweep;
  for (int axis = 0; axis < 3; ++axis) {
    for (double wobble = 0.1; wobble > 0.9e-17; wobble *= 0.31622776601683794) {
      for (const Vec3& side : {Vec3(1, 1, 1), Vec3(-1, 1, 0.3), Vec3(0.2, 1, -1)}) {
        Vec3 omega = 10.0 * wobble * side;
        omega[axis] = 10.0;
        sweep.add(spinning({1, 2, 3}, Quat::Identity(), omega));
      }
    }
  }
  WARN("wobble 1e-1 to 1e-17 about each axis, " << sweep.points << " bodies, 10 s: error at most "
                                                << sweep.most << " eps |omega| T");
  CHECK(sweep.most < 6.0);
}

TEST_CASE("the error has no step as two moments or three become equal", "[figures]") {
  Sweep sweep;
  for (double change = 0.1; change > 2e-16; change *= 0.31622776601683794) {
    for (const double near : {1.0 + change, 1.0 - change}) {
      for (const Vec3& I :
           {Vec3(1, near, 2), Vec3(near, 0.5, 1), Vec3(1, near, 1.0 + 0.3 * change)}) {
        if (I[0] == I[1] || I[1] == I[2] || I[2] == I[0]) continue;
        sweep.add(spinning(I, tumblingBrick().q, {3, 5, -2}));
        sweep.add(spinning(I, Quat::Identity(), {1e-3, 5, 1e-5}));
      }
    }
  }
  WARN("moments that differ by 1e-1 to 2e-16, " << sweep.points << " bodies, 10 s: error at most "
                                                << sweep.most << " eps |omega| T");
  CHECK(sweep.most < 6.0);
}

TEST_CASE("the error has no step across the separatrix", "[figures]") {
  Sweep sweep;
  for (double change = 0.1; change > 1e-16; change *= 0.31622776601683794) {
    for (const double excess : {1.0 + change, 1.0 - change}) {
      sweep.add(spinning({1, 2, 3}, tumblingBrick().q, {std::sqrt(3.0) * excess, 4.0, 1.0}));
      sweep.add(spinning({3, 2, 1}, Quat::Identity(), {excess, 0.1, std::sqrt(3.0)}));
    }
  }
  WARN("1e-1 to 1e-16 beside the separatrix, " << sweep.points << " bodies, 10 s: error at most "
                                               << sweep.most << " eps |omega| T");
  CHECK(sweep.most < 6.0);
}
