// Meshes by three ways that share nothing: convex pieces, polygon pairs, all pairs of triangles.
#include "sim/collide/polygon_pairs.h"

#include <cmath>

#include "sim/collide/collide.h"
#include "sim/collide/parts.h"
#include "sim/math/frames.h"
#include "sim/math/orientation.h"
#include "sim/shape/pieces.h"
#include "tests/body/solids.h"
#include "tests/catch.h"
#include "tests/collide/random_pose.h"

using namespace tumble;

namespace {

/// About the middle of its height.
Mesh prism(const std::vector<Vec3>& outline, double height) {
  Mesh mesh = solids::prism(outline, height).mesh();
  mesh.origin = {0.8, 0.8, 0.5 * height};
  mesh.pieces = std::make_shared<const Pieces>(piecesOf(*mesh.solid, PieceKind::Good, 0.0));
  return mesh;
}

/// A ring about z of flat faces all around: its section is a square on edge.
Mesh ring(int around) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  const double turn = 2.0 * 3.14159265358979323846;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < 4; ++k) {
      const double a = turn * i / around;
      const double r = k == 0 ? 1.3 : k == 2 ? 0.7 : 1.0, z = k == 1 ? 0.3 : k == 3 ? -0.3 : 0.0;
      points.emplace_back(r * std::cos(a), r * std::sin(a), z);
      const int j = (i + 1) % around, l = (k + 1) % 4;
      faces.push_back({4 * i + k, 4 * j + k, 4 * j + l, 4 * i + l});
    }
  Mesh mesh{std::make_shared<const Polyhedron>(makePolyhedron(points, faces))};
  mesh.origin = -points[0];
  mesh.pieces = std::make_shared<const Pieces>(piecesOf(*mesh.solid, PieceKind::Good, 1e-9));
  return mesh;
}

Mesh someMesh(Random& random) {
  switch (random.below(3)) {
    case 0:
      return prism({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 1);
    case 1:
      return prism({{0, 0, 0},
                    {2, 0, 0},
                    {2, 1.5, 0},
                    {1.75, 1.5, 0},
                    {1.75, 0.25, 0},
                    {0.25, 0.25, 0},
                    {0.25, 1.5, 0},
                    {0, 1.5, 0}},
                   0.5);
    default:
      return ring(6);
  }
}

/// Whether an edge of one triangle passes through another, on corners in the world as rounded.
bool cross(const PolygonSoup::Corners& s, const PolygonSoup::Corners& t) {
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

bool allPairsCross(const PolygonSoup& a, const Pose& poseA, const PolygonSoup& b,
                   const Pose& poseB) {
  const auto placed = [](const PolygonSoup& soup, const Pose& pose) {
    std::vector<PolygonSoup::Corners> all = soup.triangles();
    for (PolygonSoup::Corners& t : all)
      for (Vec3& p : t.at) p = toWorld(pose, p);
    return all;
  };
  const auto ofA = placed(a, poseA), ofB = placed(b, poseB);
  for (const auto& s : ofA)
    for (const auto& t : ofB)
      if (cross(s, t) || cross(t, s)) return true;
  for (const Vec3& p : a.shells())
    if (b.contains(toBody(poseB, toWorld(poseA, p)))) return true;
  for (const Vec3& p : b.shells())
    if (a.contains(toBody(poseA, toWorld(poseB, p)))) return true;
  return false;
}

void compare(int poses) {
  Random random(91);
  int overlapping = 0, doubtful = 0;
  for (int k = 0; k < poses; ++k) {
    const Mesh a = someMesh(random), b = someMesh(random);
    const PolygonSoup soupA(a), soupB(b);
    PolygonPairs pairs(soupA, soupB);
    const Shape partsA = readyShape(contactShape(a)), partsB = readyShape(contactShape(b));
    for (int turn = 0; turn < 20; ++turn) {
      const Pose poseA = random.pose(1.6), poseB = random.pose(0.6);
      const PolygonLook look = pairs.look(poseA, poseB);
      const double gap = separation(partsA, poseA, partsB, poseB);
      const bool crossed = allPairsCross(soupA, poseA, soupB, poseB);
      if (std::abs(gap) < 1e-12 || std::abs(look.least) < look.bound) {
        ++doubtful;
        continue;
      }
      CAPTURE(k, turn, gap, look.least);
      REQUIRE(look.apart == (gap > 0.0));
      REQUIRE(look.apart == !crossed);
      overlapping += crossed ? 1 : 0;
    }
  }
  WARN(20 * poses << " poses of pairs of meshes: measured " << overlapping << " overlaps, "
                  << doubtful << " in doubt, no wrong sign");
  CHECK(overlapping > 5 * poses);
  CHECK(overlapping < 16 * poses);
  CHECK(doubtful <= poses / 1000);
}

}  // namespace

// Oracle: three detectors that share no code beyond the tree of boxes, which the third lacks.
TEST_CASE("pieces, polygon pairs and all pairs of triangles tell the same overlaps") {
  compare(100);
}
TEST_CASE("a million poses: pieces, polygon pairs and all triangles agree", "[long]") {
  compare(50'000);
}

// Oracle: all pairs. Boxes by level let fewer through, and nothing that is near is lost.
TEST_CASE("a tree of boxes finds what all pairs of boxes find, in fewer looks") {
  Random random(17);
  const Mesh mesh = ring(24);
  const PolygonSoup soup(mesh);
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
      const PolygonSoup::Corners& t = soup.triangles()[static_cast<std::size_t>(i)];
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
  }
}

// Oracle: the search anew. On a smooth way past each other planes mostly stay.
TEST_CASE("planes of polygon pairs are remembered, and change no answer") {
  const Mesh a = ring(24), b = ring(24);
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
