#include "sim/shape/shells.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "sim/shape/interior.h"

namespace tumble {
namespace {

constexpr double kThin = 1e-12;         // of size × area: a volume below it may be rounding alone
constexpr double kUnder = 1e-4;         // of a triangle's width: how far inside a shell is tried
constexpr std::size_t kMostTried = 16;  // triangles of a shell, four points each

/// A closed surface as a solid of its own; `side` is −1 if it is inside out, 0 without volume.
struct Shell {
  int face = 0;  ///< the first, in the whole surface
  std::shared_ptr<const Polyhedron> solid;
  std::unique_ptr<const Shape> shape;
  std::unique_ptr<const Interior> interior;
  std::vector<std::array<int, 3>> triangles;
  double side = 1.0;
  Aabb box;
  int depth = 0;    ///< shells around it
  int around = -1;  ///< one of them
};

/// For each point the least point that it hangs together with.
std::vector<int> piecesOf(const Polyhedron& solid) {
  std::vector<int> up(solid.points.size());
  std::iota(up.begin(), up.end(), 0);
  const auto root = [&](int i) {
    const auto at = [&](int k) -> int& { return up[static_cast<std::size_t>(k)]; };
    while (at(i) != i) i = at(i) = at(at(i));
    return i;
  };
  for (const std::vector<int>& face : solid.faces)
    for (const int i : face) {
      const int a = root(face[0]), b = root(i);
      up[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  for (int& i : up) i = root(i);
  return up;
}

void complete(Shell& shell, Polyhedron&& solid) {
  shell.side = sideOf(solid);
  for (const std::vector<int>& face : solid.faces) cutIntoTriangles(solid, face, shell.triangles);
  shell.solid = std::make_shared<const Polyhedron>(std::move(solid));
  shell.shape = std::make_unique<const Shape>(Mesh{shell.solid, Vec3::Zero()});
  shell.interior = std::make_unique<const Interior>(*shell.shape);
  shell.box = boxAsGiven(*shell.shape);
}

/// The shells of a surface, in the order of their first faces.
std::vector<Shell> shellsOf(const Polyhedron& solid) {
  const std::vector<int> piece = piecesOf(solid);
  std::vector<int> shellOf(solid.points.size(), -1), index(solid.points.size(), -1);
  std::vector<Polyhedron> parts;
  std::vector<Shell> shells;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    int& s = shellOf[static_cast<std::size_t>(piece[static_cast<std::size_t>(solid.faces[f][0])])];
    if (s < 0) {
      s = static_cast<int>(parts.size());
      parts.emplace_back();
      shells.emplace_back().face = static_cast<int>(f);
    }
    Polyhedron& part = parts[static_cast<std::size_t>(s)];
    std::vector<int>& face = part.faces.emplace_back();
    for (const int i : solid.faces[f]) {
      int& own = index[static_cast<std::size_t>(i)];
      if (own < 0) {
        own = static_cast<int>(part.points.size());
        part.points.push_back(solid.points[static_cast<std::size_t>(i)]);
      }
      face.push_back(own);
    }
  }
  for (std::size_t s = 0; s < shells.size(); ++s) complete(shells[s], std::move(parts[s]));
  return shells;
}

/// Points just inside a shell: under the middle and near the corners of triangles that reach into
/// a box.
std::vector<Vec3> pointsUnder(const Shell& shell, const Aabb& box, double touch) {
  std::vector<std::array<int, 3>> near;
  const auto corner = [&](int i) { return shell.solid->points[static_cast<std::size_t>(i)]; };
  for (const auto& t : shell.triangles) {
    const Vec3 a = corner(t[0]), b = corner(t[1]), c = corner(t[2]);
    if (box.overlaps({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)})) near.push_back(t);
  }
  std::vector<Vec3> points;
  const std::size_t count = std::min(kMostTried, near.size());
  for (std::size_t k = 0; k < count; ++k) {
    const auto& t = near[k * near.size() / count];
    const Vec3 a = corner(t[0]), b = corner(t[1]), c = corner(t[2]), middle = (a + b + c) / 3.0;
    const Vec3 n = shell.side * (b - a).cross(c - a);
    const double length = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (!(n.norm() > 0.0)) continue;
    const Vec3 under = middle - std::max(kUnder / length, touch / n.norm()) * n;
    points.push_back(under);
    for (const Vec3& p : {a, b, c}) points.push_back(under + 0.98 * (p - middle));
  }
  return points;
}

enum class Place { Outside, Inside, Both };

/// Where shell a lies with respect to shell b.
Place placeOf(const Shell& a, const Shell& b, double touch) {
  // What reaches beyond b's box, by more than touching, is not inside b.
  const double slack = std::max(touch, kUnder * (b.box.hi - b.box.lo).maxCoeff());
  bool inside = false, outside = (a.box.lo.array() < b.box.lo.array() - slack).any() ||
                                 (a.box.hi.array() > b.box.hi.array() + slack).any();
  for (const Vec3& p : pointsUnder(a, b.box, touch))
    if (a.interior->contains(p)) (b.interior->contains(p) ? inside : outside) = true;
  return !inside ? Place::Outside : outside ? Place::Both : Place::Inside;
}

std::string name(const Shell& shell, const Polyhedron& solid) {
  const int point = solid.faces[static_cast<std::size_t>(shell.face)][0];
  return "the shell of face " + std::to_string(shell.face + 1) + " at point " +
         std::to_string(point + 1);
}

/// Finds which of two shells is around the other, if either is.
void nest(Shell& a, Shell& b, const Polyhedron& solid, double touch) {
  const Place ofA = placeOf(a, b, touch), ofB = placeOf(b, a, touch);
  if (ofA == Place::Outside && ofB == Place::Outside) return;
  if ((ofA == Place::Inside) == (ofB == Place::Inside)) {
    const Shell &one = a.face < b.face ? a : b, &two = a.face < b.face ? b : a;
    throw NotASolid(name(two, solid) + " overlaps " + name(one, solid) +
                        "; what they share would be counted twice",
                    two.face);
  }
  Shell &inner = ofA == Place::Inside ? a : b, &outer = ofA == Place::Inside ? b : a;
  ++inner.depth;
  inner.around = outer.face;
}

void checkSide(const Shell& shell, const Polyhedron& solid) {
  const bool cavity = shell.depth % 2 == 1;
  if (cavity == (shell.side < 0.0)) return;
  const std::string why =
      cavity ? " lies inside the shell of face " + std::to_string(shell.around + 1) +
                   " and is counted twice; the faces of a cavity run the other way round"
      : shell.depth == 0 ? " is inside out, and no other is around it"
                         : " is inside out, and so is the cavity around it";
  throw NotASolid(name(shell, solid) + why, shell.face);
}

}  // namespace

int sideOf(const Polyhedron& solid) {
  double sum = 0.0, area = 0.0, size = 0.0;
  const auto from0 = [&](int i) -> Vec3 {
    return solid.points[static_cast<std::size_t>(i)] - solid.points[0];
  };
  for (const std::vector<int>& face : solid.faces) {
    const Vec3 n = areaVector(solid, face);
    sum += from0(face[0]).dot(n);
    area += n.norm();
    for (const int i : face) size = std::max(size, from0(i).norm());
  }
  return !(std::abs(sum) > kThin * size * area) ? 0 : sum > 0.0 ? 1 : -1;
}

void checkShells(const Polyhedron& solid, double touch) {
  std::vector<Shell> shells = shellsOf(solid);
  if (shells.size() < 2) return;
  for (const Shell& shell : shells)
    if (shell.side == 0.0)
      throw NotASolid(
          name(shell, solid) + " holds no volume, or so little that it may be rounding alone",
          shell.face);
  // Only shells whose boxes meet can share anything: a sweep along x finds those.
  std::vector<Shell*> order;
  for (Shell& shell : shells) order.push_back(&shell);
  std::sort(order.begin(), order.end(),
            [](const Shell* a, const Shell* b) { return a->box.lo.x() < b->box.lo.x(); });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      if (order[k]->box.lo.x() > order[i]->box.hi.x()) break;
      if (order[k]->box.overlaps(order[i]->box)) nest(*order[i], *order[k], solid, touch);
    }
  for (const Shell& shell : shells) checkSide(shell, solid);
}

}  // namespace tumble
