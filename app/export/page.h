// A run as one HTML page that plays it.
#pragma once

#include <string>

#include "app/record/recording.h"

namespace tumble {

/// The page of assets/page with the run in it: poses, contact forces and points of what bends in 16
/// bits each, packed by zlib; events, claims with what was measured, the curves that they expect;
/// the shaders of the images, in which WebGL 2 draws it. It asks for nothing outside itself.
/// @param recording with at least one sample
/// @throws FileError if the page or a shader cannot be read.
std::string pageHtml(const Scene& scene, const Recording& recording);

}  // namespace tumble
