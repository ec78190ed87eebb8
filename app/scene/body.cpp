#include "app/scene/body.h"

#include <algorithm>

#include "app/scene/choices.h"
#include "app/scene/settings.h"
#include "app/scene/shape.h"
#include "sim/body/principal_axes.h"
#include "sim/math/frames.h"

namespace tumble {

namespace {

constexpr std::size_t kMostBodies = 100'000;
constexpr std::size_t kLongestLabel = 200;
constexpr int kMostSamples = 10'000'000;

void readMass(Section& section, BodyDef& def) {
  section.read("mass", def.mass, positive("kg"));
  section.read("inertia", def.inertia, positive("kg m²"));
  section.read("products", def.products, any("kg m²"));
  if (!def.inertia && section.find("products"))
    section.complain("products", "needs `inertia` beside it: the moments about the body axes");
  if (!def.inertia) return;
  // Each principal moment is at most the sum of the other two.
  const Vec3 I = principalAxes(givenInertia(def)).moments;
  if (!(I.minCoeff() > 0.0) || 2.0 * I.maxCoeff() > I.sum() * (1.0 + 1e-12))
    section.complain("inertia", "no body has these: one is larger than the sum of the other two");
}

// How the inertia is found, and the centre of mass with it.
void readInertiaMethod(Section& section, BodyDef& def) {
  section.read("inertia_by", def.inertiaBy, inertiaChoices());
  section.read("samples", def.samples, 1, kMostSamples);
}

// The shape with its origin at the centre of mass, and the body where that is.
void centre(Section& section, const std::optional<Vec3>& origin, BodyDef& def) {
  try {
    const Vec3 zero = originOf(def.shape);
    def.shape = centredShape(def);
    if (origin) def.position = *origin + def.orientation * Vec3(originOf(def.shape) - zero);
  } catch (const std::invalid_argument& reason) {
    section.complain("samples", reason.what());
  }
}

void readMotion(Section& section, BodyDef& def) {
  section.read("position", def.position, any("m"));
  readOrientation(section, def.orientation);
  section.read("velocity", def.velocity, any("m/s"));
  section.read("angular_velocity", def.angularVelocity, any("rad/s"));
  Vec3 omega_B = Vec3::Zero();
  section.read("angular_velocity_body", omega_B, any("rad/s"));
  if (!section.find("angular_velocity_body")) return;
  if (section.find("angular_velocity"))
    section.complain("angular_velocity_body", "angular_velocity is given too; keep one");
  def.angularVelocity = def.orientation * omega_B;
}

// Whether it is known what a body weighs, or does not matter.
bool weighs(const BodyDef& def) {
  return def.fixed || def.mass || (def.density && !std::get_if<Particle>(&def.shape));
}

void requireMass(Section& section, const BodyDef& def) {
  if (weighs(def)) return;
  section.complain("mass", std::get_if<Particle>(&def.shape)
                               ? "missing; a particle needs a mass"
                               : "missing; a moving body needs a mass, or a density of its own or "
                                 "its material's");
}

// kick = { impulse = [x, y, z], point = [x, y, z] }: the world-frame impulse that the body gets at
// a point of its own frame before time begins, on top of its velocities.
void readKick(Section& section, BodyDef& def) {
  const Node* node = section.find("kick");
  if (!node) return;
  Section kick(*node, section.path("kick"), section.findings());
  Vec3 impulse = Vec3::Zero(), point_B = Vec3::Zero();
  kick.read("impulse", impulse, any("N s"));
  kick.read("point", point_B, any("m"));
  kick.finish();
  if (!section.good() || !weighs(def)) return;
  if (def.fixed) return section.complain("kick", "the body is fixed");
  RigidBody body;
  try {
    body = makeBody(massOf(def));
  } catch (const std::invalid_argument& reason) {
    return section.complain("kick", reason.what());
  }
  body.x = def.position;
  body.q = def.orientation;
  setVelocity(body, def.velocity, def.angularVelocity);
  applyImpulse(body, toWorld(body.pose(), point_B), impulse);
  def.velocity = body.v;
  def.angularVelocity = body.omega;
}

// Where [0, 0, 0] of the frame stands that a hull, a mesh or a compound is given in.
std::optional<Vec3> readOrigin(Section& section) {
  Vec3 origin = Vec3::Zero();
  section.read("origin", origin, any("m"));
  if (!section.find("origin")) return {};
  if (section.find("position")) section.complain("origin", "position is given too; keep one");
  return origin;
}

void checkOrigin(Section& section, const Shape& shape) {
  if (section.find("origin") && !hasOwnFrame(shape))
    section.complain("origin",
                     "only a hull, a mesh or a compound has coordinates of its own; a position "
                     "says where this body stands");
}

// A half-space is fixed and stands where its n and d say.
void checkPlane(Section& section, BodyDef& def) {
  if (section.find("fixed") && !def.fixed) section.complain("fixed", "a plane is always fixed");
  def.fixed = true;
  for (const char* key : {"position", "orientation"})
    if (section.find(key))
      section.complain(key, "a plane stands where its [nx, ny, nz, d] says; leave this out");
}

// A particle has no inertia, and it does not turn.
void checkParticle(Section& section) {
  for (const char* key :
       {"inertia", "products", "orientation", "angular_velocity", "angular_velocity_body"})
    if (section.find(key))
      section.complain(key, "a particle has no inertia and does not turn; leave this out");
}

// Surface and density of the material, unless the body has its own.
Material readSurface(Section& section, const Materials& materials, std::string& name) {
  Material surface;
  section.read("material", name);
  const auto row = materials.find(name);
  if (row != materials.end())
    surface = row->second;
  else if (section.find("material"))
    section.complain("material",
                     "unknown material " + inQuotes(name) +
                         (materials.empty() ? "; there is no [materials." + plain(name) + "]"
                                            : hint(name, namesOf(materials))));
  surface.read(section);
  return surface;
}

}  // namespace

BodyEntry readBody(Section& section, const std::string& name, const Materials& materials) {
  BodyEntry entry;
  BodyDef& def = entry.def;
  def.name = name;

  const Material surface = readSurface(section, materials, def.material);
  def.density = surface.density;
  def.restitution = surface.restitution;
  def.friction = surface.friction;
  entry.colour = surface.colour;
  entry.back = surface.back;
  section.read("label", entry.label);
  if (entry.label.size() > kLongestLabel) section.complain("label", "longer than 200 bytes");

  section.read("fixed", def.fixed);
  section.read("pivot_body", def.pivot_B, any("m"));
  readMass(section, def);
  readInertiaMethod(section, def);
  readMotion(section, def);
  const std::optional<Vec3> origin = readOrigin(section);
  const std::optional<Shape> shape = readShape(section);
  section.find("kick");
  section.finish();
  if (!shape) return entry;
  def.shape = *shape;
  checkOrigin(section, def.shape);
  if (std::get_if<HalfSpace>(&def.shape)) checkPlane(section, def);
  if (std::get_if<Particle>(&def.shape)) checkParticle(section);
  // A key that is misspelt or wrong may be the very one that seems to be missing.
  if (section.good() && surface.sound) requireMass(section, def);
  if (section.good()) centre(section, origin, def);
  readKick(section, def);
  return entry;
}

void BodyList::add(BodyEntry entry, Spot spot, Section& section) {
  const std::string& name = entry.def.name;
  if (!isName(name))
    section.findings().complain(spot, section.path("name"),
                                "expected 1 to 64 of A-Z a-z 0-9 _ and ., found " + inQuotes(name));
  else if (!indices_.emplace(name, static_cast<int>(next())).second)
    section.findings().complain(spot, section.path("name"),
                                "there is a body " + inQuotes(name) + " already");
  scene_.colours.push_back(entry.colour);
  scene_.backs.push_back(entry.back);
  scene_.labels.push_back(std::move(entry.label));
  share(entry.def.shape);
  scene_.world.bodies.push_back(std::move(entry.def));
}

void BodyList::claim(Section& section, const std::string& name, const std::string& what) {
  if (!section.find("name")) return;
  const auto [claimed, isNew] = claimed_.emplace(name, what);
  const std::string has = indices_.contains(name) ? "body" : isNew ? "" : claimed->second;
  if (!has.empty())
    section.complain("name", "there is a " + has + " " + inQuotes(name) + " already");
}

// Copies of one hull or mesh share its points.
void BodyList::share(Shape& shape) {
  if (Hull* hull = std::get_if<Hull>(&shape)) share(hull->solid);
  if (Mesh* mesh = std::get_if<Mesh>(&shape)) share(mesh->solid);
  if (Compound* compound = std::get_if<Compound>(&shape))
    for (Part& part : compound->parts)
      if (Hull* hull = std::get_if<Hull>(&part.solid)) share(hull->solid);
}

void BodyList::share(std::shared_ptr<const Polyhedron>& solid) {
  const auto same = [&](const std::shared_ptr<const Polyhedron>& other) {
    return other->points == solid->points && other->faces == solid->faces;
  };
  const auto found = std::find_if(solids_.begin(), solids_.end(), same);
  if (found == solids_.end())
    solids_.push_back(solid);
  else
    solid = *found;
}

bool BodyList::full(Spot spot, Findings& findings) const {
  if (next() < kMostBodies) return false;
  findings.complain(spot, "", "more than " + std::to_string(kMostBodies) + " bodies");
  return true;
}

void requireBody(Section& section, std::string_view key, const std::string& name,
                 std::span<const BodyDef> bodies) {
  std::vector<std::string> names;
  for (const BodyDef& body : bodies) names.push_back(body.name);
  if (std::find(names.begin(), names.end(), name) == names.end())
    section.complain(key, "unknown body " + inQuotes(name) + hint(name, names));
}

std::optional<int> BodyList::named(Section& section, std::string_view key) const {
  std::string name;
  section.read(key, name);
  if (!section.find(key) || !section.good()) return {};
  const auto it = indices_.find(name);
  if (it != indices_.end()) return it->second;
  requireBody(section, key, name, scene_.world.bodies);
  return {};
}

std::vector<int> BodyList::group(Section& section, std::string_view key) const {
  std::string name;
  if (!section.find(key)) return {kNoBody};
  section.read(key, name);
  std::vector<int> copies;
  for (auto it = indices_.find(name + ".0"); it != indices_.end();
       it = indices_.find(name + "." + std::to_string(copies.size())))
    copies.push_back(it->second);
  if (copies.empty()) copies.push_back(named(section, key).value_or(kNoBody));
  return copies;
}

void readBodies(Section& root, const Materials& materials, BodyList& bodies) {
  std::size_t number = 0;
  for (const Node& node : root.tables("body")) {
    if (bodies.full(node.spot, root.findings())) return;
    Section section(node, pathOf("body", node, number), root.findings(), bodies.nextPath());
    std::string text = "body." + std::to_string(number++);
    section.read("name", text);
    const Node* given = section.find("name");
    BodyEntry entry = readBody(section, text, materials);
    bodies.add(std::move(entry), given ? given->spot : node.spot, section);
  }
}

}  // namespace tumble
