#include "app/scene/expect.h"

#include <fmt/format.h>

namespace tumble {

namespace {

constexpr std::size_t kMostExpects = 100;

// A number or a formula of it. Whether the key is there.
bool readAim(Section& section, std::string_view key, Relation relation, ExpectDef& expect) {
  const Node* node = section.find(key);
  if (!node) return false;
  expect.relation = relation;
  if (node->as<std::string>())
    section.read(key, expect.aim);
  else
    section.read(key, expect.target, any({}));
  return true;
}

void readAims(Section& section, ExpectDef& expect) {
  const int given = readAim(section, "equals", Relation::Equal, expect) +
                    readAim(section, "at_most", Relation::AtMost, expect) +
                    readAim(section, "at_least", Relation::AtLeast, expect);
  if (given != 1)
    section.complain("equals",
                     fmt::format("expected one of `equals`, `at_most` and `at_least`, a "
                                 "number or a formula; {}",
                                 given == 0 ? "there is none" : "keep one of those given"));
}

void readWhen(Section& section, const Scene& scene, ExpectDef& expect) {
  section.read("over", expect.over, {"start", "end", "max", "min"});
  section.read("at", expect.at, {0.0, scene.world.duration, false, "s"});
  if (!expect.at) return;
  if (section.find("over")) section.complain("at", "`over` is given too; keep one");
  if (isSample(*expect.at, scene.image.rate)) return;
  const double k = std::round(*expect.at * scene.image.rate);
  section.complain("at", fmt::format("between two samples; the nearest one is at {:.17g} s, and "
                                     "image.rate is {:g} a second",
                                     k / scene.image.rate, scene.image.rate));
}

}  // namespace

void readExpects(Section& root, Scene& scene) {
  for (const Node& node : root.tables("expect")) {
    const std::string index = std::to_string(scene.expects.size());
    if (scene.expects.size() == kMostExpects) return root.complain("expect", "at most 100");
    ExpectDef& expect = scene.expects.emplace_back();
    Section section(node, "expect." + index, root.findings(), "expect[" + index + "]");
    section.read("label", expect.label);
    section.read("value", expect.value);
    if (expect.value.empty())
      section.complain("value", "expected a formula, for example \"ball.y\" or \"energy\"");
    readWhen(section, scene, expect);
    readAims(section, expect);
    section.read("within", expect.within, notNegative({}));
    section.finish();
  }
}

}  // namespace tumble
