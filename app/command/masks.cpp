#include "app/command/masks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/present/bent.h"
#include "app/present/bodies.h"
#include "app/present/palette.h"

namespace tumble {

namespace {

// The scene with each body in the colour that stands for it, on both sides.
Scene inIdentityColours(const Scene& scene) {
  Scene flat = scene;
  flat.colours.assign(scene.world.bodies.size(), std::nullopt);
  for (std::size_t i = 0; i < flat.colours.size(); ++i)
    flat.colours[i] = identityColour(static_cast<int>(i));
  flat.backs.clear();
  for (BentDef& bent : flat.bent) bent.colour = bent.back = identityColour(bent.first);
  flat.show.speed = false;
  flat.checks.clear();
  flat.expects.clear();
  return flat;
}

// Sixteen bits for six times the distance of what the camera looks at.
GreyImage greyOf(const Masks& masks, double metres) {
  GreyImage image{masks.identity.width, masks.identity.height, {}};
  for (const float depth : masks.depth)
    image.grey.push_back(depth > 0.0f ? static_cast<std::uint16_t>(
                                            std::clamp(std::lround(depth / metres), 1L, 65535L))
                                      : std::uint16_t{0});
  return image;
}

std::array<int, 3> bytesOf(const Rgb& colour) {
  std::array<int, 3> bytes;
  for (std::size_t c = 0; c < 3; ++c) bytes[c] = static_cast<int>(std::lround(255.0 * colour[c]));
  return bytes;
}

}  // namespace

// An odd factor maps the numbers below 2²⁴ onto themselves, one to one, and 0 alone to 0.
Rgb identityColour(int body) {
  const unsigned number = (static_cast<unsigned>(body) + 1u) * 0x9E3779u & 0xFFFFFFu;
  return {(number >> 16) / 255.0, (number >> 8 & 255u) / 255.0, (number & 255u) / 255.0};
}

std::string maskPath(const std::string& imagePath, const std::string& mask) {
  const std::size_t dot = imagePath.rfind('.');
  return imagePath.substr(0, dot) + "." + mask + imagePath.substr(dot);
}

MaskDrawer::MaskDrawer(const Scene& scene, const Recording& recording, Studio& studio)
    : scene_(scene),
      flat_(inIdentityColours(scene)),
      studio_(studio),
      presenter_(flat_, recording) {}

void MaskDrawer::write(int k, const std::string& imagePath, const Stamp& identity,
                       const Stamp& depth) {
  const Picture picture = presenter_.bodiesAlone(k);
  Masks masks = studio_.drawMasks(picture, scene_.image);
  const std::vector<BodyDef>& bodies = scene_.world.bodies;
  const auto floor = std::find_if(bodies.begin(), bodies.end(), isFloor);
  if (picture.floor.visible && floor != bodies.end()) {
    Colour colour;
    std::ranges::copy(identityColour(static_cast<int>(floor - bodies.begin())), colour.begin());
    addFloor(picture, colour, masks);
  }
  writePng(maskPath(imagePath, "identity"), masks.identity, identity);
  const double metres = 6.0 * (picture.camera.eye - picture.camera.target).norm() / 65535.0;
  Stamp scaled = depth;
  scaled[kMetresOfLevel] = fmt::format("{:.17g}", metres);
  writePng(maskPath(imagePath, "depth"), greyOf(masks, metres), scaled);
}

std::string MaskDrawer::legend() const {
  std::string text = "body,red,green,blue\n";
  const auto add = [&](const std::string& name, int body) {
    const std::array<int, 3> bytes = bytesOf(identityColour(body));
    text += fmt::format("{},{},{},{}\n", name, bytes[0], bytes[1], bytes[2]);
  };
  const std::vector<bool> inSurface = partsOfSurfaces(scene_);
  for (std::size_t i = 0; i < scene_.world.bodies.size(); ++i)
    if (!inSurface[i]) add(scene_.world.bodies[i].name, static_cast<int>(i));
  for (const BentDef& bent : scene_.bent) add(bent.name, bent.first);
  return text;
}

}  // namespace tumble
