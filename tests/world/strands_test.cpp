// Strands in a world: how far they bend and stretch, how they swing, and whom they go with.
#include <algorithm>
#include <cmath>
#include <functional>

#include "sim/elastic/strand.h"
#include "sim/world.h"
#include "tests/catch.h"
#include "tests/gravity.h"

using namespace tumble;
using tumble::test::kG;

namespace {

/// A strand in a world, held by the two points of its root. @return the number of its tip
int addStrand(WorldDef& def, const StrandDef& strand, const Quat& turn) {
  const int first = static_cast<int>(def.bodies.size());
  const auto places = strandPlaces(strand);
  const auto masses = strandMasses(strand);
  auto body = std::make_shared<ElasticBody>();
  body->name = "strand";
  for (int p = 0; p < strand.points; ++p) {
    body->bodies.push_back(first + p);
    def.bodies.push_back({.name = "strand." + std::to_string(p),
                          .shape = Particle{},
                          .mass = masses[p],
                          .position = turn * places[p],
                          .fixed = p < 2});
  }
  body->elements = strandElements(strand, first);
  def.forces.push_back(Bending{body});
  return first + strand.points - 1;
}

Quat about(const Vec3& axis, double degrees) {
  return Quat(Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180.0, axis));
}

/// The tip of a beam that leaves a wall level, without stretch, under a weight w [N/m] and a load F
/// [N] at its tip:  B θ″ = −(F + w (L − s)) cos θ,  θ(0) = 0,  θ′(L) = 0, downward. By shooting, in
/// 4000 steps of Runge and Kutta's.
Vec3 tipOfBeam(double B, double L, double w, double F) {
  constexpr int kSteps = 4000;
  const double h = L / kSteps;
  using State = Eigen::Vector4d;  // θ, θ′, x, y
  const auto rate = [&](double s, const State& y) -> State {
    return {y[1], -(F + w * (L - s)) * std::cos(y[0]) / B, std::cos(y[0]), -std::sin(y[0])};
  };
  const auto end = [&](double bend) {
    State y(0.0, bend, 0.0, 0.0);
    for (int k = 0; k < kSteps; ++k) {
      const double s = k * h;
      const State a = rate(s, y), b = rate(s + 0.5 * h, y + 0.5 * h * a),
                  c = rate(s + 0.5 * h, y + 0.5 * h * b), d = rate(s + h, y + h * c);
      y += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    return y;
  };
  double lo = 0.0, hi = (F + w * L) * L / B;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (lo + hi);
    (end(middle)[1] < 0.0 ? lo : hi) = middle;
  }
  const State y = end(0.5 * (lo + hi));
  return {y[2], y[3], 0.0};
}

}  // namespace

// Oracle: closed form, of any number of pieces. Only rounding remains, allowed 1e-12.
TEST_CASE("a strand that hangs lengthens by its weight, rho g L^2 / 2EA") {
  const StrandDef strand{
      .points = 7, .length = 0.5, .density = 0.01, .stretch = 2.0, .bend = 1e-6, .damping = 0.05};
  WorldDef def;
  def.duration = 40.0;
  def.stepping.step = 0.1;
  const int tip = addStrand(def, strand, about(Vec3::UnitX(), 180.0));
  World world(def);
  world.advance(def.duration);
  REQUIRE_FALSE(world.report().stopped);
  const double longer = 0.01 * kG * 0.5 * 0.5 / (2.0 * 2.0);
  const double y = world.sample(def.duration).bodies[tip].x.y();
  CAPTURE(y + 0.5 + longer);
  CHECK(std::abs(y + 0.5 + longer) <= 1e-12);
}

// Oracle: closed form of a point that is let go under a spring at rest, order of convergence.
// Measured 2.4e-4 m with the shortest, ratios of 1.95 and 1.97.
TEST_CASE("an implicit step of what bends is of first order") {
  const StrandDef strand{.points = 3, .length = 0.2, .density = 0.01, .stretch = 0.2, .bend = 0.0};
  const double k = strand.stretch / strand.length, m = strandMasses(strand).back(), T = 0.1;
  const double rest = -strand.length - m * kG / k * (1.0 - std::cos(std::sqrt(k / m) * T));
  const auto errorOf = [&](double h) {
    WorldDef def;
    def.duration = T;
    def.stepping.step = h;
    const int tip = addStrand(def, strand, about(Vec3::UnitX(), 180.0));
    World world(def);
    world.advance(T);
    return std::abs(world.sample(T).bodies[tip].x.y() - rest);
  };
  const double coarse = errorOf(2e-3), middle = errorOf(1e-3), fine = errorOf(5e-4);
  CAPTURE(coarse, middle, fine, coarse / middle, middle / fine);
  CHECK(fine > 1e-6);
  CHECK(std::abs(coarse / middle - 2.0) <= 0.15);
  CHECK(std::abs(middle / fine - 2.0) <= 0.08);
}

