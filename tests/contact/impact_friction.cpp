// Friction of an impact: what sweeps and Newton's method leave of it, and which normal impulses
// bound it.
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/body/force.h"
#include "sim/body/mass_properties.h"
#include "sim/contact/impact.h"
#include "tests/catch.h"
#include "tests/collide/random_pose.h"

using namespace tumble;

namespace {

/// A brick of 1 kg that meets the floor at so many points, where it slides and spins.
struct Rubbed {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts;
  std::vector<double> restitution;
  std::vector<Vec3> impulse;

  Rubbed(const Vec3& v, const Vec3& omega) {
    bodies = {makeFixedBody(Pose{}, Vec3::Zero(), Vec3::Zero()),
              makeBody(solidMass(Box{{0.15, 0.05, 0.1}}, 1.0))};
    bodies[1].x = {0.0, 0.05, 0.0};
    setVelocity(bodies[1], v, omega);
  }
  void touch(double x, double z, double e, double mu) {
    Contact c;
    c.a = 1;
    c.b = 0;
    c.point.p = c.point.pa = c.point.pb = {x, 0.0, z};
    c.point.n = Vec3::UnitY();
    c.restitution = e;
    c.friction = mu;
    contacts.push_back(c);
    restitution.push_back(e);
    impulse.emplace_back(Vec3::Zero());
  }
  Impact impact() { return {bodies, contacts, restitution, impulse, {}}; }
};

}  // namespace

// Oracle: what is least. Each contact sticks, or its friction is as large as it may be and against
// its slip. Measured 3e-16 of the fastest slip, allowed 1e-13; 2e-4 after 200 sweeps.
TEST_CASE("friction of an impact leaves the least energy, at many points of one body") {
  Random random(3);
  double worst = 0.0;
  for (int scene = 0; scene < 400; ++scene) {
    const Vec3 v = random.vector(-2.0, 2.0), omega = random.vector(-10.0, 10.0);
    Rubbed brick(v, omega);
    std::vector<double> j;
    std::vector<int> all;
    const int n = 2 + random.below(7);
    for (int k = 0; k < n; ++k) {
      const double x = random.uniform(-0.15, 0.15), z = random.uniform(-0.1, 0.1);
      brick.touch(x, z, 0.5, random.uniform(0.1, 1.0));
      j.push_back(random.uniform(0.0, 0.5));
      all.push_back(k);
    }
    const double before = kineticEnergy(brick.bodies);
    double fastest = 0.0;
    for (const Contact& c : brick.contacts)
      fastest = std::max(fastest, slipVelocity(brick.bodies[1], brick.bodies[0], c.point).norm());
    const ImpulseEnergy energy = frictionImpulses(brick.impact(), all, j);
    CHECK(energy.lost >= 0.0);
    CHECK(std::abs(before - kineticEnergy(brick.bodies) - energy.lost) < 1e-13 * before);
    for (int k = 0; k < n; ++k) {
      const Contact& c = brick.contacts[k];
      const Vec3 slip = slipVelocity(brick.bodies[1], brick.bodies[0], c.point);
      const double bound = c.friction * j[k];
      CHECK(brick.impulse[k].norm() <= bound * (1.0 + 1e-14));
      const double pulled = brick.impulse[k].norm();
      const double open = pulled < bound * (1.0 - 1e-12)
                              ? slip.norm()
                              : (slip.norm() * brick.impulse[k] / pulled + slip).norm();
      worst = std::max(worst, open / fastest);
    }
  }
  CAPTURE(worst);
  CHECK(worst < 1e-13);
}

// Oracle: symmetry. Four corners share a blow in many ways, and friction goes by their shares: the
// order of the corners tells nothing. Measured 1e-14 m/s and rad/s, allowed 1e-12; 2e-9 where the
// normal impulses hung on it, and 2e-4 where sweeps ended before friction was found.
TEST_CASE("a face that strikes, rebounds and rubs does so in whatever order its corners stand") {
  const char* law = GENERATE("reflections", "simultaneous", "poisson", "crowd");
  const double e = GENERATE(0.5, 1.0);
  const auto after = [&](const std::vector<int>& order) {
    Rubbed brick({0.2, -1.4, 0.1}, {0.0, 10.0, 0.0});
    for (const int k : order) brick.touch(k & 1 ? 0.15 : -0.15, k & 2 ? 0.1 : -0.1, e, 0.3);
    findImpactLaw(law)->apply(brick.impact());
    Vec6 twist;
    twist << brick.bodies[1].v, brick.bodies[1].omega;
    return twist;
  };
  const Vec6 first = after({0, 1, 2, 3});
  std::vector<int> order = {0, 1, 2, 3};
  double worst = 0.0;
  while (std::next_permutation(order.begin(), order.end()))
    worst = std::max(worst, (after(order) - first).norm());
  CAPTURE(law, e, worst);
  CHECK(worst < 1e-12);
}
