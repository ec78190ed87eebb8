#include "app/present/touch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "app/claim/free_body.h"
#include "app/present/digits.h"
#include "app/present/named.h"
#include "app/present/palette.h"
#include "sim/body/rigid_body.h"
#include "sim/world.h"

namespace tumble {

namespace {

// Slower along the normal than this [m/s], or than this share of the fastest point that slides,
// what touches rests: no arrow shows less, and steps leave as much.
constexpr double kResting = 1e-6, kShareAtRest = 1e-3;

std::string kindOf(double approach, double resting) {
  if (approach < -resting) return "colliding: n·ṗ < 0";
  return approach > resting ? "separating: n·ṗ > 0" : "resting: n·ṗ = 0";
}

// At the start also of what touches and parts at once, which no method keeps as a contact.
std::vector<ContactSample> touching(const Scene& scene, const Sample& sample) {
  return sample.t == 0.0 ? World::checkStart(scene.world).sample.contacts : sample.contacts;
}

}  // namespace

void addContactVelocities(const Scene& scene, const Sample& sample, double length,
                          Picture& picture) {
  const std::vector<RigidBody> bodies = bodiesAt(scene.world, sample);
  struct Worst {
    Vec3 p = Vec3::Zero();
    double approach = 0.0;
  };
  std::map<std::pair<int, int>, Worst> worst;
  double fastest = 0.0;
  const auto velocityAt = [&](const ContactSample& c) {
    return Vec3(pointVelocity(bodies[c.a], c.p) - pointVelocity(bodies[c.b], c.p));
  };
  const std::vector<ContactSample> contacts = touching(scene, sample);
  for (const ContactSample& c : contacts) fastest = std::max(fastest, velocityAt(c).norm());
  std::vector<Vec3> drawn;  // of points that would cover each other, the first
  for (const ContactSample& c : contacts) {
    const Vec3 velocity = velocityAt(c);
    const double approach = c.n.dot(velocity);
    if (std::any_of(drawn.begin(), drawn.end(),
                    [&](const Vec3& p) { return (p - c.p).norm() < 0.1 * length; }))
      continue;
    drawn.push_back(c.p);
    addNamedArrow(c.p, length * c.n, colour::kInk, "n", picture, true);
    if (fastest > kResting)
      addNamedArrow(c.p, length / fastest * velocity, colour::kVelocity, "ṗ", picture);
    const auto [pair, first] = worst.insert({{c.a, c.b}, {c.p, approach}});
    if (!first && approach < pair->second.approach) pair->second = {c.p, approach};
  }
  const double resting = std::max(kResting, kShareAtRest * fastest);
  for (const auto& [pair, at] : worst) {
    const double tidy = std::abs(at.approach) <= resting ? 0.0 : at.approach;
    picture.marks.push_back(
        {at.p, {kindOf(at.approach, resting), fourDigits(tidy) + " m/s"}, colour::kForce});
  }
}

void addImpulses(const Recording& recording, double t, double length, Picture& picture) {
  double largest = 0.0;
  for (const Event& event : recording.report.events)
    if (event.kind == EventKind::Impact) largest = std::max(largest, event.j);
  for (const Event& event : recording.report.events)
    if (event.kind == EventKind::Impact && event.t <= t && event.j > 0.02 * largest)
      addNamedArrow(event.p, length * event.j / largest * event.n, colour::kForce, "j n", picture);
}

void addSprings(const Scene& scene, const Sample& sample, double length, Picture& picture) {
  constexpr int kTurns = 7;
  const Vec3 sight = picture.camera.target - picture.camera.eye;
  for (const BodyDef& ground : scene.world.bodies) {
    const HalfSpace* plane = std::get_if<HalfSpace>(&ground.shape);
    if (!plane) continue;
    const Vec3 across = 0.16 * length * sight.cross(plane->n).normalized();
    for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
      const BodyDef& body = scene.world.bodies[i];
      if (!moves(body)) continue;
      const double height = plane->n.dot(sample.bodies[i].x);
      const double lowest = height - reach(body.shape, sample.bodies[i].q, -plane->n);
      const double foot = plane->d - length;
      const double top = std::max(foot, std::min(plane->d, lowest));
      const Vec3 below = sample.bodies[i].x - height * plane->n;
      Polyline coil;
      coil.width = 2.2f;
      for (int k = 0; k <= 2 * kTurns; ++k) {
        const double side = k == 0 || k == 2 * kTurns ? 0.0 : k % 2 ? 1.0 : -1.0;
        const double up = foot + (top - foot) * k / (2.0 * kTurns);
        coil.points.emplace_back(below + up * plane->n + side * across);
      }
      picture.lines.push_back(std::move(coil));
    }
  }
}

void addGel(double height, double thickness, const Vec3& centre, double radius, Picture& picture) {
  Instance slab;
  slab.position = {centre.x(), height - 0.5 * thickness, centre.z()};
  slab.scale = {0.8 * radius, 0.5 * thickness, 0.25 * radius};
  slab.colour = hex(0x3F9C8C);
  slab.finish = Finish::Glass;
  picture.instances.push_back(slab);
}

}  // namespace tumble
