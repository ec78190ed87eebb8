// A run as a glTF 2.0 file, for viewers, engines and notebooks.
#pragma once

#include <string>

#include "app/record/recording.h"

namespace tumble {

/// The bytes of a GLB: a node for each body with its motion as an animation, linear between
/// samples; bodies of one form share a mesh. Metres, Y up, the colours of the pictures in linear
/// light. What moves, weighs and touches is told by the extensions KHR_physics_rigid_bodies and
/// KHR_implicit_shapes, which viewers may ignore: mass, principal moments, velocities at the start,
/// a sphere, box, capsule, cylinder or convex mesh to collide with, friction and restitution.
///   Departure: friction mixes as the geometric mean here; there √μ stands, to be multiplied.
/// glTF 2.0 Specification, Khronos Group 2021, §3–§4; drafts of both extensions.
/// @param recording with at least one sample
std::string gltfBinary(const Scene& scene, const Recording& recording);

}  // namespace tumble
