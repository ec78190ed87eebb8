// Charts as SVG documents.
#include "render/svg.h"

#include "render/chart.h"
#include "tests/catch.h"
#include "tests/render/studio.h"

using namespace tumble;

namespace {

Fonts& fonts() {
  static Fonts all(kFonts);
  return all;
}

std::size_t countOf(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

}  // namespace

TEST_CASE("strokes that go on from each other are one path, and what is text is escaped") {
  SvgDrawing drawing(100.0, 50.0, fonts());
  const Colour red = {1.0f, 0.0f, 0.0f};
  drawing.stroke({1.0, 2.0}, {3.25, 4.0}, 2.0, red);
  drawing.stroke({3.25, 4.0}, {5.0, 6.123}, 2.0, red);
  drawing.stroke({9.0, 9.0}, {8.0, 8.0}, 2.0, red);
  drawing.text({10.0, 20.0}, "a < b & c", {14.0, Face::Bold, Align::Right, red});
  const std::string text = drawing.document();
  CHECK(text.find("d=\"M1 2L3.25 4L5 6.12\" stroke=\"#ff0000\" stroke-width=\"2\"") !=
        std::string::npos);
  CHECK(text.find("d=\"M9 9L8 8\"") != std::string::npos);
  CHECK(text.find("text-anchor=\"end\" font-weight=\"bold\" fill=\"#ff0000\">a &lt; b &amp; "
                  "c</text>") != std::string::npos);
  CHECK(countOf("<path", text) == 2);
}

// Oracle: the axes' own places. x: 0 … 4 from 64 px to the right edge less 32, y: 0 … 2 upwards.
TEST_CASE("a curve of a chart is one path whose ends stand where its axes say") {
  Chart chart;
  chart.title = "Curves & lines";
  chart.x = {"time / s", false};
  chart.y = {"height / m", false};
  chart.curves.push_back({"", "", {{0.0, 0.0}, {1.0, 2.0}, {4.0, 1.0}}, {0.0f, 0.0f, 1.0f}, false});
  const std::string text = svgOf(chart, 640.0, 360.0, fonts());
  const double right = 640.0 - 32.0, top = 120.0, bottom = 360.0 - 58.0;
  const double quarter = 64.0 + 0.25 * (right - 64.0), middle = 0.5 * (top + bottom);
  char path[100];
  std::snprintf(path, sizeof path, "M64 %gL%g %gL%g %g\" stroke=\"#0000ff\"", bottom, quarter, top,
                right, middle);
  INFO(text);
  CHECK(text.find(path) != std::string::npos);
  CHECK(text.find(">Curves &amp; lines</text>") != std::string::npos);
  CHECK(text.find(">time / s</text>") != std::string::npos);
  CHECK(countOf("<text", text) == countOf("</text>", text));
  CHECK(text == svgOf(chart, 640.0, 360.0, fonts()));
}

TEST_CASE("an axis that may be broken is so where it leaves out 0, and nowhere else") {
  const auto strokes = [](bool broken, double least) {
    Chart chart;
    chart.y.broken = broken;
    ChartCurve& curve = chart.curves.emplace_back();
    curve.points = {{0.0, least}, {1.0, 90.0}};
    return countOf("<path", svgOf(chart, 640.0, 360.0, fonts()));
  };
  CHECK(strokes(true, 71.0) == strokes(false, 71.0) + 2);
  CHECK(strokes(true, 0.0) == strokes(false, 0.0));
}
