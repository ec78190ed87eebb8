// Arrows that say what they are.
#pragma once

#include <string>

#include "render/picture.h"
#include "sim/math/vec.h"

namespace tumble {

/// An arrow from a point along a vector [m] with its name at the tip: to the right, above one that
/// points to the left; or, if asked for, to the left. None for a vector of no length.
void addNamedArrow(const Vec3& from, const Vec3& vector, const Colour& colour,
                   const std::string& name, Picture& picture, bool left = false);

}  // namespace tumble
