// Telling versions of bytes apart.
#pragma once

#include <cstdint>
#include <string_view>

namespace tumble {

/// FNV-1a, 64 bits (Fowler, Noll, Vo). No secret depends on it. To digest several parts as one,
/// start each with the digest of those before it.
inline std::uint64_t digest(std::string_view bytes, std::uint64_t start = 0xcbf29ce484222325u) {
  std::uint64_t hash = start;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  return hash;
}

}  // namespace tumble
