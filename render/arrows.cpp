#include "render/arrows.h"

namespace tumble {

namespace {

/// Opacity of what is seen through a body.
constexpr float kThrough = 0.5f;

}  // namespace

Arrows::Arrows(const std::string& shaders)
    : program_(shaders, "arrow.vert", "arrow.frag"), buffer_(gl::makeBuffer()) {}

void Arrows::load(const std::vector<Arrow>& arrows, const Stage& stage) {
  shafts_.clear();
  for (const Arrow& arrow : arrows) {
    // What is shorter than half a pixel has no direction to show.
    const auto base = stage.projection.project(arrow.base);
    const Eigen::Vector3d reach = arrow.tip - arrow.base;
    if (!base || reach.norm() < 0.5 * stage.projection.pixelAtUnitDepth() * base->z()) continue;
    const Eigen::Vector3f from = stage.toStage(arrow.base), along = reach.cast<float>();
    shafts_.push_back({{from.x(), from.y(), from.z()},
                       arrow.radius,
                       {along.x(), along.y(), along.z()},
                       {arrow.colour[0], arrow.colour[1], arrow.colour[2]}});
  }
  gl::upload(GL_ARRAY_BUFFER, buffer_, shafts_);
}

void Arrows::draw() const {
  if (shafts_.empty()) return;
  const auto drawAll = [&](float halo, float opacity) {
    program_.set("halo", halo);
    program_.set("opacity", opacity);
    mesh_.draw(buffer_, 10, {{2, 4, 0}, {3, 3, 4}, {4, 3, 7}}, 0, static_cast<int>(shafts_.size()));
  };
  program_.use();
  glEnable(GL_CULL_FACE);
  // First what bodies hide, through them and without a trace in the depths.
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  drawAll(0.0f, kThrough);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  drawAll(0.0f, 1.0f);
  // The rim is the inside of a thicker arrow: seen only where the arrow itself does not cover it.
  glCullFace(GL_FRONT);
  drawAll(1.3f, 1.0f);
  glCullFace(GL_BACK);
  glDisable(GL_CULL_FACE);
}

}  // namespace tumble
