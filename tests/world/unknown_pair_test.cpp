// Shapes that have no contact rule yet: they fly alone, and never through one another.
#include "sim/world.h"
#include "tests/body/solids.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

BodyDef dumbbellAt(const char* name, const Vec3& x, const Vec3& v) {
  BodyDef body;
  body.name = name;
  body.shape = solids::dumbbell().mesh();
  body.density = 1000.0;
  body.position = x;
  body.velocity = v;
  body.angularVelocity = Vec3(0.1, 0.2, 1.0);
  return body;
}

WorldDef twoDumbbells(const std::string& method, const Vec3& approach) {
  WorldDef def;
  def.method = method;
  def.gravity.setZero();
  def.duration = 4.0;
  def.bodies = {dumbbellAt("left", {-3.0, 0.0, 0.0}, approach),
                dumbbellAt("right", {3.0, 0.0, 0.0}, -approach)};
  return def;
}

}  // namespace

// Oracle: L = R I Rᵀ ω of the start, with products of inertia once the body is turned. Measured
// 1e-14, allowed 1e-12.
TEST_CASE("a mesh with products of inertia flies with its momentum") {
  WorldDef def = twoDumbbells("course", Vec3::Zero());
  def.bodies[0].shape = solids::ell().mesh();
  const Mat3 inertia = massOf(def.bodies[0]).inertia;
  REQUIRE(std::abs(inertia(0, 1)) > 100.0);
  const Vec3 L = inertia * def.bodies[0].angularVelocity;
  World world(def);
  world.advance(def.duration);
  const BodySample body = world.sample(def.duration).bodies[0];
  REQUIRE_FALSE(world.report().stopped);
  CHECK((body.q * (inertia * (body.q.conjugate() * body.omega)) - L).norm() < 1e-12 * L.norm());
  CHECK((body.x - def.bodies[0].position).norm() < 1e-12);  // turns about its centre of mass
}

// Oracle: boxes that touch at t = 1.75 s at the latest, before the bodies can.
TEST_CASE("bodies without a contact rule stop the run before they meet") {
  for (const char* method : {"course", "stepping"}) {
    World world(twoDumbbells(method, {1.0, 0.0, 0.0}));
    world.advance(4.0);
    CHECK(world.report().stopped);
    CHECK(world.report().reason.find("\"right\" comes near \"left\"") == 0);
    World apart(twoDumbbells(method, {-1.0, 0.0, 0.0}));
    apart.advance(4.0);
    CHECK_FALSE(apart.report().stopped);
  }
}

TEST_CASE("bodies without a contact rule are refused where their boxes overlap at the start") {
  WorldDef def = twoDumbbells("course", Vec3::Zero());
  def.bodies[1].position = {-1.0, 0.0, 0.0};
  CHECK_THROWS_AS(World(def), Refusal);
  def.bodies[1].position = {0.0, 0.0, 0.0};
  CHECK_NOTHROW(World(def));
}
