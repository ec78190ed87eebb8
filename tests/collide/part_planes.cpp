// Planes that are remembered between boxes of two bodies' parts.
#include "sim/collide/part_planes.h"

#include "sim/collide/collide.h"
#include "tests/catch.h"
#include "tests/collide/meshes.h"

using namespace tumble;

namespace {

bool same(const Manifold& a, const Manifold& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const ContactPoint& p, const ContactPoint& q) {
        return p.p == q.p && p.n == q.n && p.separation == q.separation && p.feature == q.feature;
      });
}

}  // namespace

// Oracle: the search anew, to the bit; rings in each other that come near, touch, overlap and part.
TEST_CASE("what planes between boxes of parts spare changes no contact") {
  const Shape ring = readyShape(contactShape(meshes::ring(24)));
  Random random(19);
  std::vector<PartWitness> known;
  PartLooks looks;
  Manifold remembering, fresh;
  long touching = 0, looked = 0;
  for (int way = 0; way < 12; ++way) {
    const Vec3 axis = random.direction();
    const double tilt = random.uniform(1.2, 1.9), off = random.uniform(-0.1, 0.1);
    for (int k = 0; k < 100; ++k) {
      const Pose other{
          {1.1 + 0.006 * k, off, 0.1},
          Quat(Eigen::AngleAxisd(0.002 * k, axis)) * Quat(Eigen::AngleAxisd(tilt, Vec3::UnitX()))};
      const double margin = k % 3 == 0 ? 0.001 : 0.02;
      collide(ring, Pose{}, ring, other, margin, remembering, known, looks);
      collide(ring, Pose{}, ring, other, margin, fresh);
      CAPTURE(way, k);
      REQUIRE(same(remembering, fresh));
      touching += fresh.empty() ? 0 : 1;
      ++looked;
    }
  }
  WARN("rings of 24 pieces in each other: measured " << looks.tests << " questions in " << looked
                                                     << " looks, " << looks.hits
                                                     << " answered by what was known");
  CHECK(touching > looked / 4);
  CHECK(touching < looked);
  CHECK(looks.hits > looks.tests / 2);
}
