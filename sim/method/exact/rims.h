// Rims of cylinders that touch a face: at the outermost point, wherever a list of points has
// theirs.
#pragma once

#include <vector>

#include "sim/method/state.h"

namespace tumble {

/// Ties contacts to the bodies of the state. A rim that leans and meets a face keeps one contact,
/// which follows its outermost point.
/// @param close  [m] of a rim, for a point that is on it
void tieRims(const State& state, double close, std::vector<Contact>& contacts);

}  // namespace tumble
