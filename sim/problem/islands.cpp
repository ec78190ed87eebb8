#include <numeric>

#include "sim/problem/cone.h"
#include "sim/problem/problem.h"

namespace tumble {
namespace {

bool movable(const Problem& problem, int body) {
  return problem.invM[body] > 0.0 || !problem.Iinv[body].isZero(0.0);
}

/// A part of a problem that stands alone, and where its bodies come from.
struct Island {
  Problem problem;
  Solution solution;
  std::vector<int> bodies;  ///< in the whole, per body of the part
};

/// Copies cones, rows and bodies of one island. `local` is −1 for every body, before and after.
void gather(const Problem& whole, const std::vector<int>& cones, const Solution& start,
            std::vector<int>& local, Island& island) {
  const bool known = start.v.size() == whole.vStar.size();
  const auto bodyOf = [&](int body) {
    if (local[body] < 0) {
      local[body] = static_cast<int>(island.bodies.size());
      island.bodies.push_back(body);
      island.problem.invM.push_back(whole.invM[body]);
      island.problem.Iinv.push_back(whole.Iinv[body]);
      island.problem.vStar.push_back(whole.vStar[body]);
      if (known) island.solution.v.push_back(start.v[body]);
    }
    return local[body];
  };
  island = {};
  const bool warm = start.lambda.size() == whole.rows.size();
  for (int c : cones) {
    Cone cone = whole.cones[c];
    const int first = cone.row;
    cone.row = static_cast<int>(island.problem.rows.size());
    island.problem.cones.push_back(cone);
    for (int k = 0; k < coneRows(cone.kind); ++k) {
      Row row = whole.rows[first + k];
      row.a = bodyOf(row.a);
      row.b = bodyOf(row.b);
      island.problem.rows.push_back(row);
      if (warm) island.solution.lambda.push_back(start.lambda[first + k]);
    }
  }
  for (int body : island.bodies) local[body] = -1;
}

void scatter(const Problem& whole, const std::vector<int>& cones, const Island& island,
             Solution& solution) {
  for (std::size_t c = 0; c < cones.size(); ++c) {
    const Cone& from = island.problem.cones[c];
    const int to = whole.cones[cones[c]].row;
    for (int k = 0; k < coneRows(from.kind); ++k)
      solution.lambda[to + k] = island.solution.lambda[from.row + k];
  }
  for (std::size_t i = 0; i < island.bodies.size(); ++i)
    if (movable(whole, island.bodies[i])) solution.v[island.bodies[i]] = island.solution.v[i];
}

}  // namespace

int islandRoot(std::vector<int>& parent, int body) {
  while (parent[body] != body) {
    parent[body] = parent[parent[body]];
    body = parent[body];
  }
  return body;
}

std::vector<std::vector<int>> islands(const Problem& problem) {
  // Join what a row joins.
  std::vector<int> parent(problem.invM.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const Row& row : problem.rows) {
    if (!movable(problem, row.a) || !movable(problem, row.b)) continue;
    const int a = islandRoot(parent, row.a), b = islandRoot(parent, row.b);
    parent[std::max(a, b)] = std::min(a, b);
  }

  // Deal the cones out in order. A cone between immovable bodies stands alone.
  std::vector<std::vector<int>> result;
  std::vector<int> islandOf(problem.invM.size(), -1);
  for (std::size_t c = 0; c < problem.cones.size(); ++c) {
    const Row& row = problem.rows[problem.cones[c].row];
    const bool moves = movable(problem, row.a) || movable(problem, row.b);
    const int root = islandRoot(parent, movable(problem, row.a) ? row.a : row.b);
    if (!moves || islandOf[root] < 0) {
      if (moves) islandOf[root] = static_cast<int>(result.size());
      result.push_back({static_cast<int>(c)});
    } else {
      result[islandOf[root]].push_back(static_cast<int>(c));
    }
  }
  return result;
}

SolveReport solveByIslands(const Solver& solver, const Problem& problem,
                           const SolveSettings& settings, Solution& solution) {
  Solution start;
  std::swap(start, solution);
  solution.lambda.assign(problem.rows.size(), 0.0);
  solution.v = problem.vStar;

  SolveReport worst;
  Island island;
  std::vector<int> local(problem.invM.size(), -1);
  for (const std::vector<int>& cones : islands(problem)) {
    gather(problem, cones, start, local, island);
    const SolveReport report = solver.solve(island.problem, settings, island.solution);
    scatter(problem, cones, island, solution);
    worst.status = std::max(worst.status, report.status);
    worst.residual = std::max(worst.residual, report.residual);
    worst.balance = std::max(worst.balance, report.balance);
    worst.iterations = std::max(worst.iterations, report.iterations);
  }
  return worst;
}

}  // namespace tumble
