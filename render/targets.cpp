#include "render/targets.h"

#include <string>

namespace tumble {
namespace {

void attach(GLuint renderbuffer, GLenum format, GLenum attachment, int samples, int width,
            int height) {
  glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width,
                                   height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, renderbuffer);
}

}  // namespace

void Targets::resize(int width, int height, int samples) {
  if (width == width_ && height == height_ && samples == samples_) return;
  width_ = 0;  // stays so if the driver refuses below
  colour_ = gl::makeRenderbuffer();
  depth_ = gl::makeRenderbuffer();
  bodies_ = gl::makeFramebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, bodies_);
  attach(colour_, GL_RGBA8, GL_COLOR_ATTACHMENT0, samples, width, height);
  attach(depth_, GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT, samples, width, height);
  const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  gl::checkFramebuffer(size +
                       (samples > 1 ? ", " + std::to_string(samples) + " samples each" : ""));

  resolvedColour_ = gl::makeRenderbuffer();
  resolved_ = gl::makeFramebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_);
  attach(resolvedColour_, GL_RGBA8, GL_COLOR_ATTACHMENT0, 1, width, height);
  gl::checkFramebuffer(size);
  width_ = width, height_ = height, samples_ = samples;
}

void Targets::begin(GLuint framebuffer, const gl::Rectangle& place) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width_, height_);
  glEnable(GL_SCISSOR_TEST);
  glScissor(place.x, place.y, place.width, place.height);
  glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
}

void Targets::beginBodies(const gl::Rectangle& place) {
  begin(bodies_, place);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void Targets::beginFloor(const gl::Rectangle& place) {
  begin(resolved_, place);
  glClear(GL_COLOR_BUFFER_BIT);
}

Layer Targets::readBodies(const gl::Rectangle& place) {
  glDisable(GL_SCISSOR_TEST);
  if (samples_ <= 1) return read(bodies_, place, bodyPixels_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, bodies_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
  const int right = place.x + place.width, top = place.y + place.height;
  glBlitFramebuffer(place.x, place.y, right, top, place.x, place.y, right, top, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  return read(resolved_, place, bodyPixels_);
}

Layer Targets::readFloor(const gl::Rectangle& place) {
  return read(resolved_, place, floorPixels_);
}

Layer Targets::read(GLuint framebuffer, const gl::Rectangle& place, Pixels& into) {
  into.resize(4u * static_cast<std::size_t>(place.width) * place.height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(place.x, place.y, place.width, place.height, GL_RGBA, GL_UNSIGNED_BYTE, into.data());
  return {place, into.data()};
}

}  // namespace tumble
