// What is drawn of inertia, momenta, speed and the two sides of a body.
#include "app/present/inertia.h"

#include <algorithm>
#include <cmath>

#include "app/file/data.h"
#include "app/present/boxes.h"
#include "app/present/palette.h"
#include "app/present/present.h"
#include "render/camera.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

// A book that spins about its middle axis and a ball, free of gravity.
constexpr const char* kBook = R"(
[world]
gravity = [0, 0, 0]
duration = 4.0
[[body]]
name = "book"
shape = { box = [0.30, 0.20, 0.05] }
mass = 1.0
orientation = { axis = [1, 2, 3], degrees = 40 }
velocity = [0.5, 0.0, 0.0]
angular_velocity_body = [0.02, 6.0, 0.0]
colour = [0.0, 0.0, 1.0]
colour_back = [1.0, 0.5, 0.0]
[[body]]
name = "ball"
shape = { sphere = 0.2 }
mass = 3.0
position = [0, 2, 0]
velocity = [0.0, 0.0, 1.0]
)";

struct BookRun {
  Scene scene;
  Recording recording;
  explicit BookRun(const std::vector<std::string>& overrides)
      : scene(parseScene(kBook, "book", overrides)), recording(record(scene, 60.0)) {}
  Picture strobe() const { return Presenter(scene, recording).strobe(); }
  Picture image(int k) const { return Presenter(scene, recording).image(k); }
};

const Instance& ellipsoid(const Picture& picture, std::size_t index) {
  std::size_t found = 0;
  for (const Instance& instance : picture.instances)
    if (instance.form == Form::Ellipsoid && found++ == index) return instance;
  FAIL("no such ellipsoid");
  return picture.instances.front();
}

}  // namespace

// Oracles: a solid ball is its own ellipsoid; a box of half extents h has √(5/3) h. Measured 2e-16
// relative, allowed 1e-14.
TEST_CASE("the ellipsoid of a body weighs and turns like it") {
  const BookRun run({"show.ellipsoid=true"});
  const Picture picture = run.image(7);
  const Instance& ball = ellipsoid(picture, 1);
  CHECK((ball.scale - Vec3::Constant(0.2)).norm() < 1e-14 * 0.2);
  CHECK(ball.finish == Finish::Glass);
  const Instance& book = ellipsoid(picture, 0);
  CHECK(book.position == run.recording.samples[7].bodies[0].x);
  // Principal axes may come in any order: compare the quadratic forms in the world.
  const auto form = [](const Quat& q, const Vec3& scale) -> Mat3 {
    const Mat3 R = q.toRotationMatrix();
    return R * scale.cwiseAbs2().asDiagonal() * R.transpose();
  };
  const Mat3 expected =
      form(run.recording.samples[7].bodies[0].q, std::sqrt(5.0 / 3.0) * Vec3(0.15, 0.10, 0.025));
  CHECK((form(book.orientation, book.scale) - expected).norm() < 1e-14);
}

// Oracle: invariants. ω·Iω and |Iω|² are the same all along every curve. Measured 1.4e-9 (RK4) for
// the way of ω and 1.6e-15 for the others, allowed 1e-7 and 1e-12.
TEST_CASE("the polhode lies on Poinsot's ellipsoid, as do the curves of other momenta") {
  const BookRun run({"show.polhode=true", "body.ball.fixed=true"});
  const Picture picture = run.image(120);
  const Instance& surface = ellipsoid(picture, 0);
  const Vec3 I(0.2 * 0.2 + 0.05 * 0.05, 0.3 * 0.3 + 0.05 * 0.05, 0.3 * 0.3 + 0.2 * 0.2);
  const Quat q = run.recording.samples[120].bodies[0].q;
  double longest = 0.0;
  REQUIRE(picture.lines.size() == 11);  // ten others
  for (const Polyline& line : picture.lines) {
    const bool others = line.points.size() != run.recording.samples.size();
    double momentum = -1.0;
    for (const Eigen::Vector3d& point : line.points) {
      const Vec3 p_P = surface.orientation.conjugate() * (point - surface.position);
      const double level = p_P.cwiseQuotient(surface.scale).norm();
      CHECK(std::abs(level / 1.004 - 1.0) < (others ? 1e-12 : 1e-7));
      const Vec3 p_B = q.conjugate() * (point - surface.position);
      const double L = I.cwiseProduct(p_B).norm();
      if (momentum < 0.0) momentum = L;
      CHECK(std::abs(L / momentum - 1.0) < (others ? 1e-12 : 1e-7));
      if (!others) longest = std::max(longest, std::abs(p_B.x()) / surface.scale.maxCoeff());
    }
  }
  CHECK(longest > 0.5);  // the flip leads far away from where it began
  // The arrow of ω ends on the curve where it is now.
  REQUIRE(picture.arrows.size() == 1);
  const Eigen::Vector3d tip = picture.arrows[0].tip - surface.position;
  CHECK((surface.orientation.conjugate() * tip).cwiseQuotient(surface.scale).norm() ==
        Approx(1.0).epsilon(1e-7));
}

