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
