// Ellipsoids, bodies of two colours, and the size of the page.
#include <cmath>

#include "tests/render/studio.h"

using namespace tumble;

namespace {

Picture single(const Instance& instance) {
  Picture picture;
  picture.camera = straight(0.0);
  picture.floor.visible = false;
  picture.radius = 2.0;
  picture.instances = {instance};
  return picture;
}

RenderOptions full() {
  RenderOptions options;
  options.width = 1280;
  options.height = 720;
  return options;
}

}  // namespace

// A point at z = 0 stands 180 px per metre from the middle. The outline of an ellipsoid of
// semi-axes a, b, c seen from the distance D along c is a/√(1 − c²/D²) wide: 181.6 px for a = 1, b
// = 0.5 and c = 0.4 rather than 180.1; the mesh lies within a pixel of it.
TEST_CASE("an ellipsoid fills the outline that its semi-axes have") {
  Instance body;
  body.form = Form::Ellipsoid;
  body.scale = {1.0, 0.5, 0.4};
  const Picture empty = [] {
    Picture picture = single({});
    picture.instances.clear();
    return picture;
  }();
  const Image paper = studio().draw(empty, full()), image = studio().draw(single(body), full());
  const auto drawn = [&](int x, int y) { return pixel(paper, x, y) != pixel(image, x, y); };
  const double a = 180.0 / std::sqrt(1.0 - 0.16 / 100.0), b = 0.5 * a;
  CHECK(drawn(640 + static_cast<int>(a - 2.5), 360));
  CHECK_FALSE(drawn(640 + static_cast<int>(a + 2.5), 360));
  CHECK(drawn(640, 360 - static_cast<int>(b - 2.5)));
  CHECK_FALSE(drawn(640, 360 - static_cast<int>(b + 2.5)));
  // Turned by a quarter about the line of sight, width and height change places.
  body.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ()));
  const Image turned = studio().draw(single(body), full());
  CHECK(pixel(turned, 640, 360 - static_cast<int>(a - 2.5)) !=
        pixel(paper, 640, 360 - static_cast<int>(a - 2.5)));
  CHECK(lowestPoint(body) == Approx(-1.0));
  CHECK(reachOf(body) == 1.0);
}

TEST_CASE("the half of a body with z below zero has its own colour, whichever way it faces") {
  const Finish finish = GENERATE(Finish::Solid, Finish::Ghost);
  const Form form = GENERATE(Form::Box, Form::Sphere, Form::Cylinder, Form::Ellipsoid);
  Instance body;
  body.form = form;
  body.finish = finish;
  body.scale = Eigen::Vector3d::Constant(0.5);
  body.colour = {0.1f, 0.2f, 0.9f};
  body.back = Colour{0.9f, 0.4f, 0.1f};
  const auto middle = [&](double degrees) {
    body.orientation =
        Eigen::Quaterniond(Eigen::AngleAxisd(degrees * EIGEN_PI / 180.0, Eigen::Vector3d::UnitY()));
    return pixel(studio().draw(single(body), full()), 700, 390);
  };
  const auto front = middle(0.0), behind = middle(180.0);
  CHECK(front[2] > front[0] + 40);
  CHECK(behind[0] > behind[2] + 40);
}

TEST_CASE("a smaller page makes text and lines larger, and moves no body") {
  Instance body;
  body.scale.setConstant(0.5);
  Picture picture = single(body);
  const auto changed = [&](double page) {
    RenderOptions options = full();
    options.pageHeight = page;
    picture.labels.clear();
    const Image without = studio().draw(picture, options);
    picture.labels = {{Eigen::Vector3d(0.0, 1.0, 0.0), {0.0, 0.0}, "polhode", 14.0f}};
    const Image with = studio().draw(picture, options);
    Eigen::AlignedBox2i extent;
    for (int y = 0; y < 720; ++y)
      for (int x = 0; x < 1280; ++x)
        if (pixel(with, x, y) != pixel(without, x, y)) extent.extend(Eigen::Vector2i(x, y));
    REQUIRE_FALSE(extent.isEmpty());
    return Eigen::Vector2i(extent.sizes() + Eigen::Vector2i::Ones());
  };
  // Oracle: twice as wide and twice as high, to the pixel that begins or ends a letter.
  const Eigen::Vector2i normal = changed(720.0), large = changed(360.0);
  CHECK(normal.x() > 20);
  CHECK((large - 2 * normal).cwiseAbs().maxCoeff() <= 3);
}
