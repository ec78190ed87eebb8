// Contact points on faces that wander over both bodies: outermost points of rims, and corners where
// the edges of two faces cross.
#pragma once

#include <vector>

#include "sim/method/state.h"

namespace tumble {

/// Ties contacts to the bodies of the state. A rim that leans and meets a face keeps one contact,
/// which follows its outermost point. A corner at which edges of two boxes cross follows both; it
/// is told by a bend below 0.
/// @param close  [m] of a rim, for a point that is on it
void tieRims(const State& state, double close, std::vector<Contact>& contacts);

/// Contacts that are told as of a face, but where two edges of boxes cross that lean against it:
/// ties them to their edges, n = ± ea×eb. Of a pair that has such contacts, those are dropped whose
/// n does not lie between the faces beside both edges: there the solids are not outermost.
void tieLeaning(const State& state, std::vector<Contact>& contacts);

}  // namespace tumble
