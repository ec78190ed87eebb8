// Answers that islands keep: from the step before, or from one of another length.
#include <algorithm>
#include <limits>

#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

/// Whether an island has the bodies that it had when it was solved, and as many links.
bool Stepping::ofSame(const Island& island) const {
  return island.memory->seen.size() == island.links.size() &&
         std::equal(island.memory->movers.begin(), island.memory->movers.end(),
                    island.movers.begin(), island.movers.end(),
                    [](const IslandMemory::Mover& mover, int body) { return mover.body == body; });
}

/// Whether the links of an island are pairs with the features that it was solved with.
bool Stepping::hasSameForm(const Island& island) const {
  if (!ofSame(island)) return false;
  for (std::size_t k = 0; k < island.links.size(); ++k)
    if (!isPair(island.links[k]) ||
        island.memory->seen[k].form != memory_.pairs[island.links[k]].form)
      return false;
  return true;
}

/// Whether the pairs of an island have the levers that it was solved with, and as many of their
/// points are in its problem.
bool Stepping::looksTheSame(const Island& island, double h) const {
  const IslandMemory& memory = *island.memory;
  if (!ofSame(island)) return false;
  std::size_t cones = 0;
  for (std::size_t k = 0; k < island.links.size(); ++k) {
    if (!isPair(island.links[k])) {
      ++cones;
      continue;
    }
    const PairMemory& pair = memory_.pairs[island.links[k]];
    if (memory.seen[k].look != pair.look) return false;
    for (const Touch& touch : pair.touches) cones += flies(touch, h) || isAside(touch) ? 0 : 1;
  }
  return cones == memory.cones;
}

/// Whether an island asks what it asked when it was solved, wherever it has gone: the same levers
/// and inertias, and velocities that differ by far less than the tolerance on the residual.
bool Stepping::keeps(const Island& island, double h) const {
  if (isBonded(island) || !looksTheSame(island, h)) return false;
  constexpr double kKept = 0.01;  // of the tolerance: what is kept errs the same way in every step
  const double part = kKept * model_.def.stepping.tolerance, allowed = part * island.memory->scale;
  for (const IslandMemory::Mover& mover : island.memory->movers) {
    const Mat3 turned = state_.bodies[mover.body].Iinv - mover.Iinv;
    if (!((work_.star[mover.body] - mover.vStar).lpNorm<Eigen::Infinity>() <= allowed) ||
        !(turned.lpNorm<Eigen::Infinity>() <= part * mover.Iinv.lpNorm<Eigen::Infinity>()))
      return false;
  }
  for (const Link link : island.links)
    for (const Touch& touch : memory_.pairs[link].touches)
      if (touch.pushedOpen) return false;
  return true;
}

/// Whether what was seen further in a step asks an island nothing: it was solved in this very step,
/// and by that problem. Rows of joints are the same throughout a step.
bool Stepping::isAnswered(const Island& island, double h) const {
  return again_ && island.memory->step == step_ && island.memory->length == h &&
         looksTheSame(island, h) && !anyYields(island) &&
         std::none_of(island.movers.begin(), island.movers.end(),
                      [&](int i) { return isDriven(i); });
}

/// Tells of such an island what was told when it was solved.
void Stepping::answerAgain(Island& island, double h) {
  island.answer.kept = false;
  tellRough(island, h);
  giveMotion(island);
  for (std::size_t k = 0; k < island.links.size(); ++k)
    if (!isPair(island.links[k]))
      work_.bonds.lambda[island.links[k] - state_.near.size()] = island.memory->seen[k].lambda;
  if (isBonded(island) && flyAsOne(island, h)) keepSpin(island, h);
  if (island.memory->smooth)
    for (const int i : island.movers) work_.smooth[i] = 1;
}

/// Whether an island may ask for the forces of the step before: its contacts are those of then. One
/// contact alone is solved as quickly as asked, and without what rounding would add up; what hardly
/// moves is solved, to be told to stand.
bool Stepping::goesOn(const Island& island, double h) const {
  if (island.memory->cones < 2 || island.memory->rough || !hasSameForm(island)) return false;
  for (const Link link : island.links)
    for (const Touch& touch : memory_.pairs[link].touches)
      if (touch.length != h || touch.pushedOpen || flies(touch, h)) return false;
  return anyMoves(island);
}