TEST_CASE("momenta are drawn along, each kind as long as it is large") {
  const BookRun run({"show.momenta=true"});
  const Picture first = run.image(0), later = run.image(130);
  // Book: P, L and ω; the ball does not spin.
  REQUIRE(first.arrows.size() == 4);
  CHECK(first.arrows[0].colour != colour::kVelocity);
  const auto along = [](const Arrow& arrow) -> Vec3 { return arrow.tip - arrow.base; };
  CHECK(along(first.arrows[0]).normalized().x() == Approx(1.0));
  CHECK(along(first.arrows[3]).normalized().z() == Approx(1.0));
  CHECK(along(first.arrows[3]).norm() == Approx(6.0 * along(first.arrows[0]).norm()));
  // L stays, ω wanders.
  CHECK((along(first.arrows[1]) - along(later.arrows[1])).norm() < 1e-6);
  CHECK((along(first.arrows[2]) - along(later.arrows[2])).norm() > 0.05);
  const Mat3 R = run.recording.samples[0].bodies[0].q.toRotationMatrix();
  const Vec3 I(0.0425 / 12, 0.0925 / 12, 0.13 / 12);
  const Vec3 L = R * I.asDiagonal() * Vec3(0.02, 6.0, 0.0);
  CHECK(along(first.arrows[1]).normalized().dot(L.normalized()) == Approx(1.0));
}

TEST_CASE("a box in body axes turns with the body, and does not shear with its matrix") {
  const BookRun run({"body.ball.fixed=true"});
  Sample sample = run.recording.samples[30];
  const auto lengths = [&] {
    Picture picture;
    addBodyBoxes(run.scene, sample, picture);
    double length = 0.0;
    for (const Polyline& line : picture.lines)
      for (std::size_t k = 1; k < line.points.size(); ++k)
        length += (line.points[k] - line.points[k - 1]).norm();
    return length;
  };
  CHECK(lengths() == Approx(4.0 * (0.3 + 0.2 + 0.05)).epsilon(1e-12));
  sample.bodies[0].R = Vec3(2.0, 1.0, 1.0).asDiagonal();
  CHECK(lengths() == Approx(4.0 * (0.3 + 0.2 + 0.05)).epsilon(1e-12));
}

TEST_CASE("speed runs from one end of the scale to the other") {
  const BookRun run({"show.speed=true", "body.book.velocity=[0, 0, 0]"});
  const Picture picture = run.strobe();
  REQUIRE(picture.bar);
  CHECK(picture.bar->caption == "speed / m/s");
  CHECK(picture.bar->to == Approx(1.0));
  CHECK(picture.bar->ticks.front() == 0.0);
  for (const Instance& instance : picture.instances)
    CHECK(instance.colour ==
          (instance.form == Form::Sphere ? cividisStops().back() : cividisStops().front()));
}

TEST_CASE("a body with two sides keeps its colours in a strobe") {
  const BookRun run({"body.ball.fixed=true"});
  const Picture picture = run.strobe();
  CHECK_FALSE(picture.bar);
  for (const Instance& instance : picture.instances) {
    if (instance.form != Form::Box) continue;
    CHECK(instance.colour == Colour{0.0f, 0.0f, 1.0f});
    REQUIRE(instance.back);
    CHECK(*instance.back == Colour{1.0f, 0.5f, 0.0f});
  }
}

