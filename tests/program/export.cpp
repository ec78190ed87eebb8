// Exports, read by programs that know nothing of this one.
#include "tests/catch.h"
#include "tests/program/program.h"

// Oracle: Assimp's reader of glTF.
TEST_CASE("a glTF file of a run is read by Assimp with its nodes, meshes and animation") {
  const Scratch scratch;
  REQUIRE(tumbleRun(scratch, "export overhang -o run.glb -q --set world.duration=0.2").code == 0);
  const Outcome read = tumbleRun(scratch, "--version", "assimp info run.glb >said 2>&1");
  const std::string said = textOf(scratch.path / "said");
  CAPTURE(said);
  CHECK(said.find("Animations:         1") != std::string::npos);
  CHECK(said.find("Meshes:") != std::string::npos);
  CHECK(said.find("import took") != std::string::npos);
}

TEST_CASE("export writes by the ending of the name, and refuses another") {
  const Scratch scratch;
  CHECK(tumbleRun(scratch, "export overhang -o sub/scene.json").code == 0);
  CHECK(textOf(scratch.path / "sub/scene.json").starts_with("{"));
  const Outcome other = tumbleRun(scratch, "export overhang -o run.obj");
  CHECK(other.code == 2);
  CHECK(other.says(".glb"));
  CHECK(filesBelow(scratch.path) == 1);
}

TEST_CASE("a page of the pile weighs less than half a megabyte") {
  const Scratch scratch;
  CHECK(tumbleRun(scratch, "render pile --html pages/pile.html -q").code == 0);
  const auto size = std::filesystem::file_size(scratch.path / "pages/pile.html");
  CAPTURE(size);
  CHECK(size < 500'000);
  CHECK(size > 50'000);
}