bool Stepping::moves(int body) const {
  const Vec6& v = work_.before[body];
  return v.head<3>().norm() + model_.radius[body] * v.tail<3>().norm() > tolerance_.rest;
}

bool Stepping::anyMoves(const Island& island) const {
  return std::any_of(island.movers.begin(), island.movers.end(), [&](int i) { return moves(i); });
}

/// Whether the impulses of the step before, where points are now, change velocities as they did.
bool Stepping::balances(const Island& island) {
  constexpr double kBalance = 1e-12, kOpen = 0.01;  // of the change; of the tolerance
  const double open = std::max(kBalance, kOpen * model_.def.stepping.tolerance);
  for (const int i : island.movers) work_.after[i].setZero();
  for (const Link link : island.links) {
    for (const Touch& touch : memory_.pairs[link].touches) {
      const Contact& c = touch.contact;
      const auto push = [&](int i, const Vec3& impulse) {
        if (model_.fixed(i)) return;
        work_.after[i].head<3>() += impulse;
        work_.after[i].tail<3>() += (c.point.p - state_.bodies[i].x).cross(impulse);
      };
      push(c.a, touch.impulse);
      push(c.b, -touch.impulse);
    }
  }
  return std::all_of(island.memory->movers.begin(), island.memory->movers.end(),
                     [&](const IslandMemory::Mover& mover) {
                       const RigidBody& body = state_.bodies[mover.body];
                       const Vec6& sum = work_.after[mover.body];
                       Vec6 push;
                       push << body.invM * sum.head<3>(), body.Iinv * Vec3(sum.tail<3>());
                       return (push - mover.push).norm() <= open * push.norm();
                     });
}

/// How far [m/s] the velocity of a point after the step is from one with which its force obeys the
/// law of contact: a projection brings no two points further apart, so that this bounds the
/// residual.
double Stepping::missedBy(const Touch& touch, const Room& room, double h) const {
  constexpr double kEdge = 1e-14;  // of a force: nearer to the edge of its cone is on it
  const Contact& c = touch.contact;
  const Vec3& n = c.point.n;
  Vec3 lead = carried(c, h);
  if (!model_.fixed(c.a) && !model_.fixed(c.b)) lead -= n.dot(lead) * n;
  const Vec3 u = rateAt(c, work_.after) + lead;
  const double along = n.dot(u), j = n.dot(touch.impulse), parts = along + gapRate(touch, room, h);
  const Vec3 held = touch.impulse - j * n;
  const double holds = held.norm(), most = c.friction * j, rounding = kEdge * j;
  if (j < 0.0 || holds > most + rounding) return std::numeric_limits<double>::infinity();
  if (j == 0.0) return std::max(0.0, -parts);
  if (c.friction <= 0.0) return std::abs(parts);
  Vec3 slip = u - along * n;
  if (holds >= most - rounding)  // then it may slip against what holds it
    slip -= std::min(0.0, slip.dot(held) / (holds * holds)) * held;
  return std::abs(parts) + (1.0 + c.friction) * slip.norm();
}

