// One pass of an impact law: Newton's law at some contacts at once, as a linear complementarity
// problem.
#include "sim/contact/impact_pass.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "sim/body/force.h"
#include "sim/contact/rows.h"
#include "sim/problem/cone.h"
#include "sim/problem/delassus.h"
#include "sim/problem/solvers.h"

namespace tumble {
namespace {

constexpr int kSweeps = 500;
constexpr std::size_t kDense = 150;  // rows that pivoting, of third order, is for

/// The contacts that take part, and their rows.
struct Strike {
  Problem problem;
  std::vector<int> contacts;
  std::vector<int> number;  ///< per body, in the problem; < 0: not in it. Empty: as in the world
};

/// Bonds may join any bodies; contacts bring theirs with them.
void begin(const Impact& impact, Strike& strike) {
  if (impact.bound())
    beginVelocityProblem(impact.bodies, strike.problem);
  else
    strike.number.assign(impact.bodies.size(), -1);
}

int numberOf(const Impact& impact, int i, Strike& strike) {
  if (strike.number.empty()) return i;
  if (strike.number[i] < 0)
    strike.number[i] = addToVelocityProblem(impact.bodies[i], strike.problem);
  return strike.number[i];
}

void addRow(const Impact& impact, const Contact& c, const Vec3& d, double bias, Strike& strike) {
  Row& row =
      strike.problem.rows.emplace_back(pointRow(impact.bodies, c.a, c.b, c.point.p, d, bias));
  row.a = numberOf(impact, c.a, strike);
  row.b = numberOf(impact, c.b, strike);
}

void addContact(const Impact& impact, int i, double bias, bool withFriction, Strike& strike) {
  const Contact& c = impact.contacts[i];
  const RigidBody &a = impact.bodies[c.a], &b = impact.bodies[c.b];
  Problem& problem = strike.problem;
  strike.contacts.push_back(i);
  const bool cone = withFriction && c.friction > 0.0;
  problem.cones.push_back({.kind = cone ? ConeKind::Friction : ConeKind::Push,
                           .row = static_cast<int>(problem.rows.size()),
                           .mu = cone ? c.friction : 0.0});
  addRow(impact, c, c.point.n, bias, strike);
  if (!cone) return;
  Vec3 t1, t2;
  tangents(c.point.n, slipVelocity(a, b, c.point), t1, t2);
  for (const Vec3& t : {t1, t2}) addRow(impact, c, t, 0.0, strike);
}

/// Gives the impulses of all bonds as one, after which their λ hold the sum of all passes.
ImpulseEnergy giveBonds(const Impact& impact, const Solution& solution, std::size_t firstBond) {
  Bonds now = *impact.bonds;
  readBonds(solution.lambda, firstBond, now);
  const double before = kineticEnergy(impact.bodies);
  addBondImpulses(now, impact.bodies);
  const double work = outerBonds(now, impact.bodies).power;
  for (std::size_t i = 0; i < now.rows.size(); ++i) impact.bonds->lambda[i] += now.lambda[i];
  return {.lost = before - kineticEnergy(impact.bodies) + work, .work = work};
}

/// Gives the impulses of one contact of a solved pass, first along its normal, then across.
/// @return that along the normal
double giveOne(const Impact& impact, const Strike& strike, int k, const Solution& solution,
               ImpactReport& report) {
  const Cone& cone = strike.problem.cones[k];
  const double j = solution.lambda[cone.row];
  const ImpulseEnergy normal =
      applyContactImpulse(impact, strike.contacts[k], j * strike.problem.rows[cone.row].linear);
  report.lostNormal += normal.lost;
  report.work += normal.work;
  if (cone.kind != ConeKind::Friction) return j;
  const Vec3 across = solution.lambda[cone.row + 1] * strike.problem.rows[cone.row + 1].linear +
                      solution.lambda[cone.row + 2] * strike.problem.rows[cone.row + 2].linear;
  const ImpulseEnergy friction = applyContactImpulse(impact, strike.contacts[k], across);
  report.lostFriction += friction.lost;
  report.work += friction.work;
  return j;
}

/// Gives the impulses of a solved pass.
std::vector<double> give(const Impact& impact, const Strike& strike, const Solution& solution,
                         ImpactReport& report) {
  std::vector<double> j;
  for (std::size_t k = 0; k < strike.contacts.size(); ++k)
    j.push_back(giveOne(impact, strike, static_cast<int>(k), solution, report));
  return j;
}

/// Sets the impulses of islands that would gain energy to the part of them that takes most.
void keepFromGaining(const Problem& problem, std::span<const int> island, Solution& solution) {
  std::vector<double> first(problem.rows.size()), last(problem.rows.size());
  rowVelocities(problem, problem.vStar, first);
  rowVelocities(problem, solution.v, last);
  const int count = *std::max_element(island.begin(), island.end()) + 1;
  std::vector<double> slope(count, 0.0), curvature(count, 0.0);
  const auto forRows = [&](const auto& visit) {
    for (std::size_t c = 0; c < problem.cones.size(); ++c) {
      const int of = c < island.size() ? island[c] : 0;
      for (int k = 0; k < coneRows(problem.cones[c].kind); ++k) visit(of, problem.cones[c].row + k);
    }
  };
  forRows([&](int of, int row) {
    slope[of] += solution.lambda[row] * first[row];
    curvature[of] += solution.lambda[row] * (last[row] - first[row]);
  });
  forRows([&](int of, int row) {
    if (slope[of] + 0.5 * curvature[of] <= 0.0) return;
    solution.lambda[row] *= std::clamp(-slope[of] / curvature[of], 0.0, 1.0);
  });
}

/// Whether no other impulses push as well as these: the rows that push or stay closed are
/// independent.
bool areOnly(const Problem& problem, const Solution& solution) {
  constexpr double kClosed = 1e-9;   // of the scale: a row that parts no faster may push
  constexpr double kFollows = 1e-9;  // pivot of a row that follows from others
  const double closed = kClosed * velocityScale(problem);
  std::vector<int> pushing;
  for (std::size_t r = 0; r < problem.rows.size(); ++r) {
    const Row& row = problem.rows[r];
    const double parts = rowSpeed(row, solution.v[row.a], solution.v[row.b]) + row.bias;
    if (solution.lambda[r] > 0.0 || parts <= closed) pushing.push_back(static_cast<int>(r));
  }
  if (pushing.empty()) return true;
  MatX A = delassus(problem).A(pushing, pushing);
  const VecX weight = A.diagonal().cwiseSqrt().cwiseInverse();
  A = weight.asDiagonal() * A * weight.asDiagonal();
  const Eigen::LDLT<MatX> factor(A);
  return factor.vectorD().minCoeff() > kFollows;
}

/// Normal impulses by pivoting; where they are one answer of many, as where a face strikes, by
/// `newton`, which chooses among them whatever their order: with friction what moves on depends on
/// them.
SolveReport solveFaces(const Problem& problem, const SolveSettings& settings, Solution& solution) {
  const SolveReport pivoted = solvePivoting(problem, settings, solution);
  if (pivoted.status == SolveStatus::Solved && areOnly(problem, solution)) return pivoted;
  Solution chosen;
  const SolveReport report = solveNewton(problem, settings, chosen);
  if (report.status != SolveStatus::Solved && report.residual >= pivoted.residual) return pivoted;
  solution = std::move(chosen);
  return report;
}

/// The solver of a pass, and the one that tries where it fails.
std::array<Solver, 2> solversOf(const Impact& impact, const Strike& strike) {
  const Solver &pgs = *findSolver("pgs"), &newton = *findSolver("newton"),
               &pivoting = *findSolver("pivoting");
  const Solver faces{"faces", "", solveFaces};
  const bool small = strike.problem.rows.size() <= kDense;
  const bool cones = strike.problem.rows.size() > strike.problem.cones.size();
  if (cones && !impact.bound())
    return strike.contacts.size() == 1 ? std::array{pgs, newton} : std::array{newton, pgs};
  if (!small) return {newton, pgs};
  const bool rubs = std::any_of(strike.contacts.begin(), strike.contacts.end(),
                                [&](int i) { return impact.contacts[i].friction > 0.0; });
  return {rubs && !impact.bound() ? faces : pivoting, newton};
}

/// Solves for the impulses of a pass; those of bonds are given at once.
SolveReport solvePass(const Impact& impact, Strike& strike, Solution& solution,
                      ImpactReport& report) {
  const std::size_t firstBond = strike.problem.rows.size();
  if (impact.bound()) appendBonds(*impact.bonds, strike.problem);
  const auto [first, second] = solversOf(impact, strike);
  const SolveSettings settings{.maxIterations = kSweeps};
  SolveReport solved = solveByIslands(first, strike.problem, settings, solution);
  if (solved.status != SolveStatus::Solved) {
    Solution other;
    const SolveReport again = solveByIslands(second, strike.problem, settings, other);
    if (again.residual < solved.residual) {
      solved = again;
      solution = std::move(other);
    }
  }
  report.residual = std::max(report.residual, solved.residual);
  report.rows += (1 + solved.iterations) * static_cast<long>(strike.problem.rows.size());
  if (impact.bound()) {
    const ImpulseEnergy energy = giveBonds(impact, solution, firstBond);
    report.lostNormal += energy.lost;
    report.work += energy.work;
  }
  return solved;
}

/// Friction bounded by the normal impulses j of the contacts, held to the bonds.
void rub(const Impact& impact, std::span<const int> contacts, std::span<const double> j,
         ImpactReport& report) {
  const ImpulseEnergy energy = frictionImpulses(impact, contacts, j);
  report.lostFriction += energy.lost;
  report.work += energy.work;
  report.rows += energy.rows;
  tighten(impact, true, report);
}

/// Whether a contact takes part, by how it moves now.
bool takesPart(PassKind kind, ContactClass now, double restitution) {
  switch (kind) {
    case PassKind::Touching:
      return now != ContactClass::Separating;
    case PassKind::Approaching:
      return now == ContactClass::Colliding || (now == ContactClass::Resting && restitution == 0.0);
    case PassKind::Inelastic:
      return true;
  }
  return true;
}

}  // namespace

void strikeOnce(const Impact& impact, PassKind kind, ImpactReport& report) {
  Strike pass;
  begin(impact, pass);
  const std::vector<int> reached = reachOfImpact(impact);
  const auto vrel = [&](int i) {
    const Contact& c = impact.contacts[i];
    return approachVelocity(impact.bodies[c.a], impact.bodies[c.b], c.point);
  };
  const bool inelastic = kind == PassKind::Inelastic;
  // Beside a hit, what leans rests, whatever rounding left of its speed.
  const auto leans = [&](int i) {
    return impact.contacts[i].lasting && std::abs(vrel(i)) <= impact.tolerance.keep;
  };
  const bool hit = std::any_of(reached.begin(), reached.end(), [&](int i) {
    return vrel(i) < -impact.tolerance.rest && !leans(i);
  });
  const auto classNow = [&](int i) {
    return hit && leans(i) ? ContactClass::Resting : classify(vrel(i), impact.tolerance.rest);
  };
  const bool together =
      inelastic || std::none_of(reached.begin(), reached.end(), [&](int i) {
        return impact.restitution[i] > 0.0 && classNow(i) == ContactClass::Colliding;
      });
  for (int i : reached) {
    const ContactClass now = classNow(i);
    if (!takesPart(kind, now, impact.restitution[i])) continue;
    const bool bounces = now == ContactClass::Colliding && !inelastic;
    addContact(impact, i, bounces ? impact.restitution[i] * vrel(i) : 0.0, together, pass);
  }

  Solution solution;
  solvePass(impact, pass, solution, report);
  const std::vector<double> j = give(impact, pass, solution, report);
  if (!together) rub(impact, pass.contacts, j, report);
}

void strikeOne(const Impact& impact, int contact, ImpactReport& report) {
  Strike pass;
  begin(impact, pass);
  const Contact& c = impact.contacts[contact];
  const double vrel = approachVelocity(impact.bodies[c.a], impact.bodies[c.b], c.point);
  addContact(impact, contact, impact.restitution[contact] * vrel, false, pass);
  Solution solution;
  solvePass(impact, pass, solution, report);
  const std::vector<double> j = give(impact, pass, solution, report);
  rub(impact, pass.contacts, j, report);
}

std::vector<Compressed> compress(const Impact& impact, std::span<const int> contacts,
                                 std::span<const double> e, std::span<const int> island,
                                 ImpactReport& report) {
  constexpr int kRough = 60;         // sweeps, where restitution takes energy and a contact
  constexpr double kRoughly = 1e-3;  // problem follows, and the residual that is enough then
  Strike pass;
  begin(impact, pass);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    addContact(impact, contacts[k], 0.0, true, pass);
    pass.problem.cones.back().mu *= 1.0 + e[k];
  }
  Solution solution;
  std::vector<Compressed> taken(contacts.size() + 1);
  const ImpactReport before = report;
  const double most = *std::max_element(e.begin(), e.end());
  const bool keepsAll = 1.0 - most * most < kRoughly;
  if (impact.goesOn && !impact.bound() && !keepsAll) {
    const SolveSettings roughly{.tolerance = kRoughly, .maxIterations = kRough};
    solveByIslands(*findSolver("pgs"), pass.problem, roughly, solution);
    keepFromGaining(pass.problem, island, solution);
  } else {
    solvePass(impact, pass, solution, report);
  }
  taken.back().lost = report.lostNormal - before.lostNormal;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double sum = report.lostNormal + report.lostFriction;
    taken[k].j = giveOne(impact, pass, static_cast<int>(k), solution, report);
    taken[k].lost = report.lostNormal + report.lostFriction - sum;
  }
  return taken;
}

