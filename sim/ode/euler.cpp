#include <vector>

#include "sim/ode/steppers.h"

namespace tumble {
namespace {

/// Explicit Euler:  Y(t + h) = Y + h f(t, Y)  (slide SD8).
class Euler : public Stepper {
 public:
  explicit Euler(int size) : k_(size) {}

  void step(const System& system, double t, double h, std::span<double> y) override {
    system.derivative(t, y, k_);
    follow(y, h, k_, y);
    system.normalise(y);
  }

 private:
  std::vector<double> k_;
};

}  // namespace

std::unique_ptr<Stepper> makeEuler(int size, const Choices&) {
  return std::make_unique<Euler>(size);
}

}  // namespace tumble
