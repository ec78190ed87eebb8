// One definition for each name: the linker takes any of two classes of one name without a word.
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/catch.h"
#include "tests/house/pattern.h"

namespace fs = std::filesystem;
using tumble::test::Pattern;

namespace {

using Places = std::map<std::string, std::vector<std::string>>;

/// Adds every class that a text defines where other files can see it.
void addClasses(std::istream& text, const std::string& place, Places& places) {
  static const Pattern definition(R"(^(class|struct|enum class|union) (\w+)( final)?( : | ?\{))");
  bool hidden = false;  // in a namespace without a name
  for (std::string line; std::getline(text, line);) {
    if (line == "namespace {") hidden = true;
    if (line == "}  // namespace") hidden = false;
    if (hidden) continue;
    if (const auto match = definition.first(line)) places[(*match)[2]].push_back(place);
  }
}

std::string clashes(const Places& places) {
  std::string found;
  for (const auto& [name, files] : places)
    if (files.size() > 1) {
      found += name + " is defined in";
      for (const std::string& file : files) found += " " + file;
      found += "\n";
    }
  return found;
}

}  // namespace

TEST_CASE("no two classes of sim, render and app have one name") {
  Places places;
  for (const char* room : {"sim", "render", "app"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(TUMBLE_SOURCE_DIR) / room)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".h" && ending != ".cpp") continue;
      std::ifstream text(entry.path());
      addClasses(text, entry.path().lexically_relative(TUMBLE_SOURCE_DIR).string(), places);
    }
  CHECK(places.size() > 200);
  CHECK(clashes(places) == "");
}

TEST_CASE("a second class of one name is found, unless no other file can see it") {
  Places places;
  std::istringstream first("struct Axis {\n  struct Tick {};\n};\nclass Far;\n");
  std::istringstream second(
      "namespace {\nclass Far : public Near {\n};\n}  // namespace\nclass Axis {\n};\n");
  addClasses(first, "a.h", places);
  addClasses(second, "b.cpp", places);
  CHECK(clashes(places) == "Axis is defined in a.h b.cpp\n");
}
