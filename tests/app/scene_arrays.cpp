// Generators: what the copies of a body are promised to be.
#include <cstring>

#include "app/scene/random.h"
#include "app/scene/scene.h"
#include "sim/collide/collide.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

std::vector<BodyDef> copies(const std::string& keys, int seed = 1) {
  const std::string text =
      "[world]\nseed = " + std::to_string(seed) + "\n[[array]]\nname = \"a\"\n" + keys + "\n";
  return parseScene(text, "s.toml").world.bodies;
}

double gap(const BodyDef& a, const BodyDef& b) {
  return separation(a.shape, {a.position, a.orientation}, b.shape, {b.position, b.orientation});
}

// FNV-1a over the bits of positions and orientations.
std::uint64_t hash(const std::vector<BodyDef>& bodies) {
  std::uint64_t h = 0xcbf29ce484222325u;
  const auto mix = [&h](double x) {
    unsigned char bytes[sizeof x];
    std::memcpy(bytes, &x, sizeof x);
    for (const unsigned char byte : bytes) h = (h ^ byte) * 0x100000001b3u;
  };
  for (const BodyDef& body : bodies) {
    for (int i = 0; i < 3; ++i) mix(body.position[i]);
    for (int i = 0; i < 4; ++i) mix(body.orientation.coeffs()[i]);
  }
  return h;
}

}  // namespace

TEST_CASE("a row steps from the template's own position") {
  const std::vector<BodyDef> row = copies(
      "kind = \"row\"\ncount = 4\nstep = [0.5, 0, -1]\n"
      "body = { shape = { sphere = 0.25 }, mass = 1, position = [1, 2, 3] }");
  REQUIRE(row.size() == 4);
  for (int i = 0; i < 4; ++i) {
    CHECK(row[i].name == "a." + std::to_string(i));
    CHECK(row[i].position == Vec3(1.0 + 0.5 * i, 2.0, 3.0 - i));
  }
}

TEST_CASE("varied numbers run evenly and reach both ends exactly") {
  const std::vector<BodyDef> row = copies(
      "kind = \"row\"\ncount = 11\nstep = [3, 0, 0]\n"
      "body = { shape = { box = [1, 1, 1] }, mass = 1 }\n"
      "vary = { restitution = [0.0, 1.0], mass = [0.1, 0.11], \"shape.box\" = [[1, 1, 1], [1, 2, "
      "1]], "
      "velocity = [[0, 0, 0], [0, 0, 5]] }");
  REQUIRE(row.size() == 11);
  for (int i = 0; i < 11; ++i) {
    CHECK(row[i].restitution == i / 10.0);
    CHECK(std::get<Box>(row[i].shape).half.y() == 0.5 * ((10 - i) + i * 2.0) / 10.0);
    CHECK(row[i].velocity.z() == 0.5 * i);
  }
  CHECK(row.front().mass == 0.1);
  CHECK(row.back().mass == 0.11);
  CHECK(copies("kind = \"row\"\ncount = 1\nbody = { shape = { sphere = 1 }, mass = 1 }\n"
               "vary = { shape = { sphere = [2, 3] } }")
            .size() == 1);
}

// Oracle: the separation of neighbours. Measured 0 for boxes, 1.8e-15 m for 40 spheres; allowed
// 1e-14 m: rounding of a height of up to 24 m.
TEST_CASE("each copy of a tower stands on the one before it") {
  const std::string kinds[] = {
      "body = { shape = { box = [0.4, 0.3, 0.2] }, mass = 1 }",
      "body = { shape = { sphere = 0.3 }, mass = 1 }\nvary = { \"shape.sphere\" = [0.3, 0.1] }",
      "body = { shape = { box = [0.4, 0.3, 0.2] }, mass = 1, "
      "orientation = { axis = [0, 0, 1], degrees = 90 } }\n"
      "vary = { \"shape.box\" = [[0.9, 0.3, 0.2], [0.1, 0.3, 0.2]] }"};
  for (const std::string& body : kinds) {
    INFO(body);
    const std::vector<BodyDef> tower =
        copies("kind = \"tower\"\ncount = 40\nbase = [1, 2, 3]\n" + body);
    REQUIRE(tower.size() == 40);
    BodyDef floor;
    floor.shape = HalfSpace{Vec3::UnitY(), 2.0};
    CHECK(std::abs(gap(tower[0], floor)) < 1e-14);
    for (int i = 1; i < 40; ++i) {
      CHECK(std::abs(gap(tower[i], tower[i - 1])) < 1e-14);
      CHECK(tower[i].position.y() > tower[i - 1].position.y());
      CHECK(tower[i].position.x() == 1.0);
      CHECK(tower[i].position.z() == 3.0);
    }
  }
}

