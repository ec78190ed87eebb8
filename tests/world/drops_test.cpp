// Bodies that fall on each other and on a floor, by the exact method: every run ends with books
// that close, and contacts never give energy, however events crowd.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "tests/catch.h"
#include "tests/gravity.h"
#include "tests/world/draws.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// Lets the scene run and looks at energy and overlap in 60 samples a second.
void checkDrop(WorldDef def) {
  World world(def);
  double energy = 0.0, gain = 0.0;
  for (int k = 0; k <= std::lround(60.0 * def.duration) && !world.report().stopped; ++k) {
    world.advance(k / 60.0);
    if (world.report().stopped) break;
    const Sample s = world.sample(k / 60.0);
    if (k > 0) gain = std::max(gain, s.kinetic + s.potential - energy);
    energy = s.kinetic + s.potential;
  }
  const Certificate& books = world.report().certificate;
  CAPTURE(world.report().reason, gain, books.max_energy_gain, books.max_penetration);
  CHECK_FALSE(world.report().stopped);
  CHECK(gain < 1e-9);
  CHECK(books.energy_balance_error < 1e-8);
  CHECK(books.momentum_error < 1e-8);
  CHECK(books.max_penetration < 1e-6);
}

}  // namespace

// Oracle: conservation. Three cubes, one above the other and a little aside, rattle to rest: more
// hits, slips and ends of slips than can be followed. Measured: see the checks' bounds, a tenth.
TEST_CASE("three cubes that fall on each other come to an end, turned or mirrored or shifted") {
  for (const int view : {0, 1, 2}) {
    CAPTURE(view);
    const double side = view == 1 ? -1.0 : 1.0, by = view == 2 ? 10.0 : 0.0;
    WorldDef def = worldOf("exact", 0.3, {ground(0.3, 0.5)});
    const double x[] = {0.0, 0.03, 0.01}, y[] = {0.1, 0.3, 0.8};
    for (int k = 0; k < 3; ++k)
      def.bodies.push_back(box("cube" + std::to_string(k), {0.2, 0.2, 0.2},
                               {by + side * x[k], y[k], 0.0}, 0.3, 0.5));
    checkDrop(def);
  }
}

// Oracle: as above. A flat box slides and turns on its face to rest: four contacts that slip in
// unlike directions share the load in more ways than one, and not all move the box alike.
TEST_CASE("a box that slides and turns on its face comes to rest") {
  WorldDef def = worldOf("exact", 0.5, {ground(0.0, 0.29)});
  def.bodies.push_back(box("box", {0.12, 0.135, 0.06}, {-0.09, 0.0675, 0.08}, 0.8, 1.0));
  def.bodies[1].orientation = fromAxisAngle(Vec3::UnitY(), 1.0868);
  def.bodies[1].angularVelocity = {0.0, 0.38863429114328873, 0.0};
  checkDrop(def);
}

namespace {

/// Thrown boxes, balls and capsules, one to three of them, with every restitution and friction.
void checkDrops(std::uint64_t seed, int count) {
  const auto draw = [&seed](double lo, double hi) {
    seed += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = seed;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return lo + (hi - lo) * static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  };
  for (int scene = 0; scene < count; ++scene) {
    CAPTURE(scene);
    const double e = draw(0.0, 1.0), mu = draw(0.0, 1.5);
    WorldDef def = worldOf("exact", 0.5, {ground(scene % 4 == 0 ? 0.0 : e, mu)});
    double height = 0.0;
    for (int k = 0; k <= scene % 3; ++k) {
      const double a = draw(0.08, 0.3), b = draw(0.05, 0.3), c = draw(0.05, 0.3);
      BodyDef body =
          box("body" + std::to_string(k), {a, b, c}, Vec3::Zero(), scene % 4 == 0 ? 0.0 : e, mu);
      if (draw(0.0, 1.0) < 0.3) body.shape = Capsule{0.25 * a, b};
      if (draw(0.0, 1.0) < 0.2) body.shape = Sphere{0.5 * b};
      const double x = draw(-1.0, 1.0), y = draw(-1.0, 1.0), z = draw(-1.0, 1.0);
      if (draw(0.0, 1.0) < 0.6) body.orientation = Quat(1.0, x, y, z).normalized();
      const Aabb box = boundingBox(body.shape, {Vec3::Zero(), body.orientation});
      body.position = {0.05 * x, height - box.lo.y() + 0.05 * (1.0 + y), 0.05 * z};
      body.velocity = {x, -1.0, z};
      height = body.position.y() + box.hi.y();
      def.bodies.push_back(body);
    }
    checkDrop(def);
  }
}

}  // namespace

