// What the answer of an island gives to its bodies, its contacts and the books.
#include "sim/method/stepping/stepping.h"
#include "sim/problem/cone.h"

namespace tumble {

/// Gives the solution to the contacts and bodies of an island, and remembers it.
void Stepping::share(Island& island, double h) {
  island.memory->length = island.memory->solved = h;
  island.memory->cones = island.problem.cones.size();
  island.memory->step = step_;
  for (const int i : island.movers) work_.after[i] = island.solution.v[island.local[i]];
  remember(island);
  std::size_t cone = 0;
  for (std::size_t k = 0; k < island.links.size(); ++k) {
    const Link link = island.links[k];
    if (!isPair(link)) {
      const double lambda = island.solution.lambda[island.problem.cones[cone++].row];
      work_.bonds.lambda[link - state_.near.size()] = island.memory->seen[k].lambda = lambda;
      continue;
    }
    for (Touch& touch : memory_.pairs[link].touches)
      if (!flies(touch, h) && !isAside(touch))
        shareTouch(island, touch, island.problem.cones[cone++], h);
  }
}

/// What an island saw when it found the velocities `after`.
void Stepping::remember(Island& island) {
  island.memory->books = {};
  island.memory->seen.clear();
  for (const Link link : island.links) {
    IslandMemory::Seen& seen = island.memory->seen.emplace_back();
    if (isPair(link)) seen = {.look = memory_.pairs[link].look, .form = memory_.pairs[link].form};
  }
  island.memory->movers.clear();
  for (const int i : island.movers)
    island.memory->movers.push_back({.body = i,
                                     .Iinv = state_.bodies[i].Iinv,
                                     .vStar = work_.star[i],
                                     .v = work_.after[i],
                                     .push = work_.after[i] - work_.star[i]});
}

void Stepping::shareTouch(Island& island, Touch& touch, const Cone& cone, double h) {
  Vec3 impulse = Vec3::Zero(), pull = Vec3::Zero(), ofA = Vec3::Zero(), ofB = Vec3::Zero();
  const Vec6 twistA = 0.5 * (work_.before[touch.contact.a] + work_.after[touch.contact.a]),
             twistB = 0.5 * (work_.before[touch.contact.b] + work_.after[touch.contact.b]);
  for (int r = cone.row; r < cone.row + coneRows(cone.kind); ++r) {
    const Row& row = island.problem.rows[r];
    impulse += island.solution.lambda[r] * row.linear;
    if (!island.solution.pull.empty()) pull += island.solution.pull[r] * row.linear;
    ofA += (row.linear.dot(twistA.head<3>()) + row.angularA.dot(twistA.tail<3>())) * row.linear;
    ofB += (row.linear.dot(twistB.head<3>()) - row.angularB.dot(twistB.tail<3>())) * row.linear;
  }
  touch.impulse = impulse;
  touch.pull = island.solution.pull.empty() ? unknown() : pull;
  touch.length = h;
  touch.contact.force = impulse / h;
  bookTouch(touch, ofA, ofB, island.memory->books);
}

/// What the impulse of a touch does: its work is that by the mean of the velocities [m/s] of the
/// two bodies before the step and after it.
void Stepping::bookTouch(Touch& touch, const Vec3& ofA, const Vec3& ofB, IslandBooks& books) const {
  Contact& contact = touch.contact;
  const bool fixedA = model_.fixed(contact.a), fixedB = model_.fixed(contact.b);
  const Vec3 rate = ofA - ofB;
  const double lostImpact = touch.impulse.dot(contact.point.n) * contact.point.n.dot(rate);
  books.lostImpact -= lostImpact;
  books.lostFriction -= touch.impulse.dot(rate) - lostImpact;
  if (fixedA) books.work -= touch.impulse.dot(ofA);
  if (fixedB) books.work += touch.impulse.dot(ofB);
  if (fixedB) books.external += touch.impulse;
  if (fixedA) books.external -= touch.impulse;
  contact.sliding = contact.friction > 0.0 && slides(touch);
  contact.lasting = !arrives(touch);
}

/// Of a body at a contact point.
Vec3 Stepping::speedAt(const Contact& contact, int body, std::span<const Vec6> twists) const {
  const Vec6& twist = twists[body];
  return twist.head<3>() + twist.tail<3>().cross(contact.point.p - state_.bodies[body].x);
}

/// Whether the friction of a touch is all that its cone gives, and its bodies slip.
bool Stepping::slides(const Touch& touch) const {
  const Contact& contact = touch.contact;
  const Vec3& n = contact.point.n;
  const double j = touch.impulse.dot(n);
  const Vec3 tangential = touch.impulse - j * n, rate = rateAt(contact, work_.after);
  const Vec3 slip = rate - rate.dot(n) * n;
  constexpr double kEdge = 1e-9;  // of the cone: nearer is on its edge
  return tangential.norm() >= contact.friction * j * (1.0 - kEdge) &&
         slip.norm() > tolerance_.stick;
}

}  // namespace tumble
