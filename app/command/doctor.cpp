// tumble doctor: what this machine offers, and what is missing.
#include <fmt/core.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/file/data.h"
#include "app/file/file.h"
#include "app/golden/manifest.h"
#include "render/context/window.h"
#include "render/renderer.h"

namespace tumble::command {

namespace {

// A blue box on the floor: lit, in shadow, with lines and text.
Picture testPicture() {
  Picture picture;
  picture.camera = {.eye = {3.0, 2.0, 6.0}, .target = {0.0, 0.4, 0.0}, .fov = 24.0};
  picture.instances = {{.position = {0.0, 0.5, 0.0}, .scale = Eigen::Vector3d::Constant(0.5)}};
  picture.radius = 2.0;
  picture.title = "tumble doctor";
  return picture;
}

void row(const std::string& what, const std::string& answer) {
  fmt::print("{:<9} {}\n", what, answer);
}

// Draws the test picture in a context; what came of it in one line.
std::string examine(Context& context) {
  Renderer renderer(context, dataFolder("shaders"), dataFolder("fonts"));
  const Image image = renderer.draw(testPicture(), {.width = 320, .height = 180});
  return fmt::format("{}, OpenGL {}; test picture {}", context.renderer(), context.version(),
                     pixelHash(image));
}

enum class Drawing { Works, NoContext, NoFiles };

// Tells about one kind of context; whether it draws, or what is in the way.
template <class Make>
Drawing examineKind(std::string_view name, const Make& make) {
  try {
    const auto context = make();
    row(std::string(name), examine(*context));
    return Drawing::Works;
  } catch (const NoContext& error) {
    row(std::string(name), fmt::format("no: {}", error.what()));
    return Drawing::NoContext;
  } catch (const std::exception& error) {
    row(std::string(name), fmt::format("no: {}", error.what()));
    return Drawing::NoFiles;
  }
}

// That of the best kind; a context without files is missing files, not a context.
Drawing examineContexts() {
  Drawing best = Drawing::NoContext;
  for (const ContextKind& kind : contextKinds()) {
    const Drawing one = examineKind(kind.name, kind.make);
    if (best != Drawing::Works && one != Drawing::NoContext) best = one;
  }
  // A window is for `view` alone, so it does not count.
  examineKind("window", [] {
    return std::make_unique<Window>(Window::Options{.width = 64, .height = 64, .visible = false});
  });
  return best;
}

void tellFolders() {
  for (const std::string kind : {"demos", "shaders", "fonts", "golden"}) {
    try {
      row(kind, dataFolder(kind));
    } catch (const FileError& error) {
      row(kind, fmt::format("no: {}", error.what()));
    }
  }
}

// First file of that name on the PATH, or "".
std::string onPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path file = std::filesystem::path(folder) / program;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file.string();
  }
  return "";
}

}  // namespace

int doctor(int argc, char** argv) {
  CommandLine line("doctor", "Tells what this machine offers for drawing, and what is missing.",
                   {"  # contexts, folders, helpers", "  && tumble render path-of-brick"});
  if (!line.read(argc, argv)) return kOk;

  row("tumble", TUMBLE_VERSION);
  tellFolders();
  const std::string ffmpeg = onPath("ffmpeg");
  row("ffmpeg", ffmpeg.empty() ? "no: needed by --video alone; install ffmpeg" : ffmpeg);
  const std::string gnuplot = onPath("gnuplot");
  row("gnuplot", gnuplot.empty()
                     ? "no: needed by the figures of report and converge alone; install gnuplot-nox"
                     : gnuplot);
  const Drawing drawing = examineContexts();
  if (drawing == Drawing::NoContext)
    throw NoContext("nothing here can draw; install libosmesa6 or libegl1 with libgl1-mesa-dri");
  if (drawing == Drawing::NoFiles)
    throw FileError(
        "the program's own files are not where it looks for them; install it anew or set "
        "TUMBLE_DATA to the folder that holds them");
  if (std::getenv("TUMBLE_GL")) row("TUMBLE_GL", std::string(makeContext()->name()));
  return kOk;
}

}  // namespace tumble::command
