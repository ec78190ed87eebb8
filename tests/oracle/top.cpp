// The heavy top against quadruple precision.
#include "sim/flight/top.h"

#include <cmath>

#include "tests/catch.h"
#include "tests/flight/held.h"
#include "tests/flight/taylor_reference.h"
#include "tests/oracle/quad.h"
#include "tests/oracle/top_reference.h"

using namespace tumble;
using namespace tumble::test;

namespace {

double energy(const Held& top, const RigidBody& body) {
  return 0.5 * body.omega.dot(momentumAbout(top.pivot, body)) - body.M * kGravity.dot(body.x);
}

}  // namespace

// Oracle: quadruple precision. Measured 1.4e-13 rad for the symmetric top and 1.0e-13 rad for an
// uneven body on one of its axes; allowed 1e-12.
TEST_CASE("a heavy top at 150 rad/s is right to 1e-12 after 10 s", "[figures]") {
  const Quat q = fromAxisAngle({0.2, 0.1, 1.0}, 0.9);
  const Held symmetric = held(disc(), q, {0.0, -0.1, 0.0}, q * Vec3(1.0, 150.0, -2.0));
  const Held uneven = held(tumblingBrick(), q, {0.0, 0.0, -0.3}, q * Vec3(3.0, 1.0, 60.0));
  struct Row {
    const char* name;
    const Held& top;
    int steps;
  };
  for (const Row& row : {Row{"symmetric top, 150 rad/s", symmetric, 1600},
                         Row{"uneven body, 60 rad/s", uneven, 800}}) {
    const auto exact = referenceTop<Quad>(row.top.body, row.top.pivot, 9.81, 10.0, row.steps);
    HeavyTop top(row.top.body, row.top.pivot, kGravity, 0.0);
    REQUIRE(top.reach(10.0));
    RigidBody body = row.top.body;
    top.at(10.0, body);
    const double error = angleTo(exact, body.q);
    const double drift = std::abs(energy(row.top, body) / energy(row.top, row.top.body) - 1.0);
    WARN("heavy top, " << row.name << ", 10 s: attitude error " << error << " rad, energy " << drift
                       << " relative, " << top.arcs() << " arcs");
    CHECK(error < 1e-12);
    CHECK(drift < 1e-12);
  }
}

// Oracle: the reference itself at half the step. Measured 1e-24, allowed 1e-20.
TEST_CASE("the reference of the heavy top has converged") {
  const Quat q = fromAxisAngle({0.2, 0.1, 1.0}, 0.9);
  const Held top = held(disc(), q, {0.0, -0.1, 0.0}, q * Vec3(1.0, 150.0, -2.0));
  const auto coarse = referenceTop<Quad>(top.body, top.pivot, 9.81, 0.5, 80);
  const auto fine = referenceTop<Quad>(top.body, top.pivot, 9.81, 0.5, 160);
  for (int i = 0; i < 4; ++i) CHECK(std::abs(static_cast<double>(coarse[i] - fine[i])) < 1e-20);
}
