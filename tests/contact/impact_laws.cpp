// Impact laws: what every one keeps, and what tells them apart.
#include "sim/contact/impact.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/body/force.h"
#include "sim/body/mass_properties.h"
#include "tests/catch.h"
#include "tests/collide/random_pose.h"

using namespace tumble;

namespace {

/// Bodies, contacts and restitutions of one instant.
struct Heap {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts;
  std::vector<double> restitution;
  std::vector<Vec3> impulse;

  void touch(int a, int b, const Vec3& p, const Vec3& n, double e = 1.0, double mu = 0.0) {
    Contact c;
    c.a = a;
    c.b = b;
    c.point.p = c.point.pa = c.point.pb = p;
    c.point.n = n.normalized();
    c.restitution = e;
    c.friction = mu;
    contacts.push_back(c);
    restitution.push_back(e);
  }
  ImpactReport strike(const char* law) {
    impulse.assign(contacts.size(), Vec3::Zero());
    return findImpactLaw(law)->apply({bodies, contacts, restitution, impulse, {}});
  }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (const RigidBody& b : bodies) sum += b.P;
    return sum;
  }
  Vec3 spin() const {
    Vec3 sum = Vec3::Zero();
    for (const RigidBody& b : bodies)
      if (!b.fixed()) sum += b.L + b.x.cross(b.P);
    return sum;
  }
  double approach() const {
    double worst = 0.0;
    for (const Contact& c : contacts)
      worst = std::min(worst, approachVelocity(bodies[c.a], bodies[c.b], c.point));
    return worst;
  }
};

RigidBody ballAt(const Vec3& x, const Vec3& v, double mass = 1.0) {
  RigidBody body = makeBody(solidMass(Sphere{0.5}, mass));
  body.x = x;
  setVelocity(body, v, Vec3::Zero());
  return body;
}

/// A row of touching balls of diameter 1, the first of which moves at 1 m/s.
Heap cradle(int n, double e = 1.0) {
  Heap heap;
  for (int i = 0; i < n; ++i)
    heap.bodies.push_back(ballAt({1.0 * i, 0.0, 0.0}, {i == 0 ? 1.0 : 0.0, 0.0, 0.0}));
  for (int i = 0; i + 1 < n; ++i) heap.touch(i + 1, i, {i + 0.5, 0.0, 0.0}, Vec3::UnitX(), e);
  return heap;
}

/// Unlike bodies in contact at random points, some against an immovable one; some rest.
Heap randomHeap(Random& random, bool friction, bool elastic) {
  Heap heap;
  const int n = 2 + random.below(6);
  for (int i = 0; i < n; ++i) {
    const Vec3 edges = random.vector(0.1, 1.0);
    const double mass = std::pow(10.0, random.uniform(-2.0, 2.0));
    RigidBody body = i == 0 && random.below(2) ? makeFixedBody(Pose{}, Vec3::Zero(), Vec3::Zero())
                                               : makeBody(solidMass(Box{edges}, mass));
    body.x = random.vector(-2.0, 2.0);
    body.q = random.rotation();
    updateDerived(body);
    const Vec3 v = random.vector(-3.0, 3.0), omega = random.vector(-5.0, 5.0);
    if (!body.fixed() && random.below(4)) setVelocity(body, v, omega);
    heap.bodies.push_back(body);
  }
  const int m = 1 + random.below(2 * n);
  for (int k = 0; k < m; ++k) {
    const int a = 1 + random.below(n - 1), b = random.below(a);
    const Vec3 p = 0.5 * (heap.bodies[a].x + heap.bodies[b].x) + random.vector(-0.5, 0.5);
    heap.touch(a, b, p, random.direction(), elastic ? 1.0 : random.uniform(0.0, 1.0),
               friction ? random.uniform(0.0, 1.0) : 0.0);
  }
  return heap;
}

/// What many random impacts of one law do at worst, relative to what there was.
struct WorstImpact {
  double energy = 0.0, gain = -1.0, momentum = 0.0, spin = 0.0, pull = 0.0, approach = 0.0;
  int unfinished = 0;
};

