// Chapter 5, collide: the table of shape pairs, and how it is read in both orders.
#include "sim/collide/collide.h"

#include <array>
#include <limits>
#include <utility>

#include "sim/collide/features.h"
#include "sim/collide/pairs.h"

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
  std::size_t kindA, kindB;
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

struct Entry {
  const PairRow* row = nullptr;
  bool swapped = false;
};

constexpr std::array<std::array<Entry, kKinds>, kKinds> kLookup = [] {
  std::array<std::array<Entry, kKinds>, kKinds> lookup{};
  for (const PairRow& row : kPairs) {
    lookup[row.kindB][row.kindA] = {&row, true};
    lookup[row.kindA][row.kindB] = {&row, false};
  }
  return lookup;
}();

NormalTie mirrored(NormalTie tie) {
  switch (tie) {
    case NormalTie::FaceOfA:
      return NormalTie::FaceOfB;
    case NormalTie::FaceOfB:
      return NormalTie::FaceOfA;
    case NormalTie::EdgeOfA:
      return NormalTie::EdgeOfB;
    case NormalTie::EdgeOfB:
      return NormalTie::EdgeOfA;
    default:
      return tie;
  }
}

// The same contact seen with a and b exchanged.
void mirror(ContactPoint& c) {
  c.n = -c.n;
  c.tie = mirrored(c.tie);
  c.feature = swappedFeature(c.feature);
  std::swap(c.pa, c.pb);
  std::swap(c.ra, c.rb);
  std::swap(c.ea, c.eb);
}

}  // namespace

bool canCollide(const Shape& a, const Shape& b) {
  return kLookup[a.index()][b.index()].row != nullptr;
}

double separation(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  const Entry entry = kLookup[a.index()][b.index()];
  if (!entry.row) return std::numeric_limits<double>::infinity();
  return entry.swapped ? entry.row->separation(b, poseB, a, poseA)
                       : entry.row->separation(a, poseA, b, poseB);
}

ContactPoint separatingPlane(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  const Entry entry = kLookup[a.index()][b.index()];
  ContactPoint plane;
  plane.separation = std::numeric_limits<double>::infinity();
  if (!entry.row) return plane;
  if (!entry.swapped) return entry.row->separatingPlane(a, poseA, b, poseB);
  plane = entry.row->separatingPlane(b, poseB, a, poseA);
  mirror(plane);
  return plane;
}

void collide(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, double margin,
             Manifold& out) {
  out.clear();
  const Entry entry = kLookup[a.index()][b.index()];
  if (!entry.row) return;
  if (entry.swapped) {
    entry.row->collide(b, poseB, a, poseA, margin, out);
    for (ContactPoint& c : out) mirror(c);
  } else {
    entry.row->collide(a, poseA, b, poseB, margin, out);
  }
}

}  // namespace tumble
