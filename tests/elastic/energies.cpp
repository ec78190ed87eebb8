// Every energy by differences, under rigid motions, and projected.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/elastic/elastic_body.h"
#include "sim/elastic/solid.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

/// A number in [−1, 1] that depends on its place alone.
double drawn(int& state) {
  state = static_cast<int>((static_cast<long>(state) * 48271) % 2147483647);
  return 2.0 * state / 2147483647.0 - 1.0;
}

Vec3 drawnPoint(int& state) {
  const double x = drawn(state), y = drawn(state), z = drawn(state);
  return {x, y, z};
}

const std::array<Vec3, 4> kCorners = {Vec3(0.0, 0.0, 0.0), Vec3(0.9, 0.1, 0.0), Vec3(0.1, 1.1, 0.1),
                                      Vec3(-0.1, 0.2, 0.8)};

const Vec3 kHalf(0.5, 0.4, 0.6);

/// One of each row of the table, with its points at rest in restOf (nearly, where they cannot).
std::vector<Energy> examples() {
  const Weave weave = weaveOf({0.0, 0.0}, {0.9, 0.1}, {0.1, 1.1});
  const Cell cell = cellOf(kCorners);
  return {StretchSpring{.stiffness = 7.0, .damping = 0.3, .rest = 0.8},
          ClothStretch{.weave = weave, .stiffness = 5.0, .damping = 0.2},
          ClothShear{.weave = weave, .stiffness = 3.0, .damping = 0.4},
          ClothBend{.difference = {1.0, -1.0, -1.0, 1.0}, .stiffness = 2.0},
          StrandBend{.stiffness = 1.5, .length = 0.9},
          Corotated{.cell = cell, .solid = solidityOf(10.0, 0.3, 0.5)},
          NeoHookean{.cell = cell, .solid = solidityOf(10.0, 0.4, 0.5)},
          ShapeMatch{.half = kHalf, .mu = 5.0, .viscosity = 0.5},
          ClothPoint{.stiffness = 6.0, .thickness = 1.5},
          ClothEdges{.stiffness = 6.0, .thickness = 1.5}};
}

ElementPlaces restOf(const Energy& energy) {
  ElementPlaces x;
  x.fill(Vec3::Zero());
  std::copy(kCorners.begin(), kCorners.end(), x.begin());
  if (std::holds_alternative<ShapeMatch>(energy))
    for (int c = 0; c < 8; ++c)
      x[c] = kHalf.cwiseProduct(Vec3(2 * (c & 1) - 1, (c & 2) - 1, (c >> 1 & 2) - 1));
  return x;
}

/// Places near those at rest: further away the more `by` is.
ElementPlaces placesOf(const Energy& energy, int seed, double by) {
  int state = 12345 + 97 * seed;
  ElementPlaces x = restOf(energy);
  for (Vec3& p : x) p += by * drawnPoint(state);
  return x;
}

/// The block of the points that an energy joins.
Eigen::MatrixXd joined(const Energy& energy, const ElementMatrix& A) {
  return A.topLeftCorner(3 * pointsOf(energy), 3 * pointsOf(energy));
}
Eigen::VectorXd joined(const Energy& energy, const ElementVector& v) {
  return v.head(3 * pointsOf(energy));
}

ElementTerms termsOf(const Energy& energy, const ElementPlaces& x, ElementAsk ask) {
  ElementTerms terms;
  differentiate(energy, x, ask, terms);
  return terms;
}

ElementPlaces moved(ElementPlaces x, int k, double by) {
  x[k / 3][k % 3] += by;
  return x;
}

}  // namespace

TEST_CASE("every row of the table of energies has an example in these tests") {
  const auto all = examples();
  REQUIRE(all.size() == energyKinds().size());
  for (std::size_t k = 0; k < all.size(); ++k) CHECK(all[k].index() == k);
}

