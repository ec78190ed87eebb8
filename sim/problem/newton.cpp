// Chapter 6, problem: the stages of the proximal augmented Lagrangian; one class and long, for they
// hand one state to each other.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/problem/direct.h"
#include "sim/problem/last_resort.h"
#include "sim/problem/newton_system.h"
#include "sim/problem/point_contacts.h"
#include "sim/problem/solvers.h"

namespace tumble {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kOpen = 1e-12;    ///< balance of momentum above which v is taken from λ
constexpr double kClosed = 1e-14;  ///< balance or residual that is rounding
constexpr double kNear = 1e-9;     ///< residual below which stages that bring nothing are counted
constexpr double kCalmTau = 1e4;   ///< ρ of the calm stages, by the weight of the system

template <int N>
class Newton {
 public:
  SolveReport solve(const Problem& problem, const SolveSettings& settings, Solution& solution);
  /// Of the many answers that are as good as the one in `solution` the one that solve() gives.
  void choose(const Problem& problem, const SolveSettings& settings, SolveReport& report,
              Solution& solution);

 private:
  double accuracy(double residual) const;
  double mayBeOpen() const;
  void recall(const Problem& problem, const Solution& solution);
  double residualOf(int inner);
  double solveCalm();
  double solveCold(int most);
  double solveSlips(double tau);
  double solveHard(int most);
  void settle();
  void remember();
  void keepBetter(SolveReport& report);
  void polish(SolveReport& report);
  void closeBalance(SolveReport& report);
  void obeyForces(SolveReport& report);
  bool expect(SolveReport& report);
  void takeSprings(double residual, SolveReport& report);
  void select(SolveReport& report);
  bool solveAnew(int most, const Solution& start, SolveReport& report);

  void takeLambda(const Problem& problem, Solution& solution, SolveReport& report);

