// Meshes by three ways that share nothing: convex pieces, polygon pairs, all pairs of triangles.
#include "sim/collide/polygon_pairs.h"

#include <cmath>

#include "sim/collide/collide.h"
#include "sim/collide/parts.h"
#include "sim/math/frames.h"
#include "sim/math/orientation.h"
#include "tests/catch.h"
#include "tests/collide/meshes.h"

using namespace tumble;

namespace {

using Corners = PolygonSoup::Corners;

/// Whether an edge of one triangle passes through another, on corners in the world as rounded.
bool crosses(const Corners& s, const Corners& t) {
  for (int k = 0; k < 3; ++k) {
    const Vec3 &p = s.at[k], &q = s.at[(k + 1) % 3];
    if (orientation(t.at[0], t.at[1], t.at[2], p) == orientation(t.at[0], t.at[1], t.at[2], q))
      continue;
    const int side = orientation(p, q, t.at[0], t.at[1]);
    if (side == orientation(p, q, t.at[1], t.at[2]) && side == orientation(p, q, t.at[2], t.at[0]))
      return true;
  }
  return false;
}

struct Triangle {
  Corners corners;
  Aabb box;
};
std::vector<Triangle> trianglesAt(const PolygonSoup& soup, const Pose& pose) {
  std::vector<Triangle> all;
  for (Corners t : soup.triangles()) {
    for (Vec3& p : t.at) p = toWorld(pose, p);
    all.push_back({t,
                   {t.at[0].cwiseMin(t.at[1]).cwiseMin(t.at[2]),
                    t.at[0].cwiseMax(t.at[1]).cwiseMax(t.at[2])}});
  }
  return all;
}

bool allPairsCross(const PolygonSoup& a, const Pose& poseA, const PolygonSoup& b,
                   const Pose& poseB) {
  const std::vector<Triangle> ofA = trianglesAt(a, poseA), ofB = trianglesAt(b, poseB);
  for (const Triangle& s : ofA)
    for (const Triangle& t : ofB) {
      if ((s.box.lo.array() > t.box.hi.array()).any() ||
          (t.box.lo.array() > s.box.hi.array()).any())
        continue;
      if (crosses(s.corners, t.corners) || crosses(t.corners, s.corners)) return true;
    }
  for (const Vec3& p : a.shells())
    if (b.contains(toBody(poseB, toWorld(poseA, p)))) return true;
  for (const Vec3& p : b.shells())
    if (a.contains(toBody(poseA, toWorld(poseB, p)))) return true;
  return false;
}

struct OverlapTally {
  int poses = 0, overlapping = 0, doubtful = 0;
};

/// Twenty poses of two meshes. Pieces may stand out of them by what they say.
void comparePoses(const Mesh& a, const Mesh& b, Random& random, OverlapTally& tally) {
  const PolygonSoup soupA(a), soupB(b);
  PolygonPairs pairs(soupA, soupB);
  const Shape partsA = readyShape(contactShape(a)), partsB = readyShape(contactShape(b));
  const double bound = std::max(1e-12, a.pieces->excess + b.pieces->excess);
  for (int turn = 0; turn < 20; ++turn) {
    const Pose poseA = random.pose(1.6), poseB = random.pose(0.6);
    const PolygonLook look = pairs.look(poseA, poseB);
    const double gap = separation(partsA, poseA, partsB, poseB);
    const bool crossed = allPairsCross(soupA, poseA, soupB, poseB);
    ++tally.poses;
    if (std::abs(gap) < bound || std::abs(look.least) < look.bound) {
      ++tally.doubtful;
      continue;
    }
    CAPTURE(tally.poses, gap, look.least);
    REQUIRE(look.apart == (gap > 0.0));
    REQUIRE(look.apart == !crossed);
    tally.overlapping += crossed ? 1 : 0;
  }
}

void reportOverlaps(const char* what, const OverlapTally& tally) {
  WARN(tally.poses << " poses of pairs of " << what << ": measured " << tally.overlapping
                   << " overlaps, " << tally.doubtful << " in doubt, no wrong sign");
  CHECK(tally.overlapping > tally.poses / 4);
  CHECK(tally.overlapping < tally.poses * 4 / 5);
  CHECK(tally.doubtful <= tally.poses / 20'000);
}

void compareMeshes(int pairs) {
  Random random(91);
  OverlapTally tally;
  for (int k = 0; k < pairs; ++k) {
    const Mesh a = meshes::someMesh(random), b = meshes::someMesh(random);
    comparePoses(a, b, random, tally);
  }
  reportOverlaps("meshes", tally);
}

}  // namespace

// Oracle: three detectors that share no code beyond the tree of boxes, which the third lacks.
TEST_CASE("pieces, polygon pairs and all pairs of triangles tell the same overlaps") {
  compareMeshes(100);
}
TEST_CASE("a million poses: pieces, polygon pairs and all triangles agree", "[long][figures]") {
  compareMeshes(50'000);
}
TEST_CASE("a thousand poses of tori: pieces, polygon pairs and all triangles agree",
          "[long][figures]") {
  Mesh torus = solids::torus(1.0, 0.3, 48, 24).mesh();
  torus.origin = -torus.solid->points[0];
  torus.pieces = std::make_shared<const Pieces>(piecesOf(*torus.solid, PieceKind::Good, 1.4e-6));
  Random random(92);
  OverlapTally tally;
  for (int k = 0; k < 50; ++k) comparePoses(torus, torus, random, tally);
  reportOverlaps("tori", tally);
}

// Oracle: all pairs. Boxes by level let fewer through, and nothing that is near is lost.
TEST_CASE("a tree of boxes finds what all pairs of boxes find, in fewer looks", "[figures]") {
  Random random(17);
  const Mesh mesh = meshes::ring(24);
  const PolygonSoup soup(mesh);
  Survivors whole;
  for (int k = 0; k < 50; ++k) {
    const Pose poseA = random.pose(1.5), poseB = random.pose(0.2);
    const Seat seat = seatOf(poseA, poseB);
    const double reach = 0.05;
    std::vector<std::pair<int, int>> found, all;
    Survivors count;
    forNear(
        soup.tree(), soup.tree(), seat, reach, [&](int i, int j) { found.emplace_back(i, j); },
        &count);
    const auto boxOf = [&](int i) {
      const Corners& t = soup.triangles()[static_cast<std::size_t>(i)];
      return Aabb{t.at[0].cwiseMin(t.at[1]).cwiseMin(t.at[2]),
                  t.at[0].cwiseMax(t.at[1]).cwiseMax(t.at[2])};
    };
    const int n = static_cast<int>(soup.triangles().size());
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        if (gapOf(boxOf(i), boxOf(j), seat) <= reach) all.emplace_back(i, j);
    std::sort(found.begin(), found.end());
    REQUIRE(found == all);
    long tested = 0;
    for (const long level : count.tested) tested += level;
    CHECK(tested < n * n / 2);
    whole.tested.resize(std::max(whole.tested.size(), count.tested.size()));
    whole.left.resize(whole.tested.size());
    for (std::size_t level = 0; level < count.tested.size(); ++level) {
      whole.tested[level] += count.tested[level];
      whole.left[level] += count.left[level];
    }
  }
  std::string levels;
  for (std::size_t level = 0; level < whole.tested.size(); ++level)
    levels += " " + std::to_string(whole.left[level]) + "/" + std::to_string(whole.tested[level]);
  WARN(
      "50 poses of two rings of 192 triangles: measured pairs of boxes left of those looked at, "
      "from the root to the leaves:"
      << levels);
}

// Oracle: the search anew. On a smooth way past each other planes mostly stay.
TEST_CASE("planes of polygon pairs are remembered, and change no answer", "[figures]") {
  const Mesh a = meshes::ring(24), b = meshes::ring(24);
  const PolygonSoup soupA(a), soupB(b);
  PolygonPairs known(soupA, soupB);
  long pairs = 0, remembered = 0;
  for (int k = 0; k < 200; ++k) {
    // Interlocked, and turning in each other.
    const Quat turned(Eigen::AngleAxisd(1.57 + 0.001 * k, Vec3::UnitX()));
    const Pose poseA{{1.0, 0.0, 0.001 * k}, turned}, poseB;
    const PolygonLook look = known.look(poseA, poseB);
    PolygonPairs fresh(soupA, soupB);
    REQUIRE(look.apart == fresh.look(poseA, poseB).apart);
    REQUIRE(look.apart);
    pairs += look.pairs;
    remembered += look.remembered;
  }
  WARN("interlocked rings: measured planes remembered " << remembered << " of " << pairs
                                                        << " pairs of polygons");
  CHECK(remembered > 0.9 * pairs);
}
