// Convex pieces beside CGAL: how many of them, in what time, and whether two meshes overlap.
#include "sim/shape/pieces.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_decomposition_3.h>

#include <ctime>
#include <fstream>
#include <sstream>

#include "sim/collide/collide.h"
#include "sim/collide/parts.h"
#include "tests/body/notched.h"
#include "tests/catch.h"
#include "tests/collide/meshes.h"

using namespace tumble;

namespace {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Surface = CGAL::Polyhedron_3<ExactKernel>;
using Rounded = CGAL::Exact_predicates_inexact_constructions_kernel;
using PlacedMesh = CGAL::Surface_mesh<Rounded::Point_3>;

/// The surface as CGAL builds it, from a polyhedron.
struct Build : CGAL::Modifier_base<Surface::HalfedgeDS> {
  const Polyhedron& solid;
  explicit Build(const Polyhedron& of) : solid(of) {}
  void operator()(Surface::HalfedgeDS& to) override {
    CGAL::Polyhedron_incremental_builder_3<Surface::HalfedgeDS> builder(to, true);
    builder.begin_surface(solid.points.size(), solid.faces.size());
    for (const Vec3& p : solid.points) builder.add_vertex({p.x(), p.y(), p.z()});
    for (const std::vector<int>& face : solid.faces) builder.add_facet(face.begin(), face.end());
    builder.end_surface();
  }
};

double secondsSince(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Volumes that CGAL's decomposition marks as inside.
int partsByCgal(const Polyhedron& solid) {
  Surface surface;
  Build build(solid);
  surface.delegate(build);
  CGAL::Nef_polyhedron_3<ExactKernel> nef(surface);
  CGAL::convex_decomposition_3(nef);
  int parts = 0;
  for (auto v = ++nef.volumes_begin(); v != nef.volumes_end(); ++v) parts += v->mark() ? 1 : 0;
  return parts;
}

/// A mesh of the program; its files have plain points and faces.
Polyhedron fromFile(const std::string& name) {
  std::ifstream file(std::string(TUMBLE_SOURCE_DIR) + "/assets/meshes/" + name);
  solids::Raw raw;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    Vec3 p;
    if (key == "v" && words >> p.x() >> p.y() >> p.z()) raw.points.push_back(p);
    if (key != "f") continue;
    raw.faces.emplace_back();
    for (int corner = 0; words >> corner;) raw.faces.back().push_back(corner - 1);
  }
  return raw.made();
}

PlacedMesh placed(const Mesh& mesh, const Pose& pose) {
  PlacedMesh surface;
  std::vector<PlacedMesh::Vertex_index> corners;
  for (const Vec3& p : mesh.solid->points) {
    const Vec3 q = toWorld(pose, p - mesh.origin);
    corners.push_back(surface.add_vertex({q.x(), q.y(), q.z()}));
  }
  for (const std::vector<int>& face : mesh.solid->faces) {
    std::vector<std::array<int, 3>> triangles;
    cutIntoTriangles(*mesh.solid, face, triangles);
    for (const auto& [a, b, c] : triangles)
      surface.add_face(corners[static_cast<std::size_t>(a)], corners[static_cast<std::size_t>(b)],
                       corners[static_cast<std::size_t>(c)]);
  }
  return surface;
}

}  // namespace

// Oracle: CGAL::convex_decomposition_3, exact: as many pieces or fewer.
TEST_CASE("meshes come apart into no more pieces than CGAL makes", "[long][figures]") {
  const std::pair<const char*, Polyhedron> all[] = {{"L", solids::ell().made()},
                                                    {"U", solids::letterU().made()},
                                                    {"comb", solids::comb(5).made()},
                                                    {"star", solids::star(5).made()},
                                                    {"dumbbell", fromFile("dumbbell.obj")},
                                                    {"spanner", fromFile("spanner.obj")}};
  for (const auto& [name, solid] : all) {
    const std::clock_t start = std::clock();
    const std::size_t ours = piecesOf(solid, PieceKind::Good, 0.0).hulls.size();
    const double seconds = secondsSince(start);
    const std::clock_t then = std::clock();
    const int theirs = partsByCgal(solid);
    WARN(name << ": measured " << ours << " pieces in " << 1e3 * seconds << " ms, by CGAL "
              << theirs << " in " << 1e3 * secondsSince(then) << " ms");
    CHECK(ours <= static_cast<std::size_t>(theirs));
  }
}

// Oracle: CGAL's do_intersect of closed surfaces, on corners in the world as rounded.
TEST_CASE("ten thousand poses of pairs of meshes overlap where CGAL says so", "[long][figures]") {
  namespace pmp = CGAL::Polygon_mesh_processing;
  Random random(93);
  int overlapping = 0, doubtful = 0;
  for (int k = 0; k < 500; ++k) {
    const Mesh a = meshes::someMesh(random), b = meshes::someMesh(random);
    const Shape partsA = readyShape(contactShape(a)), partsB = readyShape(contactShape(b));
    for (int turn = 0; turn < 20; ++turn) {
      const Pose poseA = random.pose(1.6), poseB = random.pose(0.6);
      const double gap = separation(partsA, poseA, partsB, poseB);
      if (std::abs(gap) < 1e-12) {
        ++doubtful;
        continue;
      }
      const bool meets =
          pmp::do_intersect(placed(a, poseA), placed(b, poseB),
                            CGAL::parameters::do_overlap_test_of_bounded_sides(true),
                            CGAL::parameters::do_overlap_test_of_bounded_sides(true));
      CAPTURE(k, turn, gap);
      REQUIRE(meets == (gap < 0.0));
      overlapping += meets ? 1 : 0;
    }
  }
  WARN("10,000 poses beside CGAL: measured " << overlapping << " overlaps, " << doubtful
                                             << " in doubt, no wrong sign");
  CHECK(overlapping > 2000);
}