  NewtonSystem<N> system_;
  double tolerance_ = 1e-12;
  std::vector<typename NewtonSystem<N>::Point> points_, pointsBefore_;
  std::vector<typename NewtonSystem<N>::Mover> movers_, moversBefore_;
  std::vector<Vec6> own_;  ///< v where λ might decide
};

/// How little [m/s] a step must change any row to be the last of its stage.
template <int N>
double Newton<N>::accuracy(double residual) const {
  return system_.scale * std::max(0.1 * tolerance_, 0.01 * std::min(1.0, residual));
}

/// The balance of momentum that a solution where points bend may end with: what is left of it,
/// `obey` closes, and its residual grows by as much.
template <int N>
double Newton<N>::mayBeOpen() const {
  return std::max(kOpen, 0.01 * tolerance_);
}

/// Begins with the forces in `solution`, if it has some.
template <int N>
void Newton<N>::recall(const Problem& problem, const Solution& solution) {
  if (solution.lambda.size() != problem.rows.size()) return;
  for (std::size_t c = 0; c < system_.points.size(); ++c) {
    auto& point = system_.points[c];
    for (int k = 0; k < point.rows; ++k)
      point.lambda[k] = solution.lambda[problem.cones[c].row + k] / point.length;
  }
  system_.look(true);
}

/// The residual at the end of a stage. Forces that do not balance yet may look right: where points
/// bend a solved stage goes on to its minimum, by so many steps at most.
template <int N>
double Newton<N>::residualOf(int inner) {
  const double now = system_.residual();
  if (!(now <= tolerance_) || !system_.couples() || system_.balance() <= mayBeOpen()) return now;
  system_.minimise(0.0, inner);
  return system_.residual();
}

/// Stages of constant slip terms with one large ρ: where little has changed, one factor will do.
/// The first go with narrow cones, so that the last find few forces on the edge of one.
template <int N>
double Newton<N>::solveCalm() {
  constexpr int kStages = 10, kNarrow = 2, kInner = 12, kMost = 40;
  constexpr double kRoughest = 1e-2;  // residual that the first stage is measured by: a large ρ
  constexpr double kRough = 1e-8;     // balance of a stage that was ended early
  constexpr double kSlips = 1e-3;     // of the scale: a slip that is not for a stage to bring to 0
  system_.rho = kCalmTau * system_.weight;
  system_.narrow();
  double before = kInfinity;
  for (int stage = 0; stage < kStages && system_.factorizations < kMost; ++stage) {
    if (!system_.minimise(accuracy(std::min(kRoughest, before)), kInner)) break;
    if (stage == 0) system_.widen(kSlips * system_.scale);
    double now = system_.residual();
    // Forces that do not yet balance may look right where nothing moves. A loose tolerance leaves
    // those of cones to the next stage.
    const bool open = now <= tolerance_ && system_.balance() > kRough;
    const bool goesOn = open && tolerance_ > kRough && system_.rubs();
    if (open && !goesOn) {
      system_.minimise(0.0, kInner);
      now = system_.residual();
    }
    const auto done = [&] { return now <= tolerance_ && !goesOn; };
    bool stalled = stage != 1 && now > 0.5 * before;
    if (done() || stalled || stage == kNarrow) {
      if (system_.widen(0.0)) stalled = false;
      now = system_.residual();
    }
    if (done() || stalled) return now;
    system_.nextStage(0.0);
    before = now;
  }
  return kInfinity;
}

/// Stages with slip terms that go half of the way to those of the velocities after each: the whole
/// of it swings to and fro where many contacts slide. ρ grows while stages are easy. Points that
/// bend have a contact each: there they go most of the way, and unless solids turn too, a larger ρ
/// finds more edges of cones to cross than it saves stages (a cloth that slides over a ball: 6
/// factors a step in place of 18).
template <int N>
double Newton<N>::solveCold(int most) {
  constexpr double kGrowth = 10.0, kLastTau = 10.0, kPart = 0.5, kPartOfBent = 0.8;
  constexpr int kStages = 60, kInner = 60, kEasy = 6, kPatience = 4, kShrinks = 4;
  double before = kInfinity, best = kInfinity;
  int stalled = 0, shrunk = 0;
  most += system_.factorizations;
  for (int stage = 0;; ++stage) {
    const int spent = system_.factorizations;
    pointsBefore_ = system_.points;
    moversBefore_ = system_.movers;
    const bool minimal = system_.minimise(accuracy(before), kInner);
    const double now = residualOf(kInner);
    if (now <= tolerance_) return now;
    if (system_.factorizations >= most || stage == kStages) return now;
    // A ρ that the range of masses does not bear leaves no minimum to be found.
    if (!minimal && shrunk < kShrinks && now > 1e-3 * before && system_.balance() > 1e-3) {
      system_.goBack(pointsBefore_, moversBefore_);
      system_.rho *= 0.1;
      ++shrunk;
      continue;
    }
    stalled = now > 0.8 * best && now < kNear ? stalled + 1 : 0;
    best = std::min(best, now);
    if (stalled == kPatience) return now;
    const bool slow = now > 0.01 * before && system_.factorizations - spent <= kEasy;
    if ((N == 6 || !system_.couples()) && (stage == 0 || slow))
      system_.rho = std::min(kGrowth * system_.rho, kLastTau * system_.weight);
    before = now;
    system_.nextStage(system_.couples() ? kPartOfBent : kPart);
  }
}

/// Stages in which the slip terms follow the velocities.
template <int N>
double Newton<N>::solveSlips(double tau) {
  constexpr int kStages = 10, kInner = 15, kFailures = 4, kPatience = 2;
  system_.rho = tau * system_.weight;
  double before = system_.residual();
  int failed = 0, stalled = 0;
  for (int stage = 0; stage < kStages && failed < kFailures; ++stage) {
    system_.nextStage(0.0);
    pointsBefore_ = system_.points;
    moversBefore_ = system_.movers;
    const bool found = system_.followSlip(accuracy(before), kInner);
    const double now = residualOf(kInner);
    if (now <= tolerance_) return now;
    if (!found && !(now <= 0.5 * before)) {
      system_.goBack(pointsBefore_, moversBefore_);
      system_.rho *= 0.1;
      ++failed;
      continue;
    }
    stalled = now > 0.9 * before && now < kNear ? stalled + 1 : 0;
    if (stalled == kPatience) return now;
    if (found && now > 0.1 * before) system_.rho *= 3.0;
    before = now;
  }
  return before;
}

/// λ and v to go back to.
template <int N>
void Newton<N>::remember() {
  points_ = system_.points;
  movers_ = system_.movers;
}

/// Both in turn, with more patience each time.
template <int N>
double Newton<N>::solveHard(int most) {
  struct Round {
    int cold;    // factorizations
    double tau;  // of the stages that follow
  };
  constexpr Round kRounds[] = {{200, 10.0}, {100, 10.0}, {60, 1.0}, {100, 1000.0}, {150, 10.0}};
  system_.rho = system_.weight;
  double residual = kInfinity, before = kInfinity;
  for (const Round& round : kRounds) {
    residual = solveCold(std::min(round.cold, most));
    if (residual <= tolerance_ || system_.factorizations >= most) return residual;
    const double rho = system_.rho;
    remember();
    const double slips = solveSlips(round.tau);
    if (slips <= tolerance_) return slips;
    if (slips < residual) {
      residual = slips;
    } else {
      system_.goBack(points_, movers_);
    }
    // Where contacts hold one another to a hair, their forces grow without an end.
    if (system_.factorizations >= most || (residual < kNear && residual > 0.1 * before))
      return residual;
    before = residual;
    system_.rho = rho;
    system_.nextStage(1.0);
  }
  return residual;
}

/// Minimises to rounding, as far as that closes the balance of momentum.
template <int N>
void Newton<N>::settle() {
  constexpr int kSteps = 4;
  double before = kInfinity;
  for (int k = 0; k < kSteps; ++k) {
    system_.minimise(0.0, 1);
    const double now = system_.balance();
    if (now <= kClosed || now > 0.5 * before) return;
    before = now;
  }
}

/// Keeps the answer at hand where it is better than what was reported, balance first; else the one
/// before.
template <int N>
void Newton<N>::keepBetter(SolveReport& report) {
  const double balance = system_.balance(), residual = system_.residual();
  const bool closer = balance <= kClosed && residual <= report.residual;
  const bool closed = balance < report.balance;
  if (closer || (closed && residual <= std::max(tolerance_, report.residual))) {
    report.balance = balance;
    report.residual = residual;
  } else {
    system_.goBack(points_, movers_);
  }
}

/// After calm stages, one or two more by the last factor leave rounding alone.
template <int N>
void Newton<N>::polish(SolveReport& report) {
  constexpr int kMore = 2;
  for (int k = 0; k < kMore; ++k) {
    if (std::max(report.residual, report.balance) <= kClosed) return;
    remember();
    if (!system_.stageMore()) return;
    keepBetter(report);
  }
}

/// At a solution every ρ gives the same forces; but a large one magnifies the rounding of fast
/// slips, where a small one closes the balance of momentum.
template <int N>
void Newton<N>::closeBalance(SolveReport& report) {
  constexpr int kStages = 8;
  for (const double rho : {system_.rho, system_.weight}) {
    if (report.balance <= kClosed) return;
    remember();
    system_.rho = rho;
    for (int stage = 0; stage < kStages; ++stage) {
      system_.nextStage(1.0);
      settle();
      if (system_.residual() <= tolerance_) break;
    }
    keepBetter(report);
  }
}

/// Where contacts do what they are expected to do, forces of springs are found at once.
/// @return whether they were
template <int N>
bool Newton<N>::expect(SolveReport& report) {
  const double rho = system_.rho, residual = system_.expectSprings(tolerance_);
  if (!(residual <= tolerance_)) return false;
  takeSprings(residual, report);
  system_.rho = rho;
  return report.balance <= kClosed;
}

template <int N>
void Newton<N>::takeSprings(double residual, SolveReport& report) {
  report.residual = residual;
  report.balance = system_.balance();
}

/// Of the many forces that solve the problem those of springs, if they can be had.
template <int N>
void Newton<N>::select(SolveReport& report) {
  if (!(report.residual <= tolerance_) || system_.couples() || system_.areOfSprings()) return;
  remember();
  const double rho = system_.rho, residual = system_.findSprings(tolerance_);
  if (residual <= tolerance_) {
    takeSprings(residual, report);
  } else {
    system_.goBack(points_, movers_);
    system_.rho = rho;
  }
}

template <int N>
SolveReport Newton<N>::solve(const Problem& problem, const SolveSettings& settings,
                             Solution& solution) {
  tolerance_ = settings.tolerance;
  system_.prepare(problem);
  system_.restart(solution);
  if (system_.couples()) recall(problem, solution);
  system_.expect(problem, system_.couples() ? std::span<const double>{} : settings.pull);
  SolveReport report;
  const bool easy = expect(report) || solveAnew(settings.maxIterations, solution, report);
  report.iterations += system_.factorizations;
  system_.write(problem, solution);
  if (!system_.couples() && (!easy || report.balance > kOpen))
    takeLambda(problem, solution, report);
  if (!(report.residual <= tolerance_)) report.status = SolveStatus::NotConverged;
  return report;
}

/// Velocities that go with the forces at hand, where closing the balance does not bring them.
template <int N>
void Newton<N>::obeyForces(SolveReport& report) {
  if (report.balance > mayBeOpen()) closeBalance(report);
  if (report.balance <= kOpen) return;
  system_.obey();
  report.residual = system_.residual();
  report.balance = system_.balance();
}

/// From λ = 0 and the velocities at hand. @return whether calm stages did it
template <int N>
bool Newton<N>::solveAnew(int most, const Solution& start, SolveReport& report) {
  report.iterations = std::exchange(system_.factorizations, 0);
  if (report.iterations > 0) system_.restart(start);
  // Calm stages keep the slip terms of the start, so that they do not end where contacts slide.
  const bool slides = system_.couples() ? system_.rubs() : system_.slides();
  report.residual = slides ? kInfinity : solveCalm();
  const bool calm = report.residual <= tolerance_;
  if (!calm) {
    if (!std::isfinite(report.residual)) system_.restart(start);
    report.residual = solveHard(most);
  }
  report.balance = system_.balance();
  if (system_.couples()) {
    obeyForces(report);
    if (!calm || report.residual <= tolerance_) return calm;
    system_.restart(start);
    report.residual = solveHard(most);
    report.balance = system_.balance();
    obeyForces(report);
    return calm;
  }
  if (calm) polish(report);
  select(report);
  closeBalance(report);
  return calm;
}

template <int N>
void Newton<N>::choose(const Problem& problem, const SolveSettings& settings, SolveReport& report,
                       Solution& solution) {
  tolerance_ = settings.tolerance;
  system_.prepare(problem);
  system_.take(problem, solution);
  SolveReport chosen = report;
  select(chosen);
  closeBalance(chosen);
  Solution other;
  system_.write(problem, other);
  takeLambda(problem, other, chosen);
  report.iterations += system_.factorizations;
  if (!(chosen.residual <= std::max(tolerance_, report.residual))) return;
  report.residual = chosen.residual;
  report.balance = chosen.balance;
  std::swap(solution, other);
}

/// Where v is not what λ gives, momentum would be lost: λ decides, unless that leaves more than the
/// tolerance where v does not, as under loads that outweigh a body a million times.
template <int N>
void Newton<N>::takeLambda(const Problem& problem, Solution& solution, SolveReport& report) {
  if (report.balance == 0.0) return;
  const bool open = report.balance > kOpen;
  own_ = solution.v;
  for (double& lambda : solution.lambda)
    if (!std::isfinite(lambda)) lambda = 0.0;
  velocitiesFromLambda(problem, solution.lambda, solution.v);
  const double residual = naturalResidual(problem, solution);
  if (!open && residual > tolerance_) {
    std::swap(solution.v, own_);
    return;
  }
  report.residual = residual;
  report.balance = 0.0;
}

/// Whether a row turns a body, by more than rounding.
bool turns(const Problem& problem) {
  constexpr double kNothing = 1e-28;  // of the mobility that a row gives
  return std::any_of(problem.rows.begin(), problem.rows.end(), [&](const Row& row) {
    const double turning = row.angularA.dot(problem.Iinv[row.a] * row.angularA) +
                           row.angularB.dot(problem.Iinv[row.b] * row.angularB);
    const double moving = problem.invM[row.a] + problem.invM[row.b];
    return turning > kNothing * moving * row.linear.squaredNorm();
  });
}

}  // namespace

