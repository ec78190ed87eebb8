#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "render/arrows.h"
#include "render/bodies.h"
#include "render/canvas.h"
#include "render/floor.h"
#include "render/font.h"
#include "render/lines.h"
#include "render/maps.h"
#include "render/mask_target.h"
#include "render/overlay.h"
#include "render/page.h"
#include "render/stage.h"
#include "render/targets.h"

namespace tumble {
namespace {

/// The part of the frame that bodies, lines and arrows can touch: only this is cleared and
/// resolved.
class Extent {
 public:
  explicit Extent(const Stage& stage) : stage_(stage) {}

  void add(const Eigen::Vector3d& point, double reach, double pixels) {
    const auto place = stage_.projection.project(point);
    const double nearest = place ? place->z() - reach : 0.0;
    if (nearest < stage_.projection.near()) {
      everything_ = true;
      return;
    }
    // A ball seen off the axis is longer than its radius by 1/cos² of the angle; 1.3 covers 60
    // degrees of field.
    const double radius = 1.3 * reach / (stage_.projection.pixelAtUnitDepth() * nearest) +
                          pixels * stage_.scale + 2.0;
    low_ = low_.cwiseMin(place->head<2>() - Eigen::Vector2d::Constant(radius));
    high_ = high_.cwiseMax(place->head<2>() + Eigen::Vector2d::Constant(radius));
  }

  gl::Rectangle rectangle() const {
    if (everything_) return {0, 0, stage_.width, stage_.height};
    const Eigen::Vector2d size(stage_.width, stage_.height);
    const Eigen::Vector2d low = low_.cwiseMax(0.0).cwiseMin(size),
                          high = high_.cwiseMin(size).cwiseMax(low);
    const int x0 = static_cast<int>(low.x()), x1 = static_cast<int>(std::ceil(high.x()));
    const int y0 = static_cast<int>(low.y()), y1 = static_cast<int>(std::ceil(high.y()));
    return {x0, stage_.height - y1, x1 - x0, y1 - y0};
  }

 private:
  const Stage& stage_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(1e9), high_ = Eigen::Vector2d::Constant(-1e9);
  bool everything_ = false;
};

/// What the floor can touch.
gl::Rectangle floorExtent(const Stage& stage) {
  Extent extent(stage);
  const int corners = 32;
  const double around = 2.0 * std::numbers::pi / corners;
  const double radius = FloorDisc::kFaded * stage.radius / std::cos(0.5 * around);
  for (int i = 0; i < corners; ++i)
    extent.add(
        stage.origin + radius * Eigen::Vector3d(std::cos(i * around), 0.0, std::sin(i * around)),
        0.0, 0.0);
  return extent.rectangle();
}

gl::Rectangle extentOf(const Picture& picture, const Stage& stage) {
  Extent extent(stage);
  for (const Instance& body : picture.instances) extent.add(body.position, reachOf(body), 1.0);
  for (const Polyline& line : picture.lines)
    if (line.stroke == Stroke::Solid)
      for (const Eigen::Vector3d& point : line.points) extent.add(point, 0.0, line.width);
  for (const Arrow& arrow : picture.arrows) {
    extent.add(arrow.base, 0.0, 4.0 * arrow.radius + 4.0);
    extent.add(arrow.tip, 0.0, 4.0 * arrow.radius + 4.0);
  }
  return extent.rectangle();
}

void checkOptions(const RenderOptions& options) {
  const int most = options.antialias == AntiAlias::Ssaa2x2 ? 8192 : 16384;
  if (options.width < 1 || options.height < 1 || options.width > most || options.height > most)
    throw std::invalid_argument("an image of " + std::to_string(options.width) + " x " +
                                std::to_string(options.height) + " pixels cannot be drawn; 1 to " +
                                std::to_string(most) + " each way can");
}

}  // namespace

struct Renderer::Parts {
  Context& context;
  Fonts fonts;
  StageBuffer stage;
  Bodies bodies;
  ShadowMap shadow;
  AboveMap above;
  FloorDisc floor;
  Lines lines;
  Arrows arrows;
  Targets targets;
  MaskTarget masks;

