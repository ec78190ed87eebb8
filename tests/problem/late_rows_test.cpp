// Factors of matrices that differ in some rows alone, which are eliminated last.
#include <Eigen/Cholesky>

#include "sim/problem/block_cholesky.h"
#include "tests/catch.h"
#include "tests/problem/problems.h"

using namespace tumble;
using namespace tumble::test;

namespace {

constexpr int kSide = 7, kRows = kSide * kSide;

std::vector<BlockEdge> gridEdges() {
  std::vector<BlockEdge> edges;
  for (int i = 0; i < kRows; ++i) {
    if (i % kSide + 1 < kSide) edges.emplace_back(i, i + 1);
    if (i + kSide < kRows) edges.emplace_back(i, i + kSide);
  }
  return edges;
}

Mat3 drawBlock(Draw& draw) {
  return Mat3::NullaryExpr([&] { return draw(-1.0, 1.0); });
}

}  // namespace

// Oracle: a dense factor. Measured 1e-15 of the largest number, allowed 1e-12.
TEST_CASE("rows that come late are factored anew, and all others once") {
  Draw draw(11);
  const std::vector<BlockEdge> edges = gridEdges();
  std::vector<char> late(kRows, 0);
  for (int i = 0; i < kRows; ++i) late[i] = i % 5 == 0 || (i > 20 && i < 24);
  const BlockStructure structure(kRows, edges, late);
  CHECK(structure.isFor(kRows, edges, late));
  CHECK_FALSE(structure.isFor(kRows, edges));
  BlockCholesky<3> factor;
  factor.begin(structure);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * kRows, 3 * kRows);
  for (int i = 0; i < kRows; ++i) {
    factor.diagonal(i) = 20.0 * Mat3::Identity();
    A.block<3, 3>(3 * i, 3 * i) = factor.diagonal(i);
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [i, j] = edges[e];
    const Mat3 block = drawBlock(draw);
    const int number = static_cast<int>(e);
    factor.lower(number) = factor.edgeRow(number) == i ? block : Mat3(block.transpose());
    A.block<3, 3>(3 * i, 3 * j) = block;
    A.block<3, 3>(3 * j, 3 * i) = block.transpose();
  }
  factor.eliminateEarly();
  for (int trial = 0; trial < 3; ++trial) {
    Eigen::MatrixXd H = A;
    if (trial > 0) factor.backToLate();
    for (int i = 0; i < kRows; ++i) {
      if (!late[i]) continue;
      const Mat3 root = drawBlock(draw), push = 100.0 * root * root.transpose();
      factor.diagonal(i) += push;
      H.block<3, 3>(3 * i, 3 * i) += push;
    }
    REQUIRE(factor.factor());
    std::vector<Vec3> x(kRows);
    for (Vec3& part : x) part = drawBlock(draw).col(0);
    const Eigen::VectorXd b = Eigen::VectorXd::Map(x[0].data(), 3 * kRows);
    factor.solve(x);
    const Eigen::VectorXd exact = H.llt().solve(b);
    CHECK((Eigen::VectorXd::Map(x[0].data(), 3 * kRows) - exact).lpNorm<Eigen::Infinity>() <=
          1e-12 * exact.lpNorm<Eigen::Infinity>());
  }
}
