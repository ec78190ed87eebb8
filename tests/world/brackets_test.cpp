// Scenes on the brink: what stands just above a limit of statics falls just below it.
#include <algorithm>
#include <ctime>

#include "sim/shape/convex_hull.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// How far the bodies that moved most are from their start, and what the run says of itself.
struct Outcome {
  double way = 0.0;   ///< [m]
  double turn = 0.0;  ///< [rad]
  Report report = {};
};

Outcome wayOf(const WorldDef& def, const Sample& now) {
  Outcome outcome;
  for (std::size_t i = 0; i < def.bodies.size(); ++i) {
    const BodyDef& start = def.bodies[i];
    outcome.way = std::max(outcome.way, (now.bodies[i].x - start.position).norm());
    outcome.turn = std::max(outcome.turn, now.bodies[i].q.angularDistance(start.orientation));
  }
  return outcome;
}

Outcome outcomeOf(const WorldDef& def) {
  World world(def);
  Outcome outcome = wayOf(def, run(world));
  outcome.report = world.report();
  return outcome;
}

/// Holds both sides of a limit: nothing moves on the safe one, and on the other something goes far.
void checkSides(const std::string& name, const Outcome& safe, const Outcome& unsafe, double far) {
  const double residual = safe.report.certificate.max_complementarity;
  WARN(name << ": " << safe.way << " m and " << safe.turn << " rad on the safe side, residual "
            << residual << "; " << unsafe.way << " m on the other");
  CHECK_FALSE(safe.report.stopped);
  CHECK_FALSE(unsafe.report.stopped);
  CHECK(safe.way < 1e-9);
  CHECK(safe.turn < 1e-9);
  CHECK(residual < 1e-10);
  CHECK(unsafe.way > far);
}

/// Rises towards −x.
BodyDef slope(double angle, double mu) {
  BodyDef def = ground(0.0, mu);
  def.shape = HalfSpace{Vec3(std::sin(angle), std::cos(angle), 0.0)};
  return def;
}

WorldDef blockOnSlope(const char* method, double angle, const Vec3& edges, double mu) {
  const Quat turn = fromAxisAngle({0.0, 0.0, 1.0}, -angle);
  BodyDef block = box("block", edges, turn * Vec3(0.0, 0.5 * edges.y(), 0.0), 0.0, mu);
  block.orientation = turn;
  return worldOf(method, 10.0, {slope(angle, mu), block});
}

/// Books on the edge of a table, which ends at x = 0: book k from the top stands out over the next
/// by L/(2k) times `side`.
WorldDef bookStack(const char* method, int n, double side, double duration) {
  const double L = 0.3, height = 0.04, mu = 0.5;
  BodyDef table = box("table", {2.0, 0.2, 1.0}, {-1.0, -0.1, 0.0}, 0.0, mu);
  table.fixed = true;
  WorldDef def = worldOf(method, duration, {table});
  double end = 0.0;
  for (int k = n; k >= 1; --k) {
    end += side * L / (2.0 * k);
    def.bodies.push_back(box("book." + std::to_string(k), {L, height, 0.2},
                             {end - 0.5 * L, height * (n - k + 0.5), 0.0}, 0.0, mu));
  }
  return def;
}

/// Radii [m] of a semicircular arch of mean radius 1 m, whose n stones are wedges with flat sides:
/// their corners lie on the circles of the two radii.
struct Arch {
  int n;
  double thickness;
  double inner() const { return 1.0 - 0.5 * thickness; }
  double outer() const { return 1.0 + 0.5 * thickness; }
  double halfAngle() const { return 0.5 * kPi / n; }
  double squares() const { return outer() * outer() - inner() * inner(); }
  double cubes() const { return std::pow(outer(), 3) - std::pow(inner(), 3); }
  /// Distance of a stone's centre from that of the arch.
  double centre() const { return 2.0 / 3.0 * std::cos(halfAngle()) * cubes() / squares(); }
};

