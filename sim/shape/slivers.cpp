#include "sim/shape/slivers.h"

#include <utility>

#include "sim/shape/convex_hull.h"
#include "sim/shape/cut.h"
#include "sim/shape/notches.h"

namespace tumble {
namespace {

constexpr int kSlices = 4;

cut::Surface surfaceOf(const Polyhedron& solid) {
  cut::Surface surface;
  std::vector<std::array<int, 3>> triangles;
  for (const std::vector<int>& face : solid.faces) cutIntoTriangles(solid, face, triangles);
  for (const auto& corner : triangles) surface.push_back({corner});
  return surface;
}

void addSlice(const cut::Points& points, const cut::Surface& slice, std::vector<Hull>& slices) {
  if (slice.empty()) return;
  try {
    slices.push_back(
        {std::make_shared<const Polyhedron>(hullInFrame(cut::cornersOf(points, slice)))});
  } catch (const NotASolid&) {
  }
}

}  // namespace

std::vector<Hull> slivered(const std::vector<Hull>& pieces, const Polyhedron& mesh) {
  Vec3 lo = mesh.points[0], hi = lo;
  for (const Vec3& p : mesh.points) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  const Vec3 edges = hi - lo;
  const double size = edges.maxCoeff();
  int axis = 0;
  edges.minCoeff(&axis);
  const Vec3 u = size * Vec3::Unit((axis + 1) % 3), v = size * Vec3::Unit((axis + 2) % 3);
  std::vector<Hull> slices;
  for (const Hull& piece : pieces) {
    cut::Points points{piece.solid->points, {}};
    points.exact.resize(points.at.size());
    cut::Surface rest = surfaceOf(*piece.solid);
    for (int k = 1; k < kSlices && !rest.empty(); ++k) {
      const Vec3 p = lo + k * edges[axis] / kSlices * Vec3::Unit(axis);
      cut::Halves halves =
          cut::halve(points, rest, cut::planeThrough(p, p + u, p + v), cut::kRounding * size);
      addSlice(points, halves.below, slices);
      rest = std::move(halves.above);
    }
    addSlice(points, rest, slices);
  }
  return slices;
}

}  // namespace tumble