WorstImpact worstOf(const char* law, int count, bool friction, bool elastic) {
  Random random(7);
  WorstImpact worst;
  for (int k = 0; k < count; ++k) {
    Heap heap = randomHeap(random, friction, elastic);
    const bool free = !heap.bodies[0].fixed();
    const double before = kineticEnergy(heap.bodies);
    const Vec3 P = heap.momentum(), L = heap.spin();
    double scale = 1e-300, arm = 1e-300;
    for (const RigidBody& b : heap.bodies) {
      if (b.fixed()) continue;
      scale += b.P.norm();
      arm += b.L.norm() + b.x.norm() * b.P.norm();
    }
    const ImpactReport report = heap.strike(law);
    const double after = kineticEnergy(heap.bodies);
    if (before == 0.0) continue;
    worst.energy = std::max(worst.energy, std::abs(after - before) / before);
    worst.gain = std::max(worst.gain, (after - before) / before);
    if (free) {
      worst.momentum = std::max(worst.momentum, (heap.momentum() - P).norm() / scale);
      worst.spin = std::max(worst.spin, (heap.spin() - L).norm() / arm);
    }
    for (std::size_t i = 0; i < heap.contacts.size(); ++i)
      worst.pull = std::max(worst.pull, -heap.impulse[i].dot(heap.contacts[i].point.n) / scale);
    worst.approach = std::max(worst.approach, -heap.approach());
    worst.unfinished += report.finishedInelastic;
  }
  return worst;
}

}  // namespace

// Oracle: closed form, velocities handed on from ball to ball. Measured 0, allowed 1e-12.
TEST_CASE("reflections send the last balls of a cradle off, as many as came") {
  for (const int n : {2, 3, 5, 9}) {
    CAPTURE(n);
    Heap heap = cradle(n);
    heap.strike("reflections");
    for (int i = 0; i < n; ++i)
      CHECK((heap.bodies[i].v - Vec3(i == n - 1 ? 1.0 : 0.0, 0.0, 0.0)).norm() < 1e-12);
    Heap two = cradle(n);
    setVelocity(two.bodies[1], {1.0, 0.0, 0.0}, Vec3::Zero());
    two.strike("reflections");
    for (int i = 0; i < n; ++i)
      CHECK((two.bodies[i].v - Vec3(i >= n - 2 ? 1.0 : 0.0, 0.0, 0.0)).norm() < 1e-12);
  }
}

// Oracle: closed form. Newton's law at all contacts at once cannot tell the balls of a row apart:
// v₁ = 1 − 2 (n − 1)/n, the others 2/n. The same by sequential hits as by reflections.
TEST_CASE("laws differ in a cradle of five balls") {
  Heap together = cradle(5), one = cradle(5), poisson = cradle(5), crowd = cradle(5);
  together.strike("simultaneous");
  one.strike("sequential");
  poisson.strike("poisson");
  crowd.strike("crowd");
  for (int i = 0; i < 5; ++i) {
    CHECK(together.bodies[i].v.x() == Approx(i == 0 ? -0.6 : 0.4).margin(1e-12));
    CHECK(one.bodies[i].v.x() == Approx(i == 4 ? 1.0 : 0.0).margin(1e-12));
  }
  // Compression leaves all at 1/5; what each contact took, (5 − k)/5, it gives back.
  for (int i = 0; i < 5; ++i) {
    const double gains = i == 0 ? -0.8 : 0.2;
    CHECK(poisson.bodies[i].v.x() == Approx(0.2 + gains).margin(1e-12));
    CHECK(crowd.bodies[i].v.x() == Approx(0.2 + gains).margin(1e-12));
  }
}

