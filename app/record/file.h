// Files, whole or not at all.
#pragma once

#include <stdexcept>
#include <string>

namespace tumble {

/// A file or folder that cannot be read or written: path and reason.
class FileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Writes the file by way of a temporary one beside it that is renamed when complete.
/// @throws FileError; nothing half-written is left.
void writeFile(const std::string& path, const std::string& content);

/// @throws FileError
std::string readFile(const std::string& path);

/// Makes the folder with those above it, unless it is there.
/// @throws FileError
void makeFolder(const std::string& path);

}  // namespace tumble
