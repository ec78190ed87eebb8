// The next implicit step of what bends, whose points are held along the normals of
// the fixed bodies that they touch.
#pragma once

#include "app/claim/claim.h"
#include "sim/problem/held.h"

namespace tumble {

/// That step from a sample on, of all that bends in the scene:
///   (M + h D + h² K) Δv = h f − h² K v,   n·(v + Δv) = n·ṗ at points that touch a fixed body.
/// Baraff and Witkin, Large Steps in Cloth Simulation, 1998, eq. 6. Departure: none. Points
/// that are fixed are held whole; bodies that move are left out. Empty if nothing is held.
HeldProblem heldStep(const Scene& scene, const Sample& sample);

/// The sample of a recording at whose step most directions are held, or null.
const Sample* mostHeld(const Scene& scene, const Recording& recording);

}  // namespace tumble
