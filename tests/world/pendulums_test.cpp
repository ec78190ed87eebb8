// Pendulums and chains: bodies on pins against closed forms, statics and extended precision.
#include <algorithm>
#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>
#include <numbers>
#include <span>

#include "sim/contact/impact.h"
#include "sim/joint/joint_rows.h"
#include "tests/catch.h"
#include "tests/world/joints.h"

using namespace tumble;
using namespace tumble::scenes;

// Oracle: closed form, T = 4 K(sin θ₀/2) √(I/(m g d)). Where a bar comes through the vertical after
// ten periods and a quarter, its angle over its speed is how late it is. Measured 2e-15 by both
// methods; allowed 1e-9.
TEST_CASE("a physical pendulum keeps the period of its elliptic integral", "[figures]") {
  const std::string method = GENERATE("course", "exact");
  const double l = 1.2, m = 3.0, start = 1.0;
  WorldDef def = careful(method);
  def.bodies = {bar("bar", l, m, Vec3::Zero(), start)};
  def.joints = {hinge(0, kNoBody, Vec3::Zero())};
  const double inertia = m * (4.0 * 0.03 * 0.03 + l * l) / 12.0 + m * 0.25 * l * l;
  const double period =
      4.0 * boost::math::ellint_1(std::sin(0.5 * start)) * std::sqrt(inertia / (m * kG * 0.5 * l));
  const double t = 10.25 * period;
  def.duration = 11.0 * period;
  World world(def);
  world.advance(t);
  const Sample sample = world.sample(t);
  const double late = angleOf(sample.bodies[0]) / sample.bodies[0].omega.z() / t;
  const Certificate& books = world.report().certificate;
  WARN("physical pendulum, " << method << ": period off by " << std::abs(late)
                             << ", allowed 1e-9; joint gap " << books.max_joint_gap << " m");
  CHECK(std::abs(late) < 1e-9);
  CHECK(books.max_joint_gap < 1e-12);
  CHECK(books.energy_balance_error < 1e-10);
  CHECK(books.momentum_error < 1e-10);
}

// Oracle: order of convergence, against `exact`. A pull on the pin that answered between the stages
// of a step would leave order 2. Measured 4.3; asked 3.7.
TEST_CASE("a classical step of Runge and Kutta keeps its order on a pin") {
  const auto bobAt = [](const char* method, double step) {
    WorldDef def = worldOf(method, 1.0, {ball("bob", 0.1, {0.8, -0.6, 0.0})});
    def.course.integrator = "rk4";
    def.course.step = step;
    def.joints = {{.name = "pin", .kind = JointKind::Ball, .a = 0, .b = kNoBody}};
    World world(def);
    world.advance(1.0);
    return world.sample(1.0).bodies[0].x;
  };
  const Vec3 exact = bobAt("exact", 0.01);
  const double coarse = (bobAt("course", 0.02) - exact).norm();
  const double fine = (bobAt("course", 0.005) - exact).norm();
  CAPTURE(coarse, fine);
  CHECK(std::log2(coarse / fine) / 2.0 > 3.7);
}

namespace {

using Extended = long double;

/// Two bars in their two angles: θ₁, θ₂ and their rates, in extended precision.
struct DoublePendulum {
  Extended l1, d1, d2, m1, m2, i1, i2, g;
  using State = std::array<Extended, 4>;

  State rates(const State& y) const {
    const Extended c = cos(y[0] - y[1]), s = sin(y[0] - y[1]), k = m2 * l1 * d2;
    const Extended a11 = i1 + m1 * d1 * d1 + m2 * l1 * l1, a12 = k * c, a22 = i2 + m2 * d2 * d2;
    const Extended b1 = -k * s * y[3] * y[3] - (m1 * d1 + m2 * l1) * g * sin(y[0]);
    const Extended b2 = k * s * y[2] * y[2] - m2 * d2 * g * sin(y[1]);
    const Extended det = a11 * a22 - a12 * a12;
    return {y[2], y[3], (a22 * b1 - a12 * b2) / det, (a11 * b2 - a12 * b1) / det};
  }

  /// One step by extrapolated midpoints (Gragg, Bulirsch, Stoer), of order 2·kColumns.
  State step(const State& y, const Extended& h) const {
    constexpr int kColumns = 9;
    std::array<State, kColumns> row{};
    for (int j = 0; j < kColumns; ++j) {
      const int n = 2 * (j + 1);
      const Extended part = h / n;
      State before = y, now = y;
      const State first = rates(y);
      for (int i = 0; i < 4; ++i) now[i] += part * first[i];
      for (int k = 1; k < n; ++k) {
        const State f = rates(now);
        for (int i = 0; i < 4; ++i) {
          const Extended next = before[i] + 2 * part * f[i];
          before[i] = now[i];
          now[i] = next;
        }
      }
      const State last = rates(now);
      State value{};
      for (int i = 0; i < 4; ++i) value[i] = (before[i] + now[i] + part * last[i]) / 2;
      // Neville's scheme in the square of the part.
      for (int k = 1; k <= j; ++k) {
        const Extended ratio = Extended(n * n) / (4 * (j - k + 1) * (j - k + 1)) - 1;
        for (int i = 0; i < 4; ++i) {
          const Extended better = value[i] + (value[i] - row[k - 1][i]) / ratio;
          row[k - 1][i] = value[i];
          value[i] = better;
        }
      }
      row[j] = value;
    }
    return row[kColumns - 1];
  }

