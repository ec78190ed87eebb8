// What made the goldens: pixel hashes of every image, and the OpenGL that drew them.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "render/image.h"

namespace tumble {

/// The file golden/manifest.json.
struct Manifest {
  std::string glRenderer, glVersion, program;
  /// subject (a demo's name) → image name → hash of its pixels
  std::map<std::string, std::map<std::string, std::string>> images;
};

/// @throws FileError if the file cannot be read or is no manifest. A file that is not there is
/// empty.
Manifest readManifest(const std::string& path);
void writeManifest(const std::string& path, const Manifest& manifest);

/// Enters the images of the subjects that `now` has, and what drew them, into manifest.json of the
/// folder, and keeps what it says of others. Processes that do so at the same time wait for each
/// other. @throws FileError
void enterInManifest(const std::string& folder, const Manifest& now);

/// FNV-1a, 64 bits, of size and pixels; 16 hexadecimal digits.
/// Fowler, Noll, Vo, "The FNV Non-Cryptographic Hash Algorithm", draft-eastlake-fnv.
std::string pixelHash(const Image& image);

}  // namespace tumble
