// Poses that a plan of the course did not let stand.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// Of each body, until t [s], the first pose that overlapped, in red, and an arrow to where its
/// plan put it, with the instants of both.
void addMissteps(const Scene& scene, const Recording& recording, double t, Picture& picture);

}  // namespace tumble
