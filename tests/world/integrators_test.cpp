// Every row of the table of integrators at work in the course's method, on whole worlds.
#include <algorithm>
#include <cmath>

#include "sim/ode/integrator.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

BodyDef brick(const std::string& name, const Vec3& x) {
  BodyDef def = box(name, {0.2, 0.4, 0.6}, x);
  def.orientation = fromAxisAngle({1.0, 2.0, -0.5}, 0.8);
  def.velocity = {1.0, 3.0, 0.5};
  def.angularVelocity = {3.0, 1.0, -2.0};
  return def;
}

/// A ball on a spring from a moving fixed body, in a wind: offers everything.
WorldDef ballOnSpring() {
  WorldDef def;
  def.method = "course";
  def.duration = 1.0;
  def.bodies = {ball("ball", 0.1, {0.3, 1.0, 0.0}), ball("hook", 0.1, {0.0, 3.0, 0.0})};
  def.bodies[1].fixed = true;
  def.bodies[1].velocity = {0.2, 0.0, 0.1};
  def.forces = {Spring{0, 1, {0.1, 0.0, 0.0}, Vec3::Zero(), 25.0, 0.0, 1.0},
                UniformWind{0, {0.5, 0.0, 0.1}}, PointForce{0, {0.0, 0.1, 0.0}, {0.1, 0.2, 0.0}}};
  return def;
}

/// A disc of 1 kg that spins about its pivot 0.1 m away.
WorldDef spinningTop() {
  WorldDef def;
  def.method = "course";
  def.duration = 2.0;
  BodyDef top;
  top.name = "top";
  top.shape = Cylinder{0.1, 0.02};
  top.mass = 1.0;
  top.position = {0.4, 2.0, -0.3};
  top.orientation = fromAxisAngle({0.2, 0.0, 1.0}, 0.7);
  top.angularVelocity = top.orientation * Vec3(0.5, 40.0, 0.0);
  top.pivot_B = {0.0, -0.1, 0.0};
  def.bodies = {top};
  return def;
}

std::string refusal(const WorldDef& def, std::string* why = nullptr) {
  try {
    World world(def);
  } catch (const Refusal& refused) {
    if (why) *why = refused.what();
    return refused.where();
  }
  return "";
}

}  // namespace

// Oracle: conservation; the books close to the order of the row, energy and momentum both.
// Energy: measured 7e-2 for the first order, 1.2e-5 for the second, 9e-9 above; momentum, which the
// pivot of a fast top turns round: 6e-2, 1.3e-3, 3.3e-7.
TEST_CASE("the certificate of every integrator closes to its order", "[figures]") {
  for (const Integrator& row : integrators()) {
    for (WorldDef def : {ballOnSpring(), spinningTop()}) {
      def.course.integrator = row.name;
      def.course.step = 1.0 / 1000.0;
      World world(def);
      run(world);
      const Certificate& books = world.report().certificate;
      WARN(def.bodies[0].name << ", " << row.name << ": energy balance "
                              << books.energy_balance_error << ", momentum " << books.momentum_error
                              << ", " << books.evaluations << " evaluations");
      const int level = std::min(row.order, 3) - 1;
      const double energy[] = {0.1, 3e-5, 3e-8}, momentum[] = {0.1, 3e-3, 1e-6};
      CHECK(books.energy_balance_error < energy[level]);
      CHECK(books.momentum_error < momentum[level]);
      if (row.order > 1) CHECK(world.report().notes.empty());  // the audit sees the first order
    }
  }
}

// Oracle: the count. A step of rk4 asks four times, one of euler once; a Taylor series by its
// order.
TEST_CASE("evaluations are counted") {
  const auto count = [](const char* name, int order) {
    WorldDef def = ballOnSpring();
    def.bodies.pop_back();
    def.forces.clear();
    def.course = {.integrator = name, .order = order, .step = 0.01};
    World world(def);
    world.advance(0.305);  // a pause changes nothing
    world.sample(0.301);
    run(world);
    return world.report().certificate.evaluations;
  };
  CHECK(count("euler", 12) == 100);
  CHECK(count("rk4", 12) == 400);
  CHECK(count("rkmk4", 12) == 400);
  CHECK(count("splitting2", 12) == 200);
  CHECK(count("taylor", 7) == 700);
}

// Oracle: two methods agree. While it lies, rk4 stands in; what it did is the same to rounding as
// what rk4 alone does. Measured 1e-13 m, allowed 1e-9 m.
TEST_CASE("rk4 stands in while contacts last, and the report says so") {
  WorldDef def;
  def.method = "course";
  def.duration = 2.0;
  def.bodies = {ground(0.0, 0.3), box("box", {0.4, 0.2, 0.4}, {0.0, 0.6, 0.0}, 0.0, 0.3)};
  def.bodies[1].velocity = {1.0, 0.0, 0.0};
  World plain(def);
  const Sample expected = run(plain);
  CHECK(plain.report().notes.empty());
  for (const char* name : {"splitting2", "splitting4", "taylor"}) {
    def.course.integrator = name;
    World world(def);
    const Sample sample = run(world);
    CAPTURE(name);
    REQUIRE(world.report().notes.size() == 1);
    CHECK(world.report().notes[0].find("rk4 stands in") != std::string::npos);
    CHECK((sample.bodies[1].x - expected.bodies[1].x).norm() < 1e-9);
  }
}