// Oracle: central differences of E, and of the gradient; their own error is h² times a third
// derivative. Measured 2e-10 and 4e-10 of the largest entry, allowed 1e-7.
TEST_CASE("gradient and Hessian of every energy are its derivatives, far from rest too") {
  constexpr double h = 1e-5;
  for (const Energy& energy : examples())
    for (const double by : {0.05, 0.4})
      for (int seed = 0; seed < 10; ++seed) {
        const ElementPlaces x = placesOf(energy, seed, by);
        const ElementTerms at = termsOf(energy, x, ElementAsk::Matrices);
        CAPTURE(energyKinds()[energy.index()].name, by, seed);
        const double size = 1e-7 * (1.0 + at.gradient.lpNorm<Eigen::Infinity>());
        const double stiff = 1e-7 * (1.0 + at.hessian.lpNorm<Eigen::Infinity>());
        for (int k = 0; k < 3 * pointsOf(energy); ++k) {
          const ElementTerms up = termsOf(energy, moved(x, k, h), ElementAsk::Forces);
          const ElementTerms down = termsOf(energy, moved(x, k, -h), ElementAsk::Forces);
          CHECK(std::abs((up.energy - down.energy) / (2.0 * h) - at.gradient[k]) <= size);
          const ElementVector off = (up.gradient - down.gradient) / (2.0 * h) - at.hessian.col(k);
          CHECK(joined(energy, off).lpNorm<Eigen::Infinity>() <= stiff);
        }
        CHECK(termsOf(energy, x, ElementAsk::Energy).energy == at.energy);
      }
}

// Oracle: invariance. Forces of what only knows relative places add up to nothing, and turn
// nothing. Measured 2e-16 of the sizes of the terms, allowed 1e-12.
TEST_CASE("no energy pushes or turns its points as a whole, nor does its damping") {
  for (const Energy& energy : examples())
    for (int seed = 0; seed < 20; ++seed) {
      const ElementPlaces x = placesOf(energy, seed, 0.5);
      const ElementTerms at = termsOf(energy, x, ElementAsk::Matrices);
      int state = 7 + seed;
      ElementVector v;
      for (double& speed : v) speed = drawn(state);
      CAPTURE(energyKinds()[energy.index()].name, seed);
      for (const ElementVector& f : {at.gradient, elementTimes(at.damping, v, pointsOf(energy))}) {
        Vec3 sum = Vec3::Zero(), turn = Vec3::Zero();
        for (int i = 0; i < pointsOf(energy); ++i) {
          sum += f.segment<3>(3 * i);
          turn += x[i].cross(Vec3(f.segment<3>(3 * i)));
        }
        const double size = 1.0 + joined(energy, f).lpNorm<1>();
        CHECK(sum.norm() <= 1e-12 * size);
        CHECK(turn.norm() <= 1e-12 * size);
      }
    }
}

// Oracle: invariance. Measured 2e-16, allowed 1e-12.
TEST_CASE("a rigid motion changes no energy, and turns its forces along") {
  const Quat q = Quat(0.3, -0.5, 0.7, 0.2).normalized();
  const Vec3 way(0.4, -1.0, 2.0);
  for (const Energy& energy : examples()) {
    const ElementPlaces x = placesOf(energy, 3, 0.4);
    ElementPlaces y = x;
    for (Vec3& p : y) p = q * p + way;
    const ElementTerms a = termsOf(energy, x, ElementAsk::Forces);
    const ElementTerms b = termsOf(energy, y, ElementAsk::Forces);
    CAPTURE(energyKinds()[energy.index()].name);
    CHECK(std::abs(a.energy - b.energy) <= 1e-12 * (1.0 + a.energy));
    for (int i = 0; i < pointsOf(energy); ++i)
      CHECK((q * Vec3(a.gradient.segment<3>(3 * i)) - b.gradient.segment<3>(3 * i)).norm() <=
            1e-12 * (1.0 + a.gradient.norm()));
  }
}

// Oracle: eigenvalues. Measured −3e-16 of the largest, allowed −1e-13: rounding of the sum.
TEST_CASE("projected Hessians have no negative eigenvalue, and give way to no rigid shift") {
  for (const Energy& energy : examples()) {
    double lowest = 0.0;
    for (int seed = 0; seed < 40; ++seed) {
      const ElementPlaces x = placesOf(energy, seed, 0.9);  // compressed, folded, inside out
      const Eigen::MatrixXd H = joined(energy, termsOf(energy, x, ElementAsk::Projected).hessian);
      const Eigen::MatrixXd full = joined(energy, termsOf(energy, x, ElementAsk::Matrices).hessian);
      CAPTURE(energyKinds()[energy.index()].name, seed);
      const auto least = [](const Eigen::MatrixXd& A) {
        return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues()[0];
      };
      CHECK(least(H) >= -1e-13 * (1.0 + H.norm()));
      CHECK((H - H.transpose()).norm() <= 1e-13 * (1.0 + H.norm()));
      lowest = std::min(lowest, least(full));
      for (int axis = 0; axis < 3; ++axis) {
        Eigen::VectorXd shift = Eigen::VectorXd::Zero(H.rows());
        for (int i = 0; i < pointsOf(energy); ++i) shift[3 * i + axis] = 1.0;
        CHECK((H * shift).norm() <= 1e-12 * (1.0 + H.norm()));
      }
    }
    // Only the quadratic one needs no projection.
    CHECK((lowest < -1e-3) == !std::holds_alternative<ClothBend>(energy));
  }
}

