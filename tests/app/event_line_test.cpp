// The line of all events.
#include "app/panel/event_line.h"

#include "app/file/data.h"
#include "tests/catch.h"

using namespace tumble;

// A ball 1 nm above the floor, which it meets after √(2e-9/9.81) s = 14.3 µs.
TEST_CASE("instants of a short run differ, and a long title stays on the line of events") {
  const std::string title = "A title that is longer than the line, " + std::string(120, 'w');
  const Scene scene = parseScene("title = \"" + title + R"("
[world]
duration = 4e-5
[materials.rubber]
restitution = 0.5
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
material = "rubber"
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1.0
material = "rubber"
position = [0, 0.100000001, 0]
[image]
rate = 1e5
)",
                                 "short");
  Fonts fonts(dataFolder("fonts"));
  const std::string svg = eventLineSvg(scene, record(scene, 1e5), fonts);
  for (const char* word : {">0.0<", ">1.0<", ">4.0<", ">time / s  (× 10⁻⁵)<", "www…<"}) {
    CAPTURE(word);
    CHECK(svg.find(word) != std::string::npos);
  }
  CHECK(svg.find(">0.00000") == std::string::npos);
}
