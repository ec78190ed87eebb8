#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/ode/steppers.h"

namespace tumble {
namespace {

/// Iterations, and how many of them in a row may fail to come closer before rounding is to blame.
constexpr int kMostIterations = 200, kPatience = 3;
/// A change that is larger than this beside Y when the iteration ends means that it did not
/// converge.
constexpr double kConverged = 1e-11;

/// The implicit midpoint rule, solved to rounding by fixed-point iteration:
///   Y(t + h) = Y + h f(t + h/2, Z),   Z = ½ (Y + Y(t + h)).
/// Symplectic, symmetric, and it keeps every quadratic invariant (Hairer, Lubich and Wanner,
/// Geometric Numerical Integration, §IV.2, §VIII.6). Converges while h times the steepest slope of
/// f is below 2.
class ImplicitMidpoint : public Stepper {
 public:
  explicit ImplicitMidpoint(int size) : k_(size), middle_(size) {}

  void step(const System& system, double t, double h, std::span<double> y) override {
    std::copy(y.begin(), y.end(), middle_.begin());
    double change = std::numeric_limits<double>::infinity(), least = change, size = 0.0;
    for (int i = 0, stalled = 0; i < kMostIterations && stalled < kPatience && change != 0.0; ++i) {
      system.derivative(t + 0.5 * h, middle_, k_);
      change = size = 0.0;
      for (std::size_t n = 0; n < y.size(); ++n) {
        const double next = y[n] + 0.5 * h * k_[n];
        change = std::max(change, std::abs(next - middle_[n]));
        size = std::max(size, std::abs(next));
        middle_[n] = next;
      }
      if (!std::isfinite(change)) break;
      stalled = change < least ? 0 : stalled + 1;
      least = std::min(least, change);
    }
    withinTolerance_ = change <= kConverged * size;
    follow(y, h, k_, y);
    system.normalise(y);
  }

  bool withinTolerance() const override { return withinTolerance_; }

 private:
  std::vector<double> k_, middle_;
  bool withinTolerance_ = true;
};

}  // namespace

std::unique_ptr<Stepper> makeImplicitMidpoint(int size, const Choices&) {
  return std::make_unique<ImplicitMidpoint>(size);
}

}  // namespace tumble
