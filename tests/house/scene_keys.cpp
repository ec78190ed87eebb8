// The reference of scene files names every key that the readers know, and no other.
#include <filesystem>
#include <set>

#include "tests/catch.h"
#include "tests/house/pattern.h"
#include "tests/text_of.h"

namespace fs = std::filesystem;
using tumble::test::Pattern;
using tumble::test::textOf;

namespace {

/// What each match of the pattern has in the group of that number.
std::set<std::string> wordsOf(const std::string& text, const Pattern& pattern, std::size_t group) {
  std::set<std::string> words;
  for (const Pattern::Match& match : pattern.all(text)) words.insert(match[group]);
  return words;
}

// Words that the sources of app/scene ask for: read("key", …), find("key"), readColour(table,
// "key", …), and the rows of its tables, {"kind", readKind}.
std::set<std::string> knownKeys() {
  const Pattern asked(
      R"re((read|readLine|find|tables|readAim|readColour|readParameter|readVariant|bodyOf)\(\s*([a-z]+,\s*)?"([a-z_]+)")re");
  const Pattern row(R"re(\{"([a-z_]+)",\s*(read|make)[A-Z])re");
  std::set<std::string> keys;
  for (const auto& entry : fs::directory_iterator(TUMBLE_SOURCE_DIR "/app/scene")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = textOf(entry.path());
    keys.merge(wordsOf(text, asked, 3));
    keys.merge(wordsOf(text, row, 1));
  }
  return keys;
}

const std::string kReference = textOf(TUMBLE_SOURCE_DIR "/assets/demos/README.md");

}  // namespace

TEST_CASE("the reference of scene files names every key and kind") {
  const std::set<std::string> keys = knownKeys();
  REQUIRE(keys.size() > 100);
  for (const std::string& key : keys) {
    // Tables of the root stand in headings.
    const bool named = kReference.find("`" + key + "`") != std::string::npos ||
                       kReference.find("[" + key + "]") != std::string::npos ||
                       kReference.find("[" + key + ".NAME]") != std::string::npos;
    INFO("not in assets/demos/README.md: " << key);
    CHECK(named);
  }
}

TEST_CASE("the reference of scene files names no key that is unknown") {
  const std::set<std::string> keys = knownKeys();
  const Pattern cell("\n\\| ([^|]*) \\|"), word("`([a-z_]+)`");
  for (const std::string& first : wordsOf(kReference, cell, 1))
    for (const std::string& key : wordsOf(first, word, 1)) {
      INFO("unknown: " << key);
      CHECK(keys.contains(key));
    }
}

TEST_CASE("the reference of scene files names every check and every integrator") {
  const Pattern row("\n    \\{(\\.name = )?\"([a-z0-9-]+)\"");
  int count = 0;
  for (const char* table : {"app/claim/claim.cpp", "sim/ode/integrators.cpp"})
    for (const std::string& name :
         wordsOf(textOf(TUMBLE_SOURCE_DIR "/" + std::string(table)), row, 2)) {
      CAPTURE(table, name);
      CHECK(kReference.find("\n| \"" + name + "\" |") != std::string::npos);
      ++count;
    }
  CHECK(count > 20);
}
