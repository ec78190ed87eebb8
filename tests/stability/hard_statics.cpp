// Hard cases of what stands: on the brink, under loads unlike their bearers, for long.
#include <algorithm>
#include <array>
#include <limits>

#include "sim/shape/convex_hull.h"
#include "tests/gravity.h"
#include "tests/stability/hard_case.h"

namespace tumble::test {
namespace {

using namespace scenes;

constexpr double kSoon = 0.3;  // [s] what slips has gone some 0.4 eps m by then

/// The farthest that a centre of mass has gone from its start, and the run's own word on stopping.
double wayOf(const WorldDef& def, double t) {
  const World world = ranTo(def, t);
  const Sample now = world.sample(t);
  double way = 0.0;
  for (std::size_t i = 0; i < def.bodies.size(); ++i)
    way = std::max(way, (now.bodies[i].x - def.bodies[i].position).norm());
  return unlessStopped(world, way);
}

/// The least of 1e-3, 1e-6 and 1e-9 by which a limit may be missed for both sides to do as they
/// should: still on the safe side, on the way on the other. 1 if not even a
/// thousandth tells.
double bracket(const std::function<WorldDef(double)>& aside, double t) {
  double least = 1.0;
  for (const double eps : {1e-3, 1e-6, 1e-9}) {
    const double safe = wayOf(aside(eps), t), unsafe = wayOf(aside(-eps), t);
    if (!(safe < 1e-2 * eps && unsafe > 0.1 * eps)) break;
    least = eps;
  }
  return least;
}

/// A card that leans at 65° with its foot on the floor and its head at a smooth wall: half of a
/// tent. Moments about the foot's edge: the wall's push H L sin θ = m g (½ L cos θ − ½ d sin θ)
/// against μ m g.
constexpr double kLean = 65.0 * std::numbers::pi / 180.0, kLength = 1.0, kThick = 0.01;
double ladderFriction() {
  return 0.5 / std::tan(kLean) - 0.5 * kThick / kLength;
}

BodyDef card(double mu) {
  const Vec3 up(std::cos(kLean), std::sin(kLean), 0.0), out(-up.y(), up.x(), 0.0);
  BodyDef def = box("card", {kThick, kLength, 0.7},
                    {-0.5 * kLength * up.x(), 0.5 * kLength * up.y(), 0.0}, 0.0, mu);
  def.position += 0.5 * kThick * out;
  def.orientation = fromAxisAngle({0.0, 0.0, 1.0}, kLean - 0.5 * std::numbers::pi);
  return def;
}

/// Half of a tent whose cards are cut upright at their heads, where they lie against each other:
/// the corners of its cross-section, foot first, and its centre.
struct HalfTent {
  std::array<Eigen::Vector2d, 4> corners;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();

  HalfTent() {
    const Eigen::Vector2d foot(-kLength * std::cos(kLean), 0.0),
        head(0.0, kLength * std::sin(kLean));
    const Eigen::Vector2d out(-std::sin(kLean), std::cos(kLean));
    corners = {foot, head, head + Eigen::Vector2d(0.0, kThick / std::cos(kLean)),
               foot + kThick * out};
    double area = 0.0;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d &p = corners[i], &q = corners[(i + 1) % 4];
      const double part = p.x() * q.y() - q.x() * p.y();
      area += part;
      centre += part * (p + q) / 3.0;
    }
    centre /= area;
  }
  /// Moments about the foot: the other card pushes at the highest point, if it must.
  double friction() const { return (centre.x() - corners[0].x()) / corners[2].y(); }

  BodyDef card(const std::string& name, double side, double mu) const {
    std::vector<Vec3> points;
    for (const Eigen::Vector2d& corner : corners)
      for (const double z : {-0.35, 0.35})
        points.emplace_back(side * (corner.x() - centre.x()), corner.y() - centre.y(), z);
    BodyDef def = box(name, Vec3::Ones(), {side * centre.x(), centre.y(), 0.0}, 0.0, mu);
    def.shape = Hull{std::make_shared<const Polyhedron>(convexHull(points))};
    return def;
  }
};

WorldDef tent(double mu) {
  const HalfTent half;
  return worldOf("auto", kSoon,
                 {ground(0.0, mu), half.card("left", 1.0, mu), half.card("right", -1.0, mu)});
}

WorldDef ladder(double mu) {
  BodyDef wall = ground();
  wall.name = "wall";
  wall.shape = HalfSpace{Vec3(-1.0, 0.0, 0.0)};
  return worldOf("auto", kSoon, {ground(0.0, mu), wall, card(mu)});
}

WorldDef unevenTower(int n, double ratio, double t) {
  WorldDef def = worldOf("auto", t, {ground(0.0, 0.5)});
  double mass = 1.0;
  for (int k = 0; k < n; ++k, mass *= ratio) {
    def.bodies.push_back(
        box("box." + std::to_string(k), {1.0, 1.0, 1.0}, {0.0, 0.5 + k, 0.0}, 0.0, 0.5));
    def.bodies.back().density.reset();
    def.bodies.back().mass = mass;
  }
  return def;
}

/// Worst relative error of what the bodies from k on weigh against the force below body k.
double loadError(const WorldDef& def) {
  const World world = ranTo(def, def.duration);
  const Sample now = world.sample(def.duration);
  double worst = 0.0, above = 0.0;
  for (int k = static_cast<int>(def.bodies.size()) - 1; k > 0; --k) {
    above += *def.bodies[k].mass * kG;
    double force = 0.0;
    for (const ContactSample& c : now.contacts)
      if (c.a == k && c.b == k - 1) force += c.force.y();
    worst = std::max(worst, std::abs(force / above - 1.0));
  }
  return unlessStopped(world, worst);
}

}  // namespace

std::vector<HardCase> hardStatics() {
  const double mu = ladderFriction(), tentMu = HalfTent().friction();
  return {
      {"card tent, bracket of μ", "moments about the foot", "1", 1e-6,
       [=] { return bracket([=](double eps) { return tent(tentMu * (1.0 + eps)); }, kSoon); }},
      {"ladder at a smooth wall, bracket of μ", "μ = cot θ/2 − d/2L", "1", 1e-6,
       [=] { return bracket([=](double eps) { return ladder(mu * (1.0 + eps)); }, kSoon); }},
      {"1000 t on 1 kg, force below", "weight above", "1", 1e-9,
       [] { return loadError(unevenTower(2, 1e6, 1.0)); }},
      {"ten cubes, each twice as heavy, forces", "weight above", "1", 1e-9,
       [] { return loadError(unevenTower(10, 2.0, 1.0)); }},
      {"six cubes, each ten times as heavy, forces", "weight above", "1", 1e-9,
       [] { return loadError(unevenTower(6, 10.0, 1.0)); }},
      {"ten cubes, each twice as heavy, drift in a minute", "none", "m", 1e-9,
       [] { return wayOf(unevenTower(10, 2.0, 60.0), 60.0); }},
  };
}

}  // namespace tumble::test
