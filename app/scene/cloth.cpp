#include "app/scene/cloth.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/scene/bent.h"
#include "sim/elastic/cloth.h"

namespace tumble {

namespace {

ClothDef readWeave(Section& section) {
  ClothDef cloth;
  for (const char* key : {"columns", "rows"})
    if (!section.find(key)) section.complain(key, "missing; how many points there are along it");
  section.read("columns", cloth.columns, 2, kMostPoints);
  section.read("rows", cloth.rows, 2, kMostPoints);
  if (section.good() && static_cast<long>(cloth.columns) * cloth.rows > kMostPoints)
    section.complain("columns", "more than " + std::to_string(kMostPoints) +
                                    " points in one cloth; take fewer columns or rows");
  double size[2] = {cloth.length, cloth.width};
  if (!section.find("size")) section.complain("size", "missing; [length, width] in m");
  section.read("size", size, 2, kLength);
  cloth.length = size[0];
  cloth.width = size[1];
  section.read("density", cloth.density, positive("kg/m²"));
  section.read("stretch", cloth.stretch, notNegative("N/m"));
  section.read("shear", cloth.shear, notNegative("N/m"));
  section.read("bend", cloth.bend, notNegative("N m"));
  section.read("damping", cloth.damping, notNegative("N s/m"));
  return cloth;
}

// One pin: [column, row].
void readPin(Section& section, const Node& node, const ClothDef& cloth, std::vector<int>& pins) {
  const Array* pair = node.as<Array>();
  const auto number = [&](std::size_t k, int end) -> int {
    const std::int64_t* value = (*pair)[k].as<std::int64_t>();
    return value && *value >= 0 && *value < end ? static_cast<int>(*value) : -1;
  };
  const bool two = pair && pair->size() == 2;
  const int column = two ? number(0, cloth.columns) : -1, row = two ? number(1, cloth.rows) : -1;
  if (column >= 0 && row >= 0) return pins.push_back(clothPoint(cloth, column, row));
  section.complain("pins", "expected pairs [column, row], columns from 0 to " +
                               std::to_string(cloth.columns - 1) + ", rows from 0 to " +
                               std::to_string(cloth.rows - 1));
}

// "corners", "row" or "column" (the first of them), or a list of pairs.
void readPins(Section& section, const ClothDef& cloth, std::vector<int>& pins) {
  const Node* node = section.find("pins");
  if (!node || !section.good()) return;
  const int m = cloth.columns, n = cloth.rows;
  const Array* list = node->as<Array>();
  for (std::size_t k = 0; list && k < list->size() && section.good(); ++k)
    readPin(section, (*list)[k], cloth, pins);
  std::string word;
  if (!list) section.read("pins", word, {"corners", "row", "column"});
  for (int i = 0; word == "row" && i < m; ++i) pins.push_back(clothPoint(cloth, i, 0));
  for (int j = 0; word == "column" && j < n; ++j) pins.push_back(clothPoint(cloth, 0, j));
  if (word == "corners")
    for (const int i : {0, m - 1})
      for (const int j : {0, n - 1}) pins.push_back(clothPoint(cloth, i, j));
}

}  // namespace

void readCloths(Section& root, const Materials& materials, BodyList& bodies, Scene& scene) {
  std::size_t number = 0;
  for (const Node& node : root.tables("cloth")) {
    Section section(node, pathOf("cloth", node, number++), root.findings());
    if (!node.as<Table>()) continue;
    BentTable bent = readBent(section, materials);
    bodies.claim(section, bent.name, "cloth");
    const ClothDef cloth = readWeave(section);
    double thickness = 0.01;
    section.read("thickness", thickness, kLength);
    const double narrow = std::min(cloth.length, cloth.width);
    if (section.good() && thickness > narrow)
      section.complain("thickness", fmt::format("{:g} m is more than the {:g} m that the cloth is "
                                                "wide; take [[soft]] for what is as thick",
                                                thickness, narrow));
    readPins(section, cloth, bent.pins);
    readPinTo(section, bodies, bent);
    section.finish();
    if (!section.good()) continue;
    scene.bent.push_back(addBent(
        section, bent, clothPlaces(cloth), clothMasses(cloth), 0.5 * thickness,
        [&](ElasticBody& body, int first) {
          body.elements = clothElements(cloth, first);
          body.sheet = clothSheet(cloth, thickness, first);
        },
        bodies, scene));
    scene.bent.back().triangles = clothTriangles(cloth);
    scene.bent.back().columns = cloth.columns;
    scene.bent.back().thickness = thickness;
  }
}

}  // namespace tumble
