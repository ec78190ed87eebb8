#include "app/scene/bent.h"

#include <algorithm>

#include "app/scene/settings.h"
#include "app/scene/shape.h"

namespace tumble {

namespace {

void readSurface(Section& section, const Materials& materials, BentTable& bent) {
  section.read("material", bent.material);
  const auto row = materials.find(bent.material);
  if (row != materials.end()) {
    bent.friction = row->second.friction;
    bent.colour = row->second.colour;
    bent.back = row->second.back;
  } else if (section.find("material")) {
    section.complain("material", "unknown material " + inQuotes(bent.material) +
                                     hint(bent.material, namesOf(materials)));
  }
  section.read("friction", bent.friction, notNegative({}));
  readColour(section, "colour", bent.colour);
}

void readPose(Section& section, BodyDef& pose) {
  section.read("position", pose.position, any("m"));
  readOrientation(section, pose.orientation);
  section.read("velocity", pose.velocity, any("m/s"));
  section.read("angular_velocity", pose.angularVelocity, any("rad/s"));
}

// Joins a point, the next body, to what it is pinned to.
void pin(Section& section, const BentTable& bent, const BodyDef& point, int number, Scene& scene) {
  std::vector<JointDef>& joints = scene.world.joints;
  section.findings().note("joints[" + std::to_string(joints.size()) + "]", section.spot());
  joints.push_back({.name = point.name + ".pin",
                    .a = number,
                    .b = bent.pinnedTo,
                    .anchorA = point.position,
                    .anchorB = point.position});
}

}  // namespace

BentTable readBentNamed(Section& section, const Materials& materials) {
  BentTable bent;
  section.read("name", bent.name);
  if (!section.find("name"))
    section.complain("name", "missing; its points are called NAME.0, NAME.1, …");
  readSurface(section, materials, bent);
  return bent;
}

BentTable readBent(Section& section, const Materials& materials) {
  BentTable bent = readBentNamed(section, materials);
  readColour(section, "colour_back", bent.back);
  readPose(section, bent.pose);
  return bent;
}

void readPinTo(Section& section, const BodyList& bodies, BentTable& bent) {
  std::sort(bent.pins.begin(), bent.pins.end());
  bent.pins.erase(std::unique(bent.pins.begin(), bent.pins.end()), bent.pins.end());
  if (!section.find("pin_to")) return;
  bent.pinnedTo = bodies.named(section, "pin_to").value_or(kNoBody);
  if (bent.pins.empty() && section.good())
    section.complain("pin_to", "nothing is pinned; say which points with pins");
}

BentDef addBent(Section& section, const BentTable& bent, const std::vector<Vec3>& places,
                const std::vector<double>& masses, double radius,
                const std::function<void(ElasticBody&, int first)>& fill, BodyList& bodies,
                Scene& scene) {
  const int first = static_cast<int>(bodies.next());
  auto body = std::make_shared<ElasticBody>();
  body->name = bent.name;
  for (std::size_t p = 0; p < places.size(); ++p) {
    if (bodies.full(section.spot(), section.findings())) return {};
    const Vec3 arm = bent.pose.orientation * places[p];
    const bool pinned = std::binary_search(bent.pins.begin(), bent.pins.end(), static_cast<int>(p));
    const bool stands = pinned && bent.pinnedTo == kNoBody;
    BodyEntry entry;
    entry.def = {.name = bent.name + "." + std::to_string(p),
                 .shape = Particle{radius},
                 .mass = masses[p],
                 .friction = bent.friction,
                 .material = bent.material,
                 .position = bent.pose.position + arm,
                 .fixed = stands};
    if (!stands) entry.def.velocity = bent.pose.velocity + bent.pose.angularVelocity.cross(arm);
    entry.colour = bent.colour;
    body->bodies.push_back(first + static_cast<int>(p));
    section.findings().note(bodies.nextPath(), section.spot());
    if (pinned && !stands) pin(section, bent, entry.def, body->bodies.back(), scene);
    bodies.add(std::move(entry), section.spot(), section);
    if (!section.good()) return {};  // what is wrong with a point's name is so with all
  }
  fill(*body, first);
  std::vector<Force>& forces = scene.world.forces;
  section.findings().note("forces[" + std::to_string(forces.size()) + "]", section.spot());
  forces.push_back(Bending{body});
  return {.name = bent.name,
          .first = first,
          .count = static_cast<int>(places.size()),
          .colour = bent.colour,
          .back = bent.back};
}

}  // namespace tumble
