// A renderer with the program's own shaders and fonts.
#pragma once

#include <memory>

#include "app/scene/scene.h"
#include "render/context/context.h"
#include "render/font.h"
#include "render/renderer.h"

namespace tumble {

class Studio {
 public:
  /// @throws NoContext, FileError
  Studio();

  /// Draws in the given format; width and height may be replaced.
  /// @param pageHeight  as in RenderOptions
  Image draw(const Picture& picture, const ImageFormat& format, double pageHeight = 720.0);
  Fonts& fonts() { return fonts_; }

 private:
  std::unique_ptr<Context> context_;
  Renderer renderer_;
  Fonts fonts_;
};

}  // namespace tumble
