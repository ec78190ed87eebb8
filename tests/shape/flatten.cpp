// Meshes whose corners have few digits, flat again.
#include "sim/shape/flatten.h"

#include <algorithm>
#include <cmath>

#include "sim/shape/face_groups.h"
#include "tests/body/notched.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

/// A surface turned, its corners rounded to a grain [m], and where they were.
struct Written {
  Polyhedron mesh;
  std::vector<Vec3> were;
};
Written written(const solids::Raw& raw, double grain) {
  solids::Raw made = turned(raw, Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())));
  Written all{{}, made.points};
  for (Vec3& p : made.points) p = grain * (p / grain).array().round().matrix();
  for (Vec3& p : all.were) p -= made.points[0];
  all.mesh = made.made();
  return all;
}

double largestOff(const std::vector<FaceGroup>& groups) {
  double off = 0.0;
  for (const FaceGroup& group : groups) off = std::max(off, group.off);
  return off;
}

}  // namespace

// Oracle: closed form. Of four corners of a square of which one is lifted by a little, the plane of
// least squares leaves each a quarter of it, in turn above and below; the tip is on planes that
// turn with them, and stays. Rounding of 1e-16 and the squares of the little, 1e-8, remain.
TEST_CASE("corners move to the plane that moves them least") {
  constexpr double kLift = 1e-4;
  solids::Raw pyramid{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, kLift}, {0.5, 0.5, 1}},
                      {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  const Polyhedron mesh = pyramid.made();
  const auto flat = flattened(mesh, kLift);
  REQUIRE(flat);
  const double up[] = {0.25, -0.25, 0.25, -0.25, 0.0};
  for (std::size_t i = 0; i < 5; ++i) {
    const Vec3 way = (flat->solid.points[i] - mesh.points[i]) / kLift;
    CHECK((way - Vec3(0.0, 0.0, up[i])).norm() < 2e-4);  // measured 4e-5
  }
  CHECK(flat->moved == Approx(0.25 * kLift).epsilon(1e-3));
  CHECK_FALSE(flattened(mesh, 0.1 * kLift));  // a digit that leaves no room for the lift
}

// Oracle: the mesh before it was rounded has flat faces, with corners as near as half a digit along
// each axis. All faces of the flat one are within rounding of a plane, and its corners no further
// from the rounded ones in the mean than those are: they move by the least.
TEST_CASE("a rounded mesh has flat faces again, and the same ones") {
  const auto check = [](const char* name, const solids::Raw& raw) {
    for (const double grain : {1e-3, 1e-4, 1e-6, 1e-9}) {
      const Written made = written(raw, grain);
      const auto flat = flattened(made.mesh, grain);
      CAPTURE(name, grain);
      REQUIRE(flat);
      const std::vector<FaceGroup> were = faceGroups(raw.made(), 1e-9);
      const std::vector<FaceGroup> are = faceGroups(flat->solid, 1e-9);
      CHECK(are.size() == were.size());
      double moved = 0.0, off = 0.0;
      for (std::size_t i = 0; i < made.were.size(); ++i) {
        moved += (flat->solid.points[i] - made.mesh.points[i]).squaredNorm();
        off += (made.were[i] - made.mesh.points[i]).squaredNorm();
      }
      WARN(name << " rounded to " << grain << " m: measured " << largestOff(are)
                << " m off planes, moved by at most " << flat->moved / grain << " grain");
      CHECK(largestOff(are) < 1e-13);
      CHECK(flat->moved > 0.0);
      CHECK(flat->moved < grain);
      CHECK(moved < off);
    }
  };
  check("an L", solids::ell());
  check("a star", solids::star(8));
  check("a comb", solids::comb(9));
  check("a dumbbell", solids::dumbbell());
}

// Oracle: by construction. Faces that are flat as they are written, and a step of the last digit
// between two of them.
TEST_CASE("a mesh that is flat as it is stays what it is") {
  CHECK_FALSE(flattened(solids::ell().made(), 1e-3));
  CHECK_FALSE(flattened(written(solids::ell(), 1e-4).mesh, 0.0));
  solids::Raw step = solids::ell();
  for (Vec3& p : step.points) p.x() = p.x() > 1.5 ? 1.001 : p.x() > 0.5 ? 1.0 : 0.0;
  CHECK_FALSE(flattened(step.made(), 1e-3));
  // A grain that leaves no shape.
  CHECK_FALSE(flattened(written(solids::ell(), 1e-2).mesh, 1e-2));
}

// Oracle: by construction. Facets of a fine ring lean by less than three decimals tell, so that
// some are taken for one, and no small way makes those flat.
TEST_CASE("a rough mesh without a flat one near it comes back as it is") {
  const Written ring = written(solids::torus(0.77, 0.23, 48, 24), 1e-3);
  const auto flat = flattened(ring.mesh, 1e-3);
  REQUIRE(flat);
  CHECK(flat->moved == 0.0);
  CHECK(flat->solid.points == ring.mesh.points);
}
