#include "app/scene/force.h"

#include <array>
#include <type_traits>
#include <utility>

namespace tumble {

namespace {

// The body that a key names, or kNoBody. A key that must be there complains if it is not.
int bodyOf(Section& section, std::string_view key, const BodyList& bodies, bool needed) {
  if (!section.find(key)) {
    if (needed) section.complain(key, "missing; name the body");
    return kNoBody;
  }
  return bodies.named(section, key).value_or(kNoBody);
}

void need(Section& section, std::string_view key) {
  if (!section.find(key)) section.complain(key, "missing");
}

Force readWind(Section& section, const BodyList&) {
  UniformWind wind;
  need(section, "force");
  section.read("force", wind.force, any("N"));
  return wind;
}

Force readDrag(Section& section, const BodyList&) {
  LinearDrag drag;
  section.read("linear", drag.linear, notNegative("N s/m"));
  section.read("angular", drag.angular, notNegative("N m s"));
  return drag;
}

Force readField(Section& section, const BodyList&) {
  CircularField field;
  Vec3 axis = Vec3::UnitY();
  double rate = 1.0;
  need(section, "rate");
  section.read("centre", field.centre, any("m"));
  section.read("axis", axis, any({}));
  section.read("rate", rate, {-1e6, 1e6, false, "rad/s"});
  if (axis.stableNorm() < 1e-9)
    section.complain("axis", "expected three numbers that are not all zero");
  field.rotation = rate * axis.stableNormalized();
  return field;
}

Force readPoint(Section& section, const BodyList& bodies) {
  PointForce force;
  force.body = bodyOf(section, "body", bodies, true);
  section.read("point", force.point_B, any("m"));
  need(section, "force");
  section.read("force", force.force, any("N"));
  return force;
}

Force readSpring(Section& section, const BodyList& bodies) {
  Spring spring;
  spring.a = bodyOf(section, "a", bodies, !section.find("b"));
  spring.b = bodyOf(section, "b", bodies, false);
  if (spring.a == spring.b && section.find("b") && section.good())
    section.complain("b", "both ends are on the same body");
  section.read("anchor_a", spring.anchorA_B, any("m"));
  section.read("anchor_b", spring.anchorB_B, any("m"));
  if (!section.find("a")) {  // the end in the world stands second: a spring has no direction
    std::swap(spring.a, spring.b);
    std::swap(spring.anchorA_B, spring.anchorB_B);
  }
  need(section, "stiffness");
  section.read("stiffness", spring.stiffness, notNegative("N/m"));
  section.read("damping", spring.damping, notNegative("N s/m"));
  section.read("rest", spring.rest, notNegative("m"));
  return spring;
}

struct ForceRow {
  const char* kind;
  Force (*read)(Section&, const BodyList&);
};
constexpr std::array<ForceRow, 5> kForces = {{{"wind", readWind},
                                              {"drag", readDrag},
                                              {"point", readPoint},
                                              {"spring", readSpring},
                                              {"field", readField}}};

// Appends the force; one that acts on centres of mass once for each body that `body` names.
template <class Kind>
void append(const Kind& force, Section& section, const BodyList& bodies,
            std::vector<Force>& forces) {
  if constexpr (std::is_same_v<Kind, PointForce> || std::is_same_v<Kind, Spring> ||
                std::is_same_v<Kind, Bending> || std::is_same_v<Kind, Layering>) {
    forces.push_back(force);
  } else {
    for (const int body : bodies.group(section, "body")) {
      forces.push_back(force);
      std::get<Kind>(forces.back()).body = body;
    }
  }
}

}  // namespace

void readForces(Section& root, const BodyList& bodies, std::vector<Force>& forces) {
  std::vector<std::string> kinds;
  for (const ForceRow& row : kForces) kinds.emplace_back(row.kind);

  int number = 0;
  for (const Node& node : root.tables("force")) {
    Section section(node, "force." + std::to_string(number++), root.findings(),
                    "forces[" + std::to_string(forces.size()) + "]");
    std::string kind, name;
    section.read("name", name);
    section.read("kind", kind, kinds);
    if (!section.find("kind")) section.complain("kind", "missing" + hint("", kinds));
    // Without a kind nobody can tell which keys are known.
    for (const ForceRow& row : kForces) {
      if (kind != row.kind) continue;
      std::visit([&](const auto& force) { append(force, section, bodies, forces); },
                 row.read(section, bodies));
      section.finish();
    }
  }
}

}  // namespace tumble
