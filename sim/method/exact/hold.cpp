// What stays in contact: constant forces that hold it, or a stretch of motion that follows them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/contact/jam.h"
#include "sim/contact/modes.h"
#include "sim/contact/rest.h"
#include "sim/method/exact/exact.h"

namespace tumble {
namespace {

/// Forces and accelerations below this part of the largest are rounding.
constexpr double kRounding = 1e-10;
/// Accelerations together below this part of the weights are that of bodies that fall as one.
constexpr double kWeightless = 1e-13;
/// Approach that a law of impact may leave, in speeds of rest.
constexpr double kLeft = 100.0;
/// What parts at less than this part of its weight, and of what turning bends, has just been pushed
/// still.
constexpr double kSlow = 1e-4;
/// Residual of contact forces that are no solution.
constexpr double kLawless = 1e-6;
/// Stretches before closed forms are tried again: the first time, and at most.
constexpr int kFirst = 1, kMost = 64;

}  // namespace

bool Exact::lasts(int i, int j) const {
  const auto [b, a] = std::minmax(i, j);
  return std::any_of(state_.lasting.begin(), state_.lasting.end(),
                     [&, b = b, a = a](const Contact& c) { return c.a == a && c.b == b; });
}

std::vector<Contact> Exact::restingOf(const Cluster& cluster) const {
  std::vector<Contact> resting;
  for (Contact c : cluster.contacts) {
    const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
    const double vrel = approachVelocity(a, b, c.point);
    const bool rests = vrel <= tolerance_.rest && vrel >= -kLeft * tolerance_.rest;
    if (!rests && !endsBounces(c, vrel)) continue;
    c.lasting = true;
    c.anchor = anchorOf(a, b, c.point);
    const Vec3 slip = slipVelocity(a, b, c.point);
    c.sliding = c.friction > 0.0 && slip.norm() > tolerance_.stick;
    if (c.sliding) c.slipDirection = slip.normalized();
    resting.push_back(c);
  }
  return resting;
}

double Exact::weightOn(const Contact& c) const {
  return state_.bodies[c.a].invM * state_.exact.outer[c.a].norm() +
         state_.bodies[c.b].invM * state_.exact.outer[c.b].norm();
}

// The last hit of a row of bounces may lift other points of the pair, as little as the bounces that
// are left out would have.
bool Exact::endsBounces(const Contact& c, double vrel) const {
  return std::any_of(ends_.begin(), ends_.end(),
                     [&](const auto& end) { return end.first == Pair(c.b, c.a); }) &&
         0.5 * vrel * vrel < lowest() * weightOn(c);
}

namespace {

/// The bodies that contacts hold, numbered anew.
struct Held {
  Held(std::span<const RigidBody> all, std::vector<Contact> those);