  Parts(Context& c, const std::string& shaders, const std::string& fontFolder)
      : context(c),
        fonts(fontFolder),
        bodies(shaders),
        above(shaders),
        floor(shaders),
        lines(shaders),
        arrows(shaders) {}

  void load(const Picture& picture, const Stage& s);
  Layer drawFloor(const Picture& picture, const Stage& s);
  Layer drawBodies(const Picture& picture, const Stage& s);
};

/// Sends everything to OpenGL and draws the two maps that all shading reads.
void Renderer::Parts::load(const Picture& picture, const Stage& s) {
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glEnable(GL_MULTISAMPLE);
  stage.load(s);
  bodies.load(picture, s);
  lines.load(picture.lines, s);
  arrows.load(picture.arrows, s);
  shadow.draw(bodies, s);
  above.draw(bodies, s);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, above.texture());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, shadow.texture());
}

Layer Renderer::Parts::drawFloor(const Picture& picture, const Stage& s) {
  if (!picture.floor.visible) return {};
  const gl::Rectangle place = floorExtent(s);
  if (place.empty()) return {};
  targets.beginFloor(place);
  glDisable(GL_DEPTH_TEST);
  floor.draw(picture.floor, s);
  return targets.readFloor(place);
}

Layer Renderer::Parts::drawBodies(const Picture& picture, const Stage& s) {
  const gl::Rectangle place = extentOf(picture, s);
  if (place.empty()) return {};
  targets.beginBodies(place);
  glEnable(GL_DEPTH_TEST);
  // Colour blends over, alpha adds up: the layer ends premultiplied.
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bodies.drawSolids();
  arrows.draw();
  bodies.drawGhosts();
  bodies.drawGlass();
  lines.draw();
  glDisable(GL_BLEND);
  return targets.readBodies(place);
}

Renderer::Renderer(Context& context, const std::string& shaders, const std::string& fonts) {
  context.makeCurrent();
  parts_ = std::make_unique<Parts>(context, shaders, fonts);
  gl::checkErrors("nothing yet, while the renderer was made");
}

Renderer::~Renderer() {
  try {
    parts_->context.makeCurrent();
  } catch (const NoContext&) {
    // The context is lost and its objects with it.
  }
}

Image Renderer::draw(const Picture& picture, const RenderOptions& options) {
  checkOptions(options);
  Parts& parts = *parts_;
  parts.context.makeCurrent();
  const Stage stage(picture, options);
  parts.targets.resize(stage.width, stage.height, stage.samples);

  // Maps, floor and bodies by OpenGL.
  parts.load(picture, stage);
  const Layer floor = parts.drawFloor(picture, stage);
  const Layer bodies = parts.drawBodies(picture, stage);
  gl::checkErrors("a picture");

  // Page and text by hand, so that they are the same on every driver.
  Image image = options.transparent ? composeFigure(stage.width, stage.height, floor, bodies)
                                    : composePage(stage.width, stage.height, floor, bodies);
  if (options.antialias == AntiAlias::Ssaa2x2) image = halved(image);
  straighten(image);
  Canvas canvas(image, parts.fonts, image.height / options.pageHeight);
  const Projection page(picture.camera, canvas.width(), canvas.height());
  drawOverlay(picture, page, canvas);
  return image;
}

Masks Renderer::drawMasks(const Picture& picture, const RenderOptions& options) {
  checkOptions(options);
  Parts& parts = *parts_;
  parts.context.makeCurrent();
  RenderOptions plain = options;
  plain.antialias = AntiAlias::None;
  const Stage stage(picture, plain);
  parts.stage.load(stage);
  parts.bodies.load(picture, stage);
  parts.masks.begin(stage.width, stage.height);
  glDisable(GL_CULL_FACE);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  parts.bodies.drawMasks();
  Masks masks = parts.masks.read();
  gl::checkErrors("masks");
  return masks;
}

}  // namespace tumble
