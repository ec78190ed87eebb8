// All events of a run on one line of time, as a drawing to print.
#pragma once

#include <string>

#include "app/record/recording.h"
#include "app/scene/scene.h"
#include "render/font.h"

namespace tumble {

/// An SVG document 1280 px wide: a lane for each kind of event that happened, a stroke for each
/// event; those of impacts are as high as the root of their impulse.
std::string eventLineSvg(const Scene& scene, const Recording& recording, Fonts& fonts);

}  // namespace tumble
