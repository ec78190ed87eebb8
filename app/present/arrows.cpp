#include "app/present/arrows.h"

#include <algorithm>
#include <limits>

#include "app/claim/free_body.h"
#include "app/present/bodies.h"
#include "app/present/joints.h"
#include "app/present/named.h"
#include "app/present/palette.h"
#include "sim/math/frames.h"

namespace tumble {

ArrowScale arrowScale(const Scene& scene, const Recording& recording, double fastest,
                      double radius) {
  constexpr double kLargest = 0.6, kJoint = 0.25;  // of the radius
  double longest = std::min(typicalHeight(scene), kLargest * radius);
  // Links that lie flat are not high, and what they pull by is to be seen.
  if (scene.show.joint_forces) longest = std::max(longest, kJoint * radius);
  return {longest, fastest, largestContactForce(recording), jointScale(recording)};
}

double ArrowScale::together(const ShowFlags& show) const {
  return std::max(show.contact_forces ? contact : 0.0, show.joint_forces ? joint.longest : 0.0);
}

void addArrows(const Scene& scene, const Sample& sample, const ArrowScale& scale,
               Picture& picture) {
  const ShowFlags& show = scene.show;
  const double length = 0.88 * scale.longest;
  const double largest = scale.together(show);
  const double metresPerNewton = show.force_scale > 0.0 ? show.force_scale
                                 : largest > 0.0        ? length / largest
                                                        : 1.0;
  if (show.joint_forces)
    addJointForces(scene, sample, metresPerNewton,
                   show.force_scale > 0.0 ? std::numeric_limits<double>::infinity() : largest,
                   picture);
  else if (show.contact_forces)
    addContactForces(sample, scale.contact, metresPerNewton * scale.contact, picture);
  if (show.normals) addNormals(sample, length, picture);
  if (show.velocities) addVelocities(scene, sample, scale.fastest, 2.0 * scale.longest, picture);
  if (show.forces)
    addForces(scene, sample, scale.longest, picture, show.force_scale, show.resultant);
}

double largestContactForce(const Recording& recording) {
  constexpr double kRounding = 1e-12;  // of the largest: what is left of no force
  std::vector<double> forces;
  for (const Sample& sample : recording.samples)
    for (const ContactSample& contact : sample.contacts) forces.push_back(contact.force.norm());
  const double largest = forces.empty() ? 0.0 : *std::max_element(forces.begin(), forces.end());
  std::erase_if(forces, [&](double force) { return force <= kRounding * largest; });
  if (forces.empty()) return 1.0;
  // In a run that comes to rest the largest force that lasts is within the lowest 98 %.
  const std::size_t index = forces.size() - 1 - forces.size() / 50;
  std::nth_element(forces.begin(), forces.begin() + static_cast<std::ptrdiff_t>(index),
                   forces.end());
  return forces[index];
}

void addContactForces(const Sample& sample, double fmax, double length, Picture& picture) {
  constexpr double kLevel = 1e-9;  // of a force: what rounding has of its height
  for (const ContactSample& contact : sample.contacts) {
    // On the body that is pushed up; of a level push, on the first.
    const bool down = contact.force.y() < -kLevel * contact.force.norm();
    const Vec3 force = down ? Vec3(-contact.force) : contact.force;
    const double share = std::min(1.0, force.norm() / fmax);
    if (share < 1e-3) continue;
    const Vec3 tip = contact.p + share * length * force.normalized();
    picture.arrows.push_back(
        {contact.p, tip, colour::kForce, static_cast<float>(1.5 + 0.6 * share)});
  }
}

void addNormals(const Sample& sample, double length, Picture& picture) {
  for (const ContactSample& contact : sample.contacts)
    picture.arrows.push_back({contact.p, contact.p + length * contact.n, colour::kInk, 1.3f});
}

void addVelocities(const Scene& scene, const Sample& sample, double fastest, double length,
                   Picture& picture) {
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodySample& body = sample.bodies[i];
    if (!moves(scene.world.bodies[i]) || body.v.norm() < 0.01 * fastest) continue;
    const Vec3 base = body.x + reach(scene.world.bodies[i].shape, body.q, body.v.normalized()) *
                                   body.v.normalized();
    picture.arrows.push_back({base, base + length / fastest * body.v, colour::kVelocity, 1.9f});
  }
}

namespace {

/// A force [N] on a body, whose arrow ends at `tip`.
struct Push {
  Vec3 tip, force;
  std::size_t body;
};

// An arrow towards the centre of mass ends on the body's surface.
Push pushAtCentre(const BodyDef& def, const BodySample& body, const Vec3& force, std::size_t i) {
  const Vec3 along = force.normalized();
  return {body.x - reach(def.shape, body.q, along) * along, force, i};
}

std::vector<Push> pushes(const Scene& scene, const Sample& sample) {
  std::vector<Push> found;
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  for (const Force& force : scene.world.forces) {
    if (const UniformWind* wind = std::get_if<UniformWind>(&force)) {
      for (std::size_t i = 0; i < bodies.size(); ++i)
        if (moves(bodies[i]) && (wind->body == kNoBody || wind->body == static_cast<int>(i)))
          found.push_back(pushAtCentre(bodies[i], sample.bodies[i], wind->force, i));
    } else if (const PointForce* point = std::get_if<PointForce>(&force)) {
      const BodySample& body = sample.bodies[point->body];
      found.push_back({toWorld({body.x, body.q}, point->point_B), point->force,
                       static_cast<std::size_t>(point->body)});
    }
  }
  return found;
}

// "f₁": the name of the k-th force.
std::string forceName(std::size_t k) {
  constexpr const char* kDigits[] = {"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"};
  std::string name;
  for (const char digit : std::to_string(k + 1)) name += kDigits[digit - '0'];
  return "f" + name;
}

// Names at the tails of forces, and on each body F = Σ f and τ = Σ (p − x) × f.
void addResultants(const std::vector<Push>& found, const Sample& sample, double metres,
                   double length, Picture& picture) {
  for (std::size_t k = 0; k < found.size(); ++k) {
    Label label;
    label.anchor = found[k].tip - metres * found[k].force;
    const bool upward = found[k].force.y() > 0.7 * found[k].force.norm();
    label.offset = {0.0, upward ? 17.0 : -7.0};
    label.align = Align::Centre;
    label.text = forceName(k);
    label.size = 16.0f;
    label.italic = true;
    label.clear = true;
    label.colour = colour::kForce;
    picture.labels.push_back(label);
  }
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
    for (const Push& push : found) {
      if (push.body != i) continue;
      sum += push.force;
      torque += (push.tip - sample.bodies[i].x).cross(push.force);
    }
    addNamedArrow(sample.bodies[i].x, metres * sum, colour::kInk, "F = Σ f", picture);
    if (torque.norm() > 1e-9 * sum.norm())
      addNamedArrow(sample.bodies[i].x, 1.5 * length * torque.normalized(), colour::kAngular,
                    "τ = Σ (p − x) × f", picture, true);
  }
}

}  // namespace

void addForces(const Scene& scene, const Sample& sample, double length, Picture& picture,
               double scale, bool resultant) {
  const std::vector<Push> found = pushes(scene, sample);
  double largest = 0.0;
  for (const Push& push : found) largest = std::max(largest, push.force.norm());
  if (largest == 0.0) return;
  const double metres = scale > 0.0 ? scale : length / largest;
  for (const Push& push : found)
    picture.arrows.push_back(
        {push.tip - metres * push.force, push.tip, colour::kForce, scale > 0.0 ? 2.6f : 1.6f});
  if (resultant) addResultants(found, sample, metres, length, picture);
}

}  // namespace tumble
