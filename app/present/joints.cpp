#include "app/present/joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/claim/free_body.h"
#include "app/present/bent.h"
#include "app/present/digits.h"
#include "app/present/palette.h"
#include "sim/math/frames.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

constexpr Colour kPin = hex(0x1D2127), kRod = hex(0x4A505A);
constexpr double kNothing = 1e-9;  // [N] no force
constexpr double kMostly = 0.5;    // of a force that counts as pulling down, the part that does
constexpr Colour kUp = hex(0x1B8A4B), kDown = hex(0xC4161C);

// A joint as it stands in a sample. World frame.
struct Posed {
  Vec3 pa, pb, axis;
};

// The pose of an end at the start, and now; of the world none.
struct End {
  Pose before, now;
};

End endOf(const Scene& scene, const Sample& sample, int body) {
  if (body == kNoBody) return {};
  const BodyDef& def = scene.world.bodies[body];
  const BodySample& at = sample.bodies[body];
  return {{def.position, def.orientation.normalized()}, {at.x, at.q}};
}

Vec3 carried(const End& end, const Vec3& p) {
  return toWorld(end.now, end.before.q.conjugate() * (p - end.before.x));
}

Posed posed(const Scene& scene, const Sample& sample, const JointDef& def) {
  const End a = endOf(scene, sample, def.a), b = endOf(scene, sample, def.b);
  const Vec3 axis = def.axis.stableNormalized();
  return {carried(a, def.anchorA), carried(b, def.anchorB),
          b.now.q * (b.before.q.conjugate() * axis)};
}

Instance ballAt(const Vec3& p, double radius, const Colour& colour) {
  Instance ball;
  ball.form = Form::Sphere;
  ball.position = p;
  ball.scale.setConstant(radius);
  ball.colour = colour;
  return ball;
}

Instance rodFrom(const Vec3& p, const Vec3& q, double radius, const Colour& colour) {
  Instance rod;
  rod.form = Form::Cylinder;
  rod.position = 0.5 * (p + q);
  rod.orientation = turnBetween(Vec3::UnitY(), q - p);
  rod.scale = {radius, 0.5 * (q - p).norm(), radius};
  rod.colour = colour;
  return rod;
}

// Half the length of a hinge's pin: through the body that turns, and a little more.
double throughBody(const Scene& scene, const Sample& sample, const JointDef& def, const Vec3& axis,
                   double least) {
  const BodySample& body = sample.bodies[def.a];
  return std::max(least, reach(scene.world.bodies[def.a].shape, body.q, axis) + 0.7 * least);
}

void addLabel(const Vec3& p, const Eigen::Vector2d& offset, Align align, const std::string& text,
              const Colour& colour, Picture& picture) {
  Label label;
  label.anchor = p;
  label.offset = offset;
  label.text = text;
  label.size = 15.0f;
  label.bold = true;
  label.align = align;
  label.colour = colour;
  picture.labels.push_back(label);
}

// "98.1 N", with a minus as printers have it.
std::string newtons(double force) {
  return (force == 0.0 ? "0" : fourDigits(force)) + " N";
}

// Joints between each body and the world, or what never moves; where none lead there, between it
// and the first body of its group.
std::vector<int> stepsFromWorld(const Scene& scene) {
  const WorldDef& world = scene.world;
  constexpr int kFar = std::numeric_limits<int>::max() - 1;
  std::vector<int> steps(world.bodies.size(), kFar);
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (!moves(world.bodies[i])) steps[i] = 0;
  const auto at = [&](int body) { return body == kNoBody ? 0 : steps[body]; };
  const auto spread = [&] {
    for (bool changed = true; changed;) {
      changed = false;
      for (const JointDef& joint : world.joints)
        for (const auto& [near, far] : {std::pair(joint.a, joint.b), std::pair(joint.b, joint.a)})
          if (far != kNoBody && at(near) != kFar && steps[far] > at(near) + 1) {
            steps[far] = at(near) + 1;
            changed = true;
          }
    }
  };
  spread();
  for (int& step : steps)
    if (step == kFar) {
      step = 0;
      spread();
    }
  return steps;
}

// Of the two forces of a joint the one on the body further from the world, and where it acts on
// that; on a if neither is.
struct Outward {
  Vec3 force, p;
};

std::vector<Outward> forcesOutward(const Scene& scene, const Sample& sample) {
  const std::vector<int> steps = stepsFromWorld(scene);
  std::vector<Outward> forces;
  for (const JointForce& joint : sample.joints) {
    const JointDef& def = scene.world.joints[joint.joint];
    const bool turned = def.b != kNoBody && steps[def.b] > steps[def.a];
    if (turned)
      forces.push_back({-joint.force, posed(scene, sample, def).pb});
    else
      forces.push_back({joint.force, joint.p});
  }
  return forces;
}