// Oracle: closed form, ½ σ:ε. What it leaves out is of third order: measured 2e-11 and 7e-6 of it.
TEST_CASE("small strains are those of linear elasticity") {
  constexpr double e = 1e-5, young = 10.0, nu = 0.3;
  const Solidity solid = solidityOf(young, nu);
  const Cell cell = cellOf(kCorners);
  const Mat3 strain = (Mat3() << 2.0, 0.3, 0.1, 0.3, -1.0, 0.2, 0.1, 0.2, 0.5).finished() * e;
  const double expected = cell.volume * (solid.mu * strain.squaredNorm() +
                                         0.5 * solid.lambda * strain.trace() * strain.trace());
  for (const Energy& energy : {Energy(Corotated{cell, solid}), Energy(NeoHookean{cell, solid})}) {
    ElementPlaces x = restOf(energy);
    for (Vec3& p : x) p += strain * p;
    CHECK(termsOf(energy, x, ElementAsk::Energy).energy / expected == Approx(1.0).epsilon(1e-4));
  }
  // Of no Poisson's ratio, whatever its edges.
  const Energy match = ShapeMatch{.half = kHalf, .mu = 0.5 * young};
  ElementPlaces x = restOf(match);
  for (Vec3& p : x) p += strain * p;
  CHECK(termsOf(match, x, ElementAsk::Energy).energy ==
        Approx(8.0 * kHalf.prod() * 0.5 * young * strain.squaredNorm()).epsilon(1e-4));
}

// Oracle: the definition: the mean of the places, and of all turns the one that leaves least, here
// by Horn's quaternion, an eigenvector of a 4 × 4 matrix (Closed-form Solution of Absolute
// Orientation Using Unit Quaternions, 1987). Measured 2e-15 of it, allowed 1e-12.
TEST_CASE("a cube that matches its shape stores what the best turn of it leaves") {
  constexpr double h = 0.3, mu = 7.0;
  const Energy energy = ShapeMatch{.half = Vec3::Constant(h), .mu = mu};
  std::array<Vec3, 8> q;
  for (int c = 0; c < 8; ++c) q[c] = h * restOf(energy)[c].cwiseQuotient(kHalf);
  for (int seed = 0; seed < 20; ++seed) {
    int state = 77 + seed;
    const Quat turn = Quat(drawn(state), drawn(state), drawn(state), drawn(state)).normalized();
    ElementPlaces x;
    Vec3 centre = Vec3::Zero();
    for (int c = 0; c < 8; ++c) {
      x[c] = turn * q[c] + Vec3(1.0, -2.0, 0.5) + 0.2 * drawnPoint(state);
      centre += 0.125 * x[c];
    }
    Mat3 S = Mat3::Zero();
    for (int c = 0; c < 8; ++c) S += q[c] * (x[c] - centre).transpose();
    const Vec3 odd(S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0));
    Eigen::Matrix4d N;
    N << S.trace(), odd.transpose(), odd, S + S.transpose() - S.trace() * Mat3::Identity();
    const Vec4 best = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(N).eigenvectors().col(3);
    const Quat R(best[0], best[1], best[2], best[3]);
    double left = 0.0;
    for (int c = 0; c < 8; ++c) left += (x[c] - centre - R * q[c]).squaredNorm();
    const double stored = termsOf(energy, x, ElementAsk::Energy).energy;
    CAPTURE(seed, stored / (mu * h * left) - 1.0);
    CHECK(stored == Approx(mu * h * left).epsilon(1e-12));
  }
}

