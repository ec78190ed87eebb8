// Which bodies are as one: those that are near each other, and islands, which something joins now.
#include <algorithm>
#include <limits>
#include <numeric>

#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

/// How far [m] a body of these parts reaches along n from the world's origin.
double reachOf(std::span<const Convex> parts, const Vec3& x, const Quat& q, const Vec3& n) {
  const Vec3 own = q.conjugate() * n;
  double most = -std::numeric_limits<double>::infinity();
  for (const Convex& part : parts) most = std::max(most, own.dot(outermost(part.outline, own)));
  return n.dot(x) + most;
}

}  // namespace

void Stepping::partBodies() {
  work_.root.resize(state_.bodies.size());
  for (const int i : work_.active) work_.root[i] = i;
}

void Stepping::joinBodies(int a, int b) {
  const int world = static_cast<int>(state_.bodies.size());
  if (a == world || b == world || model_.fixed(a) || model_.fixed(b)) return;
  const int p = islandRoot(work_.root, a), q = islandRoot(work_.root, b);
  work_.root[std::max(p, q)] = std::min(p, q);
}

bool Stepping::mayMeet(std::size_t pair, double h, double strays) {
  const PairMemory& memory = memory_.pairs[pair];
  if (memory.seamed) return true;
  const auto [ib, ia] = state_.near[pair];
  if (memory.touches.empty() || model_.fixed(ia) || model_.fixed(ib)) return false;
  // Between two instants a turning body reaches no farther along n than at one of them, but for a
  // bulge of r (hω)²/8; and ω wanders by no more than hω² where nothing twists it, which moves the
  // surface by r (hω)²/2.
  double slack = tolerance_.touch + strays + 2.0 * gravity_ * h * h;
  for (const int i : {ia, ib})
    slack += (0.125 + 0.5) * h * h * state_.bodies[i].omega.squaredNorm() * model_.radius[i];
  const RigidBody &a = state_.bodies[ia], &b = state_.bodies[ib];
  const std::vector<Convex>&partsA = partsOf(ia), &partsB = partsOf(ib);
  const auto gapAfter = [&](const Vec3& n, double t) {
    const auto reach = [&](const std::vector<Convex>& parts, const RigidBody& body, const Vec3& m) {
      return reachOf(parts, body.x + t * body.v, rotated(body.q, t * body.omega), m);
    };
    return -reach(partsA, a, -n) - reach(partsB, b, n);
  };
  return std::none_of(memory.touches.begin(), memory.touches.end(), [&](const Touch& touch) {
    const Vec3& n = touch.contact.point.n;
    return gapAfter(n, 0.0) > slack && gapAfter(n, h) > slack;
  });
}

/// Bodies that may meet, and all that are near each other in a crowd.
void Stepping::joinNear(double h) {
  partBodies();
  for (std::size_t k = 0; k < state_.near.size(); ++k) {
    const auto [b, a] = state_.near[k];
    if (work_.dense[a] || work_.dense[b] || mayMeet(k, h)) joinBodies(a, b);
  }
}

/// Deals what joins bodies out to islands, in the order of their first links.
[[gnu::flatten]] void Stepping::groupLinks(double h) {
  const int count = static_cast<int>(state_.near.size() + work_.bonds.rows.size());
  const int world = static_cast<int>(state_.bodies.size());
  const auto joins = [&](Link link) {
    if (!isPair(link)) return true;
    const std::vector<Touch>& touches = memory_.pairs[link].touches;
    return std::any_of(touches.begin(), touches.end(),
                       [&](const Touch& touch) { return !flies(touch, h); });
  };
  const auto fixed = [&](int body) { return body == world || model_.fixed(body); };
  partBodies();
  if (bends()) joinBent();
  work_.island.assign(count, -1);
  for (Link link = 0; link < count; ++link) {
    if (!joins(link)) continue;
    const auto [b, a] = ends(link);
    joinBodies(a, b);
    work_.island[link] = fixed(a) ? b : a;
  }
  work_.number.resize(state_.bodies.size());
  for (const int i : work_.active) work_.number[i] = -1;
  work_.begin.assign(1, 0);
  for (int& island : work_.island) {
    if (island < 0) continue;
    int& number = work_.number[islandRoot(work_.root, island)];
    if (number < 0) {
      number = static_cast<int>(work_.begin.size()) - 1;
      work_.begin.push_back(0);
    }
    island = number;
    ++work_.begin[island + 1];
  }
  std::partial_sum(work_.begin.begin(), work_.begin.end(), work_.begin.begin());
  work_.order.resize(work_.begin.back());
  work_.place.assign(work_.begin.begin(), work_.begin.end());
  for (Link link = 0; link < count; ++link)
    if (work_.island[link] >= 0) work_.order[work_.place[work_.island[link]]++] = link;
}

}  // namespace tumble
