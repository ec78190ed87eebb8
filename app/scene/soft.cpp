#include "app/scene/soft.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/scene/bent.h"
#include "sim/elastic/soft.h"

namespace tumble {

namespace {

constexpr int kMostCells = 200;                 // along an edge
constexpr Range kYoung{0.0, 1e15, true, "Pa"};  // a thousand times diamond's: stiffer is rounding

void readCells(Section& section, SoftDef& soft) {
  const Node* node = section.find("cells");
  const Array* list = node ? node->as<Array>() : nullptr;
  bool right = list && list->size() == 3;
  for (std::size_t k = 0; right && k < 3; ++k) {
    const std::int64_t* value = (*list)[k].as<std::int64_t>();
    right = value && *value >= 1 && *value <= kMostCells;
    if (right) soft.cells[k] = static_cast<int>(*value);
  }
  if (!right)
    return section.complain("cells", "expected three whole numbers from 1 to " +
                                         std::to_string(kMostCells) + ", along x, y and z");
  if (softPoints(soft) > kMostPoints)
    section.complain("cells", "more than " + std::to_string(kMostPoints) +
                                  " points in one soft body; take fewer cells");
}

SoftDef readSolid(Section& section) {
  SoftDef soft;
  readCells(section, soft);
  if (!section.find("size")) section.complain("size", "missing; three edges in m");
  section.read("size", soft.size, kLength);
  section.read("density", soft.density, positive("kg/m³"));
  std::string law = "corotated";
  section.read("law", law, {"corotated", "neo-hookean", "lattice", "matching"});
  soft.law = law == "lattice"     ? SoftLaw::Lattice
             : law == "matching"  ? SoftLaw::Matching
             : law == "corotated" ? SoftLaw::Corotated
                                  : SoftLaw::NeoHookean;
  const bool lattice = soft.law == SoftLaw::Lattice, matching = soft.law == SoftLaw::Matching;
  double young = 0.0, poisson = lattice ? 0.25 : matching ? 0.0 : 0.3, viscosity = 0.0;
  if (!section.find("young")) section.complain("young", "missing; Young's modulus in Pa");
  section.read("young", young, kYoung);
  section.read("poisson", poisson, {0.0, 0.49, false, {}});
  section.read("viscosity", viscosity, notNegative("Pa s"));
  if (lattice && poisson != 0.25)
    section.complain("poisson", "springs that pull along themselves alone have 0.25; leave it out");
  if (matching && poisson != 0.0)
    section.complain("poisson", "cells that are drawn to their shape have 0; leave it out");
  if (section.good()) soft.solid = solidityOf(young, poisson, viscosity);
  if (section.good() && lattice && !hasLattice(soft))
    section.complain("cells",
                     "too flat for a lattice, whose springs would push; take cells whose "
                     "edges are more alike");
  return soft;
}

// A side of the box, by its direction.
void readPins(Section& section, const SoftDef& soft, std::vector<int>& pins) {
  const std::vector<std::string> sides = {"-x", "+x", "-y", "+y", "-z", "+z"};
  std::string word;
  section.read("pins", word, sides);
  if (!section.find("pins") || !section.good()) return;
  const std::size_t side = std::find(sides.begin(), sides.end(), word) - sides.begin();
  for (const SoftFace& face : softFaces(soft))
    if (static_cast<std::size_t>(face.side) == side)
      pins.insert(pins.end(), face.points.begin(), face.points.end());
}

}  // namespace

void readSofts(Section& root, const Materials& materials, BodyList& bodies, Scene& scene) {
  std::size_t number = 0;
  for (const Node& node : root.tables("soft")) {
    Section section(node, pathOf("soft", node, number++), root.findings());
    if (!node.as<Table>()) continue;
    BentTable bent = readBent(section, materials);
    bodies.claim(section, bent.name, "soft box");
    const SoftDef soft = readSolid(section);
    double skin = 0.005;
    section.read("skin", skin, kLength);
    if (section.good() && skin > 0.5 * soft.size.minCoeff())
      section.complain("skin", fmt::format("{:g} m is more than half of its shortest edge, {:g} m; "
                                           "take a thinner skin",
                                           skin, soft.size.minCoeff()));
    readPins(section, soft, bent.pins);
    readPinTo(section, bodies, bent);
    section.finish();
    if (!section.good()) continue;
    BentDef drawn = addBent(
        section, bent, softPlaces(soft), softMasses(soft), skin,
        [&](ElasticBody& body, int first) { body.elements = softElements(soft, first); }, bodies,
        scene);
    for (const SoftFace& face : softFaces(soft)) {
      drawn.triangles.push_back(face.points);
      drawn.sides.push_back(face.side);
    }
    drawn.skin = skin;
    scene.bent.push_back(std::move(drawn));
  }
}

}  // namespace tumble
