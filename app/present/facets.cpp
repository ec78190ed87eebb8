#include "app/present/facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "sim/math/frames.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

constexpr double kCrease = 0.8660254037844386;  // cos 30°
constexpr float kNoEdge = 1e6f;                 // [m] to a line that is not drawn
constexpr int kSides = 48;

Vec3 pointOf(const Polyhedron& solid, int i) {
  return solid.points[static_cast<std::size_t>(i)];
}

// What shading needs of the neighbourhood: which faces meet at a point, which at an edge.
class Neighbours {
 public:
  explicit Neighbours(const Polyhedron& solid) : atPoint_(solid.points.size()) {
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
      const std::vector<int>& face = solid.faces[f];
      areas_.push_back(areaVector(solid, face));
      for (std::size_t k = 0; k < face.size(); ++k) {
        atPoint_[static_cast<std::size_t>(face[k])].push_back(f);
        atEdge_[{face[k], face[(k + 1) % face.size()]}] = f;
      }
    }
  }

  Vec3 normal(std::size_t face) const { return areas_[face].normalized(); }

  // Mean over the faces about a point that continue this one smoothly.
  Vec3 normalAt(std::size_t face, int point) const {
    Vec3 sum = Vec3::Zero();
    for (const std::size_t other : atPoint_[static_cast<std::size_t>(point)])
      if (normal(other).dot(normal(face)) > kCrease) sum += areas_[other];
    return sum.normalized();
  }

  // Whether two of a face's points are an edge of it, and a sharp one.
  bool isLine(int from, int to) const {
    const auto here = atEdge_.find({from, to}), there = atEdge_.find({to, from});
    return here != atEdge_.end() && there != atEdge_.end() &&
           normal(here->second).dot(normal(there->second)) <= kCrease;
  }

 private:
  std::vector<Vec3> areas_;
  std::vector<std::vector<std::size_t>> atPoint_;
  std::map<std::pair<int, int>, std::size_t> atEdge_;
};

// A solid at a pose in the frame of the facets.
void addSolid(const Polyhedron& solid, const Pose& pose, Facets& facets) {
  const Neighbours neighbours(solid);
  const Mat3 R = rotationMatrix(pose.q);
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    std::vector<std::array<int, 3>> triangles;
    cutIntoTriangles(solid, solid.faces[f], triangles);
    for (const std::array<int, 3>& triangle : triangles) {
      Facets::Corner corners[3];
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = R * pointOf(solid, triangle[k]) + pose.x;
        const Vec3 n = R * neighbours.normalAt(f, triangle[k]);
        corners[k] = {p.cast<float>(), n.cast<float>(), Eigen::Vector3f::Constant(kNoEdge)};
      }
      // Along a line the distance is 0, at the corner across it the height of the triangle.
      for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3, across = (k + 2) % 3;
        if (!neighbours.isLine(triangle[k], triangle[l])) continue;
        const Vec3 edge = pointOf(solid, triangle[l]) - pointOf(solid, triangle[k]);
        const Vec3 side = pointOf(solid, triangle[across]) - pointOf(solid, triangle[k]);
        for (Facets::Corner& corner : corners) corner.toEdge[k] = 0.0f;
        corners[across].toEdge[k] = static_cast<float>(edge.cross(side).norm() / edge.norm());
      }
      for (const Facets::Corner& corner : corners) facets.corners.push_back(corner);
    }
  }
}

Polyhedron boxOf(const Vec3& half) {
  Polyhedron box;
  for (int k = 0; k < 8; ++k)
    box.points.emplace_back(k & 1 ? half.x() : -half.x(), k & 2 ? half.y() : -half.y(),
                            k & 4 ? half.z() : -half.z());
  box.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return box;
}

// Rings of points about Y, each at a height with a radius, from below to above, closed by the first
// and last as flat faces.
Polyhedron turnedSolid(const std::vector<std::pair<double, double>>& heightsAndRadii) {
  Polyhedron solid;
  const int rings = static_cast<int>(heightsAndRadii.size());
  for (const auto& [height, radius] : heightsAndRadii)
    for (int i = 0; i < kSides; ++i) {
      double s = 0.0, c = 1.0;
      sinCos(2.0 * EIGEN_PI * i / kSides, s, c);
      solid.points.emplace_back(radius * c, height, -radius * s);
    }
  std::vector<int> below, above;
  for (int i = 0; i < kSides; ++i) {
    const int j = (i + 1) % kSides;
    for (int ring = 0; ring + 1 < rings; ++ring) {
      const int low = ring * kSides, high = low + kSides;
      solid.faces.push_back({low + i, low + j, high + j, high + i});
    }
    below.push_back(kSides - 1 - i);
    above.push_back((rings - 1) * kSides + i);
  }
  solid.faces.push_back(below);
  solid.faces.push_back(above);
  return solid;
}

Polyhedron solidOf(const Box& box) {
  return boxOf(box.half);
}
Polyhedron solidOf(const Cylinder& c) {
  return turnedSolid({{-0.5 * c.h, c.r}, {0.5 * c.h, c.r}});
}
Polyhedron solidOf(const Capsule& c) {
  constexpr int kRings = kSides / 4;
  std::vector<std::pair<double, double>> rings;
  for (int k = 0; k <= kRings; ++k) {
    double sine = 1.0, cosine = 0.0;
    if (k < kRings) sinCos(0.5 * EIGEN_PI * (k + 0.5) / kRings, sine, cosine);
    rings.emplace_back(-0.5 * c.h - c.r * cosine, c.r * sine);
  }
  for (int k = kRings; k >= 0; --k) rings.emplace_back(-rings[k].first, rings[k].second);
  return turnedSolid(rings);
}
Polyhedron solidOf(const Hull& hull) {
  Polyhedron solid = *hull.solid;
  for (Vec3& p : solid.points) p -= hull.origin;
  return solid;
}
Polyhedron solidOf(const Sphere& sphere) {
  std::vector<std::pair<double, double>> rings;
  for (int k = 0; k < kSides / 2; ++k) {
    double s = 0.0, c = 1.0;
    sinCos(EIGEN_PI * (k + 0.5) / (kSides / 2), s, c);
    rings.emplace_back(-sphere.r * c, sphere.r * s);
  }
  return turnedSolid(rings);
}

