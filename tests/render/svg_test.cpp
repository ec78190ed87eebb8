// Charts as SVG documents.
#include "render/svg.h"

#include "render/chart.h"
#include "tests/catch.h"
#include "tests/render/studio.h"

using namespace tumble;

namespace {

std::size_t countOf(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

}  // namespace

TEST_CASE("strokes that look alike are one path, and what is text is escaped") {
  SvgDrawing drawing(100.0, 50.0, fonts());
  const Colour red = {1.0f, 0.0f, 0.0f};
  drawing.stroke({1.0, 2.0}, {3.25, 4.0}, 2.0, red);
  drawing.stroke({3.25, 4.0}, {5.0, 6.123}, 2.0, red);
  drawing.stroke({9.0, 9.0}, {8.0, 8.0}, 2.0, red);
  drawing.stroke({9.0, 9.0}, {8.0, 8.0}, 1.0, red, 0.5);
  drawing.stroke({8.0, 8.0}, {7.0, 9.0}, 1.0, red, 0.5);
  drawing.stroke({9.0, 8.0}, {8.0, 9.0}, 1.0, red, 0.5);
  drawing.text({10.0, 20.0}, "a < b & c", {14.0, Face::Bold, Align::Right, red});
  const std::string text = drawing.document();
  CHECK(text.find("d=\"M1 2L3.25 4L5 6.12M9 9L8 8\" stroke=\"#ff0000\" stroke-width=\"2\"") !=
        std::string::npos);
  // Where two cross that let something through, it is darker.
  CHECK(text.find("d=\"M9 9L8 8L7 9\"") != std::string::npos);
  CHECK(text.find("d=\"M9 8L8 9\"") != std::string::npos);
  CHECK(text.find("text-anchor=\"end\" font-weight=\"bold\" fill=\"#ff0000\">a &lt; b &amp; "
                  "c</text>") != std::string::npos);
  CHECK(countOf("<path", text) == 3);
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
    const std::string text = svgOf(chart, 640.0, 360.0, fonts());
    return countOf("M", text);
  };
  CHECK(strokes(true, 71.0) == strokes(false, 71.0) + 2);
  CHECK(strokes(true, 0.0) == strokes(false, 0.0));
}

// Oracle: the axes' own places. The plot is 544 px wide.
TEST_CASE("a curve of very many points has no more strokes than pixels across, and every peak") {
  Chart chart;
  ChartCurve& curve = chart.curves.emplace_back();
  curve.colour = {0.0f, 0.0f, 1.0f};
  curve.marked = false;
  for (int i = 0; i <= 100'000; ++i) curve.points.emplace_back(1e-5 * i, i % 2 + i % 3);
  curve.points[31'415].y() = 20.0;
  curve.points[31'417].y() = -20.0;
  curve.points[99'999].y() = 11.0;
  const std::string text = svgOf(chart, 640.0, 360.0, fonts());
  const std::size_t end = text.find(" stroke=\"#0000ff\"");
  REQUIRE(end != std::string::npos);
  const std::string path = text.substr(0, end).substr(text.rfind("d=\"", end));
  CHECK(countOf("L", path) <= 544 + 2);
  CHECK(countOf("L", path) >= 500);
  CHECK(countOf("M", path) == 1);
  const auto at = [](double y) {
    char text[20];
    std::snprintf(text, sizeof text, " %.2f", 48.0 + (302.0 - 48.0) * (20.0 - y) / 40.0);
    std::string number = text;
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    return number + "L";
  };
  for (const double peak : {20.0, -20.0, 11.0}) CHECK(countOf(at(peak), path) == 1);
  CHECK(text.size() < 30'000);
}

// Measured 1,092 discs, two a mark, in 67 kB; all 80,002 would be 4.3 MB.
TEST_CASE("very many marks are no more than pixels across, with every peak; few are all there") {
  const auto drawn = [](int count) {
    Chart chart;
    ChartCurve& curve = chart.curves.emplace_back();
    for (int i = 0; i <= count; ++i) curve.points.emplace_back(1.0 * i / count, i % 2 + i % 3);
    curve.points[static_cast<std::size_t>(count / 3)].y() = 20.0;
    return svgOf(chart, 640.0, 360.0, fonts());
  };
  CHECK(countOf("<circle", drawn(300)) == 2 * 301);
  const std::string many = drawn(40'000);
  CHECK(countOf("<circle", many) <= 2 * (544 + 2));
  CHECK(countOf("<circle", many) >= 2 * 500);
  CHECK(countOf("cy=\"48\"", many) == 2);  // the peak, at the top of the axis
  CHECK(many.size() < 100'000);
}

TEST_CASE("very many guides do not hide the curve, few are dashed all the way") {
  const auto drawn = [](int count, double step) {
    Chart chart;
    ChartCurve& curve = chart.curves.emplace_back();
    curve.points = {{0.0, 0.0}, {1.0, 1.0}};
    for (int i = 0; i < count; ++i) chart.guides.push_back({true, 0.1 + step * i, ""});
    return svgOf(chart, 640.0, 360.0, fonts());
  };
  const std::size_t without = countOf("M", drawn(0, 0.0));
  CHECK(countOf("M", drawn(3, 0.1)) == without + 3 * countOf("M", drawn(1, 0.1)) - 3 * without);
  CHECK(countOf("M", drawn(1, 0.1)) > without + 10);
  CHECK(countOf("M", drawn(5000, 1e-4)) == without);  // one bar
  CHECK(countOf("<rect", drawn(5000, 1e-4)) == countOf("<rect", drawn(0, 0.0)) + 1);
  CHECK(countOf("<rect", drawn(80, 0.01)) == countOf("<rect", drawn(0, 0.0)) + 80);
  CHECK(countOf("M", drawn(2, 1e-4)) == countOf("M", drawn(1, 0.1)));  // they are one
}
