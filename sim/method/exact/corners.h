// Contact points on faces at which the edges of two boxes cross, and which wander over both.
#pragma once

#include <vector>

#include "sim/method/state.h"

namespace tumble {

/// Ties contacts to the bodies of the state. A corner at which edges of two boxes cross follows
/// both; with a normal of its own, n = ± ea×eb, where they are about to lean against the face.
/// @param rest  [m/s] speed that is told from none
void tieCrossings(const State& state, double rest, std::vector<Contact>& contacts);

/// Contacts that are told as of a face, but where two edges of boxes cross that lean against it:
/// ties them to their edges, n = ± ea×eb. Of a pair that has such contacts, those are dropped whose
/// n does not lie between the faces beside both edges: there the solids are not outermost.
void tieLeaning(const State& state, std::vector<Contact>& contacts);

}  // namespace tumble
