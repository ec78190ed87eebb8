// Where the program's own files are: demos, shaders, fonts, goldens.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tumble {

/// Folder of "demos", "meshes", "shaders", "fonts" or "golden": in $TUMBLE_DATA, else in
/// <prefix>/share/tumble beside the running program, else in the source tree.
/// @throws FileError naming the places that were tried.
std::string dataFolder(std::string_view kind);

/// Names of all demos, sorted.
std::vector<std::string> demoNames();

/// Path of the demo of that name, or of the file; what a SCENE argument means.
/// @throws SceneError if it is neither a demo nor a readable file.
std::string scenePath(const std::string& scene);

}  // namespace tumble
