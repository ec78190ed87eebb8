// The files that a fuzzer starts from, and those that once broke the reader.
#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/scene/scene.h"
#include "tests/catch.h"

namespace fs = std::filesystem;
using namespace tumble;

TEST_CASE("every file of the fuzzer's corpus is read or refused, with a place") {
  int read = 0, refused = 0;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(TUMBLE_SOURCE_DIR "/tests/fuzz/corpus")) {
    INFO(entry.path());
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    try {
      parseScene(text.substr(0, text.find('\0')), "s.toml");
      ++read;
    } catch (const SceneError& error) {
      for (const Diagnostic& diagnostic : error.diagnostics()) CHECK(diagnostic.place.line > 0);
      ++refused;
    }
  }
  CHECK(read >= 3);
  CHECK(refused >= 3);
}
