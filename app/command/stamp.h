// What is written into an image about its making, and whether a file is that image already.
#pragma once

#include <map>
#include <string>

#include "app/scene/scene.h"

namespace tumble {

/// Keys and values of a PNG's text chunks.
using Stamp = std::map<std::string, std::string>;

/// Version, a digest of the program and its shaders, scene line, a digest of the scene's file, and
/// the image: its size, rate and what it shows.
Stamp stampOf(const Scene& scene, const std::string& what);

/// Key of the metres that a level of grey stands for, in masks of depth.
inline const std::string kMetresOfLevel = "Metres";

/// Text chunks of a PNG that is whole; empty if the file is missing, broken or no PNG.
Stamp readStamp(const std::string& path);

}  // namespace tumble
