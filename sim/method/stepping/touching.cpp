// Which pairs are near, and where they touch: looked at anew only where a body has moved.
#include <algorithm>
#include <cmath>

#include "sim/collide/collide.h"
#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

/// Whether a body has a pose but for rounding.
bool isAt(const Pose& pose, const RigidBody& body, double rounding) {
  return (pose.x - body.x).lpNorm<Eigen::Infinity>() <= rounding &&
         (pose.q.coeffs() - body.q.coeffs()).lpNorm<Eigen::Infinity>() <= kPoseRounding;
}

/// The least power of two that is no less.
double powerAbove(double x) {
  const double below = std::ldexp(1.0, std::ilogb(x));
  return below < x ? 2.0 * below : below;
}

/// Whether two levers are one but for rounding.
bool isSame(const Lever& p, const Lever& q, double rounding) {
  const auto near = [](const Vec3& x, const Vec3& y, double within) {
    return (x - y).lpNorm<Eigen::Infinity>() <= within;
  };
  return near(p.n, q.n, kPoseRounding) && near(p.armA, q.armA, rounding) &&
         near(p.armB, q.armB, rounding) && std::abs(p.separation - q.separation) <= rounding;
}

}  // namespace

void Stepping::findTouching(double h) {
  if (findNear(h) && stopAtUnknownPair(model_, state_.near, report_)) return;
  lookAtAll(h);
}

void Stepping::lookAtAll(double h) {
  const StageScope stage(state_.times, StepStage::Points);
  for (std::size_t k = 0; k < state_.near.size(); ++k) look(k, marginOf(k, h));
  leaveSeams();
}

bool Stepping::findNear(double h) {
  const StageScope stage(state_.times, StepStage::Pairs);
  if (parted_) {  // what stays in its box meets nobody new
    for (const int k : work_.solids) {
      const int i = model_.solid[k];
      work_.after[i] << state_.bodies[i].v, state_.bodies[i].omega;
      work_.touched[i] = 1;
    }
    return growBoxes(h, true) && takePairs();
  }
  sweptBoxes(model_, state_.bodies, h, gravity_, tolerance_.touch, work_.boxes);
  return takePairs();
}

bool Stepping::takePairs() {
  state_.broadPhase.update(work_.boxes, model_.solidBends);
  work_.near.clear();
  for (const auto& [i, j] : state_.broadPhase.pairs()) {
    const int b = model_.solid[i], a = model_.solid[j];
    if (!model_.mayTouch(a, b)) continue;
    if (parted_ && !(isActive(a) && isActive(b)) && !(isActive(a) && model_.fixed(b)) &&
        !(isActive(b) && model_.fixed(a)))
      continue;
    work_.near.emplace_back(b, a);
  }
  if (work_.near == state_.near && memory_.pairs.size() == work_.near.size()) return false;

  // What is known of pairs that stay goes with them. Both lists are sorted.
  work_.passed.clear();
  work_.passed.resize(work_.near.size());
  std::vector<PairWitness> witnesses(work_.near.size());
  std::size_t old = 0;
  for (std::size_t k = 0; k < work_.near.size(); ++k) {
    while (old < memory_.pairs.size() && state_.near[old] < work_.near[k]) ++old;
    if (old == memory_.pairs.size() || state_.near[old] != work_.near[k]) continue;
    work_.passed[k] = std::move(memory_.pairs[old]);
    witnesses[k] = std::move(state_.witnesses[old]);
  }
  std::swap(state_.near, work_.near);
  std::swap(memory_.pairs, work_.passed);
  std::swap(state_.witnesses, witnesses);
  return true;
}

/// As far [m] as the two surfaces can come towards each other within the step, and no less than
/// what the projection wants to see; rounded up to a power of two, so that it seldom changes.
[[gnu::flatten]] double Stepping::marginOf(std::size_t pair, double h) const {
  const auto [ib, ia] = state_.near[pair];
  const RigidBody &b = state_.bodies[ib], &a = state_.bodies[ia];
  double speed = (a.v - b.v).norm();
  for (int i : {ib, ia})
    if (std::isfinite(model_.radius[i])) speed += state_.bodies[i].omega.norm() * model_.radius[i];
  if (passes(pair, a.v - b.v, h)) speed = 0.0;
  return powerAbove(marginFor(speed, h));
}

