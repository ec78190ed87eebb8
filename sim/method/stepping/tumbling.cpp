// Free bodies that turn far in a step: no parabola tells when a corner of theirs arrives, nor
// which one. Their flight is known in closed form, and so is the instant of their first touch. What
// then rolls on a rim touches at a point that runs round it faster than the body turns.
#include <algorithm>
#include <limits>

#include "sim/collide/approach.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

constexpr double kRound =
    0.02;  ///< [rad] how far a point may run round its rim in a part of a step

}  // namespace

bool Stepping::tumbles(std::size_t pair, double h) const {
  if (isOneOf(work_.dense, pair)) return false;     // hits of many divide no step
  constexpr double kRebounds = 0.02, kStays = 0.2;  // [rad] in a step
  const double most = memory_.pairs[pair].bounces ? kRebounds : kStays;
  const auto turns = [&](int i) {
    return h * state_.bodies[i].omega.norm() > most &&
           !std::holds_alternative<Sphere>(model_.shapes[i]);
  };
  return turns(state_.near[pair].first) || turns(state_.near[pair].second) ||
         h * runsRound(pair) > kRound;
}

double Stepping::partOnRim(std::size_t pair) {
  constexpr double kLeast = 5e-3;  // of a step
  const double step = model_.def.stepping.step, part = kRound / runsRound(pair);
  const std::vector<Touch>& touches = memory_.pairs[pair].touches;
  const auto touched = [&](const Touch& touch) { return closed(touch); };
  if (part >= step || std::count_if(touches.begin(), touches.end(), touched) != 1) return step;
  report_.note(
      "a rim rolled faster than steps follow: they were divided, and still lost energy there; a "
      "smaller stepping.step loses less");
  return std::max(part, kLeast * step);
}

double Stepping::runsRound(std::size_t pair) const {
  const auto [b, a] = state_.near[pair];
  double fastest = 0.0;
  for (const Touch& touch : memory_.pairs[pair].touches)
    fastest = std::max(fastest,
                       tumble::runsRound(state_.bodies[a], state_.bodies[b], touch.contact.point));
  return fastest;
}

bool Stepping::fliesFree(int i) const {
  const RigidBody& body = state_.bodies[i];
  return body.fixed() || (!work_.held[i] && !isDriven(i) && body.torque.isZero(0.0));
}

const std::vector<Convex>& Stepping::partsOf(int body) {
  memory_.parts.resize(state_.bodies.size());
  std::vector<Convex>& parts = memory_.parts[body];
  if (parts.empty()) parts = outlinedParts(model_.shapes[body]);
  return parts;
}

double Stepping::firstMeeting(std::size_t pair, double h) {
  const auto [ib, ia] = state_.near[pair];
  const auto flightOf = [&](int i) {
    const RigidBody& body = state_.bodies[i];
    return Flight(body, body.invM * body.force, 0.0);
  };
  const Flight flightA = flightOf(ia), flightB = flightOf(ib);
  RigidBody a = state_.bodies[ia], b = state_.bodies[ib];
  constexpr double kShare = 1e-2;  // of the touch
  return firstTouch({flightA, partsOf(ia), a}, {flightB, partsOf(ib), b}, kShare * tolerance_.touch,
                    h);
}

void Stepping::foreseeMeeting(std::size_t pair, double h) {
  const auto [ib, ia] = state_.near[pair];
  std::vector<Touch>& touches = memory_.pairs[pair].touches;
  if (!fliesFree(ia) || !fliesFree(ib)) return;
  const auto hitsNow = [](const Touch& touch) { return touch.rebounds && touch.due == 0.0; };
  if (touches.empty() || std::any_of(touches.begin(), touches.end(), hitsNow)) return;
  Touch* nearest = nullptr;
  for (Touch& touch : touches) {
    touch.rebounds = false;
    touch.due = std::numeric_limits<double>::infinity();
    const auto gap = [](const Touch& t) { return t.contact.point.separation; };
    if (!nearest || gap(touch) < gap(*nearest)) nearest = &touch;
  }
  const double first = firstMeeting(pair, h);
  if (first == h) return;
  nearest->rebounds = true;
  nearest->due = first;
}

}  // namespace tumble
