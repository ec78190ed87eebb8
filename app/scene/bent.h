// What all that bends has in a scene: a surface, a pose, pins, and points that are bodies.
#pragma once

#include <functional>

#include "app/scene/body.h"
#include "sim/elastic/elastic_body.h"

namespace tumble {

inline constexpr int kMostPoints = 20'000;  ///< of one thing that bends

/// The keys that cloth, soft solids and fur share.
struct BentTable {
  std::string name, material;
  double friction = 0.0;
  std::optional<Rgb> colour, back;
  BodyDef pose;           ///< position, orientation and velocities alone
  std::vector<int> pins;  ///< points, in order
  int pinnedTo = kNoBody;
};

/// Reads name, material, friction and colour.
BentTable readBentNamed(Section& section, const Materials& materials);

/// Reads these, colour_back and the pose.
BentTable readBent(Section& section, const Materials& materials);

/// Reads pin_to, the body that pinned points are joined to; without it they stand.
void readPinTo(Section& section, const BodyList& bodies, BentTable& bent);

/// Appends the points as bodies NAME.0, NAME.1, … with a radius [m], the force that joins them, and
/// joints where they are pinned to a body.
/// @param places    [m] in its own frame
/// @param masses    [kg]
/// @param fill      adds elements, by numbers of points plus that of the first
/// @return what is drawn of it, without triangles
BentDef addBent(Section& section, const BentTable& bent, const std::vector<Vec3>& places,
                const std::vector<double>& masses, double radius,
                const std::function<void(ElasticBody&, int first)>& fill, BodyList& bodies,
                Scene& scene);

}  // namespace tumble
