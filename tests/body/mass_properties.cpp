#include "sim/body/mass_properties.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr double kPi = 3.14159265358979323846;

bool inside(const Sphere& s, const Vec3& p) {
  return p.squaredNorm() < s.r * s.r;
}
bool inside(const Box& b, const Vec3& p) {
  return (p.array().abs() < b.half.array()).all();
}
bool inside(const Cylinder& c, const Vec3& p) {
  return std::abs(p.y()) < 0.5 * c.h && p.x() * p.x() + p.z() * p.z() < c.r * c.r;
}

/// The integrals of slide SD20 over a grid of cells of edge 1/64 [m]: volume, and inertia of
/// mass 1.
template <class Solid>
MassProperties integrate(const Solid& solid, double& volumeSum) {
  const double cell = 1.0 / 64.0;
  Mat3 sum = Mat3::Zero();
  double count = 0.0;
  for (double x = -1.0 + cell / 2; x < 1.0; x += cell) {
    for (double y = -1.0 + cell / 2; y < 1.0; y += cell) {
      for (double z = -1.0 + cell / 2; z < 1.0; z += cell) {
        const Vec3 p(x, y, z);
        if (!inside(solid, p)) continue;
        count += 1.0;
        sum += p.squaredNorm() * Mat3::Identity() - p * p.transpose();
      }
    }
  }
  volumeSum = count * cell * cell * cell;
  return {1.0, sum / count};
}

template <class Solid>
void checkAgainstIntegral(const Solid& solid) {
  double v = 0.0;
  const MassProperties sum = integrate(solid, v);
  CHECK(volume(solid) == Approx(v).epsilon(0.01));
  CHECK((solidMass(solid, 1.0).inertia - sum.inertia).norm() < 0.01 * sum.inertia.norm());
}

}  // namespace

// Oracle: closed forms with whole numbers; only rounding remains.
TEST_CASE("mass properties of sphere, box and cylinder are those of the textbook") {
  const Mat3 sphere = solidMass(Sphere{0.5}, 10.0).inertia;
  CHECK((sphere - Mat3::Identity()).norm() < 1e-15);
  const Mat3 box = solidMass(Box{{0.5, 1.0, 1.5}}, 12.0).inertia;
  CHECK((box.diagonal() - Vec3(13.0, 10.0, 5.0)).norm() < 1e-14);
  CHECK(box.isDiagonal(0.0));
  const Mat3 cylinder = solidMass(Cylinder{2.0, 3.0}, 12.0).inertia;
  CHECK((cylinder.diagonal() - Vec3(21.0, 24.0, 21.0)).norm() < 1e-14);

  CHECK(volume(Sphere{0.5}) == Approx(kPi / 6.0));
  CHECK(volume(Box{{0.5, 1.0, 1.5}}) == Approx(6.0));
  CHECK(volume(Cylinder{2.0, 3.0}) == Approx(12.0 * kPi));
  CHECK(std::isinf(volume(HalfSpace{})));
}

// Oracle: the integrals themselves, summed over two million cells. Measured 0.2 %,
// allowed 1 %.
TEST_CASE("mass properties are the integrals of the slides") {
  checkAgainstIntegral(Sphere{0.9});
  checkAgainstIntegral(Box{{0.25, 0.5, 0.875}});
  checkAgainstIntegral(Cylinder{0.6, 1.75});
}

TEST_CASE("a body that cannot be is refused") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double mass : {0.0, -1.0, infinity, std::nan("")}) {
    CHECK_THROWS_AS(solidMass(Sphere{1.0}, mass), std::invalid_argument);
    CHECK_THROWS_AS(makeBody({mass, Mat3::Identity()}), std::invalid_argument);
  }
  CHECK_THROWS_AS(solidMass(HalfSpace{}, 1.0), std::invalid_argument);

  Mat3 negative = Mat3::Identity(), lopsided = Mat3::Identity(), saddle = Mat3::Identity();
  negative(1, 1) = -1.0;
  lopsided(0, 1) = 0.5;
  saddle(0, 1) = saddle(1, 0) = 2.0;
  for (const Mat3& I : {negative, lopsided, saddle, Mat3(Mat3::Zero()), Mat3(NAN * negative)}) {
    CHECK_THROWS_AS(makeBody({1.0, I}), std::invalid_argument);
  }
}

// Measured 3e-16, allowed 1e-14: a well-conditioned inverse.
TEST_CASE("an inertia tensor that is not diagonal is inverted too") {
  Mat3 I;
  I << 2.0, 0.3, -0.1, 0.3, 1.5, 0.2, -0.1, 0.2, 1.0;
  const RigidBody body = makeBody({3.0, I});
  CHECK((body.Ibody * body.IbodyInv - Mat3::Identity()).norm() < 1e-14);
  CHECK(body.invM * body.M == Approx(1.0));
}
