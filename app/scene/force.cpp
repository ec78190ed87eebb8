#include "app/scene/force.h"

#include <array>

namespace tumble {

namespace {

// The body that a key names, or kNoBody. A key that must be there complains if it is not.
int bodyOf(Section& section, std::string_view key, const Bodies& bodies, bool needed) {
  if (!section.find(key)) {
    if (needed) section.complain(key, "missing; name the body");
    return kNoBody;
  }
  return bodies.named(section, key).value_or(kNoBody);
}

void need(Section& section, std::string_view key) {
  if (!section.find(key)) section.complain(key, "missing");
}

Force readWind(Section& section, const Bodies& bodies) {
  UniformWind wind;
  wind.body = bodyOf(section, "body", bodies, false);
  need(section, "force");
  section.read("force", wind.force, any("N"));
  return wind;
}

Force readDrag(Section& section, const Bodies& bodies) {
  LinearDrag drag;
  drag.body = bodyOf(section, "body", bodies, false);
  section.read("linear", drag.linear, notNegative("N s/m"));
  section.read("angular", drag.angular, notNegative("N m s"));
  return drag;
}

Force readPoint(Section& section, const Bodies& bodies) {
  PointForce force;
  force.body = bodyOf(section, "body", bodies, true);
  section.read("point", force.point_B, any("m"));
  need(section, "force");
  section.read("force", force.force, any("N"));
  return force;
}

Force readSpring(Section& section, const Bodies& bodies) {
  Spring spring;
  spring.a = bodyOf(section, "a", bodies, true);
  spring.b = bodyOf(section, "b", bodies, false);
  if (spring.a == spring.b && section.find("b") && section.good())
    section.complain("b", "both ends are on the same body");
  section.read("anchor_a", spring.anchorA_B, any("m"));
  section.read("anchor_b", spring.anchorB_B, any("m"));
  need(section, "stiffness");
  section.read("stiffness", spring.stiffness, notNegative("N/m"));
  section.read("damping", spring.damping, notNegative("N s/m"));
  section.read("rest", spring.rest, notNegative("m"));
  return spring;
}

struct ForceRow {
  const char* kind;
  Force (*read)(Section&, const Bodies&);
};
constexpr std::array<ForceRow, 4> kForces = {
    {{"wind", readWind}, {"drag", readDrag}, {"point", readPoint}, {"spring", readSpring}}};

}  // namespace

void readForces(Section& root, const Bodies& bodies, std::vector<Force>& forces) {
  std::vector<std::string> kinds;
  for (const ForceRow& row : kForces) kinds.emplace_back(row.kind);

  for (const Node& node : root.tables("force")) {
    const std::string index = std::to_string(forces.size());
    Section section(node, "force." + index, root.findings(), "forces[" + index + "]");
    std::string kind, name;
    section.read("name", name);
    section.read("kind", kind, kinds);
    if (!section.find("kind")) section.complain("kind", "missing" + hint("", kinds));
    Force force = UniformWind{};
    bool known = false;
    for (const ForceRow& row : kForces) {
      if (kind != row.kind) continue;
      force = row.read(section, bodies);
      known = true;
    }
    // Without a kind nobody can tell which keys are known.
    if (known) section.finish();
    forces.push_back(force);
  }
}

}  // namespace tumble
