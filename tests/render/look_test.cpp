// What the picture says about space; long, for one set of helpers measures all that is drawn:
// shadows, ghosts, glass, bodies that sank, and what stands beside them, labels and panels too.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/camera.h"
#include "render/overlay.h"
#include "render/page.h"
#include "render/sheet.h"
#include "tests/render/plates.h"
#include "tests/render/studio.h"

using namespace tumble;
using Eigen::Vector3d;

namespace {

Picture stage() {
  Picture picture;
  picture.camera = {{0.0, 3.0, 9.0}, {0.0, 0.5, 0.0}, 30.0};
  picture.centre = {0.0, 0.5, 0.0};
  picture.radius = 2.5;
  picture.floor.rule = false;
  picture.floor.grid = picture.floor.fineGrid = 0.0;
  return picture;
}

Instance box(const Vector3d& position, Finish finish) {
  Instance body;
  body.position = position;
  body.scale = {0.3, 0.3, 0.3};
  body.finish = finish;
  body.alpha = 0.6f;
  return body;
}

double brightnessAt(const Image& image, const Picture& picture, const Vector3d& point) {
  const Vector3d place = *Projection(picture.camera, 1280, 720).project(point);
  return brightness(image, static_cast<int>(place.x()), static_cast<int>(place.y()));
}

}  // namespace

// Oracle: geometry. The light stands 38° to the left of the onlooker (who looks along −Z here) and
// 52° high: a point at height y casts its shadow y/tan 52° away, to the right and backwards.
TEST_CASE("a ball casts its shadow where the light says") {
  Picture picture = stage();
  const Image empty = studio().draw(picture, kFull);
  Instance ball;
  ball.form = Form::Sphere;
  ball.position = {-0.4, 0.7, 0.3};
  ball.scale = Vector3d::Constant(0.25);
  picture.instances = {ball};
  const Image image = studio().draw(picture, kFull);
  const double degree = std::numbers::pi / 180.0, away = 0.7 / std::tan(52.0 * degree);
  const Vector3d foot(-0.4, 0.0, 0.3),
      towards(std::sin(38.0 * degree), 0.0, -std::cos(38.0 * degree));
  const auto ratio = [&](const Vector3d& point) {
    return brightnessAt(image, picture, point) / brightnessAt(empty, picture, point);
  };
  CHECK(ratio(foot + away * towards) < 0.90);
  CHECK(ratio(foot - away * towards) > 0.99);
  CHECK(ratio(foot + away * Vector3d(-towards.x(), 0.0, towards.z())) > 0.98);
}

// Oracle: geometry. The face of the slab stands 0.3 before the middle of a ball of radius 0.5:
// within 0.4 of its middle the ball stands out of it.
TEST_CASE("a ball reaches through a face that cuts it before its middle") {
  Picture picture = stage();
  picture.camera = {{0.0, 0.5, 12.0}, {0.0, 0.5, 0.0}, 20.0};
  Instance slab = box({0.0, 0.5, 0.0}, Finish::Solid);
  slab.colour = {0.9f, 0.9f, 0.9f};
  Instance ball = slab;
  ball.form = Form::Sphere;
  ball.colour = {0.1f, 0.1f, 0.1f};
  ball.banded = false;
  ball.scale.setConstant(0.5);
  slab.scale = {1.0, 1.0, 0.3};
  picture.instances = {slab, ball};
  const Image image = studio().draw(picture, kFull);
  const auto dark = [&](double x) { return brightnessAt(image, picture, {x, 0.5, 0.3}) < 100.0; };
  CHECK(dark(0.0));
  CHECK(dark(0.37));
  CHECK(dark(-0.37));
  CHECK_FALSE(dark(0.43));
  CHECK_FALSE(dark(-0.43));
}

TEST_CASE("a body shades the body behind it in the light, and a ghost does not") {
  Picture picture = stage();
  picture.instances = {box({0.0, 0.3, 0.0}, Finish::Solid)};
  const Image alone = studio().draw(picture, kFull);
  const double degree = std::numbers::pi / 180.0;
  const Vector3d light(-std::sin(38.0 * degree) * std::cos(52.0 * degree), std::sin(52.0 * degree),
                       std::cos(38.0 * degree) * std::cos(52.0 * degree));
  const Vector3d top(0.0, 0.6, 0.0);
  for (const Finish finish : {Finish::Solid, Finish::Ghost}) {
    Picture shaded = picture;
    shaded.instances.push_back(box(top + 1.2 * light, finish));
    const double ratio = brightnessAt(studio().draw(shaded, kFull), picture, top) /
                         brightnessAt(alone, picture, top);
    if (finish == Finish::Solid)
      CHECK(ratio < 0.85);
    else
      CHECK(ratio > 0.97);
  }
}

