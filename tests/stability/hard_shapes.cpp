// Hard cases of size: far too small, large, far away, thin or slender.
#include <algorithm>

#include "tests/stability/hard_case.h"

namespace tumble::test {
namespace {

using namespace scenes;

/// A brick that falls, tumbles, bounces and slides, s times as large and √s as slow, its origin
/// elsewhere.
WorldDef brick(double s, const Vec3& origin = Vec3::Zero()) {
  BodyDef def = box("brick", s * Vec3(0.2, 0.1, 0.3), s * Vec3(0.0, 0.6, 0.0) + origin, 0.4, 0.3);
  def.orientation = fromAxisAngle({1.0, 2.0, 3.0}, 0.6);
  def.velocity = std::sqrt(s) * Vec3(1.0, 0.0, 0.5);
  def.angularVelocity = Vec3(1.0, 3.0, -2.0) / std::sqrt(s);
  return worldOf("auto", 0.5 * std::sqrt(s), {ground(0.4, 0.3), def});
}

/// Where it is at the end, in its own size and from its own origin.
Vec3 endPlace(double s, const Vec3& origin = Vec3::Zero()) {
  const WorldDef def = brick(s, origin);
  return (ranTo(def, def.duration).sample(def.duration).bodies[1].x - origin) / s;
}

double scaled(double s) {
  return (endPlace(s) - endPlace(1.0)).norm();
}

double shifted(double by) {
  return (endPlace(1.0, {by, 0.0, by}) - endPlace(1.0)).norm();
}

/// Three boxes on each other, s times as large: how far they go in so many seconds, in their size.
double stackDrift(double s, const Vec3& origin) {
  WorldDef def = worldOf("auto", 2.0, {ground(0.0, 0.5)});
  for (int k = 0; k < 3; ++k)
    def.bodies.push_back(box("box." + std::to_string(k), s * Vec3(0.4, 0.2, 0.3),
                             s * Vec3(0.02 * k, 0.1 + 0.2 * k, 0.0) + origin, 0.0, 0.5));
  const World world = ranTo(def, def.duration);
  double way = 0.0;
  const Sample now = world.sample(def.duration);
  for (std::size_t i = 1; i < def.bodies.size(); ++i)
    way = std::max(way, (now.bodies[i].x - def.bodies[i].position).norm() / s);
  return unlessStopped(world, way);
}

/// Free spin of a slender or flat box: relative change of its energy and its angular momentum in 10
/// s.
double spinError(const Vec3& edges) {
  BodyDef def = box("it", edges, Vec3::Zero());
  def.angularVelocity = {3.0, 5.0, 0.01};
  WorldDef world = worldOf("auto", 10.0, {def});
  world.gravity = Vec3::Zero();
  const World ran = ranTo(world, 10.0);
  const double before = ran.report().certificate.energy_start,
               after = ran.report().certificate.energy_end;
  return unlessStopped(
      ran, std::max(std::abs(after / before - 1.0), ran.report().certificate.momentum_error));
}

/// It falls on the floor: how deep it gets into it, in m.
double fallOverlap(const Vec3& edges) {
  BodyDef def = box("it", edges, {0.0, 0.5, 0.0}, 0.0, 0.3);
  def.orientation = fromAxisAngle({1.0, 0.3, 0.2}, 0.5);
  const World world = ranTo(worldOf("auto", 2.0, {ground(0.0, 0.3), def}), 2.0);
  return unlessStopped(world, world.report().certificate.max_penetration);
}

/// Sheets of a tenth of a millimetre on each other: how far the topmost goes.
double sheets() {
  WorldDef def = worldOf("auto", 2.0, {ground(0.0, 0.5)});
  for (int k = 0; k < 4; ++k)
    def.bodies.push_back(box("sheet." + std::to_string(k), {0.3, 1e-4, 0.2},
                             {0.01 * k, 1e-4 * (k + 0.5), 0.0}, 0.0, 0.5));
  const World world = ranTo(def, 2.0);
  return unlessStopped(world, (world.sample(2.0).bodies[4].x - def.bodies[4].position).norm());
}

/// A beam that lies across another, turned by so little that their edges are nearly parallel: how
/// far it goes.
double crossedBeams(double angle) {
  BodyDef under = box("under", {1.0, 0.1, 0.1}, {0.0, 0.05, 0.0}, 0.0, 0.5), over = under;
  over.name = "over";
  over.position = {0.0, 0.15, 0.0};
  over.orientation = fromAxisAngle({0.0, 1.0, 0.0}, angle);
  const World world = ranTo(worldOf("auto", 2.0, {ground(0.0, 0.5), under, over}), 2.0);
  return unlessStopped(world, (world.sample(2.0).bodies[2].x - over.position).norm());
}

}  // namespace

std::vector<HardCase> hardShapes() {
  const Vec3 far(1e6, 0.0, 1e6);
  return {
      {"bouncing brick, a thousandth as large", "as it is, scaled", "1", 1e-6,
       [] { return scaled(1e-3); }},
      {"bouncing brick, a thousand times as large", "as it is, scaled", "1", 1e-6,
       [] { return scaled(1e3); }},
      {"bouncing brick, 1.4e6 m away, to what touches there", "as it is, shifted", "m", 1e-9,
       [] { return shifted(1e6); }},
      {"three boxes at rest, a thousandth as large", "none moves", "1", 1e-9,
       [] { return stackDrift(1e-3, Vec3::Zero()); }},
      {"three boxes at rest, a thousand times as large", "none moves", "1", 1e-9,
       [] { return stackDrift(1e3, Vec3::Zero()); }},
      {"three boxes at rest, 1.4e6 m away", "none moves", "m", 1e-9,
       [=] { return stackDrift(1.0, far); }},
      {"needle of 1 m × 0.1 mm, its spin for 10 s", "energy, momenta constant", "1", 1e-12,
       [] {
         return spinError({1e-4, 1.0, 1e-4});
       }},
      {"flake of 1 m × 1 m × 0.1 mm, its spin for 10 s", "energy, momenta constant", "1", 1e-12,
       [] {
         return spinError({1.0, 1e-4, 1.0});
       }},
      {"needle that falls flat", "no overlap", "m", 1e-9,
       [] {
         return fallOverlap({1e-3, 0.5, 1e-3});
       }},
      {"flake that falls flat", "no overlap", "m", 1e-9,
       [] {
         return fallOverlap({0.5, 1e-3, 0.5});
       }},
      {"four sheets of 0.1 mm at rest", "none moves", "m", 1e-9, sheets},
      {"beams 1e-7 rad from parallel at rest", "none moves", "m", 1e-9,
       [] { return crossedBeams(1e-7); }},
      {"beams 1e-9 rad from parallel at rest", "none moves", "m", 1e-9,
       [] { return crossedBeams(1e-9); }},
  };
}

}  // namespace tumble::test
