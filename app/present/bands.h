// Colours by a quantity on a surface: bands between lines on which it is the same.
#pragma once

#include <span>
#include <vector>

#include "render/picture.h"

namespace tumble {

/// Cuts a surface, on whose triangles a quantity is linear, where it passes from one of `bands`
/// even parts of [0, top] to the next. Corners that triangles share are cut alike.
/// @param values  per corner
/// @return the surface of each band, from the lowest on; some have no corners
std::vector<Facets> inBands(const Facets& facets, std::span<const double> values, double top,
                            int bands);

}  // namespace tumble
