// Chapter 6, problem: contacts that no velocities obey.
#pragma once

#include <vector>

#include "sim/problem/problem.h"

namespace tumble {

/// Whether contacts push against each other without end: λ of the cones (of an Equality of either
/// sign) with
///   Jᵀ λ = 0,  b·λ < 0,
/// so that no velocities at all have  u = J v + b  in the dual of the cones (Farkas): none obeys
/// the normals, or friction holds what has room to give way, as between jaws at less than its
/// angle. Bodies that do not move are part of b with their vStar; of the others vStar counts for
/// nothing; compliance is left out, and friction of what slides. Where there are such velocities,
/// the slowest of them in the measure of M has λᵀ J M⁻¹ Jᵀ λ = −b·λ;  where there are none,
/// Gauss–Seidel sweeps make λ grow for ever, and the left side stays behind the right, here by a
/// hundred.
/// @param rubs  false: normals alone
/// @return λ along the normal per cone; none where the contacts can be obeyed as far as sweeps tell
std::vector<double> endlessPush(const Problem& problem, bool rubs);

}  // namespace tumble
