#include "sim/collide/part_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/math/frames.h"

namespace tumble {
namespace {

const BoxTree::Node& nodeOf(const PartView& view, int i) {
  return view.tree().nodes()[static_cast<std::size_t>(i)];
}

// How far [m] the parts below a box reach above the body's origin along n, world frame.
double reachBelow(const PartView& view, int i, const Vec3& n) {
  const Vec3 n_B = view.pose().q.conjugate() * n;
  if (!view.parts()) return reachAlong(view.solid(0), n_B);
  double far = -std::numeric_limits<double>::infinity();
  for (int k = i; k < nodeOf(view, i).past; ++k) {
    const int part = nodeOf(view, k).item;
    if (part < 0) continue;
    const Pose& own = view.parts()->list[static_cast<std::size_t>(part)].pose;
    far = std::max(far, n_B.dot(own.x) + reachAlong(view.solid(part), own.q.conjugate() * n_B));
  }
  return far;
}

// Half the diagonal [m] of the box, about whose middle all below it lies.
double radiusOf(const PartView& view, int i) {
  const Aabb& box = nodeOf(view, i).box;
  return 0.5 * (box.hi - box.lo).norm();
}

}  // namespace

bool PartPlanes::isNear(int i, int j) const {
  return gapOf(nodeOf(a_, i).box, nodeOf(b_, j).box, seat_) <= margin_;
}

bool PartPlanes::parts(int i, int j, const Witness& plane) const {
  // Manifolds take what lies on a side to 1e-9 of the size, and are rounded themselves.
  constexpr double kSlack = 1e-8;
  const Vec3 n = normalOf(plane, a_.pose().q, b_.pose().q), way = a_.pose().x - b_.pose().x;
  const double gap = n.dot(way) - reachBelow(a_, i, -n) - reachBelow(b_, j, n);
  return gap > margin_ + kSlack * (radiusOf(a_, i) + radiusOf(b_, j) + way.norm());
}

void PartPlanes::ask(int i, int j, const Witness& plane) {
  ++looks_.tests;
  if (parts(i, j, plane)) {
    ++looks_.hits;
    held_.push_back({i, j, plane});
    return;
  }
  const BoxTree::Node &p = nodeOf(a_, i), &q = nodeOf(b_, j);
  if (p.item >= 0 && q.item >= 0) return;
  const bool openA = opensFirst(p, q);
  for (const int child : {openA ? p.first : q.first, openA ? p.last : q.last}) {
    const int u = openA ? child : i, v = openA ? j : child;
    if (isNear(u, v)) ask(u, v, plane);
  }
}

void PartPlanes::keep(std::span<const PartWitness> known) {
  for (const PartWitness& w : known)
    if (w.plane.known && isNear(w.i, w.j)) ask(w.i, w.j, w.plane);
  std::sort(held_.begin(), held_.end(), [](const PartWitness& v, const PartWitness& w) {
    return std::pair(v.i, v.j) < std::pair(w.i, w.j);
  });
  kept_ = held_.size();
}

bool PartPlanes::keeps(int i, int j) const {
  const auto end = held_.begin() + static_cast<std::ptrdiff_t>(kept_);
  const auto at = std::lower_bound(held_.begin(), end, std::pair(i, j),
                                   [](const PartWitness& w, const std::pair<int, int>& pair) {
                                     return std::pair(w.i, w.j) < pair;
                                   });
  return at != end && at->i == i && at->j == j;
}

bool PartPlanes::isUnder(const PartWitness& w, int i, int j) const {
  return w.i <= i && i < nodeOf(a_, w.i).past && w.j <= j && j < nodeOf(b_, w.j).past;
}

bool PartPlanes::hasFound(int partA, int partB) const {
  const int i = a_.leafOf(partA), j = b_.leafOf(partB);
  return std::any_of(held_.begin() + static_cast<std::ptrdiff_t>(kept_), held_.end(),
                     [&](const PartWitness& w) { return isUnder(w, i, j); });
}

// The pair of boxes that a descent comes from: of the two above, it opened the smaller one last.
PartWitness PartPlanes::above(int i, int j, const Witness& plane) const {
  const int upA = nodeOf(a_, i).parent, upB = nodeOf(b_, j).parent;
  if (upA < 0 || (upB >= 0 && opensFirst(nodeOf(a_, upA), nodeOf(b_, upB)))) return {i, upB, plane};
  return {upA, j, plane};
}

void PartPlanes::find(int partA, int partB, const Witness& plane) {
  PartWitness found{a_.leafOf(partA), b_.leafOf(partB), plane};
  if (plane.known)
    while (nodeOf(a_, found.i).parent >= 0 || nodeOf(b_, found.j).parent >= 0) {
      const PartWitness higher = above(found.i, found.j, plane);
      if (!parts(higher.i, higher.j, plane)) break;
      found = higher;
    }
  // It answers for those below it.
  const auto isBelow = [&](const PartWitness& w) { return isUnder(found, w.i, w.j); };
  const auto kept = held_.begin() + static_cast<std::ptrdiff_t>(kept_);
  kept_ -= static_cast<std::size_t>(std::count_if(held_.begin(), kept, isBelow));
  std::erase_if(held_, isBelow);
  held_.push_back(found);
}

}  // namespace tumble
