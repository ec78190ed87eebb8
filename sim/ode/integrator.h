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

/// What a step keeps, up to rounding, of any system that has it. Linear invariants (momentum) are
/// kept by every row.
struct Keeps {
  bool quadratic = false;  ///< invariants that are quadratic in Y (|q|², Euler's energy and |L|²)
  bool symplectic = false;  ///< areas in phase space, so that the energy only oscillates
  bool symmetric = false;   ///< a step by −h undoes a step by h
  bool manifold = false;    ///< the manifold that `normalise` serves (unit quaternions)
};

/// What some rows leave to the caller.
struct Choices {
  int order = 0;             ///< of a row of any order; 0 = the row's own
  double tolerance = 1e-10;  ///< of an adaptive row: error per substep in each number y of Y,
                             ///< relative to 1 + |y|
};

/// A row of the table: what an integrator is called, needs, keeps and achieves.
struct Integrator {
  std::string_view name;     ///< value of `course.integrator` in a scene
  std::string_view summary;  ///< one line for people
  int order;                 ///< global error ~ h^order
  bool adaptive = false;     ///< divides a step by its own error estimate
  bool anyOrder = false;     ///< the order is the caller's choice; `order` is the default
  bool hasDense = false;     ///< `Stepper::dense` answers
  Offers needs = {};         ///< beside the derivative
  Keeps keeps = {};
  std::unique_ptr<Stepper> (*create)(int size, const Choices&);

  /// A stepper for systems of that size.
  std::unique_ptr<Stepper> make(int size, Choices choices = {}) const {
    if (!anyOrder || choices.order == 0) choices.order = order;
    return create(size, choices);
  }
};

/// True if the system, as it is now, offers what the row needs.
inline bool suits(const Integrator& row, const System& system) {
  return missing(system.offers(), row.needs).empty();
}

/// The highest order that a row of any order takes.
inline constexpr int kHighestOrder = 40;
/// The least tolerance that an adaptive row takes: rounding spoils its estimate below.
inline constexpr double kLeastTolerance = 1e-14;

/// All integrators. To add one: write `sim/ode/<name>.cpp` and add its row in integrators.cpp.
std::span<const Integrator> integrators();

/// The row of that name, or nullptr.
const Integrator* findIntegrator(std::string_view name);

}  // namespace tumble
