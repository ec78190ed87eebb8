#include "app/report/machine.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

namespace tumble {

namespace {

// The processor's name for itself.
std::string processorName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
      return line.substr(colon + 2);
  }
  return "unknown processor";
}

#ifdef __clang__
constexpr const char* kCompiler = "clang " __clang_version__;
#else
constexpr const char* kCompiler = "gcc " __VERSION__;
#endif

#ifdef NDEBUG
constexpr const char* kAssertions = "assertions off";
#else
constexpr const char* kAssertions = "assertions on";
#endif

}  // namespace

std::string machineLine() {
  return fmt::format("{}, {} processors; {}, {}, {}; tumble {}", processorName(),
                     std::thread::hardware_concurrency(), kCompiler, TUMBLE_BUILD, kAssertions,
                     TUMBLE_VERSION);
}

}  // namespace tumble
