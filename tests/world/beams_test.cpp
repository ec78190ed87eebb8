// What bends at rest under its own weight, held to beams and chains.
#include <cmath>

#include "sim/world.h"
#include "tests/catch.h"
#include "tests/gravity.h"
#include "tests/world/bent_bodies.h"

using namespace tumble;
using tumble::test::kG;

namespace {

/// Holds points by rods to nails so far off along an axis that they stand in no other's way.
void holdAlong(WorldDef& def, int axis, const std::vector<int>& points, double young) {
  constexpr double kFar = 1e3;  // m
  auto rods = std::make_shared<ElasticBody>(*std::get<Bending>(def.forces[0]).body);
  for (const int p : points) {
    const int nail = static_cast<int>(def.bodies.size());
    const Vec3 x = def.bodies[p].position;
    def.bodies.push_back({.name = "nail." + std::to_string(nail),
                          .shape = Particle{},
                          .mass = 1.0,
                          .position = x - kFar * Vec3::Unit(axis),
                          .fixed = true});
    rods->bodies.push_back(nail);
    rods->elements.push_back({.points = {p, nail},
                              .count = 2,
                              .energy = StretchSpring{.stiffness = 10.0 * young, .rest = kFar}});
  }
  def.forces[0] = Bending{rods};
}

/// A wall that a beam may widen along: it holds the length everywhere, the height and the depth
/// along the lines through the middle.
void holdWidening(WorldDef& def, double wall, double young) {
  std::vector<int> held[3];
  for (std::size_t p = 0; p < def.bodies.size(); ++p) {
    const Vec3& x = def.bodies[p].position;
    if (x.x() > wall + 1e-9) continue;
    held[0].push_back(static_cast<int>(p));
    if (std::abs(x.y()) < 1e-9 && std::abs(x.z()) < 1e-9) held[1].push_back(static_cast<int>(p));
    if (std::abs(x.z()) < 1e-9) held[2].push_back(static_cast<int>(p));
  }
  for (int axis = 0; axis < 3; ++axis) holdAlong(def, axis, held[axis], young);
}

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
  const std::size_t points = def.bodies.size();
  if (nu == 0.0)
    for (BodyDef& body : def.bodies) body.fixed = body.position.x() < -0.5 * length + 1e-9;
  else
    holdWidening(def, -0.5 * length, young);
  World world(def);
  world.advance(def.duration);
  REQUIRE_FALSE(world.report().stopped);
  const Sample end = world.sample(def.duration);
  double sunk = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < points; ++i) {
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

namespace {

/// How far the tip sinks by bars of 2, 4 and 8 cells across, over what Timoshenko's beam does,
///   w L⁴/8EI + w L²/2κGA  with  κ = 10(1+ν)/(12+11ν)  (Cowper 1966),
/// and what the two finest tend to, for linear tetrahedra are too stiff in bending to second order
/// in their size.
struct Sinking {
  double two, four, eight, limit;
};
Sinking sinkingOf(double nu) {
  const double L = 1.0, edge = 0.1, rho = 1.0, young = 1e6;
  const double w = rho * kG * edge * edge, I = std::pow(edge, 4) / 12.0;
  const double shear = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu) * young / (2.0 * (1.0 + nu));
  const double exact =
      w * std::pow(L, 4) / (8.0 * young * I) + w * L * L / (2.0 * shear * edge * edge);
  const double two = tipOf(2, L, edge, rho, young, nu) / exact;
  const double four = tipOf(4, L, edge, rho, young, nu) / exact;
  const double eight = tipOf(8, L, edge, rho, young, nu) / exact;
  return {two, four, eight, eight + (eight - four) / 3.0};
}

void checkSinking(double nu) {
  const auto [two, four, eight, limit] = sinkingOf(nu);
  CAPTURE(nu, two, four, eight, limit);
  CHECK(two < four);
  CHECK(four < eight);
  CHECK(eight < 1.0);
  CHECK(std::abs(limit - 1.0) <= 0.01);
}

}  // namespace

// Oracle: Timoshenko's beam. Poisson's ratio is 0, for the wall of a beam does not keep it from
// getting wider. Measured 4.2e-3.
TEST_CASE("a level bar of tetrahedra sinks as Timoshenko's beam, by refinement") {
  checkSinking(0.0);
}

// Oracle: the same, by a wall that lets the beam get wider. Measured 1.4e-3.
TEST_CASE("a level bar whose Poisson's ratio is 0.3 does, where its wall lets it widen") {
  checkSinking(0.3);
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