// Oracle: the elastica by another method, order of convergence. Both loads make large turns.
// Measured 1.5e-3 and 2.6e-3 of the length with 16 pieces, ratios of 3.7 and more; the tip creeps
// by 6e-7 m/s yet.
TEST_CASE("a strand bends as a beam under its weight and a load, to second order in its pieces") {
  constexpr double L = 0.1, B = 6e-6, rho = 2e-3;
  const double load = GENERATE(0.0, 2e-3);  // N
  double off[2] = {};
  for (int k = 0; k < 2; ++k) {
    const StrandDef strand{
        .points = 10 + 8 * k, .length = L, .density = rho, .stretch = 2e4, .bend = B};
    WorldDef def;
    def.duration = 8.0;
    def.stepping.step = 0.02;
    def.stepping.linearisations = 10;
    const int tip = addStrand(def, strand, about(Vec3::UnitZ(), -90.0));
    *def.bodies[tip].mass += load / kG;
    World world(def);
    world.advance(def.duration);
    REQUIRE_FALSE(world.report().stopped);
    const Sample end = world.sample(def.duration);
    CHECK(end.bodies[tip].v.norm() <= 1e-5);
    off[k] = (end.bodies[tip].x - tipOfBeam(B, L, rho * kG, load)).norm() / L;
  }
  CAPTURE(load, off[0], off[1]);
  CHECK(off[1] <= 4e-3);
  CHECK(off[0] / off[1] == Approx(4.0).epsilon(0.1));
}

// Oracle: closed form. N equal masses l apart on a string swing with ω² = x g/l, where x is the
// first zero of Laguerre's polynomial L_N; the limit is Bernoulli's chain, ω = j₀₁/2 √(g/L), which
// is N/(N + ½) of it off. Steps of 0.5 ms give 1e-6. Measured 1.6e-6, allowed 1e-5.
TEST_CASE("a chain that hangs swings with the frequency of Laguerre's polynomial") {
  const int pieces = GENERATE(8, 16);
  const double L = 1.0, l = L / pieces;
  const StrandDef chain{
      .points = pieces + 2, .length = L, .density = 1.0, .stretch = 1e7, .bend = 0.0};
  double lo = 0.0,
         hi = 5.9 / (4.0 * pieces + 2.0);  // j₀₁² = 5.78, and the next zero five times that
  for (int k = 0; k < 60; ++k) {
    const double x = 0.5 * (lo + hi);
    (std::laguerre(static_cast<unsigned>(pieces), x) > 0.0 ? lo : hi) = x;
  }
  WorldDef def;
  def.duration = 1.4;
  def.stepping.step = 5e-4;
  const int tip = addStrand(def, chain, about(Vec3::UnitX(), 180.0));
  def.bodies[tip].mass = *def.bodies[tip - 1].mass;
  // It starts in that mode: of mass n from below the place is L_n(x), and of the lowest L_0 = 1.
  for (int n = 0; n < pieces; ++n)
    def.bodies[tip - n].position.x() = 1e-4 * std::laguerre(static_cast<unsigned>(n), lo);
  World world(def);
  std::vector<double> zeros;
  double before = 1e-4;
  for (int n = 1; n <= 2800; ++n) {
    world.advance(n * 5e-4);
    const double x = world.sample(n * 5e-4).bodies[tip].x.x();
    if ((x < 0.0) != (before < 0.0)) zeros.push_back((n - x / (x - before)) * 5e-4);
    before = x;
  }
  REQUIRE(zeros.size() == 2);
  const double omega = 3.14159265358979323846 / (zeros[1] - zeros[0]);
  CAPTURE(pieces, omega / std::sqrt(lo * kG / l) - 1.0);
  CHECK(std::abs(omega / std::sqrt(lo * kG / l) - 1.0) <= 1e-5);
}
