#include "app/present/motion.h"

#include <algorithm>

#include "app/present/named.h"
#include "app/present/palette.h"
#include "app/record/bodies.h"
#include "sim/math/frames.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

// From the origin, named at its middle: its tip is in the body.
void addPlace(const Vec3& x, Picture& picture) {
  picture.arrows.push_back({Vec3::Zero(), x, colour::kInk, 1.6f});
  Label label;
  label.anchor = 0.5 * x;
  label.offset = {10.0, 14.0};
  label.text = "x";
  label.size = 16.0f;
  label.italic = true;
  picture.labels.push_back(label);
}

}  // namespace

void addMotion(const Scene& scene, const Recording& recording, const Sample& sample, double length,
               Picture& picture) {
  double fastest = 0.0, strongest = 0.0;
  for (const Sample& other : recording.samples) {
    const std::vector<RigidBody> bodies = loadedBodiesAt(scene.world, other);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (!moves(scene.world.bodies[i])) continue;
      fastest = std::max(fastest, other.bodies[i].v.norm());
      strongest = std::max(strongest, bodies[i].force.norm());
    }
  }
  const std::vector<RigidBody> bodies = loadedBodiesAt(scene.world, sample);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!moves(scene.world.bodies[i])) continue;
    const BodySample& body = sample.bodies[i];
    addPlace(body.x, picture);
    if (fastest > 0.0)
      addNamedArrow(body.x, length / fastest * body.v, colour::kVelocity, "v", picture);
    if (strongest > 0.0)
      addNamedArrow(body.x, length / strongest * bodies[i].force, colour::kForce, "F", picture,
                    true);
  }
}

namespace {

// Half the width of a grid that holds the field's bodies, with a margin.
double spanOf(const CircularField& field, const Sample& sample) {
  const Vec3 axis = field.rotation.normalized();
  double span = 0.0;
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    if (field.body != kNoBody && field.body != static_cast<int>(i)) continue;
    const Vec3 r = sample.bodies[i].x - field.centre;
    span = std::max(span, (r - axis.dot(r) * axis).norm());
  }
  return 1.25 * span;
}

}  // namespace

void addFields(const Scene& scene, const Sample& sample, Picture& picture) {
  constexpr int kHalf = 4;  // arrows from the middle to the edge
  for (const Force& force : scene.world.forces) {
    const CircularField* field = std::get_if<CircularField>(&force);
    if (!field) continue;
    const double span = spanOf(*field, sample);
    if (!(span > 0.0)) continue;
    const Mat3 across = rotationMatrix(turnBetween(Vec3::UnitZ(), field->rotation.normalized()));
    const double step = span / kHalf;
    const double metres = 0.85 * step / (std::sqrt(2.0) * span * field->rotation.norm());
    for (int i = -kHalf; i <= kHalf; ++i)
      for (int k = -kHalf; k <= kHalf; ++k) {
        const Vec3 r = step * (i * across.col(0) + k * across.col(1));
        const Vec3 base = field->centre + r, along = metres * field->rotation.cross(r);
        if (along.norm() > 0.0) picture.arrows.push_back({base, base + along, hex(0x8FA6BF), 1.2f});
      }
  }
}

void addAxes(const Scene& scene, const Sample& sample, double length, Picture& picture) {
  const char* world[] = {"x", "y", "z"};
  const char* body[] = {"x′", "y′", "z′"};
  for (int axis = 0; axis < 3; ++axis)
    addNamedArrow(Vec3::Zero(), length * Vec3::Unit(axis), colour::kQuiet, world[axis], picture);
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const Box* box = std::get_if<Box>(&scene.world.bodies[i].shape);
    if (!box || !moves(scene.world.bodies[i])) continue;
    const BodySample& at = sample.bodies[i];
    const bool own = at.x.isZero(1e-12) && at.q.vec().isZero(1e-12);
    for (int axis = 0; axis < 3; ++axis) {
      const double reach = box->half[axis] + 0.6 * length;
      if (!own)
        addNamedArrow(at.x, reach * (at.q * Vec3::Unit(axis)), colour::kAngular, body[axis],
                      picture);
    }
    const Vec3 p = toWorld({at.x, at.q}, box->half);
    picture.lines.push_back({{at.x, p}, colour::kForce, 1.8f, Stroke::Solid});
    picture.marks.push_back({p, {own ? "p₀" : "p = R p₀ + x"}, colour::kForce});
  }
}

void addCentres(const Scene& scene, const Sample& sample, double size, Picture& picture) {
  constexpr int kRays = 12;
  const auto line = [&](const Vec3& from, const Vec3& to, const Colour& colour, float width) {
    picture.lines.push_back({{from, to}, colour, width, Stroke::Solid});
  };
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodyDef& body = scene.world.bodies[i];
    if (!moves(body)) continue;
    const Vec3& x = sample.bodies[i].x;
    if (const InertiaMethod* method = findInertiaMethod(body.inertiaBy); method->spread) {
      const std::vector<Vec3> points = pointsInside(body.shape, *method->spread, body.samples);
      const std::size_t every = std::max<std::size_t>(1, points.size() / kRays);
      for (std::size_t k = every / 2; k < points.size(); k += every)
        line(x, toWorld({x, sample.bodies[i].q}, points[k]), colour::kQuiet, 1.0f);
    }
    const Vec3 sight = (picture.camera.target - picture.camera.eye).normalized();
    const Vec3 right = sight.cross(Vec3::UnitY()).normalized(), up = right.cross(sight);
    line(x - size * right, x + size * right, colour::kInk, 2.4f);
    line(x - size * up, x + size * up, colour::kInk, 2.4f);
  }
}

}  // namespace tumble