// A ball, stretched.
Polyhedron solidOf(const Ellipsoid& e) {
  Polyhedron solid = solidOf(Sphere{1.0});
  for (Vec3& p : solid.points) p = p.cwiseProduct(e.half);
  return solid;
}

// Normals of the surface itself: a flat one is bent too sharply at its rim for those of faces.
void smooth(const Ellipsoid& e, const Mat3& stretch, Facets& facets) {
  const Mat3 back = stretch.inverse();
  const Vec3 inverse = e.half.cwiseAbs2().cwiseInverse();
  for (Facets::Corner& corner : facets.corners) {
    const Vec3 p = back * corner.position.cast<double>();
    corner.normal = (back.transpose() * inverse.cwiseProduct(p)).normalized().cast<float>();
    corner.toEdge = Eigen::Vector3f::Constant(kNoEdge);
  }
}

void measure(Facets& facets) {
  Eigen::Vector3f lo = facets.corners[0].position, hi = lo;
  for (const Facets::Corner& corner : facets.corners) {
    lo = lo.cwiseMin(corner.position);
    hi = hi.cwiseMax(corner.position);
    facets.reach = std::max(facets.reach, static_cast<double>(corner.position.norm()));
  }
  facets.thickness = 0.5 * static_cast<double>((hi - lo).minCoeff());
}

// Calls act(solid, pose in the body frame) for each solid of a shape that has a surface of its own.
template <class Action>
void forEachSolid(const Shape& shape, Action act) {
  if (const Mesh* mesh = std::get_if<Mesh>(&shape)) {
    act(*mesh->solid, Pose{-mesh->origin, Quat::Identity()});
  } else if (const Compound* compound = std::get_if<Compound>(&shape)) {
    for (const Part& part : compound->parts)
      act(std::visit([](const auto& piece) { return solidOf(piece); }, part.solid),
          poseInBody(*compound, part));
  } else if (const Box* box = std::get_if<Box>(&shape)) {
    act(solidOf(*box), Pose{});
  } else if (const Sphere* sphere = std::get_if<Sphere>(&shape)) {
    act(solidOf(*sphere), Pose{});
  } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape)) {
    act(solidOf(*cylinder), Pose{});
  } else if (const Capsule* capsule = std::get_if<Capsule>(&shape)) {
    act(solidOf(*capsule), Pose{});
  } else if (const Ellipsoid* ellipsoid = std::get_if<Ellipsoid>(&shape)) {
    act(solidOf(*ellipsoid), Pose{});
  } else if (const Hull* hull = std::get_if<Hull>(&shape)) {
    act(solidOf(*hull), Pose{});
  }
}

}  // namespace

std::shared_ptr<const Facets> facetsOf(const Shape& shape) {
  const bool drawnSo = std::holds_alternative<Capsule>(shape) ||
                       std::holds_alternative<Hull>(shape) || std::holds_alternative<Mesh>(shape) ||
                       std::holds_alternative<Compound>(shape);
  if (!drawnSo) return nullptr;
  auto facets = std::make_shared<Facets>();
  forEachSolid(shape,
               [&](const Polyhedron& solid, const Pose& pose) { addSolid(solid, pose, *facets); });
  measure(*facets);
  return facets;
}

std::vector<std::shared_ptr<const Facets>> facetsOfBodies(std::span<const BodyDef> bodies) {
  using Key = std::tuple<const Polyhedron*, double, double, double>;
  std::map<Key, std::shared_ptr<const Facets>> known;
  std::vector<std::shared_ptr<const Facets>> facets;
  const auto share = [&](const Shape& shape, const Polyhedron* solid, const Vec3& numbers) {
    auto& found = known[{solid, numbers.x(), numbers.y(), numbers.z()}];
    if (!found) found = facetsOf(shape);
    return found;
  };
  for (const BodyDef& body : bodies) {
    if (const Capsule* capsule = std::get_if<Capsule>(&body.shape))
      facets.push_back(share(body.shape, nullptr, Vec3(capsule->r, capsule->h, 0.0)));
    else if (const Hull* hull = std::get_if<Hull>(&body.shape))
      facets.push_back(share(body.shape, hull->solid.get(), hull->origin));
    else if (const Mesh* mesh = std::get_if<Mesh>(&body.shape))
      facets.push_back(share(body.shape, mesh->solid.get(), mesh->origin));
    else
      facets.push_back(facetsOf(body.shape));
  }
  return facets;
}

std::shared_ptr<const Facets> facetsOf(const Shape& shape, const Mat3& stretch) {
  auto facets = std::make_shared<Facets>();
  forEachSolid(shape, [&](Polyhedron solid, const Pose& pose) {
    for (Vec3& p : solid.points) p = stretch * toWorld(pose, p);
    addSolid(solid, {}, *facets);
  });
  if (facets->corners.empty()) return nullptr;
  if (const Ellipsoid* ellipsoid = std::get_if<Ellipsoid>(&shape))
    smooth(*ellipsoid, stretch, *facets);
  measure(*facets);
  return facets;
}

}  // namespace tumble
