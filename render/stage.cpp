#include "render/stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tumble {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

int supersampling(const RenderOptions& options) {
  return options.antialias == AntiAlias::Ssaa2x2 ? 2 : 1;
}

Eigen::Vector3d keyLight(const Projection& projection) {
  const double azimuth = 38.0 * kDegree, elevation = 52.0 * kDegree;
  const Eigen::Vector3d towardsOnlooker = projection.right().cross(Eigen::Vector3d::UnitY());
  return std::cos(elevation) *
             (std::cos(azimuth) * towardsOnlooker - std::sin(azimuth) * projection.right()) +
         std::sin(elevation) * Eigen::Vector3d::UnitY();
}

}  // namespace

double contactReach(const Picture& picture) {
  double sum = 0.0;
  for (const Instance& body : picture.instances) sum += thicknessOf(body);
  const double mean =
      picture.instances.empty() ? 0.0 : sum / static_cast<double>(picture.instances.size());
  return std::clamp(mean, 0.02 * picture.radius, 0.08 * picture.radius);
}

namespace {

/// Orthographic, looking along the light at the ball that holds the scene.
Eigen::Matrix4d lightProjection(const Stage& stage) {
  const Eigen::Vector3d side = stage.light.cross(Eigen::Vector3d::UnitY()).normalized();
  const Eigen::Vector3d up = side.cross(stage.light);
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  const double scale = 1.0 / stage.radius;
  matrix.row(0) << scale * side.transpose(), -scale * side.dot(stage.centre);
  matrix.row(1) << scale * up.transpose(), -scale * up.dot(stage.centre);
  matrix.row(2) << -0.5 * scale * stage.light.transpose(),
      0.5 * scale * stage.light.dot(stage.centre);
  return matrix;
}

struct Block {
  std::array<float, 16> viewProjection, lightProjection;
  std::array<float, 4> eye, forward, light, extent, image;
};

std::array<float, 16> columns(const Eigen::Matrix4d& matrix) {
  std::array<float, 16> values;
  Eigen::Map<Eigen::Matrix4f>(values.data()) = matrix.cast<float>();
  return values;
}

std::array<float, 4> four(const Eigen::Vector3d& v, double w) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(w)};
}

}  // namespace

Stage::Stage(const Picture& picture, const RenderOptions& options)
    : width(options.width * supersampling(options)),
      height(options.height * supersampling(options)),
      samples(options.antialias == AntiAlias::Msaa4 ? 4 : 1),
      scale(height / options.pageHeight),
      projection(picture.camera, width, height),
      origin(picture.centre.x(), picture.floor.height, picture.centre.z()),
      light(keyLight(projection)),
      lightStrength(options.lightScale),
      radius(std::max(picture.radius, 1e-6)),
      centre(0.0, picture.centre.y() - picture.floor.height, 0.0),
      contactReach(tumble::contactReach(picture)),
      shadowMapSize(options.shadowMapSize),
      hasFloor(picture.floor.visible) {}

void StageBuffer::load(const Stage& stage) const {
  Eigen::Matrix4d toWorld = Eigen::Matrix4d::Identity();
  toWorld.topRightCorner<3, 1>() = stage.origin;
  const Projection& projection = stage.projection;
  const Block block = {
      columns(projection.matrix() * toWorld),
      columns(lightProjection(stage)),
      four(projection.eye() - stage.origin, projection.pixelAtUnitDepth()),
      four(projection.forward(), stage.scale),
      four(stage.light, stage.lightStrength),
      four({stage.radius, stage.mapHalfWidth(), stage.contactReach}, stage.mapHeight()),
      four({double(stage.width), double(stage.height), 1.0 / stage.shadowMapSize}, stage.hasFloor),
  };
  glBindBuffer(GL_UNIFORM_BUFFER, buffer_);
  glBufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, buffer_);
}

}  // namespace tumble