// Oracle: closed form. A ball of 2 m/s meets two that touch each other: −0.4, (1.2, ± 1.2/√3); from
// both sides at once a ball between two stays. Measured 2e-16, allowed 1e-12.
TEST_CASE("Bernoulli's problem and the three-ball case come out symmetric") {
  const double s = 0.5 * std::sqrt(3.0);
  for (const char* law : {"reflections", "simultaneous", "poisson"}) {
    CAPTURE(law);
    Heap heap;
    heap.bodies = {ballAt({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}), ballAt({s, 0.5, 0.0}, Vec3::Zero()),
                   ballAt({s, -0.5, 0.0}, Vec3::Zero())};
    heap.touch(1, 0, 0.5 * Vec3(s, 0.5, 0.0), {s, 0.5, 0.0});
    heap.touch(2, 0, 0.5 * Vec3(s, -0.5, 0.0), {s, -0.5, 0.0});
    heap.touch(2, 1, {s, 0.0, 0.0}, {0.0, -1.0, 0.0});
    heap.strike(law);
    CHECK((heap.bodies[0].v - Vec3(-0.4, 0.0, 0.0)).norm() < 1e-12);
    CHECK((heap.bodies[1].v - Vec3(1.2, 1.2 / std::sqrt(3.0), 0.0)).norm() < 1e-12);
    CHECK((heap.bodies[2].v - Vec3(1.2, -1.2 / std::sqrt(3.0), 0.0)).norm() < 1e-12);

    Heap three = cradle(3);
    setVelocity(three.bodies[2], {-1.0, 0.0, 0.0}, Vec3::Zero());
    three.strike(law);
    CHECK((three.bodies[0].v - Vec3(-1.0, 0.0, 0.0)).norm() < 1e-12);
    CHECK(three.bodies[1].v.norm() < 1e-12);
    CHECK((three.bodies[2].v - Vec3(1.0, 0.0, 0.0)).norm() < 1e-12);
  }
}

// Oracle: e = 0 ends together, e = 1 as elastic; a contact at rest that does not rebound holds like
// a floor: a ball leaves a plate on the floor as fast as e allows. Measured 2e-16.
TEST_CASE("restitution is each contact's own") {
  Heap stuck = cradle(4, 0.0);
  stuck.strike("reflections");
  for (const RigidBody& b : stuck.bodies) CHECK(b.v.x() == Approx(0.25).margin(1e-12));
  Heap heap;
  heap.bodies = {makeFixedBody(Pose{}, Vec3::Zero(), Vec3::Zero()),
                 ballAt({0.0, 0.5, 0.0}, Vec3::Zero(), 0.01),
                 ballAt({0.0, 1.5, 0.0}, {0.0, -1.0, 0.0})};
  heap.touch(1, 0, {0.0, 0.0, 0.0}, Vec3::UnitY(), 0.0);
  heap.touch(2, 1, {0.0, 1.0, 0.0}, Vec3::UnitY(), 0.9);
  heap.strike("reflections");
  CHECK(heap.bodies[1].v.norm() < 1e-12);
  CHECK(heap.bodies[2].v.y() == Approx(0.9).margin(1e-12));
}

// Oracle: continuity. One end of a block lies on the floor while the other hits it: what rounding
// left of the speed of the first changes nothing but rounding. Measured 2e-9, allowed 1e-7; where
// the sign of that speed told whether the end takes part, 0.14 m/s and 1.3 rad/s.
TEST_CASE("what leans beside a hit rests, whatever rounding left of its speed") {
  const double e = GENERATE(0.3, 1.0), mu = GENERATE(0.0, 1.0);
  const auto after = [&](double speed) {
    Heap heap;
    heap.bodies = {makeFixedBody(Pose{}, Vec3::Zero(), Vec3::Zero()),
                   makeBody(solidMass(Box{{0.5, 0.3, 0.2}}, 1.0))};
    heap.bodies[1].x = {0.0, 0.3, 0.0};
    setVelocity(heap.bodies[1], {0.0, 0.5 * (speed - 1.0), 0.0}, {0.0, 0.0, speed + 1.0});
    heap.touch(1, 0, {0.5, 0.0, 0.1}, Vec3::UnitY(), e, mu);
    heap.touch(1, 0, {-0.5, 0.0, 0.0}, Vec3::UnitY(), e, mu);
    heap.contacts[0].lasting = true;
    heap.strike("auto");
    CHECK(heap.approach() > -1e-9);
    return std::pair(heap.bodies[1].v, heap.bodies[1].omega);
  };
  const auto [v, omega] = after(0.0);
  for (const double speed : {-1e-9, -2e-10, 1e-9}) {
    const auto [w, spin] = after(speed);
    CAPTURE(e, mu, speed, (w - v).norm(), (spin - omega).norm());
    CHECK((w - v).norm() + (spin - omega).norm() < 1e-7);
  }
}

