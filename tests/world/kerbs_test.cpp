// Steps in a solid that are lower than its pieces may stand out of it.
#include <algorithm>
#include <cmath>

#include "sim/shape/pieces.h"
#include "tests/body/solids.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// A floor with a kerb 1.5 mm high at x = 0.5, whose underside is hollow by 0.45 mm: a piece that
/// fills the hollow reaches, by its bound, out by twice that.
solids::Raw floorWithKerb(bool mirrored) {
  std::vector<Vec3> outline{{-3.0, -0.5, 0},  {0.0, -0.49955, 0}, {3.0, -0.5, 0}, {3.0, 0.0015, 0},
                            {0.5, 0.0015, 0}, {0.5, 0.0, 0},      {-3.0, 0.0, 0}};
  if (mirrored) {
    std::reverse(outline.begin(), outline.end());
    for (Vec3& p : outline) p.x() = -p.x();
  }
  return solids::moved(solids::prism(outline, 2.0), {0.0, 0.0, -1.0});
}

struct KerbEnd {
  Vec3 x;                // [m] seen from the floor
  double deepest = 0.0;  // [m] by the audit
  double added = 0.0;    // [J]
  double excess = 0.0;   // [m]
};

/// Where a box ends that slides on ice into the kerb; pieces may stand out by `tolerance` [m].
KerbEnd endAtKerb(const char* method, double tolerance, bool mirrored, bool turned) {
  const Quat turn =
      turned ? Quat(Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, 3.0).normalized())) : Quat::Identity();
  const double way = mirrored ? -1.0 : 1.0;
  WorldDef def = worldOf(method, 1.0, {});
  def.gravity = turn * Vec3(0.0, -9.81, 0.0);
  const solids::Raw raw = floorWithKerb(mirrored);
  Mesh mesh = raw.mesh();
  Pieces pieces = piecesOf(*mesh.solid, PieceKind::Good, tolerance);
  if (turned) std::reverse(pieces.hulls.begin(), pieces.hulls.end());
  mesh.pieces = std::make_shared<const Pieces>(pieces);
  BodyDef ground;
  ground.name = "floor";
  ground.shape = mesh;
  ground.fixed = true;
  ground.position = turn * (raw.points[0] + originOf(centredShape(ground)));
  ground.orientation = turn;
  BodyDef body = box("box", {0.4, 0.2, 0.3}, turn * Vec3(-0.1 * way, 0.1, 0.02));
  body.velocity = turn * Vec3(0.5 * way, 0.0, 0.0);
  body.orientation = turn;
  def.bodies = {ground, body};
  World world(def);
  world.advance(def.duration);
  const Certificate& books = world.report().certificate;
  return {turn.conjugate() * world.sample(def.duration).bodies[1].x, books.audit_max_penetration,
          books.energy_added_repair, pieces.excess};
}

}  // namespace

// Oracle: the same floor in exact pieces. Measured 2e-15 m and overlaps to 3.5e-10 m, allowed 1e-9
// m; where the seam counts as wide as the groove is deep the box sinks 0.37 mm into the kerb, is
// lifted onto it, and ends 0.11 m further.
TEST_CASE("a kerb that is lower than pieces stand out elsewhere stops what runs into it") {
  const char* method = GENERATE("stepping", "exact", "course");
  const bool mirrored = GENERATE(false, true), turned = GENERATE(false, true);
  const KerbEnd exact = endAtKerb(method, 0.0, mirrored, turned);
  const KerbEnd rough = endAtKerb(method, 1e-3, mirrored, turned);
  CAPTURE(method, mirrored, turned);
  REQUIRE(rough.excess == Approx(0.9e-3));
  CHECK(std::abs(exact.x.x()) < 0.3);
  CHECK((rough.x - exact.x).norm() < 1e-9);
  CHECK(rough.deepest < 1e-9);
  CHECK(rough.added < 1e-9);
}
