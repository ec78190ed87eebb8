// Demos with keys changed, and runs as they are shown.
#pragma once

#include <string>
#include <vector>

#include "app/file/data.h"
#include "app/record/recording.h"
#include "app/scene/scene.h"

namespace tumble {

inline Scene demo(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return readScene(dataFolder("demos") + "/" + name + ".toml", overrides);
}

inline Recording runOf(const Scene& scene) {
  return record(scene, scene.image.rate);
}

}  // namespace tumble
