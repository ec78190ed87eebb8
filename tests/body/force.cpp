#include "sim/body/force.h"

#include <array>
#include <vector>

#include "tests/body/bodies.h"
#include "tests/catch.h"

using namespace tumble;
using namespace tumble::test;

namespace {

const Vec3 kObliqueGravity(0.5, -9.81, 0.3);

/// Brick, cylinder, turntable; springs between the first two, from either to the turntable, and
/// from the cylinder to a point of the world. Undamped, all of them have a potential.
std::vector<RigidBody> threeBodies() {
  return {tumblingBrick(), tumblingCylinder(), turntable()};
}

std::vector<Force> springs(double damping = 0.0) {
  const Vec3 a(0.1, -0.2, 0.25), b(-0.1, 0.4, 0.1);
  return {Spring{0, 1, a, b, 30.0, damping, 0.4}, Spring{0, 2, -a, 2.0 * a, 50.0, damping, 0.7},
          Spring{2, 1, -b, a, 40.0, damping, 0.5},
          Spring{1, kNoBody, -b, {1.0, 2.0, 3.0}, 20.0, damping, 1.0}};
}

/// Energy of all that can change.
double energy(const std::vector<Force>& forces, const std::vector<RigidBody>& bodies) {
  return kineticEnergy(bodies) + potentialEnergy(kObliqueGravity, forces, bodies);
}

/// The bodies a time h later to second order: x and q with mean velocity, P and L with the forces.
std::vector<RigidBody> later(std::vector<RigidBody> bodies, const std::vector<Force>& forces,
                             double h) {
  sumForces(kObliqueGravity, forces, bodies);
  for (RigidBody& body : bodies) {
    const RigidBody start = body;
    body.P += 0.5 * h * body.force;
    body.L += 0.5 * h * body.torque;
    updateDerived(body);
    body = moved(body, h);
    body.P = start.P + h * start.force;
    body.L = start.L + h * start.torque;
    updateDerived(body);
  }
  return bodies;
}

}  // namespace

// Oracle: closed forms, SD13 and SD21: F = Σ fᵢ, τ = Σ (p − x) × fᵢ.
TEST_CASE("forces and torques add up over a body") {
  std::vector<RigidBody> bodies = {tumblingBrick()};
  const Vec3 grip_B(0.1, -0.2, 0.3), pull(2.0, 1.0, -3.0), wind(0.1, 0.2, 0.3);
  const std::vector<Force> forces = {PointForce{0, grip_B, pull}, UniformWind{kNoBody, wind},
                                     LinearDrag{0, 0.7, 0.2}};
  sumForces(kObliqueGravity, forces, bodies);
  const RigidBody& body = bodies[0];
  // Measured 0 to the printed digits, allowed 1e-13.
  CHECK((body.force - (3.0 * kObliqueGravity + pull + wind - 0.7 * body.v)).norm() < 1e-13);
  CHECK((body.torque - ((body.R * grip_B).cross(pull) - 0.2 * body.omega)).norm() < 1e-13);
}

TEST_CASE("a couple turns a body without moving it") {
  std::vector<RigidBody> bodies = {tumblingBrick()};
  const Vec3 grip_B(0.0, 0.2, 0.0), pull(1.0, 0.0, 2.0);
  const std::vector<Force> couple = {PointForce{0, grip_B, pull}, PointForce{0, -grip_B, -pull}};
  sumForces(Vec3::Zero(), couple, bodies);
  CHECK(bodies[0].force.isZero(0.0));
  CHECK((bodies[0].torque - 2.0 * (bodies[0].R * grip_B).cross(pull)).norm() < 1e-14);
}

TEST_CASE("a force on one body leaves the others alone, and none reaches a fixed body") {
  std::vector<RigidBody> bodies = threeBodies();
  const std::vector<Force> forces = {UniformWind{1, {1.0, 0.0, 0.0}},
                                     PointForce{2, Vec3::Zero(), {1.0, 1.0, 1.0}},
                                     LinearDrag{2, 1.0, 1.0}};
  sumForces(Vec3::Zero(), forces, bodies);
  CHECK((bodies[0].force.isZero(0.0) && bodies[0].torque.isZero(0.0)));
  CHECK(bodies[1].force == Vec3(1.0, 0.0, 0.0));
  CHECK((bodies[2].force.isZero(0.0) && bodies[2].torque.isZero(0.0)));
}

// Oracle: central difference of the potential along every shift and turn of either free body.
// Measured 3e-8, allowed 3e-7 of forces near 30 N.
TEST_CASE("gravity and springs pull down the slope of their potential") {
  const std::vector<Force> forces = springs();
  std::vector<RigidBody> bodies = threeBodies();
  sumForces(kObliqueGravity, forces, bodies);
  const double h = 1e-6;
  for (int body = 0; body < 2; ++body) {
    for (int axis = 0; axis < 3; ++axis) {
      std::array<double, 2> shifted, turned;
      for (int side = 0; side < 2; ++side) {
        const Vec3 step = (side == 0 ? -h : h) * Vec3::Unit(axis);
        std::vector<RigidBody> trial = bodies;
        trial[body].x += step;
        shifted[side] = potentialEnergy(kObliqueGravity, forces, trial);
        trial = bodies;
        trial[body].q = rotated(trial[body].q, step);
        updateDerived(trial[body]);
        turned[side] = potentialEnergy(kObliqueGravity, forces, trial);
      }
      CHECK(bodies[body].force[axis] == Approx((shifted[0] - shifted[1]) / (2 * h)).margin(3e-7));
      CHECK(bodies[body].torque[axis] == Approx((turned[0] - turned[1]) / (2 * h)).margin(3e-7));
    }
  }
}

// Oracle: central difference of the energy along the motion. The turntable leads one spring along.
// Measured 5e-7, allowed 7e-6 of 62 W.
TEST_CASE("energy changes by the power of the forces that have no potential") {
  std::vector<Force> forces = springs(0.8);
  forces.push_back(UniformWind{kNoBody, {1.0, -2.0, 0.5}});
  forces.push_back(LinearDrag{kNoBody, 0.4, 0.3});
  forces.push_back(PointForce{1, {0.1, 0.3, 0.0}, {3.0, 1.0, -2.0}});
  const std::vector<RigidBody> bodies = threeBodies();
  const double h = 1e-5;
  const double before = energy(forces, later(bodies, forces, -h));
  const double after = energy(forces, later(bodies, forces, h));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    // Each force has a share in it: a sign lost in any would show.
    CHECK(std::abs(powerOfForces({&forces[i], 1}, bodies)) > 0.1);
  }
  CHECK(powerOfForces(forces, bodies) == Approx((after - before) / (2.0 * h)).margin(7e-6));
}

TEST_CASE("a spring of no length pulls at nothing") {
  std::vector<RigidBody> bodies = {tumblingBrick()};
  const std::vector<Force> spring = {Spring{0, kNoBody, Vec3::Zero(), bodies[0].x, 10.0, 1.0, 0.5}};
  sumForces(Vec3::Zero(), spring, bodies);
  CHECK(bodies[0].force.isZero(0.0));
}