/// Gives an island the forces of the step before, where they do as well: as to what slides on along
/// its line, however fast it is by now.
bool Stepping::pushesAlike(Island& island, double h) {
  constexpr double kAlike = 0.1;  // of the tolerance
  if (!goesOn(island, h) || !balances(island)) return false;
  for (const IslandMemory::Mover& mover : island.memory->movers)
    work_.after[mover.body] = work_.star[mover.body] + mover.push;
  double scale = 0.0, missed = 0.0;
  for (const Link link : island.links) {
    const std::vector<Touch>& touches = memory_.pairs[link].touches;
    const Room room = roomOf(touches);
    for (const Touch& touch : touches) {
      scale = std::max(scale, rateAt(touch.contact, work_.star).norm());
      missed = std::max(missed, missedBy(touch, room, h));
    }
  }
  if (!(missed <= kAlike * model_.def.stepping.tolerance * scale)) return false;

  island.answer.kept = false;  // a contact may have come to slip
  island.memory->scale = scale;
  island.memory->residual = missed / scale;
  for (IslandMemory::Mover& mover : island.memory->movers) {
    mover.vStar = work_.star[mover.body];
    mover.v = work_.after[mover.body];
  }
  island.memory->books = {};
  for (const Link link : island.links) {
    for (Touch& touch : memory_.pairs[link].touches) {
      touch.approach = -touch.contact.point.n.dot(rateAt(touch.contact, work_.before));
      const auto mean = [&](int i) {
        return Vec3(0.5 * (speedAt(touch.contact, i, work_.before) +
                           speedAt(touch.contact, i, work_.after)));
      };
      bookTouch(touch, mean(touch.contact.a), mean(touch.contact.b), island.memory->books);
    }
  }
  return true;
}

/// Whether an island that was at rest is asked for a step of another length: its forces stay,
/// unless they are those of a short step, in whose impulses more of them is rounding.
bool Stepping::rests(const Island& island, double h) const {
  if (island.memory->length == h || h > 2.0 * island.memory->solved || !hasSameForm(island))
    return false;
  const double s = h / island.memory->length, still = tolerance_.rest;
  for (std::size_t i = 0; i < island.movers.size(); ++i) {
    const Vec6 &star = work_.star[island.movers[i]], &before = work_.before[island.movers[i]];
    const Vec6 asked = before + s * (island.memory->movers[i].vStar - island.memory->movers[i].v);
    for (const Vec6& v : {before, island.memory->movers[i].v, Vec6(star - asked)})
      if (!(v.lpNorm<Eigen::Infinity>() <= still)) return false;
  }
  return true;
}

/// An island none of whose bodies moves by more than the solver left, before a step or after it,
/// stands, where that would bring one of them to another pose: it was no motion. In a crowd it
/// stands as soon as all of them are at rest.
void Stepping::stand(Island& island, bool crowd, double h) const {
  constexpr double kLeft = 100.0;  // of what was asked: a jam of blocks answers with 40 times it
  const double residual = std::max(island.memory->residual, model_.def.stepping.tolerance),
               left = kLeft * residual * island.memory->scale;
  const double still = crowd ? tolerance_.rest : std::min(left, tolerance_.rest);
  const auto stands = [&](int body, const Vec6& twist) {
    return twist.head<3>().norm() + model_.radius[body] * twist.tail<3>().norm() <= still;
  };
  bool leaves = crowd;
  for (const IslandMemory::Mover& mover : island.memory->movers) {
    if (!stands(mover.body, work_.before[mover.body]) || !stands(mover.body, mover.v)) return;
    const RigidBody& body = state_.bodies[mover.body];
    leaves = leaves || body.x + h * mover.v.head<3>() != body.x ||
             rotated(body.q, h * mover.v.tail<3>()).coeffs() != body.q.coeffs();
  }
  if (!leaves) return;
  island.memory->books.external.setZero();
  for (IslandMemory::Mover& mover : island.memory->movers) {
    mover.v.setZero();
    island.memory->books.external -= massOnWay(mover.body) * mover.vStar.head<3>();
  }
}

/// Gives the answer of an island at rest to a step of another length.
void Stepping::stretch(Island& island, double h) {
  const double s = h / island.memory->length;
  island.memory->length = h;
  island.memory->books = {};
  for (std::size_t k = 0; k < island.links.size(); ++k) {
    island.memory->seen[k].look = memory_.pairs[island.links[k]].look;
    for (Touch& touch : memory_.pairs[island.links[k]].touches) {
      touch.impulse *= s;
      touch.length = h;
    }
  }
  for (std::size_t i = 0; i < island.movers.size(); ++i) {
    island.memory->movers[i].vStar = work_.star[island.movers[i]];
    island.memory->movers[i].v = work_.before[island.movers[i]];
    island.memory->books.external +=
        massOnWay(island.movers[i]) *
        (island.memory->movers[i].v - island.memory->movers[i].vStar).head<3>();
  }
}

}  // namespace tumble