// Oracle: as above.
TEST_CASE("random drops of one to three bodies come to an end") {
  checkDrops(20260, 8);
}

TEST_CASE("hundreds of random drops come to an end", "[long]") {
  checkDrops(20261, 300);
}

namespace {

/// A run that came to its end, without overlap, and of whose energy and momentum no more is open.
void checkBooks(const World& world, double open) {
  const Certificate& books = world.report().certificate;
  CAPTURE(world.report().reason);
  CHECK_FALSE(world.report().stopped);
  CHECK(books.max_penetration < 1e-9);
  CHECK(books.energy_balance_error < open);
  CHECK(books.momentum_error < open);
}

/// Boxes, cylinders, capsules and ellipsoids with edges from 3 cm to 1.2 m, one to three of them,
/// that fall over up to two more which are fixed.
WorldDef oddDrop(unsigned seed) {
  Draws draws{std::mt19937(seed)};
  const double e = draws(0.0, 1.0) < 0.5 ? 0.0 : draws(0.0, 0.8);
  const double mu = draws(0.0, 1.0) < 0.2 ? 0.0 : draws(0.0, 1.0);
  const auto vector = [&](double lo, double hi) {
    const double x = draws(lo, hi), y = draws(lo, hi);
    return Vec3(x, y, draws(lo, hi));
  };
  WorldDef def = worldOf("exact", 0.8, {ground(e, mu)});
  double height = 0.0;
  const auto add = [&](bool fixed, const Vec3& place) {
    const double kind = draws(0.0, 5.0);
    const Vec3 power = vector(0.0, 1.0);
    const Vec3 edges = 0.03 * Vec3(std::pow(40.0, power.x()), std::pow(40.0, power.y()),
                                   std::pow(40.0, power.z()));
    BodyDef body = box("body" + std::to_string(def.bodies.size()), edges, place, e, mu);
    if (kind > 2.0) body.shape = Cylinder{0.5 * edges.x(), edges.y()};
    if (kind > 3.0) body.shape = Capsule{0.3 * edges.x(), edges.y()};
    if (kind > 4.0) body.shape = Ellipsoid{0.5 * edges};
    const Vec3 axis = vector(-1.0, 1.0);
    body.orientation = Quat(draws(-1.0, 1.0), axis.x(), axis.y(), axis.z()).normalized();
    body.fixed = fixed;
    const Aabb from = boundingBox(body.shape, {Vec3::Zero(), body.orientation});
    if (!fixed) {
      body.position.y() += height - from.lo.y();
      body.velocity = vector(-1.0, 0.0);
      body.angularVelocity = vector(-2.0, 2.0);
    }
    height = std::max(height, body.position.y() + from.hi.y());
    def.bodies.push_back(body);
  };
  const int fixed = static_cast<int>(draws(0.0, 3.0)),
            moving = 1 + static_cast<int>(draws(0.0, 3.0));
  for (int k = 0; k < fixed; ++k) add(true, Vec3(0.6 * k - 0.3, draws(0.0, 0.4), 0.0));
  for (int k = 0; k < moving; ++k) add(false, Vec3(draws(-0.3, 0.3), draws(0.0, 0.1), 0.0));
  return def;
}

}  // namespace

