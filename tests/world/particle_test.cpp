// Particles in a world: what they meet, and that many cost no more than many times one.
#include "sim/neighbours.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

BodyDef particle(const std::string& name, const Vec3& x, const Vec3& v = Vec3::Zero(),
                 double radius = 0.0) {
  BodyDef def;
  def.name = name;
  def.shape = Particle{radius};
  def.mass = 0.5;
  def.position = x;
  def.velocity = v;
  return def;
}

std::string bodyRefusedAt(const BodyDef& body) {
  WorldDef def;
  def.bodies = {body};
  try {
    World world(def);
  } catch (const Refusal& refusal) {
    return refusal.where();
  }
  return "";
}

}  // namespace

TEST_CASE("a particle falls through the ground, unless it has a radius") {
  for (const char* method : {"course", "stepping"}) {
    CAPTURE(method);
    WorldDef def;
    def.method = method;
    def.duration = 2.0;
    def.bodies = {ground(0.0, 0.5), particle("point", {0.0, 1.0, 0.0}),
                  particle("grain", {1.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, 0.1)};
    def.bodies[2].friction = 0.5;
    World world(def);
    const Sample end = run(world);
    CHECK(end.bodies[1].x.y() == Approx(1.0 - 0.5 * 9.81 * 4.0).epsilon(1e-2));
    // The grain lands as a ball of its radius, slides with friction to a stop and never rolls.
    CHECK(end.bodies[2].x.y() == Approx(0.1).margin(1e-6));
    CHECK(end.bodies[2].v.norm() < 1e-6);
    CHECK(end.bodies[2].omega.isZero(0.0));
    CHECK(end.bodies[2].q.coeffs() == Quat::Identity().coeffs());
    for (const Event& event : world.report().events) CHECK(event.a != 1);
  }
}

TEST_CASE("particles overlap as they like; grains of a radius do not") {
  WorldDef def;
  def.bodies = {particle("a", Vec3::Zero()), particle("b", Vec3::Zero()),
                ball("c", 1.0, Vec3::Zero())};
  CHECK_NOTHROW(World(def));
  def.bodies.push_back(particle("d", Vec3::Zero(), Vec3::Zero(), 0.1));
  CHECK_THROWS_AS(World(def), Refusal);
}

TEST_CASE("a particle that turns, has an inertia or no mass is refused") {
  CHECK(bodyRefusedAt(particle("p", Vec3::Zero())).empty());
  BodyDef def = particle("p", Vec3::Zero());
  def.mass.reset();
  def.density = 1000.0;
  CHECK(bodyRefusedAt(def) == "bodies[0]");
  def = particle("p", Vec3::Zero());
  def.inertia = Vec3::Ones();
  CHECK(bodyRefusedAt(def) == "bodies[0].inertia");
  def = particle("p", Vec3::Zero());
  def.angularVelocity = Vec3::UnitX();
  CHECK(bodyRefusedAt(def) == "bodies[0].angular_velocity");
  def = particle("p", Vec3::Zero());
  def.orientation = Quat(0.0, 1.0, 0.0, 0.0);
  CHECK(bodyRefusedAt(def) == "bodies[0].orientation");
  def = particle("p", Vec3::Zero(), Vec3::Zero(), -0.1);
  CHECK(bodyRefusedAt(def) == "bodies[0].shape");
}

// Oracle: the broad phase is never asked, so there are no pairs to pay for.
TEST_CASE("2,000 particles make no pairs") {
  WorldDef def;
  def.duration = 0.1;
  for (int i = 0; i < 2000; ++i)
    def.bodies.push_back(particle("p" + std::to_string(i), {0.0, 0.0, 0.0}, {0.001 * i, 5.0, 0.0}));
  World world(def);
  const Sample end = run(world);
  CHECK(world.model().solid.empty());
  CHECK(end.bodies[1999].x.x() == Approx(0.1999).epsilon(1e-12));
  const std::vector<std::string> features = world.features();
  CHECK(std::find(features.begin(), features.end(), "contact") == features.end());
}

TEST_CASE("friction is found by kinds of surfaces as by all pairs") {
  WorldDef def;
  def.bodies = {ground(0.0, 0.5), ball("a", 0.1, {0.0, 1.0, 0.0}), ball("b", 0.1, {1.0, 1.0, 0.0})};
  CHECK(!anyFriction(World(def).model()));
  def.bodies[2].friction = 0.1;
  CHECK(anyFriction(World(def).model()));
  def.bodies[2].friction = 0.0;
  def.bodies[1].material = def.bodies[2].material = "ice";
  def.pairs = {{"ice", "ice", {}, 0.2}};
  CHECK(anyFriction(World(def).model()));
  def.pairs = {{"ice", "rust", {}, 0.2}};
  CHECK(!anyFriction(World(def).model()));
}

// Oracle: closed forms. What a contact does to a particle with a radius bends its way: friction of
// a belt takes it along, until it goes with it; on a smooth sphere it slides as a pendulum swings.
// Measured 1e-15 m/s and 5e-16 m on the belt, 9e-16 of the energy on the sphere.
TEST_CASE("a particle with a radius obeys friction and a normal that turns, by the exact method") {
  constexpr double kRadius = 0.1, kBelt = 1.0, kMu = 0.3, kTime = 3.0, kG = 9.81;
  BodyDef belt = box("belt", {20.0, 0.2, 2.0}, {0.0, -0.1, 0.0}, 0.0, kMu);
  belt.fixed = true;
  belt.velocity = {kBelt, 0.0, 0.0};
  BodyDef rides = particle("rides", {0.0, kRadius, 0.0}, Vec3::Zero(), kRadius);
  rides.friction = kMu;
  World moving(worldOf("exact", kTime, {belt, rides}));
  moving.advance(kTime);
  const BodySample carried = moving.sample(kTime).bodies[1];
  CHECK(std::abs(carried.v.x() - kBelt) < 1e-12);
  CHECK(std::abs(carried.x.x() - (kBelt * kTime - kBelt * kBelt / (2.0 * kMu * kG))) < 1e-12);

  constexpr double kStart = 0.2;  // [rad] from the top
  BodyDef big = ball("big", 1.0, Vec3::Zero());
  big.fixed = true;
  const double way = 1.0 + kRadius;
  World sphere(
      worldOf("exact", 1.0,
              {big, particle("slides", {way * std::sin(kStart), way * std::cos(kStart), 0.0},
                             Vec3::Zero(), kRadius)}));
  sphere.advance(1.0);
  const BodySample fallen = sphere.sample(1.0).bodies[1];
  const double height = way * std::cos(kStart) - fallen.x.y();
  CAPTURE(height, fallen.v.norm());
  CHECK(fallen.v.norm() > 1.0);
  CHECK(std::abs(0.5 * fallen.v.squaredNorm() / (kG * height) - 1.0) < 1e-12);
  // It leaves at cos θ = 2/3 cos θ0 with v² = g (R + r) cos θ, and falls.
  const double leaves = 2.0 / 3.0 * std::cos(kStart);
  CHECK(std::abs(fallen.v.x() - std::sqrt(kG * way * leaves) * leaves) < 1e-9);
}
