// Chapter 1, Y(t): what the rows of the table make. For the table and the integrators only.
#pragma once

#include <memory>
#include <span>

#include "sim/ode/integrator.h"

namespace tumble {

std::unique_ptr<Stepper> makeEuler(int size, int order);
std::unique_ptr<Stepper> makeSymplecticEuler(int size, int order);
std::unique_ptr<Stepper> makeMidpoint(int size, int order);
std::unique_ptr<Stepper> makeRk4(int size, int order);
std::unique_ptr<Stepper> makeDopri5(int size, int order);

/// to = from + h rate, number by number.
inline void follow(std::span<const double> from, double h, std::span<const double> rate,
                   std::span<double> to) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] + h * rate[i];
}

}  // namespace tumble