/// Whether a line of thrust fits into one half of an arch: at each joint the crown's push, H with
/// the moment K about the centre, and the weights above turn one way about the joint's inner end
/// and the other way about its outer end. Both bound K from a side, linearly in H.
bool thrustFits(const Arch& arch) {
  const int joints = (arch.n + 1) / 2;
  const auto room = [&](double H) {
    double least = -1e300, most = 1e300, weight = 0.5, moment = 0.0;
    moment = 0.5 * std::sin(arch.halfAngle()) / 3.0 * arch.cubes() / arch.squares();
    for (int i = 0; i < joints; ++i) {
      const double angle = (2 * i + 1) * arch.halfAngle();  // from the vertical
      const auto K = [&](double r) {
        return H * r * std::cos(angle) + weight * r * std::sin(angle) - moment;
      };
      least = std::max(least, K(arch.inner()));
      most = std::min(most, K(arch.outer()));
      weight += 1.0;
      moment += arch.centre() * std::sin(angle + arch.halfAngle());
    }
    return most - least;
  };
  double low = 0.0, high = 0.5 * arch.n;
  for (int i = 0; i < 200; ++i) {  // the room is concave in H
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    (room(a) < room(b) ? low : high) = room(a) < room(b) ? a : b;
  }
  return room(0.5 * (low + high)) >= 0.0;
}

double leastThickness(int n) {
  double low = 0.01, high = 0.5;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (thrustFits({n, middle}) ? high : low) = middle;
  }
  return high;
}

BodyDef stoneOf(const Arch& arch, int k) {
  const double middle = (2 * k + 1) * arch.halfAngle();
  const Vec3 x(arch.centre() * std::cos(middle), arch.centre() * std::sin(middle), 0.0);
  std::vector<Vec3> corners;
  for (const double r : {arch.inner(), arch.outer()})
    for (const int side : {k, k + 1})
      for (const double z : {-0.2, 0.2}) {
        const double angle = 2 * side * arch.halfAngle();
        corners.push_back(Vec3(r * std::cos(angle), r * std::sin(angle), z) - x);
      }
  BodyDef def;
  def.name = "stone." + std::to_string(k);
  def.shape = Hull{std::make_shared<const Polyhedron>(convexHull(corners))};
  def.density = 2000.0;
  def.position = x;
  def.friction = 1.0;
  return def;
}

WorldDef archOf(const char* method, const Arch& arch, double duration) {
  WorldDef def = worldOf(method, duration, {ground(0.0, 1.0)});
  for (int k = 0; k < arch.n; ++k) def.bodies.push_back(stoneOf(arch, k));
  return def;
}

/// Six storeys of eight beams on end with nine blocks across them, loose, of 10 kg each.
WorldDef blockTower(double duration) {
  WorldDef def = worldOf("stepping", duration, {ground(0.0, 0.8)});
  def.stepping.step = 0.01;
  const auto add = [&](const Vec3& edges, const Vec3& x) {
    BodyDef block = box("block." + std::to_string(def.bodies.size()), edges, x, 0.0, 0.8);
    block.density.reset();
    block.mass = 10.0;
    def.bodies.push_back(block);
  };
  for (int storey = 0; storey < 6; ++storey) {
    const double y = 0.2 * storey + 0.05;
    for (int j = 0; j < 8; ++j) add({0.05, 0.1, 0.25}, {0.2 * j, y, 0.0});
    for (const double x : {0.1, 0.5, 0.9, 1.3}) add({0.2, 0.1, 0.05}, {x, y + 0.1, -0.1});
    for (const double x : {0.1, 0.3, 0.7, 1.1, 1.3}) add({0.2, 0.1, 0.05}, {x, y + 0.1, 0.1});
  }
  return def;
}

}  // namespace

// Oracle: Coulomb's law, mu = tan θ; below it the way is ½ g cos θ (tan θ − mu) t². Measured 0 m,
// and 0.05 % more than that way, a step early; allowed 1e-9 m and 1 %.
TEST_CASE("stepping: a block sticks or slides to a millionth of its friction for ten seconds",
          "[figures]") {
  const double angle = 25.0 * kPi / 180.0;
  const auto outcome = [&](double side) {
    return outcomeOf(blockOnSlope("stepping", angle, {0.4, 0.2, 0.3}, side * std::tan(angle)));
  };
  const Outcome slides = outcome(1.0 - 1e-6);
  checkSides("block that slides", outcome(1.0 + 1e-6), slides, 0.0);
  CHECK(slides.way == Approx(0.5 * 9.81 * std::sin(angle) * 1e-6 * 100.0).epsilon(0.01));
}

