// The points by which a body is weighed.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// In each moving body that is weighed by points, those that lie inside, as dots; of many, the
/// first that fit into a picture.
void addSamplePoints(const Scene& scene, const Sample& sample, Picture& picture);

}  // namespace tumble
