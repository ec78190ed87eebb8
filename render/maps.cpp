#include "render/maps.h"

namespace tumble {
namespace {

/// Outside the map every texel has this value.
void setBorder(float value) {
  const float border[4] = {value, value, value, value};
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
}

}  // namespace

void ShadowMap::resize(int size) {
  if (size == size_) return;
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size, size, 0, GL_DEPTH_COMPONENT,
               GL_UNSIGNED_INT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  setBorder(1.0f);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_, 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  gl::checkFramebuffer("the shadow map");
  size_ = size;
}

void ShadowMap::draw(const Bodies& bodies, const Stage& stage) {
  resize(stage.shadowMapSize);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size_, size_);
  glEnable(GL_DEPTH_TEST);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2.2f, 4.0f);
  bodies.drawFromLight();
  glDisable(GL_POLYGON_OFFSET_FILL);
}

AboveMap::AboveMap(const std::string& shaders)
    : blur_(shaders, "screen.vert", "blur.frag"),
      sharp_(gl::makeTexture()),
      between_(gl::makeTexture()),
      sharpTarget_(gl::makeFramebuffer()),
      betweenTarget_(gl::makeFramebuffer()),
      nothing_(gl::makeVertexArray()) {
  const std::pair<GLuint, GLuint> targets[] = {{sharp_, sharpTarget_}, {between_, betweenTarget_}};
  for (const auto& [texture, target] : targets) {
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kSize, kSize, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    setBorder(0.0f);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    gl::checkFramebuffer("the map from above");
  }
}

void AboveMap::blur(GLuint from, GLuint into, const Eigen::Vector2f& axis) const {
  glBindFramebuffer(GL_FRAMEBUFFER, into);
  glBindTexture(GL_TEXTURE_2D, from);
  blur_.set("axis", axis);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void AboveMap::draw(const Bodies& bodies, const Stage&) {
  // The largest value of each channel, whatever the order of bodies.
  glBindFramebuffer(GL_FRAMEBUFFER, sharpTarget_);
  glViewport(0, 0, kSize, kSize);
  glDisable(GL_DEPTH_TEST);
  glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  bodies.drawFromAbove();
  glBlendEquation(GL_FUNC_ADD);
  glDisable(GL_BLEND);

  // Two one-dimensional blurs, there and back.
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(nothing_);
  blur_.use();
  blur_.set("map", 0);
  blur(sharp_, betweenTarget_, {1.0f, 0.0f});
  blur(between_, sharpTarget_, {0.0f, 1.0f});
}

}  // namespace tumble
