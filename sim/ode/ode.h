// Chapter 1, Y(t): the black box of the course (slides SD9–SD10), callable from C.
#pragma once

extern "C" {

/// Writes dY/dt at (t, y) into ydot.
typedef void (*dydt_func)(double t, double y[], double ydot[]);

/// Carries Y from t0 to t1 [s], forwards or backwards, by Dormand–Prince 5(4) at 1e-10 per substep:
/// what one step of the integrator "dopri5" over t1 − t0 gives, to the bit.
/// @param y0    Y(t0), `len` numbers, not changed
/// @param yend  receives Y(t1), `len` numbers; may be y0 itself
/// @param dydt  may read and write its own arguments only; never sees y0 or yend themselves
void ode(double y0[], double yend[], int len, double t0, double t1, dydt_func dydt);

}  // extern "C"

namespace tumble {
using ::dydt_func;
using ::ode;
}  // namespace tumble
