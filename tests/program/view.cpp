// The window, on a virtual display.
#include "tests/catch.h"
#include "tests/program/program.h"

TEST_CASE("the window opens on a virtual display, draws and closes") {
  if (std::system("command -v xvfb-run xauth >/dev/null") != 0) {
    WARN("xvfb is not installed: not tested");
    return;
  }
  const Folder scratch;
  scratch.file(
      "scene.toml",
      "[world]\nduration = 0.2\n[[body]]\nname = \"a\"\nshape = { sphere = 0.1 }\nmass = 1.0\n");
  // With a key of ours xvfb-run has no folder of its own, which it may fail to tidy up.
  const std::string server = "xvfb-run --auto-servernum --auth-file='" + scratch.file("key", "") +
                             "' --server-args='-screen 0 1280x800x24' ";
  // What the drivers of the display keep cannot be told by name once they are unloaded.
  const std::string command = "cd '" + scratch.path.string() + "' && ASAN_OPTIONS=detect_leaks=0 " +
                              server + TUMBLE_PROGRAM + " view scene.toml --images 3 >log 2>&1";
  const int status = std::system(command.c_str());
  CAPTURE(textOf(scratch.path / "log"));
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}
