// Colours of the plates, and who gets which.
#pragma once

#include <span>
#include <vector>

#include "app/scene/scene.h"
#include "render/picture.h"

namespace tumble {

/// 0xRRGGBB, sRGB.
constexpr Colour hex(unsigned rgb) {
  return {static_cast<float>(rgb >> 16 & 255) / 255.0f, static_cast<float>(rgb >> 8 & 255) / 255.0f,
          static_cast<float>(rgb & 255) / 255.0f};
}

namespace colour {
inline constexpr Colour kForce = hex(0xD5401A);     ///< forces and theory
inline constexpr Colour kVelocity = hex(0x0A63B0);  ///< velocities
inline constexpr Colour kInk = hex(0x2B2F36);       ///< normals, paths, text
inline constexpr Colour kQuiet = hex(0x5C636E);     ///< secondary text
inline constexpr Colour kAngular = hex(0xB15FD6);   ///< angular velocities and momenta
inline constexpr Colour kFixed = hex(0xB4BBC4);     ///< bodies that do not move
}  // namespace colour

/// The ramp from past (blue) to now (orange), evenly spaced.
std::span<const Colour> timeStops();
/// The part of cividis that stands out on paper: for an ordered parameter.
std::span<const Colour> cividisStops();
/// Linear between stops; u is held to [0, 1].
Colour ramp(std::span<const Colour> stops, double u);
/// Every channel times a factor.
Colour shade(const Colour& colour, float factor);

/// Colour of the i-th curve of a chart, dark enough for a thin line on paper.
Colour seriesColour(std::size_t i);

/// The colour of the half of body i with z < 0 in its frame, if it has one of its own.
std::optional<Colour> backOf(const Scene& scene, std::size_t i);
bool anyBack(const Scene& scene);

/// The back of a cloth that has no colour for it: paler than its front, for it is seen in shadow;
/// of a pale front, darker.
Colour backOfCloth(const Colour& front);

/// A colour for every body: the scene's own; else that of its kind – body, array or surface – in
/// order of first use; fixed ones grey.
std::vector<Colour> bodyColours(const Scene& scene);

}  // namespace tumble