bool Stepping::passes(std::size_t pair, const Vec3& v, double h) const {
  constexpr double kTurns = 0.25;  // [rad] less than that, and its plane stands for the solid
  const auto [ib, ia] = state_.near[pair];
  if (!model_.bends(ia) && !model_.bends(ib)) return false;
  const int point = model_.bends(ia) ? ia : ib, other = point == ia ? ib : ia;
  const RigidBody& solid = state_.bodies[other];
  const Vec3 x = state_.bodies[point].x, way = (point == ia ? h : -h) * v;
  const double r = model_.radius[point], length = way.norm(), clear = marginFor(0.0, h);
  // No surface that far off a solid is rounder than a ball of that radius.
  if (!std::isfinite(model_.radius[other]) || length <= kTurns * (r + clear)) return false;
  const Shape& shape = model_.shapes[other];
  const auto planeAt = [&](const Vec3& at) {
    return separatingPlane(Sphere{r}, {at, Quat::Identity()}, shape, solid.pose());
  };
  const double turn = h * solid.omega.norm() * model_.radius[other];
  const ContactPoint before = planeAt(x);
  if (before.separation > length + turn + clear) return false;  // there is no row
  if ((planeAt(x + way).n - before.n).norm() <= kTurns) return false;
  const Pose middle{x + 0.5 * way, Quat::FromTwoVectors(Vec3::UnitY(), way)};
  return separation(Capsule{r, length}, middle, shape, solid.pose()) > turn + clear;
}

double Stepping::marginFor(double speed, double h) const {
  constexpr double kNeighbour = 1e-4;  // [m] in worlds that are not small
  const double neighbour = kNeighbour * std::min(1.0, ContactTolerance::scaleOf(model_.size));
  return std::max(neighbour, h * speed + 2.0 * gravity_ * h * h + tolerance_.touch);
}

bool Stepping::growBoxes(double h, bool fall) {
  const double bend = gravity_ * h * h;
  bool grew = false;
  for (const int k : work_.solids) {
    const int i = model_.solid[k];
    if (!work_.touched[i]) continue;
    const Vec3 v = work_.after[i].head<3>(), omega = work_.after[i].tail<3>();
    const auto box = [&](double margin) {
      return sweptBox(model_, i, state_.bodies[i], v, omega, h, margin);
    };
    Aabb& known = work_.boxes[k];
    const Aabb needed = box(tolerance_.touch + (fall ? bend : 0.0));
    if ((needed.lo - known.lo).minCoeff() >= 0.0 && (known.hi - needed.hi).minCoeff() >= 0.0)
      continue;
    const Aabb wide = box(tolerance_.touch + bend);
    known.lo = known.lo.cwiseMin(wide.lo);
    known.hi = known.hi.cwiseMax(wide.hi);
    grew = true;
  }
  return grew;
}

/// What drives a body alone takes it along a parabola, but for terms in h³; and that is how a whole
/// falls.
Vec6 Stepping::twistAhead(int i) const {
  if (work_.flown[i]) return 0.5 * (work_.before[i] + work_.after[i]);
  Vec6 twist = work_.after[i];
  twist.head<3>() -= work_.falls[i];
  return twist;
}

double Stepping::gapBeside(const ContactPoint& c, std::pair<int, int> pair, const Vec6& va,
                           const Vec6& vb, double h) const {
  const Quat byA = rotated(Quat::Identity(), h * va.tail<3>()),
             byB = rotated(Quat::Identity(), h * vb.tail<3>());
  const auto moved = [&](int i, const Vec6& v, const Quat& by, const Vec3& p) {
    const Vec3 arm = p - state_.bodies[i].x;
    return Vec3(p + h * v.head<3>() + (by * arm - arm));
  };
  const Vec3 way = moved(pair.second, va, byA, c.pa) - moved(pair.first, vb, byB, c.pb);
  const Vec3 e = c.tie == NormalTie::EdgeOfB ? byB * c.eb : byA * c.ea;
  const Vec3 apart = way - way.dot(e) * e;
  return std::copysign(apart.norm(), apart.dot(c.n)) - c.ra - c.rb;
}

