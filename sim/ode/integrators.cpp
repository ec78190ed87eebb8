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
     .keeps = {.symplectic = true, .manifold = true},
     .create = makeSymplecticEuler},
    {.name = "midpoint",
     .summary = "follow the derivative half-way for the whole step",
     .order = 2,
     .create = makeMidpoint},
    {.name = "implicit-midpoint",
     .summary = "follow the derivative at the middle between start and end, solved to rounding",
     .order = 2,
     .keeps = {.quadratic = true, .symplectic = true, .symmetric = true, .manifold = true},
     .create = makeImplicitMidpoint},
    {.name = "splitting2",
     .summary = "half a kick, a drift, half a kick: Stoermer-Verlet on particles",
     .order = 2,
     .needs = {.split = Split::Symmetric},
     .keeps = {.symplectic = true, .symmetric = true, .manifold = true},
     .create = makeSplitting2},
    {.name = "rk4",
     .summary = "weigh four derivatives: start, twice half-way, end",
     .order = 4,
     .create = makeRk4},
    {.name = "rkmk4",
     .summary = "rk4 in the Lie algebra: Y moves by rotations alone",
     .order = 4,
     .needs = {.lie = true},
     .keeps = {.manifold = true},
     .create = makeRkmk4},
    {.name = "splitting4",
     .summary = "Suzuki's five steps of splitting2, the third of them backwards",
     .order = 4,
     .needs = {.split = Split::Symmetric},
     .keeps = {.symplectic = true, .symmetric = true, .manifold = true},
     .create = makeSplitting4},
    {.name = "nystrom4",
     .summary = "seven kicks, six exact drifts: particles and bodies that do not tumble",
     .order = 4,
     .needs = {.split = Split::Exact},
     .keeps = {.symplectic = true, .symmetric = true, .manifold = true},
     .create = makeNystrom4},
    {.name = "taylor",
     .summary = "Taylor's series of the motion, cut off at course.order",
     .order = 12,
     .anyOrder = true,
     .hasDense = true,
     .needs = {.jet = true},
     .create = makeTaylor},
    {.name = "dopri5",
     .summary = "Dormand-Prince 5(4): divides a step until its error estimate is small",
     .order = 5,
     .adaptive = true,
     .hasDense = true,
     .create = makeDopri5},
    {.name = "extrapolation",
     .summary = "Gragg's midpoint rule, extrapolated to no substeps; divides a step like dopri5",
     .order = 10,
     .adaptive = true,
     .create = makeExtrapolation},
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
