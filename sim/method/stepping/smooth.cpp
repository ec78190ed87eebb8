// Motion that is smooth in a step: what slides slides on, what sticks or rolls does so on. Its
// forces are those of the middle of the step, and it moves with the mean of its velocities at both
// ends, so that its error is of second order. Anything else goes by velocities at the end of the
// step, which let nothing overlap and bring what slips to a halt.
#include <algorithm>
#include <cmath>

#include "sim/body/force.h"
#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

/// How fast [m/s] a touch may part or approach as a smooth step begins: as its point went on in a
/// step that was not, by h J̇ v, or as a gap closes; not into an overlap.
double Stepping::leftOver(const Touch& touch, double h) const {
  const Contact& c = touch.contact;
  const double way = 0.5 * h * c.point.n.dot(rateAt(c, work_.before));
  if (c.point.separation + way < -tolerance_.root) return 0.0;
  return h * std::abs(normalAccelerationBias(state_.bodies[c.a], state_.bodies[c.b], c.point)) +
         tolerance_.touch / model_.def.stepping.step;
}

/// How fast [m/s] the points of a pair close in a smooth step what those before left of their gaps,
/// all alike. What dates no collision is rounding.
double Stepping::closing(std::span<const Touch> touches, double h) const {
  double least = tolerance_.touch;
  for (const Touch& touch : touches) least = std::min(least, touch.contact.point.separation);
  if (least <= tolerance_.root || !areClosed(touches)) return 0.0;
  return least / std::max(h, model_.def.stepping.step);
}

/// The rate of a touch at the end of a smooth step, to second order, where its velocities are those
/// of the end: J½ v1 + (J½ − J0) v0, along the normal.
Vec3 Stepping::rateAtEnd(const Stance& at) const {
  const Vec3 rate = rateIn(at, work_.after);
  const double normal = at.point.n.dot(rate) + wanders(at);
  return rate + (normal - at.touch->contact.point.n.dot(rate)) * at.touch->contact.point.n;
}

/// What the rate of a touch along its normal [m/s] gains from the start of a smooth step to its
/// middle because its point wanders: (J½ − J0) v0; as much again until its end.
double Stepping::wanders(const Stance& at) const {
  const Contact& c = at.touch->contact;
  return at.point.n.dot(rateIn(at, work_.before)) - c.point.n.dot(rateAt(c, work_.before));
}

Vec3 Stepping::rateIn(const Stance& at, std::span<const Vec6> twists) const {
  const auto of = [&](int i, const Vec3& x) {
    return Vec3(twists[i].head<3>() + twists[i].tail<3>().cross(at.point.p - x));
  };
  return of(at.touch->contact.a, at.a) - of(at.touch->contact.b, at.b);
}

/// Whether a touch slips on forwards between these velocities at the two ends of a step, or sticks
/// on.
bool Stepping::keepsMode(const Touch& touch, const Vec3& first, const Vec3& last) const {
  if (touch.contact.friction <= 0.0) return true;
  return first.norm() > tolerance_.stick ? first.dot(last) > 0.0 : last.norm() <= tolerance_.stick;
}

/// Whether what goes round leads what goes round with it by more than contacts at rest may move: of
/// bodies that slide on each other rounding leaves spins that share a direction, or do not.
bool Stepping::leads(const Contact& contact, double h) const {
  return carried(contact, h).norm() > tolerance_.rest;
}

/// Whether a touch carries its bodies round with each other, along chords.
bool Stepping::goesRound(const Touch& touch, double h) const {
  const Contact& c = touch.contact;
  if (!leads(c, h)) return false;
  const bool drives = model_.fixed(c.a) || model_.fixed(c.b);
  return (c.friction > 0.0 && rateAt(c, work_.before).norm() <= tolerance_.stick) ||
         (drives && std::abs(c.point.n.dot(carried(c, h))) > tolerance_.rest);
}

/// Whether an island moves, and its contacts last and keep their modes if the same acts on its
/// bodies as in the step before.
bool Stepping::foreseesSmooth(Island& island, double h) {
  if (!anyMoves(island)) return false;
  for (const int i : island.movers) {
    const Push& last = memory_.pushes[i];
    if (!(last.t1 > last.t0)) return false;
    const RigidBody& body = state_.bodies[i];
    const double part = h / (last.t1 - last.t0);
    work_.after[i].head<3>() = body.v + part * body.invM * (last.P1 - last.P0);
    work_.after[i].tail<3>() = body.omega + part * body.Iinv * (last.L1 - last.L0);
  }
  for (const Link link : island.links) {
    if (!isPair(link)) continue;
    for (const Touch& touch : memory_.pairs[link].touches) {
      if (!closed(touch)) continue;  // one that closes ends what is smooth
      const Contact& c = touch.contact;
      const Vec3 first = rateAt(c, work_.before), last = rateAt(c, work_.after);
      const bool slows = 2.0 * first.dot(last) < first.squaredNorm();  // it may come to a halt
      const double left = island.movers.size() == 1 ? leftOver(touch, h) : 0.0;
      const bool stays = std::abs(c.point.n.dot(first)) <= tolerance_.rest + left;
      if (!stays || !keepsMode(touch, first, last) || slows || goesRound(touch, h)) return false;
    }
  }
  return true;
}