SolveReport solveNewton(const Problem& problem, const SolveSettings& settings, Solution& solution) {
  const bool couples = !problem.couplings.empty();
  if (!couples)
    if (const auto direct = solveDirect(problem, settings, solution)) return *direct;
  if (couples)
    if (const auto found = solvePointContacts(problem, settings, solution)) return *found;
  thread_local Newton<3> straight;  // both keep their memory from call to call
  thread_local Newton<6> turning;
  const auto alone = [](const Problem& p, const SolveSettings& to, Solution& answer) {
    return turns(p) ? turning.solve(p, to, answer) : straight.solve(p, to, answer);
  };
  SolveReport report = alone(problem, settings, solution);
  if (report.status == SolveStatus::Solved) return report;
  if (atRounding(problem, solution, report.residual)) {
    report.status = SolveStatus::Solved;
    return report;
  }
  if (couples) return report;
  if (islands(problem).size() > 1) {  // those that are easy need not fail with the others
    solution = {};
    return solveByIslands({"newton", "", solveNewton}, problem, settings, solution);
  }
  report = lastResort(problem, settings, alone, report, solution);
  if (report.status != SolveStatus::Solved) return report;
  turns(problem) ? turning.choose(problem, settings, report, solution)
                 : straight.choose(problem, settings, report, solution);
  return report;
}

}  // namespace tumble
