// Chapter 2, shape: surfaces of several pieces.
#pragma once

#include "sim/shape/polyhedron.h"

namespace tumble {

/// Which way round a closed surface runs, by Σ (p₀ − o)·(p₁ − o) × (p₂ − o) over all triangles, six
/// times its volume [m³]; o is its first point.
/// @return 1 if counter-clockwise seen from outside, −1 if inside out, 0 if the volume is less than
///         1e-12 of size × area, so that it may be rounding alone.
int sideOf(const Polyhedron& solid);

/// Refuses a surface whose pieces would be counted twice, or as less than nothing, by integrals
/// over its faces. A shell is a piece whose faces hang together by their points. Two shells lie
/// apart or one inside the other, and so each has a depth, the number of shells around it:
///   depth even  bounds the solid from outside: its own volume is > 0
///   depth odd   a cavity: its own volume is < 0
/// A shell of several that holds no volume bounds nothing, and is refused.
/// Tried at up to 64 points just inside each shell, 1e-4 of a face's width under it or deeper than
/// `touch` [m], so that surfaces that touch pass. Shells that cross between those points are not
/// found.
/// @throws NotASolid with one face of the shells that overlap, turn the wrong way or hold nothing.
void checkShells(const Polyhedron& solid, double touch = 0.0);

}  // namespace tumble
