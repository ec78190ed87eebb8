// Chapter 1, Y(t): the table of integrators.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "sim/ode/system.h"

namespace tumble {

/// One integrator at work on systems of one size: owns its stages, so a step allocates nothing.
class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Replaces y = Y(t) by the approximation of Y(t + h), h [s] of either sign, and normalises it.
  /// The result depends on t, h and y alone, not on the steps before.
  virtual void step(const System& system, double t, double h, std::span<double> y) = 0;

  /// Dense output: Y at a time t [s] inside the last step, not normalised. False if this integrator
  /// has none, or not for this time.
  virtual bool dense(double /*t*/, std::span<double> /*y*/) const { return false; }

  /// False if the last step could not be held to the integrator's tolerance.
  virtual bool withinTolerance() const { return true; }
};

/// A row of the table: what an integrator is called, needs, keeps and achieves.
struct Integrator {
  std::string_view name;        ///< value of `course.integrator` in a scene
  std::string_view summary;     ///< one line for people
  int order;                    ///< global error ~ h^order
  bool adaptive = false;        ///< divides a step by its own error estimate
  bool needsKickDrift = false;  ///< works only on systems that offer kick and drift
  bool hasDense = false;        ///< `Stepper::dense` answers
  std::unique_ptr<Stepper> (*make)(int size);
};

/// All integrators. To add one: write `sim/ode/<name>.cpp` and add its row in integrators.cpp.
std::span<const Integrator> integrators();

/// The row of that name, or nullptr.
const Integrator* findIntegrator(std::string_view name);

}  // namespace tumble
