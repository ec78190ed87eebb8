// Cloths and soft boxes as bodies of a world.
#pragma once

#include <memory>
#include <string>

#include "sim/elastic/cloth.h"
#include "sim/elastic/soft.h"
#include "sim/method/model.h"

namespace tumble {

/// A cloth in a world: its points are the last bodies. @return the number of its first point
inline int addCloth(WorldDef& def, const ClothDef& cloth, const Vec3& middle, double skin,
                    double friction = 0.0) {
  const int first = static_cast<int>(def.bodies.size());
  const auto places = clothPlaces(cloth);
  const auto masses = clothMasses(cloth);
  auto body = std::make_shared<ElasticBody>();
  body->name = "cloth";
  for (std::size_t p = 0; p < places.size(); ++p) {
    body->bodies.push_back(first + static_cast<int>(p));
    def.bodies.push_back({.name = "cloth." + std::to_string(p),
                          .shape = Particle{skin},
                          .mass = masses[p],
                          .friction = friction,
                          .position = middle + places[p]});
  }
  body->elements = clothElements(cloth, first);
  def.forces.push_back(Bending{body});
  return first;
}

/// A soft box in a world. @return the number of its first point
inline int addSoft(WorldDef& def, const SoftDef& soft, const Vec3& middle, double skin,
                   double friction = 0.5) {
  const int first = static_cast<int>(def.bodies.size());
  const auto places = softPlaces(soft);
  const auto masses = softMasses(soft);
  auto body = std::make_shared<ElasticBody>();
  body->name = "soft";
  for (std::size_t p = 0; p < places.size(); ++p) {
    body->bodies.push_back(first + static_cast<int>(p));
    def.bodies.push_back({.name = "soft." + std::to_string(p),
                          .shape = Particle{skin},
                          .mass = masses[p],
                          .friction = friction,
                          .position = middle + places[p]});
  }
  body->elements = softElements(soft, first);
  def.forces.push_back(Bending{body});
  return first;
}

}  // namespace tumble
