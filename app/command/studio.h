// A renderer with the program's own shaders and fonts.
#pragma once

#include <memory>
#include <optional>

#include "app/scene/scene.h"
#include "render/context/context.h"
#include "render/font.h"
#include "render/renderer.h"

namespace tumble {

class Studio {
 public:
  /// Draws in the given format; width and height may be replaced. The first drawing opens OpenGL.
  /// @throws NoContext, FileError
  /// @param pageHeight  as in RenderOptions
  Image draw(const Picture& picture, const ImageFormat& format, double pageHeight = 720.0);
  /// Masks of the picture's bodies, as large as its image.
  Masks drawMasks(const Picture& picture, const ImageFormat& format);
  /// @throws NoContext, FileError
  Fonts& fonts();
  /// Opens OpenGL now, to learn before long work that it is there. @throws NoContext, FileError
  void open();

 private:
  std::unique_ptr<Context> context_;
  std::optional<Renderer> renderer_;
  std::optional<Fonts> fonts_;
};

}  // namespace tumble
