// The three ways to the inertia tensor, against exact values and against the theory of their
// errors.
#include "sim/body/inertia_method.h"

#include <algorithm>
#include <cmath>

#include "sim/body/principal_axes.h"
#include "sim/body/samples.h"
#include "sim/math/rotation.h"
#include "sim/shape/convex_hull.h"
#include "sim/shape/interior.h"
#include "tests/body/solids.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

MassProperties by(const char* method, const Shape& shape, int samples = 1000,
                  std::uint64_t seed = 0) {
  return findInertiaMethod(method)->weigh(shape, 1.0, samples, seed);
}

/// The dumbbell and the L as convex parts.
Compound dumbbellParts() {
  const auto box = [](double x, double y, double z, double at) {
    return Part{Box{{0.5 * x, 0.5 * y, 0.5 * z}}, {{at, 0.0, 0.0}, Quat::Identity()}};
  };
  return {{box(0.5, 0.5, 0.5, -1.0), box(0.5, 0.5, 0.5, 1.0), box(1.5, 0.1, 0.1, 0.0)},
          Vec3::Zero()};
}

Compound ellParts() {
  Compound compound;
  for (const Vec3& at : {Vec3(0.5, 0.5, 0.5), Vec3(1.5, 0.5, 0.5), Vec3(0.5, 1.5, 0.5)})
    compound.parts.push_back({Box{}, {at, Quat::Identity()}});
  return compound;
}

double relativeError(const Mat3& found, const Mat3& exact) {
  return (found - exact).norm() / exact.norm();
}

/// Root mean square of the relative error of the inertia tensor over tilted copies of a solid, or
/// over seeds where the solid stands still, and over counts within half as many again.
double rmsError(const char* method, const solids::Raw& raw, bool tilted, int samples) {
  double sum = 0.0;
  const int kRuns = 24;
  for (int run = 0; run < kRuns; ++run) {
    const Vec3 axis(1.0 + run, 2.0 - 0.3 * run, 0.7 * run - 5.0);
    const Shape shape = (tilted ? solids::turned(raw, fromAxisAngle(axis, 0.4 + run)) : raw).mesh();
    const Mat3 exact = by("surface", shape).inertia;
    const int count = samples + samples * run / (2 * kRuns);
    const double error =
        relativeError(by(method, shape, count, static_cast<std::uint64_t>(run)).inertia, exact);
    sum += error * error;
  }
  return std::sqrt(sum / kRuns);
}

/// Slope of log error against log N, between the ends.
double slope(const char* method, const solids::Raw& raw, bool tilted, int few, int many) {
  return std::log(rmsError(method, raw, tilted, many) / rmsError(method, raw, tilted, few)) /
         std::log(static_cast<double>(many) / few);
}

}  // namespace

// Oracle: closed forms by hand. Izz of the dumbbell: 2 (m/12 (a² + a²) + m 1²) + bar; the box
// around it has m/12 (2.5² + 0.5²). Measured in per cent: −45.47, +5.75, +9.09, 0.2357 m. Allowed:
// the last digit that is printed.
TEST_CASE("the bounding box errs by what the exact tensor says", "[figures]") {
  const MassProperties bell = by("surface", solids::dumbbell().mesh());
  const MassProperties bellBox = by("box", solids::dumbbell().mesh());
  const auto percent = [](double found, double exact) { return 100.0 * (found / exact - 1.0); };
  const double dIzz = percent(bellBox.inertia(2, 2), bell.inertia(2, 2));
  const double dIxx = percent(bellBox.inertia(0, 0), bell.inertia(0, 0));
  const double faster = bell.inertia(2, 2) / bellBox.inertia(2, 2);
  WARN("dumbbell by its box: Izz " << dIzz << " %, Ixx +" << dIxx << " %, spins " << faster
                                   << " times as fast");
  CHECK(std::abs(dIzz + 45.5) < 0.05);
  CHECK(std::abs(dIxx - 5.7) < 0.051);
  CHECK(std::abs(faster - 1.83) < 0.005);

  const MassProperties ell = findInertiaMethod("surface")->weigh(solids::ell().mesh(), 3.0, 1, 0);
  const MassProperties ellBox = findInertiaMethod("box")->weigh(solids::ell().mesh(), 3.0, 1, 0);
  const double dEll = percent(ellBox.inertia(2, 2), ell.inertia(2, 2));
  const double off = (ellBox.centre - ell.centre).norm();
  WARN("L by its box: Izz +" << dEll << " %, Ixy " << ellBox.inertia(0, 1) << " instead of "
                             << ell.inertia(0, 1) << ", centre of mass off by " << off << " m");
  CHECK(std::abs(dEll - 9.1) < 0.05);
  CHECK(ellBox.inertia(0, 1) == 0.0);
  CHECK(ell.inertia(0, 1) == Approx(1.0 / 3.0).epsilon(1e-14));
  CHECK(std::abs(off - 0.236) < 0.0005);
}

