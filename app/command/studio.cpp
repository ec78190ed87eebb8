#include "app/command/studio.h"

#include "app/file/data.h"

namespace tumble {

namespace {

AntiAlias antiAliasOf(const std::string& name) {
  if (name == "none") return AntiAlias::None;
  return name == "ssaa2x2" ? AntiAlias::Ssaa2x2 : AntiAlias::Msaa4;
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
  options.antialias = antiAliasOf(format.antialias);
  open();
  return renderer_->draw(picture, options);
}

}  // namespace tumble
