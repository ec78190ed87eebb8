// The demos: scenes that a name is enough for.
#pragma once

#include <string>
#include <vector>

namespace tumble {

/// Names of all demos, sorted.
std::vector<std::string> demoNames();

/// Path of the demo of that name, or of the file; what a SCENE argument means.
/// @throws FileError if it is neither.
std::string scenePath(const std::string& scene);

}  // namespace tumble