// Oracle: it topples if its width is less than tan θ times its height, and ends on its side.
// Measured 0 m; a quarter turn to 1e-8 rad, allowed 1e-6.
TEST_CASE("stepping: a block on a slope stands or topples to a millionth of its width",
          "[figures]") {
  const double angle = 20.0 * kPi / 180.0;
  const auto outcome = [&](double side) {
    return outcomeOf(blockOnSlope("stepping", angle, {std::tan(angle) * side, 1.0, 0.5}, 0.9));
  };
  const Outcome topples = outcome(1.0 - 1e-6);
  checkSides("block that topples", outcome(1.0 + 1e-6), topples, 0.3);
  CHECK(topples.turn == Approx(0.5 * kPi).epsilon(1e-6));
}

// Oracle: μc = (C.x − B.x)/(U.y − B.y), C its centre, B and U its corners on floor and wall.
// Measured 0 m and 1.49 m in 10 s: it lies on the floor.
TEST_CASE("stepping: a plank against a smooth wall stands or slides to a millionth of its friction",
          "[figures]") {
  checkSides("plank", outcomeOf(leaningPlank("stepping", 1.0 + 1e-6)),
             outcomeOf(leaningPlank("stepping", 1.0 - 1e-6)), 1.0);
}

// Oracle: the harmonic overhang. Measured in 10 s: 2e-13 m on the safe side, 270 m on the other,
// off the table.
TEST_CASE("stepping: ten books stand or fall to a millionth of their overhang", "[figures]") {
  checkSides("ten books", outcomeOf(bookStack("stepping", 10, 1.0 - 1e-6, 10.0)),
             outcomeOf(bookStack("stepping", 10, 1.0 + 1e-6, 10.0)), 0.1);
}

// The same without steps: from the first instant the books stand for good, or tip. Measured 0 m in
// 10 s on the safe side, 2.8e-7 m in the first 0.2 s on the other.
TEST_CASE("exact: ten books stand or begin to fall to a millionth of their overhang", "[figures]") {
  checkSides("ten books, exact", outcomeOf(bookStack("exact", 10, 1.0 - 1e-6, 10.0)),
             outcomeOf(bookStack("exact", 10, 1.0 + 1e-6, 0.2)), 1e-7);
}

// Oracle: limit analysis, a line of thrust that fits into the arch; for eleven stones t/R is
// 0.104589. Measured in 10 s: 3e-13 m on the safe side, and 0.9 m on the other, in pieces.
TEST_CASE("stepping: an arch stands or falls to a thousandth of its least thickness", "[figures]") {
  const double least = leastThickness(11);
  CHECK(least == Approx(0.104589).epsilon(5e-6));
  checkSides("arch", outcomeOf(archOf("stepping", {11, least * (1.0 + 1e-3)}, 10.0)),
             outcomeOf(archOf("stepping", {11, least * (1.0 - 1e-3)}, 10.0)), 0.5);
}

// The same without steps, until a tenth of a metre is lost. Measured 0 m, and 0.14 m in 0.9 s.
TEST_CASE("exact: an arch stands or falls to a thousandth of its least thickness",
          "[long][figures]") {
  const double least = leastThickness(11);
  checkSides("arch, exact", outcomeOf(archOf("exact", {11, least * (1.0 + 1e-3)}, 10.0)),
             outcomeOf(archOf("exact", {11, least * (1.0 - 1e-3)}, 0.9)), 0.1);
}

// Oracle: what stands at rest stays. Six storeys of 17 blocks (SimBenchmark, "Kapla": 10 kg, step
// 0.01 s). Measured in ten minutes: drift 2.4e-17 m, allowed 1e-9; 0.14 ms of CPU time a
// step.
TEST_CASE("a tower of 102 loose blocks stands for ten minutes", "[long][figures]") {
  const WorldDef def = blockTower(600.0);
  World world(def);
  const std::clock_t start = std::clock();
  double drift = 0.0;
  for (int k = 1; k <= 600; ++k) {
    world.advance(k);
    drift = std::max(drift, wayOf(def, world.sample(k)).way);
  }
  const double cpu = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  WARN("tower of 102 blocks, 600 s: drift " << drift << " m, " << cpu << " CPU s");
  CHECK(drift < 1e-9);
}