  std::vector<Contact> contacts;
  std::vector<RigidBody> bodies;
  std::vector<int> global;  ///< their numbers among all
};

Held::Held(std::span<const RigidBody> all, std::vector<Contact> those)
    : contacts(std::move(those)) {
  std::vector<int> local(all.size(), -1);
  for (Contact& c : contacts)
    for (int* i : {&c.a, &c.b}) {
      if (local[*i] < 0) {
        local[*i] = static_cast<int>(bodies.size());
        global.push_back(*i);
        bodies.push_back(all[*i]);
      }
      *i = local[*i];
    }
}

}  // namespace

// Where nothing presses, as in a stack that falls, there is nothing to be found but rounding.
// Without weights there is no measure for it.
bool Exact::presses(const Contact& c) const {
  const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
  const double weight = weightOn(c);
  return weight == 0.0 || normalAcceleration(a, b, c.point) < -kWeightless * weight;
}

double Exact::solveForces(std::vector<Contact>& resting) {
  if (std::none_of(resting.begin(), resting.end(), [&](const Contact& c) { return presses(c); })) {
    for (Contact& c : resting) c.force.setZero();
    return 0.0;
  }
  Held held(state_.bodies, resting);
  for (std::size_t k = 0; k < held.bodies.size(); ++k) {
    held.bodies[k].force = state_.exact.outer[held.global[k]];
    held.bodies[k].torque.setZero();
  }
  const SolveReport solved = RestForces(true).apply(held.bodies, held.contacts);
  ++report_.certificate.evaluations;
  for (std::size_t k = 0; k < held.bodies.size(); ++k) {
    state_.bodies[held.global[k]].force = held.bodies[k].force;
    state_.bodies[held.global[k]].torque = held.bodies[k].torque;
  }
  for (std::size_t k = 0; k < resting.size(); ++k) resting[k].force = held.contacts[k].force;
  return solved.residual;
}

// A contact lasts with a constant force if its normal and its gap stay: faces that do not turn, and
// on them balls, or bodies that do not turn either; other features if nothing moves along them.
bool Exact::steady(const Contact& c) const {
  const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
  const Vec3 n = c.point.n;
  const double size = ContactTolerance::scaleOf(model_.size), still = tolerance_.rest / size;
  const auto turnsAlong = [&](const RigidBody& body) {  // steadily about n, or not at all
    if (body.particle) return true;
    if (body.omega.cross(n).norm() > still) return false;
    return body.fixed() || body.omega.cross(body.L).norm() <= kRounding * body.L.norm();
  };
  const auto torqueFree = [&](const RigidBody& body, int i) {
    const double scale = boundingRadius(model_.shapes[i]) * body.force.norm() +
                         boundingRadius(model_.shapes[i]) * state_.exact.outer[i].norm();
    return body.fixed() || body.torque.norm() <= kRounding * scale;
  };
  if (!torqueFree(a, c.a) || !torqueFree(b, c.b)) return false;
  const bool onB = c.point.tie == NormalTie::FaceOfB, onA = c.point.tie == NormalTie::FaceOfA;
  const Vec3 slip = slipVelocity(a, b, c.point);
  const Vec3 pull = pointAcceleration(a, c.point.p) - pointAcceleration(b, c.point.p);
  const double weight = weightOn(c);
  const Vec3 slipRate = pull - pull.dot(n) * n;
  const bool slides = slip.norm() > tolerance_.stick || slipRate.norm() > kRounding * weight;
  if (!onA && !onB) return !slides && a.omega.norm() <= still && b.omega.norm() <= still;
  const RigidBody &owner = onB ? b : a, &other = onB ? a : b;
  // A ball about the centre of mass touches where it touches, however it turns.
  const double round = onB ? c.point.ra : c.point.rb;
  const Vec3& middle = onB ? c.point.pa : c.point.pb;
  // Only a plane has no edge to slide, or roll, over.
  const bool endless = std::holds_alternative<HalfSpace>(model_.shapes[onB ? c.b : c.a]);
  const bool rolls =
      (placeVelocity(a, b, c.point) - pointVelocity(owner, c.point.p)).norm() > tolerance_.stick;
  if (rolls && !endless) return false;
  const bool ball = round > 0.0 && (middle - other.x).norm() <= tolerance_.touch;
  if (!turnsAlong(owner) || !(ball || turnsAlong(other))) return false;
  if (!slides) return true;
  // A slip that friction brakes keeps its line.
  const bool straight =
      c.friction == 0.0 || slip.cross(slipRate).norm() <= kRounding * slip.norm() * weight;
  return endless && straight;
}

// What is left of velocities along the normals of contacts that last, and of the slips of those
// that stick, is below tolerances; in the long run it would move them.
void Exact::stillContacts(const std::vector<Contact>& resting) {
  const bool still = std::all_of(resting.begin(), resting.end(), [&](const Contact& c) {
    const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
    const bool slips = c.friction > 0.0 && !c.sliding && !slipVelocity(a, b, c.point).isZero(0.0);
    return approachVelocity(a, b, c.point) == 0.0 && !slips;
  });
  if (still) return;
  Held held(state_.bodies, resting);
  const std::vector<Vec3> impulses = ModeForces().still(held.bodies, held.contacts);
  for (std::size_t k = 0; k < held.bodies.size(); ++k)
    if (!held.bodies[k].fixed()) state_.bodies[held.global[k]] = held.bodies[k];
  for (std::size_t k = 0; k < resting.size(); ++k) {
    if (model_.fixed(resting[k].b)) state_.externalImpulse += impulses[k];
    if (model_.fixed(resting[k].a)) state_.externalImpulse -= impulses[k];
  }
}

double Exact::findForces(double t, const Cluster& cluster, std::vector<Contact>& resting) {
  const auto solve = [&] {
    for (const int i : cluster.bodies) {
      state_.bodies[i].force = state_.exact.outer[i];
      state_.bodies[i].torque.setZero();
    }
    resting = restingOf(cluster);
    return resting.empty() ? 0.0 : solveForces(resting);
  };
  double residual = solve();
  for (int jams = 0; jams < kJams && endJam(t, cluster, resting, residual); ++jams)
    residual = solve();
  return residual;
}

bool Exact::letGo(std::vector<Contact>& resting) const {
  double strongest = 0.0;
  for (const Contact& c : resting) strongest = std::max(strongest, c.force.norm());
  bool slowly = false;
  std::erase_if(resting, [&](const Contact& c) {
    const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
    const double apart = normalAcceleration(a, b, c.point);
    const double weight = weightOn(c);
    const double turning = a.omega.squaredNorm() * (c.point.p - a.x).norm() +
                           b.omega.squaredNorm() * (c.point.p - b.x).norm();
    const bool goes = c.force.norm() <= kRounding * strongest && apart > kRounding * weight;
    slowly = slowly || (goes && apart < kSlow * (weight + turning));
    return goes;
  });
  return slowly;
}

/// Whether something slips another way than that for which its friction was found: what is left of
/// other velocities may be more than a slip, and friction along it would drive it for ever.
bool Exact::slipTurned(const std::vector<Contact>& resting) const {
  return std::any_of(resting.begin(), resting.end(), [&](const Contact& c) {
    return c.sliding && hasTurned(c, slipVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point));
  });
}

