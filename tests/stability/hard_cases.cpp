// The table of hard cases: what each is off by, held to what it may be. `test_stability "[table]"`
// writes the page.
#include "tests/stability/hard_case.h"

#include <cstdio>
#include <ctime>
#include <limits>

#include "app/file/file.h"
#include "tests/catch.h"

namespace tumble::test {

World ranTo(const WorldDef& def, double t) {
  World world(def);
  world.advance(t);
  return world;
}

double unlessStopped(const World& world, double number) {
  return world.report().stopped ? std::numeric_limits<double>::quiet_NaN() : number;
}

}  // namespace tumble::test

using namespace tumble;
using namespace tumble::test;

namespace {

const std::string kPage = TUMBLE_SOURCE_DIR "/tests/stability/README.md";

std::vector<HardCase> allCases() {
  std::vector<HardCase> all;
  for (const auto& chapter : {hardStatics(), hardMotions(), hardShapes(), hardForces()})
    all.insert(all.end(), chapter.begin(), chapter.end());
  return all;
}

std::string shortly(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", number);
  return text;
}

/// The columns of a row that say what is asked.
std::string asked(const HardCase& row) {
  return "| " + row.name + " | " + row.oracle + " | " + row.unit + " | " + shortly(row.allowed) +
         " |";
}

struct Outcome {
  double measured = 0.0, cpu = 0.0;  ///< [s]
};

Outcome outcomeOf(const HardCase& row) {
  const std::clock_t start = std::clock();
  const double measured = row.measure();
  return {measured, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC};
}

}  // namespace

// Oracle: each row's own. The page beside has what was measured.
TEST_CASE("hard cases are met by the default settings", "[figures]") {
  for (const HardCase& row : allCases()) {
    const Outcome outcome = outcomeOf(row);
    CAPTURE(row.name, row.oracle, row.unit, outcome.cpu);
    CHECK(outcome.measured <= row.allowed);
  }
}

TEST_CASE("the page of hard cases asks what the table asks") {
  const std::string page = readFile(kPage);
  for (const HardCase& row : allCases()) {
    CAPTURE(row.name);
    CHECK(page.find(asked(row)) != std::string::npos);
  }
}

TEST_CASE("the table of hard cases, written into its page", "[.][table]") {
  const std::string before = readFile(kPage);
  std::string text = before.substr(0, before.find("| case |"));
  text += "| case | oracle | unit | allowed | measured | CPU s |\n|---|---|---|---|---|---|\n";
  for (const HardCase& row : allCases()) {
    const Outcome outcome = outcomeOf(row);
    char cpu[32];
    std::snprintf(cpu, sizeof cpu, "%.2g", outcome.cpu);
    text += asked(row) + " " + shortly(outcome.measured) + " | " + cpu + " |\n";
  }
  FileWriter page(kPage);
  page.write(text);
  page.finish();
}