// Oracle: closed form. Measured 3e-15, allowed 1e-14; of F pressed flat, to a line or to a point
// too, and beside stretches of a billionth.
TEST_CASE("stretches know inside out: U and V are rotations, and F comes back") {
  for (int seed = 0; seed < 20; ++seed) {
    int state = 5 + seed;
    Mat3 any, turn;
    for (int k = 0; k < 9; ++k) any(k / 3, k % 3) = drawn(state);
    turn = stretchesOf(any).U;
    const Mat3 ofFlat = any * Vec3(1.0, 0.7, 0.0).asDiagonal() * turn,
               ofLine = any.col(0) * any.row(1),
               thin = turn * Vec3(1.0, -1e-9, 1.0).asDiagonal() * any;
    for (const Mat3& F : {any, ofFlat, ofLine, Mat3(Mat3::Zero()), turn, thin}) {
      const Stretches s = stretchesOf(F);
      CHECK((s.U * s.U.transpose() - Mat3::Identity()).norm() <= 1e-14);
      CHECK((s.V * s.V.transpose() - Mat3::Identity()).norm() <= 1e-14);
      CHECK(s.U.determinant() == Approx(1.0));
      CHECK(s.V.determinant() == Approx(1.0));
      CHECK((s.U * s.sigma.asDiagonal() * s.V.transpose() - F).norm() <= 1e-14);
      CHECK(stretchesAloneOf(F) == s.sigma);
      if (std::abs(F.determinant()) > 1e-14) CHECK((s.sigma[2] < 0.0) == (F.determinant() < 0.0));
    }
  }
}

// Oracle: the definition, by search over both pieces: no two of their points are nearer than the
// nearest, and no two much further apart than those on a grid of 1/200. Of all kinds: corner, edge
// and inside.
TEST_CASE("the nearest points of a point and a triangle, and of two edges, are the nearest") {
  constexpr int kGrid = 200;
  int kinds[2][3] = {};
  for (int seed = 0; seed < 60; ++seed) {
    int state = 31 + seed;
    std::array<Vec3, 4> x;
    for (Vec3& p : x) p = drawnPoint(state);
    for (const bool edges : {false, true}) {
      const ClothGap nearest = edges ? nearestOfEdges(x) : nearestOnTriangle(x);
      ++kinds[edges][nearest.ways];
      double least = 1e9;
      for (int i = 0; i <= kGrid; ++i)
        for (int j = 0; j <= (edges ? kGrid : kGrid - i); ++j) {
          const double s = i / double{kGrid}, u = j / double{kGrid};
          const Vec3 span = edges ? Vec3(x[0] + s * (x[1] - x[0]) - x[2] - u * (x[3] - x[2]))
                                  : Vec3(x[0] - x[1] - s * (x[2] - x[1]) - u * (x[3] - x[1]));
          least = std::min(least, span.norm());
        }
      CAPTURE(seed, edges, nearest.ways);
      CHECK(nearest.span.norm() <= least + 1e-12);
      CHECK(nearest.span.norm() >= least - 0.02);
      Vec3 span = Vec3::Zero();
      for (int k = 0; k < 4; ++k) span += nearest.weight[k] * x[k];
      CHECK((span - nearest.span).norm() <= 1e-15);
      CHECK(std::abs(nearest.weight.sum()) <= 1e-15);
      // Where they slide, they stay nearest.
      for (int k = 0; k < nearest.ways; ++k) {
        Vec3 way = Vec3::Zero();
        for (int i = 0; i < 4; ++i) way += nearest.slide(i, k) * x[i];
        CHECK(std::abs(way.dot(nearest.span)) <= 1e-13);
      }
    }
  }
  for (const auto& of : kinds)
    for (const int count : of) CHECK(count > 0);
}

TEST_CASE("triangles and tetrahedra without size, or turned over, are refused") {
  CHECK_THROWS_AS(weaveOf({0, 0}, {1, 0}, {2, 0}), std::invalid_argument);
  CHECK_THROWS_AS(weaveOf({0, 0}, {0, 1}, {1, 0}), std::invalid_argument);
  CHECK_THROWS_AS(cellOf({Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)}),
                  std::invalid_argument);
  CHECK_THROWS_AS(solidityOf(1.0, 0.5), std::invalid_argument);
  CHECK_THROWS_AS(solidityOf(0.0, 0.3), std::invalid_argument);
}