/// The gap [m] of a point h seconds from now.
double Stepping::gapAhead(const ContactPoint& c, std::pair<int, int> pair, double h) const {
  const auto [ib, ia] = pair;
  const Vec6 va = twistAhead(ia), vb = twistAhead(ib);
  if (c.beside) return gapBeside(c, pair, va, vb, h);
  const Vec3 rate = va.head<3>() + va.tail<3>().cross(c.p - state_.bodies[ia].x) - vb.head<3>() -
                    vb.tail<3>().cross(c.p - state_.bodies[ib].x);
  return c.separation + h * c.n.dot(rate);
}

/// As marginOf, at the velocities after the step; < 0 of a pair that neither contacts nor a chain
/// move, or that is not foreseen.
double Stepping::marginAhead(std::size_t pair, double h) const {
  const auto [ib, ia] = state_.near[pair];
  if (findsInside(pair) || (!work_.touched[ia] && !work_.touched[ib] && !isFree(ia) && !isFree(ib)))
    return -1.0;
  const Vec6 va = twistAhead(ia), vb = twistAhead(ib);
  double speed = (va - vb).head<3>().norm();
  if (std::isfinite(model_.radius[ia])) speed += va.tail<3>().norm() * model_.radius[ia];
  if (std::isfinite(model_.radius[ib])) speed += vb.tail<3>().norm() * model_.radius[ib];
  if (passes(pair, (va - vb).head<3>(), h)) speed = 0.0;
  return marginFor(speed, h);
}

/// Whether a pair has points that are not in the problem, and would overlap by more than is left
/// open anyway. What is known of the pair stays.
bool Stepping::meetsUnknown(std::size_t k, double h) {
  const double margin = marginAhead(k, h);
  if (margin < 0.0) return false;
  const std::vector<Touch>& known = memory_.pairs[k].touches;
  const auto overlaps = [&](const ContactPoint& c) {
    return gapAhead(c, state_.near[k], h) < -mayOverlap();
  };
  const auto isNew = [&](const ContactPoint& c) {
    return std::none_of(known.begin(), known.end(), [&](const Touch& touch) {
      return touch.contact.point.feature == c.feature;
    });
  };
  if (margin > memory_.pairs[k].margin) {
    findNearPoints(model_, state_, k, powerAbove(margin), work_.found, report_);
    if (std::any_of(work_.found.begin(), work_.found.end(),
                    [&](const ContactPoint& c) { return overlaps(c) && isNew(c); }))
      return true;
  }
  return std::any_of(known.begin(), known.end(), [&](const Touch& touch) {
    return (isAside(touch) || flies(touch, h)) && overlaps(touch.contact.point);
  });
}

/// Whether a pair has points that are not in the problem, and would overlap.
bool Stepping::lookFurther(std::size_t k, double h) {
  const double margin = marginAhead(k, h);
  if (margin < 0.0) return false;
  const auto [ib, ia] = state_.near[k];
  PairMemory& memory = memory_.pairs[k];
  if (margin > memory.margin) {
    const long before = memory.form;
    look(k, powerAbove(margin));
    if (memory.form != before) return !memory.touches.empty();
  }
  bool meets = false;
  for (Touch& touch : memory.touches) {
    const bool aside = isAside(touch);
    if (!flies(touch, h) && !aside) continue;
    const double left = aside ? mayOverlap() : tolerance_.drift;
    if (gapAhead(touch.contact.point, state_.near[k], h) >= -left) continue;
    if (aside)
      touch.due = 0.0;
    else
      hold(touch.contact);
    touchChain(ia);
    touchChain(ib);
    meets = true;
  }
  return meets;
}

bool Stepping::seeFurther(double h) {
  const StageScope stage(state_.times, StepStage::Points);
  if (growBoxes(h, false) && takePairs() && stopAtUnknownPair(model_, state_.near, report_))
    return false;
  const std::size_t count = state_.near.size();
  if (isDrafted()) {  // solved again only where something would overlap
    std::size_t k = 0;
    while (k < count && !meetsUnknown(k, h)) ++k;
    if (k == count) return false;
  }
  bool meets = false;
  for (std::size_t k = 0; k < count; ++k) meets = lookFurther(k, h) || meets;
  if (meets) leaveSeams();
  return meets;
}

