// Chapter 0, math: the side of a plane on which a point is, without a wrong answer.
#include "sim/math/orientation.h"

#include <array>
#include <cmath>
#include <random>

#include "tests/catch.h"
#include "tests/collide/exact_sat.h"

using namespace tumble;

namespace {

int exactSide(const std::array<Vec3, 4>& p) {
  std::array<ExactVec, 4> q;
  for (std::size_t i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) q[i][static_cast<std::size_t>(k)] = exactly(p[i][k]);
  for (std::size_t i = 1; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) q[i][k] -= q[0][k];
  const Exact det = dot(cross(q[1], q[2]), q[3]);
  return det > 0 ? 1 : det < 0 ? -1 : 0;
}

/// The determinant as most would write it.
int roundedSide(const std::array<Vec3, 4>& p) {
  const double det = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
  return det > 0.0 ? 1 : det < 0.0 ? -1 : 0;
}

}  // namespace

TEST_CASE("a point above a triangle that runs counter-clockwise is on its positive side") {
  const Vec3 a = Vec3::Zero(), b = Vec3::UnitX(), c = Vec3::UnitY();
  CHECK(orientation(a, b, c, Vec3(0.2, 0.2, 1e-300)) == 1);
  CHECK(orientation(a, b, c, Vec3(0.2, 0.2, -5.0)) == -1);
  CHECK(orientation(a, b, c, Vec3(3.7, -0.1, 0.0)) == 0);
}

// Oracle: whole numbers of any length. Points in or within a unit in the last place of a plane;
// rounding alone is wrong for a share of them, which is printed; ours for none.
TEST_CASE("the side of a plane is right for points that rounding cannot place", "[figures]") {
  std::mt19937_64 engine(7);
  const auto unit = [&] { return std::ldexp(static_cast<double>(engine() >> 11), -53) - 0.5; };
  int wrong = 0, roundedWrong = 0, inPlane = 0;
  constexpr int kTrials = 20000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double away = trial % 2 ? 0.0 : 1000.0, scale = std::ldexp(1.0, trial % 60 - 30);
    std::array<Vec3, 4> p;
    for (Vec3& q : p) q = scale * (Vec3(unit(), unit(), unit()) + Vec3::Constant(away));
    const double s = unit(), t = unit();
    p[3] = p[0] + s * (p[1] - p[0]) + t * (p[2] - p[0]);
    if (trial % 3 == 0) p[3] = p[0] + 0.5 * (p[1] - p[0]);
    if (trial % 3 == 1) p[3][trial % 2] = std::nextafter(p[3][trial % 2], 1e9);
    const int side = exactSide(p);
    wrong += orientation(p[0], p[1], p[2], p[3]) != side;
    wrong += orientation(p[1], p[0], p[2], p[3]) != -side;
    roundedWrong += roundedSide(p) != side;
    inPlane += side == 0;
  }
  WARN("orientation: wrong of 40000: measured " << wrong << ", by rounding alone " << roundedWrong
                                                << ", in the plane " << inPlane);
  CHECK(wrong == 0);
  CHECK(roundedWrong > kTrials / 20);
  CHECK(inPlane > 10);
}

// Oracle: whole numbers of any length. Three points in line but for rounding, whose plane the
// product of rounded differences turns by up to a radian. Measured 6e-13, allowed 1e-11.
TEST_CASE("the area of a triangle points the right way however narrow it is") {
  std::mt19937_64 engine(11);
  const auto unit = [&] { return std::ldexp(static_cast<double>(engine() >> 11), -53) - 0.5; };
  double off = 0.0, plain = 0.0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 a(unit(), unit(), unit()), b(unit(), unit(), unit());
    const Vec3 away(unit(), unit(), unit());
    const Vec3 c = a + unit() * (b - a) + std::ldexp(1.0, -(trial % 55)) * away;
    ExactVec u, v;
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = static_cast<int>(k);
      u[k] = exactly(b[i]) - exactly(a[i]);
      v[k] = exactly(c[i]) - exactly(a[i]);
    }
    const ExactVec n = cross(u, v);
    Vec3 exact;
    for (std::size_t k = 0; k < 3; ++k) exact[static_cast<int>(k)] = n[k].convert_to<double>();
    if (exact.isZero(0.0)) continue;
    exact.normalize();
    off = std::max(off, (twiceArea(a, b, c).normalized() - exact).norm());
    const Vec3 rounded = (b - a).cross(c - a);
    plain = std::max(plain, (rounded.stableNormalized() - exact).norm());
  }
  WARN("narrow triangles: measured " << off << " off their direction, by plain products " << plain);
  CHECK(off < 1e-11);
  CHECK(plain > 1e-3);
}
