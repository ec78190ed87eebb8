// What happens where bodies touch, as the lectures draw it: point velocities, impulses, springs.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// At each contact point the normal n, `length` [m] long, and the velocity ṗ of the body that
/// moves; beside the fastest of a pair n·ṗ, and what it makes of the contact: colliding, resting or
/// separating.
void addContactVelocities(const Scene& scene, const Sample& sample, double length,
                          Picture& picture);

/// At each impact up to t [s] an arrow j n, the largest of the run `length` [m] long.
void addImpulses(const Recording& recording, double t, double length, Picture& picture);

/// Below each body that can meet a floor of springs a coil that its lowest point presses together,
/// `length` [m] long where it does not.
void addSprings(const Scene& scene, const Sample& sample, double length, Picture& picture);

/// A see-through slab with its upper side at that height, under the middle of a motion of that
/// radius.
void addGel(double height, double thickness, const Vec3& centre, double radius, Picture& picture);

}  // namespace tumble
