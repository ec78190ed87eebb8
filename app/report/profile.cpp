#include "app/report/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "app/record/bodies.h"
#include "app/record/recording.h"
#include "app/report/cost.h"
#include "sim/contact/rows.h"
#include "sim/origin.h"

namespace tumble {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostRows = 400;  // a dense solver would take minutes for more

Problem stepProblem(const Model& model, const Sample& sample, double h) {
  const std::vector<RigidBody> bodies = bodiesAt(model.def, sample);
  Problem problem;
  beginVelocityProblem(bodies, problem);
  for (int i = 0; i < model.count(); ++i)
    if (!model.fixed(i)) problem.vStar[i].head<3>() += h * model.def.gravity;
  for (const ContactSample& contact : sample.contacts) {
    const double mu = model.surface(contact.a, contact.b).friction;
    const int row = static_cast<int>(problem.rows.size());
    problem.cones.push_back({mu > 0.0 ? ConeKind::Friction : ConeKind::Push, row, mu});
    const auto add = [&](const Vec3& d, double bias) {
      problem.rows.push_back(pointRow(bodies, contact.a, contact.b, contact.p, d, bias));
    };
    add(contact.n, std::max(contact.separation, 0.0) / h);
    if (mu <= 0.0) continue;
    Vec3 t1, t2;
    tangents(contact.n, Vec3::UnitX(), t1, t2);
    add(t1, 0.0);
    add(t2, 0.0);
  }
  return problem;
}

/// CPU time [s] of one call, the least of turns of a millisecond; ∞ if the goal is not reached.
double timeOf(const Solver& solver, const Problem& problem, double goal) {
  constexpr int kTurns = 3;
  constexpr double kTurn = 1e-3;  // [s]
  double least = kInfinity;
  for (int turn = 0; turn < kTurns; ++turn) {
    const double start = processSeconds();
    double spent = 0.0;
    int calls = 0;
    while (spent < kTurn) {
      Solution solution;
      solver.solve(problem, {.tolerance = goal}, solution);
      const double residual = naturalResidual(problem, solution);
      if (!(residual <= goal || atRounding(problem, solution, residual))) return kInfinity;
      ++calls;
      spent = processSeconds() - start;
    }
    least = std::min(least, spent / calls);
  }
  return least;
}

/// What the cheapest run by a method costs [s] that is right to so much; ∞ without one.
double costTo(const Study& study, const std::string& method, double error) {
  double least = kInfinity;
  for (std::size_t i = 0; i < study.series.size(); ++i)
    if (study.methods[i] == method)
      for (const ChartPoint& point : study.series[i].points)
        if (point.error <= error) least = std::min(least, point.cpuShare);
  return least;
}

}  // namespace

std::vector<Problem> contactProblems(const Scene& scene, int instants, double h) {
  World world = makeWorld(scene);
  std::vector<Problem> problems;
  for (int k = 1; k <= instants && !world.report().stopped; ++k) {
    const double t = scene.world.duration * k / instants;
    world.advance(t);
    if (world.report().stopped) break;
    const Problem problem =
        stepProblem(world.model(), shifted(world.sample(t), -world.origin(), Vec3::Zero()), h);
    if (!problem.rows.empty() && problem.rows.size() <= kMostRows) problems.push_back(problem);
  }
  return problems;
}

Profile solverProfile(std::span<const Problem> problems, double goal) {
  Profile profile{fmt::format("solvers-{:.0e}", goal),
                  fmt::format("Solvers of the contact problem, to a residual of {:.0e}", goal),
                  fmt::format("{} problems that the demos pose while they run", problems.size()),
                  {}};
  for (const Solver& solver : solvers()) {
    ProfileCurve& curve = profile.curves.emplace_back();
    curve.label = solver.name;
    for (const Problem& problem : problems) curve.seconds.push_back(timeOf(solver, problem, goal));
  }
  return profile;
}

Profile methodProfile(std::span<const Study> studies) {
  Profile profile{"methods", "Methods, to an accuracy", "", {}};
  for (const MethodName& method : methodNames())
    profile.curves.push_back({std::string(method.name), {}});
  int pairs = 0;
  for (const Study& study : studies) {
    if (std::set(study.methods.begin(), study.methods.end()).size() < 2) continue;
    for (int digits = 1; digits <= 12; ++digits) {
      std::vector<double> costs;
      for (const ProfileCurve& curve : profile.curves)
        costs.push_back(costTo(study, curve.label, std::pow(10.0, -digits)));
      if (*std::min_element(costs.begin(), costs.end()) == kInfinity) continue;
      for (std::size_t k = 0; k < costs.size(); ++k) profile.curves[k].seconds.push_back(costs[k]);
      ++pairs;
    }
  }
  profile.subtitle =
      fmt::format("{} pairs of a chart and an error of 1e-1 to 1e-12; the cheapest run", pairs);
  std::erase_if(profile.curves, [](const ProfileCurve& curve) {
    return std::all_of(curve.seconds.begin(), curve.seconds.end(),
                       [](double seconds) { return seconds == kInfinity; });
  });
  return profile;
}

std::vector<std::pair<double, double>> profileSteps(const Profile& profile, std::size_t curve) {
  // Ratios to the fastest of each problem.
  std::vector<double> ratios;
  double largest = 1.0;
  const std::vector<double>& own = profile.curves[curve].seconds;
  for (std::size_t i = 0; i < own.size(); ++i) {
    double best = kInfinity;
    for (const ProfileCurve& other : profile.curves) best = std::min(best, other.seconds[i]);
    for (const ProfileCurve& other : profile.curves)
      if (std::isfinite(other.seconds[i])) largest = std::max(largest, other.seconds[i] / best);
    if (std::isfinite(own[i])) ratios.push_back(own[i] / best);
  }
  std::sort(ratios.begin(), ratios.end());

  const double count = static_cast<double>(own.size());
  std::vector<std::pair<double, double>> steps;
  for (std::size_t k = 0; k < ratios.size(); ++k)
    if (k + 1 == ratios.size() || ratios[k + 1] > ratios[k])
      steps.emplace_back(ratios[k], static_cast<double>(k + 1) / count);
  if (steps.empty() || steps.front().first > 1.0) steps.insert(steps.begin(), {1.0, 0.0});
  if (steps.back().first < largest) steps.emplace_back(largest, steps.back().second);
  return steps;
}

std::string profileCsv(const Profile& profile) {
  std::string csv = "solver,ratio,share\n";
  for (std::size_t i = 0; i < profile.curves.size(); ++i)
    for (const auto& [ratio, share] : profileSteps(profile, i))
      csv += fmt::format("{},{:.4g},{:.4g}\n", profile.curves[i].label, ratio, share);
  return csv;
}

}  // namespace tumble
