// README's first scene is what its picture and its table show.
#include <fmt/format.h>

#include "app/claim/verdict.h"
#include "app/file/data.h"
#include "app/file/file.h"
#include "app/present/present.h"
#include "render/renderer.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

const std::string kRoot = TUMBLE_SOURCE_DIR;

// The first block of that kind behind a place of the page.
std::string blockOf(const std::string& page, const std::string& fence, std::size_t from = 0) {
  const std::size_t start = page.find("```" + fence + "\n", from) + fence.size() + 4;
  return page.substr(start, page.find("```", start) - start);
}

}  // namespace

TEST_CASE("README's first scene keeps its claim, with the numbers that stand below it") {
  const std::string page = readFile(kRoot + "/README.md");
  const Scene scene = parseScene(blockOf(page, "toml"), "ball.toml");
  const Verdict verdict = judge(scene, record(scene, scene.image.rate));
  REQUIRE(verdict.rows.size() == 1);
  const std::string table = blockOf(page, "", page.find("tumble check ball.toml"));
  CAPTURE(table);
  const ClaimRow& row = verdict.rows[0];
  for (const std::string& part : {fmt::format("{}: {}\n", scene.name, scene.title), row.label,
                                  fmt::format("{:.10g}", row.exact), toldOf(verdict)})
    CHECK(table.find(part == "its claim holds" ? "the claim holds" : part) != std::string::npos);
}

// Oracle: the scene drawn anew.
TEST_CASE("README's first picture is that of its first scene") {
  const Scene scene = parseScene(blockOf(readFile(kRoot + "/README.md"), "toml"), "ball.toml");
  const auto context = makeContext();
  Renderer renderer(*context, dataFolder("shaders"), dataFolder("fonts"));
  const Recording recording = record(scene, scene.image.rate);
  const Image drawn =
      renderer.draw(Presenter(scene, recording).strobe(), {.width = 960, .height = 540});
  CHECK(compare(readPng(kRoot + "/assets/pictures/ball.png"), drawn).passes());
}