// Oracle: fractions by hand, with the sign: mass in the corners (+, −) and (−, +) makes −∫ x y > 0.
// The L of 3 kg about its centre: Ixy = 1/3, Izz = 11/6, Ixx = Iyy = 1/4 · 3 + 2/3 · 1/4 … = 7/6.
TEST_CASE("products of inertia have the sign of minus the integral") {
  const Mat3 I = findInertiaMethod("surface")->weigh(solids::ell().mesh(), 3.0, 1, 0).inertia;
  CHECK(I(0, 1) == Approx(1.0 / 3.0).epsilon(1e-14));
  CHECK(I(2, 2) == Approx(11.0 / 6.0).epsilon(1e-14));
  CHECK(I(0, 0) == Approx(7.0 / 6.0).epsilon(1e-14));
  CHECK(std::abs(I(0, 2)) < 1e-15);
  // Mirrored in x, the product changes sign; every method sees it so.
  solids::Raw mirrored = solids::ell();
  for (Vec3& p : mirrored.points) p.x() = -p.x();
  for (std::vector<int>& face : mirrored.faces) std::reverse(face.begin(), face.end());
  for (const char* method : {"surface", "grid", "random", "quasi"}) {
    const double product = by(method, mirrored.mesh(), 8000).inertia(0, 1);
    CHECK(product == Approx(-1.0 / 9.0).margin(0.01));
  }
}

// Oracle: the same solid twice, as boxes by Steiner's theorem and as a closed surface. Measured
// 3e-16, allowed 1e-14.
TEST_CASE("a compound weighs as much as the surface around it") {
  const struct {
    Compound parts;
    Mesh mesh;
  } pairs[] = {{dumbbellParts(), solids::dumbbell().mesh()}, {ellParts(), solids::ell().mesh()}};
  for (const auto& [parts, mesh] : pairs) {
    const MassProperties a = solidMass(parts, 2.5), b = solidMass(mesh, 2.5);
    CHECK(relativeError(a.inertia, b.inertia) < 1e-14);
    // The mesh counts from its first point.
    CHECK(volume(parts) == Approx(volume(mesh)).epsilon(1e-14));
    const Aabb boxA = boundingBox(withOrigin(parts, a.centre), Pose{});
    const Aabb boxB = boundingBox(withOrigin(mesh, b.centre), Pose{});
    CHECK((boxA.lo - boxB.lo).norm() < 1e-14);
    CHECK((boxA.hi - boxB.hi).norm() < 1e-14);
  }
}

// Oracle: the theory in samples.h. Root mean square over 24 seeds or attitudes; the slope between
// two counts that differ by a factor of 64 scatters by about 0.1. Measured beside each.
TEST_CASE("sampling errors fall as theory says", "[figures]") {
  const solids::Raw bell = solids::dumbbell(), ring = solids::torus(1.0, 0.3, 24, 12);
  const struct {
    const char* text;
    double found, theory, allowed;
  } rows[] = {
      {"random, dumbbell", slope("random", bell, false, 1000, 64000), -0.5, 0.1},
      {"random, torus", slope("random", ring, false, 1000, 64000), -0.5, 0.1},
      {"grid, tilted dumbbell", slope("grid", bell, true, 1000, 64000), -2.0 / 3.0, 0.15},
      {"grid, tilted torus", slope("grid", ring, true, 1000, 64000), -2.0 / 3.0, 0.15},
      {"quasi, dumbbell along the axes", slope("quasi", bell, false, 1000, 64000), -1.0, 0.2},
      {"quasi, tilted torus", slope("quasi", ring, true, 1000, 64000), -2.0 / 3.0, 0.15},
  };
  for (const auto& [text, found, theory, allowed] : rows) {
    WARN("slope of the error, " << text << ": " << found << ", theory " << theory);
    CHECK(std::abs(found - theory) < allowed);
  }
}

