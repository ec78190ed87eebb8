// What a body covers of the page, and which points bound what a camera sees.
#include "render/silhouette.h"

#include <cmath>

#include "tests/catch.h"

using namespace tumble;
using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Straight at the origin from 10 m, 100 px for a metre there.
const Projection kAhead({{0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}, 2.0 * std::atan(0.5) * 180.0 / M_PI},
                        1000.0, 1000.0);

AlignedBox2d around(double x, double y, double half) {
  const Vector2d centre(x, y), reach(half, half);
  return {centre - reach, centre + reach};
}

}  // namespace

// Oracle: two methods agree. Measured 0: the same points bound both eyes.
TEST_CASE("the outermost points place a camera of any field and shape like all points") {
  std::vector<Vector3d> points;
  for (int i = 0; i < 3000; ++i)
    points.emplace_back(std::sin(1.7 * i * i), 2.0 * std::sin(0.9 * i * i + 1.0),
                        3.0 * std::cos(2.3 * i * i));
  for (const double elevation : {-20.0, 0.0, 12.0, 75.0}) {
    const std::vector<Vector3d> outer =
        outermost(points, frame(points, 35.0, elevation, 24.0, 16.0 / 9.0));
    CHECK(outer.size() < 200);  // measured 59 to 71
    for (const double fov : {5.0, 24.0, 90.0})
      for (const double aspect : {0.4, 1.0, 2.5}) {
        const Margins margins{.left = 0.05, .right = 0.1, .top = 0.2, .bottom = 0.02};
        const Camera all = frame(points, 35.0, elevation, fov, aspect, margins);
        const Camera few = frame(outer, 35.0, elevation, fov, aspect, margins);
        CHECK((all.eye - few.eye).norm() == 0.0);
      }
  }
}

// Oracle: closed form, of a square that stands on a corner: |x − 500| + |y − 500| = 100 √2 px.
TEST_CASE(
    "the silhouette of a box meets what its sides reach, and contains what lies within them") {
  Instance plate;
  plate.scale = {1.0, 1.0, 1e-9};
  plate.orientation = Eigen::AngleAxisd(M_PI / 4.0, Vector3d::UnitZ());
  const std::optional<Silhouette> silhouette = silhouetteOf(plate, kAhead);
  REQUIRE(silhouette);
  CHECK(silhouette->depth == Approx(10.0));
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      // Half of 5 px: its near corner is 5 px nearer by that sum, its far one 5 px further.
      const double out = 0.5 * (100.0 * std::sqrt(2.0) + 10.0), in = out - 10.0;
      CHECK(!silhouette->meets(around(500.0 + x * (out + 0.1), 500.0 + y * (out + 0.1), 5.0)));
      CHECK(silhouette->meets(around(500.0 + x * (out - 0.1), 500.0 + y * (out - 0.1), 5.0)));
      CHECK(!silhouette->contains(around(500.0 + x * (in + 0.1), 500.0 + y * (in + 0.1), 5.0)));
      CHECK(silhouette->contains(around(500.0 + x * (in - 0.1), 500.0 + y * (in - 0.1), 5.0)));
    }
}

TEST_CASE(
    "the silhouette of a ball is its circle, and of what reaches behind the eye there is none") {
  Instance ball;
  ball.form = Form::Sphere;
  const std::optional<Silhouette> silhouette = silhouetteOf(ball, kAhead);
  REQUIRE(silhouette);
  CHECK(!silhouette->meets(around(500.0 + 74.0, 500.0 + 74.0, 1.0)));  // 103 px from the middle
  CHECK(silhouette->meets(around(500.0 + 71.0, 500.0 + 71.0, 1.0)));   // 99 px
  ball.position.z() = 9.9;
  CHECK(!silhouetteOf(ball, kAhead));
}
