#include "app/command/studio.h"

#include "app/file/data.h"

namespace tumble {

namespace {

AntiAlias antiAliasOf(const std::string& name) {
  if (name == "none") return AntiAlias::None;
  return name == "ssaa2x2" ? AntiAlias::Ssaa2x2 : AntiAlias::Msaa4;
}

}  // namespace

Studio::Studio()
    : context_(makeContext()),
      renderer_(*context_, dataFolder("shaders"), dataFolder("fonts")),
      fonts_(dataFolder("fonts")) {}

Image Studio::draw(const Picture& picture, const ImageFormat& format, double pageHeight) {
  RenderOptions options;
  options.width = format.width;
  options.height = format.height;
  options.pageHeight = pageHeight;
  options.antialias = antiAliasOf(format.antialias);
  return renderer_.draw(picture, options);
}

}  // namespace tumble