TEST_CASE("a ball is brightest towards the light: on its upper left") {
  Picture picture = stage();
  Instance ball = box({0.0, 0.6, 0.0}, Finish::Solid);
  ball.form = Form::Sphere;
  ball.orientation =
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX());  // its band lies level
  picture.instances = {ball};
  const Image image = studio().draw(picture, kFull);
  const auto at = [&](double x, double y) {
    return brightnessAt(image, picture, Vector3d(x, 0.6 + y, 0.0));
  };
  CHECK(at(-0.13, 0.13) > 1.15 * at(0.13, 0.13));
  CHECK(at(-0.13, 0.13) > 1.3 * at(-0.13, -0.13));
}

TEST_CASE("a box has dark edges") {
  Picture picture = stage();
  picture.instances = {box({0.0, 0.3, 0.0}, Finish::Solid)};
  const Image image = studio().draw(picture, kFull);
  const double edge = brightnessAt(image, picture, {0.0, 0.6, 0.3});
  CHECK(edge < 0.85 * brightnessAt(image, picture, {0.0, 0.6, 0.1}));
  CHECK(edge < 0.95 * brightnessAt(image, picture, {0.0, 0.45, 0.3}));
}

// Oracle: invariance. Lengths differ by a factor alone; what remains is rounding of single
// precision. Pixels off by more than 2 of 255: measured 0, allowed 1e-4 of them.
TEST_CASE("a picture of a world a hundred thousand times as small looks the same") {
  Picture picture = stage();
  Instance ball = box({-0.5, 0.2, 0.4}, Finish::Solid),
           barrel = box({0.6, 0.3, 0.0}, Finish::Solid);
  ball.form = Form::Sphere;
  ball.scale.setConstant(0.2);
  barrel.form = Form::Cylinder;
  ball.back = barrel.back = Colour{0.9f, 0.8f, 0.2f};
  picture.instances = {box({0.0, 0.3, 0.0}, Finish::Solid), ball, barrel};
  const Image large = studio().draw(picture, kFull);
  constexpr double kSmall = 1e-5;
  picture.camera.eye *= kSmall;
  picture.camera.target *= kSmall;
  picture.centre *= kSmall;
  picture.radius *= kSmall;
  for (Instance& body : picture.instances) {
    body.position *= kSmall;
    body.scale *= kSmall;
  }
  const Image small = studio().draw(picture, kFull);
  std::size_t off = 0;
  for (std::size_t i = 0; i < large.rgb.size(); ++i)
    off += std::abs(large.rgb[i] - small.rgb[i]) > 2;
  CHECK(static_cast<double>(off) < 1e-4 * static_cast<double>(large.rgb.size()));
}

// The wall stands to the right, its shadow falls further right: what darkens the slab is the sky it
// hides.
TEST_CASE("a slab is darker beside a wall than alone, without being in its shadow") {
  Picture picture = stage();
  Instance slab = box({0.0, 0.05, 0.0}, Finish::Solid);
  slab.scale = {1.5, 0.05, 1.0};
  picture.instances = {slab};
  const Image alone = studio().draw(picture, kFull);
  Instance wall = box({0.5, 0.6, 0.0}, Finish::Solid);
  wall.scale = {0.1, 0.5, 0.8};
  picture.instances.push_back(wall);
  const Image beside = studio().draw(picture, kFull);
  const auto ratio = [&](double x) {
    return brightnessAt(beside, picture, {x, 0.1, 0.0}) /
           brightnessAt(alone, picture, {x, 0.1, 0.0});
  };
  CHECK(ratio(0.34) < 0.97);
  CHECK(ratio(-0.9) == Approx(1.0).margin(0.01));
}

// Oracle: symmetry. Measured: equal to the last bit.
TEST_CASE("without a floor a picture is the same at every height") {
  const auto at = [](double height) {
    Picture picture = stage();
    picture.floor.visible = false;
    picture.instances = {box({0.2, 0.5, 0.0}, Finish::Solid), box({-0.8, 0.1, 0.4}, Finish::Solid)};
    for (Vector3d* point : {&picture.camera.eye, &picture.camera.target, &picture.centre,
                            &picture.instances[0].position, &picture.instances[1].position})
      point->y() += height;
    return studio().draw(picture, kFull);
  };
  const ImageDifference below = compare(at(0.0), at(-4.0)), above = compare(at(0.0), at(4.0));
  CAPTURE(below.largest, above.largest);
  CHECK(below.passes());
  CHECK(above.passes());
}

