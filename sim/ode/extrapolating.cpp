// Extrapolation as a row of the table. What it cannot cross, Dormand and Prince's steps do.
#include "sim/ode/extrapolation.h"
#include "sim/ode/steppers.h"

namespace tumble {
namespace {

class Extrapolating : public Stepper {
 public:
  Extrapolating(int size, const Choices& choices)
      : extrapolation_(size, choices.tolerance), rest_(makeDopri5(size, choices)) {}

  void step(const System& system, double t, double h, std::span<double> y) override {
    const double done = extrapolation_.step(system, t, h, y);
    across_ = done == h;
    if (!across_) rest_->step(system, t + done, h - done, y);
  }
  bool withinTolerance() const override { return across_ || rest_->withinTolerance(); }

 private:
  Extrapolation extrapolation_;
  std::unique_ptr<Stepper> rest_;
  bool across_ = true;
};

}  // namespace

std::unique_ptr<Stepper> makeExtrapolation(int size, const Choices& choices) {
  return std::make_unique<Extrapolating>(size, choices);
}

}  // namespace tumble
