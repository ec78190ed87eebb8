#include "app/scene/joint.h"

#include <algorithm>

namespace tumble {

namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;

// Names are letters as those of bodies, and each stands once.
void readName(Section& section, BodyList& bodies, std::vector<JointDef>& joints, JointDef& joint) {
  joint.name = "joint." + std::to_string(joints.size());
  section.read("name", joint.name);
  if (!isName(joint.name))
    section.complain("name", "expected letters, digits, _ and dots, found " + inQuotes(joint.name));
  const auto same = [&](const JointDef& other) { return other.name == joint.name; };
  if (std::any_of(joints.begin(), joints.end(), same))
    section.complain("name", "there is a joint " + inQuotes(joint.name) + " already");
  else
    bodies.claim(section, joint.name, "joint");
}

void readEnds(Section& section, const BodyList& bodies, JointDef& joint) {
  if (!section.find("a")) section.complain("a", "missing; name the body");
  joint.a = bodies.named(section, "a").value_or(0);
  joint.b = section.find("b") ? bodies.named(section, "b").value_or(kNoBody) : kNoBody;
  if (section.good() && joint.a == joint.b) section.complain("b", "both ends are on the same body");
}

void readAnchors(Section& section, JointDef& joint) {
  if (!section.find("anchor")) section.complain("anchor", "missing; a point of the world");
  section.read("anchor", joint.anchorA, any("m"));
  joint.anchorB = joint.anchorA;
  if (joint.kind != JointKind::Distance) return;
  if (!section.find("anchor_b"))
    section.complain("anchor_b", "missing; a distance has two anchors");
  section.read("anchor_b", joint.anchorB, any("m"));
}

void readAxis(Section& section, JointDef& joint) {
  if (!section.find("axis")) section.complain("axis", "missing; a direction of the world");
  section.read("axis", joint.axis, any({}));
  if (joint.axis.stableNorm() < 1e-9)
    section.complain("axis", "expected three numbers that are not all zero");
}

void readLimits(Section& section, JointDef& joint) {
  const bool turns = joint.kind == JointKind::Hinge;
  Range range = turns ? Range{-180.0, 180.0, false, "degrees"} : any("m");
  if (joint.kind == JointKind::Distance) range = notNegative("m");
  std::optional<double> lo, hi;
  section.read("min", lo, range);
  section.read("max", hi, range);
  if (lo) joint.lo = turns ? *lo * kRadians : *lo;
  if (hi) joint.hi = turns ? *hi * kRadians : *hi;
}

}  // namespace

void readJoints(Section& root, BodyList& bodies, std::vector<JointDef>& joints) {
  std::vector<std::string> kinds;
  for (const JointName& row : jointNames()) kinds.emplace_back(row.name);
  for (const Node& node : root.tables("joint")) {
    Section section(node, pathOf("joint", node, joints.size()), root.findings(),
                    "joints[" + std::to_string(joints.size()) + "]");
    JointDef joint;
    std::string kind;
    readName(section, bodies, joints, joint);
    section.read("kind", kind, kinds);
    if (!section.find("kind")) section.complain("kind", "missing" + hint("", kinds));
    // Without a kind nobody can tell which keys are known.
    for (const JointName& row : jointNames()) {
      if (kind != row.name) continue;
      joint.kind = row.kind;
      readEnds(section, bodies, joint);
      readAnchors(section, joint);
      if (row.axis) readAxis(section, joint);
      if (row.limits) readLimits(section, joint);
      section.read("collide", joint.collide);
      section.finish();
    }
    joints.push_back(joint);
  }
}

}  // namespace tumble
