#include "sim/collide/core.h"

#include <algorithm>
#include <cmath>

#include "sim/collide/ellipsoid.h"

namespace tumble::convex {
namespace {

// An axis that leans by less is along n but for rounding, and shows no point of the rim.
constexpr double kAlong = 4e-15;

Polyhedron makeUnitCube() {
  Polyhedron cube;
  for (int v = 0; v < 8; ++v)
    cube.points.emplace_back(v & 1 ? 1.0 : -1.0, v & 2 ? 1.0 : -1.0, v & 4 ? 1.0 : -1.0);
  const auto vertex = [](int k, int side, int next, int last) {
    return side << k | next << nextAxis(k) | last << lastAxis(k);
  };
  for (int k = 0; k < 3; ++k) {
    // Counter-clockwise seen from +k; the other way round on the other side.
    const int next[] = {0, 1, 1, 0}, last[] = {0, 0, 1, 1};
    for (const int side : {0, 1}) {
      std::vector<int>& face = cube.faces.emplace_back();
      for (int c = 0; c < 4; ++c) {
        const int turn = side == 1 ? c : 3 - c;
        face.push_back(vertex(k, side, next[turn], last[turn]));
      }
    }
  }
  findEdges(cube);
  // Edges in the order of their codes.
  std::vector<Polyhedron::Edge> edges(12);
  std::vector<int> place(12);
  for (std::size_t e = 0; e < 12; ++e) {
    const int p = cube.edges[e].from, difference = p ^ cube.edges[e].to;
    const int axis = difference == 1 ? 0 : difference == 2 ? 1 : 2;
    place[e] = 4 * axis + (p >> nextAxis(axis) & 1) + 2 * (p >> lastAxis(axis) & 1);
    edges[static_cast<std::size_t>(place[e])] = cube.edges[e];
  }
  cube.edges = edges;
  for (std::vector<int>& side : cube.sides)
    for (int& e : side) e = place[static_cast<std::size_t>(e)];
  return cube;
}

/// Turns and shifts points into the frame of b.
struct Frame {
  const Mat3& R;
  const Vec3& x;
  Vec3 operator()(const Vec3& p) const { return R * p + x; }
};

void build(const Sphere& s, const Frame& at, Core& core) {
  core.points.push_back(at.x);
  core.radius = s.r;
}

void build(const Capsule& c, const Frame& at, Core& core) {
  static const std::vector<Polyhedron::Edge> segment = {{0, 1, -1, -1}};
  const Vec3 half = 0.5 * c.h * at.R.col(1);
  core.radius = c.r;
  if (c.h == 0.0) {
    core.points.push_back(at.x);
    return;
  }
  core.points.push_back(at.x - half);
  core.points.push_back(at.x + half);
  core.edges = segment;
  core.size = 0.5 * c.h;
}

void build(const Cylinder& c, const Frame& at, Core& core) {
  const Vec3 half = 0.5 * c.h * at.R.col(1);
  core.points.push_back(at.x - half);
  core.points.push_back(at.x + half);
  core.disc = c.r;
  core.up = at.R.col(1);
  core.side = at.R.col(0);
  core.size = std::sqrt(c.r * c.r + 0.25 * c.h * c.h);
}

void build(const Ellipsoid& e, const Frame& at, Core& core) {
  core.points.push_back(at.x);
  core.half = e.half;
  core.axes = at.R;
  core.size = e.half.maxCoeff();
}

void build(const Box& box, const Frame& at, Core& core) {
  const Polyhedron& cube = unitCube();
  const Mat3 half = at.R * box.half.asDiagonal();
  for (const Vec3& p : cube.points) core.points.push_back(at.x + half * p);
  for (int k = 0; k < 3; ++k) {
    core.normals.push_back(-at.R.col(k));
    core.normals.push_back(at.R.col(k));
  }
  core.edges = cube.edges;
  core.faces = cube.faces;
  core.sides = cube.sides;
  core.size = box.half.norm();
}

void build(const Hull& hull, const Frame& at, Core& core) {
  const Polyhedron& solid = *hull.solid;
  core.middle.setZero();
  for (const Vec3& p : solid.points) {
    core.points.push_back(at(p - hull.origin));
    core.middle += core.points.back();
  }
  core.middle /= static_cast<double>(solid.points.size());
  for (const Vec3& p : core.points) core.size = std::max(core.size, (p - core.middle).norm());
  for (const Vec3& n : solid.normals) core.normals.push_back(at.R * n);
  core.edges = solid.edges;
  core.faces = solid.faces;
  core.sides = solid.sides;
}

template <class S>
void build(const S&, const Frame&, Core&) {}

}  // namespace

const Polyhedron& unitCube() {
  static const Polyhedron cube = makeUnitCube();
  return cube;
}

bool hasCore(const Shape& shape) {
  return std::holds_alternative<Sphere>(shape) || std::holds_alternative<Box>(shape) ||
         std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Capsule>(shape) ||
         std::holds_alternative<Hull>(shape) || std::holds_alternative<Ellipsoid>(shape);
}

Core coreOf(const Shape& shape, const Mat3& R, const Vec3& x) {
  Core core;
  core.middle = x;
  std::visit([&](const auto& solid) { build(solid, Frame{R, x}, core); }, shape);
  return core;
}

int outermostVertex(const Core& core, const Vec3& n) {
  int best = 0;
  double far = n.dot(core.points[0]);
  for (int k = 1; k < static_cast<int>(core.points.size()); ++k) {
    const double height = n.dot(core.points[k]);
    if (height > far) far = height, best = k;
  }
  return best;
}

Vec3 outermost(const Core& core, const Vec3& n, int& vertex) {
  if (core.isEllipsoid()) {
    vertex = -1;
    return core.points[0] + outermostOnEllipsoid(core.half, core.axes, n);
  }
  if (!core.isCylinder()) {
    vertex = outermostVertex(core, n);
    return core.points[vertex];
  }
  vertex = -1;
  const Vec3& u = core.axis();
  Vec3 across = n - n.dot(u) * u;
  across -= across.dot(u) * u;  // what is left of n along u may be all rounding
  const double length = across.norm();
  const Vec3& cap = core.points[n.dot(u) < 0.0 ? 0 : 1];
  return length > kAlong * n.norm() ? Vec3(cap + (core.disc / length) * across) : cap;
}

bool holds(const Core& core, const Vec3& p, double off) {
  const Vec3 d = p - core.middle;
  if (core.isEllipsoid()) {
    const Vec3 part = (core.axes.transpose() * d).cwiseQuotient(core.half);
    return part.norm() <= 1.0 + off / core.half.minCoeff();
  }
  if (core.isCylinder()) {
    const double along = d.dot(core.axis()), half = 0.5 * (core.points[1] - core.points[0]).norm();
    return std::abs(along) <= half + off && (d - along * core.axis()).norm() <= core.disc + off;
  }
  if (core.normals.empty()) {  // a segment, or a point
    const Vec3 &from = core.points.front(), way = core.points.back() - from;
    const double square = way.squaredNorm();
    const double t = square > 0.0 ? std::clamp(way.dot(p - from) / square, 0.0, 1.0) : 0.0;
    return (p - from - t * way).norm() <= off;
  }
  for (std::size_t f = 0; f < core.normals.size(); ++f)
    if (core.normals[f].dot(p - core.points[core.faces[f][0]]) > off) return false;
  return true;
}

double coreGap(const Core& a, const Core& b, const Vec3& n) {
  int vertex = 0;
  return n.dot(outermost(a, -n, vertex)) - n.dot(outermost(b, n, vertex));
}

}  // namespace tumble::convex
