#include "sim/ode/integrator.h"
#include "sim/ode/steppers.h"

namespace tumble {
namespace {

constexpr Integrator kIntegrators[] = {
    {.name = "euler",
     .summary = "follow the derivative at the start for the whole step",
     .order = 1,
     .create = makeEuler},
    {.name = "symplectic-euler",
     .summary = "kick the momenta, then drift with the new velocities",
     .order = 1,
     .needs = {.split = Split::Rough},
     .keeps = {.symplectic = true},
     .create = makeSymplecticEuler},
    {.name = "midpoint",
     .summary = "follow the derivative half-way for the whole step",
     .order = 2,
     .create = makeMidpoint},
    {.name = "rk4",
     .summary = "weigh four derivatives: start, twice half-way, end",
     .order = 4,
     .create = makeRk4},
    {.name = "dopri5",
     .summary = "Dormand-Prince 5(4): divides a step until its error estimate is small",
     .order = 5,
     .adaptive = true,
     .hasDense = true,
     .create = makeDopri5},
};

}  // namespace

std::span<const Integrator> integrators() {
  return kIntegrators;
}

const Integrator* findIntegrator(std::string_view name) {
  for (const Integrator& row : kIntegrators) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

}  // namespace tumble
