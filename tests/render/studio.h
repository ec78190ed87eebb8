// One renderer for all cases of a test program, and small views of its images.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "render/font.h"
#include "render/renderer.h"
#include "tests/catch.h"

namespace tumble {

inline const char* const kShaders = TUMBLE_SOURCE_DIR "/assets/shaders";
inline const char* const kFonts = TUMBLE_BINARY_DIR "/fonts";

inline Renderer& studio() {
  static const std::unique_ptr<Context> context = makeContext();
  static Renderer renderer(*context, kShaders, kFonts);
  return renderer;
}

inline Fonts& fonts() {
  static Fonts all(kFonts);
  return all;
}

/// As a picture is drawn where nothing else is asked for.
inline const RenderOptions kFull;

/// The size of goldens.
inline RenderOptions golden() {
  RenderOptions options;
  options.width = 480;
  options.height = 270;
  return options;
}

/// The three channels, 0 to 255.
inline std::array<int, 3> pixel(const Image& image, int x, int y) {
  const std::uint8_t* p = image.rgb.data() + 3 * (static_cast<std::size_t>(y) * image.width + x);
  return {p[0], p[1], p[2]};
}

/// Mean of the three channels, 0 to 255.
inline double brightness(const Image& image, int x, int y) {
  const std::uint8_t* p = image.rgb.data() + 3 * (static_cast<std::size_t>(y) * image.width + x);
  return (p[0] + p[1] + p[2]) / 3.0;
}

/// A camera that looks along −Z from (0, height, 10) with a field whose half has tangent 0.2:
/// a point at z = 0 stands 180 pixels per metre from the middle of a 1280 × 720 image.
inline Camera straight(double height) {
  Camera camera;
  camera.eye = {0.0, height, 10.0};
  camera.target = {0.0, height, 0.0};
  camera.fov = 2.0 * 11.309932474020213;  // 2 atan 0.2 [deg]
  return camera;
}

}  // namespace tumble
