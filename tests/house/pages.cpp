// The pages keep their word: what they point at is there.
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/catch.h"
#include "tests/house/pattern.h"
#include "tests/text_of.h"

namespace fs = std::filesystem;
using tumble::test::Pattern;
using tumble::test::textOf;

namespace {

const fs::path kRoot = TUMBLE_SOURCE_DIR;

/// What each match of the pattern has in its first group.
std::vector<std::string> found(const std::string& text, const char* pattern) {
  std::vector<std::string> all;
  for (const Pattern::Match& match : Pattern(pattern).all(text)) all.push_back(match[1]);
  return all;
}

/// A page from one heading to the next.
std::string section(const std::string& page, const std::string& heading) {
  const std::size_t start = page.find("## " + heading);
  if (start == std::string::npos) return "";
  return page.substr(start, page.find("\n## ", start) - start);
}

/// The names of all test cases of a room.
std::string casesOf(const std::string& room) {
  std::string names;
  for (const auto& entry : fs::directory_iterator(kRoot / "tests" / room))
    if (entry.path().extension() == ".cpp")
      for (const std::string& name : found(textOf(entry.path()), R"re(TEST_CASE\(\s*"([^"]+)")re"))
        names += "\n" + name + "\n";
  return names;
}

/// Whether a room has a case of that name; "… rest" is the end of one.
bool hasCase(const std::string& room, const std::string& name) {
  const std::string ellipsis = "… ";
  return name.starts_with(ellipsis)
             ? casesOf(room).find(name.substr(ellipsis.size()) + "\n") != std::string::npos
             : casesOf(room).find("\n" + name + "\n") != std::string::npos;
}

}  // namespace

TEST_CASE("every link and picture of a page is there") {
  int count = 0;
  for (const char* page : {"README.md", "API.md", "sim/README.md", "render/README.md",
                           "app/README.md", "assets/demos/README.md", "assets/report/README.md"}) {
    const std::vector<std::string> links = found(textOf(kRoot / page), R"(\]\(([^)#:]+)\))");
    for (const std::string& link : links) {
      CAPTURE(page, link);
      CHECK(fs::exists(kRoot / fs::path(page).parent_path() / link));
      ++count;
    }
  }
  CHECK(count > 5);
}

TEST_CASE("every row of a table has as many cells as its head") {
  for (const char* page : {"README.md", "sim/README.md", "sim/TOLERANCES.md", "render/README.md",
                           "app/README.md", "assets/demos/README.md", "assets/report/README.md"}) {
    std::istringstream lines(textOf(kRoot / page));
    std::size_t head = 0, rows = 0;
    for (std::string line; std::getline(lines, line);) {
      std::size_t bars = 0;
      for (std::size_t i = 0; i < line.size(); ++i)
        bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
      if (!line.starts_with('|')) bars = 0;
      CAPTURE(page, line);
      if (head > 0 && bars > 0) CHECK(bars == head);
      head = bars;
      rows += bars > 0;
    }
    CHECK(rows > 3);
  }
}

TEST_CASE("every number of the certificate is told what it says") {
  const std::string table = section(textOf(kRoot / "sim/README.md"), "The certificate");
  const std::vector<std::string> keys =
      found(textOf(kRoot / "sim/method/report.h"), R"re(\{"(\w+)", &Certificate::)re");
  CHECK(keys.size() > 30);
  for (const std::string& key : keys) {
    CAPTURE(key);
    CHECK(table.find("`" + key + "`") != std::string::npos);
  }
}

TEST_CASE("every file that the way from slide to file names is there") {
  const std::string table = section(textOf(kRoot / "sim/README.md"), "From slide to file");
  const std::vector<std::string> files = found(table, R"(`([a-zA-Z0-9_/]+\.(h|cpp))`)");
  CHECK(files.size() > 20);
  for (const std::string& file : files) {
    CAPTURE(file);
    CHECK(fs::exists(kRoot / "sim" / file));
  }
}

TEST_CASE("every file that the maps of the program and of its pictures name is there") {
  for (const std::string room : {"app", "render"}) {
    const std::vector<std::string> files =
        found(textOf(kRoot / room / "README.md"), R"(`([a-z_/]+\.(h|cpp))`)");
    CHECK(files.size() > 15);
    for (const std::string& file : files) {
      CAPTURE(room, file);
      bool there = fs::exists(kRoot / room / file) || fs::exists(kRoot / file);
      for (const auto& folder : fs::directory_iterator(kRoot / room))
        there |= folder.is_directory() && fs::exists(folder.path() / file);
      CHECK(there);
    }
  }
}

TEST_CASE("every test that the way from slide to test names is there") {
  const std::string table = section(textOf(kRoot / "sim/README.md"), "From slide to test");
  const Pattern cell(R"(\| `(\w+)`: ([^|]+) \|)");
  int count = 0;
  for (const Pattern::Match& match : cell.all(table))
    for (const std::string& name : found(match[2] + ";", R"(\s*([^;]+);)")) {
      CAPTURE(match[1], name);
      CHECK(hasCase(match[1], name));
      ++count;
    }
  CHECK(count > 30);
}

TEST_CASE("the changes begin with the version that is built") {
  const std::vector<std::string> built =
      found(textOf(kRoot / "CMakeLists.txt"), R"(project\(tumble VERSION ([0-9.]+) )");
  const std::vector<std::string> told =
      found(textOf(kRoot / "CHANGELOG.md"), R"(## ([0-9]+\.[0-9]+\.[0-9]+)\b)");
  REQUIRE(built.size() == 1);
  REQUIRE_FALSE(told.empty());
  CHECK(told.front() == built.front());
}
