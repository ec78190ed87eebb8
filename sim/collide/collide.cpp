// Chapter 5, collide: convex solids by the table of pairs; compounds part by part.
#include "sim/collide/collide.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sim/collide/features.h"
#include "sim/collide/pair_table.h"
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

void collideParts(const PartView& a, const PartView& b, double margin, Manifold& out,
                  std::vector<PartWitness>* known, PartLooks* looks) {
  // All keep their storage from call to call.
  thread_local PairsOfParts near, covered, beside;
  thread_local std::vector<PartWitness> old;
  near.clear();
  forNearParts(a, b, margin, [&](int i, int j) { near.emplace_back(i, j); });
  std::sort(near.begin(), near.end());
  covered.clear();
  beside.clear();
  double deepest = 0.0;
  old.clear();
  if (known) old.swap(*known);
  auto before = old.begin();
  for (const auto& pair : near) {
    const auto [i, j] = pair;
    const Pose poseA = a.poseOf(i), poseB = b.poseOf(j);
    const Shape &solidA = a.solid(i), &solidB = b.solid(j);
    while (before != old.end() && std::pair(before->i, before->j) < pair) ++before;
    const bool seen = before != old.end() && std::pair(before->i, before->j) == pair;
    if (looks) ++looks->tests;
    if (seen && showsApart(before->plane, solidA, poseA, solidB, poseB, margin)) {
      ++looks->hits;
      known->push_back(*before);
      continue;
    }
    const std::size_t first = out.size();
    pairs::pointsOf(solidA, poseA, solidB, poseB, margin, out);
    if (known && out.size() == first)
      known->push_back(
          {i, j, witnessOf(pairs::planeOf(solidA, poseA, solidB, poseB), poseA, poseB)});
    for (std::size_t k = first; k < out.size(); ++k) {
      deepest = std::max(deepest, -out[k].separation);
      out[k].feature |= featureOf(i, j);
    }
    const Left left = leaveCovered(a, i, b, j, first, out);
    if (left != Left::Enough) (left == Left::NotDeepest ? covered : beside).push_back(pair);
  }
  uncover(a, b, covered, beside, margin, deepest, out);
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