TEST_CASE("an integrator that a scene cannot serve is refused with what it lacks") {
  WorldDef def;
  def.method = "course";
  def.bodies = {brick("brick", Vec3::Zero())};
  std::string why;
  def.course.integrator = "nystrom4";
  CHECK(refusal(def, &why) == "course.integrator");
  CHECK(why ==
        "\"nystrom4\" needs a kick and a drift that are exact, which this scene does not offer");
  def.course.integrator = "splitting4";
  CHECK(refusal(def).empty());
  def.forces = {LinearDrag{}};
  def.forces = {LinearDrag{0, 0.1, 0.0}};
  CHECK(refusal(def) == "course.integrator");
  def.course.integrator = "taylor";
  CHECK(refusal(def).empty());
  def.course.order = 0;
  CHECK(refusal(def) == "course.order");
  def.course = {.attitude = "euler angles"};
  CHECK(refusal(def) == "course.attitude");
}

// Oracle: the manifold. After 10,000 steps of Euler's method the matrix has sheared, the quaternion
// has not; R of the sample is what the body is drawn by. Measured drift of RᵀR: 0.21 and 2e-16.
TEST_CASE("an attitude integrated as nine numbers shears, a quaternion does not", "[figures]") {
  const auto drift = [](const char* attitude, const char* integrator, double* det = nullptr) {
    WorldDef def;
    def.method = "course";
    def.gravity.setZero();
    def.bodies = {brick("brick", Vec3::Zero())};
    def.course = {.integrator = integrator, .attitude = attitude, .step = 1e-3};
    def.duration = 10.0;
    World world(def);
    const BodySample body = run(world).bodies[0];
    CHECK(world.report().certificate.steps == 10000);
    CHECK(std::abs(body.q.norm() - 1.0) < 1e-15);
    CHECK(body.R.has_value() == (std::string(attitude) == "matrix"));
    const Mat3 R = body.R.value_or(rotationMatrix(body.q));
    if (det) *det = R.determinant() - 1.0;
    return (R.transpose() * R - Mat3::Identity()).norm();
  };
  double matrixDet, quaternionDet;
  const double matrix = drift("matrix", "euler", &matrixDet);
  const double quaternion = drift("quaternion", "euler", &quaternionDet);
  WARN("10,000 Euler steps: RᵀR − 1 is " << matrix << " as a matrix, " << quaternion
                                         << " by quaternion; det R − 1 is " << matrixDet << " and "
                                         << quaternionDet);
  CHECK(matrix > 0.05);
  CHECK(std::abs(matrixDet) > 0.02);
  CHECK(quaternion < 1e-14);
  CHECK(std::abs(quaternionDet) < 1e-14);
  // The implicit midpoint rule keeps what is quadratic, and RᵀR is. Measured 1e-14.
  const double midpoint = drift("matrix", "implicit-midpoint");
  WARN("10,000 steps of the implicit midpoint rule on the matrix: RᵀR − 1 is " << midpoint);
  CHECK(midpoint < 1e-12);
}

TEST_CASE("a run stops where a matrix or a pivot would have to touch something") {
  WorldDef def;
  def.method = "course";
  def.duration = 2.0;
  def.bodies = {ground(), box("box", {0.2, 0.2, 0.2}, {0.0, 1.0, 0.0})};
  def.course.attitude = "matrix";
  World sheared(def);
  run(sheared);
  CHECK(sheared.report().stopped);
  CHECK(sheared.report().reason.find("\"box\" touches \"ground\" at 0.42") == 0);

  def.course.attitude = "quaternion";
  def.bodies[1].pivot_B = {0.0, 0.8, 0.0};
  World still(def);
  run(still);
  CHECK_FALSE(still.report().stopped);
  def.bodies[1].pivot_B = {0.9, 0.0, 0.0};
  World swinging(def);
  run(swinging);
  CHECK(swinging.report().stopped);
  CHECK(swinging.report().reason.find("a body with a pivot has no contacts") != std::string::npos);
}

// Oracle: closed form. A box that hangs from its pivot swings as a physical pendulum,
// ω² = M g l/Ip for small angles. Measured 2e-9 of the amplitude after a whole number of periods.
TEST_CASE("a body on a pivot is a physical pendulum") {
  WorldDef def;
  def.method = "course";
  BodyDef bar = box("bar", {0.1, 0.6, 0.1}, Vec3::Zero());
  bar.pivot_B = {0.0, 0.3, 0.0};
  const double small = 1e-4;
  bar.orientation = fromAxisAngle(Vec3::UnitZ(), small);
  def.bodies = {bar};
  const double inertia = (0.01 + 0.36) / 12.0 + 0.09;  // per mass
  const double period = 2.0 * 3.14159265358979323846 / std::sqrt(9.81 * 0.3 / inertia);
  def.duration = 2.0 * period;
  World world(def);
  const BodySample end = run(world).bodies[0];
  CHECK(std::abs(2.0 * end.q.z() - small) < 1e-6 * small);
  CHECK((end.x - end.q * Vec3(0.0, -0.3, 0.0) -
         Vec3(-0.3 * std::sin(small), 0.3 * std::cos(small), 0.0))
            .norm() < 1e-15);
}

TEST_CASE("pivots that cannot be are refused") {
  WorldDef def = spinningTop();
  CHECK(refusal(def).empty());
  def.method = "stepping";
  CHECK(refusal(def) == "bodies[0].pivot_body");
  def = spinningTop();
  def.bodies[0].velocity = {1.0, 0.0, 0.0};
  CHECK(refusal(def) == "bodies[0].velocity");
  def = spinningTop();
  def.bodies[0].fixed = true;
  CHECK(refusal(def) == "bodies[0].pivot_body");
  def = spinningTop();
  def.bodies[0].pivot_B = {0.0, std::nan(""), 0.0};
  CHECK(refusal(def) == "bodies[0].pivot_body");
}
