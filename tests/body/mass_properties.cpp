#include "sim/body/mass_properties.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/shape/convex_hull.h"
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

bool inside(const Capsule& c, const Vec3& p) {
  const double y = std::clamp(p.y(), -0.5 * c.h, 0.5 * c.h);
  return (p - Vec3(0.0, y, 0.0)).norm() < c.r;
}

bool inside(const Ellipsoid& e, const Vec3& p) {
  return p.cwiseQuotient(e.half).norm() < 1.0;
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
  checkAgainstIntegral(Capsule{0.4, 1.1});
  checkAgainstIntegral(Ellipsoid{{0.9, 0.4, 0.6}});
}

// Oracle: a ball, stretched: of one moment ∫ x² dm = m a²/5 each, I is their sums. Measured 1e-16.
TEST_CASE("an ellipsoid weighs as a ball that is stretched") {
  const Mat3 ball = solidMass(Sphere{1.0}, 3.0).inertia,
             I = solidMass(Ellipsoid{{2.0, 3.0, 5.0}}, 3.0).inertia;
  const double own = 0.5 * ball(0, 0);
  CHECK((I.diagonal() - own * Vec3(34.0, 29.0, 13.0)).norm() < 1e-13);
  CHECK(I.isDiagonal(0.0));
  CHECK(std::abs(volume(Ellipsoid{{2.0, 3.0, 5.0}}) / volume(Sphere{1.0}) - 30.0) < 1e-13);
}

// Oracle: discs across Y, whose moments are polynomials in y of degree 4 along the cylinder and
// along each cap; Boole's rule integrates them exactly. Measured 2e-16.
TEST_CASE("a capsule weighs as much as the discs it is made of") {
  const Capsule c{0.3, 0.7};
  double V = 0.0, along = 0.0, across = 0.0;
  const auto disc = [&](double weight, double y) {
    const double cap = std::max(std::abs(y) - 0.5 * c.h, 0.0), square = c.r * c.r - cap * cap;
    V += weight * kPi * square;
    along += weight * kPi * square * 0.5 * square;
    across += weight * kPi * square * (0.25 * square + y * y);
  };
  const double ends[] = {-0.5 * c.h - c.r, -0.5 * c.h, 0.5 * c.h, 0.5 * c.h + c.r};
  const double boole[] = {7.0, 32.0, 12.0, 32.0, 7.0};
  for (int piece = 0; piece < 3; ++piece)
    for (int k = 0; k < 5; ++k) {
      const double length = ends[piece + 1] - ends[piece];
      disc(boole[k] / 90.0 * length, ends[piece] + 0.25 * k * length);
    }
  CHECK(std::abs(volume(c) / V - 1.0) < 1e-14);
  const Mat3 I = solidMass(c, 2.0).inertia;
  CHECK((I.diagonal() - 2.0 / V * Vec3(across, along, across)).norm() < 1e-14);
  CHECK(I.isDiagonal(0.0));
  const Mat3 ball = solidMass(Capsule{0.5, 1e-12}, 10.0).inertia;
  CHECK((ball - Mat3::Identity()).norm() < 1e-11);
}

// Oracle: the same points as a mesh, as a box and as parts.
TEST_CASE("a hull weighs as the same solid made otherwise") {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) corners.emplace_back(k & 1 ? 2.0 : 0.0, k & 2 ? 3.0 : 0.0, k / 4);
  const Vec3 way(10.0, -20.0, 5.0);
  for (Vec3& p : corners) p += way;
  const Hull hull{std::make_shared<const Polyhedron>(convexHull(corners)), -corners[0]};
  const MassProperties whole = solidMass(hull, 6.0);
  CHECK((whole.inertia - solidMass(Box{{1.0, 1.5, 0.5}}, 6.0).inertia).norm() < 1e-13);
  CHECK((whole.centre - Vec3(1.0, 1.5, 0.5)).norm() < 1e-14);
  CHECK((solidMass(Mesh{hull.solid, Vec3::Zero()}, 6.0).inertia - whole.inertia).norm() < 1e-15);

  const Quat q = Quat(0.3, 0.4, -0.5, 0.2).normalized();
  const Compound alone{{Part{hull, {{1.0, 2.0, 3.0}, q}}}, Vec3::Zero()};
  const MassProperties turned = solidMass(alone, 6.0);
  const Mat3 R = q.toRotationMatrix();
  CHECK((turned.inertia - R * whole.inertia * R.transpose()).norm() < 1e-13);
  const Vec3 middle = R * (way + Vec3(1.0, 1.5, 0.5)) + Vec3(1.0, 2.0, 3.0);
  CHECK((turned.centre - middle).norm() < 1e-13);
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