// Oracle: conservation, and no overlap. Of 250 such scenes 20 went up to 0.4 m into each other or
// lost up to half of their momentum, most without a word: bodies that turned fast met unseen, and
// normals of ellipsoids and of rims on edges ended on the far side. These are six of them. In three
// more, rims came to lie flat on edges, or nearly below a ball: 1e-5 of the momentum, and 0.04 J.
// Measured at most 5e-12 m of overlap, 4e-14 of the energy and 2e-12 of the momentum open.
TEST_CASE("bodies of any proportions fall over each other and over what stands there") {
  for (const unsigned seed : {12u, 38u, 39u, 45u, 57u, 74u, 89u, 130u, 192u}) {
    CAPTURE(seed);
    World world(oddDrop(seed));
    world.advance(0.8);
    checkBooks(world, 1e-10);
  }
}

// Oracle: conservation. A box slides by its lowest edge, which is level, over the edge of a block,
// and tips about the latter, so that its edge leans from then on. Of a point of the face, the speed
// along the face's normal would change by another law than that of the two edges. Measured: at most
// 3e-12 of the momentum is open, with two or four events; 3e-9, with six to eight, by the face.
TEST_CASE("a box that tips on the edge of a block, on a level edge, leans without a jolt") {
  for (const double yaw : {0.6, -0.9}) {
    for (const double spin : {-0.5, 0.5, 2.0}) {
      CAPTURE(yaw, spin);
      WorldDef def = worldOf("exact", 0.1, {});
      def.bodies.push_back(box("block", {1.0, 1.0, 1.0}, {-0.5, -0.5, 0.0}, 0.0, 0.1));
      def.bodies.back().fixed = true;
      BodyDef tips = box("box", {0.4, 0.1, 0.15}, Vec3::Zero(), 0.0, 0.1);
      tips.orientation = fromAxisAngle(Vec3::UnitY(), -yaw) * fromAxisAngle(Vec3::UnitX(), 0.7);
      const Vec3 onEdge = tips.orientation * Vec3(-0.05, -0.05, 0.075);
      tips.position = -onEdge;
      tips.angularVelocity = {0.0, 0.0, spin};
      tips.velocity = tips.angularVelocity.cross(tips.position) + Vec3(0.4, 0.0, 0.7);
      def.bodies.push_back(tips);
      World world(def);
      world.advance(0.1);
      const Certificate& books = world.report().certificate;
      CHECK(books.momentum_error < 1e-11);
      CHECK(books.energy_balance_error < 1e-12);
      CHECK(books.events <= 4);
    }
  }
}

// Oracle: closed form. A card of 1 cm that stands on an edge, leaning by 1e-3 or 1e-4 more than it
// could stand, hardly moves at first, then falls against a block within the same look ahead:
//   ½ I ω² = m g (r cos φ₀ − r cos φ),  and its corner meets the block at h sin θ = gap.
// Measured equal to ten digits; where only the forces of the start were looked at, it fell 3.6 mm
// into it.
TEST_CASE("a card that falls within one look ahead meets what it falls against") {
  constexpr double kHigh = 0.01, kWide = 0.001, kGap = 0.005;
  for (const double over : {1e-2, 1e-3, 1e-4}) {
    CAPTURE(over);
    const double stands = std::atan(kWide / kHigh), lean = stands + over;
    WorldDef def = worldOf("exact", 0.4, {ground(0.0, 0.9)});
    BodyDef card = box("card", {kWide, kHigh, kHigh}, Vec3::Zero(), 0.0, 0.9);
    card.orientation = fromAxisAngle(Vec3::UnitZ(), -lean);
    card.position = -(card.orientation * Vec3(0.5 * kWide, -0.5 * kHigh, 0.0));
    def.bodies.push_back(card);
    def.bodies.push_back(box("block", {0.01, 0.02, 0.02}, {kGap + 0.005, 0.01, 0.0}, 0.0, 0.9));
    def.bodies.back().fixed = true;
    World world(def);
    world.advance(def.duration);
    const Report& report = world.report();
    CHECK(report.certificate.max_penetration < 1e-12);
    const auto hit = std::find_if(report.events.begin(), report.events.end(),
                                  [](const Event& event) { return event.a == 2; });
    REQUIRE(hit != report.events.end());
    const double square = kWide * kWide + kHigh * kHigh, at = std::asin(kGap / kHigh);
    const double drop = 0.5 * std::sqrt(square) * (std::cos(over) - std::cos(at - stands));
    const double spin = std::sqrt(2.0 * tumble::test::kG * drop / (square / 3.0));
    CHECK(hit->vrel == Approx(-spin * kHigh * std::cos(at)).epsilon(1e-9));
  }
}

