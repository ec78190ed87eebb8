#include "app/scene/roots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace tumble {

namespace {

constexpr double kPi = std::numbers::pi;

// A triangle of a polyhedron's surface.
struct Triangle {
  Vec3 a, b, c, normal;
  double upTo = 0.0;  // [m²] area of all up to this one
};

// Uniform on the unit ball's surface, and in the unit disc, both by rejection.
Vec3 directionBy(Random& random) {
  for (;;) {
    const Vec3 p = random.inBox(Vec3::Constant(-1.0), Vec3::Constant(1.0));
    const double square = p.squaredNorm();
    if (square <= 1.0 && square > 1e-6) return p / std::sqrt(square);
  }
}
Eigen::Vector2d inDisc(Random& random) {
  for (;;) {
    const double x = random.between(-1.0, 1.0);
    const double y = random.between(-1.0, 1.0);
    if (x * x + y * y <= 1.0 && x * x + y * y > 1e-6) return {x, y};
  }
}

// One place, uniform over the surface, for each shape that has one.
class Sower {
 public:
  Sower(const Shape& shape, Random& random) : shape_(shape), random_(random) {
    if (const auto* hull = std::get_if<Hull>(&shape)) cut(*hull->solid, hull->origin);
    if (const auto* mesh = std::get_if<Mesh>(&shape)) cut(*mesh->solid, mesh->origin);
  }

  Root draw() {
    return std::visit([this](const auto& solid) { return on(solid); }, shape_);
  }

 private:
  Root on(const Sphere& ball) {
    const Vec3 n = directionBy(random_);
    return {ball.r * n, n};
  }

  Root on(const Box& box) {
    const Vec3& h = box.half;
    const Vec3 sides(h.y() * h.z(), h.z() * h.x(), h.x() * h.y());
    double which = random_.between(0.0, 2.0 * sides.sum());
    int side = 0;
    for (; side < 5 && which >= sides[side / 2]; ++side) which -= sides[side / 2];
    Root root{random_.inBox(-h, h), Vec3::Zero()};
    root.normal[side / 2] = side % 2 ? -1.0 : 1.0;
    root.place[side / 2] = root.normal[side / 2] * h[side / 2];
    return root;
  }

  // The side of a cylinder of height h, or where the draw falls beyond it: how far [m²].
  std::pair<Root, double> round(double r, double h, double ends) {
    const double which = random_.between(0.0, 2.0 * kPi * r * h + ends);
    const Eigen::Vector2d d = inDisc(random_).normalized();
    const Vec3 n(d.x(), 0.0, d.y());
    const double y = random_.between(-0.5 * h, 0.5 * h);
    return {{r * n + Vec3(0.0, y, 0.0), n}, which - 2.0 * kPi * r * h};
  }

  Root on(const Cylinder& can) {
    const double lid = kPi * can.r * can.r;
    const auto [root, beyond] = round(can.r, can.h, 2.0 * lid);
    if (beyond < 0.0) return root;
    const double up = beyond < lid ? 1.0 : -1.0;
    const Eigen::Vector2d d = can.r * inDisc(random_);
    return {{d.x(), 0.5 * up * can.h, d.y()}, up * Vec3::UnitY()};
  }

  Root on(const Capsule& pill) {
    const auto [root, beyond] = round(pill.r, pill.h, 4.0 * kPi * pill.r * pill.r);
    if (beyond < 0.0) return root;
    const Vec3 n = directionBy(random_);
    return {pill.r * n + Vec3(0.0, n.y() > 0.0 ? 0.5 * pill.h : -0.5 * pill.h, 0.0), n};
  }

  // A ball that is stretched: its area grows by |d/half|, up to that at the shortest half axis.
  Root on(const Ellipsoid& egg) {
    for (;;) {
      const Vec3 d = directionBy(random_);
      const Vec3 n = d.cwiseQuotient(egg.half);
      if (random_.unit() * egg.half.cwiseInverse().maxCoeff() <= n.norm())
        return {d.cwiseProduct(egg.half), n.normalized()};
    }
  }

  Root on(const Hull&) { return onTriangles(); }
  Root on(const Mesh&) { return onTriangles(); }
  Root on(const HalfSpace&) { return {}; }
  Root on(const Particle&) { return {}; }
  Root on(const Compound&) { return {}; }

  void cut(const Polyhedron& solid, const Vec3& origin) {
    double area = 0.0;
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
      std::vector<std::array<int, 3>> pieces;
      cutIntoTriangles(solid, solid.faces[f], pieces);
      for (const auto& [a, b, c] : pieces) {
        const Vec3 p = solid.points[a], q = solid.points[b], r = solid.points[c];
        area += 0.5 * (q - p).cross(r - p).norm();
        triangles_.push_back({p - origin, q - origin, r - origin, solid.normals[f], area});
      }
    }
  }

  Root onTriangles() {
    const double which = random_.between(0.0, triangles_.back().upTo);
    const auto at = std::upper_bound(triangles_.begin(), triangles_.end() - 1, which,
                                     [](double w, const Triangle& t) { return w < t.upTo; });
    double u = random_.unit();
    double v = random_.unit();
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    return {at->a + u * (at->b - at->a) + v * (at->c - at->a), at->normal};
  }

  const Shape& shape_;
  Random& random_;
  std::vector<Triangle> triangles_;
};

// A place in the area; nothing if ten thousand in a row miss it.
std::optional<Root> drawIn(const RootArea& area, Sower& sower) {
  constexpr int kMostTries = 10'000;
  for (int k = 0; k < kMostTries; ++k) {
    const Root root = sower.draw();
    if (root.normal.dot(area.towards) >= area.least) return root;
  }
  return {};
}

}  // namespace

std::string barrenness(const Shape& shape) {
  if (std::holds_alternative<HalfSpace>(shape)) return "a plane has no end to spread strands over";
  if (std::holds_alternative<Particle>(shape)) return "a particle has no surface";
  if (std::holds_alternative<Compound>(shape)) return "a compound has parts; name a body of one";
  return "";
}

std::vector<Root> rootsOn(const Shape& shape, const RootArea& area, int count, Random random) {
  constexpr int kCandidates = 8;
  Sower sower(shape, random);
  std::vector<Root> roots;
  while (static_cast<int>(roots.size()) < count) {
    Root best;
    double farthest = -1.0;
    for (int k = 0; k < kCandidates; ++k) {
      const std::optional<Root> root = drawIn(area, sower);
      if (!root) return roots;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Root& other : roots)
        nearest = std::min(nearest, (root->place - other.place).squaredNorm());
      if (nearest <= farthest) continue;
      farthest = nearest;
      best = *root;
    }
    roots.push_back(best);
  }
  return roots;
}

}  // namespace tumble
