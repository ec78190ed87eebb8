// The slides on resting contact as experiments (SD47–SD56, and the particle between two planes).
#include <algorithm>
#include <initializer_list>

#include "sim/body/force.h"
#include "sim/body/mass_properties.h"
#include "sim/contact/rest.h"
#include "sim/contact/rows.h"
#include "sim/math/rotation.h"
#include "sim/problem/delassus.h"
#include "tests/catch.h"
#include "tests/problem/problems.h"

using namespace tumble;
using tumble::test::Draw;

namespace {

constexpr double kWeight = 9.81;  // m/s²
const Vec3 kDown(0.0, -kWeight, 0.0);

RigidBody restingSolid(const Shape& shape, double mass, const Vec3& x) {
  RigidBody body = makeBody(solidMass(shape, mass));
  body.x = x;
  updateDerived(body);
  return body;
}

Contact touch(int a, int b, const Vec3& p, const Vec3& n = Vec3::UnitY()) {
  Contact c;
  c.a = a;
  c.b = b;
  c.lasting = true;
  c.point.p = c.point.pa = c.point.pb = p;
  c.point.n = n;
  return c;
}

/// Bodies that touch, and carry their weight.
struct Scene {
  std::vector<RigidBody> bodies = {makeFixedBody({})};
  std::vector<Contact> contacts = {};

  int add(RigidBody body) {
    applyForce(body, body.x, kDown / body.invM);
    bodies.push_back(std::move(body));
    return static_cast<int>(bodies.size()) - 1;
  }
  double acceleration(const Contact& c) const {
    return normalAcceleration(bodies[c.a], bodies[c.b], c.point);
  }
  /// The rows of all contacts, at acceleration level.
  Problem problem() const {
    Problem rows;
    beginAccelerationProblem(bodies, rows);
    for (const Contact& c : contacts) {
      const double bias = normalAccelerationBias(bodies[c.a], bodies[c.b], c.point);
      rows.cones.push_back({ConeKind::Push, static_cast<int>(rows.rows.size()), 0.0});
      rows.rows.push_back(pointRow(bodies, c.a, c.b, c.point.p, c.point.n, bias));
    }
    return rows;
  }
};

/// Boxes of 1, 2, … kg on each other, each on its four corners, the first on the floor.
Scene stack(int count) {
  Scene scene;
  for (int k = 0; k < count; ++k) {
    const int box =
        scene.add(restingSolid(Box{{0.5, 0.25, 0.4}}, 1.0 + k, {0.0, 0.25 + 0.5 * k, 0.0}));
    for (const double x : {-0.5, 0.5})
      for (const double z : {-0.4, 0.4})
        scene.contacts.push_back(touch(box, box - 1, {x, 0.5 * k, z}));
  }
  return scene;
}

/// Two boxes askew on each other and on the floor, everything in motion.
Scene tangle() {
  Scene scene;
  for (int k = 0; k < 2; ++k) {
    RigidBody box = restingSolid(Box{{0.3, 0.2, 0.4}}, 1.0 + k, {0.1 * k, 0.3 + 0.5 * k, -0.1 * k});
    box.q = fromAxisAngle({1.0, 2.0, -0.5}, 0.4 + 0.3 * k);
    updateDerived(box);
    setVelocity(box, {0.3, -0.2 * k, 0.1}, {0.7, -1.1, 0.4 + k});
    scene.add(box);
  }
  scene.contacts = {touch(1, 0, {0.2, 0.0, 0.1}), touch(1, 0, {-0.2, 0.0, 0.3}),
                    touch(2, 1, {0.1, 0.5, 0.0}, Vec3(0.2, 1.0, -0.1).normalized()),
                    touch(2, 1, {-0.1, 0.5, 0.2}, Vec3(0.2, 1.0, -0.1).normalized())};
  for (Contact& c : scene.contacts)
    c.anchor = anchorOf(scene.bodies[c.a], scene.bodies[c.b], c.point);
  return scene;
}

/// The body a short time t later under the force and torque that it carries, to t³.
RigidBody later(RigidBody body, double t) {
  if (body.fixed()) return body;
  const Vec3 turn = body.Iinv * (body.torque - body.omega.cross(body.L));
  body.x += t * body.v + 0.5 * t * t * body.invM * body.force;
  body.q = rotated(body.q, t * body.omega + 0.5 * t * t * turn);
  updateDerived(body);
  return body;
}

}  // namespace