// Oracle: energy, and no overlap. Four ellipsoids of 30, 10 and 20 cm fall on each other askew,
// roll and slip off. Where their normals were sought from wherever they had last been, one went
// over to the far side of what it lay on, which moved bodies by 11 cm.
TEST_CASE("ellipsoids that lie on each other roll off each other") {
  WorldDef def = worldOf("exact", 1.0, {ground(0.1, 0.5)});
  for (int i = 0; i < 4; ++i) {
    BodyDef egg =
        box("egg" + std::to_string(i), {0.1, 0.1, 0.1}, {0.01 * i, 0.15 + 0.25 * i, 0.0}, 0.1, 0.5);
    egg.shape = Ellipsoid{{0.3, 0.1, 0.2}};
    def.bodies.push_back(egg);
  }
  World world(def);
  world.advance(def.duration);
  checkBooks(world, 1e-9);
}

// Oracle: there is no room, and energy. A box falls onto one end of a plank across a fixed
// cylinder: from rest the other end meets the floor within one look ahead. It was 28 mm in it
// before it was found to touch.
TEST_CASE("a seesaw that tips from rest meets the floor") {
  WorldDef def = worldOf("exact", 0.6, {ground(0.0, 0.5)});
  BodyDef pivot = box("pivot", {0.1, 0.1, 0.1}, {0.0, 0.1, 0.0}, 0.0, 0.5);
  pivot.shape = Cylinder{0.1, 0.6};
  pivot.orientation = fromAxisAngle(Vec3::UnitX(), 0.5 * std::numbers::pi);
  pivot.fixed = true;
  def.bodies.push_back(pivot);
  def.bodies.push_back(box("plank", {3.0, 0.06, 0.4}, {0.0, 0.235, 0.0}, 0.0, 0.5));
  def.bodies.push_back(box("load", {0.3, 0.3, 0.3}, {-1.2, 0.42, 0.0}, 0.0, 0.5));
  World world(def);
  world.advance(def.duration);
  checkBooks(world, 1e-9);
}

// Oracle: there is no room. A fixed box that moves on pushes another against a wall, which it
// reaches at t = 0.7 s.
TEST_CASE("a box that is pushed against a wall by a fixed one is crushed, and the run says so") {
  WorldDef def = worldOf("exact", 1.0, {ground(0.0, 0.5), ground(0.0, 0.5)});
  def.bodies[1].name = "wall";
  def.bodies[1].shape = HalfSpace{-Vec3::UnitX(), -1.0};
  def.bodies.push_back(box("pusher", {0.2, 0.2, 0.2}, {0.0, 0.15, 0.0}));
  def.bodies.back().fixed = true;
  def.bodies.back().velocity = {1.0, 0.0, 0.0};
  def.bodies.push_back(box("victim", {0.2, 0.2, 0.2}, {0.5, 0.1, 0.0}, 0.0, 0.5));
  World world(def);
  world.advance(1.0);
  const Report& report = world.report();
  CAPTURE(report.reason, report.certificate.max_penetration, report.certificate.steps);
  REQUIRE(report.stopped);
  CHECK(report.reason.find("\"victim\" is crushed by") != std::string::npos);
  CHECK(report.reason.find("t = 0.7 s") != std::string::npos);
  CHECK(report.certificate.max_penetration < 1e-9);
  CHECK(report.certificate.steps < 10000);
}

