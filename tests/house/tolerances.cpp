// The table of tolerances and the sources say the same.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "tests/catch.h"
#include "tests/house/pattern.h"

namespace fs = std::filesystem;
using tumble::test::Pattern;

namespace {

const fs::path kSource = TUMBLE_SOURCE_DIR;

using Constant = std::tuple<std::string, std::string, std::string>;  // file, name, value

/// The small numbers that a source gives a name, with an exponent below zero: "kFlat = 1e-12".
std::set<Constant> constantsIn(std::istream& text, const std::string& file) {
  static const Pattern small(R"(\b(k[A-Z]\w*) = ([0-9.]+e-[0-9]+)\b)");
  std::set<Constant> found;
  for (std::string line; std::getline(text, line);) {
    if (line.find("constexpr double") == std::string::npos) continue;
    for (const Pattern::Match& match : small.all(line)) found.insert({file, match[1], match[2]});
  }
  return found;
}

std::set<Constant> constantsOfSim() {
  std::set<Constant> all;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / "sim")) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".h" && ending != ".cpp") continue;
    std::ifstream text(entry.path());
    all.merge(constantsIn(text, entry.path().lexically_relative(kSource / "sim").string()));
  }
  return all;
}

struct TableRow {
  Constant constant;
  std::string unit, reason, test;
};

std::vector<TableRow> tableRows() {
  static const Pattern row(
      R"(^\| `([^`]+)` \| `(\w+)` \| ([0-9.e-]+) \| ([^|]+) \| (.+) \| `([^`]+)` \|$)");
  std::vector<TableRow> rows;
  std::ifstream text(kSource / "sim/TOLERANCES.md");
  for (std::string line; std::getline(text, line);)
    if (const auto match = row.first(line)) {
      const auto& [whole, file, name, value, unit, reason, test, none] = *match;
      rows.push_back({{file, name, value}, unit, reason, test});
    }
  return rows;
}

/// Whether a file of sim sets that name to that value, as a constant or a default.
bool stands(const Constant& constant) {
  const auto& [file, name, value] = constant;
  std::ifstream text(kSource / "sim" / file);
  const Pattern set("\\b" + name + " = " + value + "\\b");
  for (std::string line; std::getline(text, line);)
    if (set.first(line)) return true;
  return false;
}

}  // namespace

TEST_CASE("every row of the table of tolerances is in the sources, with a test that exists") {
  const std::vector<TableRow> rows = tableRows();
  CHECK(rows.size() > 80);
  for (const TableRow& row : rows) {
    CAPTURE(std::get<0>(row.constant), std::get<1>(row.constant), std::get<2>(row.constant));
    CHECK(stands(row.constant));
    CHECK(fs::is_regular_file(kSource / row.test));
    CHECK(row.reason.size() > 5);
  }
}

TEST_CASE("every small constant of sim has its row in the table of tolerances") {
  std::set<Constant> told;
  for (const TableRow& row : tableRows()) told.insert(row.constant);
  for (const Constant& constant : constantsOfSim()) {
    CAPTURE(std::get<0>(constant), std::get<1>(constant), std::get<2>(constant));
    CHECK(told.count(constant) == 1);
  }
}

TEST_CASE("a constant that the table leaves out, or has with another value, is found") {
  std::istringstream text("constexpr double kFlat = 1e-12, kWide = 2.0;\nint kFew = 1e-3;\n");
  const std::set<Constant> found = constantsIn(text, "a.cpp");
  CHECK(found == std::set<Constant>{{"a.cpp", "kFlat", "1e-12"}});
  CHECK(stands({"shape/polyhedron.cpp", "kFlat", "1e-12"}));
  CHECK_FALSE(stands({"shape/polyhedron.cpp", "kFlat", "1e-13"}));
}
