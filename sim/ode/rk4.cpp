#include <vector>

#include "sim/ode/steppers.h"

namespace tumble {
namespace {

/// The classical Runge–Kutta method:
///   k1 = f(t, Y),                    k2 = f(t + h/2, Y + h/2 k1),
///   k3 = f(t + h/2, Y + h/2 k2),     k4 = f(t + h, Y + h k3),
///   Y(t + h) = Y + h/6 (k1 + 2 k2 + 2 k3 + k4).
class Rk4 : public Stepper {
 public:
  explicit Rk4(int size) : k1_(size), k2_(size), k3_(size), k4_(size), stage_(size) {}

  void step(const System& system, double t, double h, std::span<double> y) override {
    system.derivative(t, y, k1_);
    follow(y, 0.5 * h, k1_, stage_);
    system.derivative(t + 0.5 * h, stage_, k2_);
    follow(y, 0.5 * h, k2_, stage_);
    system.derivative(t + 0.5 * h, stage_, k3_);
    follow(y, h, k3_, stage_);
    system.derivative(t + h, stage_, k4_);
    for (std::size_t i = 0; i < y.size(); ++i) {
      y[i] += h / 6.0 * (k1_[i] + 2.0 * k2_[i] + 2.0 * k3_[i] + k4_[i]);
    }
    system.normalise(y);
  }

 private:
  std::vector<double> k1_, k2_, k3_, k4_, stage_;
};

}  // namespace

std::unique_ptr<Stepper> makeRk4(int size, const Choices&) {
  return std::make_unique<Rk4>(size);
}

}  // namespace tumble
