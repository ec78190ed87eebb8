#include "sim/collide/facet.h"

#include <algorithm>
#include <cmath>

namespace tumble::convex {
namespace {

// Faces within this of being equally square to n are taken in their order.
constexpr double kSquareBias = 1e-9;
// [part of the size] A face as far out as this has the outermost corner.
constexpr double kOutermost = 1e-9;

// Where steep faces meet in the outermost corner, one that is squarer to n may not reach it.
Facet faceOf(const Core& core, const Vec3& n) {
  const double far = n.dot(core.points[outermostVertex(core, n)]) - kOutermost * core.size;
  const auto reaches = [&](int f) {
    return std::any_of(core.faces[f].begin(), core.faces[f].end(),
                       [&](int v) { return n.dot(core.points[v]) >= far; });
  };
  int best = -1;
  for (int f = 0; f < static_cast<int>(core.normals.size()); ++f)
    if ((best < 0 || core.normals[f].dot(n) > core.normals[best].dot(n) + kSquareBias) &&
        reaches(f))
      best = f;
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
