// Whatever bytes stand in a scene file and behind --set: a checked scene or complaints, no third
// way.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "app/scene/override.h"
#include "app/scene/scene.h"

using namespace tumble;

namespace {

void need(bool holds) {
  if (!holds) std::abort();
}

// What the rest of the program takes for granted of a scene that was not refused.
void check(const Scene& scene) {
  const WorldDef& world = scene.world;
  need(!world.bodies.empty() && world.bodies.size() <= 100'000);
  need(scene.colours.size() == world.bodies.size() && scene.labels.size() == world.bodies.size() &&
       scene.backs.size() == world.bodies.size());
  need(world.gravity.allFinite() && world.duration > 0.0 && std::isfinite(world.duration));
  need(world.course.step > 0.0 && world.stepping.step > 0.0);
  for (const BodyDef& body : world.bodies) {
    need(body.position.allFinite() && body.velocity.allFinite() &&
         body.angularVelocity.allFinite());
    need(std::abs(body.orientation.norm() - 1.0) < 1e-12);
    need(body.restitution >= 0.0 && body.restitution <= 1.0 && body.friction >= 0.0);
    need(body.fixed || body.mass || body.density);
    need(!body.mass || (*body.mass > 0.0 && std::isfinite(*body.mass)));
  }
}

}  // namespace

// The text, then overrides, each behind a zero byte.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> parts(1);
  for (std::size_t i = 0; i < size; ++i) {
    if (data[i] == 0)
      parts.emplace_back();
    else
      parts.back() += static_cast<char>(data[i]);
  }
  try {
    check(parseScene(parts[0], "fuzz.toml", {parts.begin() + 1, parts.end()}));
  } catch (const SceneError& error) {
    need(!error.diagnostics().empty());
  } catch (const UsageError&) {
  }
  return 0;
}
