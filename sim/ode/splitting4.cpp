#include <cassert>

#include "sim/ode/steppers.h"

namespace tumble {
namespace {

/// 1/(4 − 4^(1/3)).
constexpr double kOuter = 0.41449077179437573714;

/// Suzuki's composition of five symmetric steps, whose errors of third order cancel:
///   S(sh) S(sh) S((1 − 4s)h) S(sh) S(sh),   s = 1/(4 − ∛4)
/// (Suzuki, Fractal Decomposition of Exponential Operators, 1990). It asks of the kick and the
/// drift only that each can be undone, so it suits bodies whose free turn is itself a product.
class Splitting4 : public Stepper {
 public:
  void step(const System& system, double t, double h, std::span<double> y) override {
    assert(system.offers().split >= Split::Symmetric);
    const double outer = kOuter * h, middle = (1.0 - 4.0 * kOuter) * h;
    strang(system, t, outer, y);
    strang(system, t + outer, outer, y);
    strang(system, t + 2.0 * outer, middle, y);
    strang(system, t + 2.0 * outer + middle, outer, y);
    strang(system, t + h - outer, outer, y);
    system.normalise(y);
  }
};

}  // namespace

std::unique_ptr<Stepper> makeSplitting4(int /*size*/, const Choices&) {
  return std::make_unique<Splitting4>();
}

}  // namespace tumble
