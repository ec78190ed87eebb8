// What bends at rest under its own weight, held to beams and chains.
#include <cmath>

#include "sim/world.h"
#include "tests/catch.h"
#include "tests/world/bent_bodies.h"

using namespace tumble;

namespace {

constexpr double kG = 9.81;

/// How far the tip of a level bar with n cells across sinks.
double tipOf(int n, double length, double edge, double rho, double young, double nu) {
  const SoftDef bar{.cells = {10 * n, n, n},
                    .size = {length, edge, edge},
                    .density = rho,
                    .solid = solidityOf(young, nu)};
  WorldDef def;
  def.duration = 300.0;
  def.stepping.step = 100.0;  // so long that what swings is gone after one
  addSoft(def, bar, Vec3::Zero(), 0.0);
  for (BodyDef& body : def.bodies) body.fixed = body.position.x() < -0.5 * length + 1e-9;
  World world(def);
  world.advance(def.duration);
  REQUIRE_FALSE(world.report().stopped);
  const Sample end = world.sample(def.duration);
  double sunk = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < def.bodies.size(); ++i) {
    if (def.bodies[i].position.x() < 0.5 * length - 1e-9) continue;
    sunk += def.bodies[i].position.y() - end.bodies[i].x.y();
    ++count;
  }
  return sunk / count;
}

/// A chain of springs without a length of rest to speak of, hung at both ends 1 m apart.
/// @return how far below them its middle point rests [m]
double sagOf(int pieces, double length) {
  WorldDef def;
  def.duration = 30.0;
  def.stepping.step = 0.05;
  def.stepping.linearisations = 20;
  auto body = std::make_shared<ElasticBody>();
  body->name = "chain";
  const double piece = length / pieces, drop = std::sqrt(0.25 * (length * length - 1.0));
  for (int k = 0; k <= pieces; ++k) {
    const double s = static_cast<double>(k) / pieces;
    body->bodies.push_back(k);
    def.bodies.push_back({.name = "chain." + std::to_string(k),
                          .shape = Particle{},
                          .mass = 0.1 * piece,
                          .position = {s, -drop * (1.0 - std::abs(2.0 * s - 1.0)), 0.0},
                          .fixed = k == 0 || k == pieces});
    if (k > 0)
      body->elements.push_back({.points = {k - 1, k},
                                .count = 2,
                                .energy = StretchSpring{.stiffness = 1e5 / piece, .rest = piece}});
  }
  def.forces.push_back(Bending{body});
  World world(def);
  world.advance(def.duration);
  REQUIRE_FALSE(world.report().stopped);
  return -world.sample(def.duration).bodies[pieces / 2].x.y();
}

}  // namespace

// Oracle: Timoshenko's beam, w L⁴/8EI + w L²/2κGA with κ = 10(1+ν)/(12+11ν) (Cowper 1966). Linear
// tetrahedra are too stiff in bending, to second order in their size: the two finest, extrapolated.
// Poisson's ratio is 0, for the wall of a beam does not keep it from getting wider.
// Measured 4.2e-3.
TEST_CASE("a level bar of tetrahedra sinks as Timoshenko's beam, by refinement") {
  const double L = 1.0, edge = 0.1, rho = 1.0, young = 1e6, nu = 0.0;
  const double w = rho * kG * edge * edge, I = std::pow(edge, 4) / 12.0;
  const double shear = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu) * young / (2.0 * (1.0 + nu));
  const double exact =
      w * std::pow(L, 4) / (8.0 * young * I) + w * L * L / (2.0 * shear * edge * edge);
  const double two = tipOf(2, L, edge, rho, young, nu) / exact;
  const double four = tipOf(4, L, edge, rho, young, nu) / exact;
  const double eight = tipOf(8, L, edge, rho, young, nu) / exact;
  const double limit = eight + (eight - four) / 3.0;
  CAPTURE(two, four, eight, limit);
  CHECK(two < four);
  CHECK(four < eight);
  CHECK(eight < 1.0);
  CHECK(std::abs(limit - 1.0) <= 0.01);
}

// Oracle: the catenary, 2a sinh(1/2a) = length, which hangs a (cosh(1/2a) − 1) below its ends; a
// chain of straight pieces is off by the square of their length.
TEST_CASE("a chain that hangs between two nails is a catenary, to second order in its pieces") {
  constexpr double kLength = 1.3;
  double lo = 0.2, hi = 2.0;
  for (int k = 0; k < 80; ++k) {
    const double a = 0.5 * (lo + hi);
    (2.0 * a * std::sinh(0.5 / a) > kLength ? lo : hi) = a;
  }
  const double sag = lo * (std::cosh(0.5 / lo) - 1.0);
  const double coarse = sagOf(8, kLength) - sag, fine = sagOf(16, kLength) - sag;
  CAPTURE(coarse, fine, sag);
  CHECK(std::abs(fine) <= 2e-3);
  CHECK(coarse / fine == Approx(4.0).epsilon(0.1));
}
