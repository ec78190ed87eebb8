// The title and subtitle above a chart or a page of panels.
#pragma once

#include <string>

#include "render/canvas.h"

namespace tumble {

/// [px] of type, the smallest that is read.
inline constexpr double kLegible = 10.0;

/// Each on as many lines as it takes, the subtitle below the title. In px of type.
class Heading {
 public:
  /// @param width  of the room
  /// @param most   lines of each; where these do not do, type is smaller
  Heading(Drawing& drawing, const std::string& title, const std::string& subtitle, double width,
          std::size_t most);

  /// How much lower it ends than one whose title and subtitle take a line each.
  double below() const;
  void draw(double left, Drawing& drawing) const;

 private:
  Drawing::Words title_, subtitle_;
};

}  // namespace tumble
