// Text: decoding, fallback, kerning.
#include "render/font.h"

#include <numeric>

#include "render/canvas.h"
#include "tests/catch.h"
#include "tests/render/studio.h"

using namespace tumble;

namespace {

long inkOf(const TextImage& image) {
  return std::accumulate(image.ink.begin(), image.ink.end(), 0L);
}

}  // namespace

// Oracle: the definition of UTF-8; a malformed byte becomes U+FFFD and what follows is read on.
TEST_CASE("UTF-8 is decoded, and malformed bytes are shown") {
  CHECK(decodeUtf8("aε∝𝄞") == U"aε∝𝄞");
  CHECK(decodeUtf8("\xce") == U"\uFFFD");
  CHECK(decodeUtf8("\xff"
                   "b") ==
        U"\uFFFD"
        U"b");
  CHECK(decodeUtf8("\xe2\x88"
                   "b") ==
        U"\uFFFD"
        U"b");
}

TEST_CASE("a glyph that Lato lacks is drawn from DejaVu Sans") {
  // Lato 2.0 has no proportional sign, parallel or perpendicular; DejaVu has.
  for (const char32_t letter : {U'∝', U'∥', U'⊥'}) CHECK_FALSE(fonts().has(Face::Regular, letter));
  CHECK(fonts().has(Face::Regular, U'ε'));
  const TextImage missing =
      fonts().set("\uE123", Face::Regular, 40.0, 0.0);  // in neither: the empty box
  for (const char* text : {"∝", "∥", "⊥"}) {
    const TextImage& glyph = fonts().set(text, Face::Regular, 40.0, 0.0);
    CHECK(inkOf(glyph) > 255 * 50);
    CHECK(glyph.ink != missing.ink);
  }
}

TEST_CASE("A and V are set closer than they stand alone") {
  const double a = fonts().set("A", Face::Regular, 40.0, 0.0).advance;
  const double v = fonts().set("V", Face::Regular, 40.0, 0.0).advance;
  CHECK(fonts().set("AV", Face::Regular, 40.0, 0.0).advance < a + v - 1.0);
}

// Oracle: ink grows with the square of the size. Measured 4.000 within 0.02, allowed 0.1.
TEST_CASE("text of twice the size has four times the ink") {
  const double small = static_cast<double>(inkOf(fonts().set("tumble", Face::Bold, 40.0, 0.0)));
  const double large = static_cast<double>(inkOf(fonts().set("tumble", Face::Bold, 80.0, 0.0)));
  CHECK(large / small == Approx(4.0).margin(0.1));
}

TEST_CASE("text stands left of, about and right of its pen, as it is aligned") {
  const Align aligns[] = {Align::Left, Align::Centre, Align::Right};
  double middles[3];
  for (int k = 0; k < 3; ++k) {
    Image page{300, 60, std::vector<std::uint8_t>(54000, 255)};
    Canvas canvas(page, fonts(), 1.0);
    canvas.setPaper({1.0f, 1.0f, 1.0f});
    canvas.text({150.0, 40.0}, "HHHH", {20.0, Face::Regular, aligns[k], {0.0f, 0.0f, 0.0f}});
    double sum = 0.0, weight = 0.0;
    for (int i = 0; i < 300 * 60; ++i) {
      sum += (255 - page.rgb[3 * i]) * (i % 300 + 0.5);
      weight += 255 - page.rgb[3 * i];
    }
    middles[k] = sum / weight;
  }
  const double width = fonts().set("HHHH", Face::Regular, 20.0, 0.0).advance;
  CHECK(middles[0] == Approx(150.0 + 0.5 * width).margin(0.6));
  CHECK(middles[1] == Approx(150.0).margin(0.6));
  CHECK(middles[2] == Approx(150.0 - 0.5 * width).margin(0.6));
}
