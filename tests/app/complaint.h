// What is wrong with a scene, be it seen by the reader or by the world that is made of it.
#pragma once

#include <string>

#include "app/scene/scene.h"
#include "sim/world.h"

namespace tumble {

/// The first complaint, as people read it.
inline std::string complaint(const std::string& text) {
  try {
    const Scene scene = parseScene(text, "s.toml");
    try {
      const World world(scene.world);
    } catch (const Refusal& refusal) {
      return format(locate(scene, refusal));
    }
  } catch (const SceneError& error) {
    return format(error.diagnostics().front());
  }
  return "";
}

/// How many complaints there are of a scene.
inline std::size_t countOfComplaints(const std::string& text) {
  try {
    parseScene(text, "s.toml");
  } catch (const SceneError& error) {
    return error.diagnostics().size();
  }
  return 0;
}

}  // namespace tumble
