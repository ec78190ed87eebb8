// The audit of points of mass that have a skin: what rubs it is turned by it, and the point is not.
#include <algorithm>
#include <cmath>

#include "tests/audit/told.h"
#include "tests/catch.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

BodyDef marble(const Vec3& x, const Vec3& velocity, double e, double mu) {
  BodyDef def;
  def.name = "marble";
  def.shape = Particle{0.1};
  def.mass = 0.7;
  def.position = x;
  def.velocity = velocity;
  def.restitution = e;
  def.friction = mu;
  return def;
}

/// It meets a ball in free flight, off its middle.
WorldDef grazed(const char* method, double e) {
  WorldDef def = worldOf(method, 1.0,
                         {marble({0.0, 0.0, 0.0}, {1.0, 0.2, -0.1}, e, 0.5),
                          ball("ball", 0.15, {0.4, 0.2, 0.05}, e, 0.8)});
  def.bodies[1].angularVelocity = {1.0, -2.0, 3.0};
  def.gravity.setZero();
  return def;
}

/// It falls on a table that turns, and is carried along.
WorldDef carried(const char* method, double e) {
  return worldOf(method, 0.5,
                 {turntable(2.0, 0.3), marble({0.6, 0.15, 0.0}, {0.0, 0.0, 0.3}, e, 0.4)});
}

/// A wind presses it on a ball in free flight, over which it slides.
WorldDef pressed(const char* method) {
  WorldDef def = worldOf(method, 1.0,
                         {marble({-0.25, 0.0, 0.0}, {0.0, 0.2, -0.1}, 0.0, 0.3),
                          ball("ball", 0.15, {0.0, 0.0, 0.0}, 0.0, 0.3)});
  def.bodies[1].angularVelocity = {1.0, -2.0, 3.0};
  def.gravity.setZero();
  def.forces = {UniformWind{.body = 0, .force = {1.0, 0.0, 0.0}}};
  return def;
}

/// Onto a drum.
WorldDef drummed(const char* method, double e) {
  WorldDef def = carried(method, e);
  def.bodies[0].shape = Cylinder{1.0, 1.0};
  def.bodies[0].angularVelocity = {0.0, 0.0, 2.0};
  def.bodies[0].orientation = Quat(Eigen::AngleAxisd(0.5 * kPi, Vec3::UnitX()));
  def.bodies[0].position = {0.0, -1.0, 0.0};
  def.bodies[1].position = {0.1, 0.15, 0.0};
  return def;
}

}  // namespace

// Oracle: the certificate. Measured of spin: 3e-15 where it is struck, and where it is pressed all
// the while 6e-8 by course, 1e-4 by exact, 9e-4 by stepping, which is of order one there; of energy
// on the drum 4e-8, 1.3e-4 and 1e-2. Allowed thrice these; off by 0.09 and more where the push is
// taken at its centre.
TEST_CASE("the audit agrees where a point of mass with a skin is rubbed") {
  const std::string method = GENERATE("course", "exact", "stepping", "auto");
  const double e = GENERATE(0.0, 0.5);
  const bool steps = method == "stepping", sure = method == "course";
  const auto booksOf = [&](const WorldDef& def) {
    World world(def);
    run(world);
    CHECK(world.report().certificate.audit_untold_steps == 0);
    CHECK(world.report().certificate.energy_lost_friction > 1e-4);
    return world.report().certificate;
  };
  CAPTURE(method, e);
  Certificate books = booksOf(grazed(method.c_str(), e));
  CHECK(books.audit_spin_error < 1e-14);
  CHECK(books.audit_energy_error < 1e-14);
  books = booksOf(pressed(method.c_str()));
  CHECK(books.audit_spin_error < (sure ? 2e-7 : steps ? 3e-3 : 3e-4));
  CHECK(books.audit_energy_error < (steps ? 3e-5 : 1e-10));
  books = booksOf(carried(method.c_str(), e));
  CHECK(books.audit_energy_error < 2e-7);
  books = booksOf(drummed(method.c_str(), e));
  CHECK(books.audit_energy_error < (sure ? 1e-7 : steps ? 3e-2 : 4e-4));
}

// Oracle: conservation, and what was planted. A marble strikes a ball that it touches, along the
// normal and across it, and the ball has a hundredth more of the spin that this gave it.
TEST_CASE("the audit finds spin that the ball a point of mass rubs did not get from it") {
  const double more = GENERATE(0.0, 1e-2);
  WorldDef def = grazed("course", 0.0);
  const Vec3 n = Vec3(-2.0, 1.0, 2.0) / 3.0, j = 0.3 * n + Vec3(0.1, 0.2, 0.0);
  def.bodies[1].angularVelocity.setZero();
  def.bodies[0].position = def.bodies[1].position + 0.25 * n;
  Told told(def);
  std::vector<RigidBody> now = told.bodies;
  const Vec3 spin = (0.15 * n).cross(-j);
  now[0].P += j;
  now[1].P -= j;
  now[1].L += (1.0 + more) * spin;
  for (RigidBody& body : now) updateVelocities(body);
  told.audit->see(0.0, now);
  const Certificate books = told.figures(0.0);
  CHECK(books.audit_momentum_error < 1e-15);
  CHECK((books.audit_spin_error > 1e-3) == (more > 0.0));
  CHECK((books.audit_spin_error < 1e-14) == (more == 0.0));
}

// Oracle: closed form. On a drum whose skin moves at v a marble as fast is pushed to (1 + s) v: the
// skin did the work M s v² at most, and M s² v² / 2 came from nowhere. Its centre, where the drum
// would move at 1.1 v, would have had all of it from the drum. Measured 1e-16, allowed 1e-12.
TEST_CASE("the audit finds energy that the skin of a point of mass did not get from a drum") {
  const double s = 0.1, v = 2.0;
  WorldDef def = drummed("course", 0.0);
  def.gravity.setZero();
  def.bodies[1].position = {0.0, 0.1, 0.0};
  def.bodies[1].velocity = {-v, 0.0, 0.0};
  Told told(def);
  std::vector<RigidBody> now = told.bodies;
  setVelocity(now[1], {-(1.0 + s) * v, 0.0, 0.0}, Vec3::Zero());
  told.audit->see(0.0, now);
  CHECK(std::abs(told.figures(0.0).audit_energy_gain - 0.5 * 0.7 * s * s * v * v) < 1e-12);
}
