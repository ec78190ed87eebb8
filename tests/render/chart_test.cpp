// Charts: where values lie, which numbers stand along the axes, and that marks are drawn there.
#include "render/chart.h"

#include <cmath>
#include <limits>

#include "render/canvas.h"
#include "render/overlay.h"
#include "render/svg.h"
#include "tests/render/studio.h"

using namespace tumble;

namespace {

std::vector<double> labelled(const Scale& scale) {
  std::vector<double> values;
  for (const Tick& tick : scale.ticks())
    if (tick.labelled) values.push_back(tick.value);
  return values;
}

// Pixels of the image that are nearly of the colour.
int countNear(const Image& image, const Colour& colour) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    double worst = 0.0;
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(image.rgb[i + c] - 255.0 * colour[c]));
    count += worst < 3.0;
  }
  return count;
}

}  // namespace

// Oracle: closed form. Measured 0 px, allowed 1e-9.
TEST_CASE("a logarithmic axis spans whole decades and places values by their logarithm") {
  const std::vector<double> values = {3e-5, 0.2, 0.0, -1.0, std::nan("")};
  const Scale scale({"x", true}, values, 100.0, 600.0, 50.0);
  CHECK(labelled(scale) == std::vector<double>{-5, -4, -3, -2, -1, 0});
  CHECK(std::abs(scale.at(1e-5) - 100.0) < 1e-9);
  CHECK(std::abs(scale.at(1.0) - 600.0) < 1e-9);
  CHECK(std::abs(scale.at(1e-3) - 300.0) < 1e-9);
  CHECK_FALSE(scale.holds(0.0));
  CHECK_FALSE(scale.holds(std::numeric_limits<double>::infinity()));
}

TEST_CASE("where there is no room for every decade, some are lines without a number") {
  const Scale scale({"x", true}, std::vector<double>{1e-16, 1.0}, 0.0, 400.0, 64.0);
  CHECK(scale.ticks().size() == 17);
  CHECK(labelled(scale) == std::vector<double>{-16, -13, -10, -7, -4, -1});
}

// An axis may run upwards: its first pixel lies below its last.
TEST_CASE("a linear axis has round numbers around what it shows") {
  const Scale scale({"y", false}, std::vector<double>{-0.3, 7.9}, 400.0, 100.0, 40.0);
  CHECK(labelled(scale) == std::vector<double>{-2, 0, 2, 4, 6, 8});
  CHECK(std::abs(scale.at(-2.0) - 400.0) < 1e-9);
  CHECK(std::abs(scale.at(8.0) - 100.0) < 1e-9);
  // One value, or none, has room around it too.
  CHECK(labelled(Scale({"y", false}, std::vector<double>{3.0}, 0.0, 100.0, 40.0)).size() >= 2);
  CHECK(labelled(Scale({"y", true}, {}, 0.0, 100.0, 40.0)).size() >= 2);
}

// Beside 1e17 a step of 1 is none, and nothing of 1e-17 is seen on an axis up to 1.
TEST_CASE("a value that never changes has room on its axis, however large or small it is") {
  for (const double value : {0.0, 1e-300, -1e-17, 1e-3, 1962.0, -1e17, 1e300}) {
    CAPTURE(value);
    const Scale scale({"y", false}, std::vector<double>{value, value}, 0.0, 100.0, 20.0);
    const std::vector<double> numbers = labelled(scale);
    CHECK(numbers.size() >= 2);
    CHECK(numbers.size() <= 12);
    CHECK(numbers.back() - numbers.front() >= std::abs(value) * 1e-6);
    CHECK((value == 0.0 || numbers.back() - numbers.front() <= std::max(2.0, 3 * std::abs(value))));
    CHECK(scale.at(value) >= -1e-6);
    CHECK(scale.at(value) <= 100.0 + 1e-6);
  }
  CHECK_FALSE(Scale({"y", false}, {}, 0.0, 100.0, 20.0).holds(1e301));
}

