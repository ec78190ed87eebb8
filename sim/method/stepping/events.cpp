// What a step has to tell: impacts, contacts that begin or end to last, slip and stick.
#include <algorithm>

#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

const Contact* ofSamePair(const std::vector<Contact>& list, const Contact& c) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Contact& other) {
    return other.a == c.a && other.b == c.b;
  });
  return found == list.end() ? nullptr : &*found;
}

Event eventAt(double t, EventKind kind, const Contact& c) {
  return {.t = t,
          .kind = kind,
          .a = c.a,
          .b = c.b,
          .p = c.point.p,
          .n = c.point.n,
          .vrel = 0.0,
          .j = 0.0};
}

}  // namespace

std::vector<Contact> Stepping::pushedContacts(double h) {
  const std::vector<RigidBody>& start = state_.trail.back().start;
  std::vector<Contact> pushed;
  state_.warm.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact c = contacts_[i];
    const double j = impulse_[i].dot(c.point.n);
    if (j <= 0.0) continue;
    state_.warm[{c.a, c.b, c.point.feature}] = impulse_[i];
    c.anchor = anchorOf(start[c.a], start[c.b], c.point);
    c.force = impulse_[i] / h;
    const Vec3 tangential = impulse_[i] - j * c.point.n;
    const Vec3 slip = slipVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point);
    c.sliding = c.friction > 0.0 && tangential.norm() >= c.friction * j * (1.0 - 1e-9) &&
                slip.norm() > tolerance_.stick;
    c.lasting = !rebounds_[i];
    pushed.push_back(c);
  }
  return pushed;
}

void Stepping::recordImpact(double t, std::span<const Contact> pair) {
  const std::vector<RigidBody>& start = state_.trail.back().start;
  Event event = eventAt(t, EventKind::Impact, pair.front());
  event.p.setZero();
  for (const Contact& c : pair) {
    const double j = (t - state_.t) * c.force.dot(c.point.n);
    event.p += j * c.point.p;
    event.j += j;
    event.vrel = std::min(event.vrel, approachVelocity(start[c.a], start[c.b], c.point));
  }
  event.p /= event.j;
  if (event.vrel < landingSpeed()) report_.events.push_back(event);
}

void Stepping::recordEvents(double t) {
  const std::size_t firstEvent = report_.events.size();
  const std::vector<Contact> pushed = pushedContacts(t - state_.t);
  std::vector<Contact> before;
  std::swap(before, state_.lasting);

  // Contacts of one pair stand together; a pair that rebounds does not last.
  for (auto first = pushed.begin(); first != pushed.end();) {
    const auto last = std::find_if(
        first, pushed.end(), [&](const Contact& c) { return c.a != first->a || c.b != first->b; });
    recordImpact(t, {first, last});
    if (std::all_of(first, last, [](const Contact& c) { return c.lasting; })) {
      state_.lasting.insert(state_.lasting.end(), first, last);
      const Contact* old = ofSamePair(before, *first);
      if (!old) report_.events.push_back(eventAt(t, EventKind::Rest, *first));
      if (first->sliding != (old && old->sliding))
        report_.events.push_back(
            eventAt(t, first->sliding ? EventKind::Slip : EventKind::Stick, *first));
    }
    first = last;
  }
  for (const Contact& c : before)
    if (ofSamePair(before, c) == &c && !ofSamePair(state_.lasting, c))
      report_.events.push_back(eventAt(t, EventKind::Separate, c));
  sortEvents(report_, firstEvent);
  state_.trail.back().contacts = pushed;
}

double Stepping::landingSpeed() const {
  return -2.0 * model_.def.gravity.norm() * model_.def.stepping.step;
}

}  // namespace tumble
