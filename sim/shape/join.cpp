#include "sim/shape/join.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "sim/shape/convex_hull.h"
#include "sim/shape/shape.h"

namespace tumble {
namespace {

Aabb boxOf(const Polyhedron& solid, double slack) {
  Aabb box{solid.points[0], solid.points[0]};
  for (const Vec3& p : solid.points) box = {box.lo.cwiseMin(p), box.hi.cwiseMax(p)};
  const Vec3 more = Vec3::Constant(slack);
  return {box.lo - more, box.hi + more};
}

/// The convex union of two solids, if it is one; none if both are flatter than numbers can tell.
bool join(Polyhedron& a, const Polyhedron& b, double thin) {
  std::vector<Vec3> corners = a.points;
  corners.insert(corners.end(), b.points.begin(), b.points.end());
  Polyhedron both;
  try {
    both = hullInFrame(corners);
  } catch (const NotASolid&) {
    return false;
  }
  if (std::abs(volumeOf(both) - volumeOf(a) - volumeOf(b)) > thin * areaOf(both)) return false;
  a = std::move(both);
  return true;
}

/// Numbers of two solids that make no convex one; what is joined has a new number.
using Apart = std::set<std::pair<int, int>>;

/// Joins the first two that make a convex one.
bool joinOne(std::vector<Polyhedron>& solids, double thin, double slack, std::vector<int>& number,
             Apart& apart) {
  for (std::size_t i = 0; i < solids.size(); ++i)
    for (std::size_t j = i + 1; j < solids.size(); ++j) {
      if (apart.count({number[i], number[j]}) > 0) continue;
      if (!boxOf(solids[i], slack).overlaps(boxOf(solids[j], slack)) ||
          !join(solids[i], solids[j], thin)) {
        apart.emplace(number[i], number[j]);
        continue;
      }
      number[i] = 1 + *std::max_element(number.begin(), number.end());
      solids.erase(solids.begin() + static_cast<std::ptrdiff_t>(j));
      number.erase(number.begin() + static_cast<std::ptrdiff_t>(j));
      return true;
    }
  return false;
}

}  // namespace

Polyhedron hullInFrame(const std::vector<Vec3>& corners) {
  // `convexHull` subtracts the first corner and keeps the order.
  Polyhedron hull = convexHull(corners);
  std::size_t k = 0;
  for (const Vec3& p : corners)
    if (k < hull.points.size() && p - corners[0] == hull.points[k]) hull.points[k++] = p;
  return hull;
}

double volumeOf(const Polyhedron& solid) {
  double sum = 0.0;
  for (const std::vector<int>& face : solid.faces)
    sum += (solid.points[static_cast<std::size_t>(face[0])] - solid.points[0])
               .dot(areaVector(solid, face));
  return sum / 6.0;
}

double areaOf(const Polyhedron& solid) {
  double sum = 0.0;
  for (const std::vector<int>& face : solid.faces) sum += 0.5 * areaVector(solid, face).norm();
  return sum;
}

double depthUnder(const Polyhedron& solid, const Vec3& a, const Vec3& b, const Vec3& c,
                  double area) {
  constexpr double kFacing = 0.1;  // cosine: faces turned further away tell nothing
  const Vec3 product = (b - a).cross(c - a);
  if (!(product.norm() > area)) return 0.0;
  const Vec3 m = product.normalized();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Vec3& n = solid.normals[f];
    const double slope = n.dot(m);
    if (slope < kFacing) continue;
    const double top = n.dot(solid.points[static_cast<std::size_t>(solid.faces[f][0])]);
    const double low = std::min({n.dot(a), n.dot(b), n.dot(c)});
    least = std::min(least, std::max(0.0, top - low) / slope);
  }
  return least;
}

void joinConvex(std::vector<Polyhedron>& solids, double thin, double slack) {
  std::erase_if(solids, [](const Polyhedron& solid) { return solid.points.empty(); });
  std::vector<int> number(solids.size());
  std::iota(number.begin(), number.end(), 0);
  Apart apart;
  while (joinOne(solids, thin, slack, number, apart)) {
  }
}

}  // namespace tumble
