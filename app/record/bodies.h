// The bodies of a sample, as physics has them.
#pragma once

#include <vector>

#include "app/record/recording.h"

namespace tumble {

/// Whether forces move the body: neither fixed nor a half-space.
bool moves(const BodyDef& body);

/// All bodies where a sample has them, moving as there; without forces.
std::vector<RigidBody> bodiesAt(const WorldDef& world, const Sample& sample);

/// The same with the forces and torques of the world, of contacts and of joints on them.
std::vector<RigidBody> loadedBodiesAt(const WorldDef& world, const Sample& sample);

}  // namespace tumble
