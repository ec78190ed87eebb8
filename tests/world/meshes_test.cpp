// Bodies that are not convex, by every method: interlocked, thin and fast, near and apart.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/collide/collide.h"
#include "sim/collide/parts.h"
#include "sim/math/frames.h"
#include "sim/shape/pieces.h"
#include "tests/body/solids.h"
#include "tests/catch.h"
#include "tests/collide/meshes.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// With its convex pieces, which carry its contacts.
Mesh inPieces(const solids::Raw& raw) {
  Mesh mesh = raw.mesh();
  mesh.origin = -mesh.solid->points[0];
  mesh.pieces = std::make_shared<const Pieces>(piecesOf(*mesh.solid, PieceKind::Good, 0.0));
  return mesh;
}

/// A frame in the xy plane about z = 0: between an outline and a hole of as many corners, both
/// counter-clockwise.
solids::Raw frame(const std::vector<Vec3>& outline, const std::vector<Vec3>& hole, double height) {
  const int n = static_cast<int>(outline.size()), up = 2 * n;
  solids::Raw raw;
  for (const double z : {-0.5 * height, 0.5 * height})
    for (const auto* ring : {&outline, &hole})
      for (const Vec3& p : *ring) raw.points.emplace_back(p.x(), p.y(), z);
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    raw.faces.push_back({k, next, up + next, up + k});
    raw.faces.push_back({n + next, n + k, up + n + k, up + n + next});
    raw.faces.push_back({next, k, n + k, n + next});
    raw.faces.push_back({up + k, up + next, up + n + next, up + n + k});
  }
  return raw;
}

/// A slab of 4 m whose top is a valley: it rises from x = 0 by a slope both ways.
BodyDef valley(double slope) {
  solids::Raw raw = solids::prism(
      {{-2, -0.5, 0}, {2, -0.5, 0}, {2, 2 * slope, 0}, {0, 0, 0}, {-2, 2 * slope, 0}}, 1.0);
  for (Vec3& p : raw.points) p.z() -= 0.5;
  Mesh mesh = raw.mesh();
  mesh.pieces = std::make_shared<const Pieces>(piecesOf(*mesh.solid, PieceKind::Good, 1e-6));
  BodyDef ground;
  ground.name = "valley";
  ground.shape = mesh;
  ground.fixed = true;
  ground.position = raw.points[0] + originOf(centredShape(ground));
  return ground;
}

/// A link of bars of 0.5 m: 2 m wide, 3 m high.
Mesh linkMesh() {
  return inPieces(frame({{-1, -1.5, 0}, {1, -1.5, 0}, {1, 1.5, 0}, {-1, 1.5, 0}},
                        {{-0.5, -1, 0}, {0.5, -1, 0}, {0.5, 1, 0}, {-0.5, 1, 0}}, 0.5));
}

WorldDef linkedChain(const char* method, int links) {
  WorldDef def = worldOf(method, 0.5, {});
  for (int k = 0; k <= links; ++k) {
    BodyDef link;
    link.name = "link." + std::to_string(k);
    link.shape = linkMesh();
    link.fixed = k == 0;
    link.mass = 1.0 + k;
    link.friction = 0.5;
    link.position = {0.0, -2.0 * k, 0.0};
    if (k % 2 == 1) link.orientation = {std::sqrt(0.5), 0.0, std::sqrt(0.5), 0.0};
    def.bodies.push_back(link);
  }
  return def;
}

}  // namespace

// Oracle: statics. Link k carries what hangs below it.
TEST_CASE("a chain of interlocked links hangs, and each link carries what hangs below it",
          "[figures]") {
  const char* method = GENERATE("stepping", "exact", "course");
  const int links = 4;
  const WorldDef def = linkedChain(method, links);
  World world(def);
  world.advance(def.duration);
  REQUIRE_FALSE(world.report().stopped);
  const Sample end = world.sample(def.duration);
  double off = 0.0, moved = 0.0;
  for (int k = 1; k <= links; ++k) {
    double below = 0.0, carried = 0.0;
    for (int j = k; j <= links; ++j) below += 9.81 * (1.0 + j);
    for (const ContactSample& c : end.contacts)
      if (std::max(c.a, c.b) == k && std::min(c.a, c.b) == k - 1)
        carried += (c.a == k ? 1.0 : -1.0) * c.force.y();
    off = std::max(off, std::abs(carried / below - 1.0));
    moved = std::max(moved, (end.bodies[k].x - def.bodies[k].position).norm());
  }
  WARN("a chain by " << method << ": measured forces off by " << off << ", moved by " << moved
                     << " m");
  CHECK(off < 1e-10);
  CHECK(moved < 1e-9);
}