// Where the straight way from p inside a body to q comes out of it, if the body is a ball or an
// ellipsoid, which are drawn as deep as their outlines; others hide what is inside them.
Vec3 wayOut(const BodyDef& body, const BodySample& at, const Vec3& p, const Vec3& q) {
  Vec3 half;
  if (const Sphere* sphere = std::get_if<Sphere>(&body.shape))
    half.setConstant(sphere->r);
  else if (const Ellipsoid* ellipsoid = std::get_if<Ellipsoid>(&body.shape))
    half = ellipsoid->half;
  else
    return p;
  // |u + s w| = 1 in units of the semi-axes.
  const Vec3 u = (at.q.conjugate() * (p - at.x)).cwiseQuotient(half);
  const Vec3 w = (at.q.conjugate() * (q - p)).cwiseQuotient(half);
  const double a = w.squaredNorm(), b = u.dot(w), c = u.squaredNorm() - 1.0;
  if (c >= 0.0 || a == 0.0) return p;
  return p + std::min(1.0, (std::sqrt(b * b - a * c) - b) / a) * (q - p);
}

void addRod(const Vec3& p, const Vec3& q, double radius, Picture& picture) {
  if ((q - p).norm() > radius) picture.instances.push_back(rodFrom(p, q, radius, kRod));
}

// Whether a rod leads from a body to an anchor: it moves, and the anchor is outside it.
bool hasLever(const Scene& scene, const Sample& sample, int body, const Vec3& anchor) {
  constexpr double kOn = 1.0 + 1e-6;  // of the way to a surface
  if (body == kNoBody || !moves(scene.world.bodies[body])) return false;
  const BodySample& at = sample.bodies[body];
  const Vec3 lever = anchor - at.x;
  return lever.norm() > kOn * reach(scene.world.bodies[body].shape, at.q, lever.stableNormalized());
}

void addLever(const Scene& scene, const Sample& sample, int body, const Vec3& anchor, double radius,
              Picture& picture) {
  if (!hasLever(scene, sample, body, anchor)) return;
  const BodySample& at = sample.bodies[body];
  addRod(wayOut(scene.world.bodies[body], at, at.x, anchor), anchor, radius, picture);
}

// Radii of pins and rods, and the length of a rail [m], in a picture of that size.
constexpr double kPinRadius = 0.010, kRodRadius = 0.35 * kPinRadius, kRail = 1.0;

// Whether its anchors are one point, which levers lead to.
bool atOnePoint(JointKind kind) {
  return kind != JointKind::Distance && kind != JointKind::Slider;
}

}  // namespace

bool isSeam(const Scene& scene, const JointDef& joint) {
  return joint.kind == JointKind::Ball && isPoint(scene, joint.a);
}

void addJoints(const Scene& scene, const Sample& sample, double size, Picture& picture) {
  const double pin = kPinRadius * size, thin = kRodRadius * size, rail = 0.5 * kRail * size;
  for (const JointDef& def : scene.world.joints) {
    if (isSeam(scene, def)) continue;
    const Posed at = posed(scene, sample, def);
    if (atOnePoint(def.kind))
      for (const int body : {def.a, def.b}) addLever(scene, sample, body, at.pa, thin, picture);
    switch (def.kind) {
      case JointKind::Hinge: {
        const double half = throughBody(scene, sample, def, at.axis, pin);
        picture.instances.push_back(
            rodFrom(at.pa - half * at.axis, at.pa + half * at.axis, pin, kPin));
        break;
      }
      case JointKind::Distance: {
        const auto end = [&](int body, const Vec3& p, const Vec3& q) {
          if (body == kNoBody) return p;
          return wayOut(scene.world.bodies[body], sample.bodies[body], p, q);
        };
        const Vec3 from = end(def.a, at.pa, at.pb), to = end(def.b, at.pb, at.pa);
        for (const Vec3& p : {from, to}) picture.instances.push_back(ballAt(p, pin, kPin));
        addRod(from, to, thin, picture);
        break;
      }
      case JointKind::Slider:
        picture.instances.push_back(
            rodFrom(at.pb - rail * at.axis, at.pb + rail * at.axis, thin, kRod));
        picture.instances.push_back(ballAt(at.pa, pin, kPin));
        break;
      case JointKind::Ball:
      case JointKind::Fixed:
        picture.instances.push_back(ballAt(at.pa, pin, kPin));
    }
  }
}