TEST_CASE("the floor is there in the middle and has become the page at twice the radius") {
  Picture picture = stage();
  picture.radius = 1.0;
  const Image with = studio().draw(picture, kFull);
  picture.floor.visible = false;
  const Image without = studio().draw(picture, kFull);
  const auto change = [&](const Vector3d& p) {
    return brightnessAt(without, picture, p) - brightnessAt(with, picture, p);
  };
  CHECK(change({0.0, 0.0, 0.0}) > 3.0);
  CHECK(change({0.7, 0.0, 0.0}) > 3.0);
  CHECK(change({1.97, 0.0, 0.0}) == 0.0);
}

// Measured: mean difference 0.4 (none) and 0.2 (2×2) levels; one missing body gives more.
TEST_CASE("the ways of anti-aliasing differ at edges only") {
  RenderOptions options;
  const Image smooth = studio().draw(plates::sunk(), options);
  for (const AntiAlias other : {AntiAlias::None, AntiAlias::Ssaa2x2}) {
    options.antialias = other;
    CHECK(compare(smooth, studio().draw(plates::sunk(), options)).mean < 0.5);
  }
}

// Oracle: scaling. Everything given in pixels is for an image 720 high. Measured 0.3 levels.
TEST_CASE("an image of half the size shows the same picture") {
  Picture picture = plates::strobe();
  RenderOptions large, small;
  small.width = 640, small.height = 360;
  const Image big = studio().draw(picture, large), half = studio().draw(picture, small);
  double sum = 0.0;
  for (int y = 0; y < 360; ++y)
    for (int x = 0; x < 640; ++x)
      sum += std::abs(0.25 * (brightness(big, 2 * x, 2 * y) + brightness(big, 2 * x + 1, 2 * y) +
                              brightness(big, 2 * x, 2 * y + 1) +
                              brightness(big, 2 * x + 1, 2 * y + 1)) -
                      brightness(half, x, y));
  CHECK(sum / (640 * 360) < 0.8);
}

// Oracle: symmetry. At each sample only the nearest ghost is seen, so the order of ghosts means
// nothing.
TEST_CASE("ghosts and glass look the same in whatever order they are given") {
  for (const Finish finish : {Finish::Ghost, Finish::Glass}) {
    Picture picture = stage();
    for (int i = 0; i < 6; ++i) {
      Instance body = box({-0.5 + 0.2 * i, 0.4 + 0.1 * i, 0.3 * (i % 3)}, finish);
      body.colour = {0.2f * static_cast<float>(i % 5), 0.5f, 0.7f};
      picture.instances.push_back(body);
    }
    Picture reversed = picture;
    std::reverse(reversed.instances.begin(), reversed.instances.end());
    CHECK(studio().draw(picture, kFull) == studio().draw(reversed, kFull));
  }
}

// Oracle: by hand. One behind the other, ghosts do not add up.
TEST_CASE("two ghosts in line are no denser than the nearer one") {
  Picture one = stage();
  one.floor.visible = false;
  one.instances = {box({0.0, 0.5, 0.5}, Finish::Ghost)};
  Picture two = one;
  two.instances.push_back(box({0.0, 0.5, -0.5}, Finish::Ghost));
  const Image alone = studio().draw(one, kFull), both = studio().draw(two, kFull);
  CHECK(brightnessAt(both, one, {0.0, 0.5, 0.8}) == brightnessAt(alone, one, {0.0, 0.5, 0.8}));
}

// Oracle: by hand. What was earlier does not cover what came later, though it is nearer; what
// stands before them hides both.
TEST_CASE("a ghost is hidden by what has a higher layer, and by what stands before it") {
  const auto layered = [](const Vector3d& place, Finish finish, int layer, float red) {
    Instance body = box(place, finish);
    body.layer = layer;
    body.colour = {red, 0.5f, 0.7f};
    return body;
  };
  const Vector3d inside(0.0, 0.5, -0.2), beside(0.45, 0.5, 1.2), before(0.0, 0.5, 2.3);
  for (const Finish later : {Finish::Ghost, Finish::Solid}) {
    Picture alone = stage();
    alone.floor.visible = false;
    alone.instances = {layered({0.0, 0.5, -0.5}, later, 2, 0.9f)};
    Picture both = alone;
    both.instances.push_back(layered({0.2, 0.5, 0.9}, Finish::Ghost, 1, 0.2f));
    const Image one = studio().draw(alone, kFull), two = studio().draw(both, kFull);
    CHECK(brightnessAt(two, alone, inside) == brightnessAt(one, alone, inside));
    CHECK(brightnessAt(two, alone, beside) < brightnessAt(one, alone, beside));
    Picture wall = alone;
    wall.instances = {layered({0.0, 0.5, 2.0}, Finish::Solid, 0, 0.9f)};
    both.instances.push_back(wall.instances.front());
    CHECK(brightnessAt(studio().draw(both, kFull), wall, before) ==
          brightnessAt(studio().draw(wall, kFull), wall, before));
  }
}

