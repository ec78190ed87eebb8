// Chapter 11: what bodies may stand beside each other when a world begins.
#pragma once

#include <span>

#include "sim/method/model.h"

namespace tumble {

/// Holds the start of a world against two rules: no two bodies overlap, and two whose shapes have
/// no contact rule stand apart with the boxes around them. Bodies that touch to rounding are fine.
/// @param bodies  at the start, in the order of the model
/// @throws Refusal with the names of the first pair that breaks a rule, and the depth.
void checkNeighbours(const Model& model, std::span<const RigidBody> bodies);

/// Whether some two bodies that can touch would rub.
bool anyFriction(const Model& model);

}  // namespace tumble
