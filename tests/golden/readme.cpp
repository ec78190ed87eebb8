// README's first scene is what its picture and its table show.
#include <fmt/format.h>

#include "app/claim/verdict.h"
#include "app/file/data.h"
#include "app/file/file.h"
#include "app/present/present.h"
#include "app/scene/demos.h"
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

// Oracle: the demos drawn anew. `tumble render NAME --size 960x540` with --strobe or --still makes
// them: where they differ and the goldens of the demo changed as they should, make them again.
TEST_CASE("README's table shows the demos as they are") {
  const std::string page = readFile(kRoot + "/README.md");
  const auto context = makeContext();
  Renderer renderer(*context, dataFolder("shaders"), dataFolder("fonts"));
  const struct {
    std::string name;
    std::optional<double> at;  // [s]; none: the strobe
  } pictures[] = {{"path-of-brick", {}},
                  {"slope", 0.2},
                  {"pile", 6.0},
                  {"wall-and-ball", 0.45},
                  {"domino-spiral", 2.6}};
  for (const auto& picture : pictures) {
    CAPTURE(picture.name);
    const std::string file = "assets/pictures/" + picture.name + ".png";
    CHECK(page.find(file) != std::string::npos);
    Scene scene = readScene(scenePath(picture.name));
    scene.image.width = 960, scene.image.height = 540;
    const Recording recording = record(scene, scene.image.rate);
    const Presenter presenter(scene, recording);
    const Image drawn =
        renderer.draw(picture.at ? presenter.still(*picture.at) : presenter.strobe(),
                      {.width = 960, .height = 540});
    CHECK(compare(readPng(kRoot + "/" + file), drawn).passes());
  }
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
