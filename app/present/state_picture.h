// The start of a scene, with what is wrong with it.
#pragma once

#include <string>

#include "app/scene/scene.h"
#include "render/image.h"
#include "render/picture.h"
#include "sim/world.h"

namespace tumble {

/// The start of the scene's world and what is wrong with it.
/// @throws SceneError for a world that is refused for anything but its state
StartCheck checkedStart(const Scene& scene);

/// "\"ball\" is 50 mm inside \"floor\"": one sentence for a fault.
std::string faultText(const Scene& scene, const StateFault& fault);

/// The bodies as they start, rings where a layer of the state is wrong, and the name of the first
/// such layer, `top` [px] below the page's edge.
Picture statePicture(const Scene& scene, const StartCheck& check, double top = 104.0);

/// Turns the page of a state that is not legal red.
void redden(Image& image);

}  // namespace tumble