  State after(State y, double t, int steps) const {
    for (int k = 0; k < steps; ++k) y = step(y, Extended(t) / steps);
    return y;
  }
};

}  // namespace

// Oracle: the two angles in extended precision, by an extrapolation of order 18 whose halved step
// differs by less than 1e-19. Measured 7e-14 by both methods; allowed 1e-9.
TEST_CASE("a double pendulum is where extended precision has it after 5 s", "[figures]") {
  const std::string method = GENERATE("course", "exact");
  const double l = 1.0, m = 1.0, first = 1.5, second = 0.4;
  WorldDef def = careful(method);
  def.duration = 5.0;
  const Vec3 elbow = l * Vec3(std::sin(first), -std::cos(first), 0.0);
  def.bodies = {bar("upper", l, m, Vec3::Zero(), first), bar("lower", l, m, elbow, second)};
  def.joints = {hinge(0, kNoBody, Vec3::Zero(), "shoulder"), hinge(1, 0, elbow, "elbow")};
  World world(def);
  world.advance(5.0);
  const Sample sample = world.sample(5.0);

  const Extended inertia =
      Extended(m) * (Extended(4.0) * Extended(0.03) * Extended(0.03) + Extended(l) * l) / 12;
  const DoublePendulum exact{l, Extended(l) / 2, Extended(l) / 2, m, m, inertia, inertia, kG};
  const DoublePendulum::State start = {first, second, 0, 0};
  const DoublePendulum::State end = exact.after(start, 5.0, 640);
  const DoublePendulum::State coarse = exact.after(start, 5.0, 320);
  REQUIRE(std::abs(end[0] - coarse[0]) < 1e-15L);
  double worst = 0.0;
  for (int k : {0, 1}) {
    const double turn = angleOf(sample.bodies[k]) - static_cast<double>(end[k]);
    worst = std::max(worst, std::abs(std::remainder(turn, 2.0 * std::numbers::pi)));
  }
  WARN("double pendulum, " << method << ": angles off by " << worst
                           << " after 5 s, allowed 1e-9; joint gap "
                           << world.report().certificate.max_joint_gap << " m");
  CHECK(worst < 1e-9);
}

// Oracle: order of convergence. `stepping` swings a pendulum without drift at its pin, and its
// angle after 2 s errs by h² at most.
TEST_CASE("stepping swings a pendulum with an error that falls with the step") {
  double errors[3];
  for (int k = 0; k < 3; ++k) {
    double angle[2];
    for (int exact : {0, 1}) {
      WorldDef def = careful(exact ? "exact" : "stepping");
      def.stepping.step = 1.0 / (240 << k);
      def.stepping.solver = "pivoting";
      def.duration = 2.0;
      def.bodies = {bar("bar", 1.0, 2.0, Vec3::Zero(), 1.0)};
      def.joints = {hinge(0, kNoBody, Vec3::Zero())};
      World world(def);
      world.advance(2.0);
      angle[exact] = angleOf(world.sample(2.0).bodies[0]);
      CHECK(world.report().certificate.max_joint_gap < 1e-9);
    }
    errors[k] = std::abs(angle[0] - angle[1]);
  }
  CAPTURE(errors[0], errors[1], errors[2]);
  CHECK(errors[0] < 0.01);
  CHECK(errors[2] < 0.6 * errors[1]);
  CHECK(errors[1] < 0.6 * errors[0]);
}

// Oracle: angular momentum about the pivot. A ball strikes a hanging bar: with the joint in the
// same problem J = (1 + e) v/(1/m + h²/I), whatever the law, and the pin stays. Measured 1e-14.
TEST_CASE("a struck pendulum keeps its pivot, by every impact law") {
  for (const ImpactLaw& law : impactLaws()) {
    WorldDef def = careful("course");
    def.impact = law.name;
    def.gravity = Vec3::Zero();
    def.duration = 1.0;
    BodyDef striker = ball("striker", 0.1, {-0.43, -0.9, 0.0}, 0.5);
    striker.velocity = {1.0, 0.0, 0.0};
    def.bodies = {bar("bar", 1.2, 3.0, Vec3::Zero(), 0.0), striker};
    def.joints = {hinge(0, kNoBody, Vec3::Zero())};
    World world(def);
    world.advance(0.5);
    const double inertia = 3.0 * (0.06 * 0.06 + 1.2 * 1.2) / 12.0 + 3.0 * 0.36;
    const double j = 1.5 / (1.0 + 0.81 / inertia);
    CAPTURE(law.name);
    const Report& report = world.report();
    REQUIRE(report.events.size() == 1);
    CHECK(report.events[0].j == Approx(j).epsilon(1e-12));
    CHECK(world.sample(0.5).bodies[0].omega.z() == Approx(0.9 * j / inertia).epsilon(1e-11));
    CHECK(report.certificate.max_joint_gap < 1e-12);
    CHECK(report.certificate.energy_balance_error < 1e-12);
    CHECK(report.certificate.momentum_error < 1e-12);
    CHECK(report.certificate.energy_lost_impact == Approx(0.5 * 0.75 * j / 1.5).epsilon(1e-11));
  }
}

