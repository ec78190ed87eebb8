// The solvers of the contact problem side by side, on the problems that scenes pose.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/scene/scene.h"
#include "sim/problem/problem.h"

namespace tumble {

/// The velocities at the end of a step of h [s] under gravity, asked at so many evenly spaced
/// instants of a run: one problem for each instant at which something touches.
std::vector<Problem> contactProblems(const Scene& scene, int instants, double h);

/// What every problem costs one solver.
struct ProfileCurve {
  std::string label;
  std::vector<double> seconds;  ///< [s] CPU, per problem; ∞ where the residual is above the goal
};

/// A performance profile: Dolan & Moré, Benchmarking Optimization Software with Performance
/// Profiles, 2002. A solver's curve says for what share of the problems it takes at most τ times
/// the time of the fastest; where it ends is the share that it solves at all.
struct Profile {
  std::string name;  ///< of its files
  std::string title, subtitle;
  std::vector<ProfileCurve> curves;
};

/// Every solver of the table, asked for a natural-map residual of `goal`; the residual counts, not
/// what the solver says of it.
Profile solverProfile(std::span<const Problem> problems, double goal);

/// The steps of one curve: (τ, share of the problems within it), both ascending, to the largest τ
/// of all curves.
std::vector<std::pair<double, double>> profileSteps(const Profile& profile, std::size_t curve);

/// solver, ratio, share: a row for each step.
std::string profileCsv(const Profile& profile);

}  // namespace tumble
