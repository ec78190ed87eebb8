#include "sim/collide/facet.h"

#include <cmath>

namespace tumble::convex {
namespace {

// Faces within this of being equally square to n are taken in their order.
constexpr double kSquareBias = 1e-9;
// A cylinder shows its cap if its axis is nearer to n than 45 degrees.
constexpr double kCap = 0.7071067811865476;
// A cap that leans by less than this is level: its rim has no lowest point.
constexpr double kLevel = 1e-9;
// An axis that is square to n within this shows its side: of the radius, half the square is lost.
constexpr double kLying = 1e-6;
// Points of a rim that are always shown; numbers above are those of its outermost.
constexpr int kRim = 8;

Facet faceOf(const Core& core, const Vec3& n) {
  int best = 0;
  for (int f = 1; f < static_cast<int>(core.normals.size()); ++f)
    if (core.normals[f].dot(n) > core.normals[best].dot(n) + kSquareBias) best = f;
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

// The line of a cylinder's side that is outermost along n. Where it lies square to n, as its axis
// with the radius about it, so that it rolls; else where it is, between the outermost points of the
// rims: the axis is further than the radius behind it along n.
Facet sideOf(const Core& core, const Vec3& n) {
  const Vec3 u = core.axis(), lean = n - n.dot(u) * u;
  const bool lies = std::abs(n.dot(u)) < kLying;
  Facet facet = pointsOf(core);
  facet.code = edgeCode(2);
  for (std::uint32_t& side : facet.sideCodes) side = edgeCode(2);
  for (std::size_t k = 0; k < 2; ++k) {
    facet.cornerCodes[k] = vertexCode(2 * kRim + (lies ? 2 : 0) + static_cast<int>(k));
    if (!lies) facet.corners[k] += core.disc * lean.normalized();
  }
  facet.round = lies ? core.disc : 0.0;
  return facet;
}

}  // namespace

Facet capOf(const Core& core, const Vec3& n, const Vec3& cap) {
  constexpr double d = 0.7071067811865476;
  constexpr double cosines[kRim] = {1, d, 0, -d, -1, -d, 0, d};
  const int top = cap.dot(core.axis()) > 0.0 ? 1 : 0;
  Facet facet;
  facet.normal = cap;
  facet.code = faceCode(top);
  // Two directions across the axis, that ride on the body.
  const Vec3 e1 = core.side, e2 = cap.cross(e1);
  const double x = n.dot(e1), y = n.dot(e2), lean = std::sqrt(x * x + y * y);
  const auto push = [&](double cosine, double sine, int number) {
    facet.corners.push_back(core.points[top] + core.disc * (cosine * e1 + sine * e2));
    facet.cornerCodes.push_back(vertexCode(2 * number + top));
    facet.sideCodes.push_back(edgeCode(top));
  };
  for (int k = 0; k < kRim; ++k) {
    const double c = cosines[k], s = cosines[(k + 6) % kRim];
    push(c, s, k);
    // The outermost point, if it comes before the next.
    const double cNext = cosines[(k + 1) % kRim], sNext = cosines[(k + 7) % kRim];
    if (lean > kLevel && c * y - s * x > 1e-6 * lean && x * sNext - y * cNext > 1e-6 * lean)
      push(x / lean, y / lean, kRim);
  }
  return facet;
}

Facet outermostFacet(const Core& core, const Vec3& n) {
  if (!core.normals.empty()) return faceOf(core, n);
  if (!core.isCylinder()) return pointsOf(core);
  const Vec3 u = core.axis();
  return std::abs(n.dot(u)) > kCap ? capOf(core, n, n.dot(u) > 0.0 ? u : Vec3(-u))
                                   : sideOf(core, n);
}

}  // namespace tumble::convex
