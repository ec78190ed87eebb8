// Draws what Dear ImGui asks for, in any OpenGL 3.3 context: window or not.
#pragma once

#include <imgui.h>

#include "render/gl.h"
#include "render/image.h"

namespace tumble {

/// A texture that shows an Image in the user interface.
class UiTexture {
 public:
  UiTexture();
  ~UiTexture();
  UiTexture(const UiTexture&) = delete;
  UiTexture& operator=(const UiTexture&) = delete;

  void load(const Image& image);
  ImTextureID id() const;

 private:
  unsigned name_ = 0;
};

/// Shader, buffers and the texture of glyphs of one context.
class UiRenderer {
 public:
  /// Rasterises the fonts of the current ImGui context. @throws NoContext if a shader fails.
  UiRenderer();
  ~UiRenderer();
  UiRenderer(const UiRenderer&) = delete;
  UiRenderer& operator=(const UiRenderer&) = delete;

  /// Into framebuffer 0, the window's own.
  void drawToWindow(const ImDrawData& data);
  /// Into an own framebuffer of the size that the data has.
  Image drawToImage(const ImDrawData& data);

 private:
  void draw(const ImDrawData& data);
  void drawList(const ImDrawList& list, const ImDrawData& data);

  gl::Object program_;
  unsigned vertexArray_ = 0, vertices_ = 0, indices_ = 0;
  int scale_ = -1;
  UiTexture glyphs_;
};

}  // namespace tumble
