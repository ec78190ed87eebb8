// Contacts that are springs: which there are, and when they began and ended.
#include <algorithm>
#include <cmath>
#include <limits>

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
  system_.begin(touching_, {});
  system_.findForces(state_.bodies);
  state_.lasting = system_.contacts();
  // The books follow them to the end of the step.
  for (Contact& c : state_.lasting)
    c.anchor = anchorOf(state_.bodies[c.a], state_.bodies[c.b], c.point);
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

double Course::gapAfter(double h, int a, int b) {
  y_ = y0_;
  steppers_.of(system_).step(system_, state_.t, h, y_);
  system_.unpack(y_, trial_);
  return separation(model_.shapes[a], trial_[a].pose(), model_.shapes[b], trial_[b].pose());
}

double Course::firstTouch(double h) {
  const double instant = instantNear(state_.t);
  double first = h;
  for (std::size_t k = 0; k < state_.near.size(); ++k) {
    const auto [b, a] = state_.near[k];
    // A gap of nothing is still what it was before.
    const double before = std::copysign(std::numeric_limits<double>::min(), gaps_[k]);
    const auto gap = [&, a = a, b = b](double s) {
      const double value = gapAfter(s, a, b);
      return value != 0.0 ? value : before;
    };
    const double end = gap(first);
    if (gaps_[k] == 0.0 || (gaps_[k] > 0.0) == (end > 0.0)) continue;
    first = findRoot(gap, 0.0, first, gaps_[k], end, instant).hi;
  }
  if (first < h && ++state_.course.backUpsSpent > kBackUps) {
    report_.note("more springs set in than a step can hold; some inside a step");
    first = h;
  }
  allowance(first);
  return first;
}

Event Course::springEvent(EventKind kind, const Contact& c) const {
  Event event{.t = state_.t, .kind = kind, .a = c.a, .b = c.b, .p = c.point.p, .n = c.point.n};
  event.vrel = approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point);
  return event;
}

}  // namespace tumble
