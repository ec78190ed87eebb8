// The parts that solvers are made of: one frictional contact, the growing factor, the residual.
#include <Eigen/Cholesky>
#include <algorithm>

#include "sim/problem/cone.h"
#include "sim/problem/delassus.h"
#include "sim/problem/friction_block.h"
#include "sim/problem/growing_cholesky.h"
#include "tests/catch.h"
#include "tests/problem/problems.h"

using namespace tumble;
using namespace tumble::test;

// Oracle: Coulomb's law itself. W couples normal and tangent as strongly as an arm can.
// Measured 5e-16, allowed 1e-10.
TEST_CASE("one contact obeys Coulomb's law: open, sticking or sliding") {
  Draw draw(7);
  int open = 0, sticking = 0, sliding = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    // W = 1/m + the part of a random arm on a unit cube.
    const double x = draw(-0.5, 0.5), z = draw(-0.5, 0.5), mu = draw(0.0, 0.6);
    const Vec3 arm(x, -0.5, z);
    Mat3 cross;
    cross << 0, -arm[2], arm[1], arm[2], 0, -arm[0], -arm[1], arm[0], 0;
    Mat3 W = Mat3::Identity() - 6.0 * cross * cross;
    W.row(0).swap(W.row(1));  // n is the second axis
    W.col(0).swap(W.col(1));
    const double c0 = draw(-1.0, 0.3), c1 = draw(-1.0, 1.0), c2 = draw(-1.0, 1.0);
    const Vec3 c(c0, c1, c2);
    const Vec3 lambda = solveFrictionBlock(W, c, mu, Vec3::Zero());
    const Vec3 u = W * lambda + c;
    const double pull = lambda.tail<2>().norm(), slip = u.tail<2>().norm();
    CAPTURE(trial, mu, lambda.transpose(), u.transpose());
    REQUIRE(lambda[0] >= 0.0);
    REQUIRE(u[0] > -1e-10);
    REQUIRE(std::min(lambda[0], u[0]) < 1e-10);
    REQUIRE(pull <= mu * lambda[0] + 1e-10);
    REQUIRE(std::abs(lambda.tail<2>().dot(u.tail<2>()) + mu * lambda[0] * slip) < 1e-10);
    (lambda[0] == 0.0 ? open : slip < 1e-10 ? sticking : sliding) += 1;
  }
  CHECK(std::min({open, sticking, sliding}) > 200);
}

// Oracle: a factorisation from scratch. Measured 7e-14, allowed 1e-11.
TEST_CASE("a factor that gained and lost rows solves as one made anew") {
  Draw draw(3);
  const int n = 12;
  MatX G(n, n + 3);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n + 3; ++k) G(i, k) = draw(-1.0, 1.0);
  const MatX A = G * G.transpose();
  GrowingCholesky factor;
  factor.reset(n);
  std::vector<int> in;
  for (int change = 0; change < 400; ++change) {
    const int i = draw.below(n);
    const auto at = std::find(in.begin(), in.end(), i);
    if (at != in.end()) {
      factor.remove(static_cast<int>(at - in.begin()));
      in.erase(at);
    } else {
      VecX column(n);
      for (std::size_t k = 0; k < in.size(); ++k) column[k] = A(in[k], i);
      REQUIRE(factor.append(column, A(i, i), 1e-12) > 1e-12);
      in.push_back(i);
    }
    const MatX S = A(in, in);
    const VecX right = VecX::LinSpaced(in.size(), 1.0, 2.0);
    VecX x = VecX::Zero(n);
    x.head(in.size()) = right;
    factor.solveInPlace(x);
    if (!in.empty())
      REQUIRE((x.head(in.size()) - S.llt().solve(right)).lpNorm<Eigen::Infinity>() < 1e-11);
  }
}

TEST_CASE("a row that depends on the others is not appended") {
  GrowingCholesky factor;
  factor.reset(2);
  VecX column = VecX::Ones(2);
  CHECK(factor.append(column, 1.0, 1e-12) == 1.0);
  CHECK(factor.append(column, 1.0, 1e-12) == 0.0);
  CHECK(factor.size() == 1);
}

// Oracle: u = A λ + b is what rowVelocities finds for v = v* + M⁻¹ Jᵀ λ. Measured 2e-15, allowed
// 1e-12.
TEST_CASE("the matrix of the rows says what the bodies do") {
  Problem problem = tower({1.0, 2.0, 0.5}, 0.3);
  if (GENERATE(false, true)) std::reverse(problem.rows.begin(), problem.rows.end());
  const Delassus system = delassus(problem);
  Draw draw(4);
  VecX lambda(system.b.size());
  for (double& entry : lambda) entry = draw(-1.0, 1.0);
  std::vector<Vec6> v(problem.vStar.size());
  VecX u(lambda.size());
  velocitiesFromLambda(problem, {lambda.data(), problem.rows.size()}, v);
  rowVelocities(problem, v, {u.data(), problem.rows.size()});
  CHECK((system.A * lambda + system.b - u).lpNorm<Eigen::Infinity>() < 1e-12);
}

// Oracle: closed form. A cube of mass 2 that is held up too weakly by δ falls with δ/m, and so says
// the residual, relative to g; pushed too much, it rises with δ/m although pushed.
TEST_CASE("the residual is the velocity by which a contact is wrong, relative to the largest") {
  Problem problem;
  addCube(problem, 0.0, 1.0, Vec3::Zero());
  addCube(problem, 2.0, 1.0, Vec3(0.0, -kG, 0.0));
  addContact(problem, 1, 0, Vec3(0, -0.5, 0), Vec3(0, 0.5, 0), GENERATE(0.0, 0.5));
  for (double wrong : {0.0, 0.1, -0.1}) {
    Solution solution;
    solution.lambda.assign(problem.rows.size(), 0.0);
    solution.lambda[0] = 2.0 * kG + wrong;
    solution.v.resize(2);
    velocitiesFromLambda(problem, solution.lambda, solution.v);
    CHECK(naturalResidual(problem, solution) ==
          Approx(0.05 * std::abs(wrong) / 0.1 / kG).margin(1e-15));
  }
}

// Oracle: the definition of a projection: of the cone's points none is nearer, p − Π ⊥ Π.
TEST_CASE("the projection on a friction cone lands in it, and at right angles") {
  Draw draw(9);
  for (int trial = 0; trial < 1000; ++trial) {
    const double x = draw(-1.0, 1.0), y = draw(-1.0, 1.0), z = draw(-1.0, 1.0);
    const double mu = draw(0.05, 2.0);
    const Vec3 p(x, y, z), q = projectOnFrictionCone(p, mu);
    REQUIRE(q.tail<2>().norm() <= mu * q[0] + 1e-15);
    REQUIRE(std::abs((p - q).dot(q)) < 1e-15);
    REQUIRE((q - p).tail<2>().norm() <= (q - p)[0] / mu + 1e-14);  // in the polar cone
  }
}
