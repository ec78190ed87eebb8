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
  std::string finding;  ///< below it, paler; both on as many lines as they take
};

/// Width of a panel that takes the room of several and what is between them [px].
int spanningWidth(int width, int columns);

/// A page of panels in rows of `columns`, lettered a, b, c …, as large as they need. On a page
/// that is wider than a screen type is larger, so that it can be read where the page is scaled.
/// @param panels  one or more, all of one size, but for the last, which may be wider
/// @throws std::invalid_argument if there is none, sizes differ, the last has no room, or
///         columns < 1.
Image drawSheet(std::span<const Panel> panels, int columns, const std::string& title,
                const std::string& subtitle, Fonts& fonts);

}  // namespace tumble
