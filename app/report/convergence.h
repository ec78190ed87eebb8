// What halved steps say of a scene without a closed form: order, error, and where there is none.
#pragma once

#include <limits>
#include <span>

#include "app/report/halving.h"
#include "app/report/study.h"

namespace tumble {

/// How much of each demo the report's chapter on convergence takes [s], and how much CPU time [s]
/// it gives to a run.
inline constexpr double kDemoSpan = 1.0, kDemoBudget = 1.0;

/// What the differences between a run and the one at half its step come to.
enum class Halving {
  Converges,  ///< they shrink with some order in the step
  Rounding,   ///< they are what rounding makes of the motion, whatever the step
  Diverges,   ///< they do not shrink: the motion does not converge
  Chaos,      ///< rounding alone has grown so far that nothing else is seen
  Unknown,    ///< there are too few of them
};

/// Richardson's estimate from n − 1 differences of n runs with halved steps:
///   d(h) = |y(h) − y(h/2)|,   2ᵖ = d(h)/d(h/2),   |y(h) − y(0)| ≈ d(h) 2ᵖ/(2ᵖ − 1)
///   L. F. Richardson, The Deferred Approach to the Limit, 1927. Here p is the mean over the
///   halvings above ten times the noise; below 0.5 they count as not shrinking.
struct Richardson {
  Halving halving = Halving::Unknown;
  double order = 0.0;          ///< p, of what converges
  std::vector<double> errors;  ///< [m] of each of the n runs; infinite where nothing is known
};

/// @param noise  [m] what rounding makes of the motion
Richardson extrapolate(std::span<const double> differences, double noise);

/// One method at one instant.
struct MethodAt {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::vector<double> steps, seconds;  ///< [s] of the runs that came so far
  std::vector<double> differences;     ///< [m] of each to the next
  std::vector<double> offReference;    ///< [m] of each; NaN without a reference
  double noise =
      kNone;  ///< [m] rounding: what the last place of the start changes, or its steps do
  Richardson richardson;
  bool elsewhere = false;  ///< it converges, but not to the reference
  std::string missing;     ///< why there is no run here, or fewer than there should be
};

/// All methods at one instant, in the order of the table.
struct ConvergenceAt {
  double t = 0.0;
  int reference = -1;  ///< `exact` if it came so far, else who converges with the least error
  std::vector<MethodAt> methods;
};

struct Convergence {
  std::string scene;  ///< title
  std::vector<std::string> methods;
  std::vector<ConvergenceAt> instants;
};

Convergence convergenceOf(const Scene& scene, const HalvingPlan& plan,
                          const std::vector<MethodRuns>& runs);

/// "order 1.0", "rounding", "does not converge", "does not converge: chaos", "no step", "too few
/// runs", "no run"; with ", elsewhere".
std::string wordFor(const MethodAt& method);

/// The tables, one for each instant, and what they come to.
std::string convergenceText(const Convergence& convergence);

/// t, method, step, difference, order, error, off_reference, noise, cpu_seconds, says: a row for
/// each run and instant; numbers that are not known are left out.
std::string convergenceCsv(const Convergence& convergence);

/// The scenes of a report side by side: a table of HTML with a row for each method at the last
/// instant that it came to.
std::string convergenceTable(std::span<const Convergence> scenes);

/// A scene of the report; its study has no points if none can be drawn.
struct SpeedOfScene {
  Convergence convergence;
  Study speed;
};

/// Speed against error at the last instant that a run came to, as a study of the report.
Study speedOf(const Convergence& convergence);

/// Whether any point of the study can be drawn.
bool drawable(const Study& study);

}  // namespace tumble
