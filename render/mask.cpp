#include "render/mask.h"

#include <algorithm>
#include <cmath>

#include "render/camera.h"
#include "render/mask_target.h"

namespace tumble {
namespace {

void attach(GLuint renderbuffer, GLenum format, GLenum attachment, int width, int height) {
  glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
  glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, renderbuffer);
}

}  // namespace

void MaskTarget::begin(int width, int height) {
  if (width != width_ || height != height_) {
    identity_ = gl::makeRenderbuffer(), distance_ = gl::makeRenderbuffer();
    depth_ = gl::makeRenderbuffer(), framebuffer_ = gl::makeFramebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    attach(identity_, GL_RGBA8, GL_COLOR_ATTACHMENT0, width, height);
    attach(distance_, GL_R32F, GL_COLOR_ATTACHMENT1, width, height);
    attach(depth_, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, width, height);
    const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, both);
    gl::checkFramebuffer("masks of depth and identity");
    width_ = width, height_ = height;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

Masks MaskTarget::read() const {
  const std::size_t row = static_cast<std::size_t>(width_), count = row * height_;
  std::vector<std::uint8_t> rgba(4 * count);
  std::vector<float> distance(count);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  glReadPixels(0, 0, width_, height_, GL_RED, GL_FLOAT, distance.data());

  // OpenGL counts rows upwards.
  Masks masks;
  masks.identity = {width_, height_, std::vector<std::uint8_t>(3 * count)};
  masks.depth.resize(count);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height_); ++y) {
    for (std::size_t x = 0; x < row; ++x) {
      const std::size_t from = (static_cast<std::size_t>(height_) - 1 - y) * row + x,
                        to = y * row + x;
      std::copy_n(rgba.begin() + static_cast<std::ptrdiff_t>(4 * from), 3,
                  masks.identity.rgb.begin() + static_cast<std::ptrdiff_t>(3 * to));
      masks.depth[to] = distance[from];
    }
  }
  return masks;
}

void addFloor(const Picture& picture, const Colour& colour, Masks& masks) {
  const int width = masks.identity.width, height = masks.identity.height;
  const Projection projection(picture.camera, width, height);
  const double pixel = projection.pixelAtUnitDepth();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      // The point at unit depth on the ray through the middle of the pixel.
      const Eigen::Vector3d ray = projection.forward() +
                                  pixel * (x + 0.5 - 0.5 * width) * projection.right() -
                                  pixel * (y + 0.5 - 0.5 * height) * projection.up();
      const double depth = (picture.floor.height - projection.eye().y()) / ray.y();
      const std::size_t place = static_cast<std::size_t>(y) * width + x;
      float& known = masks.depth[place];
      if (!(depth > projection.near() && depth < projection.far())) continue;
      if (known > 0.0f && known <= depth) continue;
      known = static_cast<float>(depth);
      for (std::size_t c = 0; c < 3; ++c)
        masks.identity.rgb[3 * place + c] =
            static_cast<std::uint8_t>(std::lround(255.0f * colour[c]));
    }
  }
}

}  // namespace tumble
