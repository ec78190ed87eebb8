#include "app/scene/array.h"

#include <array>

#include "app/scene/generator.h"
#include "app/scene/vary.h"

namespace tumble {

namespace {

struct GeneratorRow {
  const char* kind;
  Generator (*make)(Section& array, Weather& weather);
};
constexpr std::array<GeneratorRow, 8> kGenerators = {{{"row", makeRow},
                                                      {"tower", makeTower},
                                                      {"wall", makeWall},
                                                      {"rain", makeRain},
                                                      {"fountain", makeFountain},
                                                      {"circle", makeCircle},
                                                      {"spiral", makeSpiral},
                                                      {"rack", makeRack}}};

const GeneratorRow* readKind(Section& section) {
  std::vector<std::string> kinds;
  for (const GeneratorRow& row : kGenerators) kinds.emplace_back(row.kind);
  std::string kind;
  section.read("kind", kind, kinds);
  if (!section.find("kind")) section.complain("kind", "missing" + hint("", kinds));
  for (const GeneratorRow& row : kGenerators)
    if (kind == row.kind) return &row;
  return nullptr;
}

std::string readName(Section& section) {
  std::string name;
  section.read("name", name);
  if (!section.find("name"))
    section.complain("name", "missing; copies are called NAME.0, NAME.1, …");
  return name;
}

// The template, if it is a table without keys that are the array's own business.
const Table* readTemplate(Section& section, const std::vector<std::string>& reserved,
                          std::span<const Variation> variations) {
  const Node* node = section.find("body");
  const Table* body = node ? node->as<Table>() : nullptr;
  if (!body) {
    section.complain("body",
                     "expected a template, for example body = { shape = { sphere = 0.1 } }");
    return nullptr;
  }
  for (const std::string& key : reserved) {
    const Entry* entry = body->find(key);
    if (entry)
      section.findings().complain(entry->node.spot, section.path("body." + key),
                                  "the array itself decides on this; leave it out");
    for (const Variation& variation : variations)
      if (variation.key[0] == key)
        section.findings().complain(variation.spot, section.path("vary"),
                                    "the array itself decides on " + key);
  }
  return body;
}

// Reads the template once per copy, each time with the numbers of that copy.
void expand(Section& section, const std::string& name, Generator& generator, Node body,
            std::span<const Variation> variations, const Materials& materials, BodyList& bodies) {
  Findings& findings = section.findings();
  const std::size_t before = findings.count();
  for (int i = 0; i < generator.count && findings.count() == before; ++i) {
    if (bodies.full(section.spot(), findings)) return;
    for (const Variation& variation : variations)
      variation.apply(*body.as<Table>(), i, generator.count);
    Section copy(body, section.path("body"), findings, bodies.nextPath());
    BodyEntry entry = readBody(copy, name + "." + std::to_string(i), materials);
    if (!copy.good()) return;
    const std::string wrong = generator.place(i, entry.def);
    if (!wrong.empty()) return section.complain("body", wrong);
    bodies.add(std::move(entry), section.spot(), section);
  }
}

void readArray(const Node& node, std::size_t number, Section& root, const Materials& materials,
               Weather& weather, BodyList& bodies) {
  Section section(node, pathOf("array", node, number), root.findings());
  if (!node.as<Table>()) return;

  const std::string name = readName(section);
  bodies.claim(section, name, "array");
  const GeneratorRow* row = readKind(section);
  if (!row) return;
  Generator generator = row->make(section, weather);
  std::vector<std::string> reserved = generator.reserved;
  reserved.emplace_back("name");
  const std::vector<Variation> variations = readVary(section);
  const Table* body = readTemplate(section, reserved, variations);
  section.finish();
  if (body && section.good())
    expand(section, name, generator, *section.find("body"), variations, materials, bodies);
}

}  // namespace

void readArrays(Section& root, const Materials& materials, std::uint64_t seed, const Vec3& gravity,
                BodyList& bodies) {
  Weather weather{seed, gravity, {}};
  std::size_t number = 0;
  for (const Node& node : root.tables("array"))
    readArray(node, number++, root, materials, weather, bodies);
}

}  // namespace tumble