TEST_CASE("numbers of more digits than find room are told in a power of ten, with the caption") {
  const auto power = [](double low, double high) {
    return Scale({"y", false}, std::vector<double>{low, high}, 0.0, 100.0, 20.0).power();
  };
  CHECK(power(0.0, 8e6) == 0);
  CHECK(power(0.0, 6e-5) == 0);
  CHECK(power(-3e7, 1e7) == 7);
  CHECK(power(1e-16, 4e-16) == -16);
  CHECK(Scale({"y", true}, std::vector<double>{1e-16, 1.0}, 0.0, 100.0, 20.0).power() == 0);
  Chart chart;
  chart.y = {"force / N", false};
  chart.curves.resize(1);
  chart.curves[0].points = {{0.0, 1e-16}, {1.0, 4e-16}};
  Fonts fonts(kFonts);
  const std::string svg = svgOf(chart, 480.0, 270.0, fonts);
  CHECK(svg.find("force / N  (× 10⁻¹⁶)") != std::string::npos);
  CHECK(svg.find(">4<") != std::string::npos);
  CHECK(svg.find("0.000000") == std::string::npos);
}

namespace {

// What stands along an axis of such values, from the foot up, and below its caption "y" what it is
// told in.
std::vector<std::string> writtenAlong(const std::vector<double>& values) {
  Chart chart;
  chart.y = {"y", false};
  chart.curves.resize(1);
  chart.curves[0].marked = false;
  for (const double value : values)
    chart.curves[0].points.emplace_back(chart.curves[0].points.size(), value);
  const std::string svg = svgOf(chart, 640.0, 360.0, fonts());
  std::vector<std::string> words;
  bool upright =
      false;  // its texts follow those of the level one, whose last is as high as the plot
  for (std::size_t at = svg.find("<text"); at != std::string::npos;
       at = svg.find("<text", at + 1)) {
    const std::size_t y = svg.find("y=\"", at) + 3, from = svg.find('>', at) + 1;
    upright = upright || std::stod(svg.substr(y)) < 310.0;
    if (upright) words.push_back(svg.substr(from, svg.find("</text>", from) - from));
    if (upright && words.back().starts_with("y")) break;
  }
  return words;
}

using Words = std::vector<std::string>;

}  // namespace

// Oracle: decimal arithmetic. What stands at a tick, times the power, plus what is taken off, is
// its value.
TEST_CASE("numbers that have six digits in common are told from a round one among them") {
  CHECK(writtenAlong({9.80665 - 1e-9, 9.80665 + 1e-9}) ==
        Words{"−1.0", "−0.5", "0.0", "0.5", "1.0", "y  (× 10⁻⁹ + 9.80665)"});
  CHECK(writtenAlong({-1234.5678 - 1e-6, -1234.5678 + 1e-6}) ==
        Words{"−1.0", "−0.5", "0.0", "0.5", "1.0", "y  (× 10⁻⁶ − 1234.5678)"});
  CHECK(writtenAlong({3e9 - 1.0, 3e9 + 1.0}) ==
        Words{"−1.0", "−0.5", "0.0", "0.5", "1.0", "y  (+ 3 × 10⁹)"});
  CHECK(writtenAlong({1.234491e-4, 1.234509e-4}) ==
        Words{"−1.0", "−0.5", "0.0", "0.5", "1.0", "y  (× 10⁻⁹ + 0.00012345)"});
  // Fewer are told as they are.
  CHECK(writtenAlong({2345.0, 2347.0}) ==
        Words{"2345.0", "2345.5", "2346.0", "2346.5", "2347.0", "y"});
}

TEST_CASE("an axis moves in as far as its widest number asks, and no further than that") {
  const auto foot = [](double size) {
    Chart chart;
    chart.curves.resize(1);
    chart.curves[0].points = {{0.0, -size}, {1.0, size}};
    chart.curves[0].colour = {0.0f, 0.0f, 1.0f};
    const std::string svg = svgOf(chart, 640.0, 360.0, fonts());
    const std::size_t end = svg.find(" stroke=\"#0000ff\"");
    return std::stod(svg.substr(svg.rfind("d=\"M", end) + 4));
  };
  const double widest =
      SvgDrawing(1.0, 1.0, fonts()).textWidth("−5000000", {13.0, Face::Regular, Align::Left, {}});
  CHECK(foot(5.0) == 64.0);
  CHECK(foot(5e6) == Approx(widest + 10.0 + 4.0).margin(0.01));
}

