// Problems of known answer, written down without shapes or contacts.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/problem/problem.h"
#include "tests/gravity.h"

namespace tumble::test {

/// Uniform numbers from a 64-bit linear congruential generator, one draw a call.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed * 2862933555777941757u + 3037000493u) {}
  double operator()(double lo, double hi) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * static_cast<double>(state_ >> 11) * 0x1p-53;
  }
  int below(int n) { return static_cast<int>((*this)(0.0, n)); }

 private:
  std::uint64_t state_;
};

/// A cube of this mass [kg] and edge [m], moving with v* = (v, omega). Mass 0: immovable. Returns
/// its index.
inline int addCube(Problem& problem, double mass, double edge, const Vec3& v,
                   const Vec3& omega = Vec3::Zero()) {
  problem.invM.push_back(mass > 0.0 ? 1.0 / mass : 0.0);
  problem.Iinv.push_back(mass > 0.0 ? Mat3(Mat3::Identity() * (6.0 / (mass * edge * edge)))
                                    : Mat3(Mat3::Zero()));
  Vec6 twist;
  twist << v, omega;
  problem.vStar.push_back(twist);
  return static_cast<int>(problem.invM.size()) - 1;
}

/// The row d·(ṗa − ṗb) at arms ra, rb [m] from the two centres.
inline Row pointRow(int a, int b, const Vec3& ra, const Vec3& rb, const Vec3& d,
                    double bias = 0.0) {
  return {a, b, d, ra.cross(d), -rb.cross(d), bias};
}

/// A contact with normal n, tangents t1, t2 = n × t1: frictionless if mu = 0.
inline void addContact(Problem& problem, int a, int b, const Vec3& ra, const Vec3& rb, double mu,
                       const Vec3& n = Vec3::UnitY(), const Vec3& t1 = Vec3::UnitX()) {
  const int row = static_cast<int>(problem.rows.size());
  problem.cones.push_back({mu > 0.0 ? ConeKind::Friction : ConeKind::Push, row, mu});
  problem.rows.push_back(pointRow(a, b, ra, rb, n));
  if (mu <= 0.0) return;
  problem.rows.push_back(pointRow(a, b, ra, rb, t1));
  problem.rows.push_back(pointRow(a, b, ra, rb, n.cross(t1)));
}

/// Unit cubes on an immovable floor, each touching the one below with four corners, under gravity:
/// an acceleration-level problem. Body 0 is the floor; cone 4k+c is corner c of cube k+1.
inline Problem tower(const std::vector<double>& masses, double mu) {
  Problem problem;
  addCube(problem, 0.0, 1.0, Vec3::Zero());
  for (double mass : masses) {
    const int cube = addCube(problem, mass, 1.0, Vec3(0.0, -kG, 0.0));
    for (double x : {-0.5, 0.5})
      for (double z : {-0.5, 0.5})
        addContact(problem, cube, cube - 1, Vec3(x, -0.5, z), Vec3(x, 0.5, z), mu);
  }
  return problem;
}

/// nx × ny × nz unit cubes of 1 kg on an immovable floor, body 0, as a step of h [s] finds them at
/// rest. Each touches what is below it with four points a pair; in a bond every other level is
/// shifted by half a cube along x, so that a cube stands on two.
inline Problem pile(int nx, int ny, int nz, bool bond, double mu, double h) {
  Problem problem;
  addCube(problem, 0.0, 1.0, Vec3::Zero());
  const auto indexOf = [&](int x, int y, int z) { return 1 + x + nx * (z + nz * y); };
  const auto place = [&](int x, int y) { return x + (bond && y % 2 == 1 ? 0.5 : 0.0); };
  for (int y = 0; y < ny; ++y) {
    for (int k = 0; k < nx * nz; ++k) addCube(problem, 1.0, 1.0, Vec3(0.0, -kG * h, 0.0));
    for (int z = 0; z < nz; ++z)
      for (int x = 0; x < nx; ++x)
        for (int below = y > 0 ? 0 : x; below < (y > 0 ? nx : x + 1); ++below) {
          const double offset = y > 0 ? place(x, y) - place(below, y - 1) : 0.0;
          if (std::abs(offset) > 0.9) continue;
          for (double side : {-0.5, 0.5})
            for (double dz : {-0.5, 0.5}) {
              const double at = side - (side * offset > 0.0 ? offset : 0.0);
              addContact(problem, indexOf(x, y, z), y > 0 ? indexOf(below, y - 1, z) : 0,
                         Vec3(at, -0.5, dz),
                         y > 0 ? Vec3(at + offset, 0.5, dz) : Vec3(place(x, y), 0.0, z), mu);
            }
        }
  }
  return problem;
}

/// Every body that can move gets up to `noise` [m/s, rad/s] more in each component of vStar.
inline void shake(Problem& problem, double noise, std::uint64_t seed) {
  Draw draw(seed);
  for (std::size_t body = 0; body < problem.invM.size(); ++body) {
    if (problem.invM[body] == 0.0) continue;
    for (int k = 0; k < 6; ++k) problem.vStar[body][k] += draw(-noise, noise);
  }
}

/// Sum of the normal λ of the four corners below cube k = 0, 1, … of a tower.
inline double levelForce(const Problem& problem, const Solution& solution, int k) {
  double sum = 0.0;
  for (int c = 0; c < 4; ++c) sum += solution.lambda[problem.cones[4 * k + c].row];
  return sum;
}

}  // namespace tumble::test
