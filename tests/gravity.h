// The weight of things in the tests: downwards, along −Y.
#pragma once

#include "sim/math/vec.h"

namespace tumble::test {

inline constexpr double kG = 9.81;          // [m/s²]
inline const Vec3 kGravity(0.0, -kG, 0.0);  // [m/s²] world frame

}  // namespace tumble::test
