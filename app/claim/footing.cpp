#include "app/claim/footing.h"

#include <cmath>
#include <limits>

namespace tumble {

namespace {

bool standsStill(const BodyDef& body) {
  return !moves(body) && body.velocity.isZero() && body.angularVelocity.isZero();
}

}  // namespace

double Footing::degrees() const {
  return std::atan2(downhill.norm(), into) * 180.0 / EIGEN_PI;
}

bool Footing::straight() const {
  return slip.cross(downhill).norm() <= kStill * (slip.norm() + downhill.norm());
}

Vec3 Footing::acceleration() const {
  if (slides()) return downhill - mu * into * slip.normalized();
  if (!holds()) return downhill - mu * into * downhill.normalized();
  return downhill * (mobility - 1.0) / mobility;
}

double Footing::stops() const {
  const double rate = mu * into * mobility - downhill.dot(slip.normalized());
  return rate > 0.0 ? slip.norm() / rate : std::numeric_limits<double>::infinity();
}

Footing Footing::stuck() const {
  Footing footing = *this;
  footing.slip.setZero();
  return footing;
}

Footing footingOf(const Scene& scene, const Sample& sample, int body, const Vec3& gravity) {
  const BodyDef& def = scene.world.bodies[body];
  const BodySample& seen = sample.bodies[body];
  Footing footing;
  for (const ContactSample& contact : sample.contacts) {
    if (contact.a != body && contact.b != body) continue;
    const int other = contact.a == body ? contact.b : contact.a;
    const Vec3 n = contact.a == body ? contact.n : Vec3(-contact.n);
    const bool second = footing.ground != kNoBody &&
                        (footing.ground != other || footing.n.cross(n).norm() > Footing::kStill);
    if (second || !standsStill(scene.world.bodies[other])) return {};
    footing.ground = other;
    footing.n = n;
  }
  const Sphere* ball = std::get_if<Sphere>(&def.shape);
  if (footing.ground == kNoBody || (!ball && seen.omega.norm() > Footing::kStill)) return {};
  footing.into = -gravity.dot(footing.n);
  footing.downhill = gravity + footing.into * footing.n;
  footing.mu = surfaceOf(scene.world, body, footing.ground).friction;
  footing.slip = seen.v;
  if (ball) {
    footing.slip -= ball->r * seen.omega.cross(footing.n);
    const MassProperties mass = massOf(def);
    footing.mobility = 1.0 + mass.mass * ball->r * ball->r / mass.inertia(0, 0);
  }
  footing.slip -= footing.n * footing.n.dot(footing.slip);
  return footing;
}

Event nextEvent(const Recording& recording, int body, double t) {
  for (const Event& event : recording.report.events)
    if (event.t > t && (event.a == body || event.b == body)) return event;
  Event never;
  never.t = std::numeric_limits<double>::infinity();
  return never;
}

double grain(const Scene& scene) {
  return scene.world.method == "stepping" ? scene.world.stepping.step : 0.0;
}

}  // namespace tumble
