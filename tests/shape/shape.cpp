// Chapter 2, shape: boxes and balls around shapes.
#include "sim/shape/shape.h"

#include <cmath>
#include <limits>

#include "sim/math/frames.h"
#include "sim/shape/convex_hull.h"
#include "tests/catch.h"

namespace tumble {
namespace {

const Quat kTilted(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized()));
const Pose kPose{{3.0, -2.0, 5.0}, kTilted};

// The farthest point of a shape along +axis, by looking at many points of its surface.
double farthest(const std::vector<Vec3>& points_B, int axis) {
  double far = -1e300;
  for (const Vec3& p : points_B) far = std::max(far, toWorld(kPose, p)[axis]);
  return far;
}

std::vector<Vec3> corners(const Vec3& half) {
  std::vector<Vec3> points;
  for (int k = 0; k < 8; ++k) {
    points.emplace_back(k & 1 ? half.x() : -half.x(), k & 2 ? half.y() : -half.y(),
                        k & 4 ? half.z() : -half.z());
  }
  return points;
}

std::vector<Vec3> rims(const Cylinder& c, int count) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * 3.14159265358979323846 * k / count;
    for (const double y : {-0.5 * c.h, 0.5 * c.h}) {
      points.emplace_back(c.r * std::cos(angle), y, c.r * std::sin(angle));
    }
  }
  return points;
}

// Oracle: all corners. Measured 2.2e-16, allowed 1e-14.
TEST_CASE("the box around a turned box touches its outermost corners") {
  const Box box{{0.3, 1.0, 2.0}};
  const Aabb around = boundingBox(box, kPose);
  for (int axis = 0; axis < 3; ++axis) {
    REQUIRE(std::abs(around.hi[axis] - farthest(corners(box.half), axis)) < 1e-14);
    REQUIRE(std::abs(around.hi[axis] + around.lo[axis] - 2.0 * kPose.x[axis]) < 1e-14);
  }
}

// Oracle: 40,000 rim points, which miss the outermost by up to r (π/20000)² / 2 = 1e-8.
TEST_CASE("the box around a turned cylinder touches its rims") {
  const Cylinder cylinder{0.4, 1.5};
  const Aabb around = boundingBox(cylinder, kPose);
  for (int axis = 0; axis < 3; ++axis) {
    const double miss = around.hi[axis] - farthest(rims(cylinder, 20000), axis);
    REQUIRE(miss > -1e-14);
    REQUIRE(miss < 2e-8);
    REQUIRE(std::abs(around.hi[axis] + around.lo[axis] - 2.0 * kPose.x[axis]) < 1e-14);
  }
}

// Oracle: the ends of the segment by hand, and r beyond them. Measured 4e-16.
TEST_CASE("the box around a turned capsule touches both balls at its ends") {
  const Capsule capsule{0.4, 1.5};
  const Aabb around = boundingBox(capsule, kPose);
  const Vec3 end = kTilted * Vec3(0.0, 0.75, 0.0);
  const Vec3 hi = kPose.x + end.cwiseMax(-end) + Vec3::Constant(0.4);
  const Vec3 lo = kPose.x + end.cwiseMin(-end) - Vec3::Constant(0.4);
  REQUIRE((around.hi - hi).norm() < 1e-14);
  REQUIRE((around.lo - lo).norm() < 1e-14);
}

// Oracle: an ellipse turned by 30 degrees, closed form: √(a² cos² + b² sin²). Measured 2e-16.
TEST_CASE("the box around a turned ellipsoid touches it") {
  const Aabb around =
      boundingBox(Ellipsoid{{2.0, 1.0, 3.0}},
                  {Vec3::Zero(), Quat(Eigen::AngleAxisd(EIGEN_PI / 6.0, Vec3::UnitZ()))});
  const Vec3 hi(std::sqrt(3.25), std::sqrt(1.75), 3.0);
  REQUIRE((around.hi - hi).norm() < 1e-14);
  REQUIRE((around.lo + hi).norm() < 1e-14);
}

