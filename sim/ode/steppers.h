// Chapter 1, Y(t): what the rows of the table make. For the table and the integrators only.
#pragma once

#include <memory>
#include <span>

#include "sim/ode/integrator.h"

namespace tumble {

std::unique_ptr<Stepper> makeEuler(int size, const Choices&);
std::unique_ptr<Stepper> makeSymplecticEuler(int size, const Choices&);
std::unique_ptr<Stepper> makeMidpoint(int size, const Choices&);
std::unique_ptr<Stepper> makeRk4(int size, const Choices&);
std::unique_ptr<Stepper> makeDopri5(int size, const Choices&);
std::unique_ptr<Stepper> makeExtrapolation(int size, const Choices&);
std::unique_ptr<Stepper> makeImplicitMidpoint(int size, const Choices&);
std::unique_ptr<Stepper> makeSplitting2(int size, const Choices&);
std::unique_ptr<Stepper> makeSplitting4(int size, const Choices&);
std::unique_ptr<Stepper> makeNystrom4(int size, const Choices&);
std::unique_ptr<Stepper> makeRkmk4(int size, const Choices&);
std::unique_ptr<Stepper> makeTaylor(int size, const Choices&);

/// Strang's splitting, the symmetric step that the splitting methods are composed of:
///   kick h/2 · drift h · kick h/2
/// On particles it is the method of Störmer and Verlet, on bodies that of Dullweber, Leimkuhler and
/// McLachlan. Does not normalise.
void strang(const System& system, double t, double h, std::span<double> y);

/// to = from + h rate, number by number.
inline void follow(std::span<const double> from, double h, std::span<const double> rate,
                   std::span<double> to) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] + h * rate[i];
}

}  // namespace tumble
