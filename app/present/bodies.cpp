#include "app/present/bodies.h"

#include <algorithm>
#include <cmath>

#include "app/claim/free_body.h"
#include "app/present/inertia.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

/// Radius of the dot that stands for a point, relative to the extent of the scene.
constexpr double kDot = 0.003;

}  // namespace

Instance instanceOf(const BodyDef& body, const Vec3& x, const Quat& q, const Colour& colour,
                    const Vec3& near, double extent, const std::shared_ptr<const Facets>& facets) {
  Instance instance;
  instance.position = x;
  instance.orientation = q;
  instance.colour = colour;
  if (facets) {
    instance.form = Form::Facets;
    instance.facets = facets;
  } else if (const Sphere* sphere = std::get_if<Sphere>(&body.shape)) {
    instance.form = Form::Sphere;
    instance.scale.setConstant(sphere->r);
  } else if (const Box* box = std::get_if<Box>(&body.shape)) {
    instance.form = Form::Box;
    instance.scale = box->half;
  } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&body.shape)) {
    instance.form = Form::Cylinder;
    instance.scale = {cylinder->r, 0.5 * cylinder->h, cylinder->r};
  } else if (const Ellipsoid* ellipsoid = std::get_if<Ellipsoid>(&body.shape)) {
    instance.form = Form::Ellipsoid;
    instance.scale = ellipsoid->half;
  } else if (const Particle* particle = std::get_if<Particle>(&body.shape)) {
    instance.form = Form::Sphere;
    instance.scale.setConstant(particle->radius > 0.0 ? particle->radius : kDot * extent);
  } else if (const HalfSpace* plane = std::get_if<HalfSpace>(&body.shape)) {
    // A slab whose upper face lies in the plane, below the foot of `near`.
    const double thickness = 0.01 * extent;
    const Vec3 foot = near - (plane->n.dot(near) - plane->d) * plane->n;
    instance.form = Form::Box;
    instance.scale = {0.5 * extent, 0.5 * thickness, 0.5 * extent};
    instance.position = foot - 0.5 * thickness * plane->n;
    instance.orientation = turnBetween(Vec3::UnitY(), plane->n);
  }
  return instance;
}

bool isFloor(const BodyDef& body) {
  const HalfSpace* plane = std::get_if<HalfSpace>(&body.shape);
  return plane && plane->n.y() > 0.9999;
}

bool hides(const BodyDef& body, const Vec3& eye) {
  const HalfSpace* plane = std::get_if<HalfSpace>(&body.shape);
  return plane && plane->n.dot(eye) < plane->d;
}

double decadeOf(double value, double least) {
  double decade = 1.0;
  while (value >= 1e3 * least * decade) decade *= 1e3;
  while (value < least * decade && decade > 1e-30) decade *= 1e-3;
  return decade;
}

int movingCount(const Scene& scene) {
  return static_cast<int>(
      std::count_if(scene.world.bodies.begin(), scene.world.bodies.end(), moves));
}

double typicalHeight(const Scene& scene) {
  std::vector<double> heights;
  for (const BodyDef& body : scene.world.bodies)
    if (moves(body)) heights.push_back(2.0 * reach(body.shape, body.orientation, Vec3::UnitY()));
  if (heights.empty()) return 1.0;
  std::nth_element(heights.begin(), heights.begin() + heights.size() / 2, heights.end());
  return heights[heights.size() / 2];
}

namespace {

void addCorners(const Aabb& box, std::vector<Eigen::Vector3d>& points) {
  for (int corner = 0; corner < 8; ++corner)
    points.emplace_back(corner & 1 ? box.hi.x() : box.lo.x(), corner & 2 ? box.hi.y() : box.lo.y(),
                        corner & 4 ? box.hi.z() : box.lo.z());
}

// Points of an ellipsoid in fourteen directions.
void addEllipsoid(const Vec3& centre, const Quat& q, const Vec3& semiAxes,
                  std::vector<Eigen::Vector3d>& points) {
  const auto add = [&](const Vec3& direction) {
    points.emplace_back(centre + q * semiAxes.cwiseProduct(direction));
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) add(side * Vec3::Unit(axis));
  for (int corner = 0; corner < 8; ++corner)
    add(Vec3(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0) /
        std::sqrt(3.0));
}

// What is drawn around a body beside itself.
void addSurroundings(const ShowFlags& show, const BodyDef& body, const BodySample& sample,
                     std::vector<Eigen::Vector3d>& points) {
  const double around = show.momenta ? kMomentaReach : show.polhode ? kPoinsotReach : 0.0;
  if (around > 0.0)
    addEllipsoid(sample.x, Quat::Identity(), Vec3::Constant(around * boundingRadius(body.shape)),
                 points);
  if (!show.ellipsoid) return;
  if (const std::optional<Instance> ellipsoid = inertiaEllipsoid(body, sample))
    addEllipsoid(ellipsoid->position, ellipsoid->orientation, ellipsoid->scale, points);
}

}  // namespace

void addMovingPoints(const Scene& scene, const Sample& sample,
                     std::vector<Eigen::Vector3d>& points) {
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (std::holds_alternative<Particle>(bodies[i].shape)) points.push_back(sample.bodies[i].x);
    if (!moves(bodies[i]) || std::holds_alternative<Particle>(bodies[i].shape)) continue;
    addCorners(boundingBox(bodies[i].shape, {sample.bodies[i].x, sample.bodies[i].q}), points);
    addSurroundings(scene.show, bodies[i], sample.bodies[i], points);
  }
}

std::vector<Eigen::Vector3d> standingPoints(const Scene& scene,
                                            const std::vector<Eigen::Vector3d>& motion) {
  std::vector<Eigen::Vector3d> points;
  for (const JointDef& joint : scene.world.joints)
    if (joint.b == kNoBody) points.push_back(joint.anchorB);

  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : motion) box.extend(p);
  for (const Eigen::Vector3d& p : points) box.extend(p);
  constexpr double kLargest = 2.0;  // of the motion, as long as what stands is seen with it
  const double size = box.isEmpty() ? 0.0 : kLargest * box.sizes().norm();
  for (const BodyDef& body : scene.world.bodies) {
    if (moves(body) || std::holds_alternative<HalfSpace>(body.shape)) continue;
    if (box.isEmpty() || 2.0 * boundingRadius(body.shape) <= size)
      addCorners(boundingBox(body.shape, {body.position, body.orientation}), points);
  }
  if (points.empty() && motion.empty())
    addCorners({Vec3::Constant(-1.0), Vec3::Constant(1.0)}, points);
  return points;
}

std::vector<Eigen::Vector3d> motionPoints(const Scene& scene, const Recording& recording) {
  std::vector<Eigen::Vector3d> points;
  for (const Sample& sample : recording.samples) addMovingPoints(scene, sample, points);
  for (const Eigen::Vector3d& point : standingPoints(scene, points)) points.push_back(point);
  return points;
}

std::vector<Eigen::Vector3d> pointsAround(const BodyDef& body, const BodySample& start) {
  constexpr double kRoom = 3.0;  // in radii of the body
  const double reach =
      std::holds_alternative<Particle>(body.shape) ? 1.0 : boundingRadius(body.shape);
  std::vector<Eigen::Vector3d> points;
  const Vec3 room = Vec3::Constant(kRoom * reach);
  addCorners({start.x - room, start.x + room}, points);
  return points;
}

}  // namespace tumble
