// A whole file as a text.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace tumble::test {

inline std::string textOf(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace tumble::test
