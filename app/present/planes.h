// Planes between bodies that are near each other.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// Between the nearest parts of any two bodies closer than half a part's radius, a see-through disc
/// of the plane that parts them: green if it is the plane of the sample before, orange if it was
/// sought anew, and in ink where the two touch and it is the contact plane.
/// @param k  which sample of the recording; those before say what is remembered
void addPlanes(const Scene& scene, const Recording& recording, int k, Picture& picture);

}  // namespace tumble
