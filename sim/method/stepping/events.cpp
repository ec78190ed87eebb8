// What a step has to tell: impacts, contacts that begin or end to last, slip and stick.
#include <algorithm>
#include <limits>

#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

bool sooner(const LastingPair& p, const LastingPair& q) {
  return std::pair(p.b, p.a) < std::pair(q.b, q.a);
}

}  // namespace

bool Stepping::arrives(const Touch& touch) const {
  return touch.contact.point.separation > tolerance_.touch;
}

/// Whether a hit closes its gap in this step. It has come when it gets more in the next, closed or
/// not: a point over which a body tips opens a little in every step, and closes in the next.
bool Stepping::isArriving(const Touch& touch) const {
  return arrives(touch) && !touch.pushedOpen;
}

/// What comes to rest at once, and would have bounced for less than a step. Of bodies that are
/// small against what a step of free fall goes, that is much.
void Stepping::bookLeftOut(const Touch& touch) {
  constexpr double kMuch = 1e-2;  // of the radius of the smaller body that moves
  const Contact& c = touch.contact;
  const double v = c.restitution * touch.approach;
  if (!(v > 0.0) || touch.rebounds || gravity_ == 0.0) return;
  const double height = v * v / (2.0 * gravity_);
  double& most = report_.certificate.max_closed_height;
  most = std::max(most, height);
  double size = std::numeric_limits<double>::infinity();
  for (const int i : {c.a, c.b})
    if (!model_.fixed(i)) size = std::min(size, model_.radius[i]);
  if (height > kMuch * size)
    report_.note(
        "bounces shorter than a step were left out, and some are high for bodies so small: "
        "a smaller stepping.step follows them");
}

/// What began as an arrival is told when it has arrived, with all that it got.
void Stepping::recordImpact(double t, const PairMemory& pair, double landing) {
  const auto lands = [&](const Touch& touch) { return -touch.approach < landing; };
  if (std::none_of(pair.touches.begin(), pair.touches.end(), lands)) return;
  Event event{.t = t, .kind = EventKind::Impact};
  event.p.setZero();
  for (const Touch& touch : pair.touches) {
    const double pushed = touch.impulse.dot(touch.contact.point.n);
    if (pushed <= 0.0 || isArriving(touch)) continue;
    const double j = pushed + touch.arrivalImpulse;
    if (event.j == 0.0) {
      event.a = touch.contact.a;
      event.b = touch.contact.b;
      event.n = touch.contact.point.n;
    }
    event.p += j * touch.contact.point.p;
    event.j += j;
    event.vrel = std::min(event.vrel, -touch.approach);
  }
  if (event.vrel >= landing) return;
  event.p /= event.j;
  report_.events.push_back(event);
}

void Stepping::recordEvents(double t) {
  Segment& segment = state_.trail.back();
  std::vector<Contact>& contacts =
      parted_ && divided_ ? segment.pieces.back().contacts : segment.contacts;
  const std::size_t firstEvent = report_.events.size();
  const double landing = landingSpeed();
  work_.lasting.clear();
  for (PairMemory& pair : memory_.pairs) {
    const Contact* lasting = nullptr;
    const bool tells = pair.touches.empty() || (!model_.bends(pair.touches[0].contact.a) &&
                                                !model_.bends(pair.touches[0].contact.b));
    if (!allKept_ && tells) recordImpact(t, pair, landing);
    for (Touch& touch : pair.touches) {
      const double j = touch.impulse.dot(touch.contact.point.n);
      if (j > 0.0 && reboundsInStep()) touch.rebounds ? bookShift(touch) : tellPassedOn(touch, j);
      if (j > 0.0) {
        contacts.push_back(touch.contact);
        if (!lasting && touch.contact.lasting) lasting = &touch.contact;
      }
      // What a hit that closes its gap in this step still gets comes in the next.
      const bool arriving = j > 0.0 && isArriving(touch);
      touch.arrivalImpulse = arriving ? j : 0.0;
      touch.arrivalSpeed = arriving ? touch.approach : 0.0;
      touch.pushedOpen = j > 0.0 && arrives(touch);
      if (arriving) bookLeftOut(touch);
    }
    if (lasting && tells) work_.lasting.push_back(lastingPair(*lasting));
  }
  std::swap(work_.lasting, memory_.lasting);
  if (allKept_) return;
  recordLasting(work_.lasting, t);
  sortEvents(report_, firstEvent);
}

/// Both lists have one contact of a pair, in order of pairs.
void Stepping::recordLasting(const std::vector<LastingPair>& before, double t) {
  const auto tell = [&](EventKind kind, const LastingPair& c) {
    report_.events.push_back({.t = t, .kind = kind, .a = c.a, .b = c.b, .p = c.p, .n = c.n});
  };
  auto old = before.begin();
  for (const LastingPair& c : memory_.lasting) {
    for (; old != before.end() && sooner(*old, c); ++old) tell(EventKind::Separate, *old);
    const bool known = old != before.end() && !sooner(c, *old);
    if (!known) tell(EventKind::Rest, c);
    if (c.sliding != (known && old->sliding))
      tell(c.sliding ? EventKind::Slip : EventKind::Stick, c);
    if (known) ++old;
  }
  for (; old != before.end(); ++old) tell(EventKind::Separate, *old);
}

double Stepping::landingSpeed() const {
  return -2.0 * gravity_ * model_.def.stepping.step;
}

}  // namespace tumble
