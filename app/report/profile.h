// Who is fastest how often: solvers on the problems that scenes pose, methods on charts.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/report/study.h"
#include "sim/problem/problem.h"

namespace tumble {

/// The velocities at the end of a step of h [s] under gravity, asked at so many evenly spaced
/// instants of a run: one problem for each instant at which something touches.
std::vector<Problem> contactProblems(const Scene& scene, int instants, double h);

/// What every problem costs one solver or method.
struct ProfileCurve {
  std::string label;
  std::vector<double> seconds;  ///< [s] CPU, per problem; ∞ where the goal is not reached
};

/// A performance profile: Dolan & Moré, Benchmarking Optimization Software with Performance
/// Profiles, 2002. A curve says for what share of the problems its owner
/// takes at most τ times the time of the fastest; where it ends is the share that it solves at all.
struct Profile {
  std::string name;  ///< of its files
  std::string title, subtitle;
  std::vector<ProfileCurve> curves;
};

/// Every solver of the table, asked for a natural-map residual of `goal`; the residual counts, not
/// what the solver says of it.
Profile solverProfile(std::span<const Problem> problems, double goal);

/// The methods over all pairs of a study in which several compete and an accuracy from 1e-1 to
/// 1e-12 that some run of it is right to: the cost of the cheapest such run by each.
Profile methodProfile(std::span<const Study> studies);

/// The steps of one curve: (τ, share of the problems within it), both ascending, to the largest τ
/// of all curves.
std::vector<std::pair<double, double>> profileSteps(const Profile& profile, std::size_t curve);

/// solver, ratio, share: a row for each step.
std::string profileCsv(const Profile& profile);

}  // namespace tumble
