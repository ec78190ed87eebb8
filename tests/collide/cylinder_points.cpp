// Chapter 5, collide: where cylinders touch, feature by feature, in closed form.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/collide/collide.h"
#include "sim/collide/core.h"
#include "sim/math/frames.h"
#include "sim/math/rotation.h"
#include "sim/shape/convex_hull.h"
#include "tests/catch.h"
#include "tests/collide/random_pose.h"

namespace tumble {
namespace {

const Quat kUpright = Quat::Identity();
const Quat kLying = fromAxisAngle(Vec3::UnitX(), 0.5 * std::numbers::pi);

/// The manifold of two solids, in a scene that is turned and shifted, brought back.
Manifold pointsOf(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB,
                  const Pose& scene, bool swapped) {
  Manifold manifold;
  const Pose atA = moved(scene, poseA), atB = moved(scene, poseB);
  if (swapped)
    collide(b, atB, a, atA, 1e-9, manifold);
  else
    collide(a, atA, b, atB, 1e-9, manifold);
  for (ContactPoint& c : manifold) c.p = toBody(scene, c.p);
  return manifold;
}

/// Holds all points of a manifold to places; every place must be among the points, and, if `all`,
/// every point at a place.
void hold(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB,
          const std::vector<Vec3>& places, bool all) {
  Random random(17);
  double worst = 0.0;
  for (int k = 0; k < 24; ++k) {
    const Pose scene = k < 2 ? Pose{} : random.pose(1.0);
    const Manifold manifold = pointsOf(a, poseA, b, poseB, scene, k % 2 == 1);
    CAPTURE(k, manifold.size());
    if (all) REQUIRE(manifold.size() == places.size());
    for (const Vec3& place : places) {
      double nearest = 1.0;
      for (const ContactPoint& c : manifold) {
        nearest = std::min(nearest, (c.p - place).norm());
        worst = std::max(worst, std::abs(c.separation));
      }
      worst = std::max(worst, nearest);
    }
  }
  CAPTURE(worst);
  CHECK(worst < 1e-13);
}

}  // namespace

// Oracle: closed form: chords of circles. Measured 1e-15 m in all of these, allowed 1e-13.
TEST_CASE("a disk over the edge of a box ends where its rim crosses the edge") {
  const Cylinder coin{0.5, 0.2};
  const Box slab{{2.0, 0.5, 2.0}};
  const double over = 0.2, half = std::sqrt(0.25 - over * over);
  const Pose above{{2.0 - over, 0.1, 0.3}, fromAxisAngle(Vec3::UnitY(), 0.2)};
  const Pose below{{0.0, -0.5, 0.0}, kUpright};
  hold(coin, above, slab, below, {{2.0, 0.0, 0.3 - half}, {2.0, 0.0, 0.3 + half}}, false);
  // Over a corner: it too carries.
  const Pose corner{{1.9, 0.1, 1.8}, kUpright};
  const double x = std::sqrt(0.25 - 0.04), z = std::sqrt(0.25 - 0.01);
  hold(coin, corner, slab, below, {{2.0, 0.0, 2.0}, {1.9 - x, 0.0, 2.0}, {2.0, 0.0, 1.8 - z}},
       false);
}

TEST_CASE("two disks share a lens") {
  const Cylinder wide{0.5, 0.2}, small{0.3, 0.4};
  const double d = 0.6, x = 0.5 * (d * d + 0.25 - 0.09) / d, half = std::sqrt(0.25 - x * x);
  const Quat yawed = fromAxisAngle(Vec3::UnitY(), 0.3);
  hold(small, {{d, 0.3, 0.0}, yawed}, wide, {Vec3::Zero(), kUpright},
       {{x, 0.1, -half}, {x, 0.1, half}}, false);
}

TEST_CASE("a lying cylinder touches as far as what is below it reaches") {
  const Cylinder log{0.1, 1.0};
  const Box slab{{0.3, 0.5, 0.4}};
  const Pose below{{0.0, -0.5, 0.0}, kUpright};
  // Across both edges, askew.
  const double yaw = 0.3, reach = 0.3 / std::cos(yaw);
  const Quat askew = fromAxisAngle(Vec3::UnitY(), 0.5 * std::numbers::pi - yaw) * kLying;
  const Vec3 along = askew * Vec3::UnitY();
  const Vec3 end = reach / std::abs(along.x()) * std::cos(yaw) * along;
  hold(log, {{0.0, 0.1, 0.0}, askew}, slab, below, {end, -end}, true);
  // On a slab that is wide enough, from end to end.
  hold(log, {{0.0, 0.1, 0.0}, askew}, Box{{2.0, 0.5, 2.0}}, below, {0.5 * along, -0.5 * along},
       true);
  // Across a cylinder that stands.
  const double offset = 0.15, half = std::sqrt(0.16 - offset * offset);
  hold(log, {{offset, 0.6, 0.0}, kLying}, Cylinder{0.4, 1.0}, {Vec3::Zero(), kUpright},
       {{offset, 0.5, -half}, {offset, 0.5, half}}, true);
}

TEST_CASE("lying cylinders share a line, or a point where they cross") {
  const Cylinder a{0.1, 1.0}, b{0.2, 0.6};
  const Quat turned = fromAxisAngle(Vec3::UnitY(), 0.8) * kLying;
  const Pose below{Vec3::Zero(), kLying};
  hold(a, {{0.0, 0.3, 0.3}, kLying}, b, below, {{0.0, 0.2, -0.2}, {0.0, 0.2, 0.3}}, true);
  hold(a, {{0.0, 0.3, 0.1}, turned}, b, below, {{0.0, 0.2, 0.1}}, true);
  // On the edge of a box, along it and across it.
  const double s = std::sqrt(0.5);
  const Box block{{0.5, 0.5, 0.5}};
  const Pose tipped{{0.0, -0.5 * std::sqrt(2.0), 0.0},
                    fromAxisAngle(Vec3::UnitZ(), 0.25 * std::numbers::pi)};
  hold(a, {{-0.1 * s, 0.1 * s, 0.2}, kLying}, block, tipped, {{0.0, 0.0, -0.3}, {0.0, 0.0, 0.5}},
       true);
  hold(a, {{0.0, 0.1, 0.1}, turned}, block, tipped, {{0.0, 0.0, 0.1}}, true);
}

// Oracle: closed form, to the square of the tilt. Where one end is nearer by a little the other is
// told as well, so that what lies on two ends does not rock from one to the other: three logs, of
// which one fell into the gap of the others, were lifted by 33 J a second.
TEST_CASE("a cylinder that lies along another or an edge, tilted a little, touches at both ends") {
  const Cylinder log{0.1, 1.0};
  const Quat tipped = fromAxisAngle(Vec3::UnitZ(), 0.25 * std::numbers::pi);
  const double s = std::sqrt(0.5);
  struct Below {
    Shape shape;
    Pose pose;
  };
  const Below all[] = {{Cylinder{0.2, 0.6}, {{0.0, -0.2, 0.0}, kLying}},
                       {Capsule{0.2, 0.6}, {{0.0, -0.2, 0.0}, kLying}},
                       {Box{{0.5, 0.5, 0.3}}, {{0.0, -s, 0.0}, tipped}}};
  for (const Below& below : all) {
    for (const double tilt : {1e-8, -1e-6, 1e-5, -1e-4, 8e-4}) {
      const Pose above{{0.0, 0.1 + 0.3 * std::abs(tilt), 0.0},
                       fromAxisAngle(Vec3::UnitX(), tilt) * kLying};
      for (const bool swapped : {false, true}) {
        CAPTURE(below.shape.index(), tilt, swapped);
        Manifold manifold;
        swapped ? collide(below.shape, below.pose, log, above, 1e-3, manifold)
                : collide(log, above, below.shape, below.pose, 1e-3, manifold);
        REQUIRE(manifold.size() == 2);
        std::sort(manifold.begin(), manifold.end(),
                  [](const ContactPoint& c, const ContactPoint& d) {
                    return c.separation < d.separation;
                  });
        const double side = tilt > 0.0 ? 1.0 : -1.0;  // where it is low
        const double off = tilt * tilt + 3e-15;
        CHECK(std::abs(manifold[0].separation) < off);
        CHECK(std::abs(manifold[1].separation - 0.6 * std::abs(tilt)) < off);
        CHECK(std::abs(manifold[0].p.z() - side * 0.3) < std::abs(tilt));
        CHECK(std::abs(manifold[1].p.z() + side * 0.3) < std::abs(tilt));
      }
    }
  }
}

// Oracle: closed form, to first order in the yaw. The faces beside the edge end where the capsule
// crosses it, but what holds it are the ends of what both share.
TEST_CASE("a capsule on the edge of a hull, turned a little, touches at both ends") {
  const double s = std::sqrt(0.75);
  std::vector<Vec3> corners;
  for (const double z : {-0.5, 0.5})
    for (int k = 0; k < 6; ++k)
      corners.emplace_back(std::cos(k * std::numbers::pi / 3.0),
                           std::sin(k * std::numbers::pi / 3.0) - s, z);
  const Shape prism =
      Hull{std::make_shared<const Polyhedron>(convexHull(corners)), -corners.front()};
  const Vec3 edge(0.5, 0.0, 0.0), out(0.5, s, 0.0);
  for (const double yaw : {0.0, 1e-7, -1e-5, 1e-4, -5e-4}) {
    const Pose above{edge + 0.2 * out, fromAxisAngle(out, yaw) * kLying};
    for (const bool swapped : {false, true}) {
      CAPTURE(yaw, swapped);
      Manifold manifold;
      swapped ? collide(prism, Pose{}, Capsule{0.2, 0.6}, above, 1e-3, manifold)
              : collide(Capsule{0.2, 0.6}, above, prism, Pose{}, 1e-3, manifold);
      REQUIRE(manifold.size() == 2);
      for (const ContactPoint& c : manifold) {
        CHECK(std::abs(c.separation) < 0.3 * yaw * yaw + 3e-16);
        CHECK(std::abs(std::abs(c.p.z()) - 0.3) < std::abs(yaw) + 1e-15);
        CHECK((c.p - edge - Vec3(0.0, 0.0, c.p.z())).norm() < 0.3 * std::abs(yaw) + 1e-15);
      }
      CHECK(manifold[0].p.z() * manifold[1].p.z() < 0.0);
    }
  }
}

TEST_CASE("a cylinder that leans touches with the lowest point of its rim, and rolls on it") {
  const Cylinder c{0.5, 0.8};
  for (double lean = 1e-5; lean < 1.5; lean *= 1.7) {
    const Quat q = fromAxisAngle(Vec3::UnitZ(), lean);
    const Vec3 contact = q * Vec3(-0.5, -0.4, 0.0);
    const Pose pose{{0.0, -contact.y(), 0.0}, q};
    for (const bool plane : {true, false}) {
      const Shape ground = plane ? Shape(HalfSpace{}) : Shape(Box{{5.0, 0.5, 5.0}});
      const Pose below{{0.0, plane ? 0.0 : -0.5, 0.0}, kUpright};
      Manifold manifold;
      collide(c, pose, ground, below, 1e-9, manifold);
      CAPTURE(lean, plane);
      REQUIRE(manifold.size() == 1);
      CHECK((manifold[0].p - Vec3(contact.x(), 0.0, 0.0)).norm() < 1e-15);
      CHECK(manifold[0].rimA == 0.5);
      CHECK(std::abs(manifold[0].separation) < 1e-15);
    }
  }
}

// Oracle: closed form. Exactly along each other, and off by rounding: the direction in which a cap
// leans is none then.
TEST_CASE("a cap that is level but for rounding is as far from a ball as its plane") {
  Random random(5);
  double worst = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const Pose pose = random.pose(0.3);
    const Vec3 above(random.uniform(-0.2, 0.2), 0.57, random.uniform(-0.2, 0.2));
    const Pose ball{toWorld(pose, above), random.rotation()};
    const double gap = separation(Cylinder{0.3, 0.5}, pose, Sphere{0.3}, ball);
    worst = std::max(worst, std::abs(gap - 0.02));
  }
  CAPTURE(worst);
  CHECK(worst < 1e-14);
}

