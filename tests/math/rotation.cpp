#include "sim/math/rotation.h"

#include <cmath>
#include <stdexcept>

#include "tests/catch.h"

using namespace tumble;

namespace {
constexpr double kPi = 3.14159265358979323846;
}

TEST_CASE("the skew matrix of a times b is a cross b") {
  const Vec3 a(1.0, -2.0, 3.0), b(0.5, 4.0, -1.5);
  CHECK((skew(a) * b - a.cross(b)).norm() == 0.0);
}

// Oracle: closed form. Measured 3e-16, allowed 1e-15.
TEST_CASE("a quarter turn about y takes z to x") {
  const Quat q = fromAxisAngle({0.0, 3.0, 0.0}, 0.5 * kPi);
  CHECK((q * Vec3::UnitZ() - Vec3::UnitX()).norm() < 1e-15);
}

TEST_CASE("a rotation without an axis is refused") {
  CHECK_THROWS_AS(fromAxisAngle(Vec3::Zero(), 1.0), std::invalid_argument);
  CHECK_THROWS_AS(fromAxisAngle({0.0, NAN, 0.0}, 1.0), std::invalid_argument);
}

// Oracle: closed form; both sides round a few times. Measured 3e-16, allowed 2e-15.
TEST_CASE("turning by a world vector composes from the left, at every size of the vector") {
  const Quat q = fromAxisAngle({1.0, 2.0, -0.5}, 0.7);
  const Vec3 axis = Vec3(-1.0, 0.3, 2.0).normalized();
  for (const double angle : {0.0, 1e-200, 1e-9, 0.99e-4, 1.01e-4, 0.013, 1.1, 6.7}) {
    const Quat expected = fromAxisAngle(axis, angle) * q;
    const Quat got = rotated(q, angle * axis);
    CAPTURE(angle);
    CHECK((got.coeffs() - expected.coeffs()).norm() < 2e-15);
  }
}

// Oracle: symmetry. The first order is what a small turn adds; its sign and side are checked.
TEST_CASE("a small turn moves each point by w cross p") {
  const Quat q = fromAxisAngle({0.2, -1.0, 0.4}, 1.3);
  const Vec3 p_B(0.3, 0.8, -0.2), w(2e-9, -1e-9, 3e-9);
  const Vec3 moved = rotated(q, w) * p_B - q * p_B;
  // Second order 1e-17, rounding of p 2e-16. Measured 1e-16, allowed 2e-15 of 3e-9.
  CHECK((moved - w.cross(q * p_B)).norm() < 2e-15);
}

// Oracle: invariants; a turn is the least if its axis lies across both. Measured 5e-16 and 3e-16,
// allowed 2e-15 each.
TEST_CASE("the turn between two directions takes one to the other by the shortest way") {
  const Vec3 from(0.3, -1.0, 2.0);
  const Vec3 across = from.unitOrthogonal();
  for (const double angle : {0.0, 1e-9, 0.4, 1.5, 1.6, 3.0, kPi - 1e-9, kPi - 1e-15, kPi}) {
    const Vec3 to = 1e-30 * (fromAxisAngle(across, angle) * from);
    const Quat q = turnBetween(from, to);
    CAPTURE(angle);
    CHECK((q * from.normalized() - to.stableNormalized()).norm() < 2e-15);
    CHECK(std::abs(q.vec().dot(from.normalized())) < 2e-15);
  }
}

// Oracle: invariant. Measured 5e-16, allowed 2e-15.
TEST_CASE("the matrix of a quaternion is a rotation whatever the quaternion's length") {
  const Quat q = fromAxisAngle({1.0, -2.0, 0.7}, 2.1);
  const Quat stretched(1.3 * q.coeffs());
  const Mat3 R = rotationMatrix(stretched);
  CHECK((R * R.transpose() - Mat3::Identity()).norm() < 2e-15);
  CHECK(R.determinant() == Approx(1.0).margin(1e-15));
  const Vec3 p(0.4, -1.1, 0.9);
  CHECK((R * p - q * p).norm() < 2e-15);
}
