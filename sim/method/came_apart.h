// Chapter 9, method: the words that end a run in which a joint no longer holds.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "sim/method/model.h"

namespace tumble {

/// Which joint came apart, and what to do; empty if none did.
/// @param step  the key of the step that might be too long
std::string cameApart(const Model& model, std::span<const RigidBody> bodies, std::string_view step);

}  // namespace tumble