// Oracle: all points. The origin is off the middle.
TEST_CASE("the box around a turned hull touches its outermost points, as body and as part") {
  std::vector<Vec3> points = corners({0.3, 1.0, 2.0});
  points.emplace_back(0.0, 4.0, 0.0);
  const Vec3 origin(0.1, -0.2, 0.5);
  const Hull hull{std::make_shared<const Polyhedron>(convexHull(points)), origin - points[0]};
  std::vector<Vec3> points_B;
  for (const Vec3& p : points) points_B.push_back(p - origin);
  const Aabb around = boundingBox(hull, kPose);
  const Pose in{{1.0, 2.0, 3.0}, Quat(0.6, 0.0, 0.8, 0.0)};
  const Compound compound{{Part{hull, in}, Part{Capsule{0.1, 0.2}, in}}, Vec3(0.5, 0.0, 0.0)};
  const Aabb asPart = boundingBox(compound, kPose);
  std::vector<Vec3> moved;
  for (const Vec3& p : points_B) moved.push_back(toWorld(in, p) - compound.origin);
  for (int axis = 0; axis < 3; ++axis) {
    REQUIRE(std::abs(around.hi[axis] - farthest(points_B, axis)) < 1e-14);
    REQUIRE(std::abs(asPart.hi[axis] - farthest(moved, axis)) < 1e-14);
  }
  double far = 0.0;
  for (const Vec3& p : points_B) far = std::max(far, p.norm());
  REQUIRE(std::abs(boundingRadius(hull) - far) < 1e-14);
}

TEST_CASE("a shape is the union of its convex parts") {
  const Compound compound{{Part{Box{}, {{1.0, 2.0, 3.0}, kTilted}}, Part{Capsule{0.1, 0.2}, {}}},
                          Vec3(0.5, 0.0, 0.0)};
  const std::vector<PosedPart> parts = convexParts(compound);
  REQUIRE(parts.size() == 2);
  REQUIRE(parts[0].pose.x == Vec3(0.5, 2.0, 3.0));
  REQUIRE(parts[0].pose.q.coeffs() == kTilted.coeffs());
  REQUIRE(std::get<Capsule>(parts[1].solid).h == 0.2);
  REQUIRE(convexParts(Box{}).size() == 1);
  REQUIRE(convexParts(HalfSpace{}).size() == 1);
  REQUIRE(std::get<Sphere>(convexParts(Particle{0.3})[0].solid).r == 0.3);
  REQUIRE(convexParts(Particle{}).empty());
  REQUIRE(convexParts(Mesh{}).empty());
}

TEST_CASE("the box around a standing cylinder is r wide and h high") {
  const Aabb around = boundingBox(Cylinder{0.4, 1.5}, Pose{});
  REQUIRE(around.hi == Vec3(0.4, 0.75, 0.4));
  REQUIRE(around.lo == Vec3(-0.4, -0.75, -0.4));
}

TEST_CASE("the box around a ball is its diameter, grown by the margin on every side") {
  const Aabb around = boundingBox(Sphere{0.5}, kPose, 0.25);
  REQUIRE(around.lo == Vec3(2.25, -2.75, 4.25));
  REQUIRE(around.hi == Vec3(3.75, -1.25, 5.75));
}

TEST_CASE("a half-space reaches to infinity and overlaps every box") {
  const Aabb around = boundingBox(HalfSpace{}, kPose, 0.1);
  REQUIRE((around.hi.array() == std::numeric_limits<double>::infinity()).all());
  REQUIRE((around.lo.array() == -std::numeric_limits<double>::infinity()).all());
  REQUIRE(around.overlaps(boundingBox(Sphere{0.5}, kPose)));
}

TEST_CASE("boxes that share only a face overlap, boxes with a gap along one axis do not") {
  const Aabb unit{Vec3::Zero(), Vec3::Ones()};
  const Vec3 beside(1.0, 0.0, 0.0), beyond(0.0, 0.0, std::nextafter(1.0, 2.0));
  REQUIRE(unit.overlaps({beside, beside + Vec3::Ones()}));
  REQUIRE_FALSE(unit.overlaps({beyond, beyond + Vec3::Ones()}));
}

TEST_CASE("the bounding radius reaches the farthest point of a shape") {
  REQUIRE(boundingRadius(Sphere{0.5}) == 0.5);
  REQUIRE(boundingRadius(Box{{1.0, 2.0, 2.0}}) == 3.0);
  REQUIRE(boundingRadius(Cylinder{3.0, 8.0}) == 5.0);
  REQUIRE(boundingRadius(Capsule{1.0, 8.0}) == 5.0);
  REQUIRE(boundingRadius(Ellipsoid{{1.0, 4.0, 2.0}}) == 4.0);
  REQUIRE(boundingRadius(HalfSpace{}) == std::numeric_limits<double>::infinity());
}

TEST_CASE("shapes are called by their names") {
  REQUIRE(shapeName(Sphere{}) == "sphere");
  REQUIRE(shapeName(Box{}) == "box");
  REQUIRE(shapeName(Cylinder{}) == "cylinder");
  REQUIRE(shapeName(Capsule{}) == "capsule");
  REQUIRE(shapeName(Ellipsoid{}) == "ellipsoid");
  REQUIRE(shapeName(Hull{}) == "hull");
  REQUIRE(shapeName(HalfSpace{}) == "half-space");
}

}  // namespace
}  // namespace tumble
