// Chapter 5, collide: the table of shape pairs, and how it is read in both orders.
#include "sim/collide/pair_table.h"

#include <array>
#include <limits>

#include "sim/collide/pairs.h"

namespace tumble::pairs {

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
constexpr std::size_t kCores[] = {indexOf<Sphere>(),  indexOf<Box>(),  indexOf<Cylinder>(),
                                  indexOf<Capsule>(), indexOf<Hull>(), indexOf<Ellipsoid>()};

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

}  // namespace

bool inTable(const Shape& a, const Shape& b) {
  return kLookup[a.index()][b.index()].row != nullptr;
}

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

void pointsOf(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, double margin,
              Manifold& out) {
  const Entry entry = kLookup[a.index()][b.index()];
  if (!entry.row) return;
  if (!entry.swapped) return entry.row->collide(a, poseA, b, poseB, margin, out);
  const std::size_t first = out.size();
  entry.row->collide(b, poseB, a, poseA, margin, out);
  for (std::size_t k = first; k < out.size(); ++k) mirror(out[k]);
}

}  // namespace tumble::pairs
