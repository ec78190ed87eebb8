// Draws pictures: shadows, ghosts, glass, floor, arrows, text, into an own framebuffer.
#pragma once

#include <memory>
#include <string>

#include "render/context/context.h"
#include "render/image.h"
#include "render/mask.h"
#include "render/picture.h"

namespace tumble {

enum class AntiAlias { None, Msaa4, Ssaa2x2 };

struct RenderOptions {
  int width = 1280, height = 720;
  AntiAlias antialias = AntiAlias::Msaa4;
  int shadowMapSize = 1024;
  bool transparent = false;   ///< the image has an alpha channel and nothing behind what is drawn
  double lightScale = 1.0;    ///< [1] multiplies the key light
  double pageHeight = 720.0;  ///< [px] that the sizes of a picture are meant for: less draws text,
                              ///< lines and arrows larger
};

/// Owns shaders, meshes, fonts and framebuffers of one context.
class Renderer {
 public:
  /// @param shaders folder of the GLSL files
  /// @param fonts   folder with Lato-Regular.ttf, Lato-Bold.ttf, DejaVuSans.ttf
  /// @throws NoContext if a file is missing or a shader or framebuffer fails, with the driver's
  /// words.
  Renderer(Context& context, const std::string& shaders, const std::string& fonts);
  ~Renderer();

  Image draw(const Picture& picture, const RenderOptions& options);
  /// Its bodies alone, each in its own colour, and how far they are; without floor.
  Masks drawMasks(const Picture& picture, const RenderOptions& options);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tumble