// Oracle: units. A box, a capsule and a ball, thrown side by side, in metres and with all lengths a
// thousandth and a millionth of them. Measured: at most 7e-7 of a metre's scene apart (by rounding
// of ten metres' scene: 2e-8); with tolerances of metres 1e-5 and 1e-2.
TEST_CASE("what is thrown goes alike in metres, millimetres and micrometres") {
  const auto thrown = [](double scale) {
    WorldDef def = worldOf("exact", 0.75, {ground(0.4, 0.4)});
    def.gravity *= scale;
    def.bodies.push_back(box("box", {0.3, 0.4, 0.25}, {0.0, 0.6, 0.0}));
    def.bodies.push_back(ball("capsule", 0.12, {1.0, 0.5, 0.0}));
    def.bodies.push_back(ball("ball", 0.15, {2.0, 0.7, 0.0}));
    def.bodies[1].shape = Box{scale * Vec3(0.15, 0.2, 0.125)};
    def.bodies[2].shape = Capsule{scale * 0.12, scale * 0.3};
    def.bodies[3].shape = Sphere{scale * 0.15};
    def.bodies[1].orientation = fromAxisAngle(Vec3(1.0, 2.0, -1.0).normalized(), 1.2);
    def.bodies[2].orientation = fromAxisAngle(Vec3(-1.0, 0.5, 2.0).normalized(), 0.9);
    const Vec3 velocity[] = {{0.3, -0.2, 0.5}, {-0.4, 0.1, 0.6}, {0.7, 0.3, -0.2}};
    for (std::size_t i = 1; i < def.bodies.size(); ++i) {
      BodyDef& body = def.bodies[i];
      body.density.reset();
      body.mass = 1.0;
      body.restitution = body.friction = 0.4;
      body.position *= scale;
      body.velocity = scale * velocity[i - 1];
    }
    World world(def);
    world.advance(def.duration);
    CHECK_FALSE(world.report().stopped);
    return world.sample(def.duration).bodies;
  };
  const auto metres = thrown(1.0);
  for (const double scale : {1e-3, 1e-6}) {
    const auto small = thrown(scale);
    for (std::size_t i = 1; i < small.size(); ++i) {
      CAPTURE(scale, i);
      CHECK((small[i].x / scale - metres[i].x).norm() < 3e-6);
    }
  }
}

// Oracle: units, by powers of two: as many looks, and every bit. How near bodies are looked at was
// a length in metres: then all parts of these Ls of 5 μm are near one another, points of their far
// sides are contacts, and 4,998 looks in place of 3,929 end 0.16 m of a metre's scene elsewhere.
TEST_CASE("stepping: Ls that fall on each other go alike in centimetres and micrometres") {
  const auto fallen = [](double scale) {
    WorldDef def = worldOf("stepping", 1.0, {ground(0.0, 0.4)});
    def.gravity *= scale;
    for (int k = 0; k < 3; ++k) {
      BodyDef& body = def.bodies.emplace_back();
      body.name = "ell." + std::to_string(k);
      body.shape = Compound{{{Box{scale * Vec3(0.15, 0.05, 0.05)}, {scale * Vec3(0.15, 0.05, 0.0)}},
                             {Box{scale * Vec3(0.05, 0.1, 0.05)}, {scale * Vec3(0.05, 0.2, 0.0)}}}};
      body.shape = centredShape(body);
      body.mass = 1.0;
      body.friction = 0.4;
      body.position = scale * Vec3(0.02 * k, 0.3 + 0.4 * k, 0.01 * k);
      body.orientation = fromAxisAngle(Vec3(1.0, 2.0 - k, -1.0).normalized(), 0.4 + k);
    }
    World world(def);
    world.advance(def.duration);
    CHECK_FALSE(world.report().stopped);
    return std::pair(world.report().certificate.plane_tests, world.sample(def.duration).bodies);
  };
  const auto [looks, large] = fallen(std::ldexp(1.0, -5));
  const auto [looksOfSmall, small] = fallen(std::ldexp(1.0, -16));
  CHECK(looksOfSmall == looks);
  for (std::size_t i = 1; i < small.size(); ++i) {
    CAPTURE(i);
    CHECK(std::ldexp(1.0, 11) * small[i].x == large[i].x);
  }
}
