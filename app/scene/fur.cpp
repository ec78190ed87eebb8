#include "app/scene/fur.h"

#include <cmath>

#include "app/scene/bent.h"
#include "app/scene/roots.h"
#include "sim/elastic/strand.h"

namespace tumble {

namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;

struct FurTable {
  BentTable bent;
  StrandDef strand;
  int count = 0;
  std::optional<int> on;    // the body it grows on
  double thickness = 2e-3;  // [m]
  int seed = 0;
  RootArea area;
};

void readStrand(Section& section, StrandDef& strand) {
  section.read("points", strand.points, 3, 1000);
  if (!section.find("length")) section.complain("length", "missing; of a strand in m");
  section.read("length", strand.length, kLength);
  section.read("density", strand.density, positive("kg/m"));
  section.read("stretch", strand.stretch, positive("N"));
  section.read("bend", strand.bend, notNegative("N m²"));
  section.read("damping", strand.damping, notNegative("N s"));
}

void readArea(Section& section, RootArea& area) {
  double degrees = 180.0;
  section.read("spread", degrees, {0.0, 180.0, true, "degrees"});
  section.read("towards", area.towards, any({}));
  if (area.towards.stableNorm() < 1e-9)
    return section.complain("towards", "expected a direction, three numbers that are not all zero");
  area.towards.stableNormalize();
  if (degrees < 180.0) area.least = std::cos(degrees * kRadians);
}

FurTable readFur(Section& section, const Materials& materials, const BodyList& bodies) {
  FurTable fur;
  fur.bent = readBentNamed(section, materials);
  if (!section.find("on"))
    section.complain("on", "missing; the body that it grows on");
  else
    fur.on = bodies.named(section, "on");
  if (!section.find("strands")) section.complain("strands", "missing; how many");
  section.read("strands", fur.count, 1, kMostPoints);
  section.read("seed", fur.seed, 0, 1'000'000'000);
  section.read("thickness", fur.thickness, kLength);
  readStrand(section, fur.strand);
  if (section.good() && fur.thickness > fur.strand.length)
    section.complain("thickness",
                     "a strand is thicker than it is long; take thinner or longer ones");
  readArea(section, fur.area);
  if (section.good() && static_cast<long>(fur.count) * fur.strand.points > kMostPoints)
    section.complain("strands", "more than " + std::to_string(kMostPoints) +
                                    " points in one fur; take fewer strands or points");
  section.finish();
  return fur;
}

// The turn that takes Y to a unit vector.
Quat turnTo(const Vec3& n) {
  const double w = 1.0 + n.y();
  return w < 1e-9 ? Quat(0.0, 1.0, 0.0, 0.0) : Quat(w, n.z(), 0.0, -n.x()).normalized();
}

void addStrand(Section& section, const FurTable& fur, const Root& root, int number,
               BodyList& bodies, Scene& scene) {
  const BodyDef& body = scene.world.bodies[static_cast<std::size_t>(*fur.on)];
  const bool stands = body.fixed && body.velocity.isZero(0.0) && body.angularVelocity.isZero(0.0);
  BentTable bent = fur.bent;
  bent.name += "." + std::to_string(number);
  bent.pins = {0, 1};
  bent.pinnedTo = stands ? kNoBody : *fur.on;
  const Quat attitude = body.orientation.normalized();
  const Vec3 arm = attitude * root.place;
  bent.pose.position = body.position + arm;
  bent.pose.orientation = attitude * turnTo(root.normal);
  bent.pose.angularVelocity = body.angularVelocity;
  bent.pose.velocity = body.velocity + body.angularVelocity.cross(arm);
  const BentDef added = addBent(
      section, bent, strandPlaces(fur.strand), strandMasses(fur.strand), 0.5 * fur.thickness,
      [&](ElasticBody& body, int first) { body.elements = strandElements(fur.strand, first); },
      bodies, scene);
  // The two in the root meet nothing.
  for (const int p : {0, 1})
    if (p < added.count)
      scene.world.bodies[static_cast<std::size_t>(added.first + p)].shape = Particle{};
}

}  // namespace

void readFurs(Section& root, const Materials& materials, BodyList& bodies, Scene& scene) {
  std::size_t number = 0;
  for (const Node& node : root.tables("fur")) {
    Section section(node, pathOf("fur", node, number++), root.findings());
    if (!node.as<Table>()) continue;
    const FurTable fur = readFur(section, materials, bodies);
    bodies.claim(section, fur.bent.name, "fur");
    if (!section.good() || !fur.on) continue;
    const BodyDef& body = scene.world.bodies[static_cast<std::size_t>(*fur.on)];
    const std::string barren = barrenness(body.shape);
    if (!barren.empty()) {
      section.complain("on", "nothing grows on " + inQuotes(body.name) + ": " + barren);
      continue;
    }
    const std::uint64_t seed =
        section.find("seed") ? static_cast<std::uint64_t>(fur.seed) : scene.seed;
    const std::vector<Root> roots =
        rootsOn(centredShape(body), fur.area, fur.count, Random(seed, fur.bent.name));
    if (static_cast<int>(roots.size()) < fur.count) {
      section.complain("spread", "no surface of " + inQuotes(body.name) +
                                     " was found that faces so near to towards; take a wider one");
      continue;
    }
    const int first = static_cast<int>(bodies.next());
    for (std::size_t k = 0; k < roots.size() && section.good(); ++k)
      addStrand(section, fur, roots[k], static_cast<int>(k), bodies, scene);
    scene.bent.push_back({.name = fur.bent.name,
                          .first = first,
                          .count = static_cast<int>(bodies.next()) - first,
                          .thickness = fur.thickness,
                          .strand = fur.strand.points,
                          .colour = fur.bent.colour});
  }
}

}  // namespace tumble
