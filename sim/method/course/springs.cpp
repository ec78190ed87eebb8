// Contacts that are springs: which there are, and when they began and ended.
#include <algorithm>
#include <cmath>

#include "sim/collide/collide.h"
#include "sim/math/root.h"
#include "sim/method/course/course.h"

namespace tumble {
namespace {

bool holds(const std::vector<Contact>& list, const Contact& c) {
  return std::any_of(list.begin(), list.end(),
                     [&](const Contact& other) { return other.a == c.a && other.b == c.b; });
}

}  // namespace

void Course::chooseSprings() {
  const std::vector<Contact> before = std::move(state_.lasting);
  system_.findForces(state_.bodies);
  state_.lasting = system_.contacts();
  // What they took and did not store is lost.
  report_.certificate.energy_lost_impact -= energyStored(state_.lasting) - energyStored(before);
  // One event for a pair, told at its first contact.
  const auto tell = [&](EventKind kind, const std::vector<Contact>& from,
                        const std::vector<Contact>& notIn) {
    for (std::size_t i = 0; i < from.size(); ++i)
      if (!holds(notIn, from[i]) &&
          (i == 0 || !(from[i].a == from[i - 1].a && from[i].b == from[i - 1].b)))
        report_.events.push_back(springEvent(kind, from[i]));
  };
  tell(EventKind::Rest, state_.lasting, before);
  tell(EventKind::Separate, before, state_.lasting);
}

Event Course::springEvent(EventKind kind, const Contact& c) {
  Event event{.t = state_.t, .kind = kind, .a = c.a, .b = c.b, .p = c.point.p, .n = c.point.n};
  if (state_.trail.empty()) return event;

  // When the surfaces met: the step is not cut there, since forces do not jump.
  const double t0 = state_.trail.back().t0, span = state_.t - t0;
  const auto gap = [&](double h) {
    y_ = y0_;
    steppers_.of(system_).step(system_, t0, h, y_);
    system_.unpack(y_, trial_);
    return separation(model_.shapes[c.a], trial_[c.a].pose(), model_.shapes[c.b],
                      trial_[c.b].pose());
  };
  const double first = gap(0.0), last = gap(span);
  if (first != 0.0 && (first > 0.0) != (last > 0.0))
    event.t = t0 + findRoot(gap, 0.0, span, first, last, 1e-15 + 1e-15 * state_.t).hi;
  gap(event.t - t0);
  event.vrel = approachVelocity(trial_[c.a], trial_[c.b], c.point);
  return event;
}

}  // namespace tumble
