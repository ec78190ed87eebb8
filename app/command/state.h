// The start of a scene held against the layers of a legal state.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/scene/scene.h"

namespace tumble {

/// Prints each layer of the scene's start, ok or not, or appends it to `json`, and, if a folder is
/// named, writes state.png there. Exit code 1 if a layer is not ok. @throws SceneError
int checkState(const Scene& scene, const std::string& folder, nlohmann::ordered_json* json);

}  // namespace tumble
