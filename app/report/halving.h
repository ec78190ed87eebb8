// A scene at a step, its half, quarter and eighth, by every method that takes it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/record/recording.h"

namespace tumble {

/// One run, looked at at some instants.
struct HalvedRun {
  double step = 0.0;                            ///< [s]; 0 of a method without one
  std::vector<std::vector<BodySample>> bodies;  ///< at each instant that was reached
  std::vector<double> seconds;                  ///< [s] CPU until each of these
  std::string ended;                            ///< why the last one was not reached, or ""
};

/// All runs by one method.
struct MethodRuns {
  std::string method;
  std::string refusal;          ///< why it does not take the scene, or ""
  std::vector<HalvedRun> runs;  ///< at h, h/2, h/4, h/8; one alone of a method without a step
  HalvedRun twin;               ///< the first again, its start moved in the last place
};

/// What is asked of the runs.
struct HalvingPlan {
  std::vector<double> instants;  ///< [s] ascending, within the duration
  double budget = 60.0;          ///< [s] CPU; a run that takes longer is ended, and one
                                 ///< that would is not begun
};

/// T/4, T/2, 3T/4 and T of the first T [s].
std::vector<double> quarters(double T);

/// Runs the scene by each row of the table of methods but "auto", h being the method's own step in
/// the scene.
/// @param done  called after each method
std::vector<MethodRuns> runHalved(const Scene& scene, const HalvingPlan& plan,
                                  const std::function<void()>& done = {});

/// The bounding radius [m] of each body of the scene; negative of what does not move.
std::vector<double> movingRadii(const Scene& scene);

/// How far [m] the farthest point of a moving body stands from where it stands in the other run:
///   max |Δx| + 2 r sin(θ/2),  r the bounding radius, θ the angle between the attitudes.
double apart(const std::vector<double>& radii, const std::vector<BodySample>& one,
             const std::vector<BodySample>& other);

}  // namespace tumble
