#include "sim/shape/polyhedron.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "sim/math/orientation.h"
#include "sim/shape/crossings.h"
#include "sim/shape/shells.h"
#include "sim/shape/written.h"

namespace tumble {
namespace {

constexpr double kFlat = 1e-12;   // of a face's size: what rounding of its points may bend it by
constexpr double kBeside = 1e-4;  // of a length: six decimals move corners by less
constexpr double kFar = 1e60;     // m: fifth powers, as inertia tensors have, stay finite

std::string number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6);
  return {text, end.ptr};
}

std::string place(const std::vector<Vec3>& points, int i) {
  const Vec3& p = points[static_cast<std::size_t>(i)];
  return std::to_string(i + 1) + " (" + number(p.x()) + ", " + number(p.y()) + ", " +
         number(p.z()) + ")";
}

std::string edgeText(const std::vector<Vec3>& points, int from, int to) {
  return "the edge from point " + place(points, from) + " to point " + place(points, to);
}

const Vec3& at(const Polyhedron& solid, int i) {
  return solid.points[static_cast<std::size_t>(i)];
}

double sizeOf(const Polyhedron& solid, const std::vector<int>& face) {
  double size = 0.0;
  for (const int i : face) size = std::max(size, (at(solid, i) - at(solid, face[0])).norm());
  return size;
}

/// Corners exist, no edge has length zero, no face is without area.
void checkFaces(const Polyhedron& solid, const std::vector<Vec3>& given) {
  const int count = static_cast<int>(given.size());
  for (int f = 0; f < static_cast<int>(solid.faces.size()); ++f) {
    const std::vector<int>& face = solid.faces[static_cast<std::size_t>(f)];
    if (face.size() < 3) throw NotASolid("a face has fewer than three corners", f);
    for (const int i : face)
      if (i < 0 || i >= count)
        throw NotASolid(
            "a face names point " + std::to_string(i + 1) + " of " + std::to_string(count), f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int from = face[k], to = face[(k + 1) % face.size()];
      if (at(solid, from) == at(solid, to))
        throw NotASolid(edgeText(given, from, to) + " has no length", f);
    }
    const double size = sizeOf(solid, face);
    if (!(areaVector(solid, face).norm() > kFlat * size * size))
      throw NotASolid("a face has no area; it begins with " + edgeText(given, face[0], face[1]), f);
  }
}

/// Each edge is run through once in either direction.
void checkEdges(const Polyhedron& solid, const std::vector<Vec3>& given) {
  std::map<std::pair<int, int>, int> faceOf;
  for (int f = 0; f < static_cast<int>(solid.faces.size()); ++f) {
    const std::vector<int>& face = solid.faces[static_cast<std::size_t>(f)];
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int from = face[k], to = face[(k + 1) % face.size()];
      const auto [other, first] = faceOf.emplace(std::pair(from, to), f);
      if (!first)
        throw NotASolid(edgeText(given, from, to) + " is run through the same way by face " +
                            std::to_string(other->second + 1) + " and face " +
                            std::to_string(f + 1) +
                            "; one of them is inside out, or more than two faces meet there",
                        f);
    }
  }
  for (const auto& [edge, f] : faceOf)
    if (faceOf.count({edge.second, edge.first}) == 0)
      throw NotASolid(edgeText(given, edge.first, edge.second) +
                          " has a face on one side only; the surface is not closed",
                      f);
}

/// The surface holds a volume, and Σ p₀·(p₁ × p₂) over all its triangles is positive.
void checkVolume(const Polyhedron& solid, const std::vector<Vec3>& given) {
  const int side = sideOf(solid);
  if (side == 0)
    throw NotASolid("the surface holds no volume, or so little that it may be rounding alone", 0);
  if (side < 0)
    throw NotASolid(
        "the surface is inside out: " + edgeText(given, solid.faces[0][0], solid.faces[0][1]) +
            " and all others should run counter-clockwise about their faces, "
            "seen from outside",
        0);
}

bool isFlat(const Polyhedron& solid, const std::vector<int>& face) {
  if (face.size() == 3) return true;
  const Vec3 n = areaVector(solid, face).normalized();
  const double bent = kFlat * sizeOf(solid, face);
  return std::all_of(face.begin(), face.end(), [&](int i) {
    return std::abs(n.dot(at(solid, i) - at(solid, face[0]))) <= bent;
  });
}

/// Twice the area of a triangle in the plane seen along +axis, positive if counter-clockwise.
double turnOf(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
}

}  // namespace

Vec3 areaVector(const Polyhedron& solid, const std::vector<int>& face) {
  Vec3 sum = Vec3::Zero();
  const Vec3& p0 = at(solid, face[0]);
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    sum += twiceArea(p0, at(solid, face[k]), at(solid, face[k + 1]));
  return sum;
}