namespace {

/// A chain of links that hangs from the origin at an angle, with a ball of so many link masses.
WorldDef loadedChain(int links, double ratio, double angle) {
  const double l = 0.1;
  const Vec3 along(std::sin(angle), -std::cos(angle), 0.0);
  WorldDef def;
  def.method = "course";
  for (int k = 0; k < links; ++k) {
    BodyDef link;
    link.name = "link." + std::to_string(k);
    link.shape = Capsule{0.01, 0.06};
    link.mass = 0.1;
    link.orientation = rotated(Quat::Identity(), {0.0, 0.0, angle});
    link.position = (k + 0.5) * l * along;
    def.bodies.push_back(link);
  }
  BodyDef load = ball("load", 0.2, (links * l + 0.2) * along);
  load.mass = 0.1 * ratio;
  def.bodies.push_back(load);
  for (int k = 0; k <= links; ++k)
    def.joints.push_back({.name = "pin." + std::to_string(k),
                          .a = k,
                          .b = k == 0 ? kNoBody : k - 1,
                          .anchorA = k * l * along,
                          .anchorB = k * l * along});
  return def;
}

/// Sum of all gaps over the length of the chain.
double gapsOf(const World& world, const Sample& sample) {
  std::vector<RigidBody> bodies(sample.bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].x = sample.bodies[i].x;
    bodies[i].q = sample.bodies[i].q;
    updateDerived(bodies[i]);
  }
  double sum = 0.0;
  for (const Joint& joint : world.model().joints)
    sum += largestJointGap(bodies, std::span(&joint, 1)) * std::sqrt(3.0);
  return sum / 10.0;
}

}  // namespace

// Oracle: statics. Each pin of a hanging chain carries all that hangs below it; the topmost
// g (M + Σ m). Measured 7e-11 by both methods: what the pins are
// apart from their tenths of a metre, in units of rounding, over tau squared; allowed 1e-8.
TEST_CASE("a hanging chain of 100 links under 1000:1 carries its weight", "[figures]") {
  const std::string method = GENERATE("course", "stepping");
  WorldDef def = loadedChain(100, 1000.0, 0.0);
  def.method = method;
  def.stepping.solver = "pivoting";
  def.duration = 0.05;
  World world(def);
  double worst = 0.0, stretch = 0.0;
  for (double t : {0.0, 0.02, 0.05}) {
    world.advance(t);
    const Sample sample = world.sample(t);
    stretch = std::max(stretch, gapsOf(world, sample));
    REQUIRE(sample.joints.size() == 101);
    double below = 100.0 * kG;
    for (int k = 100; k >= 0; --k) {
      if (k < 100) below += 0.1 * kG;
      worst = std::max(worst, (sample.joints[k].force - Vec3(0.0, below, 0.0)).norm() / below);
    }
  }
  WARN("hanging chain of 100, 1000:1, " << method << ": tensions off by " << worst
                                        << ", allowed 1e-8; stretch " << stretch);
  CHECK(worst < 1e-8);
  CHECK(stretch < 1e-6);
}

// Oracle: invariant. What swings under a thousand times its mass does not stretch. Measured 5e-12
// (course), 5e-11 (stepping); allowed 1e-6.
TEST_CASE("a swinging chain of 100 links under 1000:1 does not stretch", "[figures][long]") {
  const std::string method = GENERATE("course", "stepping");
  WorldDef def = loadedChain(100, 1000.0, 0.4);
  def.method = method;
  def.course.step = def.stepping.step = 5e-4;
  def.stepping.solver = "pivoting";
  def.duration = 0.3;
  World world(def);
  double stretch = 0.0;
  for (int k = 1; k <= 30; ++k) {
    world.advance(0.01 * k);
    stretch = std::max(stretch, gapsOf(world, world.sample(0.01 * k)));
  }
  const Certificate& books = world.report().certificate;
  WARN("swinging chain of 100, 1000:1, " << method << ": stretch " << stretch
                                         << ", allowed 1e-6; energy off by "
                                         << books.energy_balance_error);
  CHECK(stretch < 1e-6);
}
