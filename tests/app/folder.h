// A folder for what a test leaves behind.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace tumble {

/// A folder of its own for each test, gone at the end.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("tumble-app-" + std::to_string(::getpid()));
  Folder() {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string operator/(const std::string& name) const { return (path / name).string(); }
};

}  // namespace tumble
