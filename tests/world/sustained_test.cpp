// Contacts that last while their forces change, in the exact method.
#include <algorithm>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

constexpr double kG = 9.81, kPi = 3.14159265358979323846;

WorldDef exactWorld(double duration) {
  WorldDef def;
  def.method = "exact";
  def.duration = duration;
  return def;
}

/// The end of a run, and what it says of itself.
Sample endOf(const WorldDef& def, Report* report = nullptr) {
  World world(def);
  const Sample end = run(world);
  const Certificate& books = world.report().certificate;
  INFO(world.report().reason);
  for (const std::string& note : world.report().notes) WARN(note);
  CHECK_FALSE(world.report().stopped);
  CHECK(books.energy_balance_error < 1e-10);
  CHECK(books.max_penetration < 1e-11);
  WARN("steps " << books.steps << ", evaluations " << books.evaluations << ", energy "
                << books.energy_balance_error << ", penetration " << books.max_penetration
                << ", momentum " << books.momentum_error);
  if (report) *report = world.report();
  return end;
}

BodyDef slope(double angle, double mu, double about = 0.0) {
  BodyDef def = ground(0.0, mu);
  def.shape = HalfSpace{
      {std::sin(angle) * std::cos(about), std::cos(angle), -std::sin(angle) * std::sin(about)},
      0.0};
  return def;
}

BodyDef blockOn(double angle, const Vec3& edges, double mu, double about = 0.0) {
  const Quat turn = fromAxisAngle({0.0, 1.0, 0.0}, about) * fromAxisAngle({0.0, 0.0, 1.0}, -angle);
  BodyDef def = box("block", edges, turn * Vec3(0.0, 0.5 * edges.y(), 0.0), 0.0, mu);
  def.orientation = turn;
  return def;
}

}  // namespace

// Oracle: t = 2 v0/(7 mu g), v = 5 v0/7, d = 12 v0²/(49 mu g).
TEST_CASE("a ball that slides comes to roll", "[figures]") {
  const auto [v0, mu, r] =
      GENERATE(std::tuple{5.0, 0.3, 0.1}, std::tuple{2.0, 0.05, 1.0}, std::tuple{11.0, 1.7, 0.02});
  WorldDef def = exactWorld(6.0);
  def.bodies = {ground(0.0, mu), ball("ball", r, {0.0, r, 0.0}, 0.0, mu)};
  def.bodies[1].velocity = {v0, 0.0, 0.0};
  Report report;
  const double t = 2.0 * v0 / (7.0 * mu * kG), v = 5.0 * v0 / 7.0;
  def.duration = 3.0 * t;
  const double d = 12.0 * v0 * v0 / (49.0 * mu * kG);
  const Sample end = endOf(def, &report);
  for (const Event& e : report.events) WARN(eventName(e.kind) << " at " << e.t - t);
  WARN("slide to roll: v " << end.bodies[1].v.x() - v << ", d "
                           << end.bodies[1].x.x() - d - v * 2.0 * t);
  CHECK(std::abs(end.bodies[1].v.x() - v) < 1e-11);
}

TEST_CASE("a ball rolls down", "[figures]") {
  const double angle = 30.0 * kPi / 180.0;
  for (const double mu : {0.5, 0.1}) {
    WorldDef def = exactWorld(2.0);
    const Vec3 n(std::sin(angle), std::cos(angle), 0.0), s(std::cos(angle), -std::sin(angle), 0.0);
    def.bodies = {slope(angle, mu), ball("ball", 0.1, 0.1 * n, 0.0, mu)};
    const Sample end = endOf(def);
    const double a =
        mu > 0.2 ? 5.0 / 7.0 * kG * std::sin(angle) : kG * (std::sin(angle) - mu * std::cos(angle));
    WARN("rolling down: " << (end.bodies[1].x - 0.1 * n).dot(s) - 0.5 * a * 4.0 << " v "
                          << end.bodies[1].v.dot(s) - 2.0 * a << " gap "
                          << end.bodies[1].x.dot(n) - 0.1);
    CHECK(std::abs((end.bodies[1].x - 0.1 * n).dot(s) - 0.5 * a * 4.0) < 1e-11);
  }
}

