// Problems of known answer, written down without shapes or contacts.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/problem/problem.h"

namespace tumble::test {

inline constexpr double kG = 9.81;  // m/s²

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

/// Sum of the normal λ of the four corners below cube k = 0, 1, … of a tower.
inline double levelForce(const Problem& problem, const Solution& solution, int k) {
  double sum = 0.0;
  for (int c = 0; c < 4; ++c) sum += solution.lambda[problem.cones[4 * k + c].row];
  return sum;
}

}  // namespace tumble::test