// Oracle: closed forms of volume, middle and separation. Measured 8.9e-16 m, allowed 1e-14 m.
TEST_CASE("a wall is whole: courses touch, bricks rest on two, and the ends are flush") {
  for (const std::string along : {"[1, 0, 0]", "[0, 0, 1]", "[-3, 0, 4]", "[-1, 0, 0]"}) {
    INFO(along);
    const std::vector<BodyDef> wall =
        copies("kind = \"wall\"\nrows = 3\ncolumns = 4\nbase = [1, 2, 3]\nalong = " + along +
               "\nbody = { shape = { box = [0.4, 0.2, 0.1] }, mass = 2 }");
    REQUIRE(wall.size() == 3 * 4 + 1);

    // Mass and middle are those of one solid block.
    double mass = 0.0;
    Vec3 middle = Vec3::Zero();
    for (const BodyDef& brick : wall) {
      mass += *brick.mass;
      middle += *brick.mass * brick.position;
    }
    CHECK(mass == 24.0);
    CHECK((middle / mass - Vec3(1.0, 2.3, 3.0)).norm() < 1e-14);

    // No two bricks overlap, and each has a neighbour it touches.
    for (std::size_t i = 0; i < wall.size(); ++i) {
      double nearest = 1.0;
      for (std::size_t k = 0; k < wall.size(); ++k)
        if (i != k) nearest = std::min(nearest, gap(wall[i], wall[k]));
      CHECK(std::abs(nearest) < 1e-14);
    }

    // The bricks' own X lies along the wall, from its first end to its last.
    const Vec3 direction = (wall[3].position - wall[0].position).normalized();
    CHECK((wall[0].orientation * Vec3::UnitX() - direction).norm() < 1e-14);
  }
}

// Oracle: closed form, R (cos φ, 0, −sin φ) with φ = 2π i/n, and X along the tangent. Measured
// 4e-16, allowed 1e-12.
TEST_CASE("a circle's copies lie evenly on it and look along it") {
  const std::vector<BodyDef> ring = copies(
      "kind = \"circle\"\ncount = 7\nradius = 2.5\n"
      "body = { shape = { box = [0.1, 0.4, 0.2] }, mass = 1, position = [1, 2, 3], "
      "orientation = { axis = [1, 0, 0], degrees = 90 } }");
  REQUIRE(ring.size() == 7);
  for (int i = 0; i < 7; ++i) {
    const double angle = 2.0 * EIGEN_PI * i / 7.0;
    const Vec3 outward(std::cos(angle), 0.0, -std::sin(angle));
    CHECK((ring[i].position - Vec3(1.0, 2.0, 3.0) - 2.5 * outward).norm() < 1e-12);
    // The template's own turn brings its Z down before it is led round.
    CHECK((ring[i].orientation * Vec3::UnitX() - Vec3::UnitY().cross(outward)).norm() < 1e-12);
    CHECK((ring[i].orientation * Vec3::UnitZ() + Vec3::UnitY()).norm() < 1e-12);
  }
}

