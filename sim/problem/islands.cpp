#include <numeric>
#include <utility>

#include "sim/problem/cone.h"
#include "sim/problem/problem.h"

namespace tumble {
namespace {

bool movable(const Problem& problem, int body) {
  return problem.invM[body] > 0.0 || !problem.Iinv[body].isZero(0.0);
}

/// The cones of a problem, dealt out to its islands.
struct Deal {
  std::vector<int> root;      ///< forest of bodies
  std::vector<int> islandOf;  ///< per root; −1: none of its own
  std::vector<int> number;    ///< per cone: its island
  std::vector<int> cones;     ///< island by island
  std::vector<int> begin;     ///< per island, and at the end: where its cones begin

  int count() const { return static_cast<int>(begin.size()) - 1; }
  std::span<const int> island(int i) const {
    return std::span(cones).subspan(begin[i], begin[i + 1] - begin[i]);
  }
};

/// Joins what a row or a coupling joins.
void joinBodies(const Problem& problem, std::vector<int>& root) {
  root.resize(problem.invM.size());
  std::iota(root.begin(), root.end(), 0);
  for (const Row& row : problem.rows) {
    if (!movable(problem, row.a) || !movable(problem, row.b)) continue;
    const int a = islandRoot(root, row.a), b = islandRoot(root, row.b);
    root[std::max(a, b)] = std::min(a, b);
  }
  for (const Coupling& coupling : problem.couplings) {
    const int a = islandRoot(root, coupling.a), b = islandRoot(root, coupling.b);
    root[std::max(a, b)] = std::min(a, b);
  }
}

/// Deals the cones out in order. A cone between immovable bodies stands alone.
void dealOut(const Problem& problem, Deal& deal) {
  joinBodies(problem, deal.root);
  deal.islandOf.assign(problem.invM.size(), -1);
  deal.number.resize(problem.cones.size());
  deal.begin.assign(1, 0);
  for (std::size_t c = 0; c < problem.cones.size(); ++c) {
    const Row& row = problem.rows[problem.cones[c].row];
    const bool moves = movable(problem, row.a) || movable(problem, row.b);
    const int root = islandRoot(deal.root, movable(problem, row.a) ? row.a : row.b);
    int alone = -1;
    int& island = moves ? deal.islandOf[root] : alone;
    if (island < 0) {
      island = deal.count();
      deal.begin.push_back(0);
    }
    deal.number[c] = island;
    ++deal.begin[island + 1];
  }
  std::partial_sum(deal.begin.begin(), deal.begin.end(), deal.begin.begin());
  // Place: `islandOf` says for a moment where the next cone of an island goes.
  deal.islandOf.assign(deal.begin.begin(), deal.begin.end());
  deal.cones.resize(problem.cones.size());
  for (std::size_t c = 0; c < problem.cones.size(); ++c)
    deal.cones[deal.islandOf[deal.number[c]]++] = static_cast<int>(c);
}

/// A part of a problem that stands alone, and where its bodies come from.
struct Island {
  Problem problem;
  Solution solution;
  std::vector<int> bodies;  ///< in the whole, per body of the part

  void clear() {
    problem.invM.clear();
    problem.Iinv.clear();
    problem.vStar.clear();
    problem.rows.clear();
    problem.cones.clear();
    solution.lambda.clear();
    solution.v.clear();
    solution.pull.clear();
    bodies.clear();
  }
};

/// Copies cones, rows and bodies of one island. `local` is −1 for every body, before and after.
void gather(const Problem& whole, std::span<const int> cones, const Solution& start,
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
  island.clear();
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

void scatter(const Problem& whole, std::span<const int> cones, const Island& island,
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

/// Whether a copy of one island would be the problem again but for bodies that do not move: all
/// rows in the order of their cones, all movable bodies in the order of their first rows.
bool isInOrder(const Problem& problem) {
  int rows = 0, next = 0;
  for (const Cone& cone : problem.cones) {
    if (cone.row != rows) return false;
    rows += coneRows(cone.kind);
  }
  const int count = static_cast<int>(problem.invM.size());
  const auto skipFixed = [&] {
    while (next < count && !movable(problem, next)) ++next;
  };
  skipFixed();
  for (const Row& row : problem.rows)
    for (const int body : {row.a, row.b}) {
      if (body < next || !movable(problem, body)) continue;
      if (body > next) return false;
      ++next;
      skipFixed();
    }
  return next == count && rows == static_cast<int>(problem.rows.size());
}

void takeWorse(const SolveReport& report, SolveReport& worst) {
  worst.status = std::max(worst.status, report.status);
  worst.residual = std::max(worst.residual, report.residual);
  worst.balance = std::max(worst.balance, report.balance);
  worst.iterations = std::max(worst.iterations, report.iterations);
}

/// Solves a problem that is one island, or has couplings, as it stands.
SolveReport solveWhole(const Solver& solver, const Problem& problem, const SolveSettings& settings,
                       Solution& solution) {
  if (solution.lambda.size() != problem.rows.size()) solution.lambda.clear();
  if (solution.v.size() != problem.vStar.size()) solution.v.clear();
  SolveReport worst;
  takeWorse(solver.solve(problem, settings, solution), worst);
  for (std::size_t i = 0; i < problem.vStar.size(); ++i)
    if (!movable(problem, static_cast<int>(i))) solution.v[i] = problem.vStar[i];
  return worst;
}

/// What solveByIslands works with; kept for the sake of its storage.
struct IslandWork {
  Deal deal;
  std::vector<int> local;
  Solution start;
  Island island;
};

SolveReport solveParts(const Solver& solver, const Problem& problem, const SolveSettings& settings,
                       IslandWork& work, Solution& solution) {
  std::swap(work.start, solution);
  solution.lambda.assign(problem.rows.size(), 0.0);
  solution.v = problem.vStar;
  solution.pull.clear();
  work.local.assign(problem.invM.size(), -1);
  SolveReport worst;
  for (int i = 0; i < work.deal.count(); ++i) {
    gather(problem, work.deal.island(i), work.start, work.local, work.island);
    takeWorse(solver.solve(work.island.problem, settings, work.island.solution), worst);
    scatter(problem, work.deal.island(i), work.island, solution);
  }
  return worst;
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
  Deal deal;
  dealOut(problem, deal);
  std::vector<std::vector<int>> result;
  for (int i = 0; i < deal.count(); ++i)
    result.emplace_back(deal.island(i).begin(), deal.island(i).end());
  return result;
}

SolveReport solveByIslands(const Solver& solver, const Problem& problem,
                           const SolveSettings& settings, Solution& solution) {
  if (!problem.couplings.empty()) return solveWhole(solver, problem, settings, solution);
  thread_local IslandWork kept;
  IslandWork work = std::move(kept);  // a solver may call this in turn
  dealOut(problem, work.deal);
  const bool whole = work.deal.count() == 1 && isInOrder(problem);
  const SolveReport report = whole ? solveWhole(solver, problem, settings, solution)
                                   : solveParts(solver, problem, settings, work, solution);
  kept = std::move(work);
  return report;
}

}  // namespace tumble
