// Chapter 5, collide: the table of shape pairs, and how it is read in both orders.
#include "sim/collide/collide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/collide/features.h"
#include "sim/collide/pairs.h"
#include "sim/math/frames.h"

namespace tumble {

namespace {

constexpr std::size_t kKinds = std::variant_size_v<Shape>;

template <class Kind, std::size_t I = 0>
constexpr std::size_t indexOf() {
  if constexpr (std::is_same_v<Kind, std::variant_alternative_t<I, Shape>>) {
    return I;
  } else {
    return indexOf<Kind, I + 1>();
  }
}

struct PairRow {
  std::size_t kindA = 0, kindB = 0;
  double (*separation)(const Shape&, const Pose&, const Shape&, const Pose&);
  ContactPoint (*separatingPlane)(const Shape&, const Pose&, const Shape&, const Pose&);
  void (*collide)(const Shape&, const Pose&, const Shape&, const Pose&, double, Manifold&);
};

template <class A, class B>
constexpr PairRow row() {
  return {indexOf<A>(), indexOf<B>(),
          [](const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
            return pairs::separation(*std::get_if<A>(&a), poseA, *std::get_if<B>(&b), poseB);
          },
          [](const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
            return pairs::separatingPlane(*std::get_if<A>(&a), poseA, *std::get_if<B>(&b), poseB);
          },
          [](const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, double margin,
             Manifold& out) {
            pairs::collide(*std::get_if<A>(&a), poseA, *std::get_if<B>(&b), poseB, margin, out);
          }};
}

// All pairs. To add one: write sim/collide/<a>_<b>.cpp, declare it in pairs.h, add its row here.
constexpr PairRow kPairs[] = {
    row<Sphere, Sphere>(), row<Sphere, Box>(),    row<Sphere, HalfSpace>(),
    row<Box, Box>(),       row<Box, HalfSpace>(),
};

// Any two solids that have a core, and one of them against a half-space.
constexpr PairRow kConvex = {0, 0, pairs::convexSeparation, pairs::convexPlane,
                             pairs::convexCollide};
constexpr PairRow kConvexHalfSpace = {
    0, indexOf<HalfSpace>(),
    [](const Shape& a, const Pose& poseA, const Shape& b, const Pose&) {
      return pairs::convexSeparation(a, poseA, *std::get_if<HalfSpace>(&b));
    },
    [](const Shape& a, const Pose& poseA, const Shape& b, const Pose&) {
      return pairs::convexPlane(a, poseA, *std::get_if<HalfSpace>(&b));
    },
    [](const Shape& a, const Pose& poseA, const Shape& b, const Pose&, double margin,
       Manifold& out) {
      pairs::convexCollide(a, poseA, *std::get_if<HalfSpace>(&b), margin, out);
    }};
constexpr std::size_t kCores[] = {indexOf<Sphere>(), indexOf<Box>(), indexOf<Cylinder>(),
                                  indexOf<Capsule>(), indexOf<Hull>()};

struct Entry {
  const PairRow* row = nullptr;
  bool swapped = false;
};

constexpr std::array<std::array<Entry, kKinds>, kKinds> kLookup = [] {
  std::array<std::array<Entry, kKinds>, kKinds> lookup{};
  for (const std::size_t a : kCores) {
    for (const std::size_t b : kCores) lookup[a][b] = {&kConvex, false};
    lookup[a][indexOf<HalfSpace>()] = {&kConvexHalfSpace, false};
    lookup[indexOf<HalfSpace>()][a] = {&kConvexHalfSpace, true};
  }
  for (const PairRow& row : kPairs) {
    lookup[row.kindB][row.kindA] = {&row, true};
    lookup[row.kindA][row.kindB] = {&row, false};
  }
  return lookup;
}();

// One row of the table, read in the order of a and b.
double separationOf(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  const Entry entry = kLookup[a.index()][b.index()];
  if (!entry.row) return std::numeric_limits<double>::infinity();
  return entry.swapped ? entry.row->separation(b, poseB, a, poseA)
                       : entry.row->separation(a, poseA, b, poseB);
}

ContactPoint planeOf(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  const Entry entry = kLookup[a.index()][b.index()];
  ContactPoint plane;
  plane.separation = std::numeric_limits<double>::infinity();
  if (!entry.row) return plane;
  if (!entry.swapped) return entry.row->separatingPlane(a, poseA, b, poseB);
  plane = entry.row->separatingPlane(b, poseB, a, poseA);
  mirror(plane);
  return plane;
}

// Appends.
void pointsOf(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, double margin,
              Manifold& out) {
  const Entry entry = kLookup[a.index()][b.index()];
  if (!entry.row) return;
  if (!entry.swapped) return entry.row->collide(a, poseA, b, poseB, margin, out);
  const std::size_t first = out.size();
  entry.row->collide(b, poseB, a, poseA, margin, out);
  for (std::size_t k = first; k < out.size(); ++k) mirror(out[k]);
}

bool isCompound(const Shape& a, const Shape& b) {
  return std::holds_alternative<Compound>(a) || std::holds_alternative<Compound>(b);
}

// Calls visit(number, solid, pose) for each convex part of a shape.
template <class Visit>
void visitParts(const Shape& shape, const Pose& pose, Visit visit) {
  const Compound* compound = std::get_if<Compound>(&shape);
  if (!compound) return visit(0u, shape, pose);
  for (std::size_t k = 0; k < compound->parts.size(); ++k) {
    const Pose part = poseInBody(*compound, compound->parts[k]);
    visit(static_cast<std::uint32_t>(k), shapeOf(compound->parts[k]),
          Pose{toWorld(pose, part.x), (pose.q * part.q).normalized()});
  }
}

// A gap [m] that two parts have at least: that of the balls around them.
double ballGap(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  const double radii = boundingRadius(a) + boundingRadius(b);
  return std::isfinite(radii) ? (poseA.x - poseB.x).norm() - radii
                              : -std::numeric_limits<double>::infinity();
}

// Calls visit(feature of the parts, solid, pose, solid, pose) for each pair of parts whose balls
// are nearer than `reach` [m], which visit may shorten.
template <class Visit>
void visitPairs(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB,
                const double& reach, Visit visit) {
  visitParts(a, poseA, [&](std::uint32_t i, const Shape& solidA, const Pose& atA) {
    visitParts(b, poseB, [&](std::uint32_t j, const Shape& solidB, const Pose& atB) {
      if (ballGap(solidA, atA, solidB, atB) > reach) return;
      visit(featurePair(inPart(i, 0), inPart(j, 0)), solidA, atA, solidB, atB);
    });
  });
}

bool partsCollide(const Shape& a, const Shape& b) {
  bool all = true;
  visitParts(a, Pose{}, [&](std::uint32_t, const Shape& solidA, const Pose&) {
    visitParts(b, Pose{}, [&](std::uint32_t, const Shape& solidB, const Pose&) {
      all = all && kLookup[solidA.index()][solidB.index()].row;
    });
  });
  return all;
}

}  // namespace

bool canCollide(const Shape& a, const Shape& b) {
  return isCompound(a, b) ? partsCollide(a, b) : kLookup[a.index()][b.index()].row != nullptr;
}

double separation(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  if (!isCompound(a, b)) return separationOf(a, poseA, b, poseB);
  double least = std::numeric_limits<double>::infinity();
  visitPairs(
      a, poseA, b, poseB, least,
      [&](std::uint64_t, const Shape& solidA, const Pose& atA, const Shape& solidB,
          const Pose& atB) { least = std::min(least, separationOf(solidA, atA, solidB, atB)); });
  return least;
}

ContactPoint separatingPlane(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  if (!isCompound(a, b)) return planeOf(a, poseA, b, poseB);
  ContactPoint nearest;
  nearest.separation = std::numeric_limits<double>::infinity();
  visitPairs(a, poseA, b, poseB, nearest.separation,
             [&](std::uint64_t parts, const Shape& solidA, const Pose& atA, const Shape& solidB,
                 const Pose& atB) {
               ContactPoint plane = planeOf(solidA, atA, solidB, atB);
               plane.feature |= parts;
               if (plane.separation < nearest.separation) nearest = plane;
             });
  return nearest;
}

void collide(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, double margin,
             Manifold& out) {
  out.clear();
  if (!isCompound(a, b)) return pointsOf(a, poseA, b, poseB, margin, out);
  visitPairs(a, poseA, b, poseB, margin,
             [&](std::uint64_t parts, const Shape& solidA, const Pose& atA, const Shape& solidB,
                 const Pose& atB) {
               const std::size_t first = out.size();
               pointsOf(solidA, atA, solidB, atB, margin, out);
               for (std::size_t k = first; k < out.size(); ++k) out[k].feature |= parts;
             });
}

}  // namespace tumble