// Oracle: symmetry. A body at rest is in one place at all times: its ghosts must not add up.
TEST_CASE("ghosts in one place are drawn once, and not over the body that stands there") {
  Picture one = stage(), many = one;
  for (const double x : {-0.5, 0.5}) {
    const Finish last = x < 0.0 ? Finish::Glass : Finish::Solid;
    for (int i = 0; i < 4; ++i) {
      many.instances.push_back(
          box({x, 0.5, 1e-12 * i}, last == Finish::Solid ? Finish::Ghost : last));
      many.instances.back().colour = {0.2f * static_cast<float>(i), 0.5f, 0.5f};
    }
    many.instances.push_back(box({x, 0.5, 0.0}, last));
    one.instances.push_back(many.instances.back());
  }
  CHECK(studio().draw(one, kFull) == studio().draw(many, kFull));
  // Half a pixel further there is something to see.
  many.instances.push_back(box({-0.5, 0.505, 0.0}, Finish::Glass));
  CHECK_FALSE(studio().draw(one, kFull) == studio().draw(many, kFull));
}

// Oracle: closed form of the lowest point of each form, turned by an angle a about Z.
TEST_CASE("the lowest point of a turned body is known") {
  const double a = 0.4, s = std::sin(a), c = std::cos(a);
  Instance body;
  body.position = {5.0, 2.0, 1.0};
  body.orientation = Eigen::AngleAxisd(a, Vector3d::UnitZ());
  body.scale = {0.3, 0.2, 0.3};
  CHECK(lowestPoint(body) == Approx(2.0 - (0.3 * s + 0.2 * c)).epsilon(1e-12));
  body.form = Form::Cylinder;
  CHECK(lowestPoint(body) == Approx(2.0 - (0.3 * s + 0.2 * c)).epsilon(1e-12));
  body.form = Form::Sphere;
  CHECK(lowestPoint(body) == Approx(2.0 - 0.3).epsilon(1e-12));
}

// Oracle: by hand. Below the floor 35 % of the body are left over the floor.
TEST_CASE("what sank below the floor shows through it") {
  for (const Form form : {Form::Box, Form::Sphere, Form::Cylinder}) {
    Picture picture = stage();
    const Image empty = studio().draw(picture, kFull);
    Instance body = box({0.0, 0.05, 0.0}, Finish::Solid);
    body.form = form;
    body.colour = {0.1f, 0.1f, 0.1f};
    picture.instances = {body};
    const Image image = studio().draw(picture, kFull);
    // On the front of each body, 0.1 m above the floor and 0.12 m below it.
    const auto front = [&](double y) {
      const double depth = form == Form::Sphere ? std::sqrt(0.09 - (y - 0.05) * (y - 0.05)) : 0.3;
      return Vector3d(0.0, y, depth);
    };
    const double above = brightnessAt(image, picture, front(0.10)),
                 below = brightnessAt(image, picture, front(-0.12));
    const double floor = brightnessAt(empty, picture, front(-0.12));
    CHECK(above < 0.35 * floor);
    CHECK(below > 0.62 * floor);
    CHECK(below < 0.85 * floor);
  }
}

TEST_CASE("numbers on a scale have a true minus and as many digits as their step needs") {
  CHECK(formatTick(-1.5, 0.5) == "\u22121.5");
  CHECK(formatTick(2.0, 1.0) == "2");
  CHECK(formatTick(-1e-17, 0.5) == "0.0");
  CHECK(formatTick(0.25, 0.05) == "0.25");
  CHECK(formatTick(300.0, 100.0) == "300");
}