// Oracle: the corners of the box. A face that is level with the cap but for a part of what counts
// as level carries no plane that is as wide as the cap's own: the tilted one passes below the far
// side of the disk. Measured 2.8e-16 m, allowed 1e-13.
TEST_CASE("a box that is nearly level on a wide disk touches with its own corners") {
  const Cylinder disk{1.5, 0.2};
  const Box box{{0.1, 0.2, 0.15}};
  Random random(5);
  double worst = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double tilt = std::pow(10.0, random.uniform(-8.0, -4.0));
    const Vec3 about = Vec3(random.uniform(-1.0, 1.0), 0.0, random.uniform(-1.0, 1.0)).normalized();
    Pose pose{Vec3::Zero(), fromAxisAngle(about, tilt)};
    std::vector<Vec3> corners;
    for (const double x : {-0.1, 0.1})
      for (const double z : {-0.15, 0.15}) corners.push_back(toWorld(pose, {x, -0.2, z}));
    double lowest = 1.0;
    for (const Vec3& corner : corners) lowest = std::min(lowest, corner.y());
    const Vec3 shift{random.uniform(-1.0, 1.0), 0.1 - lowest, random.uniform(-0.8, 0.8)};
    pose.x += shift;
    for (const bool swapped : {false, true}) {
      Manifold manifold;
      if (swapped)
        collide(disk, Pose{}, box, pose, 1e-3, manifold);
      else
        collide(box, pose, disk, Pose{}, 1e-3, manifold);
      CAPTURE(k, tilt, swapped);
      REQUIRE(manifold.size() == 4);
      for (const ContactPoint& c : manifold) {
        double nearest = 1.0;
        for (const Vec3& corner : corners) {
          const Vec3 p = corner + shift;
          nearest = std::min(nearest, std::hypot(c.p.x() - p.x(), c.p.z() - p.z()) +
                                          std::abs(c.separation - (p.y() - 0.1)));
        }
        worst = std::max({worst, nearest, std::abs(std::abs(c.n.y()) - 1.0)});
      }
    }
  }
  CAPTURE(worst);
  CHECK(worst < 1e-13);
}

