// Chapter 1, Y(t): what a differential equation offers to a solver. Knows no bodies.
#pragma once

#include <span>
#include <string_view>

namespace tumble {

/// How well Y splits into positions, which drift, and momenta, which are kicked.
enum class Split {
  None,
  Rough,      ///< kick and drift are right to first order
  Symmetric,  ///< kick and drift by −h undo those by h; forces depend on positions alone
  Exact       ///< they are exact flows, and the kinetic energy is quadratic in the momenta
};

/// What a system offers beside its derivative, and what an integrator needs of it.
struct Offers {
  Split split = Split::None;
  bool jet = false;  ///< Taylor coefficients of the solution
  bool lie = false;  ///< increments in a Lie algebra and their action on Y
};

/// What `needed` asks for and `offered` lacks, in words: "a Taylor jet". Empty if nothing is.
std::string_view missing(const Offers& offered, const Offers& needed);

/// A first-order system  dY/dt = f(t, Y)  with Y an array of `size()` numbers (slides SD5–SD10).
/// A system always gives its derivative; the other offers are for integrators that ask for them.
class System {
 public:
  virtual ~System() = default;

  /// Length of Y.
  virtual int size() const = 0;

  /// Writes dY/dt at (t, y) into `ydot`. Units: those of Y per second.
  virtual void derivative(double t, std::span<const double> y, std::span<double> ydot) const = 0;

  /// Which of the functions below are there; the split may be better than `Split::Rough`.
  virtual Offers offers() const { return {}; }

  /// Momenta += h · (their rate at (t, y)), positions untouched.
  virtual void kick(double /*t*/, double /*h*/, std::span<double> /*y*/) const {}

  /// Positions move for h [s] as the momenta have them move; these stay as they are.
  virtual void drift(double /*t*/, double /*h*/, std::span<double> /*y*/) const {}

  /// Taylor jet: the coefficients c_k = Y⁽ᵏ⁾(t)/k!, k = 0 … order, of the solution through (t, y),
  ///   Y(t + s) = Σ c_k sᵏ,   c_k at coefficients[k size() … (k+1) size()).
  virtual void jet(double /*t*/, std::span<const double> /*y*/, int /*order*/,
                   std::span<double> /*coefficients*/) const {}

  /// Length of an increment: an element of the Lie algebra whose group acts on Y.
  virtual int algebraSize() const { return 0; }
  /// The increment per second a(t, y) that carries the solution:  dY/dt = a·Y  (infinitesimal
  /// action).
  virtual void algebra(double /*t*/, std::span<const double> /*y*/, std::span<double> /*a*/) const {
  }
  /// out = [a, b].
  virtual void commutator(std::span<const double> /*a*/, std::span<const double> /*b*/,
                          std::span<double> /*out*/) const {}
  /// y = exp(a)·y.
  virtual void act(std::span<const double> /*a*/, std::span<double> /*y*/) const {}

  /// Puts Y back on its manifold after a step (unit quaternions). Nothing to do by default.
  virtual void normalise(std::span<double> /*y*/) const {}
};

}  // namespace tumble
