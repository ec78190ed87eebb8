// `shape = { box = [1, 2, 3] }` and `orientation = …`.
#include "app/scene/shape.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "app/scene/mesh_file.h"
#include "app/scene/piece_store.h"
#include "sim/math/rotation.h"
#include "sim/shape/convex_hull.h"

namespace tumble {

namespace {

std::optional<Shape> readSphere(Section& shape) {
  Sphere sphere;
  shape.read("sphere", sphere.r, kLength);
  return sphere;
}

std::optional<Shape> readBox(Section& shape) {
  Vec3 edges = Vec3::Ones();
  shape.read("box", edges, kLength);
  return Box{0.5 * edges};
}

std::optional<Shape> readEllipsoid(Section& shape) {
  Ellipsoid ellipsoid;
  shape.read("ellipsoid", ellipsoid.half, kLength);
  return ellipsoid;
}

std::optional<Shape> readCylinder(Section& shape) {
  double size[2] = {0.5, 1.0};
  shape.read("cylinder", size, 2, kLength);
  return Cylinder{size[0], size[1]};
}

std::optional<Shape> readCapsule(Section& shape) {
  double size[2] = {0.5, 1.0};
  shape.read("capsule", size, 2, kLength);
  return Capsule{size[0], size[1]};
}

// The hull is that of the points less the first, which is where its origin stands from it.
std::optional<Shape> readHull(Section& shape) {
  std::vector<Vec3> points;
  shape.read("hull", points, {-kLength.hi, kLength.hi, false, kLength.unit});
  if (!shape.good()) return {};
  try {
    return Hull{std::make_shared<const Polyhedron>(convexHull(points)), -points.at(0)};
  } catch (const NotASolid& reason) {
    shape.complain("hull", reason.what());
    return {};
  }
}

// A particle's radius is a key of the body.
std::optional<Shape> readParticle(Section& body) {
  Particle particle;
  body.read("radius", particle.radius, kLength);
  return particle;
}

std::optional<Shape> readPlane(Section& shape) {
  double p[4] = {0.0, 1.0, 0.0, 0.0};
  shape.read("plane", p, 4, any("m"));
  const Vec3 n(p[0], p[1], p[2]);
  const double length = n.stableNorm();
  if (length < 1e-9) {
    shape.complain("plane", "expected [nx, ny, nz, d] with a normal that is not zero");
    return {};
  }
  return HalfSpace{n / length, p[3] / length};
}

// The radius of a mesh about the middle of its box [m], which tolerances are told in.
double sizeOf(const Polyhedron& solid) {
  Vec3 lo = solid.points[0], hi = lo;
  for (const Vec3& p : solid.points) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  return 0.5 * (hi - lo).norm();
}

std::optional<Shape> readMeshFile(Section& shape) {
  // Of the size: more than rounding leaves of faces that are flat to double precision.
  constexpr double kFlat = 1e-6;
  std::string name, pieces = "good";
  std::optional<double> tolerance;
  shape.read("mesh", name);
  shape.read("pieces", pieces, std::vector<std::string>{"good", "hull", "slivers"});
  shape.read("pieces_tolerance", tolerance, {0.0, 0.5, false, {}});
  if (!shape.good()) return {};
  const PieceKind kind = pieces == "good"   ? PieceKind::Good
                         : pieces == "hull" ? PieceKind::Hull
                                            : PieceKind::Slivers;
  std::string& before = shape.findings().refusedMesh(
      fmt::format("{}\n{} {:a}", name, pieces, tolerance.value_or(-1.0)));
  if (!before.empty()) {
    shape.complain("mesh", "refused as " + before + " is");
    return {};
  }
  MeshFile file;
  try {
    file = readMesh(meshPath(name, shape.findings().file()));
    Mesh mesh{file.solid, -file.first};
    const double size = sizeOf(*mesh.solid);
    const double allowed = tolerance.value_or(kFlat) * size;
    // Who allows less than the digits leave open means what they say.
    const bool closer = tolerance && allowed < kRoughPieces * file.grain;
    mesh.pieces = storedPieces(*mesh.solid, kind, allowed, closer ? 0.0 : file.grain, name);
    return mesh;
  } catch (const MeshError& reason) {
    shape.complain("mesh", reason.what());
  } catch (const NoPieces& reason) {
    shape.complain("mesh", name + file.lineOf(reason.face()) + ": " + reason.what());
  }
  before = shape.path("mesh");
  return {};
}

std::optional<Shape> readCompound(Section& shape);

struct ShapeRow {
  const char* name;
  std::optional<Shape> (*read)(Section&);
  bool part;  // it can be a part of a compound
};
constexpr std::array<ShapeRow, 9> kShapes = {{{"sphere", readSphere, true},
                                              {"box", readBox, true},
                                              {"cylinder", readCylinder, true},
                                              {"capsule", readCapsule, true},
                                              {"hull", readHull, true},
                                              {"plane", readPlane, false},
                                              {"mesh", readMeshFile, false},
                                              {"compound", readCompound, false},
                                              {"ellipsoid", readEllipsoid, false}}};

// The one shape that a table names.
std::optional<Shape> readOne(Section& section, bool part) {
  std::optional<Shape> shape;
  std::string names;
  int given = 0;
  for (const ShapeRow& row : kShapes) {
    if (part && !row.part) continue;
    names += (names.empty() ? "" : ", ") + std::string(row.name);
    if (!section.find(row.name)) continue;
    shape = row.read(section);
    ++given;
  }
  section.finish();
  if (given == 1 || !section.good()) return shape;
  section.findings().complain(
      section.spot(), section.key(),
      "expected one of " + names + ", found " + std::to_string(given) + " of them");
  return {};
}

std::optional<Shape> readCompound(Section& shape) {
  Compound compound;
  int number = 0;
  for (const Node& node : shape.tables("compound")) {
    Section section(node, shape.path("compound." + std::to_string(number++)), shape.findings());
    Part part;
    section.read("position", part.pose.x, any("m"));
    readOrientation(section, part.pose.q);
    const std::optional<Shape> solid = readOne(section, true);
    if (!section.good() || !solid) continue;
    if (const Sphere* sphere = std::get_if<Sphere>(&*solid)) part.solid = *sphere;
    if (const Box* box = std::get_if<Box>(&*solid)) part.solid = *box;
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&*solid)) part.solid = *cylinder;
    if (const Capsule* capsule = std::get_if<Capsule>(&*solid)) part.solid = *capsule;
    if (const Hull* hull = std::get_if<Hull>(&*solid)) part.solid = *hull;
    compound.parts.push_back(part);
  }
  if (shape.good() && compound.parts.empty())
    shape.complain("compound", "expected a list of parts like [{ box = [1, 1, 1] }, …]");
  if (!shape.good()) return {};
  return compound;
}

}  // namespace