// Oracle: parity of crossings against what the solid is made of, at 4000 points; and points that
// lie on lines through edges and corners, where a careless ray counts twice or not at all.
TEST_CASE("inside and outside of a mesh are those of its parts") {
  const Shape mesh = solids::dumbbell().mesh(), parts = dumbbellParts();
  for (const Vec3& p : pointsInside(parts, Spread::Random, 4000))
    CHECK(Interior(mesh).contains(p - solids::dumbbell().points[0]));
  const Shape cube = solids::box(Vec3::Zero(), Vec3::Ones()).mesh();
  const Interior interior(cube);
  for (const double y : {-0.5, 0.0, 0.25, 0.5, 1.0, 1.5})
    for (const double z : {-0.5, 0.0, 0.25, 0.5, 1.0, 1.5}) {
      const bool in = interior.contains({0.5, y, z});
      if (y < 0.0 || y > 1.0 || z < 0.0 || z > 1.0) CHECK_FALSE(in);
      if (y > 0.0 && y < 1.0 && z > 0.0 && z < 1.0) CHECK(in);
      CHECK_FALSE(interior.contains({-0.5, y, z}));
      CHECK_FALSE(interior.contains({1.5, y, z}));
    }
}

// Oracle: the exact tensor. 100,000 points at random, a third of them inside, scatter by 1 %;
// measured at most 1.6 %, allowed 4 %.
TEST_CASE("capsules and hulls are weighed by their points too, alone and as parts") {
  const Hull hull{std::make_shared<const Polyhedron>(convexHull(solids::tetrahedron().points)),
                  Vec3::Zero()};
  const Pose above{{0.1, 0.2, 3.0}, Quat(0.8, 0.6, 0.0, 0.0)};
  const Hull moved{hull.solid, Vec3(-1.0, 2.0, 0.5)};
  const Shape shapes[] = {
      Capsule{0.4, 1.0}, hull,
      Compound{{Part{Capsule{0.4, 1.0}, {}}, Part{moved, above}}, Vec3::Zero()}};
  for (const Shape& shape : shapes) {
    const MassProperties exact = by("surface", shape);
    for (const char* method : {"grid", "random", "quasi"}) {
      const MassProperties found = by(method, shape, 100000);
      CAPTURE(shapeName(shape), method);
      CHECK(relativeError(found.inertia, exact.inertia) < 0.04);
      CHECK((found.centre - exact.centre).norm() < 0.02);
    }
  }
  const Mat3 box = by("box", Capsule{0.4, 1.0}).inertia;
  CHECK(relativeError(box, solidMass(Box{{0.4, 0.9, 0.4}}, 1.0).inertia) < 1e-15);
}

TEST_CASE("the points inside stand in the body frame") {
  Shape shape = solids::ell().mesh();
  shape = withOrigin(shape, solidMass(shape, 1.0).centre);
  Vec3 mean = Vec3::Zero();
  const std::vector<Vec3> points = pointsInside(shape, Spread::Quasi, 40000);
  for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
  CHECK(points.size() == Approx(30000).epsilon(0.001));  // three of the box's four cubes
  CHECK(mean.norm() < 1e-3);
}

TEST_CASE("too few samples are refused") {
  CHECK_THROWS_AS(by("random", solids::dumbbell().mesh(), 1), std::invalid_argument);
  CHECK_THROWS_AS(by("grid", solids::dumbbell().mesh(), 1), std::invalid_argument);
}

// Measured 4e-16, allowed 1e-14.
TEST_CASE("principal axes are a proper rotation that makes the tensor diagonal") {
  const Mat3 ell = solidMass(solids::ell().mesh(), 3.0).inertia;
  Mat3 steep;
  steep << 1.0, 1e-9, -2e-5, 1e-9, 1e-6, 3e-9, -2e-5, 3e-9, 1.0 + 1e-6;
  for (const Mat3& I : {ell, steep, Mat3(Mat3::Identity())}) {
    const PrincipalAxes p = principalAxes(I);
    CHECK((p.axes * p.moments.asDiagonal() * p.axes.transpose() - I).norm() < 1e-14 * I.norm());
    CHECK((p.axes.transpose() * p.axes - Mat3::Identity()).norm() < 1e-14);
    CHECK(p.axes.determinant() == Approx(1.0).epsilon(1e-14));
  }
  // 45° in the plane of the L; moments 7/6 ∓ 1/3 and 11/6.
  const Vec3 moments = principalAxes(ell).moments;
  CHECK(moments.minCoeff() == Approx(5.0 / 6.0).epsilon(1e-14));
  CHECK(moments.maxCoeff() == Approx(11.0 / 6.0).epsilon(1e-14));
  // What is diagonal keeps its axes, in their order.
  const Mat3 box = Vec3(3.0, 1.0, 2.0).asDiagonal();
  CHECK(principalAxes(box).axes == Mat3(Mat3::Identity()));
  CHECK(principalAxes(box).moments == Vec3(3.0, 1.0, 2.0));
}