// Oracle: closed form: the lower end of the chord in which the line of the cylinder meets the lower
// face of the box, turned and swapped too. Below a lean of 2e-10 both ends count. Measured 3e-6 m
// for places, which a lean moves by its own size times the radius, and for gaps, its square, less
// than is shown; allowed 1e-5 and 1e-11.
TEST_CASE("what is nearly level on a lying cylinder touches with its lower edge, or with two") {
  const Cylinder log{2.0, 3.0};
  const double yaw = 0.7;
  Random random(7);
  double place = 0.0, gap = 0.0;
  for (const double lean : {-1.2e-6, 1.2e-6, -1e-7, 1e-7, -1e-10, 1e-10, 1e-11, 0.0})
    for (int k = 0; k < 48; ++k) {
      const bool disk = k % 4 > 1;
      const Shape box = disk ? Shape(Cylinder{0.18, 0.1}) : Shape(Box{{0.1, 0.05, 0.075}});
      const double end = disk ? 0.18 : 0.075 / std::cos(yaw);
      const Pose pose{{0.0, 0.05 * std::cos(lean) + end * std::sin(std::abs(lean)), 0.0},
                      fromAxisAngle(Vec3::UnitX(), lean) * fromAxisAngle(Vec3::UnitY(), yaw)};
      const Pose scene = k < 2 ? Pose{} : random.pose(1.0);
      const Manifold manifold =
          pointsOf(box, pose, log, {{0.0, -2.0, 0.0}, kLying}, scene, k % 2 == 1);
      CAPTURE(lean, k);
      REQUIRE(manifold.size() == (std::abs(lean) < 1e-9 ? 2 : 1));
      if (manifold.size() == 2) CHECK(manifold[0].p.z() * manifold[1].p.z() < 0.0);
      for (const ContactPoint& c : manifold) {
        const double low = c.p.z() * lean >= 0.0 ? 0.0 : 2.0 * end * std::abs(lean);
        const double side = manifold.size() == 1 ? lean : c.p.z();
        place = std::max(place, (c.p - Vec3(0.0, 0.0, std::copysign(end, side))).norm());
        gap = std::max(gap, std::abs(c.separation - low));
      }
    }
  CAPTURE(place, gap);
  CHECK(place < 1e-5);
  CHECK(gap < 1e-11);
}

// Oracle: a direction has no length. A search that nears the place where solids touch asks along
// vectors of any. Measured 0 m; a tenth of a metre with what is rounding told by length alone.
TEST_CASE("the outermost point of a cylinder is the same along any multiple of a direction") {
  const convex::Core core = convex::coreOf(Cylinder{0.1, 0.25}, Mat3::Identity(), Vec3::Zero());
  const Vec3 n(0.6, 0.5, -0.3);
  int vertex = 0;
  const Vec3 expected = convex::outermost(core, n, vertex);
  for (const double length : {1e-100, 1e-15, 1e-12, 1e8})
    CHECK((convex::outermost(core, length * n, vertex) - expected).norm() < 1e-16);
}

}  // namespace tumble