JointLooks jointLooks(const Scene& scene, const Sample& start, double size) {
  JointLooks looks{{}, kPinRadius * size, kRodRadius * size, kRail * size, kPin, kRod};
  const auto inBody = [&](int body, const Vec3& p) {
    const End end = endOf(scene, start, body);
    return Vec3(end.now.q.conjugate() * (p - end.now.x));
  };
  for (const JointDef& def : scene.world.joints) {
    if (isSeam(scene, def)) continue;
    const Posed at = posed(scene, start, def);
    JointLook& look = looks.joints.emplace_back();
    look.kind = def.kind;
    look.a = def.a;
    look.b = def.b;
    look.pa = inBody(def.a, at.pa);
    look.pb = inBody(def.b, at.pb);
    look.axis = endOf(scene, start, def.b).now.q.conjugate() * at.axis;
    if (def.kind == JointKind::Hinge)
      look.half = throughBody(scene, start, def, at.axis, looks.pin);
    if (!atOnePoint(def.kind)) continue;
    look.leverToA = hasLever(scene, start, def.a, at.pa);
    look.leverToB = hasLever(scene, start, def.b, at.pa);
  }
  return looks;
}

namespace {

// One arrow for all contacts of a pair, with their sum.
void addPairForces(const Sample& sample, double metresPerNewton, Picture& picture) {
  for (std::size_t i = 0; i < sample.contacts.size(); ++i) {
    // The contacts of a pair stand together and share a number.
    const ContactSample& first = sample.contacts[i];
    if (i > 0 && sample.contacts[i - 1].a == first.a && sample.contacts[i - 1].b == first.b)
      continue;
    Vec3 sum = Vec3::Zero(), middle = Vec3::Zero();
    double count = 0.0;
    for (const ContactSample& c : sample.contacts) {
      if (c.a != first.a || c.b != first.b) continue;
      sum += c.force;
      middle += c.p;
      count += 1.0;
    }
    if (sum.isZero(0.0)) continue;
    const Vec3 base = middle / count;
    const Vec3 along = metresPerNewton * (sum.y() < 0.0 ? Vec3(-sum) : sum);
    picture.arrows.push_back({base, base + along, colour::kForce, 2.6f});
    // Beside arrows that lean, above those that stand.
    const Vec3 right =
        (picture.camera.target - picture.camera.eye).cross(Vec3::UnitY()).normalized();
    const double lean = right.dot(along.normalized());
    const Align align = lean > 0.3 ? Align::Right : lean < -0.3 ? Align::Left : Align::Centre;
    const double aside = lean > 0.0 ? -8.0 : 8.0;
    addLabel(base + along, {align == Align::Centre ? 0.0 : aside, -14.0}, align,
             newtons(sum.norm()), colour::kForce, picture);
  }
}

}  // namespace

void addJointForces(const Scene& scene, const Sample& sample, double metresPerNewton, double most,
                    Picture& picture) {
  const std::vector<Outward> forces = forcesOutward(scene, sample);
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const Vec3& force = forces[k].force;
    // Along the pin of a hinge, towards the eye: there nothing stands before the arrow.
    const JointDef& def = scene.world.joints[sample.joints[k].joint];
    Vec3 base = forces[k].p;
    if (def.kind == JointKind::Hinge) {
      Vec3 axis = posed(scene, sample, def).axis;
      if (axis.dot(picture.camera.eye - base) < 0.0) axis = -axis;
      base += throughBody(scene, sample, def, axis, 0.0) * 1.1 * axis;
    }
    const double size = force.norm();
    const bool up = force.y() >= -kMostly * size, none = size < kNothing;
    const Colour colour = none ? colour::kInk : up ? kUp : kDown;
    const Vec3 tip =
        none ? base : Vec3(base + metresPerNewton * std::min(1.0, most / size) * force);
    if (!none) picture.arrows.push_back({base, tip, colour, 2.6f});
    const double shown = none ? 0.0 : up ? size : -size;
    // At its foot: where it ends may be another body. Off bodies, if near by there is room.
    addLabel(base, {-16.0, 5.0}, Align::Right, newtons(shown), colour, picture);
    picture.labels.back().apart = true;
  }
  if (scene.show.contact_forces) addPairForces(sample, metresPerNewton, picture);
}

JointScale jointScale(const Recording& recording) {
  constexpr double kSpike = 3.0;
  JointScale scale;
  std::vector<double> forces;
  for (const Sample& sample : recording.samples)
    for (const JointForce& joint : sample.joints) {
      const double size = joint.force.norm();
      if (size >= kNothing) forces.push_back(size);
      if (size > scale.largest) {
        scale.largest = size;
        scale.at = sample.t;
      }
    }
  scale.longest = scale.largest;
  if (forces.empty()) return scale;
  const std::size_t index = forces.size() - 1 - forces.size() / 50;
  std::nth_element(forces.begin(), forces.begin() + static_cast<std::ptrdiff_t>(index),
                   forces.end());
  if (scale.largest > kSpike * forces[index]) scale.longest = forces[index];
  return scale;
}

}  // namespace tumble
