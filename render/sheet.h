// Several images on one page: panels with frames, letters and captions.
#pragma once

#include <span>
#include <string>

#include "render/font.h"
#include "render/image.h"

namespace tumble {

struct Panel {
  Image image;
  std::string caption;  ///< in ink, behind the panel's letter
  std::string finding;  ///< below it, paler: as many lines as it takes
};

/// A page of panels in rows of `columns`, lettered a, b, c …, as large as they need.
/// @param panels  one or more, all of one size
/// @throws std::invalid_argument if there is none, sizes differ, or columns < 1.
Image drawSheet(std::span<const Panel> panels, int columns, const std::string& title,
                const std::string& subtitle, Fonts& fonts);

}  // namespace tumble
