#include "sim/ode/ode.h"

#include <algorithm>
#include <vector>

#include "sim/ode/steppers.h"

namespace {

/// A C function seen as a system. It is handed a copy of Y, which it is free to spoil.
class BlackBox : public tumble::System {
 public:
  BlackBox(int len, dydt_func dydt) : dydt_(dydt), copy_(len) {}

  int size() const override { return static_cast<int>(copy_.size()); }

  void derivative(double t, std::span<const double> y, std::span<double> ydot) const override {
    std::copy(y.begin(), y.end(), copy_.begin());
    dydt_(t, copy_.data(), ydot.data());
  }

 private:
  dydt_func dydt_;
  mutable std::vector<double> copy_;
};

}  // namespace

void ode(double y0[], double yend[], int len, double t0, double t1, dydt_func dydt) {
  if (len <= 0) return;
  if (yend != y0) std::copy(y0, y0 + len, yend);
  tumble::makeDopri5(len, {})->step(BlackBox(len, dydt), t0, t1 - t0,
                                    {yend, static_cast<size_t>(len)});
}
