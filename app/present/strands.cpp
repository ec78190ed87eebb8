#include "app/present/strands.h"

#include <algorithm>
#include <cmath>

#include "app/present/curve.h"
#include "app/present/palette.h"

namespace tumble {

namespace {

constexpr float kNoEdge = 1e9f;  // [m] from an edge that is not drawn
constexpr int kSides = 4;        // of a tube, whose normals are those of a round one

// A cross-section of a tube.
struct Ring {
  Vec3 middle, u, v;  // u, v unit across it
  double radius = 0.0;
};

// Rings along a curve, each turned no further than the curve turns.
std::vector<Ring> ringsAlong(const std::vector<Vec3>& curve, double radius) {
  std::vector<Ring> rings;
  Vec3 u = Vec3::UnitX();
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const Vec3 way = curve[std::min(k + 1, curve.size() - 1)] - curve[k > 0 ? k - 1 : 0];
    const Vec3 t = way.normalized();
    Vec3 across = u - u.dot(t) * t;
    if (across.squaredNorm() < 1e-4) across = t.unitOrthogonal();
    u = across.normalized();
    const double s = static_cast<double>(k) / static_cast<double>(curve.size() - 1);
    rings.push_back({curve[k], u, t.cross(u), radius * (1.0 - 0.75 * s * s)});
  }
  return rings;
}

void addTube(const std::vector<Ring>& rings, Facets& facets) {
  const auto corner = [&](const Ring& ring, int side) {
    constexpr double kTurn[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const Vec3 n = kTurn[side % kSides][0] * ring.u + kTurn[side % kSides][1] * ring.v;
    const Vec3 place = ring.middle + ring.radius * n;
    facets.corners.push_back(
        {place.cast<float>(), n.cast<float>(), Eigen::Vector3f::Constant(kNoEdge)});
    facets.reach = std::max(facets.reach, place.norm());
  };
  for (std::size_t k = 0; k + 1 < rings.size(); ++k)
    for (int side = 0; side < kSides; ++side) {
      corner(rings[k], side), corner(rings[k], side + 1), corner(rings[k + 1], side + 1);
      corner(rings[k], side), corner(rings[k + 1], side + 1), corner(rings[k + 1], side);
    }
}

}  // namespace

std::array<Colour, 3> shadesOfStrands(const Colour& colour) {
  return {shade(colour, 0.82f), colour, shade(colour, 1.15f)};
}

std::vector<Instance> strandTubes(const BentDef& fur, const Sample& sample, const Colour& colour) {
  const auto at = [&](int point) {
    return sample.bodies[static_cast<std::size_t>(fur.first + point)].x;
  };
  Vec3 middle = Vec3::Zero();
  for (int p = 0; p < fur.count; ++p) middle += at(p) / fur.count;
  const std::array<Colour, 3> shades = shadesOfStrands(colour);
  std::array<Facets, std::tuple_size_v<decltype(shades)>> tubes;
  for (int first = 0; first + fur.strand <= fur.count; first += fur.strand) {
    std::vector<Vec3> places;
    for (int p = 1; p < fur.strand; ++p) places.push_back(at(first + p) - middle);
    Facets& facets = tubes[static_cast<std::size_t>(first / fur.strand) % tubes.size()];
    addTube(ringsAlong(curveThrough(places, kPartsOfStrands), 0.5 * fur.thickness), facets);
  }
  std::vector<Instance> instances;
  for (std::size_t k = 0; k < tubes.size(); ++k) {
    if (tubes[k].corners.empty()) continue;
    tubes[k].thickness = 0.5 * fur.thickness;
    Instance& instance = instances.emplace_back();
    instance.form = Form::Facets;
    instance.position = middle;
    instance.colour = shades[k];
    instance.facets = std::make_shared<const Facets>(std::move(tubes[k]));
  }
  return instances;
}

}  // namespace tumble
