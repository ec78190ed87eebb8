#include <cassert>

#include "sim/ode/steppers.h"

namespace tumble {
namespace {

class Splitting2 : public Stepper {
 public:
  void step(const System& system, double t, double h, std::span<double> y) override {
    assert(system.offers().split >= Split::Symmetric);
    strang(system, t, h, y);
    system.normalise(y);
  }
};

}  // namespace

void strang(const System& system, double t, double h, std::span<double> y) {
  system.kick(t, 0.5 * h, y);
  system.drift(t, h, y);
  system.kick(t + h, 0.5 * h, y);
}

std::unique_ptr<Stepper> makeSplitting2(int /*size*/, const Choices&) {
  return std::make_unique<Splitting2>();
}

}  // namespace tumble
