// Bodies that pass each other: every plane between them held to their corners, and compounds to
// other decompositions of themselves.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/claim/parting.h"
#include "app/claim/rows.h"
#include "app/record/bodies.h"
#include "app/scene/piece_store.h"
#include "sim/collide/collide.h"
#include "sim/collide/parts.h"
#include "sim/collide/polygon_pairs.h"
#include "sim/shape/convex_hull.h"

namespace tumble {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-9;  // [m] nearer than this, signs are not compared

// Width [m] of the slab between two sets of corners along n; −∞ if one is empty.
double widthAlong(const Vec3& n, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double low = kInfinity, top = -kInfinity;
  for (const Vec3& p : a) low = std::min(low, n.dot(p));
  for (const Vec3& p : b) top = std::max(top, n.dot(p));
  return a.empty() || b.empty() ? -kInfinity : low - top;
}

double nearestCorners(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double least = kInfinity;
  for (const Vec3& p : a)
    for (const Vec3& q : b) least = std::min(least, (p - q).norm());
  return least;
}

// What planes are held to, over all samples.
struct PlaneRows {
  WorstRow side{"width between corners, by plane / m", 1e-9};
  WorstRow wide{"gap, by nearest corners / m", 1e-9};
  WorstRow kept{"gap where a plane is remembered / m", 0.0};

  void see(const Parting& p) {
    const double sought = separation(p.a.solid, p.a.pose, p.b.solid, p.b.pose);
    least = std::min(least, sought);
    if (p.remembered) kept.see(sought, p.gap, sought > 0.0 ? 0.0 : 1.0);
    const std::vector<Vec3> a = cornersOf(p.a.solid, p.a.pose);
    const std::vector<Vec3> b = cornersOf(p.b.solid, p.b.pose);
    if (a.empty() || b.empty() || !(p.gap > 0.0)) return;
    const double width = widthAlong(p.n, a, b), corners = nearestCorners(a, b);
    side.see(width, p.gap, std::max(0.0, p.gap - width));
    wide.see(p.gap, corners, std::max(0.0, p.gap - corners));
  }
  double least = kInfinity;
};

// The convex hull of all corners of a compound, at its body origin; null if it has round parts.
std::optional<Hull> wrapped(const Compound& compound) {
  std::vector<Vec3> points;
  for (const PosedPart& part : convexParts(compound)) {
    const std::vector<Vec3> corners = cornersOf(part.solid, part.pose);
    if (corners.empty()) return {};
    points.insert(points.end(), corners.begin(), corners.end());
  }
  return Hull{std::make_shared<const Polyhedron>(convexHull(points)), -points.at(0)};
}

// Every box cut into four slivers across its third axis; other parts as they are.
Compound sliced(const Compound& compound) {
  constexpr int kSlivers = 4;
  Compound cut;
  cut.origin = compound.origin;
  for (const Part& part : compound.parts) {
    const Box* box = std::get_if<Box>(&part.solid);
    for (int k = 0; k < (box ? kSlivers : 1); ++k) {
      Part sliver = part;
      if (box) {
        const double half = box->half.z() / kSlivers;
        sliver.solid = Box{{box->half.x(), box->half.y(), half}};
        sliver.pose.x += part.pose.q * Vec3(0.0, 0.0, (2 * k + 1 - kSlivers) * half);
      }
      cut.parts.push_back(sliver);
    }
  }
  return cut;
}

// A shape that is a compound of boxes and hulls, or a mesh of which its pieces are all, in three
// decompositions.
struct Decomposed {
  Shape parts, slivers, hull;
};
std::optional<Decomposed> decomposed(const Mesh& mesh) {
  if (!mesh.pieces || mesh.pieces->excess > 0.0) return {};
  const auto by = [&](PieceKind kind) {
    Mesh other = mesh;
    other.pieces = storedPieces(*mesh.solid, kind, 0.0, 0.0, "mesh");
    return readyShape(contactShape(other));
  };
  return Decomposed{by(PieceKind::Good), by(PieceKind::Slivers), by(PieceKind::Hull)};
}

std::optional<Decomposed> decomposed(const Shape& shape) {
  if (const Mesh* mesh = std::get_if<Mesh>(&shape)) return decomposed(*mesh);
  const Compound* compound = std::get_if<Compound>(&shape);
  if (!compound) return {};
  const std::optional<Hull> hull = wrapped(*compound);
  if (!hull) return {};
  return Decomposed{readyShape(shape), readyShape(sliced(*compound)), *hull};
}

// Samples in which two compounds overlap, by decomposition.
struct Hits {
  long parts = 0, differ = 0, hull = 0, missed = 0;