// Oracle: the three conditions of the slides, for loads that press, tip and lift a box every way.
// Measured a ≥ −2e-14 m/s², |f a| ≤ 3e-13 N m/s²; allowed 1e-10.
TEST_CASE("corners of a box push or part, never both, whatever pulls it") {
  Draw draw(5);
  int whole = 0, tilting = 0, flying = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Scene scene = stack(1);
    const Vec3 at(draw(-0.25, 0.25), draw(0.0, 0.5), draw(-0.2, 0.2));
    const double up = draw(-20.0, 40.0), x = draw(-2.0, 2.0), z = draw(-2.0, 2.0);
    applyForce(scene.bodies[1], at, {x, up, z});
    REQUIRE(RestForces().apply(scene.bodies, scene.contacts).status == SolveStatus::Solved);
    int pushing = 0;
    for (const Contact& c : scene.contacts) {
      const double f = c.force.y(), a = scene.acceleration(c);
      CAPTURE(trial, f, a);
      REQUIRE(f >= 0.0);
      REQUIRE(a >= -1e-10);
      REQUIRE(std::abs(f * a) < 1e-10);
      if (f > 0.0) ++pushing;
    }
    (pushing == 4 ? whole : pushing > 0 ? tilting : flying) += 1;
  }
  CAPTURE(whole, tilting, flying);
  CHECK(std::min({whole, tilting, flying}) > 20);
}

// Oracle: probing. A unit of impulse at contact i changes vrel at contact k by A_ki, and a unit of
// force n·p″ by as much; b is the second difference of the gap as the bodies move on, h = 1e-4 s.
// Measured 5e-16, 2e-15 and 1e-8; allowed 1e-13, 1e-13 and 1e-6.
TEST_CASE("A is what unit impulses and unit forces change, b what the gaps do without them") {
  const Scene scene = tangle();
  const Delassus system = delassus(scene.problem());
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const Contact& at = scene.contacts[i];
    Scene hit = scene, pushed = scene;
    for (const double side : {1.0, -1.0}) {
      const int body = side > 0.0 ? at.a : at.b;
      applyImpulse(hit.bodies[body], at.point.p, side * at.point.n);
      applyForce(pushed.bodies[body], at.point.p, side * at.point.n);
    }
    for (std::size_t k = 0; k < scene.contacts.size(); ++k) {
      const Contact& c = scene.contacts[k];
      CAPTURE(i, k);
      const double jump = approachVelocity(hit.bodies[c.a], hit.bodies[c.b], c.point) -
                          approachVelocity(scene.bodies[c.a], scene.bodies[c.b], c.point);
      CHECK(system.A(k, i) == Approx(jump).margin(1e-13));
      CHECK(system.A(k, i) == Approx(pushed.acceleration(c) - scene.acceleration(c)).margin(1e-13));
    }
    const double h = 1e-4;
    const auto gap = [&](double t) {
      Contact moved = at;
      follow(later(scene.bodies[at.a], t), later(scene.bodies[at.b], t), moved);
      return moved.point.separation;
    };
    CHECK(system.b[i] == Approx((gap(h) - 2.0 * gap(0.0) + gap(-h)) / (h * h)).margin(1e-6));
  }
}

// Oracle: solved by hand. A rod of length 2 l on feet at its ends: a_11 = 1/m + l²/(m l²/3) = 4/m,
// a_12 = 1/m − 3/m = −2/m, b = −g, so each foot gives m g/2; moved in to l/2, a_11 = 7/4m,
// a_12 = 1/4m, and the same force. Only rounding, 1e-14.
TEST_CASE("a_ij and b_i of a rod on two feet are as solved by hand") {
  const double m = 3.0;
  for (const bool ends : {true, false}) {
    CAPTURE(ends);
    Scene scene;
    scene.add(restingSolid(Box{{1.0, 1e-9, 1e-9}}, m, Vec3::Zero()));
    const double l = ends ? 1.0 : 0.5;
    scene.contacts = {touch(1, 0, {-l, 0.0, 0.0}), touch(1, 0, {l, 0.0, 0.0})};
    const Delassus system = delassus(scene.problem());
    for (int i = 0; i < 2; ++i) {
      CHECK(system.A(i, i) == Approx((ends ? 4.0 : 1.75) / m).epsilon(1e-14));
      CHECK(system.A(i, 1 - i) == Approx((ends ? -2.0 : 0.25) / m).epsilon(1e-14));
      CHECK(system.b[i] == -kWeight);
    }
    RestForces().apply(scene.bodies, scene.contacts);
    for (const Contact& c : scene.contacts)
      CHECK(c.force.y() == Approx(0.5 * m * kWeight).epsilon(1e-14));
  }
}

