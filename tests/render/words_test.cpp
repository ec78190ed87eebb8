// Words in the room that there is for them: none is cut at an edge.
#include <algorithm>
#include <numeric>

#include "render/canvas.h"
#include "render/chart.h"
#include "render/sheet.h"
#include "render/svg.h"
#include "tests/render/studio.h"

using namespace tumble;

namespace {

const Drawing::TextStyle kStyle{14.0, Face::Regular, Align::Left, ink::text};

const std::string kSentence =
    "a sentence that is far longer than the room there is for it on any page of such a size";

std::string joined(const std::vector<std::string>& lines) {
  return std::accumulate(lines.begin(), lines.end(), std::string(),
                         [](const std::string& all, const std::string& line) {
                           return all.empty() ? line : all + " " + line;
                         });
}

/// A text of an SVG document, and what it covers from left to right.
struct Text {
  std::string words;
  double left, right, y, size;
};

std::vector<Text> textsOf(const std::string& svg) {
  std::vector<Text> all;
  for (std::size_t at = svg.find("<text"); at != std::string::npos;
       at = svg.find("<text", at + 1)) {
    const std::string head = svg.substr(at, svg.find('>', at) - at);
    const auto number = [&](const std::string& key) {
      return std::stod(head.substr(head.find(" " + key + "=\"") + key.size() + 3));
    };
    const std::size_t from = at + head.size() + 1;
    Text text{svg.substr(from, svg.find("</text>", from) - from), number("x"), 0.0, number("y"),
              number("font-size")};
    const Face face = head.find("bold") != std::string::npos ? Face::Bold : Face::Regular;
    const double width = fonts().set(text.words, face, text.size, 0.0).advance;
    if (head.find("\"end\"") != std::string::npos) text.left -= width;
    text.right = text.left + width;
    all.push_back(std::move(text));
  }
  return all;
}

Chart wordy() {
  Chart chart;
  chart.title = "A title, " + kSentence + ", and " + kSentence;
  chart.subtitle = "A subtitle, " + kSentence + ", and " + kSentence;
  chart.x.caption = "a level caption, " + kSentence;
  chart.y.caption = "an upright caption, " + kSentence;
  for (const char* label : {"first", "second", "third"}) {
    ChartCurve& curve = chart.curves.emplace_back();
    curve.label = std::string(label) + ", " + kSentence;
    curve.points = {{0.0, 0.0}, {1.0, 1.0}};
    curve.colour = {0.0f, 0.0f, 1.0f};
  }
  chart.guides = {{true, 0.95, "an upright guide"}, {false, 0.5, "a level guide, " + kSentence}};
  return chart;
}

}  // namespace

TEST_CASE("words go into more lines, else become smaller, else end in three dots") {
  SvgDrawing page(640.0, 360.0, fonts());
  const auto widths = [&](const Drawing::Words& words) {
    Drawing::TextStyle style = kStyle;
    style.size = words.size;
    double widest = 0.0;
    for (const std::string& line : words.lines)
      widest = std::max(widest, page.textWidth(line, style));
    return widest;
  };
  const double whole = page.textWidth(kSentence, kStyle);
  const Drawing::Words one = page.fitted(kSentence, whole + 1.0, 1, kStyle, 10.0);
  CHECK(one.lines == std::vector<std::string>{kSentence});
  CHECK(one.size == 14.0);
  const Drawing::Words two = page.fitted(kSentence, 0.6 * whole, 2, kStyle, 10.0);
  CHECK(two.lines.size() == 2);
  CHECK(two.size == 14.0);
  CHECK(joined(two.lines) == kSentence);
  const Drawing::Words small = page.fitted(kSentence, 0.8 * whole, 1, kStyle, 10.0);
  CHECK(joined(small.lines) == kSentence);
  CHECK(small.size < 12.0);
  CHECK(small.size >= 10.0);
  for (const std::size_t most : {1, 2, 3}) {
    CAPTURE(most);
    const Drawing::Words cut = page.fitted(kSentence, 100.0, most, kStyle, 10.0);
    CHECK(cut.lines.size() == most);
    CHECK(cut.size == 10.0);
    CHECK(widths(cut) <= 100.0);
    const std::string text = joined(cut.lines);
    REQUIRE(text.ends_with("…"));
    CHECK(kSentence.starts_with(text.substr(0, text.size() - std::string("…").size())));
  }
  // A word is cut behind a letter, of however many bytes, and no text is none.
  const Drawing::Words word = page.fitted("ααααααααααααααααααααα", 60.0, 2, kStyle, 10.0);
  REQUIRE(word.lines.size() == 1);
  CHECK(decodeUtf8(word.lines[0]).find(U'\uFFFD') == std::u32string::npos);
  CHECK(word.lines[0].ends_with("α…"));
  CHECK(page.fitted("", 60.0, 2, kStyle, 10.0).lines.empty());
}

