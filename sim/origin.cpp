#include "sim/origin.h"

#include <cmath>
#include <limits>
#include <vector>

namespace tumble {
namespace {

/// Extents that a scene may stand from the origin before it is simulated elsewhere.
constexpr double kNear = 4.0;

/// The box of all places that a scene names.
class Places {
 public:
  void add(const Vec3& p) {
    least_ = least_.cwiseMin(p);
    most_ = most_.cwiseMax(p);
  }
  Vec3 centre() const { return 0.5 * (least_ + most_); }
  double extent() const { return (most_ - least_).maxCoeff(); }

 private:
  Vec3 least_ = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 most_ = -least_;
};

/// How far [m] a point is above a plane.
double outside(const HalfSpace& plane, const Vec3& p) {
  return plane.n.dot(p) - plane.d;
}

/// The plane that bears most of a weight; of several the first.
const HalfSpace* groundOf(const WorldDef& def) {
  const HalfSpace* ground = nullptr;
  for (const BodyDef& body : def.bodies) {
    const auto* plane = std::get_if<HalfSpace>(&body.shape);
    if (plane && (!ground || def.gravity.dot(plane->n) < def.gravity.dot(ground->n)))
      ground = plane;
  }
  return ground;
}

/// What moves, what is fixed, what holds it, and of planes the points below what moves.
Places placesOf(const WorldDef& def) {
  Places places;
  std::vector<HalfSpace> planes;
  for (const BodyDef& body : def.bodies)
    if (const auto* plane = std::get_if<HalfSpace>(&body.shape)) planes.push_back(*plane);
  for (const BodyDef& body : def.bodies) {
    if (std::holds_alternative<HalfSpace>(body.shape)) continue;
    places.add(body.position);
    if (body.fixed) continue;
    for (const HalfSpace& plane : planes)
      places.add(body.position - outside(plane, body.position) * plane.n);
  }
  for (const JointDef& joint : def.joints) {
    places.add(joint.anchorA);
    places.add(joint.anchorB);
  }
  for (const Force& force : def.forces) {
    if (const auto* field = std::get_if<CircularField>(&force)) places.add(field->centre);
    const auto* spring = std::get_if<Spring>(&force);
    if (spring && spring->a == kNoBody) places.add(spring->anchorA_B);
    if (spring && spring->b == kNoBody) places.add(spring->anchorB_B);
  }
  return places;
}

}  // namespace

Vec3 originOf(const WorldDef& def) {
  const Places places = placesOf(def);
  const Vec3 centre = places.centre();
  const double extent = places.extent();
  if (!(extent > 0.0) || !std::isfinite(extent) || !centre.allFinite()) return Vec3::Zero();
  if (centre.cwiseAbs().maxCoeff() <= kNear * extent) return Vec3::Zero();
  // Powers of two: what is subtracted from places has fewer bits than they.
  const double grid = std::ldexp(1.0, std::ilogb(extent) + 1);
  const Vec3 origin = grid * (centre / grid).array().round().matrix();
  // On the ground, so that heights above it are rounded by their own size.
  const HalfSpace* ground = groundOf(def);
  return ground ? Vec3(origin - outside(*ground, origin) * ground->n) : origin;
}

WorldDef shifted(WorldDef def, const Vec3& shift) {
  for (BodyDef& body : def.bodies) {
    body.position += shift;
    if (auto* plane = std::get_if<HalfSpace>(&body.shape)) plane->d += plane->n.dot(shift);
  }
  for (JointDef& joint : def.joints) {
    joint.anchorA += shift;
    joint.anchorB += shift;
  }
  for (Force& force : def.forces) {
    if (auto* field = std::get_if<CircularField>(&force)) field->centre += shift;
    if (auto* spring = std::get_if<Spring>(&force)) {
      if (spring->a == kNoBody) spring->anchorA_B += shift;
      if (spring->b == kNoBody) spring->anchorB_B += shift;
    }
  }
  return def;
}

Sample shifted(Sample sample, const Vec3& shift, const Vec3& weight) {
  for (BodySample& body : sample.bodies) body.x += shift;
  for (ContactSample& contact : sample.contacts) contact.p += shift;
  for (JointForce& joint : sample.joints) joint.p += shift;
  sample.potential -= weight.dot(shift);
  return sample;
}

Report shifted(Report report, const Vec3& shift, const Vec3& weight) {
  for (Event& event : report.events) event.p += shift;
  report.certificate.energy_start -= weight.dot(shift);
  report.certificate.energy_end -= weight.dot(shift);
  return report;
}

}  // namespace tumble
