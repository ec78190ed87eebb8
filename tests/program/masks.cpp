// Masks of depth and identity, and events on a line.
#include <cstdint>

#include "tests/catch.h"
#include "tests/program/program.h"

namespace fs = std::filesystem;

namespace {

const char* const kFloorAndBall = R"([world]
duration = 0.5
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "ball"
shape = { sphere = 0.2 }
mass = 1.0
position = [0, 0.4, 0]
[image]
size = [160, 90]
)";

// Of a PNG: bits a sample, and the type of its colours (PNG, §11.2.2).
std::pair<int, int> kindOf(const fs::path& path) {
  const std::string file = textOf(path);
  return file.size() < 26 ? std::pair(0, 0) : std::pair<int, int>(file[24], file[25]);
}

}  // namespace

TEST_CASE("masks stand beside images, are named, and are kept when the run goes on") {
  const Folder scratch;
  scratch.file("scene.toml", kFloorAndBall);
  REQUIRE(tumbleRun(scratch, "render scene.toml --frames 0:2 --masks -o out -q").code == 0);
  CHECK(kindOf(scratch.path / "out/image-000001.depth.png") == std::pair(16, 0));
  CHECK(kindOf(scratch.path / "out/image-000001.identity.png") == std::pair(8, 2));
  CHECK(textOf(scratch.path / "out/image-000001.depth.png").find("Metres") != std::string::npos);
  const std::string legend = textOf(scratch.path / "out/identities.csv");
  CHECK(legend.starts_with("body,red,green,blue\nfloor,158,55,121\nball,"));
  CHECK(filesBelow(scratch.path / "out") == 7);

  // Again: nothing is drawn anew; a mask that is gone comes back with the same bytes.
  const fs::path gone = scratch.path / "out/image-000000.identity.png";
  const fs::path kept = scratch.path / "out/image-000001.identity.png";
  const std::string before = textOf(gone);
  const auto time = fs::last_write_time(kept);
  fs::remove(gone);
  REQUIRE(tumbleRun(scratch, "render scene.toml --frames 0:2 --masks -o out -q").code == 0);
  CHECK(textOf(gone) == before);
  CHECK(fs::last_write_time(kept) == time);
}

TEST_CASE("the line of events is an SVG document with a lane for each kind") {
  const Folder scratch;
  scratch.file("scene.toml", kFloorAndBall);
  REQUIRE(tumbleRun(scratch, "render scene.toml --events -o out -q").code == 0);
  const std::string svg = textOf(scratch.path / "out/events.svg");
  CHECK(svg.starts_with("<svg xmlns="));
  CHECK(svg.find(">impact</text>") != std::string::npos);
  CHECK(svg.find(">slip</text>") == std::string::npos);
  CHECK(svg.ends_with("</svg>\n"));
}