// Oracle: conservation. Every law, with all its random restitutions and frictions.
TEST_CASE("impacts of any law only push, keep momentum, end, and never gain energy") {
  for (const ImpactLaw& law : impactLaws()) {
    for (const bool friction : {false, true}) {
      const std::string name(law.name);
      CAPTURE(name, friction);
      const WorstImpact worst = worstOf(name.c_str(), 300, friction, false);
      CHECK(worst.gain < 1e-12);
      CHECK(worst.momentum < 1e-12);
      CHECK(worst.spin < 1e-12);
      CHECK(worst.pull < 1e-9);
      if (!friction)
        CHECK(worst.approach < 1e-8);  // with it, as far as sweeps of a cone problem go
    }
  }
}

// Oracle: conservation. Unlike restitutions can ask for more than compression took: it is held
// back, in each island for itself. A ball that bounces off a wall beside the heap keeps all of its
// own.
TEST_CASE("a crowd holds back what restitution would add, in that island alone") {
  Random random(7);
  int cuts = 0;
  for (int k = 0; k < 300; ++k) {
    Heap heap = randomHeap(random, true, false);
    const int wall = static_cast<int>(heap.bodies.size());
    heap.bodies.push_back(makeFixedBody(Pose{}, Vec3::Zero(), Vec3::Zero()));
    heap.bodies.push_back(ballAt({0.0, 50.5, 0.0}, {0.0, -1.0, 0.0}));
    heap.touch(wall + 1, wall, {0.0, 50.0, 0.0}, Vec3::UnitY(), 0.9);
    const double before = kineticEnergy(heap.bodies);
    cuts += heap.strike("crowd").cut > 0.0;
    CAPTURE(k);
    CHECK(kineticEnergy(heap.bodies) < before * (1.0 + 1e-12));
    CHECK(heap.bodies.back().v.y() == Approx(0.9).epsilon(1e-9));
  }
  CHECK(cuts > 0);
}

// Oracle: the laws themselves. Short rows go by reflections, long ones by one problem.
TEST_CASE("the law \"auto\" is reflections as far as they reach, and crowd beyond") {
  for (const int n : {5, kReflectionsReach + 1, kReflectionsReach + 2}) {
    Heap heap = cradle(n), other = heap;
    heap.strike("auto");
    other.strike(n <= kReflectionsReach + 1 ? "reflections" : "crowd");
    CAPTURE(n);
    for (int i = 0; i < n; ++i) CHECK(heap.bodies[i].v == other.bodies[i].v);
  }
}

// Oracle: conservation. What approached gives all of it back, and with it what rested or parted and
// was compressed with it: where that gave nothing back, a row of twenty lost half its energy.
// Measured 7e-15, allowed 1e-12.
TEST_CASE("an elastic blow without friction takes nothing from a crowd") {
  const WorstImpact worst = worstOf("crowd", 2000, false, true);
  CHECK(worst.energy < 1e-12);
  CHECK(worst.approach < 1e-9);
  for (const int n : {20, 80}) {
    CAPTURE(n);
    Heap row = cradle(n);
    row.strike("crowd");
    CHECK(kineticEnergy(row.bodies) == Approx(0.5).epsilon(1e-12));
    for (int i = 0; i < n; ++i)
      CHECK(row.bodies[i].v.x() == Approx(2.0 / n - (i == 0 ? 1.0 : 0.0)).margin(1e-12));
  }
}

