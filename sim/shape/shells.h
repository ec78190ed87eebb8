// Chapter 2, shape: surfaces of several pieces.
#pragma once

#include "sim/shape/polyhedron.h"

namespace tumble {

/// Refuses a surface whose pieces would be counted twice, or as less than nothing, by integrals
/// over its faces. A shell is a piece whose faces hang together by their points. Two shells lie
/// apart or one inside the other, and so each has a depth, the number of shells around it:
///   depth even  bounds the solid from outside: its own volume is > 0
///   depth odd   a cavity: its own volume is < 0
/// Tried at up to 64 points just inside each shell, 1e-4 of a face's width under it, so that
/// surfaces that touch pass. Shells that cross between those points are not found.
/// @throws NotASolid with one face of the shells that overlap or turn the wrong way.
void checkShells(const Polyhedron& solid);

}  // namespace tumble