void Exact::hold(double t, Cluster& cluster) {
  constexpr int kAgain = 3;  // a slip that friction was found for may turn as it is stilled
  std::vector<Contact> resting;
  bool slowly = false, turned = true;
  for (int k = 0; turned && k < kAgain; ++k) {
    const double residual = findForces(t, cluster, resting);
    if (residual > kLawless) {
      state_.exact.lawless = true;
      return sustain(t, cluster);
    }
    double& worst = report_.certificate.max_complementarity;
    worst = std::max(worst, residual);
    slowly = letGo(resting);
    if (!resting.empty()) stillContacts(resting);
    turned = slipTurned(resting);
  }
  const std::vector<Contact> before = changeHolds(t, cluster, resting);
  // What parts as slowly as a push that ends is followed until there is a gap to be seen.
  if (slowly || turned ||
      !std::all_of(resting.begin(), resting.end(), [&](const Contact& c) { return steady(c); }))
    return sustain(t, cluster);
  flyOn(t, cluster);
  for (const Contact& c : before)
    if (!lasts(c.a, c.b)) lookFor({c.b, c.a}, t);
  lookForStops(t);
  // Many new flights make the rest of the window worthless: begin another.
  ExactMemory::Window& w = state_.exact.window;
  const long most = 64 + 4 * static_cast<long>(w.finite.size());
  if (w.renewals > most && w.swept.size() > 64 && t > w.t0) {
    w.length = t - w.t0;
    w.t1 = t;
    keepBooks(t);
  }
}

void Exact::flyOn(double t, const Cluster& cluster) {
  std::vector<int> renewed;
  for (const int i : cluster.bodies) {
    const RigidBody& body = state_.bodies[i];
    if (body.fixed()) continue;
    Vec3 acceleration = body.invM * body.force;
    const bool pushed = body.force != state_.exact.outer[i];
    if (pushed && acceleration.norm() <= kRounding * body.invM * state_.exact.outer[i].norm())
      acceleration.setZero();
    RigidBody unchanged = body;
    state_.exact.flights[i].back().at(t, unchanged);
    if (unchanged.P == body.P && unchanged.L == body.L &&
        state_.exact.flights[i].back().path().g == acceleration)
      continue;
    renew(t, i, acceleration);
    renewed.push_back(i);
  }
  for (const int i : renewed) lookAround(i, t);
  state_.exact.window.renewals += static_cast<long>(renewed.size());
}

