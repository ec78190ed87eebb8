#include "app/scene/material.h"

#include "app/scene/settings.h"

namespace tumble {

void Material::read(Section& section) {
  section.read("density", density, positive("kg/m³"));
  section.read("restitution", restitution, kShare);
  section.read("friction", friction, notNegative({}));
  readColour(section, "colour", colour);
  readColour(section, "colour_back", back);
}

Materials readMaterials(Section& root) {
  Materials materials;
  const Node* node = root.find("materials");
  if (!node) return materials;
  const Table* table = node->as<Table>();
  if (!table) {
    root.complain("materials", "expected tables like [materials.rubber]");
    return materials;
  }
  for (const Entry& entry : table->entries) {
    const std::string key = "materials." + plain(entry.key);
    if (!isName(entry.key))
      root.findings().complain(entry.spot, key, "a name is made of A-Z a-z 0-9 _ and .");
    Section section(entry.node, key, root.findings());
    Material& material = materials[entry.key];
    material.read(section);
    section.finish();
    material.sound = section.good();
  }
  return materials;
}

void readPairs(Section& root, const Materials& materials, std::vector<PairDef>& pairs) {
  const Node* node = root.find("pairs");
  if (!node) return;
  const Table* table = node->as<Table>();
  if (!table) return root.complain("pairs", "expected rows like \"A-B\" = { friction = 0.6 }");

  for (const Entry& entry : table->entries) {
    // Split the two names and look them up.
    const std::string key = "pairs." + inQuotes(entry.key);
    const std::size_t dash = entry.key.find('-');
    PairDef pair;
    pair.materialA = entry.key.substr(0, dash);
    if (dash != std::string::npos) pair.materialB = entry.key.substr(dash + 1);
    for (const std::string& name : {pair.materialA, pair.materialB})
      if (dash != std::string::npos && !materials.contains(name))
        root.findings().complain(
            entry.spot, key, "unknown material " + inQuotes(name) + hint(name, namesOf(materials)));
    if (dash == std::string::npos)
      root.findings().complain(entry.spot, key, "expected two materials, \"A-B\"");

    // "B-A" is the row "A-B".
    const std::string turned = pair.materialB + "-" + pair.materialA;
    if (turned < entry.key && table->find(turned))
      root.findings().complain(entry.spot, key, "the row " + inQuotes(turned) + " says it already");

    Section section(entry.node, key, root.findings());
    section.read("restitution", pair.restitution, kShare);
    section.read("friction", pair.friction, notNegative({}));
    section.finish();
    pairs.push_back(std::move(pair));
  }
}

std::vector<std::string> namesOf(const Materials& materials) {
  std::vector<std::string> names;
  for (const auto& row : materials) names.push_back(row.first);
  return names;
}

}  // namespace tumble
