#include "app/claim/fall.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "app/claim/free_body.h"

namespace tumble {

double Fall::hitSpeed() const {
  return std::sqrt(speed * speed + 2.0 * g * height);
}

double Fall::firstHit() const {
  return (speed + hitSpeed()) / g;
}

double Fall::apex(int n) const {
  const double v = hitSpeed() * std::pow(e, n);
  return v * v / (2.0 * g);
}

double Fall::hitTime(int n) const {
  double t = firstHit();
  double v = e * hitSpeed();
  for (int k = 1; k < n; ++k, v *= e) t += 2.0 * v / g;
  return t;
}

double Fall::apexTime(int n) const {
  return hitTime(n) + std::pow(e, n) * hitSpeed() / g;
}

double Fall::restTime() const {
  if (e >= 1.0) return std::numeric_limits<double>::infinity();
  return firstHit() + 2.0 * hitSpeed() / g * e / (1.0 - e);
}

double Fall::heightAt(double t) const {
  double begin = 0.0, h = height, v = speed, end = firstHit();
  double leaving = e * hitSpeed();
  // From arc to arc, until the one that holds t, or rest.
  while (t > end) {
    if (t >= restTime() || leaving < 1e-9) return 0.0;
    begin = end;
    h = 0.0;
    v = leaving;
    end = begin + 2.0 * v / g;
    leaving *= e;
  }
  const double s = t - begin;
  return std::max(0.0, h + v * s - 0.5 * g * s * s);
}

namespace {

// Whether an impulse along n at the contact passes through the centre of mass: an axis stands along
// n or, for the round sides, across it.
bool landsCentred(const BodyDef& body, const Vec3& n) {
  constexpr double kRounding = 1e-9;
  const Vec3 n_B = body.orientation.conjugate() * n;
  if (std::holds_alternative<Sphere>(body.shape)) return true;
  if (std::holds_alternative<Box>(body.shape)) return n_B.cwiseAbs().maxCoeff() > 1.0 - kRounding;
  const double along = std::abs(n_B.y());
  return along > 1.0 - kRounding || along < kRounding;
}

std::optional<Fall> fallOnto(const WorldDef& world, int body, int floor) {
  const BodyDef& faller = world.bodies[body];
  const HalfSpace* plane = std::get_if<HalfSpace>(&world.bodies[floor].shape);
  const std::optional<Vec3> acceleration = freeAcceleration(world, body);
  if (!plane || !acceleration || !landsCentred(faller, plane->n)) return {};
  if (!world.bodies[floor].velocity.isZero()) return {};

  const Surface surface = surfaceOf(world, body, floor);
  Fall fall{body, floor, plane->n};
  fall.g = -plane->n.dot(*acceleration);
  fall.height = std::max(0.0, plane->n.dot(faller.position) - plane->d -
                                  reach(faller.shape, faller.orientation, Vec3(-plane->n)));
  fall.speed = plane->n.dot(faller.velocity);
  fall.e = surface.restitution;
  fall.mu = surface.friction;
  fall.glide = faller.velocity - fall.speed * plane->n;
  fall.glideAcceleration = *acceleration + fall.g * plane->n;
  if (fall.g <= 0.0 || fall.hitSpeed() < 1e-6) return {};
  if (fall.rubs() && !std::holds_alternative<Sphere>(faller.shape)) return {};
  return fall;
}

}  // namespace

std::vector<Fall> fallsOf(const Scene& scene) {
  const WorldDef& world = scene.world;
  std::vector<Fall> falls;
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body) {
    if (!moves(world.bodies[body]) || !world.bodies[body].angularVelocity.isZero()) continue;
    // The floor it meets first.
    std::optional<Fall> first;
    for (int floor = 0; floor < static_cast<int>(world.bodies.size()); ++floor) {
      const std::optional<Fall> fall = fallOnto(world, body, floor);
      if (fall && (!first || fall->firstHit() < first->firstHit())) first = fall;
    }
    if (first) falls.push_back(*first);
  }
  return falls;
}

}  // namespace tumble
