#include <cassert>

#include "sim/ode/steppers.h"

namespace tumble {
namespace {

/// A symplectic Runge–Kutta–Nyström method: seven kicks b with six drifts a between them, read from
/// either end the same. Its coefficients make use of exact flows and of forces that depend on
/// positions alone, and so leave an error some hundred times smaller than that of `splitting4`
/// (Blanes and Moan, Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström methods,
/// 2002, method SRKN6b).
constexpr double kDrift[] = {0.245298957184271, 0.604872665711080};
constexpr double kKick[] = {0.0829844064174052, 0.396309801498368, -0.0390563049223486};
constexpr double kInnerDrift = 0.5 - (kDrift[0] + kDrift[1]);
constexpr double kMiddleKick = 1.0 - 2.0 * (kKick[0] + kKick[1] + kKick[2]);
constexpr double kDrifts[] = {kDrift[0], kDrift[1], kInnerDrift, kInnerDrift, kDrift[1], kDrift[0]};
constexpr double kKicks[] = {kKick[0], kKick[1], kKick[2], kMiddleKick,
                             kKick[2], kKick[1], kKick[0]};

class Nystrom4 : public Stepper {
 public:
  void step(const System& system, double t, double h, std::span<double> y) override {
    assert(system.offers().split == Split::Exact);
    double at = 0.0;  // share of the step that the drifts have covered
    for (int i = 0; i < 6; ++i) {
      system.kick(t + at * h, kKicks[i] * h, y);
      system.drift(t + at * h, kDrifts[i] * h, y);
      at += kDrifts[i];
    }
    system.kick(t + h, kKicks[6] * h, y);
    system.normalise(y);
  }
};

}  // namespace

std::unique_ptr<Stepper> makeNystrom4(int /*size*/, const Choices&) {
  return std::make_unique<Nystrom4>();
}

}  // namespace tumble
