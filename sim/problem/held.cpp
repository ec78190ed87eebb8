#include "sim/problem/held.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

namespace tumble {
namespace {

using Vectors = std::vector<Vec3>;

Vectors times(const HeldProblem& problem, const Vectors& x) {
  Vectors out(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) out[i] = problem.own[i] * x[i];
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const auto [i, j] = problem.edges[e];
    out[i] += problem.off[e] * x[j];
    out[j] += problem.off[e].transpose() * x[i];
  }
  return out;
}

double dot(const Vectors& a, const Vectors& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

Vectors residualOf(const HeldProblem& problem, const Vectors& x) {
  Vectors r = times(problem, x);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = problem.b[i] - r[i];
  return r;
}

/// Per point the projection on its free directions, I − Σ n nᵀ.
std::vector<Mat3> filtersOf(const HeldProblem& problem) {
  std::vector<Mat3> filters(problem.b.size(), Mat3::Identity());
  for (const Hold& hold : problem.holds) filters[hold.point] -= hold.n * hold.n.transpose();
  return filters;
}

void filter(const std::vector<Mat3>& filters, Vectors& x) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = filters[i] * x[i];
}

/// The motion that holds ask for, and no other.
Vectors askedOf(const HeldProblem& problem) {
  Vectors asked(problem.b.size(), Vec3::Zero());
  for (const Hold& hold : problem.holds) asked[hold.point] += hold.value * hold.n;
  return asked;
}

/// What the answer leaves: along holds their forces, else the residual.
void judge(const HeldProblem& problem, HeldAnswer& answer) {
  Vectors left = residualOf(problem, answer.dv);
  for (const Hold& hold : problem.holds) answer.pull.push_back(-hold.n.dot(left[hold.point]));
  filter(filtersOf(problem), left);
  double scale = 0.0;
  for (const Vec3& b : problem.b) scale = std::max(scale, b.lpNorm<Eigen::Infinity>());
  for (const Vec3& r : left)
    answer.residual = std::max(answer.residual, r.lpNorm<Eigen::Infinity>() / scale);
}

BlockStructure structureOf(const HeldProblem& problem) {
  return {static_cast<int>(problem.b.size()), problem.edges};
}

/// The factor of blocks that stand where those of A do.
template <class Own, class Off>
void factor(const HeldProblem& problem, const BlockStructure& structure, const Own& own,
            const Off& off, BlockCholesky<3>& factor) {
  factor.begin(structure);
  for (std::size_t i = 0; i < problem.own.size(); ++i)
    factor.diagonal(static_cast<int>(i)) = own(i);
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const Mat3 block = off(e);
    const bool firstIsRow = factor.edgeRow(static_cast<int>(e)) == problem.edges[e].first;
    factor.lower(static_cast<int>(e)) = firstIsRow ? block : Mat3(block.transpose());
  }
  factor.factor();
}

constexpr int kMostIterations = 10'000;

}  // namespace

HeldAnswer solveFiltered(const HeldProblem& problem, double tolerance) {
  const std::vector<Mat3> filters = filtersOf(problem);
  HeldAnswer answer{.dv = askedOf(problem)};
  const auto prepared = [&](Vectors x) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = problem.own[i].llt().solve(x[i]);
    filter(filters, x);
    return x;
  };
  Vectors r = residualOf(problem, answer.dv);
  filter(filters, r);
  Vectors y = prepared(r), direction = y;
  double now = dot(r, y);
  const double enough = tolerance * tolerance * now;
  for (; now > enough && answer.count < kMostIterations; ++answer.count) {
    Vectors moved = times(problem, direction);
    filter(filters, moved);
    const double alpha = now / dot(direction, moved);
    for (std::size_t i = 0; i < r.size(); ++i) {
      answer.dv[i] += alpha * direction[i];
      r[i] -= alpha * moved[i];
    }
    y = prepared(r);
    const double before = std::exchange(now, dot(r, y));
    for (std::size_t i = 0; i < r.size(); ++i) direction[i] = y[i] + now / before * direction[i];
  }
  judge(problem, answer);
  return answer;
}

HeldAnswer solveMultipliers(const HeldProblem& problem, double /*tolerance*/) {
  const BlockStructure structure = structureOf(problem);
  BlockCholesky<3> A;
  factor(
      problem, structure, [&](std::size_t i) { return problem.own[i]; },
      [&](std::size_t e) { return problem.off[e]; }, A);
  HeldAnswer answer{.dv = problem.b, .count = 1};
  A.solve(answer.dv);
  const std::size_t m = problem.holds.size();
  std::vector<Vectors> columns(m, Vectors(problem.b.size(), Vec3::Zero()));
  Eigen::MatrixXd W(m, m);
  Eigen::VectorXd c(m);
  for (std::size_t k = 0; k < m; ++k) {
    columns[k][problem.holds[k].point] = problem.holds[k].n;
    A.solve(columns[k]);
    for (std::size_t l = 0; l < m; ++l)
      W(l, k) = problem.holds[l].n.dot(columns[k][problem.holds[l].point]);
    c[k] = problem.holds[k].value - problem.holds[k].n.dot(answer.dv[problem.holds[k].point]);
  }
  const Eigen::VectorXd lambda = W.llt().solve(c);
  for (std::size_t k = 0; k < m; ++k)
    for (std::size_t i = 0; i < answer.dv.size(); ++i) answer.dv[i] += lambda[k] * columns[k][i];
  judge(problem, answer);
  return answer;
}

HeldAnswer solveReduced(const HeldProblem& problem, double /*tolerance*/) {
  const std::vector<Mat3> filters = filtersOf(problem);
  const BlockStructure structure = structureOf(problem);
  BlockCholesky<3> A;
  factor(
      problem, structure,
      [&](std::size_t i) {
        const Mat3 held = Mat3::Identity() - filters[i];
        return Mat3(filters[i] * problem.own[i] * filters[i] + problem.own[i].trace() * held);
      },
      [&](std::size_t e) {
        const auto [i, j] = problem.edges[e];
        return Mat3(filters[i] * problem.off[e] * filters[j]);
      },
      A);
  HeldAnswer answer{.dv = askedOf(problem), .count = 1};
  Vectors y = residualOf(problem, answer.dv);
  filter(filters, y);
  A.solve(y);
  filter(filters, y);
  for (std::size_t i = 0; i < y.size(); ++i) answer.dv[i] += y[i];
  judge(problem, answer);
  return answer;
}

std::span<const HeldSolver> heldSolvers() {
  static const HeldSolver kSolvers[] = {
      {"filter", "conjugate gradients on the free directions", solveFiltered},
      {"multipliers", "forces along the holds as unknowns", solveMultipliers},
      {"reduced", "free directions as unknowns", solveReduced},
  };
  return kSolvers;
}

}  // namespace tumble