[[gnu::flatten]] void Stepping::look(std::size_t pair, double margin) {
  PairMemory& memory = memory_.pairs[pair];
  const auto [ib, ia] = state_.near[pair];
  const RigidBody &a = state_.bodies[ia], &b = state_.bodies[ib];
  if (memory.margin == margin && isAt(memory.poseA, a, roundingAt(a.x)) &&
      isAt(memory.poseB, b, roundingAt(b.x)))
    return;
  findNearPoints(model_, state_, pair, margin, work_.found, report_);
  if (findsInside(pair)) leaveUnmet(memory);
  const bool hadNone = memory.touches.empty() && memory.margin >= 0.0;
  memory.poseA = a.pose();
  memory.poseB = b.pose();
  memory.margin = margin;
  memory.deepest = 0.0;
  memory.seamed = false;
  if (!work_.found.empty() || !hadNone) renew(memory, state_.near[pair]);
}

[[gnu::flatten]] void Stepping::renew(PairMemory& memory, std::pair<int, int> pair) {
  const bool sameForm =
      std::equal(memory.touches.begin(), memory.touches.end(), work_.found.begin(),
                 work_.found.end(), [&](const Touch& touch, const ContactPoint& point) {
                   return touch.contact.point.feature == point.feature &&
                          closed(touch) == (point.separation <= tolerance_.touch);
                 });
  if (!sameForm) matchFeatures(memory, pair);
  bool same = sameForm;
  for (std::size_t i = 0; i < work_.found.size(); ++i) {
    Touch& touch = memory.touches[i];
    touch.contact.point = work_.found[i];
    memory.deepest = std::max(memory.deepest, -touch.contact.point.separation);
    const ContactPoint& c = touch.contact.point;
    same = same && isSame(touch.lever, leverOf(c, pair), roundingAt(c.p));
  }
  if (same) return;
  memory.look = ++memory_.looks;
  if (!sameForm) memory.form = memory.look;
  for (Touch& touch : memory.touches) touch.lever = leverOf(touch.contact.point, pair);
}

Lever Stepping::leverOf(const ContactPoint& c, std::pair<int, int> pair) const {
  const auto arm = [&](int i) {
    const RigidBody& body = state_.bodies[i];
    const bool stands = body.fixed() && body.omega.isZero(0.0);
    return stands ? Vec3(Vec3::Zero()) : Vec3(c.p - body.x);
  };
  return {.n = c.n, .armA = arm(pair.second), .armB = arm(pair.first), .separation = c.separation};
}

/// Makes as many touches as were found. Hits under way go on where the same features touch.
void Stepping::matchFeatures(PairMemory& memory, std::pair<int, int> pair) {
  thread_local std::vector<Touch> old;
  old.clear();
  old.swap(memory.touches);
  Touch fresh;
  fresh.contact.a = pair.second;
  fresh.contact.b = pair.first;
  if (!work_.found.empty()) {
    const Surface surface = model_.surface(pair.second, pair.first);
    fresh.contact.restitution = surface.restitution;
    fresh.contact.friction = surface.friction;
  }
  memory.bounces = fresh.contact.restitution > 0.0;
  memory.lands = !memory.bounces && !model_.bends(pair.first) && !model_.bends(pair.second);
  memory.touches.assign(work_.found.size(), fresh);
  for (std::size_t i = 0; i < work_.found.size(); ++i) {
    for (const Touch& before : old) {
      if (before.contact.point.feature != work_.found[i].feature) continue;
      memory.touches[i].pull = before.pull;
      memory.touches[i].impulse = before.impulse;
      memory.touches[i].length = before.length;
      memory.touches[i].pushedOpen = before.pushedOpen;
      memory.touches[i].arrivalSpeed = before.arrivalSpeed;
      memory.touches[i].arrivalImpulse = before.arrivalImpulse;
    }
  }
}

}  // namespace tumble
