#include "sim/collide/facet.h"

#include <algorithm>
#include <cmath>

namespace tumble::convex {
namespace {

// Faces within this of being equally square to n are taken in their order.
constexpr double kSquareBias = 1e-9;
// [part of the size] Corners this near to the outermost one are as far out.
constexpr double kOutermost = 1e-9;

// Where steep faces meet in what is outermost, a corner or an edge, one that is squarer to n may
// not have it.
Facet faceOf(const Core& core, const Vec3& n) {
  const double far = n.dot(core.points[outermostVertex(core, n)]) - kOutermost * core.size;
  const auto outermostIn = [&](int f) {
    return std::count_if(core.faces[f].begin(), core.faces[f].end(),
                         [&](int v) { return n.dot(core.points[v]) >= far; });
  };
  int best = -1;
  std::ptrdiff_t most = 0;
  for (int f = 0; f < static_cast<int>(core.normals.size()); ++f) {
    const std::ptrdiff_t count = outermostIn(f);
    const bool squarer =
        best < 0 || core.normals[f].dot(n) > core.normals[best].dot(n) + kSquareBias;
    if (count > most || (count == most && squarer)) best = f, most = count;
  }
  Facet facet;
  facet.normal = core.normals[best];
  facet.code = faceCode(best);
  for (std::size_t k = 0; k < core.faces[best].size(); ++k) {
    const int v = core.faces[best][k];
    facet.corners.push_back(core.points[v]);
    facet.cornerCodes.push_back(vertexCode(v));
    facet.sideCodes.push_back(edgeCode(core.sides[best][k]));
  }
  return facet;
}

Facet pointsOf(const Core& core) {
  Facet facet;
  const int count = static_cast<int>(core.points.size());
  facet.code = count == 1 ? vertexCode(0) : edgeCode(0);
  for (int k = 0; k < count; ++k) {
    facet.corners.push_back(core.points[k]);
    facet.cornerCodes.push_back(vertexCode(k));
    facet.sideCodes.push_back(edgeCode(0));
  }
  return facet;
}

}  // namespace

Facet outermostFacet(const Core& core, const Vec3& n) {
  return core.normals.empty() ? pointsOf(core) : faceOf(core, n);
}

}  // namespace tumble::convex
