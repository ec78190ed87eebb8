// The start of a scene, with what is wrong with it.
#pragma once

#include <string>

#include "app/scene/scene.h"
#include "render/image.h"
#include "render/picture.h"
#include "sim/world.h"

namespace tumble {

/// "\"ball\" is 50 mm inside \"floor\"": one sentence for a fault.
std::string faultText(const Scene& scene, const StateFault& fault);

/// The bodies as they start, rings where a layer of the state is wrong, and the name of the first
/// such layer.
Picture statePicture(const Scene& scene, const StartCheck& check);

/// Turns the page of a state that is not legal red.
void redden(Image& image);

}  // namespace tumble