// Oracle: Newton. Every f = (1 + s) m g, s ≥ 0, obeys f ≥ 0 and a f + b ≥ 0, and lifts the ball off
// with s g; f a = m g² s (1 + s) is 0 for s = 0 alone, and that f is the one found. 1e-14.
TEST_CASE("f of at least 0 and a f + b of at least 0 leave the force open, f a = 0 does not") {
  const double m = 2.0;
  Scene scene;
  scene.add(restingSolid(Sphere{0.5}, m, {0.0, 0.5, 0.0}));
  scene.contacts = {touch(1, 0, Vec3::Zero())};
  const Delassus system = delassus(scene.problem());
  for (const double s : {0.0, 0.01, 1.0, 50.0}) {
    Scene pushed = scene;
    const double f = (1.0 + s) * m * kWeight;
    applyForce(pushed.bodies[1], Vec3::Zero(), {0.0, f, 0.0});
    const double a = pushed.acceleration(pushed.contacts[0]);
    CHECK(a == Approx(s * kWeight).epsilon(1e-14).margin(1e-14));
    CHECK(system.A(0, 0) * f + system.b[0] == Approx(a).epsilon(1e-14).margin(1e-14));
    CHECK(f * a == Approx(m * kWeight * kWeight * s * (1.0 + s)).epsilon(1e-13).margin(1e-12));
  }
  RestForces().apply(scene.bodies, scene.contacts);
  CHECK(scene.contacts[0].force.y() == Approx(m * kWeight).epsilon(1e-14));
}

// Oracle: two methods agree, and statics. Of the four forces of a level three are determined: what
// adds to one diagonal of its corners and takes from the other moves nothing. The top box is pulled
// until it tips. Accelerations agree to 2e-13 m/s², though sweeps find forces that differ by 0.6 N;
// allowed 1e-9.
TEST_CASE("three boxes on each other move alike by every solver, though their forces are open") {
  Scene scene = stack(3);
  applyForce(scene.bodies[3], {0.5, 1.5, 0.0}, {2.0, 20.0, 0.0});
  const Problem problem = scene.problem();

  Solution reference;
  findSolver("pivoting")->solve(problem, {}, reference);
  CHECK(reference.v[3][5] > 1.0);  // it does tip, about z
  Solution other = reference;
  for (const int corner : {4, 7}) other.lambda[corner] += 1.0;
  for (const int corner : {5, 6}) other.lambda[corner] -= 1.0;
  velocitiesFromLambda(problem, other.lambda, other.v);
  CHECK(naturalResidual(problem, other) < 1e-10);  // another answer, and as good

  for (const Solver& solver : solvers()) {
    Solution solution;
    CAPTURE(solver.name);
    CHECK(solver.solve(problem, {}, solution).status == SolveStatus::Solved);
    CHECK(naturalResidual(problem, solution) < 1e-10);
    for (std::size_t body = 0; body < solution.v.size(); ++body)
      CHECK((solution.v[body] - reference.v[body]).lpNorm<Eigen::Infinity>() < 1e-9);
    for (const int level : {0, 1, 2}) {
      double sum = 0.0, above = 0.0;
      for (int corner = 0; corner < 4; ++corner) sum += solution.lambda[4 * level + corner];
      for (int k = level + 1; k <= 3; ++k) above += k * (solution.v[k][1] + kWeight);
      CHECK(sum == Approx(above - 20.0).epsilon(1e-9));
    }
  }
}

// Oracle: statics. λ_a = m g sin β/sin(α + β), λ_b = m g sin α/sin(α + β) of walls that stand α and
// β from level; m g/(2 cos α) each if they are alike. A particle, a ball, and a box held by two
// points a wall: the same. Measured 2e-16, allowed 1e-12.
TEST_CASE("between two planes a particle, a ball and a box are carried alike") {
  const double m = 1.5, r = 0.3;
  for (const auto& [alpha, beta] : {std::pair{0.7, 0.7}, {0.3, 1.1}, {1.2, 0.4}})
    for (const char* kind : {"particle", "ball", "box"}) {
      CAPTURE(alpha, beta, kind);
      const bool box = kind == std::string("box");
      Scene scene;
      scene.add(kind == std::string("particle") ? makeParticle(m)
                : box ? restingSolid(Box{{0.2, 0.3, 0.5}}, m, Vec3::Zero())
                      : restingSolid(Sphere{r}, m, Vec3::Zero()));
      const Vec3 na(std::sin(alpha), std::cos(alpha), 0.0),
          nb(-std::sin(beta), std::cos(beta), 0.0);
      const double reach = kind == std::string("particle") ? 0.0 : r;
      for (const Vec3& n : {na, nb})
        for (const double z : box ? std::vector{-0.2, 0.2} : std::vector{0.0})
          scene.contacts.push_back(touch(1, 0, -reach * n + z * Vec3::UnitZ(), n));
      RestForces().apply(scene.bodies, scene.contacts);
      double wall[2] = {0.0, 0.0};
      for (const Contact& c : scene.contacts) wall[c.point.n.x() < 0.0] += c.force.norm();
      CHECK(wall[0] ==
            Approx(m * kWeight * std::sin(beta) / std::sin(alpha + beta)).epsilon(1e-12));
      CHECK(wall[1] ==
            Approx(m * kWeight * std::sin(alpha) / std::sin(alpha + beta)).epsilon(1e-12));
      if (alpha == beta)
        CHECK(wall[0] == Approx(m * kWeight / (2.0 * std::cos(alpha))).epsilon(1e-12));
      CHECK(scene.bodies[1].force.norm() < 1e-12);
    }
}
