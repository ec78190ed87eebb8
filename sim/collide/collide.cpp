// Chapter 5, collide: convex solids by the table of pairs; compounds part by part.
#include "sim/collide/collide.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sim/collide/features.h"
#include "sim/collide/pair_table.h"
#include "sim/collide/part_planes.h"
#include "sim/collide/seam.h"

namespace tumble {

namespace {

bool isCompound(const Shape& a, const Shape& b) {
  return std::holds_alternative<Compound>(a) || std::holds_alternative<Compound>(b);
}

std::uint64_t featureOf(int i, int j) {
  return featurePair(inPart(static_cast<std::uint32_t>(i), 0),
                     inPart(static_cast<std::uint32_t>(j), 0));
}

bool partsCollide(const Shape& a, const Shape& b) {
  const std::vector<PosedPart> ofA = convexParts(a), ofB = convexParts(b);
  const auto meets = [&](const PosedPart& p) {
    return std::all_of(ofB.begin(), ofB.end(),
                       [&](const PosedPart& q) { return pairs::inTable(p.solid, q.solid); });
  };
  return !ofA.empty() && !ofB.empty() && std::all_of(ofA.begin(), ofA.end(), meets);
}

}  // namespace

bool canCollide(const Shape& a, const Shape& b) {
  return isCompound(a, b) ? partsCollide(a, b) : pairs::inTable(a, b);
}

double separation(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  if (!isCompound(a, b)) return pairs::separationOf(a, poseA, b, poseB);
  const PartView ofA(a, poseA), ofB(b, poseB);
  double least = std::numeric_limits<double>::infinity();
  forNearParts(ofA, ofB, least, [&](int i, int j) {
    least = std::min(least,
                     pairs::separationOf(ofA.solid(i), ofA.poseOf(i), ofB.solid(j), ofB.poseOf(j)));
  });
  return least;
}

ContactPoint separatingPlane(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  if (!isCompound(a, b)) return pairs::planeOf(a, poseA, b, poseB);
  const PartView ofA(a, poseA), ofB(b, poseB);
  ContactPoint nearest;
  nearest.separation = std::numeric_limits<double>::infinity();
  std::uint64_t first = ~std::uint64_t{0};
  forNearParts(ofA, ofB, nearest.separation, [&](int i, int j) {
    ContactPoint plane = pairs::planeOf(ofA.solid(i), ofA.poseOf(i), ofB.solid(j), ofB.poseOf(j));
    plane.feature |= featureOf(i, j);
    // Of planes as wide that of the first parts, in whatever order the tree brings them.
    if (plane.separation < nearest.separation ||
        (plane.separation == nearest.separation && featureOf(i, j) < first)) {
      nearest = plane;
      first = featureOf(i, j);
    }
  });
  return nearest;
}

namespace {

// How much deeper than the deepest pair of parts a contact of the solids is looked for.
constexpr double kDeeper = 10.0;
// What overlaps has gone past the feature that it met, by a few times as much as it is deep.
constexpr double kAside = 4.0;

using PairsOfParts = std::vector<std::pair<int, int>>;

void findAll(const PartView& a, const PartView& b, const PairsOfParts& pairs, const Sought& sought,
             Manifold& out) {
  for (const auto& [i, j] : pairs) {
    const std::size_t first = out.size();
    findExposed(a, i, b, j, sought, out);
    for (std::size_t k = first; k < out.size(); ++k) out[k].feature |= featureOf(i, j);
  }
}

// The contacts of pairs of parts that overlap, or are near, along seams alone. A pair that has none
// is left to those that cover it, unless all are.
void uncover(const PartView& a, const PartView& b, const PairsOfParts& covered,
             const PairsOfParts& beside, double margin, double deepest, Manifold& out) {
  findAll(a, b, covered, {margin, kDeeper * deepest, kAside * deepest, false}, out);
  findAll(a, b, beside, {margin, deepest, kAside * deepest, true}, out);
  if (deepest == 0.0 || !out.empty()) return;
  findAll(a, b, covered, {margin, std::numeric_limits<double>::infinity(), kAside * deepest, false},
          out);
}

// What a look at two bodies' parts leaves to do.
struct PartsLeft {
  PairsOfParts covered, beside;
  double deepest = 0.0;  ///< [m] overlap of parts
};

// Adds the points of one near pair of parts that are contacts of the solids. Returns whether parts
// had points at all.
bool collideTwo(const PartView& a, const PartView& b, std::pair<int, int> pair, double margin,
                Manifold& out, PartsLeft& left) {
  const auto [i, j] = pair;
  const std::size_t first = out.size();
  pairs::pointsOf(a.solid(i), a.poseOf(i), b.solid(j), b.poseOf(j), margin, out);
  const bool any = out.size() > first;
  for (std::size_t k = first; k < out.size(); ++k) {
    left.deepest = std::max(left.deepest, -out[k].separation);
    out[k].feature |= featureOf(i, j);
  }
  const Left rest = leaveCovered(a, i, b, j, first, out);
  if (rest != Left::Enough) (rest == Left::NotDeepest ? left.covered : left.beside).push_back(pair);
  return any;
}

void collideParts(const PartView& a, const PartView& b, double margin, Manifold& out,
                  std::vector<PartWitness>* known, PartLooks* looks) {
  // All keep their storage from call to call.
  thread_local PairsOfParts near;
  thread_local PartsLeft left;
  thread_local std::vector<PartWitness> held;
  thread_local PartLooks uncounted;
  near.clear();
  left.covered.clear();
  left.beside.clear();
  left.deepest = 0.0;
  PartPlanes planes(a, b, margin, held, looks ? *looks : uncounted);
  // A half-space needs no plane remembered: it is one.
  if (known && (a.plane() || b.plane())) known->clear(), known = nullptr;
  if (known) planes.keep(*known);
  forNearParts(
      a, b, margin, [&](int i, int j) { near.emplace_back(i, j); }, nullptr,
      [&](int i, int j) { return planes.keeps(i, j); });
  std::sort(near.begin(), near.end());
  for (const auto& pair : near) {
    const auto [i, j] = pair;
    if (planes.hasFound(i, j)) continue;
    if (looks) ++looks->tests;
    if (collideTwo(a, b, pair, margin, out, left) || !known) continue;
    const Pose poseA = a.poseOf(i), poseB = b.poseOf(j);
    planes.find(
        i, j, witnessOf(pairs::planeOf(a.solid(i), poseA, b.solid(j), poseB), a.pose(), b.pose()));
  }
  if (known) known->swap(held);
  uncover(a, b, left.covered, left.beside, margin, left.deepest, out);
  leaveBeside(a, b, out);
}

}  // namespace

void collide(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, double margin,
             Manifold& out) {
  out.clear();
  if (!isCompound(a, b)) return pairs::pointsOf(a, poseA, b, poseB, margin, out);
  collideParts(PartView(a, poseA), PartView(b, poseB), margin, out, nullptr, nullptr);
}

void collide(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, double margin,
             Manifold& out, std::vector<PartWitness>& known, PartLooks& looks) {
  out.clear();
  if (!isCompound(a, b)) return pairs::pointsOf(a, poseA, b, poseB, margin, out);
  collideParts(PartView(a, poseA), PartView(b, poseB), margin, out, &known, &looks);
}

}  // namespace tumble