TEST_CASE("a sheet holds its panels' pixels, in rows, and refuses unlike ones") {
  Fonts fonts(kFonts);
  const Image red{40, 30, std::vector<std::uint8_t>(3600, 200)},
      dark{40, 30, std::vector<std::uint8_t>(3600, 20)};
  Panel panels[] = {{red, "0.1", ""}, {dark, "0.2", ""}, {red, "0.3", "rests"}};
  const Image sheet = drawSheet(panels, 2, "Title", "", fonts);
  CHECK(sheet.width == 2 * 32 + 2 * 40 + 16);
  CHECK(sheet.height == 100 + 2 * (30 + 68));
  CHECK(brightness(sheet, 32 + 20, 100 + 15) == 200.0);
  CHECK(brightness(sheet, 32 + 56 + 20, 100 + 15) == 20.0);
  CHECK(brightness(sheet, 32 + 20, 100 + 98 + 15) == 200.0);
  // A long finding is set on lines of its own, and its row grows by them.
  panels[0].finding = "a finding of many words that no panel of this width holds on a single line";
  const Image longer = drawSheet(panels, 2, "Title", "", fonts);
  CHECK(longer.width == sheet.width);
  CHECK(longer.height > sheet.height);
  CHECK((longer.height - sheet.height) % 20 == 0);
  CHECK(brightness(longer, 32 + 20, longer.height - 68 - 15) == 200.0);
  panels[0].finding = "", panels[0].caption = "many words";
  CHECK(drawSheet(panels, 2, "Title", "", fonts).height == sheet.height + 20);
  // The last may take the room of those that its row lacks, and no more.
  const Image wide{96, 30, std::vector<std::uint8_t>(8640, 90)};
  panels[2].image = wide;
  const Image spanned = drawSheet(panels, 2, "Title", "", fonts);
  CHECK(spanningWidth(40, 2) == 96);
  CHECK(spanned.width == sheet.width);
  CHECK(brightness(spanned, 32 + 90, spanned.height - 68 - 15) == 90.0);
  CHECK_THROWS_AS(drawSheet(panels, 3, "", "", fonts), std::invalid_argument);
  CHECK_THROWS_AS(drawSheet({}, 2, "", "", fonts), std::invalid_argument);
  const Panel unlike[] = {{red, "", ""},
                          {Image{30, 40, std::vector<std::uint8_t>(3600, 0)}, "", ""}};
  CHECK_THROWS_AS(drawSheet(unlike, 2, "", "", fonts), std::invalid_argument);
}

TEST_CASE("type on a page wider than a screen is larger, by as much as the page will be smaller") {
  Fonts fonts(kFonts);
  const Image blank{640, 30, std::vector<std::uint8_t>(57600, 248)};
  const std::vector<Panel> two(2, {blank, "caption", "finding"}), five(5, two[0]);
  const Image page = drawSheet(two, 2, "T", "", fonts), wide = drawSheet(five, 5, "T", "", fonts);
  CHECK(page.height == 100 + 30 + 68);
  const double type = wide.width / 1800.0;
  CHECK(type > 1.8);
  CHECK(wide.height == std::lround(100 * type) + 30 + std::lround(68 * type));
}

TEST_CASE("text is set on lines that are no wider than asked, broken at blanks alone") {
  Fonts fonts(kFonts);
  Image nothing;
  Canvas canvas(nothing, fonts, 1.0);
  const Canvas::TextStyle style{15.0};
  const std::string text = "A title that is longer than the page is wide   t = 0.50 s";
  CHECK(canvas.lines(text, 1e4, style) == std::vector<std::string>{text});
  const std::vector<std::string> lines = canvas.lines(text, 150.0, style);
  CHECK(lines.size() > 2);
  std::string joined;
  for (const std::string& line : lines) {
    CAPTURE(line);
    CHECK(canvas.textWidth(line, style) <= 150.0);
    joined += (joined.empty() ? "" : " ") + line;
  }
  CHECK(joined.find("A title that is longer than the page is wide") == 0);
  CHECK(canvas.lines("unbreakably", 10.0, style).size() == 1);
  CHECK(canvas.lines("broken\nanywhere\tblank", 10.0, style).size() == 3);
  CHECK(canvas.textWidth("a\nb\tc", style) == canvas.textWidth("a b c", style));
  CHECK(canvas.lines("", 10.0, style).empty());
}

TEST_CASE("a line ends neither at the sign of a formula nor between a number and its unit") {
  Fonts fonts(kFonts);
  Image nothing;
  Canvas canvas(nothing, fonts, 1.0);
  const Canvas::TextStyle style{15.0};
  const std::string text = "4.9 cm in 0.6 s, the plane holds both edges: n = ea × eb";
  for (double width = 110.0; width < 400.0; width += 10.0) {
    const std::vector<std::string> lines = canvas.lines(text, width, style);
    CAPTURE(width, lines);
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      for (const char* end : {"4.9", "0.6", "=", "×", "n", "ea"})
        CHECK_FALSE(lines[i].ends_with(end));
      CHECK(canvas.textWidth(lines[i], style) <= width);
    }
  }
  // What is wider than a line is broken all the same.
  CHECK(canvas.lines("a = b + c + d", 40.0, style).size() > 1);
}