// Oracle: the spiral's own equations. Chords measured equal to 2e-14 of their length, allowed
// 1e-12; off the curve 4e-16 m, allowed 1e-12.
TEST_CASE("a spiral's copies lie on it, at one distance from each to the next") {
  for (const double inner : {0.0, 0.3}) {
    const double pitch = 0.24, spacing = 0.045;
    const std::vector<BodyDef> spiral = copies(
        "kind = \"spiral\"\ncount = 200\npitch = 0.24\nspacing = 0.045\ninner = " +
        std::to_string(inner) +
        "\nbody = { shape = { box = [0.01, 0.1, 0.05] }, mass = 1, position = [1, 0.05, -2] }");
    REQUIRE(spiral.size() == 200);
    double angle = 0.0;  // unwound
    for (int i = 0; i < 200; ++i) {
      const Vec3 from = spiral[i].position - Vec3(1.0, 0.05, -2.0);
      CHECK(from.y() == 0.0);
      if (i == 0) {
        CHECK((from - Vec3(inner, 0.0, 0.0)).norm() < 1e-15);
        CHECK((spiral[0].orientation * Vec3::UnitX())
                  .dot(Vec3(pitch / (2.0 * EIGEN_PI), 0.0, -inner).normalized()) ==
              Approx(1.0).epsilon(1e-14));
        continue;
      }
      const Vec3 chord = spiral[i].position - spiral[i - 1].position;
      CHECK(std::abs(chord.norm() / spacing - 1.0) < 1e-12);
      const double seen = std::atan2(-from.z(), from.x());
      angle = seen + 2.0 * EIGEN_PI * std::ceil((angle - seen) / (2.0 * EIGEN_PI));
      CHECK(std::abs(from.norm() - (inner + pitch * angle / (2.0 * EIGEN_PI))) < 1e-12);
      const Vec3 outward = from.normalized();
      const Vec3 tangent =
          pitch / (2.0 * EIGEN_PI) * outward + from.norm() * Vec3::UnitY().cross(outward);
      CHECK((spiral[i].orientation * Vec3::UnitX() - tangent.normalized()).norm() < 1e-12);
    }
  }
}

// Oracle: closed forms of a triangular lattice. Each of 15 balls is d from its neighbours, of which
// there are 30 pairs, and √3 d or more from all others. Measured 2e-16 m, allowed 1e-12.
TEST_CASE("racked balls lie at one gap from their neighbours, in a triangle") {
  for (const double wide : {0.0, 0.001}) {
    const std::vector<BodyDef> rack =
        copies("kind = \"rack\"\nrows = 5\nalong = [3, 0, -4]\ngap = " + std::to_string(wide) +
               "\nbody = { shape = { sphere = 0.0286 }, mass = 0.17, position = [1, 0.0286, 2] }");
    REQUIRE(rack.size() == 15);
    CHECK(rack[0].position == Vec3(1.0, 0.0286, 2.0));
    const double d = 2.0 * 0.0286 + wide;
    int neighbours = 0;
    for (int i = 0; i < 15; ++i)
      for (int k = 0; k < i; ++k) {
        const double distance = (rack[i].position - rack[k].position).norm();
        if (distance > 1.5 * d) {
          CHECK(distance > std::sqrt(3.0) * d - 1e-12);
          continue;
        }
        ++neighbours;
        CHECK(std::abs(gap(rack[i], rack[k]) - wide) < 1e-12);
      }
    CHECK(neighbours == 30);
    const Vec3 middle = (rack[10].position + rack[14].position) / 2.0 - rack[0].position;
    CHECK((middle - 2.0 * std::sqrt(3.0) * d * Vec3(0.6, 0.0, -0.8)).norm() < 1e-12);
  }
}

TEST_CASE("rain falls within its box, apart from itself, and the same on every machine") {
  const std::string keys =
      "kind = \"rain\"\ncount = 200\nlo = [-1, 4, -1]\nhi = [1, 8, 1]\n"
      "body = { shape = { box = [0.2, 0.1, 0.15] }, mass = 1 }\n"
      "vary = { \"shape.box\" = [[0.1, 0.05, 0.1], [0.2, 0.15, 0.1]] }";
  const std::vector<BodyDef> rain = copies(keys, 42);
  REQUIRE(rain.size() == 200);
  for (std::size_t i = 0; i < rain.size(); ++i) {
    const Vec3& x = rain[i].position;
    CHECK((x.array() >= Vec3(-1.0, 4.0, -1.0).array()).all());
    CHECK((x.array() <= Vec3(1.0, 8.0, 1.0).array()).all());
    CHECK(std::abs(rain[i].orientation.norm() - 1.0) < 4e-16);
    for (std::size_t k = 0; k < i; ++k)
      CHECK((x - rain[k].position).norm() >=
            boundingRadius(rain[i].shape) + boundingRadius(rain[k].shape));
  }
  // Written down once: a changed generator changes every scene with rain.
  CHECK(hash(rain) == 0xb5b99e8792e1f1fau);
  CHECK(hash(copies(keys, 42)) == hash(rain));
  CHECK(hash(copies(keys, 43)) != hash(rain));
}