TEST_CASE("elastic reflections in random heaps keep energy and momentum", "[figures]") {
  const WorstImpact worst = worstOf("reflections", 2000, false, true);
  CHECK(worst.energy < 1e-12);
  CHECK(worst.momentum < 1e-12);
  CHECK(worst.pull < 1e-12);
  CHECK(worst.unfinished == 0);
}

TEST_CASE("a hundred thousand of them do", "[long][figures]") {
  const WorstImpact worst = worstOf("reflections", 100'000, false, true);
  WARN("reflections in 100,000 random heaps: energy "
       << worst.energy << ", momentum " << worst.momentum << ", angular momentum " << worst.spin
       << ", pull " << worst.pull << " (1e-12 each); left approaching " << worst.approach
       << " m/s; not ended " << worst.unfinished);
  CHECK(worst.energy < 1e-12);
  CHECK(worst.momentum < 1e-12);
  CHECK(worst.spin < 1e-12);
  CHECK(worst.pull < 1e-12);
  CHECK(worst.unfinished == 0);
}

// Oracle: symmetry. The mirror image of a heap ends as the mirror image; the order of contacts does
// not matter. Measured 3e-15 relative, allowed 1e-9 where LCPs have one answer.
TEST_CASE("reflections do not prefer a side or an order") {
  Random random(9);
  for (int k = 0; k < 300; ++k) {
    Heap heap = randomHeap(random, false, true), mirrored = heap, reversed = heap;
    const auto flip = [](Vec3& v) { v.x() = -v.x(); };
    for (RigidBody& b : mirrored.bodies) {
      const Vec3 v = b.v, w = b.omega;
      flip(b.x);
      b.q = Quat(b.q.w(), b.q.x(), -b.q.y(), -b.q.z());
      updateDerived(b);
      if (!b.fixed()) setVelocity(b, {-v.x(), v.y(), v.z()}, {w.x(), -w.y(), -w.z()});
    }
    for (Contact& c : mirrored.contacts) {
      flip(c.point.p);
      flip(c.point.n);
    }
    std::reverse(reversed.contacts.begin(), reversed.contacts.end());
    heap.strike("reflections");
    mirrored.strike("reflections");
    reversed.strike("reflections");
    double scale = 1e-9;
    for (const RigidBody& b : heap.bodies) scale = std::max(scale, b.v.norm());
    for (std::size_t i = 0; i < heap.bodies.size(); ++i) {
      CAPTURE(k, i);
      Vec3 v = mirrored.bodies[i].v;
      flip(v);
      CHECK((v - heap.bodies[i].v).norm() < 1e-9 * scale);
      CHECK((reversed.bodies[i].v - heap.bodies[i].v).norm() < 1e-9 * scale);
    }
  }
}

// Oracle: a heavy ball drives a light one against a wall: floor(pi/atan(sqrt(m/M))) hits, one row
// each, which a solver goes over twice. A law that ran out of passes would count fewer.
TEST_CASE("an impact tells how many rows it cost to work out") {
  const auto rows = [](double ratio) {
    Heap heap;
    heap.bodies = {makeFixedBody(Pose{}, Vec3::Zero(), Vec3::Zero()),
                   ballAt({0.5, 0.0, 0.0}, Vec3::Zero()),
                   ballAt({1.5, 0.0, 0.0}, {-1.0, 0.0, 0.0}, ratio)};
    heap.touch(1, 0, Vec3::Zero(), Vec3::UnitX());
    heap.touch(2, 1, {1.0, 0.0, 0.0}, Vec3::UnitX());
    return heap.strike("reflections").rows;
  };
  for (const double ratio : {4.0, 100.0}) {
    CAPTURE(ratio);
    CHECK(rows(ratio) ==
          2 * static_cast<long>(std::floor(M_PI / std::atan(1.0 / std::sqrt(ratio)))));
  }
}
