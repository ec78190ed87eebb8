// Chapter 0, math: exponential decay, the same on every machine.
#pragma once

namespace tumble {

/// What becomes in one unit of time of a quantity that decays at the rate a ≥ 0 [1]:
///   left = e^{−a},   mean = (1 − e^{−a})/a = ∫ e^{−as} ds,   lag = (1 − mean)/a.
/// So with  ẏ = −a y + f  from y₀:  y(1) = left y₀ + mean f,  ∫ y = mean y₀ + lag f.
/// Made of additions, multiplications and powers of two alone, so that every compiler and library
/// gives the same bits. Each to within 4 units in the last place.
struct Decay {
  double left = 1.0, mean = 1.0, lag = 0.5;
};
Decay decay(double a);

}  // namespace tumble
