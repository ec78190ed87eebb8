// Joints against the forces that a textbook gives for them.
#include "sim/joint/joint.h"

#include <cmath>

#include "sim/body/mass_properties.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr double kG = 9.81;

/// Accelerations of free bodies under gravity, ready for joints to be added.
Problem underGravity(std::span<const RigidBody> bodies) {
  Problem problem;
  for (const RigidBody& body : bodies) {
    problem.invM.push_back(body.invM);
    problem.Iinv.push_back(body.Iinv);
    Vec6 acceleration = Vec6::Zero();
    if (!body.fixed()) acceleration << 0.0, -kG, 0.0, -(body.Iinv * body.omega.cross(body.L));
    problem.vStar.push_back(acceleration);
  }
  return problem;
}

Solution solved(const Problem& problem) {
  Solution solution;
  const SolveReport report = findSolver("pivoting")->solve(problem, {}, solution);
  REQUIRE(report.status == SolveStatus::Solved);
  return solution;
}

}  // namespace

// Oracle: T = m g cos θ + m v²/l, tangential acceleration −g sin θ. Measured 2e-15, allowed 1e-12.
TEST_CASE("the rod of a pendulum pulls with weight and centripetal force") {
  const double m = 2.0, l = 1.5, angle = 0.7, speed = 1.3;
  RigidBody bob = makeBody(solidMass(Sphere{0.1}, m));
  const Vec3 along(std::sin(angle), -std::cos(angle), 0.0);
  const Vec3 across(std::cos(angle), std::sin(angle), 0.0);
  bob.x = l * along;
  updateDerived(bob);
  setVelocity(bob, speed * across, Vec3::Zero());
  const RigidBody bodies[] = {makeFixedBody({}), bob};
  const DistanceJoint rod{
      .a = 1, .b = 0, .anchorA_B = Vec3::Zero(), .anchorB_B = Vec3::Zero(), .length = l};
  CHECK(gap(bodies, rod) == Approx(0.0).margin(1e-15));
  Problem problem = underGravity(bodies);
  addRows(bodies, rod, problem);
  const Solution solution = solved(problem);
  const double tension = m * (kG * std::cos(angle) + speed * speed / l);
  CHECK(solution.lambda[0] == Approx(-tension).epsilon(1e-12));
  CHECK(across.dot(solution.v[1].head<3>()) == Approx(-kG * std::sin(angle)).epsilon(1e-12));
}

// Oracle: a uniform plank released level about a hinge at its end falls with ω̇ = −3g/(2L), and the
// hinge carries a quarter of its weight. Measured 1e-15, allowed 1e-12.
TEST_CASE("a plank released from level leaves a quarter of its weight to the hinge") {
  const double m = 6.0, length = 2.0, thin = 1e-3;
  RigidBody plank = makeBody(solidMass(Box{{0.5 * length, thin, thin}}, m));
  plank.x = {0.5 * length, 0.0, 0.0};
  updateDerived(plank);
  const RigidBody bodies[] = {makeFixedBody({}), plank};
  const BallJoint hinge{
      .a = 1, .b = 0, .anchorA_B = Vec3(-0.5 * length, 0.0, 0.0), .anchorB_B = Vec3::Zero()};
  CHECK(gap(bodies, hinge) == Approx(0.0).margin(1e-15));
  Problem problem = underGravity(bodies);
  addRows(bodies, hinge, problem);
  const Solution solution = solved(problem);
  const double inertia = plank.Ibody(2, 2) + m * 0.25 * length * length;  // about the hinge
  const double turn = -m * kG * 0.5 * length / inertia;
  CHECK(solution.v[1][5] == Approx(turn).epsilon(1e-12));
  CHECK(solution.lambda[1] == Approx(m * (kG + 0.5 * length * turn)).epsilon(1e-12));
  CHECK(solution.lambda[1] == Approx(0.25 * m * kG).epsilon(1e-5));  // for a thin one
}

// Oracle: a spinning plank pulls at its hinge with m ω² L/2. Measured 1e-15, allowed 1e-12.
TEST_CASE("a plank that spins about its hinge pulls outward on it") {
  const double m = 6.0, length = 2.0, spin = 5.0;
  RigidBody plank = makeBody(solidMass(Box{{0.5 * length, 0.05, 0.05}}, m));
  plank.x = {0.5 * length, 0.0, 0.0};
  updateDerived(plank);
  setVelocity(plank, {0.0, 0.5 * length * spin, 0.0}, {0.0, 0.0, spin});
  const RigidBody bodies[] = {makeFixedBody({}), plank};
  Problem problem = underGravity(bodies);
  addRows(
      bodies,
      BallJoint{
          .a = 1, .b = 0, .anchorA_B = Vec3(-0.5 * length, 0.0, 0.0), .anchorB_B = Vec3::Zero()},
      problem);
  CHECK(solved(problem).lambda[0] == Approx(-m * spin * spin * 0.5 * length).epsilon(1e-12));
}
