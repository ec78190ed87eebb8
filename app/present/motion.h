// Arrows and axes that explain the motion of bodies: what the lectures draw beside a state.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// Of each moving body: from the origin its place x, from its centre the velocity v and F, the sum
/// of all forces on it; the largest v and F of the run `length` [m] long.
void addMotion(const Scene& scene, const Recording& recording, const Sample& sample, double length,
               Picture& picture);

/// The derivative Ω × (x − c) of what runs in a circular field, as arrows on a grid across its axis
/// that holds the bodies.
void addFields(const Scene& scene, const Sample& sample, Picture& picture);

/// The axes of the world at the origin and those of each box, and one corner of it:
///   p = R p₀ + x,
/// `length` [m] long.
void addAxes(const Scene& scene, const Sample& sample, double length, Picture& picture);

/// A cross at the centre of mass of each moving body; of one that is weighed by points, r to a few
/// of them. @param size  [m] of the cross
void addCentres(const Scene& scene, const Sample& sample, double size, Picture& picture);

}  // namespace tumble