TEST_CASE("labels at one point stand above each other, not on each other") {
  Picture picture;
  picture.camera = straight(0.0);
  picture.floor.visible = false;
  const auto ink = [&] {
    const Image image = studio().draw(picture, {.width = 640, .height = 360});
    Picture bare = picture;
    bare.labels.clear();
    const Image page = studio().draw(bare, {.width = 640, .height = 360});
    int count = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) count += image.rgb[i] + 40 < page.rgb[i];
    return count;
  };
  Label label;
  label.anchor = Eigen::Vector3d::Zero();
  label.text = "HHHH";
  picture.labels = {label};
  const int one = ink();
  REQUIRE(one > 40);
  picture.labels = {label, label, label};
  CHECK(ink() == Approx(3 * one).epsilon(0.1));
}

// A body that comes to the eye in the course of the run takes the rule with it, out of the image.
TEST_CASE("the rule is seen even where bodies come nearer than the image reaches") {
  Picture picture = stage();
  picture.instances = {box({0.0, 0.3, 0.0}, Finish::Solid)};
  picture.floor.motion = {Vector3d(-2.0, 0.0, -2.0), Vector3d(2.0, 1.0, 7.0)};
  const Image without = studio().draw(picture, kFull);
  picture.floor.rule = true;
  CHECK_FALSE(compare(without, studio().draw(picture, kFull)).exact);
}

// Oracle: geometry. From half a metre before the middle the rule's right end, 0.4 m, lies below the
// image; where no body is in the way it lies further back, on the image, else it is cut off.
TEST_CASE("a rule reaches both ends of the motion where no body is in the way") {
  Picture picture;
  picture.camera = {{0.9, 1.1, 2.4}, {0.0, 0.35, 0.0}, 24.0};
  picture.centre = {0.0, 0.35, 0.0};
  picture.radius = 0.8;
  picture.instances = {box({0.0, 0.6, 0.0}, Finish::Solid)};
  picture.instances[0].scale.setConstant(0.05);
  picture.floor.motion = {Vector3d(-0.5, 0.0, -0.5), Vector3d(0.5, 0.7, 0.5)};
  // The last column that the rule changes.
  const auto end = [&](const Eigen::AlignedBox3d& way) {
    picture.floor.ways = {way};
    picture.floor.rule = false;
    const Image without = studio().draw(picture, kFull);
    picture.floor.rule = true;
    const Image ruled = studio().draw(picture, kFull);
    int last = 0;
    for (int y = 0; y < 720; ++y)
      for (int x = 0; x < 1280; ++x)
        if (pixel(without, x, y) != pixel(ruled, x, y)) last = std::max(last, x);
    return last;
  };
  const int free = end({Vector3d(-0.1, 0.5, -0.1), Vector3d(0.1, 0.7, 0.1)});
  const int barred = end({Vector3d(-0.5, 0.0, -0.5), Vector3d(0.5, 0.1, 0.5)});
  CAPTURE(free, barred);
  CHECK(free > Projection(picture.camera, 1280, 720).project({0.35, 0.0, 0.3})->x());
  CHECK(barred < free - 50);
}

// Ticks of 0.2 m would stand 28 px apart, closer than their numbers are wide.
TEST_CASE("a rule takes longer steps where its numbers would touch") {
  Picture picture = stage();
  picture.instances = {box({0.0, 0.3, 0.0}, Finish::Solid)};
  picture.floor.motion = {Vector3d(-0.7, 0.0, -0.7), Vector3d(0.7, 0.6, 0.7)};
  const Image without = studio().draw(picture, kFull);
  picture.floor.rule = true;
  CHECK_FALSE(compare(without, studio().draw(picture, kFull)).exact);
}

