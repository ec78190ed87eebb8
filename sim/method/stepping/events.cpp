// What a step has to tell: impacts, contacts that begin or end to last, slip and stick.
#include <algorithm>

#include "sim/method/stepping/stepping.h"

namespace tumble {
std::vector<Stepping::Push> Stepping::pushes(double h) {
  const std::vector<RigidBody>& start = state_.trail.back().start;
  std::vector<Push> pushed;
  std::map<State::ContactKey, State::Arrival> arrivals;
  state_.warm.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact c = contacts_[i];
    double j = impulse_[i].dot(c.point.n);
    if (j <= 0.0) continue;
    const State::ContactKey key{c.a, c.b, c.point.feature};
    state_.warm[key] = impulse_[i];
    c.anchor = anchorOf(start[c.a], start[c.b], c.point);
    c.force = impulse_[i] / h;
    const Vec3 tangential = impulse_[i] - j * c.point.n;
    const Vec3 slip = slipVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point);
    c.sliding = c.friction > 0.0 && tangential.norm() >= c.friction * j * (1.0 - 1e-9) &&
                slip.norm() > tolerance_.stick;

    // What began as an arrival is told when it has arrived, with all that it got.
    if (const auto begun = state_.arrivals.find(key); begun != state_.arrivals.end())
      j += begun->second.j;
    const bool arriving = c.point.separation > tolerance_.touch;
    if (arriving) arrivals[key] = {approach_[i], j};
    c.lasting = !arriving && !rebounds_[i];
    pushed.push_back({c, approach_[i], j, arriving});
  }
  std::swap(state_.arrivals, arrivals);
  return pushed;
}

void Stepping::recordImpact(double t, std::span<const Push> pair) {
  const Contact& first = pair.front().contact;
  Event event{.t = t, .kind = EventKind::Impact, .a = first.a, .b = first.b};
  event.n = first.point.n;
  event.p.setZero();
  for (const Push& push : pair) {
    if (push.arriving) continue;
    event.p += push.j * push.contact.point.p;
    event.j += push.j;
    event.vrel = std::min(event.vrel, -push.approach);
  }
  if (event.vrel >= landingSpeed()) return;
  event.p /= event.j;
  report_.events.push_back(event);
}

void Stepping::recordEvents(double t) {
  const std::size_t firstEvent = report_.events.size();
  const std::vector<Push> pushed = pushes(t - state_.t);
  std::vector<Contact> before;
  std::swap(before, state_.lasting);

  // Contacts of one pair stand together; a pair that rebounds does not last.
  for (auto first = pushed.begin(); first != pushed.end();) {
    const auto last = std::find_if(first, pushed.end(), [&](const Push& push) {
      return push.contact.a != first->contact.a || push.contact.b != first->contact.b;
    });
    recordImpact(t, {first, last});
    const bool rebounds = std::any_of(
        first, last, [](const Push& push) { return !push.arriving && !push.contact.lasting; });
    for (auto push = first; push != last; ++push)
      if (!rebounds && push->contact.lasting) state_.lasting.push_back(push->contact);
    first = last;
  }
  for (const Push& push : pushed) state_.trail.back().contacts.push_back(push.contact);
  recordChanges(before, state_.lasting, t, report_);
  sortEvents(report_, firstEvent);
}

double Stepping::landingSpeed() const {
  return -2.0 * model_.def.gravity.norm() * model_.def.stepping.step;
}

}  // namespace tumble
