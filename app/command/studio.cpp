#include "app/command/studio.h"

#include "app/file/data.h"

namespace tumble {

namespace {

AntiAlias antiAliasOf(const ImageFormat& format) {
  const bool byQuality = format.antialias.empty();
  if (byQuality ? format.quality == "low" : format.antialias == "none") return AntiAlias::None;
  const bool best = byQuality ? format.quality == "high" : format.antialias == "ssaa2x2";
  return best ? AntiAlias::Ssaa2x2 : AntiAlias::Msaa4;
}

}  // namespace

void Studio::open() {
  if (renderer_) return;
  context_ = makeContext();
  renderer_.emplace(*context_, dataFolder("shaders"), dataFolder("fonts"));
  fonts_.emplace(dataFolder("fonts"));
}

Fonts& Studio::fonts() {
  open();
  return *fonts_;
}

Image Studio::draw(const Picture& picture, const ImageFormat& format, double pageHeight) {
  RenderOptions options;
  options.width = format.width;
  options.height = format.height;
  options.pageHeight = pageHeight;
  options.antialias = antiAliasOf(format);
  if (format.quality == "low") options.shadowMapSize /= 2;
  if (format.quality == "high") options.shadowMapSize *= 2;
  options.transparent = format.transparent;
  open();
  return renderer_->draw(picture, options);
}

Masks Studio::drawMasks(const Picture& picture, const ImageFormat& format) {
  open();
  return renderer_->drawMasks(picture, {.width = format.width, .height = format.height});
}

}  // namespace tumble
