// One error for each scene, from the poses that an engine leaves, against a closed form of the
// scene's own numbers.
#pragma once

#include <string>
#include <vector>

#include "app/scene/scene.h"
#include "sim/world.h"

namespace tumble::peers {

/// What was read of a run: all bodies at the start and after every `stride` steps.
struct Motion {
  double interval = 0.0;  ///< [s] between two looks
  std::vector<std::vector<BodySample>> looks;
};

/// A scene that engines are held to.
struct Trial {
  std::string name, file;              ///< of the scene, and its file in tests/peers/scenes
  std::vector<std::string> overrides;  ///< "key.path=value"
  std::string title, error;            ///< what it shows; what is measured, with its unit
  double (*measure)(const Scene& scene, const Motion& motion);
  std::vector<double> rates;                      ///< [1/s] steps a second, coarse to fine
  void (*prepare)(const Scene& scene) = nullptr;  ///< makes what all measures of it share, or none
};

const std::vector<Trial>& trials();

}  // namespace tumble::peers
