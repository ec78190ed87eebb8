// Framing: the nearest camera that shows every point.
#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/catch.h"

using namespace tumble;
using Eigen::Vector3d;

namespace {

const std::vector<Vector3d> kPoints = {
    {-3.0, 0.0, 1.0}, {2.0, 0.2, -0.5}, {0.5, 2.4, 0.3}, {1.0, 0.0, 2.0}};

struct Shares {
  double left = 1.0, right = 1.0, top = 1.0, bottom = 1.0;
};

/// What is free between the points and each side, as a share of the image.
Shares freeShares(const Camera& camera, double aspect) {
  const Projection projection(camera, aspect, 1.0);
  Shares free;
  for (const Vector3d& point : kPoints) {
    const auto place = projection.project(point);
    REQUIRE(place);
    free.left = std::min(free.left, place->x() / aspect);
    free.right = std::min(free.right, 1.0 - place->x() / aspect);
    free.top = std::min(free.top, place->y());
    free.bottom = std::min(free.bottom, 1.0 - place->y());
  }
  return free;
}

}  // namespace

// Oracle: the definition. Only rounding remains: measured 2e-16, allowed 1e-12.
TEST_CASE("framed points keep every margin and touch two opposite ones") {
  const Margins margins{0.05, 0.10, 0.15, 0.08};
  for (const double aspect : {16.0 / 9.0, 1.0, 0.3}) {
    for (const double azimuth : {0.0, 14.0, -28.0, 130.0}) {
      for (const double elevation : {0.0, 12.0, -20.0, 75.0}) {
        const Shares free =
            freeShares(frame(kPoints, azimuth, elevation, 24.0, aspect, margins), aspect);
        CHECK(free.left > margins.left - 1e-12);
        CHECK(free.right > margins.right - 1e-12);
        CHECK(free.top > margins.top - 1e-12);
        CHECK(free.bottom > margins.bottom - 1e-12);
        const bool across = free.left < margins.left + 1e-12 && free.right < margins.right + 1e-12;
        const bool upright = free.top < margins.top + 1e-12 && free.bottom < margins.bottom + 1e-12;
        CHECK((across || upright));
      }
    }
  }
}

TEST_CASE("azimuth 0 looks along −Z, 90 along −X, and a positive elevation looks down") {
  const auto sight = [](double azimuth, double elevation) {
    const Camera camera = frame(kPoints, azimuth, elevation, 24.0, 1.5);
    return Vector3d((camera.target - camera.eye).normalized());
  };
  CHECK((sight(0.0, 0.0) - Vector3d(0.0, 0.0, -1.0)).norm() < 1e-12);
  CHECK((sight(90.0, 0.0) - Vector3d(-1.0, 0.0, 0.0)).norm() < 1e-12);
  CHECK((sight(0.0, 30.0) - Vector3d(0.0, -0.5, -std::sqrt(0.75))).norm() < 1e-12);
}

// Oracle: by hand. On a map +X is to the right and −Z at the top, and the azimuth turns it.
TEST_CASE("seen from straight above or below, the azimuth turns the picture") {
  for (const double elevation : {90.0, -90.0}) {
    for (const double azimuth : {0.0, 30.0, 90.0, 200.0}) {
      const Camera camera = frame(kPoints, azimuth, elevation, 24.0, 1.5);
      const Projection projection(camera, 1500, 1000);
      const double a = azimuth * std::numbers::pi / 180.0;
      CHECK((projection.right() - Vector3d(std::cos(a), 0.0, -std::sin(a))).norm() < 1e-12);
      CHECK(std::abs(projection.forward().y()) == Approx(1.0).epsilon(1e-12));
      const Shares free = freeShares(camera, 1.5);
      CHECK(std::min({free.left, free.right, free.top, free.bottom}) > 0.06 - 1e-9);
    }
  }
}

// Oracle: the pinhole, by hand: 0.2 of half a height per metre at ten metres.
TEST_CASE("a point lands where the pinhole puts it, and in clip space at the same place") {
  const Camera camera{{0.0, 1.0, 10.0}, {0.0, 1.0, 0.0}, 2.0 * 11.309932474020213};
  const Projection projection(camera, 1280, 720);
  const Vector3d place = *projection.project({1.0, 2.0, 0.0});
  CHECK((place - Vector3d(820.0, 180.0, 10.0)).norm() < 1e-9);
  CHECK_FALSE(projection.project({0.0, 1.0, 9.5}));   // nearer than the near plane
  CHECK_FALSE(projection.project({0.0, 1.0, 11.0}));  // behind the eye
  const Eigen::Vector4d clip = projection.matrix() * Eigen::Vector4d(1.0, 2.0, 0.0, 1.0);
  CHECK(640.0 * (1.0 + clip.x() / clip.w()) == Approx(820.0).epsilon(1e-12));
  CHECK(360.0 * (1.0 - clip.y() / clip.w()) == Approx(180.0).epsilon(1e-12));
}

TEST_CASE("no points, no room and no direction are refused") {
  CHECK_THROWS_AS(frame({}, 0.0, 0.0, 24.0, 1.5), std::invalid_argument);
  CHECK_THROWS_AS(frame(kPoints, 0.0, 0.0, 24.0, 1.5, {0.5, 0.5, 0.1, 0.1}), std::invalid_argument);
  CHECK_THROWS_AS(Projection(Camera{{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, 24.0}, 10, 10),
                  std::invalid_argument);
}