std::optional<Shape> readShape(Section& body) {
  const Node* node = body.find("shape");
  if (!node) {
    body.complain("shape", "missing, for example shape = { sphere = 0.1 }");
    return {};
  }
  if (const std::string* word = node->as<std::string>()) {
    if (*word == "particle") return readParticle(body);
    body.complain("shape", "expected \"particle\" or a table, found " + describe(*node));
    return {};
  }
  Section section(*node, body.path("shape"), body.findings());
  const std::optional<Shape> shape = readOne(section, false);
  if (!section.good()) return {};
  return shape;
}

void readOrientation(Section& section, Quat& out) {
  const Node* node = section.find("orientation");
  if (!node) return;
  if (node->as<Table>()) {
    Section turn(*node, section.path("orientation"), section.findings());
    Vec3 axis = Vec3::Zero();
    double degrees = 0.0;
    turn.read("axis", axis, any({}));
    turn.read("degrees", degrees, {-1e6, 1e6, false, "deg"});
    turn.finish();
    if (!turn.good()) return;
    if (axis.stableNorm() < 1e-9)
      return turn.complain("axis", "expected three numbers that are not all zero");
    out = fromAxisAngle(axis.stableNormalized(), degrees * (3.14159265358979323846 / 180.0));
    return;
  }
  double wxyz[4] = {0.0, 0.0, 0.0, 0.0};
  const std::size_t before = section.findings().count();
  section.read("orientation", wxyz, 4, any({}));
  if (section.findings().count() != before) return;
  const Vec4 q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  const double length = q.stableNorm();
  if (length < 1e-9)
    return section.complain("orientation", "expected [w, x, y, z] that is not zero");
  out = Quat(q[0] / length, q[1] / length, q[2] / length, q[3] / length);
}

}  // namespace tumble
