#include "app/scene/text.h"

#include <fmt/format.h>

#include "app/scene/body.h"
#include "app/scene/settings.h"

namespace tumble {

namespace {

constexpr std::size_t kMostTexts = 1000;

// Nothing would be seen of a text that begins off the page.
void readPage(Section& section, const ImageFormat& image, TextDef& text) {
  constexpr double kHigh = 720.0;  // px
  section.read("page", text.page.data(), 2, any("px"));
  const double wide = kHigh * image.width / image.height;
  const auto [x, y] = text.page;
  if (section.find("page") && !(x >= 0.0 && x < wide && y >= 0.0 && y < kHigh))
    section.complain("page", fmt::format("[{:g}, {:g}] is off the page, which is {:g} px wide and "
                                         "{:g} px high",
                                         x, y, wide, kHigh));
}

// One of: with a body, at a point, on the page.
void readPlace(Section& section, const ImageFormat& image, const std::vector<BodyDef>& bodies,
               TextDef& text) {
  section.read("body", text.body);
  section.read("point", text.point, any("m"));
  readPage(section, image, text);
  if (section.find("offset")) section.read("offset", text.offset.emplace().data(), 2, any("px"));
  int given = 0;
  for (const char* key : {"body", "point", "page"}) given += section.find(key) != nullptr;
  if (given != 1)
    section.complain("page", "expected one of `body`, a name, `point` [m] and `page` [px]");
  if (section.find("offset") && section.find("page"))
    section.complain("offset", "counts from a body or a point; `page` needs none");
  if (!text.body.empty()) requireBody(section, "body", text.body, bodies);
}

}  // namespace

void readFreeTexts(Section& root, Scene& scene) {
  for (const Node& node : root.tables("text")) {
    const std::string index = std::to_string(scene.texts.size());
    if (scene.texts.size() == kMostTexts) return root.complain("text", "at most 1000");
    TextDef& text = scene.texts.emplace_back();
    Section section(node, "text." + index, root.findings());
    section.read("text", text.text);
    if (text.text.empty()) section.complain("text", "expected what is to be read");
    readPlace(section, scene.image, scene.world.bodies, text);
    section.read("size", text.size, {1.0, 500.0, false, "px"});
    section.read("bold", text.bold);
    readColour(section, "colour", text.colour);
    section.read("from", text.from, notNegative("s"));
    section.read("until", text.until, notNegative("s"));
    if (text.until < text.from) section.complain("until", "before `from`");
    section.finish();
  }
}

}  // namespace tumble
