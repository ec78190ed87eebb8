// Cloths and soft boxes as bodies of a world.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/elastic/cloth.h"
#include "sim/elastic/soft.h"
#include "sim/method/model.h"

namespace tumble {

/// Points of what bends in a world, as its last bodies. @return the number of the first
inline int addPoints(WorldDef& def, const std::string& name, const std::vector<Vec3>& places,
                     const std::vector<double>& masses, const Vec3& middle, double skin,
                     double friction) {
  const int first = static_cast<int>(def.bodies.size());
  for (std::size_t p = 0; p < places.size(); ++p)
    def.bodies.push_back({.name = name + "." + std::to_string(p),
                          .shape = Particle{skin},
                          .mass = masses[p],
                          .friction = friction,
                          .position = middle + places[p]});
  return first;
}

/// Lets the bodies from the first on bend by those elements.
inline int bend(WorldDef& def, const std::string& name, int first, std::vector<Element> elements,
                Sheet sheet = {}) {
  auto body = std::make_shared<ElasticBody>();
  body->name = name;
  for (int i = first; i < static_cast<int>(def.bodies.size()); ++i) body->bodies.push_back(i);
  body->elements = std::move(elements);
  body->sheet = std::move(sheet);
  def.forces.push_back(Bending{body});
  return first;
}

/// A cloth in a world. @return the number of its first point
inline int addCloth(WorldDef& def, const ClothDef& cloth, const Vec3& middle, double skin,
                    double friction = 0.0) {
  const int first =
      addPoints(def, "cloth", clothPlaces(cloth), clothMasses(cloth), middle, skin, friction);
  return bend(def, "cloth", first, clothElements(cloth, first),
              clothSheet(cloth, 2.0 * skin, first));
}

/// A cloth of n × n points, with sides of that length [m], level over a fixed ball and nearly on
/// it. Its skin is 0.01 m; its shear is a tenth of `stretch` [N/m].
inline WorldDef clothOnBall(int n, double side, double stretch, double radius, double friction) {
  constexpr double kSkin = 0.01;
  WorldDef def;
  def.stepping.step = 1.0 / 60.0;
  def.bodies.push_back({.name = "ball",
                        .shape = Sphere{radius},
                        .mass = 1.0,
                        .friction = friction,
                        .position = {0.0, -(radius + kSkin), 0.0},
                        .fixed = true});
  const ClothDef cloth{.columns = n,
                       .rows = n,
                       .length = side,
                       .width = side,
                       .density = 0.2,
                       .stretch = stretch,
                       .shear = 0.1 * stretch,
                       .bend = 2e-5,
                       .damping = 0.2};
  addCloth(def, cloth, {0.0, kSkin, 0.0}, kSkin, friction);
  return def;
}

/// The same where nothing keeps cloth from passing through cloth.
inline WorldDef withoutLayers(WorldDef def) {
  for (Force& force : def.forces) {
    auto body = std::make_shared<ElasticBody>(*std::get<Bending>(force).body);
    body->sheet.thickness = 0.0;
    force = Bending{body};
  }
  return def;
}

/// A soft box in a world. @return the number of its first point
inline int addSoft(WorldDef& def, const SoftDef& soft, const Vec3& middle, double skin,
                   double friction = 0.5) {
  const int first =
      addPoints(def, "soft", softPlaces(soft), softMasses(soft), middle, skin, friction);
  return bend(def, "soft", first, softElements(soft, first));
}

}  // namespace tumble