// Oracle: it is not on the other side.
TEST_CASE("a thin U that flies at 100 m/s does not pass through a thin plate", "[figures]") {
  const char* method = GENERATE("stepping", "exact", "course");
  const double turn = GENERATE(0.0, 30.0);
  WorldDef def = worldOf(method, 0.06, {box("plate", {0.02, 4.0, 4.0}, {0.0, 0.0, 0.0}, 0.2)});
  def.gravity.setZero();
  def.bodies[0].fixed = true;
  BodyDef u;
  u.name = "u";
  const solids::Raw outline = solids::prism({{-0.5, -0.5, 0},
                                             {0.5, -0.5, 0},
                                             {0.5, 0.5, 0},
                                             {0.46875, 0.5, 0},
                                             {0.46875, -0.46875, 0},
                                             {-0.46875, -0.46875, 0},
                                             {-0.46875, 0.5, 0},
                                             {-0.5, 0.5, 0}},
                                            0.03125);
  u.shape = inPieces(solids::moved(outline, {0.0, 0.0, -0.015625}));
  u.mass = 1.0;
  u.restitution = 0.2;
  u.position = {-2.0, 0.1, 0.0};
  u.orientation = Quat(Eigen::AngleAxisd(0.3 + turn, Vec3(0.2, 1.0, 0.4).normalized()));
  u.velocity = {100.0, 0.0, 0.0};
  u.angularVelocity = {turn, 5.0, -2.0 * turn};
  def.bodies.push_back(u);
  World world(def);
  double farthest = def.bodies[1].position.x();
  for (int k = 1; k <= 60; ++k) {
    world.advance(0.001 * k);
    REQUIRE_FALSE(world.report().stopped);
    CAPTURE(method, turn, k);
    farthest = std::max(farthest, world.sample(0.001 * k).bodies[1].x.x());
    REQUIRE(farthest < 0.0);
  }
  const Certificate& books = world.report().certificate;
  WARN("a thin U at 100 m/s, " << method << ", turned by " << turn << ": measured its centre "
                               << -farthest << " m before the plate at least, overlaps to "
                               << books.audit_max_penetration << " m");
  CHECK(books.events > 0);
}

// Oracle: a quarter of a link moves through the hole of another and meets nothing.
TEST_CASE("what goes through a hole with a hair to spare meets nothing") {
  const char* method = GENERATE("stepping", "exact", "course");
  const double spare = GENERATE(1e-2, 1e-5, 1e-8);
  WorldDef def = worldOf(method, 1.0, {});
  def.gravity.setZero();
  BodyDef ring = linkedChain(method, 0).bodies[0],
          bar = box("bar", {1.0 - 2.0 * spare, 0.3, 0.3}, {});
  bar.position = {0.0, 0.0, -2.0};
  bar.velocity = {0.0, 0.0, 4.0};
  def.bodies = {ring, bar};
  World world(def);
  world.advance(def.duration);
  CHECK(world.report().events.empty());
  CHECK((world.sample(1.0).bodies[1].x - Vec3(0.0, 0.0, 2.0)).norm() < 1e-13);
}

