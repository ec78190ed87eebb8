// Chapter 6, problem: contacts that no velocities obey.
#pragma once

#include <vector>

#include "sim/problem/problem.h"

namespace tumble {

/// Whether normals push against each other without end: λ ≥ 0 (of an Equality of either sign) with
///   Jᵀ λ = 0,  b·λ < 0,
/// so that no velocities at all obey  u = J v + b ≥ 0  (Farkas). Bodies that do not move are part
/// of b with their vStar; of the others vStar counts for nothing, friction and compliance are left
/// out. Where there are such velocities, the slowest of them in the measure of M has λᵀ J M⁻¹ Jᵀ λ
/// = −b·λ;  where there are none, Gauss–Seidel sweeps make λ grow for ever, and the left side stays
/// behind the right, here by a hundred.
/// @return λ per cone, or nothing where the contacts can be obeyed as far as 2,000 sweeps tell
std::vector<double> endlessPush(const Problem& problem);

}  // namespace tumble