// Oracle: the page.
TEST_CASE("a chart whose words are all too long keeps them on its page, and room for its curves") {
  const Chart chart = wordy();
  using Size = Eigen::Vector2d;
  for (const Size& size : {Size(240.0, 720.0), Size(480.0, 270.0), Size(640.0, 480.0),
                           Size(800.0, 450.0), Size(1280.0, 720.0)}) {
    CAPTURE(size.x());
    const std::string svg = svgOf(chart, size.x(), size.y(), fonts());
    const std::vector<Text> texts = textsOf(svg);
    for (const Text& text : texts) {
      CAPTURE(text.words);
      CHECK(text.left >= 0.0);
      CHECK(text.right <= size.x());
      CHECK(text.y - 0.7 * text.size >= 0.0);
      CHECK(text.y <= size.y() - 2.0);
      CHECK(text.size >= 9.0);
      for (const Text& other : texts)
        if (&other != &text && other.y == text.y)
          CHECK((other.right < text.left || text.right < other.left));
    }
    const std::size_t end = svg.find(" stroke=\"#0000ff\""), start = svg.rfind("d=\"M", end);
    const double from = std::stod(svg.substr(start + 4)),
                 to = std::stod(svg.substr(svg.find('L', start) + 1));
    CHECK(to - from > 0.2 * size.x());
  }
}

// Oracle: the margins of a page with one panel, beside which nothing is drawn.
TEST_CASE("a page of panels has its title on as many lines as it takes") {
  Panel panel{{320, 180, std::vector<std::uint8_t>(3 * 320 * 180, 200)}, "caption", ""};
  const auto inkIn = [](const Image& page, int from, int to) {
    int ink = 0;
    for (int y = 0; y < page.height; ++y)
      for (int x = from; x < to; ++x) ink += brightness(page, x, y) < 150.0;
    return ink;
  };
  const Image brief = drawSheet({&panel, 1}, 1, "Title", "Subtitle", fonts());
  const Image page =
      drawSheet({&panel, 1}, 1, "Title, " + kSentence, "Subtitle, " + kSentence, fonts());
  REQUIRE(page.width == brief.width);
  CHECK(inkIn(page, page.width - 31, page.width) == 0);
  CHECK(inkIn(page, 32, page.width - 31) > 3 * inkIn(brief, 32, page.width - 31));
  CHECK(page.height > brief.height + 26 + 19);
}

namespace {

// A picture with nothing on it. In the plane z = 0 a metre is 180 px, (0, 0, 0) is in the middle.
Picture empty() {
  Picture picture;
  picture.camera = straight(0.0);
  picture.floor.visible = false;
  return picture;
}

// Pixels of ink in a picture of nothing, on a page that is brighter further down.
double inkOn(const Picture& picture, const RenderOptions& options = kFull) {
  const Image page = studio().draw(empty(), options), image = studio().draw(picture, options);
  double sum = 0.0;
  for (std::size_t i = 0; i < page.rgb.size(); i += 3)
    sum += std::max(0.0, (page.rgb[i] - image.rgb[i]) / (page.rgb[i] - 255.0 * ink::text[0]));
  return sum;
}

Label textAt(double x, double y, const std::string& text, Align align = Align::Left) {
  Label label;
  label.offset = {x, y};
  label.text = text;
  label.size = 16.0f;
  label.align = align;
  return label;
}

// The same at a pixel of the plane z = 0.
Label textBeside(double x, double y, const std::string& text) {
  Label label = textAt(8.0, 5.0, text);
  label.anchor = Eigen::Vector3d((x - 640.0) / 180.0, (360.0 - y) / 180.0, 0.0);
  return label;
}

}  // namespace

