// Chapter 5, collide: the certified gap against exact integers.
#include "sim/collide/certified.h"

#include <algorithm>
#include <cmath>

#include "sim/collide/collide.h"
#include "tests/catch.h"
#include "tests/collide/exact_polyhedra.h"
#include "tests/collide/hulls.h"

namespace tumble {
namespace {

struct PolyhedronPair {
  Shape a, b;
  Pose poseA, poseB;
  double size() const { return boundingRadius(a) + boundingRadius(b) + (poseA.x - poseB.x).norm(); }
};

// A rotation that is random, or along the axes, or at 45° about one, or nearly so.
Quat roughRotation(Random& random) {
  const int kind = random.below(4);
  if (kind == 0) return random.rotation();
  Quat q = someEighths(random);
  for (int k = 0; k < 4; ++k)  // exactly along the axes
    if (std::abs(q.coeffs()[k]) < 1e-15) q.coeffs()[k] = 0.0;
  if (kind == 1) return q;
  const Vec3 tilt = random.direction();
  const double angle = kind == 2 ? 1e-8 : 1e-12;
  const Vec3 v = 0.5 * angle * random.uniform(0.1, 1.0) * tilt;
  return Quat(1.0, v.x(), v.y(), v.z()) * q;  // not quite of unit length
}

Box someBox(Random& random) {
  Box box = random.box();
  if (random.below(4) == 0) box.half[random.below(3)] *= 1e-3;  // a thin plate
  return box;
}

PolyhedronPair someBoxPair(Random& random) {
  const Box a = someBox(random);
  const Box b = random.below(8) == 0 ? a : someBox(random);
  const Quat qa = roughRotation(random);
  const Quat qb = random.below(4) == 0 ? qa : roughRotation(random);
  const Vec3 far = random.below(8) == 0 ? 1e3 * random.direction() : Vec3(Vec3::Zero());
  const Vec3 xa = far + random.vector(-1.0, 1.0);
  const Vec3 xb = far + random.vector(-1.0, 1.0);
  return {a, b, {xa, qa}, {xb, qb}};
}

PolyhedronPair someHullPair(Random& random) {
  const Hull a = someHull(random, 4 + random.below(5));
  const Hull b = random.below(8) == 0 ? a : someHull(random, 4 + random.below(5));
  const Quat qa = roughRotation(random);
  const Quat qb = random.below(4) == 0 ? qa : roughRotation(random);
  const Vec3 far = random.below(8) == 0 ? 1e3 * random.direction() : Vec3(Vec3::Zero());
  const Vec3 xa = far + random.vector(-1.0, 1.0);
  const Vec3 xb = far + random.vector(-1.0, 1.0);
  return {a, b, {xa, qa}, {xb, qb}};
}

// Moves a along the widest plane until the gap is ±10^−6 … ±10^−17, or 0, as near as doubles go.
void bringNear(Random& random, PolyhedronPair& pair) {
  const int k = 6 + random.below(13);
  const double side = random.below(2) == 0 ? -1.0 : 1.0;
  const double target = k == 18 ? 0.0 : side * std::pow(10.0, -k);
  for (int step = 0; step < 4; ++step) {
    const ContactPoint c = separatingPlane(pair.a, pair.poseA, pair.b, pair.poseB);
    pair.poseA.x -= (c.separation - target) * c.n;
  }
}

struct SignTally {
  long pairs = 0, wrong = 0, open = 0, nan = 0, near = 0, apart = 0, exact = 0;
  double widest = 0.0;  // bound / (size + distance)
};

void holdSign(const PolyhedronPair& pair, SignTally& tally) {
  const Gap gap = certifiedSeparation(pair.a, pair.poseA, pair.b, pair.poseB);
  ++tally.pairs;
  if (std::isnan(gap.value) || std::isnan(gap.bound)) ++tally.nan;
  tally.widest = std::max(tally.widest, gap.bound / pair.size());
  if (std::abs(gap.value) < 1e-6) ++tally.near;
  if (gap.value > 0.0) ++tally.apart;
  if (std::abs(gap.value) < gap.bound) {
    ++tally.open;
    return;
  }
  exact::Sign sign(pair.a, pair.poseA, pair.b, pair.poseB);
  const int truth = sign();
  if (sign.exactAxes() > 0) ++tally.exact;
  if (truth != (gap.value > 0.0 ? 1 : -1)) ++tally.wrong;
}

template <class Make>
void holdAll(const char* name, std::uint64_t seed, long count, Make make) {
  Random random(seed);
  SignTally tally;
  for (long k = 0; k < count; ++k) {
    PolyhedronPair pair = make(random);
    if (k % 2 == 1) bringNear(random, pair);
    holdSign(pair, tally);
  }
  WARN(name << ": measured wrong signs " << tally.wrong << " of " << tally.pairs << ", left open "
            << tally.open << ", NaN " << tally.nan << ", bound " << tally.widest
            << " of size and distance; nearer than 1e-6 m " << tally.near << ", exact integers for "
            << tally.exact);
  CHECK(tally.wrong == 0);
  CHECK(tally.nan == 0);
  CHECK(tally.widest <= 1e-14);
  CHECK(tally.near > count / 3);
  CHECK(tally.apart > count / 8);
}

// Oracle: exact integers. Nothing is left out but gaps below the bound.
TEST_CASE("the certified sign of the gap between boxes is exact", "[figures]") {
  holdAll("certified gap of boxes", 71, 20000, someBoxPair);
}
TEST_CASE("the certified sign of the gap between hulls is exact", "[figures]") {
  holdAll("certified gap of hulls", 72, 3000, someHullPair);
}
TEST_CASE("the certified sign is exact for ten million pairs of boxes", "[long][figures]") {
  holdAll("certified gap of boxes", 73, 10'000'000, someBoxPair);
}
TEST_CASE("the certified sign is exact for a million pairs of hulls", "[long][figures]") {
  holdAll("certified gap of hulls", 74, 1'000'000, someHullPair);
}

// Oracle: exact integers, on cases by hand with numbers that doubles hold.
TEST_CASE("faces, edges and corners that touch exactly are told from those that miss by an ulp") {
  const Box cube{Vec3::Constant(0.5)};
  const double ulp = 0x1p-52;
  const Quat spin(0.6, 0.0, 0.8, 0.0);  // a rotation in rationals, were 0.6 one
  for (const Vec3& x : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(1, 0.25, -0.125)}) {
    for (const int step : {-1, 0, 1}) {
      const Pose there{Vec3(x.x() + step * ulp, x.y(), x.z()), Quat::Identity()};
      const Gap gap = certifiedSeparation(cube, there, cube, Pose{});
      CAPTURE(x.transpose(), step, gap.value, gap.bound);
      const bool beside = x.y() < 1.0 || step > 0;
      if (step == 0) CHECK(std::abs(gap.value) < gap.bound);
      if (step > 0) CHECK(gap.value >= gap.bound);
      if (step < 0 && beside) CHECK(gap.value <= -gap.bound);
      const Gap hulls = certifiedSeparation(boxHull(cube.half), there, cube, Pose{});
      CHECK(std::abs(hulls.value - gap.value) < 1e-26);
      // The same, both turned alike about the contact normal's plane: exact signs still agree.
      const Pose turned{there.x, spin}, below{Vec3::Zero(), spin};
      const Gap both = certifiedSeparation(cube, turned, cube, below);
      const int truth = exact::Sign(cube, turned, cube, below)();
      if (std::abs(both.value) >= both.bound) CHECK((both.value > 0.0 ? 1 : -1) == truth);
    }
  }
}

// Oracle: exact integers say whether any plane separates; long doubles whether this one does.
TEST_CASE("a separating plane is found if and only if there is one") {
  Random random(75);
  int planes = 0, none = 0;
  for (int k = 0; k < 3000; ++k) {
    PolyhedronPair pair = someHullPair(random);
    if (k % 2 == 1) {
      const ContactPoint c = separatingPlane(pair.a, pair.poseA, pair.b, pair.poseB);
      pair.poseA.x -= (c.separation - 1e-9 * (random.below(2) ? 1.0 : -1.0)) * c.n;
    }
    const ContactPoint c = separatingPlane(pair.a, pair.poseA, pair.b, pair.poseB);
    if (std::abs(c.separation) < 1e-14 * pair.size()) continue;
    const int truth = exact::Sign(pair.a, pair.poseA, pair.b, pair.poseB)();
    REQUIRE((c.separation > 0.0) == (truth > 0));
    if (truth <= 0) {
      ++none;
      continue;
    }
    ++planes;
    const auto outlineA = exact::outlineOf(pair.a), outlineB = exact::outlineOf(pair.b);
    const auto solids = exact::placed<long double>(outlineA, pair.poseA, outlineB, pair.poseB);
    const auto n = exact::entered<long double>(c.n);
    long double low = 1e300L, top = -1e300L;
    for (const auto& p : solids.a) low = std::min(low, exact::dot(n, p));
    for (const auto& p : solids.b) top = std::max(top, exact::dot(n, p));
    REQUIRE(low > top);
  }
  CAPTURE(planes, none);
  REQUIRE(planes > 500);
  REQUIRE(none > 500);
}

TEST_CASE("only boxes and hulls have a certified gap") {
  CHECK_THROWS_AS(certifiedSeparation(Sphere{}, Pose{}, Box{}, Pose{}), std::invalid_argument);
}

}  // namespace
}  // namespace tumble
