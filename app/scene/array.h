// [[array]]: a template body, repeated.
#pragma once

#include "app/scene/body.h"

namespace tumble {

/// Expands each [[array]] to the bodies NAME.0, NAME.1, …, appended in order.
///   kind = "row"    the template's own position plus i·step
///   kind = "tower"  upward from base, the middle of its underside; each stands on the one before
///   kind = "wall"   rows × columns of boxes in running bond; see wall.cpp
///   kind = "rain"   count bodies at random places and orientations; see rain.cpp
///   kind = "fountain"  count bodies thrown from base with speed, within spread of the vertical,
///   each
///                   as old as a draw from ages says: x = base + v a + ½ g a²; see fountain.cpp
///   kind = "circle" count bodies evenly on a circle about the template's position, X along it;
///   kind = "spiral" the same on a spiral of Archimedes, equal chords from copy to copy;
///   kind = "rack"   balls in rows of 1, 2, 3, …, a triangle; see path.cpp
/// vary = { restitution = [0, 1], "shape.sphere" = [0.1, 0.2] } makes numbers of the template run
/// evenly from the first copy to the last.
/// @param gravity  [m/s²], for what is thrown
void readArrays(Section& root, const Materials& materials, std::uint64_t seed, const Vec3& gravity,
                BodyList& bodies);

}  // namespace tumble