void tighten(const Impact& impact, bool afterFriction, ImpactReport& report) {
  if (!impact.bound()) return;
  Problem problem;
  beginVelocityProblem(impact.bodies, problem);
  appendBonds(*impact.bonds, problem);
  Solution solution;
  const SolveReport solved = solveByIslands(*findSolver("pivoting"), problem, {}, solution);
  report.residual = std::max(report.residual, solved.residual);
  const ImpulseEnergy energy = giveBonds(impact, solution, 0);
  (afterFriction ? report.lostFriction : report.lostNormal) += energy.lost;
  report.work += energy.work;
}

bool anyApproaching(const Impact& impact) {
  for (std::size_t i = 0; impact.bound() && i < impact.bonds->rows.size(); ++i)
    if (impact.bonds->kinds[i] == ConeKind::Push &&
        bondVelocity(impact.bonds->rows[i], impact.bodies) < -impact.tolerance.rest)
      return true;
  return std::any_of(impact.contacts.begin(), impact.contacts.end(), [&](const Contact& c) {
    return approachVelocity(impact.bodies[c.a], impact.bodies[c.b], c.point) <
           -impact.tolerance.rest;
  });
}

std::vector<int> islandsOfContacts(const Impact& impact, std::span<const int> contacts) {
  std::vector<int> island(contacts.size(), 0);
  if (impact.bound()) return island;
  std::vector<int> root(impact.bodies.size()), number(impact.bodies.size(), -1);
  std::iota(root.begin(), root.end(), 0);
  for (const int i : contacts) {
    const Contact& c = impact.contacts[i];
    if (impact.bodies[c.a].fixed() || impact.bodies[c.b].fixed()) continue;
    const int p = islandRoot(root, c.a), q = islandRoot(root, c.b);
    root[std::max(p, q)] = std::min(p, q);
  }
  int count = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = impact.contacts[contacts[k]];
    int& own = number[islandRoot(root, impact.bodies[c.a].fixed() ? c.b : c.a)];
    if (own < 0) own = count++;
    island[k] = own;
  }
  return island;
}

void add(const ImpactReport& part, ImpactReport& sum) {
  sum.lostNormal += part.lostNormal;
  sum.lostFriction += part.lostFriction;
  sum.work += part.work;
  sum.cut += part.cut;
  sum.rows += part.rows;
  sum.residual = std::max(sum.residual, part.residual);
  sum.finishedInelastic = sum.finishedInelastic || part.finishedInelastic;
}

}  // namespace tumble
