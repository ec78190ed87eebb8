// What joints look like, and what they exert.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// A dark pin at each anchor: a ball, or, of a hinge, along its axis through the body; a thin rod
/// along a distance; the rail of a slider.
/// @param size  [m] radius of what the picture shows
void addJoints(const Scene& scene, const Sample& sample, double size, Picture& picture);

/// Arrows of the force that each joint exerts on the one of its bodies that more joints part from
/// the world, on a where that is none; red if it points within 60 degrees of straight down, else
/// green, with its number beside it, negative where it is red; the same of contacts, one arrow a
/// pair, if these are shown.
/// @param metresPerNewton  of an arrow
void addJointForces(const Scene& scene, const Sample& sample, double metresPerNewton,
                    Picture& picture);

/// The largest force [N] of a joint in a run.
double largestJointForce(const Recording& recording);

}  // namespace tumble
