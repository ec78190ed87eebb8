// A picture's camera, light and lengths, ready for the shaders.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "render/camera.h"
#include "render/gl.h"
#include "render/picture.h"
#include "render/renderer.h"

namespace tumble {

/// Everything the passes share. Shaders work in metres about `origin`, the point of the floor below
/// the centre of the scene, so that single precision is enough wherever the scene stands.
struct Stage {
  Stage(const Picture& picture, const RenderOptions& options);

  int width, height;       ///< [px] that OpenGL draws: twice the image with 2×2 supersampling
  int samples;             ///< of each of them
  double scale;            ///< such pixels per pixel of the page
  Projection projection;   ///< of world points onto them
  Eigen::Vector3d origin;  ///< world [m]
  Eigen::Vector3d light;   ///< unit, towards the key light: 38° left of the onlooker, 52° high
  double lightStrength;
  double radius;           ///< [m] of the scene
  Eigen::Vector3d centre;  ///< of the scene, from the origin [m]
  double contactReach;     ///< [m] over which the shadow of contact fades: about half a body
  int shadowMapSize;
  bool hasFloor;  ///< near which the sky is less open

  double mapHalfWidth() const { return 1.35 * radius; }  ///< [m] of the map from above
  double mapHeight() const { return 1.2 * radius; }      ///< [m] that map shows at full scale
  Eigen::Vector3f toStage(const Eigen::Vector3d& point) const {
    return (point - origin).cast<float>();
  }
};

/// The uniform block of assets/shaders/stage.glsl.
class StageBuffer {
 public:
  StageBuffer() : buffer_(gl::makeBuffer()) {}
  /// Sends the stage to the block, for all passes that follow.
  void load(const Stage& stage) const;

 private:
  gl::Object buffer_;
};

}  // namespace tumble
