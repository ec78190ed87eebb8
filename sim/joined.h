// Chapter 11: the joints that a world begins with.
#pragma once

#include <span>

#include "sim/method/model.h"

namespace tumble {

/// Makes the model's joints from its definition, and the pairs that they keep from touching.
/// @param bodies  at the start, in the order of the model
/// @throws Refusal for joints between bodies that are not there or do not move, anchors or axes
///         that are none, limits that the start does not obey, and bodies that begin with
///         velocities which a joint does not allow.
void joinBodies(Model& model, std::span<const RigidBody> bodies);

}  // namespace tumble
