// Which body each pixel shows, and how far it is.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "render/image.h"
#include "render/picture.h"

namespace tumble {

/// One value a pixel, no smooth edges, so that no pixel shows a mixture of two bodies.
struct Masks {
  Image identity;  ///< colours of bodies as they are, unlit; black where there is none
  std::vector<float>
      depth;  ///< [m] along the sight, rows from top to bottom; 0 where there is none
};

/// The floor of a picture in masks, up to the horizon, where it hides what is behind it.
void addFloor(const Picture& picture, const Colour& colour, Masks& masks);

/// 16-bit grey, as masks of depth are kept.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<std::uint16_t> grey;  ///< rows from top to bottom
};

/// Writes a PNG of 16 bits a pixel, as writePng does.
void writePng(const std::string& path, const GreyImage& image,
              const std::map<std::string, std::string>& text = {});

}  // namespace tumble
