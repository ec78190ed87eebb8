#include "app/claim/parting.h"

#include <cmath>

#include "app/record/bodies.h"
#include "sim/collide/collide.h"
#include "sim/math/frames.h"

namespace tumble {

namespace {

bool near(const PlacedPart& a, const PlacedPart& b) {
  const double radii = boundingRadius(a.solid) + boundingRadius(b.solid);
  return (a.pose.x - b.pose.x).norm() < 2.0 * radii;
}

}  // namespace

std::vector<PlacedPart> placedParts(const Scene& scene, const Sample& sample) {
  std::vector<PlacedPart> placed;
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodySample& body = sample.bodies[i];
    if (std::holds_alternative<HalfSpace>(scene.world.bodies[i].shape)) continue;
    int number = 0;
    for (PosedPart& part : convexParts(scene.world.bodies[i].shape)) {
      const Pose pose = toWorld(Pose{body.x, body.q}, part.pose);
      placed.push_back({static_cast<int>(i), number++, std::move(part.solid), pose});
    }
  }
  return placed;
}

std::vector<Vec3> cornersOf(const Shape& solid, const Pose& pose) {
  std::vector<Vec3> corners;
  if (const Box* box = std::get_if<Box>(&solid))
    for (int k = 0; k < 8; ++k)
      corners.push_back(pose.x + pose.q * Vec3(k & 1 ? box->half.x() : -box->half.x(),
                                               k & 2 ? box->half.y() : -box->half.y(),
                                               k & 4 ? box->half.z() : -box->half.z()));
  if (const Hull* hull = std::get_if<Hull>(&solid))
    for (const Vec3& p : hull->solid->points)
      corners.push_back(pose.x + pose.q * (p - hull->origin));
  return corners;
}

Parting Coherence::part(const PlacedPart& a, const PlacedPart& b) {
  ++pairs_;
  Witness& witness = planes_[{b.body, a.body, b.part, a.part}];
  if (showsApart(witness, a.solid, a.pose, b.solid, b.pose, 0.0))
    return {a, b, normalOf(witness, a.pose.q, b.pose.q),
            gapAlong(witness, a.solid, a.pose, b.solid, b.pose), true};
  ++searches_;
  const ContactPoint plane = separatingPlane(a.solid, a.pose, b.solid, b.pose);
  witness = witnessOf(plane, a.pose, b.pose);
  return {a, b, plane.n, plane.separation, false};
}

std::vector<Parting> Coherence::look(const Sample& sample) {
  const std::vector<PlacedPart> parts = placedParts(scene_, sample);
  std::vector<Parting> partings;
  for (std::size_t j = 0; j < parts.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const PlacedPart &b = parts[i], &a = parts[j];
      const bool held = !moves(scene_.world.bodies[static_cast<std::size_t>(a.body)]) &&
                        !moves(scene_.world.bodies[static_cast<std::size_t>(b.body)]);
      if (a.body == b.body || held || !near(a, b)) continue;
      partings.push_back(part(a, b));
    }
  return partings;
}

}  // namespace tumble