// Oracle: the same words have the same ink wherever they stand, but for where letters fall between
// pixels. Measured within 1 %; a letter of the shorter is 5 %.
TEST_CASE("a text that the edge of the page would cut moves in, or takes more lines") {
  Picture picture = empty();
  for (const std::string& text : {std::string("the edge of the page"), kSentence}) {
    CAPTURE(text);
    picture.labels = {textAt(100.0, 300.0, text)};
    const double whole = inkOn(picture);
    for (const Label& label :
         {textAt(1270.0, 300.0, text), textAt(900.0, 300.0, text), textAt(100.0, 719.0, text),
          textAt(100.0, 0.0, text), textAt(1270.0, 719.0, text),
          textAt(20.0, 300.0, text, Align::Right), textAt(1250.0, 300.0, text, Align::Centre),
          textBeside(1260.0, 300.0, text), textBeside(900.0, 715.0, text)}) {
      CAPTURE(label.offset.x(), label.offset.y(), label.anchor.has_value());
      picture.labels = {label};
      CHECK(inkOn(picture) == Approx(whole).epsilon(0.03));
      picture.labels[0].apart = true;
      CHECK((!label.anchor || inkOn(picture) > 0.97 * whole));
    }
  }
  // What goes with a point that leaves the page leaves it, too.
  picture.labels = {textBeside(-60.0, 300.0, "the edge of the page")};
  const double part = inkOn(picture);
  picture.labels = {textBeside(100.0, 300.0, "the edge of the page")};
  CHECK(part > 0.0);
  CHECK(part < 0.8 * inkOn(picture));
}

TEST_CASE("lines of a text on the page keep others off") {
  Picture picture = empty();
  picture.labels = {textAt(900.0, 300.0, kSentence)};
  const double one = inkOn(picture);
  picture.labels.push_back(textBeside(892.0, 317.0, "at a point"));
  const double both = inkOn(picture);
  picture.labels.erase(picture.labels.begin());
  CHECK(both == Approx(one + inkOn(picture)).epsilon(0.03));
}

TEST_CASE("the words of a mark near an edge of the page are all there") {
  Picture picture = empty();
  const auto mark = [](double x, double y) {
    return Mark{{(x - 640.0) / 180.0, (360.0 - y) / 180.0, 0.0}, {"t = 0.2345 s", "j = 1.234 N s"}};
  };
  picture.marks = {mark(640.0, 360.0)};
  const double whole = inkOn(picture);
  for (const auto& [x, y] :
       {std::pair(12.0, 360.0), {1268.0, 360.0}, {640.0, 700.0}, {1268.0, 700.0}}) {
    CAPTURE(x, y);
    picture.marks = {mark(x, y)};
    CHECK(inkOn(picture) == Approx(whole).epsilon(0.08));
  }
}

TEST_CASE("a colour bar has its words on a page that is narrower than they are with it") {
  Picture picture = empty();
  picture.bar = {
      "speed / m/s", {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}, 0.0, 2.0, {0.0, 1.0, 2.0}};
  const RenderOptions narrow{.width = 240, .height = 720};
  const Image page = studio().draw(empty(), narrow), image = studio().draw(picture, narrow);
  int left = 240, right = 0, above = 0;
  for (int y = 0; y < 720; ++y)
    for (int x = 0; x < 240; ++x) {
      if (brightness(image, x, y) > brightness(page, x, y) - 30.0) continue;
      left = std::min(left, x), right = std::max(right, x);
      above += y < 670;
    }
  CHECK(left > 20);
  CHECK(right < 220);
  CHECK(above > 100);
}
