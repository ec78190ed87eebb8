#include <cassert>
#include <vector>

#include "sim/ode/steppers.h"

namespace tumble {
namespace {

/// Taylor's series of the solution, cut off at the chosen order p:
///   Y(t + h) = Σ c_k hᵏ,  k = 0 … p,
/// with the coefficients from the system's own recurrences (Moore, Interval Analysis, §11; Hairer,
/// Nørsett and Wanner, Solving Ordinary Differential Equations I, §I.8). The same polynomial is the
/// dense output.
class Taylor : public Stepper {
 public:
  Taylor(int size, int order)
      : size_(static_cast<std::size_t>(size)), order_(order), c_(size_ * (order + 1)) {}

  void step(const System& system, double t, double h, std::span<double> y) override {
    assert(system.offers().jet);
    system.jet(t, y, order_, c_);
    t_ = t;
    h_ = h;
    evaluate(h, y);
    system.normalise(y);
  }

  bool dense(double t, std::span<double> y) const override {
    const double s = t - t_;
    if (!(h_ < 0.0 ? s <= 0.0 && s >= h_ : s >= 0.0 && s <= h_)) return false;
    evaluate(s, y);
    return true;
  }

 private:
  /// Horner's rule, from the smallest term to the largest.
  void evaluate(double s, std::span<double> y) const {
    for (std::size_t i = 0; i < size_; ++i) {
      double sum = c_[order_ * size_ + i];
      for (int k = order_ - 1; k >= 0; --k) sum = c_[k * size_ + i] + s * sum;
      y[i] = sum;
    }
  }

  std::size_t size_;
  int order_;
  std::vector<double> c_;
  double t_ = 0.0, h_ = -1.0;
};

}  // namespace

std::unique_ptr<Stepper> makeTaylor(int size, const Choices& choices) {
  return std::make_unique<Taylor>(size, choices.order);
}

}  // namespace tumble
