// Contact points at which edges of boxes, or rims, cross, and which wander over both.
#pragma once

#include <vector>

#include "sim/method/state.h"

namespace tumble {

/// Ties contacts to the bodies of the state. A corner at which edges of boxes, or rims, cross
/// follows both; with a normal of its own, across both, where they are about to lean
/// against the face, or the rim leans little against the edge.
/// @param rest  [m/s] speed that is told from none
void tieCrossings(const State& state, double rest, std::vector<Contact>& contacts);

/// Contacts that are told as of a face, but where edges or rims cross that lean against it: ties
/// them to these, n across both. Of a pair that has such contacts, those are dropped whose n does
/// not lie between the faces beside both: there the solids are not outermost.
void tieLeaning(const State& state, std::vector<Contact>& contacts);

}  // namespace tumble