// Oracle: nothing is in the way. Walls stand upright on their corners, so that faces are exactly
// flat; the certificate's bound is 0. Measured 8e-13 m by stepping, 5e-15 by the others, allowed
// 1e-11.
TEST_CASE("a ring that flies through a ring with a hair to spare meets nothing", "[figures]") {
  const char* method = GENERATE("stepping", "exact", "course");
  const double spare = GENERATE(1e-3, 1e-8);
  const double turn = GENERATE(0.0, 0.7);
  const auto octagon = [](double scale) {
    std::vector<Vec3> corners;
    for (const auto& [x, y] :
         {std::pair(4, 2), std::pair(2, 4), std::pair(-2, 4), std::pair(-4, 2), std::pair(-4, -2),
          std::pair(-2, -4), std::pair(2, -4), std::pair(4, -2)})
      corners.emplace_back(scale * x, scale * y, 0.0);
    return corners;
  };
  BodyDef ring, flies;
  ring.name = "ring";
  ring.shape = inPieces(frame(octagon(1.0), octagon(0.75), 1.0));
  ring.fixed = true;
  flies.name = "flies";
  // A hair off the hole at one side, and two hairs at the other.
  flies.shape = inPieces(frame(octagon(0.75 - 0.375 * spare), octagon(0.5), 0.5));
  flies.mass = 1.0;
  flies.position = {0.5 * spare, 0.0, -3.0};
  flies.velocity = {0.0, 0.0, 6.0};
  const Quat aslant(Eigen::AngleAxisd(turn, Vec3(1.0, 2.0, 3.0).normalized()));
  for (BodyDef* body : {&ring, &flies}) {
    body->position = aslant * body->position;
    body->velocity = aslant * body->velocity;
    body->orientation = aslant;
  }
  WorldDef def = worldOf(method, 1.0, {ring, flies});
  def.gravity.setZero();
  World world(def);
  world.advance(def.duration);
  const double off =
      (aslant.conjugate() * world.sample(1.0).bodies[1].x - Vec3(0.5 * spare, 0.0, 3.0)).norm();
  WARN("a ring through a ring, " << method << ", " << spare << " m to spare, turned by " << turn
                                 << ": measured " << world.report().events.size()
                                 << " events, off its way by " << off << " m");
  CHECK(world.report().events.empty());
  CHECK(off < 1e-11);
}

// Oracle: it is not on the other side. Both are 4 mm thick, and a step is 40 cm long.
TEST_CASE("a thin compound that flies at 100 m/s does not pass through a thin one") {
  const char* method = GENERATE("stepping", "exact", "course");
  const double turn = GENERATE(0.0, 0.2);
  const auto plates = [](const char* name, const Vec3& x) {
    Compound parts;  // side by side
    for (const double y : {-0.25, 0.25})
      parts.parts.push_back({Box{{0.002, 0.25, 0.5}}, {{0.0, y, 0.0}}});
    BodyDef def;
    def.name = name;
    def.shape = parts;
    def.mass = 1.0;
    def.position = x;
    return def;
  };
  WorldDef def =
      worldOf(method, 0.05, {plates("wall", Vec3::Zero()), plates("flies", {-1.1, 0.1, 0.2})});
  def.gravity.setZero();
  def.bodies[0].fixed = true;
  def.bodies[1].velocity = {100.0, 0.0, 0.0};
  def.bodies[1].orientation = Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()));
  World world(def);
  world.advance(def.duration);
  CAPTURE(method, turn);
  REQUIRE_FALSE(world.report().stopped);
  CHECK(world.sample(def.duration).bodies[1].x.x() < 0.0);
  CHECK_FALSE(world.report().events.empty());
}

namespace {

struct Placed {
  std::vector<Vec3> points;
  const Polyhedron& solid;
  Placed(const Mesh& mesh, const Pose& pose) : points(mesh.solid->points), solid(*mesh.solid) {
    for (Vec3& p : points) p = toWorld(pose, p - mesh.origin);
  }
};

// When a corner of one that moves by v meets a face of the other, soonest [s].
double cornersMeetFaces(const Placed& a, const Placed& b, const Vec3& v) {
  double soonest = std::numeric_limits<double>::infinity();
  for (const std::vector<int>& face : b.solid.faces) {
    const auto at = [&](std::size_t k) { return b.points[face[k % face.size()]]; };
    const Vec3 n = (at(1) - at(0)).cross(at(2) - at(1));
    for (const Vec3& p : a.points) {
      const double t = n.dot(at(0) - p) / n.dot(v);
      bool inside = t > 0.0;
      for (std::size_t k = 0; k < face.size() && inside; ++k)
        inside = n.dot((at(k + 1) - at(k)).cross(p + t * v - at(k))) >= 0.0;
      if (inside) soonest = std::min(soonest, t);
    }
  }
  return soonest;
}

// When an edge of one that moves by v meets one of the other, soonest [s].
double edgesMeet(const Placed& a, const Placed& b, const Vec3& v) {
  double soonest = std::numeric_limits<double>::infinity();
  for (const Polyhedron::Edge& e : a.solid.edges)
    for (const Polyhedron::Edge& f : b.solid.edges) {
      const Vec3 &p = a.points[e.from], &q = b.points[f.from];
      const Vec3 u = a.points[e.to] - p, w = b.points[f.to] - q, n = u.cross(w);
      const double t = n.dot(q - p) / n.dot(v);
      if (!(t > 0.0) || t >= soonest) continue;
      const Vec3 d = q - (p + t * v);  // = s u − r w
      const double s = n.dot(d.cross(w)) / n.dot(n), r = n.dot(d.cross(u)) / n.dot(n);
      if (s >= 0.0 && s <= 1.0 && r >= 0.0 && r <= 1.0) soonest = t;
    }
  return soonest;
}

}  // namespace

