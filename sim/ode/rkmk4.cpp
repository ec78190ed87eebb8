#include <algorithm>
#include <cassert>
#include <vector>

#include "sim/ode/steppers.h"

namespace tumble {
namespace {

/// The classical Runge–Kutta method in a Lie algebra: stages are increments, Y moves by the action
/// of the group alone and so never leaves its manifold.
///   k1 = a(t, Y),                                 k2 = a(t + h/2, exp(h/2 k1)·Y),
///   k3 = a(t + h/2, exp(h/2 k2 − h²/8 [k1, k2])·Y),  k4 = a(t + h, exp(h k3)·Y),
///   Y(t + h) = exp(h/6 (k1 + 2 k2 + 2 k3 + k4) − h²/12 [k1, k4])·Y
/// (Munthe-Kaas, Runge–Kutta Methods on Lie Groups, 1998; Hairer, Lubich and Wanner, Geometric
/// Numerical Integration, §IV.8).
class Rkmk4 : public Stepper {
 public:
  explicit Rkmk4(int size) : stage_(size) {}

  void step(const System& system, double t, double h, std::span<double> y) override {
    assert(system.offers().lie);
    const std::size_t n = static_cast<std::size_t>(system.algebraSize());
    for (std::vector<double>* v : {&k1_, &k2_, &k3_, &k4_, &u_, &bracket_}) v->resize(n);

    system.algebra(t, y, k1_);
    for (std::size_t i = 0; i < n; ++i) u_[i] = 0.5 * h * k1_[i];
    move(system, y);
    system.algebra(t + 0.5 * h, stage_, k2_);
    system.commutator(k1_, k2_, bracket_);
    for (std::size_t i = 0; i < n; ++i) u_[i] = 0.5 * h * k2_[i] - h * h / 8.0 * bracket_[i];
    move(system, y);
    system.algebra(t + 0.5 * h, stage_, k3_);
    for (std::size_t i = 0; i < n; ++i) u_[i] = h * k3_[i];
    move(system, y);
    system.algebra(t + h, stage_, k4_);
    system.commutator(k1_, k4_, bracket_);
    for (std::size_t i = 0; i < n; ++i)
      u_[i] =
          h / 6.0 * (k1_[i] + 2.0 * k2_[i] + 2.0 * k3_[i] + k4_[i]) - h * h / 12.0 * bracket_[i];
    system.act(u_, y);
    system.normalise(y);
  }

 private:
  /// stage = exp(u)·Y.
  void move(const System& system, std::span<const double> y) {
    std::copy(y.begin(), y.end(), stage_.begin());
    system.act(u_, stage_);
  }

  std::vector<double> stage_, k1_, k2_, k3_, k4_, u_, bracket_;
};

}  // namespace

std::unique_ptr<Stepper> makeRkmk4(int size, const Choices&) {
  return std::make_unique<Rkmk4>(size);
}

}  // namespace tumble