// Oracle: the width of the widest number. The same rule 100 km away, where a number is twice as
// wide as 32 px, and steps of 0.2 m stand 50 px apart.
TEST_CASE("a rule takes longer steps where its numbers are wide") {
  const double far = 1e5;
  Picture picture = stage();
  picture.camera = {{far, 1.7, 5.0}, {far, 0.3, 0.0}, 30.0};
  picture.centre.x() += far;
  picture.instances = {box({far, 0.3, 0.0}, Finish::Solid)};
  picture.floor.motion = {Vector3d(far - 0.95, 0.0, -0.7), Vector3d(far + 0.95, 0.6, 0.7)};
  const Image without = studio().draw(picture, kFull);
  picture.floor.rule = true;
  const Image ruled = studio().draw(picture, kFull);
  // Below the line of the rule, which is level: the longest row of columns without a gap of 6 px.
  const auto changed = [&](int x, int y0) {
    for (int y = y0; y < 720; ++y)
      if (pixel(without, x, y) != pixel(ruled, x, y)) return true;
    return false;
  };
  int line = 0, most = 0;
  for (int y = 0; y < 720; ++y) {
    int count = 0;
    for (int x = 0; x < 1280; ++x) count += pixel(without, x, y) != pixel(ruled, x, y);
    if (count > most) most = count, line = y;
  }
  REQUIRE(most > 100);
  int longest = 0, from = 0, last = -10;
  for (int x = 0; x < 1280; ++x) {
    if (!changed(x, line + 8)) continue;
    if (x - last > 6) from = x;
    last = x;
    longest = std::max(longest, x - from + 1);
  }
  const double widest = fonts().set("100000.5 m", Face::Regular, 13.0, 0.0).advance;
  CHECK(longest > 0.5 * widest);
  CHECK(longest < widest + 10.0);
}

// Oracle: the room of a colour bar, 340 by 64 px. No nearer and no further is the rule clear of it.
TEST_CASE("a rule ends before a colour bar that it cannot pass") {
  Picture picture = stage();
  picture.instances = {box({0.0, 0.3, 0.0}, Finish::Solid)};
  picture.floor.motion = {Vector3d(-1.6, 0.0, -0.5), Vector3d(2.3, 0.6, 3.2)};
  picture.bar = {"speed / m/s", {{0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}}, 0.0, 1.0, {0.0, 1.0}};
  const RenderOptions screen{.width = 960, .height = 720};
  const Image without = studio().draw(picture, screen);
  picture.floor.rule = true;
  const Image ruled = studio().draw(picture, screen);
  int outside = 0, inside = 0;
  for (int y = 0; y < 720; ++y)
    for (int x = 0; x < 960; ++x)
      if (pixel(without, x, y) != pixel(ruled, x, y)) ++(x > 620 && y > 656 ? inside : outside);
  CHECK(outside > 500);
  CHECK(inside == 0);
}

TEST_CASE("a rule of which the image shows but a stump is left out") {
  Picture picture = stage();
  picture.instances = {box({-0.5, 0.3, 0.0}, Finish::Solid)};
  picture.floor.motion = {Vector3d(-2.4, 0.0, -0.3), Vector3d(2.4, 0.6, 0.3)};
  const auto ruled = [&](double fov) {
    picture.camera = {{-0.5, 3.0, 9.0}, {-0.5, 0.3, 0.0}, fov};
    picture.floor.rule = false;
    const Image without = studio().draw(picture, kFull);
    picture.floor.rule = true;
    return !compare(without, studio().draw(picture, kFull)).exact;
  };
  CHECK(ruled(30.0));
  // Of 4.8 m there are 1.7 to be seen, with two numbers, −1 and 0 m.
  CHECK_FALSE(ruled(6.0));
}

// Oracle: the place of the label. The rule, all that its picture has more, passes through it where
// only the rule is drawn, and nowhere near once the label is.
TEST_CASE("the rule keeps clear of a label that would stand on it") {
  Picture picture = stage();
  picture.instances = {box({0.0, 0.3, 0.0}, Finish::Solid)};
  Label label;
  label.anchor = Vector3d(0.3, 0.0, 0.3 * std::sqrt(3.0) + 0.12 * picture.radius);  // on it
  label.offset = {-20.0, 5.0};
  label.text = "a label of some length";
  const Vector3d place = *Projection(picture.camera, 1280, 720).project(*label.anchor);
  const auto touched = [&](bool labelled) {
    Picture with = picture;
    if (labelled) with.labels = {label};
    const Image without = studio().draw(with, kFull);
    with.floor.rule = true;
    const Image ruled = studio().draw(with, kFull);
    int count = 0, all = 0;
    for (int y = 0; y < 720; ++y)
      for (int x = 0; x < 1280; ++x) {
        if (brightness(without, x, y) == brightness(ruled, x, y)) continue;
        ++all;
        count += std::abs(x - place.x()) < 20.0 && std::abs(y - place.y()) < 5.0;
      }
    CHECK(all > 500);
    return count;
  };
  CHECK(touched(false) > 20);
  CHECK(touched(true) == 0);
}

