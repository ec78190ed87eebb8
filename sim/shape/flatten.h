// Chapter 2, shape: faces that the rounding of their corners has bent, flat again.
#pragma once

#include <optional>

#include "sim/shape/polyhedron.h"

namespace tumble {

/// A mesh whose corners have moved a little.
struct Flattened {
  Polyhedron solid;    ///< the same corners and faces, in the same frame
  double moved = 0.0;  ///< [m] by which a corner has moved at most
};

/// A mesh as it was before its corners were written with few digits. Faces that share a plane to
/// what the digits leave open (`faceGroups`) are flat, and their corners move by the least that
/// makes them so:
///   min Σ |Δx|²  with  n·(x + Δx) = d  for each corner x of each plane n·x = d, n and d free.
/// A surface without holes has twice as many of these equations as edges, and they are independent
/// (the realizations of a polyhedron of E edges are a manifold of E + 6 dimensions: Steinitz 1922),
/// so that Newton's method closes on a solution near by; a solution that is known to exist, as for
/// what was flat, lets it do so for others too.
/// @param grain  [m] the last digit of what is written: a coordinate is off by half of it
/// @return nothing for a mesh that is flat as it is: most corners of faces that share a plane are
///         of flat ones; a mesh that is rough, but has no flat one with all corners within three
///         grains and all faces, but those within a shared plane, looking the way they did, comes
///         back as it is
std::optional<Flattened> flattened(const Polyhedron& solid, double grain);

}  // namespace tumble
