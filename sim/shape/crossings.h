// Chapter 2, shape: surfaces that cross themselves.
#pragma once

#include "sim/shape/polyhedron.h"

namespace tumble {

/// Refuses a surface of which an edge passes through the inside of a face, or through another edge
/// of the same face, decided exactly (`orientation`). Faces that touch do not cross, nor do those
/// that overlap by less than `touch` [m]; nor are those found whose edges meet just on each other.
/// @throws NotASolid with the face, or one of the two
void checkCrossings(const Polyhedron& solid, double touch = 0.0);

}  // namespace tumble
