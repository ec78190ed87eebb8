// How exact free flight is: thousands of unlike bodies, sweeps through every limit, flip times.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "sim/flight/flight.h"
#include "sim/math/root.h"
#include "tests/body/bodies.h"
#include "tests/catch.h"
#include "tests/flight/theta_reference.h"

using namespace tumble;
using namespace tumble::test;

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kTime = 10.0;

struct Draw {
  std::mt19937_64 engine;
  double operator()(double from, double to) {
    return from + (to - from) * static_cast<double>(engine() >> 11) * 0x1p-53;
  }
  Vec3 vector(double size) {
    const double x = (*this)(-size, size), y = (*this)(-size, size), z = (*this)(-size, size);
    return {x, y, z};
  }
};

/// A body whose extents are spread evenly over three decades, so that its moments differ by up to
/// 1e6; turned and spinning anyhow at up to 100 rad/s.
RigidBody randomBody(Draw& draw) {
  Vec3 squares;  // ∫ x² dm along each axis
  for (int i = 0; i < 3; ++i) squares[i] = std::pow(10.0, draw(-6.0, 0.0));
  const Vec3 moments(squares[1] + squares[2], squares[2] + squares[0], squares[0] + squares[1]);
  const Vec3 axis = draw.vector(1.0), omega = draw.vector(1.0).normalized();
  const double angle = draw(0.0, 6.0), speed = draw(0.0, 100.0);
  return spinning(moments, fromAxisAngle(axis, angle), speed * omega);
}

/// Error of the attitude after 10 s, in units of ε|ω|T.
double error(const RigidBody& start) {
  const Quat q = Flight(start, Vec3::Zero(), 0.0).pose(kTime).q;
  const auto exact = ThetaTop(freeTop<Quad>(start)).attitude(Quad(kTime));
  return angleTo(exact, q) / (kEpsilon * start.omega.norm() * kTime);
}

/// The floor of the error, in the same units: what half a unit in the last place of every number of
/// the start changes, and ε, what rounding the attitude itself may.
double conditioning(const RigidBody& start, Draw& draw) {
  const FreeTop<Quad> top = freeTop<Quad>(start);
  const auto exact = ThetaTop(top).attitude(Quad(kTime));
  double most = kEpsilon;
  for (int n = 0; n < 3; ++n) {
    FreeTop<Quad> other = top;
    for (Quad& I : other.I) I *= 1 + Quad(draw(0, 1) < 0.5 ? -0.5 : 0.5) * kEpsilon;
    for (Quad& L : other.L) L *= 1 + Quad(draw(0, 1) < 0.5 ? -0.5 : 0.5) * kEpsilon;
    const auto q = ThetaTop(other).attitude(Quad(kTime));
    Quad square = 0;
    for (int i = 0; i < 4; ++i) square += (q[i] - exact[i]) * (q[i] - exact[i]);
    most = std::max(most, 2.0 * static_cast<double>(sqrt(square)));
  }
  return most / (kEpsilon * start.omega.norm() * kTime);
}

void compareRandomBodies(int count) {
  Draw draw{std::mt19937_64(42)};
  std::vector<double> errors;
  double worst = 0.0;
  for (int n = 0; n < count; ++n) {
    const RigidBody start = randomBody(draw);
    errors.push_back(error(start));
    worst = std::max(worst, errors.back() / conditioning(start, draw));
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

// Oracle: Taylor series in quadruple precision. Measured 1e-30, allowed 1e-27.
TEST_CASE("the theta functions of the literature solve Euler's equations") {
  Draw draw{std::mt19937_64(7)};
  for (int n = 0; n < 6; ++n) {
    Vec3 moments(draw(1, 2), draw(2, 3), draw(3, 4));
    std::swap(moments[n % 3], moments[n / 2]);
    const RigidBody start = spinning(moments, tumblingBrick().q, draw.vector(5.0));
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
  Draw draw{std::mt19937_64(3)};
  const Vec3 gravity(0.0, -9.81, 0.0);
  double closest = 0.0;
  for (int n = 0; n < 300; ++n) {
    const RigidBody start =
        n % 3 ? randomBody(draw) : spinning({1, 2, 3}, Quat::Identity(), draw.vector(9.0));
    const double r = draw(0.0, 2.0);
    const Flight flight(start, gravity, 0.0);
    const double bound = flight.accelBound(r),
                 alone = Flight(start, Vec3::Zero(), 0.0).accelBound(r);
    RigidBody body = start;
    double most = 0.0, turning = 0.0;
    for (int k = 0; k < 300; ++k) {
      flight.at(draw(0.0, 20.0), body);
      const Vec3 p = r * draw.vector(1.0).normalized();
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