// Oracle: every corner against every face and every edge against every edge, in closed form.
// Measured 4e-16 s, allowed 1e-12 s.
TEST_CASE("a ring that flies into a ring meets it when the first of all pairs of features meets",
          "[figures]") {
  const Mesh ring = meshes::ring(24, 1.0, 0.25), small = meshes::ring(16, 0.5, 0.125);
  double off = 0.0;
  int hits = 0;
  for (int k = 0; k < 12; ++k) {
    const Vec3 v(0.05 * k, -0.02, 2.0);
    BodyDef fixed, flies;
    fixed.name = "ring";
    fixed.shape = ring;
    fixed.fixed = true;
    flies.name = "small";
    flies.shape = small;
    flies.mass = 1.0;
    flies.position = {0.1 * k, 0.03 * k, -2.0};
    flies.orientation = Quat(Eigen::AngleAxisd(0.4 * k, Vec3(1.0, 0.3, 0.2 * k).normalized()));
    flies.velocity = v;
    WorldDef def = worldOf("exact", 2.0, {fixed, flies});
    def.gravity.setZero();
    const Placed a(small, {flies.position, flies.orientation}), b(ring, {});
    const double t =
        std::min({cornersMeetFaces(a, b, v), cornersMeetFaces(b, a, -v), edgesMeet(a, b, v)});
    World world(def);
    world.advance(std::min(def.duration, t + 1e-6));
    const std::vector<Event>& events = world.report().events;
    CAPTURE(k, t);
    REQUIRE(events.empty() == (t > def.duration));
    if (events.empty()) continue;
    ++hits;
    off = std::max(off, std::abs(events.front().t - t));
    CHECK(std::abs(events.front().t - t) < 1e-12);
  }
  WARN("first hits of rings: measured " << hits << " of 12, off by " << off << " s");
  CHECK(hits > 3);
}

TEST_CASE("a body of more parts than features can name is refused") {
  WorldDef def = worldOf("stepping", 1.0, {box("many", {1, 1, 1}, {0, 0, 0})});
  Compound compound;
  for (int k = 0; k < 4096; ++k) compound.parts.push_back({Sphere{0.4}, {{1.0 * k, 0.0, 0.0}}});
  def.bodies[0].shape = compound;
  CHECK_THROWS_WITH(World(def), Catch::Matchers::Contains("4096 parts"));
}

// Oracle: closed form. Of the two pieces of a valley one is a wedge above the other's face: where
// it is thinner than what counts as flush each hid the other, and what lay there fell through.
TEST_CASE("a valley holds what lies in it, however shallow it is") {
  const double slope = GENERATE(5e-6, 1e-4, 1e-2);
  const BodyDef ground = valley(slope);
  const Shape parts = readyShape(contactShape(centredShape(ground)));
  REQUIRE(std::get<Compound>(parts).parts.size() == 2);
  // A ball anywhere over one side.
  const double r = 0.02, steep = std::hypot(1.0, slope);
  for (const double x : {1e-5, 1e-4, 1e-3, 1e-2, 0.05, 0.15, 0.3, 0.5, 1.0, 1.5}) {
    const double gap = 1e-5, y = (r + gap) * steep + slope * x;
    Manifold found;
    collide(Sphere{r}, {{x, y, 0.01}, Quat::Identity()}, parts, {ground.position, Quat::Identity()},
            1e-3, found);
    double least = 1.0;
    for (const ContactPoint& c : found) least = std::min(least, c.separation);
    CAPTURE(slope, x);
    CHECK(least == Approx(gap).margin(1e-9));
  }
  const char* method = GENERATE("stepping", "exact", "course");
  WorldDef def = worldOf(method, 0.3, {ground, box("box", {0.04, 0.04, 0.04}, {0.0, 0.021, 0.0})});
  World world(def);
  world.advance(def.duration);
  const Certificate& books = world.report().certificate;
  CAPTURE(slope, method);
  CHECK(world.sample(def.duration).bodies[1].x.y() == Approx(0.02 + 0.02 * slope).margin(1e-8));
  CHECK(books.audit_max_penetration < 1e-8);
  CHECK(books.energy_added_repair < 1e-9);
}
