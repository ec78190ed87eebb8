// Two maps drawn before the picture: depth from the light, and contact, height and cast shadow from
// above.
#pragma once

#include <string>

#include "render/bodies.h"
#include "render/gl.h"
#include "render/mesh.h"
#include "render/stage.h"

namespace tumble {

/// Depth of solid bodies as the light sees them. One texel is compared at a time: on a software
/// rasteriser nine such taps, weighted in the shader, cost no more than two filtered ones.
class ShadowMap {
 public:
  void draw(const Bodies& bodies, const Stage& stage);
  GLuint texture() const { return texture_; }

 private:
  void resize(int size);
  gl::Object texture_ = gl::makeTexture(), framebuffer_ = gl::makeFramebuffer();
  int size_ = 0;
};

/// One picture from above for three jobs, each the largest value over all bodies:
///   red    α exp(−y/c), contact shadow;  green  y/mapHeight, height for ambient occlusion;
///   blue   max(α, 0.35) exp(−2y/R), shadow flattened along the light, paler with height.
/// Blurred: σ = 3.2 texels for the first two, 0.9 for the third.
class AboveMap {
 public:
  explicit AboveMap(const std::string& shaders);
  void draw(const Bodies& bodies, const Stage& stage);
  GLuint texture() const { return sharp_; }

 private:
  static constexpr int kSize = 256;
  void blur(GLuint from, GLuint into, const Eigen::Vector2f& axis) const;
  gl::Program blur_;
  gl::Object sharp_, between_, sharpTarget_, betweenTarget_, nothing_;
};

}  // namespace tumble
