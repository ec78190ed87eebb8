// What bends, as the page is told of it.
#pragma once

#include <nlohmann/json.hpp>

#include "app/record/recording.h"

namespace tumble {

/// Grains that the page counts places of points by, to a radius of what is seen: no coordinate is
/// off by more than half a grain, a twentieth of a pixel where 400 are the radius.
inline constexpr double kGrainsToRadius = 4096.0;

/// Where the points of cloths, soft bodies and furs are at each sample, and how surfaces go through
/// them: each sample's points in whole grains, those of a strand but its first from the one before;
/// strains, if the scene shows them, in 255 steps up to twice the strain of the last colour.
/// assets/page/bent.js draws by it. The point that a strand has inside its body is left out.
/// @param radius  [m] of what is seen; a grain is larger where 65535 would not reach
nlohmann::ordered_json bentJson(const Scene& scene, const Recording& recording, double radius);

}  // namespace tumble