/// Whether an island was smooth in the step, by the velocities that were found. Contacts between
/// bodies that both move must have been foreseen: from the start of the step its impulses turn one
/// as much as they turn the other back only if bodies move with the velocities of its end.
bool Stepping::isSmooth(const Island& island, double h) const {
  const auto moves = [&](int i) { return work_.after[i] != work_.before[i]; };
  if (std::none_of(island.movers.begin(), island.movers.end(), moves) ||
      std::any_of(island.movers.begin(), island.movers.end(),
                  [&](int i) { return isMovedByGroup(i); }))
    return false;
  for (const Link link : island.links) {
    if (!isPair(link)) continue;
    std::vector<Touch>& touches = memory_.pairs[link].touches;
    const double closes = island.follows() ? closing(touches, h) : 0.0;
    for (Touch& touch : touches) {
      const Contact& c = touch.contact;
      const Vec3 first = rateAt(c, work_.before),
                 last = island.follows() ? rateAtEnd(inMiddle(touch, h)) : rateAt(c, work_.after);
      const double left = island.follows() ? leftOver(touch, h) : 0.0;
      const auto lasts = [&](const Vec3& rate, double more) {
        return closed(touch) && std::abs(c.point.n.dot(rate)) <= tolerance_.rest + more;
      };
      const bool pushes = !touch.impulse.isZero(0.0);
      if (pushes && !island.smooth && !model_.fixed(c.a) && !model_.fixed(c.b)) return false;
      const double gap = closed(touch) ? 0.0 : c.point.separation,
                   parts = 0.5 * c.point.n.dot(first + last);
      const bool stays =
          lasts(first, left) && (lasts(last, 0.0) || lasts(last + closes * c.point.n, 0.0));
      if (pushes ? !stays : gap + h * parts < -h * tolerance_.rest) return false;
      if (island.smooth ? !keepsMode(touch, first, last) : leads(c, h)) return false;
    }
  }
  return true;
}

/// Point forces turn a body as where it stands in the middle of a smooth step, in any other one as
/// where it stands at the start; and so do springs.
void Stepping::gripAnew(Island& island, double h) {
  for (const int i : island.movers) {
    if (!isGripped(i)) continue;
    DrivenGroup& group = memory_.drives->groups[memory_.drives->groupOf[i]];
    RigidBody &body = state_.bodies[i], &at = group.moved.front();
    at = body;
    if (island.smooth) at.q = rotated(at.q, 0.5 * h * at.omega).normalized();
    updateDerived(at);
    sumForces(model_.def.gravity, group.forces, group.moved);
    body.torque = at.torque;
    work_.star[i].tail<3>() = body.Iinv * (body.L + h * body.torque);
  }
  if (isBonded(island)) springAnew(island, h);
}

/// What lands within a step is booked in its impact, and so is what a blow leaves of its step.
void Stepping::bookLanding(Island& island, double h) const {
  const auto lands = [&](const Touch& touch) {
    const ContactPoint& c = touch.contact.point;
    const bool runs = c.rimA > 0.0 || c.rimB > 0.0;
    return (runs || arrives(touch) || touch.pushedOpen) && !touch.impulse.isZero(0.0);
  };
  const auto anyLands = [&](Link link) {
    if (!isPair(link)) return false;
    const std::vector<Touch>& touches = memory_.pairs[link].touches;
    return std::any_of(touches.begin(), touches.end(), lands);
  };
  if (struck_ || std::any_of(island.links.begin(), island.links.end(), anyLands))
    bookWays(island, h);
}

/// What is touched moves with the velocity of the end of the step, which is not what forces gave it
/// on its way: the difference of their work is lost.
void Stepping::bookWays(Island& island, double h) const {
  IslandBooks& books = island.memory->books;
  for (const int i : island.movers) {
    if (!work_.touched[i] || work_.later[i] > 0.0 || isMovedByGroup(i) || isHalved(i) ||
        model_.bends(i))
      continue;
    const RigidBody& body = state_.bodies[i];
    Vec6 change = 0.5 * h * (work_.after[i] - work_.before[i]);
    change.head<3>() -= h * work_.falls[i];
    Vec3 force = body.force, torque = body.torque;
    if (const int drag = memory_.drives->dragOf[i]; drag >= 0) {  // has its own books
      force += memory_.drives->drags[drag].linear * body.v;
      torque += memory_.drives->drags[drag].angular * body.omega;
    }
    const double turning = torque.dot(change.tail<3>());
    books.lostImpact += force.dot(change.head<3>()) + turning;
    books.work += (force - body.M * model_.def.gravity).dot(change.head<3>()) + turning;
  }
}

/// Where the rows of a contact are taken in the middle of the step.
Stance Stepping::inMiddle(Touch& touch, double h) const {
  const Contact& contact = touch.contact;
  RigidBody a = state_.bodies[contact.a], b = state_.bodies[contact.b];
  Contact c = contact;
  c.anchor = anchorOf(a, b, c.point);
  for (RigidBody* body : {&a, &b}) {
    body->x += 0.5 * h * body->v;
    body->q = rotated(body->q, 0.5 * h * body->omega);
    updateDerived(*body);
  }
  follow(a, b, c);
  return {.touch = &touch, .point = c.point, .a = a.x, .b = b.x};
}

}  // namespace tumble
