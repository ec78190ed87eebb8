// What an image costs: process CPU time from a picture in memory to a PNG file on disk.
//   render_bench [FOLDER]     prints a table, and leaves the images in FOLDER (else a temporary
//   one)
// The rows under the heap of 200 are parts of it: what they cost less is what they leave out.
// CPU time, not wall time: the rasteriser uses every core, and the figure should not depend on who
// else does.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "render/image.h"
#include "render/png_writer.h"
#include "render/renderer.h"
#include "tests/render/plates.h"

namespace {

using namespace tumble;

double cpuMilliseconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double wallMilliseconds() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

void measure(Renderer& renderer, const char* name, const Picture& picture,
             const RenderOptions& options, const std::string& folder) {
  const int warmUp = 2, repeats = 7;
  std::vector<double> drawing, whole;
  for (int i = 0; i < warmUp + repeats; ++i) {
    const double start = cpuMilliseconds();
    const Image image = renderer.draw(picture, options);
    const double drawn = cpuMilliseconds();
    writePng(folder + "/" + name + ".png", image);
    if (i < warmUp) continue;
    drawing.push_back(drawn - start);
    whole.push_back(cpuMilliseconds() - start);
  }
  std::printf("%-16s %4d x %-4d  draw %6.1f  with PNG %6.1f CPU ms\n", name, options.width,
              options.height, median(drawing), median(whole));
}

/// A sequence as the program draws it, one thread packing what another has drawn. Only an idle
/// machine lends all its cores.
void run(Renderer& renderer, const Picture& picture, const std::string& folder) {
  const int images = 100;
  const double start = cpuMilliseconds(), begin = wallMilliseconds();
  PngWriter writer;
  for (int i = 0; i < images; ++i)
    writer.write(folder + "/run-" + std::to_string(i % 4) + ".png", renderer.draw(picture, {}), {});
  writer.finish();
  const double spent = cpuMilliseconds() - start, lasted = wallMilliseconds() - begin;
  std::printf("%-16s %4d images  %5.1f CPU ms each, %5.1f ms apart: %.2f cores busy\n",
              "a run of pile-200", images, spent / images, lasted / images, spent / lasted);
}

}  // namespace

int main(int count, char** arguments) {
  const std::string folder =
      count > 1 ? arguments[1] : std::filesystem::temp_directory_path().string();
  const double start = cpuMilliseconds();
  const auto context = makeContext();
  Renderer renderer(*context, TUMBLE_SOURCE_DIR "/assets/shaders", TUMBLE_BINARY_DIR "/fonts");
  std::printf("%s, %s\nstart %.1f CPU ms\n", context->renderer().c_str(),
              context->version().c_str(), cpuMilliseconds() - start);

  const RenderOptions full;
  RenderOptions golden{480, 270};
  measure(renderer, "pile-200", plates::pile(200), full, folder);
  RenderOptions low = full;
  low.antialias = AntiAlias::None;
  low.shadowMapSize /= 2;
  measure(renderer, "pile-200-low", plates::pile(200), low, folder);
  Picture part = plates::pile(200);
  part.floor.visible = false;
  measure(renderer, "- without floor", part, full, folder);
  part.instances.clear();
  measure(renderer, "- page and text", part, full, folder);
  part.floor.visible = true;
  measure(renderer, "- and floor", part, full, folder);
  measure(renderer, "strobe", plates::strobe(), full, folder);
  measure(renderer, "tower", plates::tower(), full, folder);
  measure(renderer, "fan", plates::fan(), full, folder);
  measure(renderer, "sunk", plates::sunk(), full, folder);
  measure(renderer, "pile-1000", plates::pile(1000), full, folder);
  RenderOptions fine = full;
  fine.antialias = AntiAlias::Ssaa2x2;
  measure(renderer, "pile-200-ssaa", plates::pile(200), fine, folder);
  measure(renderer, "pile-200-small", plates::pile(200), golden, folder);
  run(renderer, plates::pile(200), folder);
}
