#include <vector>

#include "sim/ode/steppers.h"

namespace tumble {
namespace {

/// Explicit midpoint rule:  Y(t + h) = Y + h f(t + h/2, Y + h/2 f(t, Y)).
class Midpoint : public Stepper {
 public:
  explicit Midpoint(int size) : k_(size), half_(size) {}

  void step(const System& system, double t, double h, std::span<double> y) override {
    system.derivative(t, y, k_);
    follow(y, 0.5 * h, k_, half_);
    system.derivative(t + 0.5 * h, half_, k_);
    follow(y, h, k_, y);
    system.normalise(y);
  }

 private:
  std::vector<double> k_, half_;
};

}  // namespace

std::unique_ptr<Stepper> makeMidpoint(int size, const Choices&) {
  return std::make_unique<Midpoint>(size);
}

}  // namespace tumble