TEST_CASE("a ball on a turntable", "[figures]") {
  WorldDef def = exactWorld(0.0);
  const double Omega = 2.0, period = 2.0 * kPi / (2.0 / 7.0 * Omega);
  def.duration = 3.0 * period;
  BodyDef table;
  table.name = "table";
  table.shape = Cylinder{5.0, 0.2};
  table.position = {0.0, -0.1, 0.0};
  table.fixed = true;
  table.friction = 1.0;
  table.angularVelocity = {0.0, Omega, 0.0};
  def.bodies = {table, ball("ball", 0.1, {1.0, 0.1, 0.0}, 0.0, 1.0)};
  def.bodies[1].velocity = {0.3, 0.0, 0.2};
  // Rolls: v + omega x (-r n) = Omega x p.
  const Vec3 n(0.0, 1.0, 0.0),
      slip = Vec3(0.3, 0.0, 0.2) - Vec3(0.0, Omega, 0.0).cross(Vec3(1.0, 0.0, 0.0));
  def.bodies[1].angularVelocity = n.cross(slip) / 0.1;
  const Sample end = endOf(def);
  WARN("turntable: closes to " << (end.bodies[1].x - def.bodies[1].position).norm());
  CHECK((end.bodies[1].x - def.bodies[1].position).norm() < 1e-8);
}

TEST_CASE("Euler's disk", "[figures]") {
  WorldDef def = exactWorld(10.0);
  const double alpha = 10.0 * kPi / 180.0, a = 1.0, h = 1e-6;
  const double Omega = std::sqrt(4.0 * kG / (a * std::sin(alpha)));
  BodyDef disk;
  disk.name = "disk";
  disk.shape = Cylinder{a, h};
  disk.mass = 1.0;
  disk.inertia = Vec3(0.25, 0.5, 0.25);
  disk.friction = 1.0;
  disk.orientation = fromAxisAngle({0.0, 0.0, 1.0}, alpha);
  const Vec3 u = disk.orientation * Vec3(0.0, 1.0, 0.0);
  // The lowest point of the lower cap is at -x.
  const Vec3 low = disk.orientation * Vec3(-a, -0.5 * h, 0.0);
  disk.position = {0.0, -low.y(), 0.0};
  // Turns about the diameter through the contact, so that centre and contact are at rest.
  const Vec3 e3 = (disk.orientation * Vec3(1.0, 0.0, 0.0));
  disk.angularVelocity = Omega * std::sin(alpha) * e3;
  def.bodies = {ground(0.0, 1.0), disk};
  const Sample end = endOf(def);
  const Vec3 axis = end.bodies[1].q * Vec3(0.0, 1.0, 0.0);
  const double drift = std::acos(axis.y()) - alpha;
  WARN("Euler's disk: alpha drifts " << drift << " centre "
                                     << (end.bodies[1].x - disk.position).norm());
  CHECK(std::abs(drift) < 1e-8);
  (void)u;
}

TEST_CASE("brackets of a block on a slope", "[figures]") {
  for (const double degrees : {10.0, 30.0, 50.0})
    for (const double about : {0.0, 1.1})
      for (const double side : {1.0 + 1e-6, 1.0 - 1e-6}) {
        const double angle = degrees * kPi / 180.0, mu = std::tan(angle) * side;
        WorldDef def = exactWorld(2.0);
        def.bodies = {slope(angle, mu, about), blockOn(angle, {1.0, 0.2, 0.6}, mu, about)};
        const Sample end = endOf(def);
        const double way = (end.bodies[1].x - def.bodies[1].position).norm();
        const double d = 0.5 * kG * std::cos(angle) * (std::tan(angle) - mu) * 4.0;
        WARN(degrees << " " << side << ": " << way << " of " << d);
        if (side > 1.0)
          CHECK(way < 1e-9);
        else
          CHECK(way == Approx(d).epsilon(0.01));
      }
}

TEST_CASE("a box pushed under balls", "[figures]") {
  const int n = 5;
  const double M = 10.0, m = 1.0, F = 150.0, mu1 = 0.4, mu2 = 0.8, T = 4.0;
  WorldDef def = exactWorld(T);
  BodyDef base = box("box", {20.0, 1.0, 20.0}, {0.0, 0.5, 0.0}, 0.0, 0.4);
  base.density.reset();
  base.mass = M;
  base.material = "box";
  BodyDef floor = ground(0.0, 0.4);
  floor.material = "floor";
  def.bodies = {floor, base};
  for (int i = 0; i < n * n; ++i) {
    BodyDef b = ball("b" + std::to_string(i), 0.5, {2.0 * (i % n - 2), 1.5, 2.0 * (i / n - 2)});
    b.material = "ball";
    def.bodies.push_back(b);
  }
  def.pairs = {{"box", "floor", {}, mu1}, {"box", "ball", {}, mu2}};
  def.forces = {PointForce{1, Vec3::Zero(), {0.0, 0.0, F}}};
  const double f1 = mu1 * (M + n * n * m) * kG, f2 = ((F - f1) / M) / (3.5 / m + n * n / M);
  const double aBox = (F - f1 - n * n * f2) / M, aBall = f2 / m;
  const Sample end = endOf(def);
  double error = 0.0;
  for (std::size_t i = 1; i < end.bodies.size(); ++i)
    error += (end.bodies[i].v - Vec3(0.0, 0.0, (i == 1 ? aBox : aBall) * T)).squaredNorm();
  WARN("SimBenchmark rolling: " << error / (n * n + 1) << " a_box " << aBox << " a_ball " << aBall);
  CHECK(error / (n * n + 1) < 1e-20);
}

