#include "sim/problem/node_matrix.h"

#include "sim/problem/cone.h"

namespace tumble {

[[gnu::flatten]] void NodeMatrix::times(std::span<const Vec3> x, std::span<Vec3> out) const {
  for (int i = 0; i < count(); ++i) {
    Vec3 sum = own[i].lazyProduct(x[i]);
    for (int k = begin[i]; k < begin[i + 1]; ++k)
      sum.noalias() += near[k].block.lazyProduct(x[near[k].node]);
    out[i] = sum;
  }
}

void Nodes::read(const Problem& problem) {
  nodeOf.assign(problem.invM.size(), -1);
  bodyOf.clear();
  A.own.clear();
  for (std::size_t i = 0; i < problem.invM.size(); ++i) {
    if (!(problem.invM[i] > 0.0)) continue;
    nodeOf[i] = static_cast<int>(bodyOf.size());
    bodyOf.push_back(static_cast<int>(i));
    A.own.push_back(Mat3(Vec3::Constant(1.0 / problem.invM[i]).asDiagonal()));
  }
  A.begin.assign(bodyOf.size() + 1, 0);
  for (const Coupling& c : problem.couplings) {
    if (c.a == c.b) {
      A.own[nodeOf[c.a]] += c.block;
      continue;
    }
    ++A.begin[nodeOf[c.a] + 1];
    ++A.begin[nodeOf[c.b] + 1];
  }
  for (int i = 0; i < A.count(); ++i) A.begin[i + 1] += A.begin[i];
  A.near.resize(A.begin.back());
  std::vector<int> next(A.begin.begin(), A.begin.end() - 1);
  for (const Coupling& c : problem.couplings) {
    if (c.a == c.b) continue;
    const int a = nodeOf[c.a], b = nodeOf[c.b];
    A.near[next[a]++] = {.node = b, .block = c.block};
    A.near[next[b]++] = {.node = a, .block = c.block.transpose()};
  }
}

void Nodes::write(const Problem& problem, std::span<const Vec3> v, Solution& solution) const {
  solution.v = problem.vStar;
  solution.pull.clear();
  for (std::size_t i = 0; i < v.size(); ++i) solution.v[bodyOf[i]].head<3>() = v[i];
}

NodeRows rowsOfNode(const Problem& problem, const Cone& cone, std::span<const int> nodeOf) {
  const Row& first = problem.rows[cone.row];
  const bool aMoves = nodeOf[first.a] >= 0;
  NodeRows rows{.node = nodeOf[aMoves ? first.a : first.b]};
  for (int k = 0; k < coneRows(cone.kind); ++k) {
    const Row& row = problem.rows[cone.row + k];
    const Vec6 still = Vec6::Zero();
    rows.J.row(k) = (aMoves ? 1.0 : -1.0) * row.linear.transpose();
    rows.bias[k] = row.bias + (aMoves ? rowSpeed(row, still, problem.vStar[row.b])
                                      : rowSpeed(row, problem.vStar[row.a], still));
  }
  return rows;
}

}  // namespace tumble
