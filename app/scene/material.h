// [materials] and [pairs].
#pragma once

#include <map>

#include "app/scene/section.h"

namespace tumble {

/// What bodies of one material share, and may say otherwise themselves.
struct Material {
  std::optional<double> density;  ///< [kg/m³]
  double restitution = 0.0, friction = 0.0;
  std::optional<Rgb> colour;
  std::optional<Rgb> back;  ///< of the half with z < 0 in the body frame
  bool sound = true;        ///< nothing was wrong with its table

  /// Reads the keys that a material has and that a body may have too.
  void read(Section& section);
};

using Materials = std::map<std::string, Material>;

Materials readMaterials(Section& root);

/// Rows "A-B" of known materials.
void readPairs(Section& root, const Materials& materials, std::vector<PairDef>& pairs);

/// The names in the table.
std::vector<std::string> namesOf(const Materials& materials);

}  // namespace tumble
