// Chapter 2, shape: closed surfaces whose corners were written with few digits.
#pragma once

#include "sim/shape/polyhedron.h"

namespace tumble {

/// Of the size of a mesh: a coarser last digit leaves no shape, and corners are what they say.
inline constexpr double kShape = 2e-3;

/// As makePolyhedron, but what overlaps by less than the digits leave open touches.
/// @param grain  [m] the last digit of the coordinates
Polyhedron makeWritten(std::vector<Vec3> points, std::vector<std::vector<int>> faces, double grain);

}  // namespace tumble