/// What rolls, tips or slides over an edge has no closed form here.
void Exact::sustain(double t, const Cluster& cluster) {
  for (const int i : cluster.bodies)
    if (!model_.fixed(i)) renew(t, i, state_.bodies[i].invM * state_.exact.outer[i]);
  keepBooks(t);
  if (!state_.exact.sustained) {
    state_.exact.patience = std::clamp(2 * state_.exact.patience, kFirst, kMost);
    state_.exact.stretchesLeft = state_.exact.patience;
  }
  state_.exact.sustained = true;
  state_.exact.modesKnown = false;
}

/// Friction that brakes along a line ends a slip at a known instant.
void Exact::lookForStops(double t) {
  for (const Contact& c : state_.lasting) {
    if (!c.sliding) continue;
    bringTo(t, c.a);
    bringTo(t, c.b);
    const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
    const Vec3 slip = slipVelocity(a, b, c.point);
    const Vec3 rate =
        state_.exact.flights[c.a].back().path().g - state_.exact.flights[c.b].back().path().g;
    const double brake = -rate.dot(slip) / slip.norm();
    const double end = t + slip.norm() / brake;
    if (brake > 0.0 && slip.norm() > tolerance_.stick && end < state_.exact.window.t1)
      push(end, c.a, c.b);
  }
}

void Exact::renew(double t, int i, const Vec3& acceleration) {
  std::vector<Flight>& flights = state_.exact.flights[i];
  if (!flights.empty() && flights.back().start() == t) flights.pop_back();
  flights.emplace_back(state_.bodies[i], acceleration, t);
  ++state_.exact.flightCount[i];
  ++report_.certificate.steps;
}

std::vector<Contact> Exact::changeHolds(double t, const Cluster& cluster,
                                        const std::vector<Contact>& now) {
  const auto inCluster = [&](const Contact& c) {
    const auto has = [&](int body) {
      return !model_.fixed(body) &&
             std::find(cluster.bodies.begin(), cluster.bodies.end(), body) != cluster.bodies.end();
    };
    return has(c.a) || has(c.b);
  };
  std::vector<Contact> before;
  std::copy_if(state_.lasting.begin(), state_.lasting.end(), std::back_inserter(before), inCluster);
  if (before.empty() && now.empty()) return before;
  bookHolds(t);
  std::erase_if(state_.lasting, inCluster);
  state_.lasting.insert(state_.lasting.end(), now.begin(), now.end());
  std::stable_sort(
      state_.lasting.begin(), state_.lasting.end(),
      [](const Contact& p, const Contact& q) { return std::pair(p.b, p.a) < std::pair(q.b, q.a); });
  if (!state_.exact.holds.empty() && state_.exact.holds.back().t == t)
    state_.exact.holds.pop_back();
  state_.exact.holds.push_back({t, state_.lasting});

  // A rest at the end of a row of bounces is told when the last of them would be over.
  Report changes;
  recordChanges(before, now, state_.bodies, t, changes);
  for (Event event : changes.events) {
    const auto same = [&](const Event& e) { return e.a == event.a && e.b == event.b; };
    if (event.kind == EventKind::Separate && std::erase_if(state_.exact.closing, same) > 0)
      continue;
    for (const auto& [pair, end] : ends_)
      if (event.kind == EventKind::Rest && pair == Pair(event.b, event.a))
        event.t = std::max(event.t, end);
    (event.t > t ? state_.exact.closing : report_.events).push_back(event);
  }
  return before;
}

void Exact::closeRests(double t) {
  std::stable_sort(state_.exact.closing.begin(), state_.exact.closing.end(),
                   [](const Event& p, const Event& q) { return p.t < q.t; });
  while (!state_.exact.closing.empty() && state_.exact.closing.front().t <= t) {
    const Event event = state_.exact.closing.front();
    state_.exact.closing.erase(state_.exact.closing.begin());
    const auto place = std::upper_bound(report_.events.begin(), report_.events.end(), event,
                                        [](const Event& p, const Event& q) { return p.t < q.t; });
    report_.events.insert(place, event);
  }
}

}  // namespace tumble
