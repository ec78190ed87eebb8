// Where the program's own files are: demos, shaders, fonts, goldens.
#pragma once

#include <string>
#include <string_view>

namespace tumble {

/// Folder of "demos", "meshes", "shaders", "fonts", "page" or "golden": in $TUMBLE_DATA, else in
/// <prefix>/share/tumble beside the running program, else in the source tree.
/// @throws FileError naming the places that were tried.
std::string dataFolder(std::string_view kind);

}  // namespace tumble
