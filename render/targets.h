// The framebuffers that a picture is drawn into, and what is read back from them.
#pragma once

#include <cstdint>
#include <vector>

#include "render/gl.h"

namespace tumble {

/// Premultiplied RGBA of part of the frame; rows upwards, as OpenGL counts. Its pixels stand until
/// the layer is read again.
struct Layer {
  gl::Rectangle place;
  const std::uint8_t* rgba = nullptr;
};

/// A layer for bodies, lines and arrows, with depth and several samples a pixel if wanted,
/// and a single-sampled one for the floor, which has no edges to smooth.
class Targets {
 public:
  /// @param samples  1, or 4 for multisampling
  /// @throws NoContext if the driver refuses.
  void resize(int width, int height, int samples);

  /// Clears `place`, restricts drawing to it, and makes the target current.
  void beginBodies(const gl::Rectangle& place);
  void beginFloor(const gl::Rectangle& place);

  /// Resolves and reads the layer back.
  Layer readBodies(const gl::Rectangle& place);
  Layer readFloor(const gl::Rectangle& place);

 private:
  using Pixels = std::vector<std::uint8_t>;  // kept: fresh memory costs more than what is read
  void begin(GLuint framebuffer, const gl::Rectangle& place) const;
  static Layer read(GLuint framebuffer, const gl::Rectangle& place, Pixels& into);

  int width_ = 0, height_ = 0, samples_ = 0;
  gl::Object colour_, depth_, bodies_;    // the layer of bodies
  gl::Object resolvedColour_, resolved_;  // its mean over samples; the floor before that
  Pixels bodyPixels_, floorPixels_;
};

}  // namespace tumble