// Of a bar of 220 px up to 5 million: as they are, six numbers of 52 px would touch.
TEST_CASE("numbers below a colour bar stand apart, and differ") {
  const auto numbersOf = [](double top, std::vector<double> ticks) {
    Image page{400, 100, std::vector<std::uint8_t>(120'000, 255)};
    Canvas canvas(page, fonts(), 1.0);
    canvas.setPaper({1.0f, 1.0f, 1.0f});
    drawColourBar({"", {{1.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}}, 0.0, top, std::move(ticks)},
                  canvas);
    std::vector<std::uint8_t> below(page.rgb.begin() + 3 * 400 * 68, page.rgb.end());
    return below;
  };
  const auto plain = numbersOf(5.0, {0.0, 1.0, 2.0, 3.0, 4.0, 5.0});
  CHECK(numbersOf(5e6, {0.0, 1e6, 2e6, 3e6, 4e6, 5e6}) == plain);
  CHECK(numbersOf(5e-7, {0.0, 1e-7, 2e-7, 3e-7, 4e-7, 5e-7}) == plain);
  CHECK(numbersOf(5e3, {0.0, 5e3}) != plain);
}

TEST_CASE("an axis that begins at zero shows a value as its share of the length") {
  const double values[] = {70.0, 98.0};
  const Scale from({"", false, true}, values, 500.0, 100.0, 40.0);
  CHECK(from.at(0.0) == 500.0);
  CHECK(from.ticks().front().value == 0.0);
  CHECK((500.0 - from.at(49.0)) / (500.0 - from.at(98.0)) == Approx(0.5));
  const double below[] = {-3.0, -1.0};
  CHECK(Scale({"", false, true}, below, 500.0, 100.0, 40.0).at(0.0) == 100.0);
  const double decades[] = {1e-3, 1.0};
  CHECK(Scale({"", true, true}, decades, 0.0, 300.0, 40.0).at(1e-3) == 0.0);
}

TEST_CASE("a chart draws its curves, leaves out what has no place, and repeats to the pixel") {
  Fonts fonts(kFonts);
  Chart chart;
  chart.x = {"error", true};
  chart.y = {"cost", true};
  ChartCurve curve;
  curve.label = "RK4";
  curve.colour = {1.0f, 0.0f, 0.0f};
  curve.points = {{1e-2, 10.0}, {1e-4, 100.0}};
  chart.curves = {curve};
  const Image image = drawChart(chart, 640, 360, 1.0, fonts);
  CHECK(image.width == 640);
  CHECK(image == drawChart(chart, 640, 360, 1.0, fonts));
  const int drawn = countNear(image, curve.colour);
  CHECK(drawn > 300);  // a line across the plot alone covers more

  // A point without a place parts the line; nothing else moves.
  chart.curves[0].points = {{1e-2, 10.0}, {0.0, 50.0}, {1e-4, 100.0}};
  const int parted = countNear(drawChart(chart, 640, 360, 1.0, fonts), curve.colour);
  CHECK(parted < drawn / 2);
  CHECK(parted > 50);  // both marks are still there
}

TEST_CASE("every curve of a chart has a mark of its own shape, and a guide is dashed") {
  Fonts fonts(kFonts);
  std::vector<Image> images;
  for (std::size_t shape = 0; shape < 6; ++shape) {
    Chart chart;
    chart.curves.resize(shape + 1);
    chart.curves.back().points = {{0.0, 0.0}, {1.0, 1.0}};
    images.push_back(drawChart(chart, 320, 180, 0.5, fonts));
    for (std::size_t other = 0; other < shape; ++other) CHECK(images[other] != images[shape]);
  }
  Chart chart;
  chart.curves.resize(1);
  chart.curves.back().points = {{0.0, 0.0}, {1.0, 1.0}};
  chart.guides = {{true, 0.5, "floor"}};
  const Image guided = drawChart(chart, 640, 360, 1.0, fonts);
  chart.guides.clear();
  const Image plain = drawChart(chart, 640, 360, 1.0, fonts);
  int rows = 0;
  for (int y = 0; y < 360; ++y) {
    const auto row = [y](const Image& image) { return image.rgb.begin() + 3 * 640 * y; };
    rows += !std::equal(row(guided), row(guided) + 3 * 640, row(plain));
  }
  CHECK(rows > 0.5 * 254);  // the plot is 254 px high, dashes cover 7 of 12
  CHECK(rows < 0.8 * 254);
}
