#include <cassert>

#include "sim/ode/steppers.h"

namespace tumble {
namespace {

/// Symplectic Euler:  p' = p + h ṗ(x, p),  x' = x + h ẋ(x, p')
/// (Hairer, Lubich and Wanner, Geometric Numerical Integration, §I.1). Of first order, yet its
/// energy error stays bounded where explicit Euler's grows.
class SymplecticEuler : public Stepper {
 public:
  void step(const System& system, double t, double h, std::span<double> y) override {
    assert(system.offers().split != Split::None);
    system.kick(t, h, y);
    system.drift(t, h, y);
    system.normalise(y);
  }
};

}  // namespace

std::unique_ptr<Stepper> makeSymplecticEuler(int /*size*/, const Choices&) {
  return std::make_unique<SymplecticEuler>();
}

}  // namespace tumble