void findEdges(Polyhedron& solid) {
  solid.edges.clear();
  solid.normals.clear();
  solid.sides.clear();
  std::map<std::pair<int, int>, int> known;
  for (int f = 0; f < static_cast<int>(solid.faces.size()); ++f) {
    const std::vector<int>& face = solid.faces[static_cast<std::size_t>(f)];
    solid.normals.push_back(areaVector(solid, face).normalized());
    std::vector<int>& sides = solid.sides.emplace_back();
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int from = face[k], to = face[(k + 1) % face.size()];
      const auto twin = known.find({to, from});
      if (twin != known.end()) {
        solid.edges[static_cast<std::size_t>(twin->second)].right = f;
        sides.push_back(twin->second);
      } else {
        const int edge = static_cast<int>(solid.edges.size());
        known[{from, to}] = edge;
        solid.edges.push_back({from, to, f, f});
        sides.push_back(edge);
      }
    }
  }
}

void cutIntoTriangles(const Polyhedron& solid, const std::vector<int>& face,
                      std::vector<std::array<int, 3>>& triangles) {
  int axis = 0;
  const Vec3 n = areaVector(solid, face);
  n.cwiseAbs().maxCoeff(&axis);
  const double side = n[axis] < 0.0 ? -1.0 : 1.0;
  std::vector<int> left = face;
  // An ear is a convex corner whose triangle holds no other corner, nor one on the edge that it
  // leaves but for what rounding has moved, its own as little.
  const auto isEar = [&](std::size_t k, double beside) {
    const int a = left[(k + left.size() - 1) % left.size()], b = left[k],
              c = left[(k + 1) % left.size()];
    const auto turn = [&](int i, int j, int l) {
      return side * turnOf(at(solid, i), at(solid, j), at(solid, l), axis);
    };
    const double wide = beside * (at(solid, c) - at(solid, a)).squaredNorm();
    return turn(a, b, c) > wide && std::none_of(left.begin(), left.end(), [&](int p) {
             return p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 &&
                    turn(c, a, p) >= -wide;
           });
  };
  while (left.size() > 3) {
    std::size_t ear = left.size();
    for (const double beside : {kBeside, 0.0})
      for (std::size_t k = 0; k < left.size() && ear == left.size(); ++k)
        if (isEar(k, beside)) ear = k;
    if (ear == left.size()) ear = 1;  // without one, any will do
    triangles.push_back(
        {left[(ear + left.size() - 1) % left.size()], left[ear], left[(ear + 1) % left.size()]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({left[0], left[1], left[2]});
}

Polyhedron makePolyhedron(std::vector<Vec3> points, std::vector<std::vector<int>> faces) {
  return makeWritten(std::move(points), std::move(faces), 0.0);
}

Polyhedron makeWritten(std::vector<Vec3> given, std::vector<std::vector<int>> faces, double grain) {
  if (faces.empty()) throw NotASolid("there are no faces", -1);
  for (std::size_t i = 0; i < given.size(); ++i)
    if (!given[i].allFinite())
      throw NotASolid("point " + std::to_string(i + 1) + " is not finite", -1);
  Polyhedron solid{given, std::move(faces)};
  for (Vec3& p : solid.points) {
    p -= given[0];
    if (!(p.cwiseAbs().maxCoeff() < kFar))
      throw NotASolid("the points are too far apart: 1e60 m or more", -1);
  }
  checkFaces(solid, given);
  checkEdges(solid, given);
  // Two faces that were one are each off by up to half a digit along each axis.
  double size = 0.0;
  for (const Vec3& p : solid.points) size = std::max(size, p.norm());
  const double touch = grain > kShape * size ? 0.0 : 2.0 * grain;
  checkShells(solid, touch);  // first: it names the shell that is inside out
  checkCrossings(solid, touch);

  std::vector<std::vector<int>> flat;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    std::vector<int>& face = solid.faces[f];
    if (isFlat(solid, face)) {
      flat.push_back(std::move(face));
      continue;
    }
    std::vector<std::array<int, 3>> triangles;
    cutIntoTriangles(solid, face, triangles);
    for (const auto& [a, b, c] : triangles) {
      flat.push_back({a, b, c});
      if (areaVector(solid, flat.back()).isZero(0.0))
        throw NotASolid(
            "face " + std::to_string(f + 1) +
                " is not flat, and one of the triangles that it is cut into has no area",
            static_cast<int>(f));
    }
  }
  solid.faces = std::move(flat);
  checkVolume(solid, given);  // a face that is bent holds what its triangles hold
  findEdges(solid);
  return solid;
}

}  // namespace tumble
