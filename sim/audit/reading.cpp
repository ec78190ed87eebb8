// What methods leave behind of the motion: parts of steps with a state at both ends, or flights in
// closed form with instants at which they change.
#include <algorithm>
#include <limits>

#include "sim/audit/audit.h"

namespace tumble {
namespace {

/// Steps of which one is audited whole; of all of them, how deep bodies overlap at their ends, and
/// the kinetic energy. The first are audited all, and every one where loads depend on velocities,
/// or where points of mass have a skin that is rubbed.
constexpr long kEvery = 8;
/// Looks at flights in a run, and the most in a second.
constexpr double kLooks = 64.0, kLooksPerSecond = 60.0;

}  // namespace

void Audit::follow(const State& state) {
  if (state.before && !handedOver_) {
    follow(*state.before);
    handedOver_ = true;
  }
  if (state.exact.flights.empty())
    followSteps(state);
  else
    followFlights(state);
}

namespace {

/// When step k of a stretch of them begins [s].
double startOf(const Segment& part, long k) {
  const double whole = static_cast<double>(part.steps);
  return k == part.steps ? part.t1 : part.t0 + static_cast<double>(k) / whole * (part.t1 - part.t0);
}

}  // namespace

void Audit::followSteps(const State& state) {
  // `stepping` strikes what is due within a step at its start: the impulse is a part of the step.
  struck_ = model_.runs == "stepping" || state.before;
  const Segment* before = nullptr;
  for (const Segment& part : state.trail) {
    const Segment* const previous = before;
    before = &part;
    if (part.t1 <= followed_) continue;
    const std::vector<RigidBody>& end = part.still ? part.start : part.end;
    followed_ = part.t1;
    addKinetic(end);
    for (long k = 0; k < part.steps; ++k) {
      const bool all = !stored_ || skins_ || parts_ < kEvery || parts_ % kEvery == 0;
      ++parts_;
      if (!all && nearness_.glance(end, part.pieces)) continue;
      const double t0 = startOf(part, k), t1 = startOf(part, k + 1);
      if (struck_ && (k > 0 || (previous && previous->t1 == part.t0))) {
        if (t0 > t_) see(t0, k > 0 ? end : previous->end, true);
      } else {
        see(t0, part.start, t0 > t_);
      }
      see(t1, end, false, part.pieces);
    }
  }
  if (state.t >= model_.def.duration || state.t == t_) see(state.t, state.bodies, state.t > t_);
}

void Audit::bodiesInFlight(const State& state, double t, bool before,
                           std::vector<RigidBody>& out) const {
  out = bodies_;
  for (std::size_t i = 0; i < state.exact.flights.size(); ++i) {
    const std::vector<Flight>& flights = state.exact.flights[i];
    const auto begun = [&](const Flight& flight) {
      return before ? flight.start() < t : flight.start() <= t;
    };
    auto next = std::partition_point(flights.begin(), flights.end(), begun);
    if (next != flights.begin()) --next;
    next->at(t, out[i]);
  }
  for (std::size_t k = 0; k < state.exact.tops.size(); ++k)
    state.exact.tops[k].at(t, out[model_.pivots[k].body]);
}

void Audit::followFlights(const State& state) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const std::size_t n = state.exact.flights.size();
  struck_ = false;
  flightsSeen_.resize(n, 1);  // the first begin with the run
  std::vector<double> changes;
  for (std::size_t i = 0; i < n; ++i) {
    const long fresh = state.exact.flightCount[i] - flightsSeen_[i];
    const std::vector<Flight>& flights = state.exact.flights[i];
    const std::size_t first = flights.size() - std::min<std::size_t>(flights.size(), fresh);
    for (std::size_t k = first; k < flights.size() && !coarse_; ++k)
      changes.push_back(flights[k].start());
    flightsSeen_[i] = state.exact.flightCount[i];
  }
  std::sort(changes.begin(), changes.end());
  changes.erase(std::unique(changes.begin(), changes.end()), changes.end());

  const double end = model_.def.duration;
  const double spacing = std::max(end / kLooks, 1.0 / kLooksPerSecond);
  auto change = changes.begin();
  auto part = state.trail.begin();
  while (part != state.trail.end() && part->t1 <= t_) ++part;
  for (;;) {
    const double atChange = change != changes.end() ? *change : kNever;
    const double atPart = part != state.trail.end() ? part->t0 : kNever;
    double atLook = std::min(static_cast<double>(looks_) * spacing, end);
    if (atLook > state.t || looks_ > std::ceil(end / spacing)) atLook = kNever;
    const double next = std::min({atChange, atPart, atLook});
    if (next == kNever) break;
    // What flies does so until then; what was followed in contact has been seen.
    if (next < t_) {
      atLook <= next ? void(++looks_) : atChange <= next ? void(++change) : void(++part);
      continue;
    }
    if (next > t_) bodiesInFlight(state, next, true, scratch_), see(next, scratch_, coarse_);
    if (atLook <= next) {
      ++looks_;
    } else if (atChange <= next) {
      bodiesInFlight(state, next, false, scratch_), see(next, scratch_);
      ++change;
    } else {
      see(part->t0, part->start);
      see(part->t1, part->end);
      ++part;
    }
  }
}

}  // namespace tumble
