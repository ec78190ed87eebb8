// Joints against the forces that a textbook gives for them.
#include "sim/joint/joint.h"

#include <cmath>

#include "sim/body/force.h"
#include "sim/body/mass_properties.h"
#include "sim/contact/rows.h"
#include "sim/joint/joint_bonds.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr double kG = 9.81;
constexpr double kNoPull = 1e9;  // [s]

/// Bodies under gravity and held by joints, solved for the forces of this moment.
struct Held {
  std::vector<RigidBody> bodies;
  std::vector<Joint> joints = {};
  Problem problem = {};
  Bonds bonds = {};
  Solution solution = {};
  SolveReport report = {};

  void join(JointDef def) {
    if (def.kind != JointKind::Distance) def.anchorB = def.anchorA;
    joints.push_back(makeJoint(def, bodies, 1.0));
  }
  std::vector<JointForce> solve(std::span<const Limit> limits = {}) {
    sumForces({0.0, -kG, 0.0}, {}, bodies);
    beginAccelerationProblem(bodies, problem);
    restBonds(bodies, joints, limits, kNoPull, bonds);
    appendBonds(bonds, problem);
    report = findSolver("pivoting")->solve(problem, {}, solution);
    if (report.status == SolveStatus::Solved) readBonds(solution.lambda, 0, bonds);
    std::vector<JointForce> forces;
    jointForces(bodies, joints, bonds, 1.0, forces);
    return forces;
  }
  Vec3 spinUp(int body) const { return solution.v[body].tail<3>(); }
};

RigidBody plankAt(const Vec3& x, double m = 6.0, double length = 2.0, double thick = 0.1) {
  RigidBody plank = makeBody(solidMass(Box{{0.5 * length, 0.5 * thick, 0.25}}, m));
  plank.x = x;
  updateDerived(plank);
  return plank;
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
  Held held{.bodies = {bob}};
  held.join({.kind = JointKind::Distance, .a = 0, .anchorA = bob.x, .anchorB = Vec3::Zero()});
  const std::vector<JointForce> forces = held.solve();
  const double tension = m * (kG * std::cos(angle) + speed * speed / l);
  CHECK((forces[0].force + tension * along).norm() < 1e-12 * tension);
  CHECK(forces[0].torque.norm() < 1e-12);
  CHECK(across.dot(held.solution.v[0].head<3>()) == Approx(-kG * std::sin(angle)).epsilon(1e-12));
}

// Oracle: a uniform plank released level about a hinge at its end falls with ω̇ = −m g L/(2 I), and
// the hinge carries m (g + L ω̇/2), a quarter of its weight if it is thin. Measured 1e-15.
TEST_CASE("a plank released from level leaves a quarter of its weight to the hinge") {
  const double m = 6.0, length = 2.0, thin = 1e-3;
  Held held{.bodies = {plankAt({0.5 * length, 0.0, 0.0}, m, length, thin)}};
  held.join({.kind = JointKind::Hinge, .a = 0});
  const std::vector<JointForce> forces = held.solve();
  const double inertia = held.bodies[0].Ibody(2, 2) + m * 0.25 * length * length;
  const double turn = -m * kG * 0.5 * length / inertia;
  CHECK(held.spinUp(0).z() == Approx(turn).epsilon(1e-12));
  CHECK(forces[0].force.y() == Approx(m * (kG + 0.5 * length * turn)).epsilon(1e-12));
  CHECK(forces[0].force.y() == Approx(0.25 * m * kG).epsilon(1e-5));
}

// Oracle: a spinning plank pulls at its hinge with m ω² L/2. Measured 1e-15, allowed 1e-12.
TEST_CASE("a plank that spins about its hinge pulls outward on it") {
  const double m = 6.0, length = 2.0, spin = 5.0;
  Held held{.bodies = {plankAt({0.5 * length, 0.0, 0.0}, m, length)}};
  setVelocity(held.bodies[0], {0.0, 0.5 * length * spin, 0.0}, {0.0, 0.0, spin});
  held.join({.kind = JointKind::Hinge, .a = 0});
  CHECK(held.solve()[0].force.x() == Approx(-m * spin * spin * 0.5 * length).epsilon(1e-12));
}

// Oracle: statics. A built-in beam carries its weight and the moment m g L/2; a slider on an
// incline lets the body go with g sin θ and carries m g cos θ. Measured 1e-15, allowed 1e-12.
TEST_CASE("a fixed joint carries force and moment, a slider what is across it") {
  const double m = 6.0, length = 2.0;
  Held beam{.bodies = {plankAt({0.5 * length, 0.0, 0.0}, m, length)}};
  beam.join({.kind = JointKind::Fixed, .a = 0});
  const JointForce built = beam.solve()[0];
  CHECK((built.force - Vec3(0.0, m * kG, 0.0)).norm() < 1e-12 * m * kG);
  CHECK((built.torque - Vec3(0.0, 0.0, m * kG * 0.5 * length)).norm() < 1e-11 * m * kG);
  CHECK(beam.solution.v[0].norm() < 1e-12);

  const double slope = 0.5;
  const Vec3 down(std::cos(slope), -std::sin(slope), 0.0),
      up(std::sin(slope), std::cos(slope), 0.0);
  Held rail{.bodies = {plankAt({0.0, 0.0, 0.0}, m, length)}};
  rail.join({.kind = JointKind::Slider, .a = 0, .axis = down});
  const JointForce held = rail.solve()[0];
  CHECK((held.force - m * kG * std::cos(slope) * up).norm() < 1e-12 * m * kG);
  CHECK((rail.solution.v[0].head<3>() - kG * std::sin(slope) * down).norm() < 1e-12 * kG);
}

