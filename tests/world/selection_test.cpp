// One selection of forces by all methods: where several hold, those of contact points of one
// compliance.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "sim/world.h"
#include "tests/catch.h"
#include "tests/gravity.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;
using tumble::test::kG;

namespace {

constexpr double kMu = 0.3;

WorldDef spinning(const std::string& method) {
  WorldDef def;
  def.method = method;
  def.duration = 0.5;
  def.bodies = {ground(0.0, kMu), box("box", {0.3, 0.1, 0.2}, {0.0, 0.05, 0.0}, 0.0, kMu)};
  def.bodies[1].velocity = {2.0, 0.0, 0.5};
  def.bodies[1].angularVelocity = {0.0, 3.0, 0.0};
  return def;
}

/// A flat box that slides and spins on its four corners, under a pressure that is linear in place:
/// x, z, their rates, the angle about the vertical, its rate.
using Flat = std::array<double, 6>;

/// Rates of the motion; and the loads [N] of the corners, if asked for.
Flat rates(const Flat& y, std::array<double, 4>* loads = nullptr) {
  constexpr double kMass = 6.0, kInertia = 6.0 / 12.0 * (0.09 + 0.04), kHeight = 0.05;
  const double c = std::cos(y[4]), s = std::sin(y[4]);
  Eigen::Matrix<double, 4, 3> places;           // 1, x, z
  Eigen::Matrix<double, 3, 4> pushes, balance;  // per unit of load
  for (int k = 0; k < 4; ++k) {
    const double a = k < 2 ? -0.15 : 0.15, b = k % 2 == 0 ? -0.1 : 0.1;
    const Vec3 r(c * a + s * b, -kHeight, -s * a + c * b);
    const Vec3 u = Vec3(y[2], 0.0, y[3]) + y[5] * Vec3::UnitY().cross(Vec3(r.x(), 0.0, r.z()));
    const Vec3 f = Vec3::UnitY() - kMu * u.normalized(), turn = r.cross(f);
    places.row(k) << 1.0, r.x(), r.z();
    balance.col(k) << 1.0, turn.x(), turn.z();
    pushes.col(k) << f.x() / kMass, f.z() / kMass, turn.y() / kInertia;
  }
  const Mat3 system = balance * places;
  const Eigen::Vector4d load =
      places * Vec3(system.partialPivLu().solve(Vec3(kMass * kG, 0.0, 0.0)));
  if (loads)
    for (int k = 0; k < 4; ++k) (*loads)[static_cast<std::size_t>(k)] = load[k];
  const Vec3 change = pushes * load;
  return {y[2], y[3], change[0], change[1], y[5], change[2]};
}

/// By the classical method of fourth order, in steps that leave 1e-13.
Flat flatAt(double t) {
  constexpr int kSteps = 4000;
  const double h = t / kSteps;
  Flat y = {0.0, 0.0, 2.0, 0.5, 0.0, 3.0};
  const auto plus = [](const Flat& at, const Flat& rate, double part) {
    Flat sum = at;
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += part * rate[k];
    return sum;
  };
  for (int k = 0; k < kSteps; ++k) {
    const Flat k1 = rates(y), k2 = rates(plus(y, k1, 0.5 * h)), k3 = rates(plus(y, k2, 0.5 * h));
    const Flat k4 = rates(plus(y, k3, h));
    y = plus(plus(plus(plus(y, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
  }
  return y;
}

double yawOf(const BodySample& body) {
  return 2.0 * std::atan2(body.q.y(), body.q.w());
}

}  // namespace

// Oracle: the pressure is linear in place, 1 and its two moments balance; the motion by rk4.
// Measured 1e-11 m, 2e-11 rad and 1e-12 of the weight, allowed 1e-9.
TEST_CASE("a box that slides and spins goes as a linear pressure has it") {
  for (const double t : {0.1, 0.3}) {
    World world(spinning("exact"));
    world.advance(t);
    const Sample at = world.sample(t);
    const Flat flat = flatAt(t);
    CHECK(std::abs(at.bodies[1].x.x() - flat[0]) < 1e-9);
    CHECK(std::abs(at.bodies[1].x.z() - flat[1]) < 1e-9);
    CHECK(std::abs(yawOf(at.bodies[1]) - flat[4]) < 1e-9);
    std::array<double, 4> loads = {};
    rates(flat, &loads);
    REQUIRE(at.contacts.size() == 4);
    std::vector<double> found, wanted(loads.begin(), loads.end());
    for (const ContactSample& c : at.contacts) found.push_back(c.force.y());
    std::sort(found.begin(), found.end());
    std::sort(wanted.begin(), wanted.end());
    for (std::size_t k = 0; k < 4; ++k) CHECK(std::abs(found[k] - wanted[k]) < 1e-9 * 6.0 * kG);
  }
}

// Oracle: each other. A plank on three posts of unlike places and heights of rest: twelve points of
// which nine are more than needed. Measured 2e-12 of the weight, allowed 1e-9.
TEST_CASE("all methods share a load on many points alike") {
  for (const double mu : {0.0, 0.5}) {
    std::vector<std::vector<double>> loads;
    for (const char* method : {"exact", "course", "stepping"}) {
      WorldDef def;
      def.method = method;
      def.duration = 0.1;
      def.bodies = {box("left", {0.1, 0.2, 0.3}, {-0.6, 0.1, 0.0}, 0.0, mu),
                    box("middle", {0.2, 0.2, 0.3}, {-0.1, 0.1, 0.0}, 0.0, mu),
                    box("right", {0.1, 0.2, 0.2}, {0.7, 0.1, 0.0}, 0.0, mu),
                    box("plank", {2.0, 0.1, 0.4}, {0.0, 0.25, 0.0}, 0.0, mu)};
      for (int k = 0; k < 3; ++k) def.bodies[static_cast<std::size_t>(k)].fixed = true;
      World world(def);
      world.advance(0.1);
      loads.emplace_back();
      for (const ContactSample& c : world.sample(0.1).contacts) loads.back().push_back(c.force.y());
      std::sort(loads.back().begin(), loads.back().end());
    }
    REQUIRE(loads[0].size() == 12);
    for (std::size_t method = 1; method < 3; ++method) {
      REQUIRE(loads[method].size() == 12);
      for (std::size_t k = 0; k < 12; ++k) {
        CAPTURE(mu, method, k, loads[0][k], loads[method][k]);
        CHECK(std::abs(loads[method][k] - loads[0][k]) < 1e-9 * 80.0 * kG);
      }
    }
  }
}

// Oracle: closed form, y − g t²/2. Springs that nothing presses together do not hold. Measured
// 2e-15 m, allowed 1e-12.
TEST_CASE("a box that fits between two walls without clearance falls, by every method") {
  for (const char* method : {"exact", "course", "stepping"}) {
    WorldDef def = worldOf(method, 0.4,
                           {box("left", {0.2, 4.0, 1.0}, {-0.3, 0.0, 0.0}, 0.0, 1.0),
                            box("right", {0.2, 4.0, 1.0}, {0.3, 0.0, 0.0}, 0.0, 1.0),
                            box("box", {0.4, 0.4, 0.4}, {0.0, 1.0, 0.0}, 0.0, 1.0)});
    for (int k = 0; k < 2; ++k) def.bodies[static_cast<std::size_t>(k)].fixed = true;
    World world(def);
    world.advance(0.4);
    const double y = world.sample(0.4).bodies[2].x.y();
    CAPTURE(method, y);
    CHECK(std::abs(y - (1.0 - 0.5 * kG * 0.16)) < (def.method == "course" ? 1e-8 : 1e-12));
  }
}