  void see(const Decomposed& a, const Pose& poseA, const Decomposed& b, const Pose& poseB) {
    const double gap = separation(a.parts, poseA, b.parts, poseB);
    const double cut = separation(a.slivers, poseA, b.slivers, poseB);
    const bool wrap = separation(a.hull, poseA, b.hull, poseB) < 0.0;
    if (gap < -kRounding) ++parts;
    if (wrap) ++hull;
    if (gap < -kRounding && !wrap) ++missed;
    if ((gap > kRounding && cut < 0.0) || (gap < -kRounding && cut > 0.0)) ++differ;
  }
};

void addHits(const Scene& scene, const Recording& recording, std::vector<ClaimRow>& rows) {
  std::vector<std::optional<Decomposed>> shapes;
  for (const BodyDef& body : scene.world.bodies) shapes.push_back(decomposed(body.shape));
  for (std::size_t j = 0; j < shapes.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      if (!shapes[i] || !shapes[j]) continue;
      Hits hits;
      for (const Sample& sample : recording.samples) {
        const BodySample &b = sample.bodies[i], &a = sample.bodies[j];
        hits.see(*shapes[j], {a.x, a.q}, *shapes[i], {b.x, b.q});
      }
      const std::string names = scene.world.bodies[i].name + ", " + scene.world.bodies[j].name;
      const auto number = [](long n) { return static_cast<double>(n); };
      rows.push_back({names + ": samples that slivers see otherwise", number(hits.differ), 0.0,
                      number(hits.differ), 0.0});
      rows.push_back({names + ": samples that hulls hit", number(hits.hull), number(hits.parts),
                      number(hits.missed), 0.0, false, Relation::AtLeast});
    }
}

// Two meshes by their pieces and by their polygons, which share nothing; what trees of boxes and
// remembered planes spare of the pairs of polygons.
struct MeshPair {
  PolygonSoup soupA, soupB;
  PolygonPairs pairs{soupA, soupB};
  Shape partsA, partsB;
  double slack;
  long differ = 0, seen = 0, remembered = 0, all = 0;

  MeshPair(const Mesh& a, const Mesh& b)
      : soupA(a),
        soupB(b),
        partsA(readyShape(contactShape(a))),
        partsB(readyShape(contactShape(b))),
        slack(kRounding + a.pieces->excess + b.pieces->excess) {}

  void see(const Pose& poseA, const Pose& poseB) {
    const PolygonLook look = pairs.look(poseA, poseB);
    const double gap = separation(partsA, poseA, partsB, poseB);
    if ((gap > slack && !look.apart) || (gap < -slack && look.apart)) ++differ;
    seen += look.pairs;
    remembered += look.remembered;
    all += static_cast<long>(soupA.triangles().size() * soupB.triangles().size());
  }
};

void addPolygons(const Scene& scene, const Recording& recording, std::vector<ClaimRow>& rows) {
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  for (std::size_t j = 0; j < bodies.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Mesh *a = std::get_if<Mesh>(&bodies[j].shape), *b = std::get_if<Mesh>(&bodies[i].shape);
      if (!a || !b || !a->pieces || !b->pieces || !(moves(bodies[i]) || moves(bodies[j]))) continue;
      MeshPair pair(*a, *b);
      for (const Sample& sample : recording.samples)
        pair.see({sample.bodies[j].x, sample.bodies[j].q},
                 {sample.bodies[i].x, sample.bodies[i].q});
      const std::string names = bodies[i].name + ", " + bodies[j].name;
      const auto number = [](long n) { return static_cast<double>(n); };
      rows.push_back({names + ": samples that polygons see otherwise", number(pair.differ), 0.0,
                      number(pair.differ), 0.0});
      rows.push_back({names + ": pairs of polygons that boxes leave", number(pair.seen),
                      number(pair.all), pair.seen > pair.all ? 1.0 : 0.0, 0.0});
      rows.push_back({names + ": of these, planes remembered", number(pair.remembered),
                      number(pair.seen), pair.remembered > pair.seen ? 1.0 : 0.0, 0.0});
    }
}

}  // namespace

std::vector<ClaimRow> apartRows(const Scene& scene, const Recording& recording) {
  Coherence coherence(scene);
  PlaneRows planes;
  for (const Sample& sample : recording.samples)
    for (const Parting& parting : coherence.look(sample)) planes.see(parting);
  if (coherence.pairs() == 0) return {emptyClaim("no two bodies come near each other")};
  std::vector<ClaimRow> rows{{"least gap of two parts, not below / m", planes.least, 0.0,
                              std::max(0.0, -planes.least), kRounding, false, Relation::AtLeast}};
  const auto bounded = [&](const WorstRow& worst, Relation relation) {
    rows.push_back(worst.row());
    rows.back().relation = relation;
  };
  if (std::isfinite(planes.side.row().error)) {
    bounded(planes.side, Relation::AtLeast);
    bounded(planes.wide, Relation::AtMost);
  }
  if (coherence.searches() < coherence.pairs()) rows.push_back(planes.kept.row());
  rows.push_back({"planes sought of pairs seen", static_cast<double>(coherence.searches()),
                  static_cast<double>(coherence.pairs()),
                  coherence.searches() > coherence.pairs() ? 1.0 : 0.0, 0.0, false,
                  Relation::AtMost});
  addHits(scene, recording, rows);
  addPolygons(scene, recording, rows);
  return rows;
}

}  // namespace tumble