// Oracle: invariants of a limit – λ ≥ 0, a ≥ 0, λ a = 0. A plank on its lower stop is carried like
// a built-in beam; pulled off it, it is free.
TEST_CASE("a limit pushes one way and lets go") {
  const double m = 6.0, length = 2.0;
  Held held{.bodies = {plankAt({0.5 * length, 0.0, 0.0}, m, length)}};
  held.join({.kind = JointKind::Hinge, .a = 0, .lo = 0.0, .hi = 1.0});
  const Limit lower[] = {0}, upper[] = {1};
  CHECK(held.solve(lower)[0].torque.z() == Approx(m * kG * 0.5 * length).epsilon(1e-12));
  CHECK(held.spinUp(0).norm() < 1e-12);
  held.joints[0].hi = 0.0;
  CHECK(std::abs(held.solve(upper)[0].torque.z()) < 1e-12);
  CHECK(held.spinUp(0).z() < -5.0);
}

// Oracle: of all forces that hold a door on two hinges the even one: each carries half the weight.
// Ten rows of which five repeat others. What shares is even as far as the small compliance that
// makes it so is small: measured 8e-10, allowed 1e-8. Their sum is exact to rounding.
TEST_CASE("a door on two hinges and a four-bar linkage in space are solved though rows repeat") {
  Held door{.bodies = {plankAt({0.5, 0.0, 0.0}, 20.0, 1.0, 2.0)}};
  for (double y : {-0.8, 0.8})
    door.join({.kind = JointKind::Hinge, .a = 0, .anchorA = {0.0, y, 0.0}, .axis = Vec3::UnitY()});
  const std::vector<JointForce> hinges = door.solve();
  CHECK(door.report.status == SolveStatus::Solved);
  CHECK(hinges[0].force.y() == Approx(10.0 * kG).epsilon(1e-8));
  CHECK(hinges[1].force.y() == Approx(10.0 * kG).epsilon(1e-8));
  CHECK((hinges[0].force + hinges[1].force - Vec3(0.0, 20.0 * kG, 0.0)).norm() < 1e-11);

  // Crank, coupler and rocker of a parallelogram: two cranks of 0.5 m that stand upright carry a
  // coupler of 1 m.
  Held bars;
  for (double x : {0.0, 1.0}) {
    RigidBody crank = makeBody(solidMass(Box{{0.02, 0.25, 0.02}}, 1.0));
    crank.x = {x, 0.25, 0.0};
    updateDerived(crank);
    bars.bodies.push_back(crank);
  }
  RigidBody coupler = makeBody(solidMass(Box{{0.5, 0.02, 0.02}}, 2.0));
  coupler.x = {0.5, 0.5, 0.0};
  updateDerived(coupler);
  bars.bodies.push_back(coupler);
  for (int k : {0, 1}) {
    const double x = k;
    bars.join({.kind = JointKind::Hinge, .a = k, .anchorA = {x, 0.0, 0.0}});
    bars.join({.kind = JointKind::Hinge, .a = 2, .b = k, .anchorA = {x, 0.5, 0.0}});
  }
  const std::vector<JointForce> forces = bars.solve();
  CHECK(bars.report.status == SolveStatus::Solved);
  CHECK(forces[0].force.y() == Approx(2.0 * kG).epsilon(1e-10));
  CHECK(forces[2].force.y() == Approx(2.0 * kG).epsilon(1e-10));
  for (const Vec6& v : bars.solution.v) CHECK(v.norm() < 1e-10);
}

// Oracle: two rods of one bob ask for accelerations that no bob can have both.
TEST_CASE("joints that contradict each other are told to be so") {
  RigidBody bob = makeBody(solidMass(Sphere{0.1}, 1.0));
  updateDerived(bob);
  setVelocity(bob, {0.0, 1.0, 0.0}, Vec3::Zero());
  Held held{.bodies = {bob}};
  // Both along x: one holds ẍ = −v²/1, the other ẍ = v²/2.
  held.join({.kind = JointKind::Distance, .a = 0, .anchorA = bob.x, .anchorB = {1.0, 0.0, 0.0}});
  held.join({.kind = JointKind::Distance, .a = 0, .anchorA = bob.x, .anchorB = {-2.0, 0.0, 0.0}});
  held.solve();
  CHECK(held.report.status == SolveStatus::Infeasible);
}
