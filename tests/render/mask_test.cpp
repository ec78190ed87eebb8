// Masks of depth and identity.
#include <array>
#include <cmath>

#include "render/mask.h"
#include "tests/catch.h"
#include "tests/render/studio.h"

using namespace tumble;

namespace {

const Colour kBall = {1.0f / 255.0f, 200.0f / 255.0f, 77.0f / 255.0f};
const Colour kBox = {254.0f / 255.0f, 3.0f / 255.0f, 128.0f / 255.0f};
const Colour kFloor = {9.0f / 255.0f, 8.0f / 255.0f, 7.0f / 255.0f};

// A ball of 0.5 m in the middle, a box of 1 m to its right and 2 m behind, seen from 10 m.
Picture ballAndBox() {
  Picture picture;
  picture.camera = straight(1.0);
  picture.floor.visible = false;
  Instance ball;
  ball.form = Form::Sphere;
  ball.position = {0.0, 1.0, 0.0};
  ball.scale = {0.5, 0.5, 0.5};
  ball.colour = kBall;
  Instance box;
  box.position = {1.2, 1.0, -2.5};
  box.scale = {0.5, 0.5, 0.5};
  box.colour = kBox;
  picture.instances = {ball, box};
  return picture;
}

}  // namespace

// Oracle: where a line of sight meets a sphere, a plane of the box, and the floor. Depths are in
// single precision, 1e-6 m at 12 m: allowed are four of these, ten for the floor.
TEST_CASE("masks tell for each pixel which body it shows, and how far that is along the sight") {
  const Picture picture = ballAndBox();
  RenderOptions options;  // 180 pixels per metre at z = 0
  Masks masks = studio().drawMasks(picture, options);
  const auto depth = [&](int x, int y) {
    return masks.depth[static_cast<std::size_t>(y) * 1280 + x];
  };

  // Up to the rim of the ball; rays through the middles of pixels.
  for (const int off : {0, 30, 60, 85}) {
    const double slope = (off + 0.5) / 1800.0, up = 0.5 / 1800.0,
                 squared = 1.0 + slope * slope + up * up;
    // |(s d) − 10 f|² = r² for the depth s.
    const double s = (10.0 - std::sqrt(100.0 - squared * (100.0 - 0.25))) / squared;
    CAPTURE(off);
    CHECK(depth(640 + off, 359) == Approx(s).margin(4e-6));
    CHECK(pixel(masks.identity, 640 + off, 359) == std::array{1, 200, 77});
  }
  CHECK(depth(640 + 144 + 40, 360) == Approx(12.0).margin(4e-6));
  CHECK(pixel(masks.identity, 640 + 144 + 40, 360) == std::array{254, 3, 128});
  CHECK(depth(100, 100) == 0.0f);
  CHECK(pixel(masks.identity, 100, 100) == std::array{0, 0, 0});

  // No pixel has a colour of two bodies.
  for (std::size_t i = 0; i < masks.depth.size(); ++i) {
    const std::uint8_t* p = masks.identity.rgb.data() + 3 * i;
    const bool known = (p[0] == 1 && p[1] == 200 && p[2] == 77) ||
                       (p[0] == 254 && p[1] == 3 && p[2] == 128) || (p[0] + p[1] + p[2] == 0);
    if (!known) FAIL("a colour that stands for no body: " << int(p[0]) << ' ' << int(p[1]));
  }

  // The floor 1 m below the eye: at (y + 1/2) pixels below the middle 1800/(y + 1/2) m away.
  addFloor(picture, kFloor, masks);
  CHECK(depth(200, 360 + 150) == Approx(1800.0 / 150.5).margin(1e-5));
  CHECK(pixel(masks.identity, 200, 360 + 150) == std::array{9, 8, 7});
  CHECK(pixel(masks.identity, 640, 359) == std::array{1, 200, 77});
  CHECK(depth(200, 100) == 0.0f);
}
