// Chapter 1, Y(t): what a differential equation offers to a solver. Knows no bodies.
#pragma once

#include <span>

namespace tumble {

/// A first-order system  dY/dt = f(t, Y)  with Y an array of `size()` numbers (slides SD5–SD10).
/// A system always gives its derivative; the other offers are for integrators that ask for them.
class System {
 public:
  virtual ~System() = default;

  /// Length of Y.
  virtual int size() const = 0;

  /// Writes dY/dt at (t, y) into `ydot`. Units: those of Y per second.
  virtual void derivative(double t, std::span<const double> y, std::span<double> ydot) const = 0;

  /// True if `kick` and `drift` below are implemented: Y splits into positions and momenta.
  virtual bool offersKickDrift() const { return false; }

  /// Momenta += h · (their rate at (t, y)), positions untouched.
  virtual void kick(double /*t*/, double /*h*/, std::span<double> /*y*/) const {}

  /// Positions += h · (their rate at (t, y)), momenta untouched.
  virtual void drift(double /*t*/, double /*h*/, std::span<double> /*y*/) const {}

  /// Puts Y back on its manifold after a step (unit quaternions). Nothing to do by default.
  virtual void normalise(std::span<double> /*y*/) const {}
};

}  // namespace tumble
