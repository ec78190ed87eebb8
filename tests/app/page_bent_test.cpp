// What bends, on the page that plays a run.
#include "app/export/page_bent.h"

#include <libdeflate.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/export/page.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

// What `packed` packed.
std::string unpacked(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> zlib(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  std::string out(1 << 22, '\0');
  std::size_t size = 0;
  REQUIRE(libdeflate_zlib_decompress(zlib.get(), bytes.data(), bytes.size(), out.data(), out.size(),
                                     &size) == LIBDEFLATE_SUCCESS);
  out.resize(size);
  return out;
}

// What `differences` wrote, series after series of that length.
std::vector<int> summed(const std::string& bytes, std::size_t length) {
  std::vector<int> values;
  const std::size_t total = bytes.size() / 2;
  for (std::size_t at = 0; at < total; ++at) {
    const int folded =
        static_cast<unsigned char>(bytes[at]) + 256 * static_cast<unsigned char>(bytes[total + at]);
    const int step = folded % 2 ? -(folded + 1) / 2 : folded / 2;
    values.push_back(((at % length ? values.back() : 0) + step) & 65535);
  }
  return values;
}

}  // namespace

// Oracle: the recording. Nearest grain: half of one, measured 0.5 of a grain of 0.1 mm.
TEST_CASE("the page has each drawn point of what bends to half a grain, and no ball for it") {
  const Scene scene = parseScene(R"([world]
method = "stepping"
duration = 0.2
[[body]]
name = "post"
shape = { box = [0.2, 0.2, 0.2] }
fixed = true
[[cloth]]
name = "cloth"
columns = 4
rows = 3
size = [0.6, 0.4]
position = [1, 0.5, 0]
thickness = 0.02
density = 0.2
stretch = 50.0
[[fur]]
name = "hair"
on = "post"
strands = 3
points = 5
length = 0.2
thickness = 0.01
density = 0.002
stretch = 20.0
bend = 1e-5
)",
                                 "bends");
  const Recording recording = record(scene, 60.0);
  const nlohmann::json bent = bentJson(scene, recording, 0.4);
  const double grain = bent["grain"];
  CHECK(grain == Approx(0.4 / 4096.0));
  const std::size_t samples = recording.samples.size();
  std::vector<int> places = summed(unpacked(bent["places"]), samples);
  std::vector<std::size_t> drawn;  // all of the cloth; of a strand all but what its body hides
  for (std::size_t p = 1; p <= 12; ++p) drawn.push_back(p);
  for (std::size_t p = 13; p < 13 + 15; ++p)
    if ((p - 13) % 5 > 0) drawn.push_back(p);
  REQUIRE(places.size() == 3 * drawn.size() * samples);
  // Of strands each point but the first is told from the one before.
  for (std::size_t n = 12; n < drawn.size(); ++n)
    for (std::size_t i = 3 * n * samples; (n - 12) % 4 > 0 && i < 3 * (n + 1) * samples; ++i)
      places[i] = (places[i] + places[i - 3 * samples]) & 65535;
  double worst = 0.0;
  for (std::size_t n = 0; n < drawn.size(); ++n)
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t k = 0; k < samples; ++k) {
        const double told = bent["low"][axis].get<double>() +
                            grain * places[(3 * n + static_cast<std::size_t>(axis)) * samples + k];
        worst = std::max(worst, std::abs(told - recording.samples[k].bodies[drawn[n]].x[axis]));
      }
  CHECK(worst <= 0.5 * grain * (1.0 + 1e-9));
  CHECK(worst > 0.4 * grain);
  const std::string page = pageHtml(scene, recording);
  CHECK(page.find("\"name\":\"post\"") != std::string::npos);
  CHECK(page.find("\"name\":\"cloth.0\"") == std::string::npos);
  CHECK(page.find("sheetThrough") != std::string::npos);
  const Scene rigid = parseScene(
      "[world]\nduration = 0.1\n[[body]]\nname = \"ball\"\nmass = 1.0\n"
      "shape = { sphere = 0.1 }\n",
      "rigid");
  CHECK(pageHtml(rigid, record(rigid, 60.0)).find("sheetThrough") == std::string::npos);
}