TEST_CASE("a jammed rod", "[figures]") {
  for (const double mu : {1.33, 4.0 / 3.0 - 1e-9, 4.0 / 3.0 + 1e-9, 1.5}) {
    WorldDef def = exactWorld(0.2);
    const double angle = std::atan(2.0), l = 1.0;
    BodyDef rod;
    rod.name = "rod";
    rod.shape = Capsule{1e-12, 2.0 * l};
    rod.mass = 1.0;
    rod.inertia = Vec3(l * l / 3.0, 1e-4, l * l / 3.0);
    rod.friction = mu;
    rod.orientation = fromAxisAngle({0.0, 0.0, 1.0}, -(kPi / 2.0 - angle));
    rod.position = {0.0, l * std::sin(angle) + 1e-12, 0.0};
    rod.velocity = {1.0, 0.0, 0.0};
    def.bodies = {ground(0.0, mu), rod};
    for (const double sign : {-1.0, 1.0}) {
      def.bodies[1].velocity.x() = sign;
      Report report;
      endOf(def, &report);
      for (const Event& e : report.events)
        WARN(mu << " " << sign << ": " << eventName(e.kind) << " at " << e.t << " vrel " << e.vrel
                << " j " << e.j);
    }
  }
}

TEST_CASE("toppling", "[figures]") {
  for (const double side : {1.0 + 1e-6, 1.0 - 1e-6}) {
    // Topples down the slope if its width is less than tan(angle) times its height.
    const double angle = 20.0 * kPi / 180.0, height = 1.0, width = std::tan(angle) * height * side;
    WorldDef def = exactWorld(10.0);
    def.bodies = {slope(angle, 0.9), blockOn(angle, {width, height, 0.5}, 0.9)};
    Report report;
    const Sample end = endOf(def, &report);
    const double turn = end.bodies[1].q.angularDistance(def.bodies[1].orientation);
    WARN("topple " << side << ": turned by " << turn);
    for (std::size_t k = 0; k < std::min<std::size_t>(8, report.events.size()); ++k)
      WARN(eventName(report.events[k].kind)
           << " at " << report.events[k].t << " vrel " << report.events[k].vrel);
    CHECK((turn < 1e-6) == (side > 1.0));
  }
}

TEST_CASE("a leaning plank", "[figures]") {
  for (const double side : {1.0 + 1e-6, 1.0 - 1e-6}) {
    const double lean = 60.0 * kPi / 180.0;
    WorldDef def = exactWorld(10.0);
    const Vec3 edges(3.0, 0.1, 0.5);
    BodyDef plank = box("plank", edges, {0.0, 0.0, 0.0});
    plank.orientation = fromAxisAngle({0.0, 0.0, 1.0}, lean);
    const Vec3 lowB = plank.orientation * Vec3(-1.5, -0.05, 0.0),
               highU = plank.orientation * Vec3(1.5, -0.05, 0.0);
    const Vec3 farU = plank.orientation * Vec3(1.5, -0.05, 0.0);
    (void)farU;
    const double mu = -lowB.x() / (highU.y() - lowB.y());
    plank.position = {-highU.x(), -lowB.y(), 0.0};
    BodyDef wall = ground(0.0, 0.0), floor = ground(0.0, mu * side);
    wall.name = "wall";
    wall.shape = HalfSpace{{-1.0, 0.0, 0.0}, 0.0};
    plank.friction = mu * side;
    plank.material = "plank";
    wall.material = "wall";
    def.pairs = {{"plank", "wall", {}, 0.0}};
    def.bodies = {floor, wall, plank};
    Report report;
    const Sample end = endOf(def, &report);
    WARN("plank " << side << " mu " << mu << ": moved by "
                  << (end.bodies[2].x - plank.position).norm());
    for (std::size_t k = 0; k < std::min<std::size_t>(20, report.events.size()); ++k)
      WARN(eventName(report.events[k].kind)
           << " " << report.events[k].a << report.events[k].b << " at " << report.events[k].t
           << " vrel " << report.events[k].vrel);
    CHECK(((end.bodies[2].x - plank.position).norm() < 1e-6) == (side > 1.0));
  }
}