// Oracle: the scene. What stays in its place has no linear momentum, whatever rounding leaves.
TEST_CASE("a momentum that is only rounding has no arrow and no letter") {
  const Scene scene =
      readScene(dataFolder("demos") + "/tops.toml", {"show.momenta=true", "world.duration=0.05"});
  Variant disk;
  disk.bodies = {"floor", "disk"};
  const Scene alone = readScene(scene.file, scene.overrides, &disk);
  const Recording recording = record(alone, 240.0);
  REQUIRE(recording.samples.back().bodies[1].v.norm() < 1e-9);
  Picture picture = Presenter(alone, recording).image(12);
  std::string letters;
  for (const Label& label : picture.labels)
    if (label.italic) letters += label.text + " ";
  CHECK(letters == "L ω ");
}

TEST_CASE("the camera sees ellipsoids and the ends of arrows inside the page") {
  const std::string flag =
      GENERATE("show.ellipsoid=true", "show.polhode=true", "show.momenta=true");
  CAPTURE(flag);
  // A rod along X that spins about itself: what stands out beyond its ends is the widest.
  const Variant rod{"",
                    {{"body.book.shape={ box = [1.0, 0.05, 0.05] }", {}},
                     {"body.book.orientation=[1, 0, 0, 0]", {}},
                     {"body.book.angular_velocity_body=[6, 0, 0]", {}}},
                    {"book"}};
  const Scene scene = parseScene(kBook, "rod", {flag, "body.book.velocity=[0, 0, 0]"}, &rod);
  const Recording recording = record(scene, 60.0);
  const Presenter presenter(scene, recording);
  for (const int k : {0, 60, 120}) {
    const Picture picture = presenter.image(k);
    const Projection projection(picture.camera, 1280.0, 720.0);
    const auto inside = [&](const Eigen::Vector3d& point) {
      const auto pixel = projection.project(point);
      return pixel && pixel->x() > 0.0 && pixel->x() < 1280.0 && pixel->y() > 0.0 &&
             pixel->y() < 720.0;
    };
    for (const Arrow& arrow : picture.arrows) CHECK(inside(arrow.tip));
    for (const Instance& body : picture.instances)
      if (body.form == Form::Ellipsoid)
        for (int axis = 0; axis < 3; ++axis)
          for (const double side : {-1.0, 1.0})
            CHECK(inside(body.position +
                         body.orientation * (side * body.scale[axis] * Vec3::Unit(axis))));
  }
}

// Oracle: I = m r² 2/5 of a ball; in cells of 54 px "4166666.667" would cover its neighbours, and
// 1e-9 would be 0.000.
TEST_CASE("numbers of an inertia tensor fill their cells, however large or small it is") {
  const auto textsOf = [](double mass) {
    const Scene scene = parseScene(
        "[world]\nduration = 0.1\n[[body]]\nname = \"ball\"\n"
        "shape = { sphere = 1.0 }\nmass = " +
            std::to_string(mass) + "\n[show]\ntensors = true\n",
        "ball");
    std::vector<std::string> texts;
    const Recording recording = record(scene, 60.0);
    for (const Label& label : Presenter(scene, recording).image(0).labels)
      texts.push_back(label.text);
    return texts;
  };
  const auto has = [](const std::vector<std::string>& texts, const std::string& text) {
    return std::find(texts.begin(), texts.end(), text) != texts.end();
  };
  for (const auto& [mass, unit] :
       {std::pair(10.0, "kg m²"), {1e7, "10⁶ kg m²"}, {1e-5, "10⁻⁶ kg m²"}}) {
    CAPTURE(mass);
    const std::vector<std::string> texts = textsOf(mass);
    CHECK(has(texts, "4.000"));
    CHECK(has(texts, "0.000"));
    CHECK(has(texts, "Ibody / (" + std::string(unit) + "): stays"));
  }
}
