// A scene with everything filled in, for programs that read trajectory.csv.
#pragma once

#include <string>

#include "app/scene/scene.h"

namespace tumble {

/// JSON: what bodies are – arrays expanded, hulls and meshes as points and faces in the body frame
/// – what they weigh, how they start, which of them ever move, their colours, joints, and what time
/// runs by. SI, Y up; quaternions are [w, x, y, z]. `assets/demos/README.md` lists the keys.
std::string sceneJson(const Scene& scene);

}  // namespace tumble