TEST_CASE("over any page a transparent image gives what is drawn on that page, text and all") {
  Picture picture = stage();
  picture.title = "A title";
  picture.floor.grid = 1.0;
  picture.instances = {box({0.0, 0.5, 0.0}, Finish::Solid), box({1.0, 0.5, 0.0}, Finish::Glass)};
  RenderOptions options = {.width = 320, .height = 180};
  const Image page = studio().draw(picture, options);
  options.transparent = true;
  for (const AntiAlias antialias : {AntiAlias::Msaa4, AntiAlias::Ssaa2x2}) {
    options.antialias = antialias;
    const Image figure = studio().draw(picture, options);
    REQUIRE(figure.alpha.size() == 320u * 180u);
    CHECK(figure.alpha[0] == 0);
    if (antialias != AntiAlias::Msaa4) continue;
    double worst = 0.0;
    for (std::size_t i = 0; i < figure.alpha.size(); ++i) {
      const double a = figure.alpha[i] / 255.0;
      const Colour behind = pageColour((static_cast<double>(i / 320) + 0.5) / 180.0);
      for (std::size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(a * figure.rgb[3 * i + c] + (1.0 - a) * 255.0 * behind[c] -
                                         page.rgb[3 * i + c]));
    }
    // Rounded where it is premultiplied, divided and put together again. Measured 2.1 levels.
    CHECK(worst < 4.0);
  }
}

TEST_CASE("where there is no title, the subtitle stands in its place") {
  const auto top = [](const char* title, const char* subtitle) {  // first row that words cover
    Picture picture = stage();
    picture.floor.visible = false;
    const Image without = studio().draw(picture, kFull);
    picture.title = title;
    picture.subtitle = subtitle;
    const Image with = studio().draw(picture, kFull);
    int y = 0;
    while (y < 719 &&
           std::equal(with.rgb.begin() + 3 * 1280 * y, with.rgb.begin() + 3 * 1280 * (y + 1),
                      without.rgb.begin() + 3 * 1280 * y))
      ++y;
    return y;
  };
  const int title = top("Hill", "");
  CHECK(std::abs(top("", "Hill") - title) < 8);
  CHECK(top("Hill", "Hill") == title);
}

// A page 405 wide and 720 high: letters went by the shorter side alone, 7 of 720 high.
TEST_CASE("remarks on a page that is taller than wide can be read") {
  const auto rowsOf = [](int width) {  // that the remark covers
    Picture picture = stage();
    picture.floor.visible = false;
    RenderOptions format = kFull;
    format.width = width;
    const Image without = studio().draw(picture, format);
    picture.remarks = {{"Height"}};
    const Image with = studio().draw(picture, format);
    int rows = 0;
    for (int y = 0; y < 720; ++y) {
      bool covered = false;
      for (int x = 0; x < width; ++x)
        covered = covered || brightness(with, x, y) != brightness(without, x, y);
      rows += covered;
    }
    return rows;
  };
  const double wide = rowsOf(1280), tall = rowsOf(405);
  CAPTURE(wide, tall);
  CHECK(tall >= 0.7 * wide);  // 10 of 13 px; measured 10 of 13 rows
  CHECK(tall < wide);
}

TEST_CASE("remarks stand below title and subtitle, in however many lines these are") {
  const std::string words = "words that go on and on and on and on and on and on and on and on ";
  const auto linesOf = [](Picture picture) {  // of pixels that its remark alone covers
    picture.floor.visible = false;
    const Image without = studio().draw(picture, kFull);
    picture.remarks = {{"a remark, which is short"}};
    const Image with = studio().draw(picture, kFull);
    int first = 720, last = 0, inked = 0;
    for (int y = 0; y < 720; ++y)
      for (int x = 0; x < 1280; ++x)
        if (brightness(with, x, y) != brightness(without, x, y)) {
          first = std::min(first, y);
          last = std::max(last, y);
        }
    // What the title and the subtitle cover begins above and ends above.
    const double page = brightness(without, 1270, 10);
    for (int y = 0; y < 300; ++y)
      for (int x = 32; x < 400; ++x)
        if (std::abs(brightness(without, x, y) - page) > 60.0) inked = std::max(inked, y);
    return std::array<int, 3>{inked, first, last};
  };
  Picture picture = stage();
  picture.title = "A title";
  picture.subtitle = "And what is below";
  const auto [plain, first, last] = linesOf(picture);
  CHECK(first > plain + 4);
  CHECK(first >= 88);
  CHECK(last <= 105);  // baseline 100
  picture.subtitle = words + words + words + words;
  const auto [lower, below, end] = linesOf(picture);
  CHECK(lower > plain + 15);
  CHECK(below > lower + 4);
}