TEST_CASE("two showers keep clear of each other") {
  const std::string shower =
      "kind = \"rain\"\ncount = 40\nlo = [0, 0, 0]\nhi = [2, 2, 2]\n"
      "body = { shape = { sphere = 0.1 }, mass = 1 }\n";
  const std::vector<BodyDef> bodies = copies(shower + "[[array]]\nname = \"b\"\n" + shower);
  REQUIRE(bodies.size() == 80);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) CHECK(gap(bodies[i], bodies[k]) >= 0.0);
}

// Oracle: moments of the uniform distributions, at 4 standard deviations of the mean of n draws:
// 4/√(12 n) = 0.0037 for a number in [0, 1), 4/√(4·n) = 0.0063 for a component of a unit
// quaternion.
TEST_CASE("random numbers fill their range and random orientations favour none") {
  constexpr int n = 100'000;
  Random random(7, "stream");
  double mean = 0.0, square = 0.0;
  for (int i = 0; i < n; ++i) {
    const double u = random.unit();
    REQUIRE((u >= 0.0 && u < 1.0));
    mean += u / n;
    square += u * u / n;
  }
  CHECK(std::abs(mean - 0.5) < 0.0037);
  CHECK(std::abs(square - 1.0 / 3.0) < 0.0038);

  Vec4 first = Vec4::Zero(), second = Vec4::Zero();
  for (int i = 0; i < n; ++i) {
    const Quat q = random.orientation();
    first += q.coeffs() / n;
    second += q.coeffs().cwiseAbs2() / n;
  }
  CHECK(first.cwiseAbs().maxCoeff() < 0.0063);
  CHECK((second.array() - 0.25).abs().maxCoeff() < 0.0063);
}

// Oracle: the published reference sequence of SplitMix64 from the state 1234567.
TEST_CASE("the generator is SplitMix64") {
  Random random(1234567, "");
  for (const std::uint64_t expected :
       {6457827717110365317u, 3203168211198807973u, 9817491932198370423u, 4593380528125082431u,
        16408922859458223821u})
    CHECK(random.bits() == expected);
}

// Oracle: each copy, traced back along its parabola, leaves the base with the speed, within the
// spread, at an age within the ages. Measured 2e-14, allowed 1e-12.
TEST_CASE("a fountain flows already when it begins") {
  const std::string keys =
      "kind = \"fountain\"\ncount = 300\nbase = [1, 0.5, -2]\nspeed = 6\nspread = 20\n"
      "ages = [-0.25, 1.2]\nbody = { shape = \"particle\", mass = 0.01 }";
  const std::vector<BodyDef> fountain = copies(keys, 7);
  REQUIRE(fountain.size() == 300);
  double youngest = 1e9, oldest = -1e9, widest = 0.0;
  for (const BodyDef& drop : fountain) {
    const Vec3 way = drop.position - Vec3(1.0, 0.5, -2.0);
    // Across the vertical nothing accelerates: age = way / velocity.
    const Vec3 level(drop.velocity.x(), 0.0, drop.velocity.z());
    const double age = level.dot(way) / level.squaredNorm();
    const Vec3 v0 = drop.velocity + age * Vec3(0.0, 9.81, 0.0);
    CHECK(v0.norm() == Approx(6.0).epsilon(1e-12));
    CHECK((age * v0 - 0.5 * age * age * Vec3(0.0, 9.81, 0.0) - way).norm() < 1e-12);
    youngest = std::min(youngest, age);
    oldest = std::max(oldest, age);
    widest = std::max(widest, std::acos(v0.y() / 6.0));
  }
  CHECK(youngest >= -0.25 - 1e-12);
  CHECK(youngest < -0.2);
  CHECK(oldest <= 1.2 + 1e-12);
  CHECK(oldest > 1.15);
  CHECK(widest <= 20.0 * EIGEN_PI / 180.0 + 1e-12);
  CHECK(widest > 19.0 * EIGEN_PI / 180.0);
  // The same seed gives the same fountain, another one another.
  CHECK(copies(keys, 7)[299].position == fountain[299].position);
  CHECK(copies(keys, 8)[299].position != fountain[299].position);
}
