// Exports, read by programs that know nothing of this one.
#include "tests/catch.h"
#include "tests/program/program.h"

// Oracle: Assimp's reader of glTF.
TEST_CASE("a glTF file of a run is read by Assimp with its nodes, meshes and animation") {
  const Folder scratch;
  REQUIRE(tumbleRun(scratch, "export overhang -o run.glb -q --set world.duration=0.2").code == 0);
  const Outcome read = tumbleRun(scratch, "--version", "assimp info run.glb >said 2>&1");
  const std::string said = textOf(scratch.path / "said");
  CAPTURE(said);
  CHECK(said.find("Animations:         1") != std::string::npos);
  CHECK(said.find("Meshes:") != std::string::npos);
  CHECK(said.find("import took") != std::string::npos);
}

TEST_CASE("export writes by the ending of the name, and refuses another") {
  const Folder scratch;
  CHECK(tumbleRun(scratch, "export overhang -o sub/scene.json").code == 0);
  CHECK(textOf(scratch.path / "sub/scene.json").starts_with("{"));
  const Outcome other = tumbleRun(scratch, "export overhang -o run.obj");
  CHECK(other.code == 2);
  CHECK(other.says(".glb"));
  CHECK(filesBelow(scratch.path) == 1);
}

// A room whose nearest walls no picture shows, and places too small to have all their digits.
TEST_CASE("a page and a glTF file hold every body, whatever the pictures leave out") {
  const Folder scratch;
  scratch.file("room.toml", R"([world]
duration = 0.1
[[body]]
name = "left"
shape = { plane = [1, 0, 0, -1] }
[[body]]
name = "front"
shape = { plane = [0, 0, -1, -1] }
[[body]]
name = "grain"
shape = { sphere = 0.1 }
mass = 1.0
position = [1e-310, 1, 0]
)");
  scratch.file("towel.toml", R"([world]
duration = 0.1
[[body]]
name = "post"
shape = { sphere = 0.1 }
fixed = true
[[cloth]]
name = "towel"
columns = 3
rows = 3
size = [0.4, 0.4]
density = 0.3
stretch = 100
shear = 10
bend = 1e-5
damping = 0.1
position = [0, 0.2, 0]
)");
  for (const char* scene : {"room", "towel"})
    for (const char* what : {"render {}.toml --html {}.html -q", "export {}.toml -o {}.glb -q"}) {
      std::string line = what;
      for (std::size_t at; (at = line.find("{}")) != std::string::npos;) line.replace(at, 2, scene);
      const Outcome outcome = tumbleRun(scratch, line);
      CAPTURE(line, outcome.err);
      CHECK(outcome.code == 0);
    }
  const std::string page = textOf(scratch.path / "room.html");
  CHECK(page.find("\"name\":\"grain\",\"shape\":3") != std::string::npos);
}

TEST_CASE("a page of the pile weighs less than half a megabyte") {
  const Folder scratch;
  CHECK(tumbleRun(scratch, "render pile --html pages/pile.html -q").code == 0);
  const auto size = std::filesystem::file_size(scratch.path / "pages/pile.html");
  CAPTURE(size);
  CHECK(size < 500'000);
  CHECK(size > 50'000);
}

// Oracle: one rule for everything that is written.
TEST_CASE("whatever is written makes the folders that it is to stand in, or says why it cannot") {
  const Folder scratch;
  scratch.file("drop.toml", R"(
[world]
duration = 0.1
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1
[image]
size = [64, 36]
)");
  const std::pair<const char*, const char*> written[] = {
      {"simulate drop.toml -q -o a/one", "a/one/summary.json"},
      {"render drop.toml -q --still 0 -o b/one", "b/one/still.png"},
      {"render drop.toml -q --html c/one/drop.html", "c/one/drop.html"},
      {"export drop.toml -q -o d/one/drop.glb", "d/one/drop.glb"},
      {"export drop.toml -q -o e/one/drop.json", "e/one/drop.json"}};
  for (const auto& [line, file] : written) {
    CAPTURE(line);
    const Outcome outcome = tumbleRun(scratch, line);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(std::filesystem::exists(scratch.path / file));
  }
  for (const char* line :
       {"render drop.toml -q --html drop.toml/drop.html", "render drop.toml -q --html c/one",
        "render drop.toml -q --video c", "export drop.toml -q -o drop.toml/drop.json"}) {
    const Outcome outcome = tumbleRun(scratch, line);
    CAPTURE(line, outcome.err);
    CHECK(outcome.code == 5);
    CHECK(outcome.err.find("cannot") != std::string::npos);
  }
  const Outcome film = tumbleRun(scratch, "render drop.toml -q --video film.xyz");
  CHECK(film.code == 2);
  CHECK(film.says("--video film.xyz: expected a name that ends in .mp4"));
  CHECK(film.lines() == 1);
}
