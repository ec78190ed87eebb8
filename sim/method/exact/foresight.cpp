// How far to look ahead at once, what may be met there, and what may have happened unseen.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "sim/collide/collide.h"
#include "sim/method/exact/sustained.h"

namespace tumble {
namespace {

/// [s], [rad] What is looked ahead at once; balls look the same from all sides, and only what
/// changes their spin turns them against a steady turn.
constexpr double kLongest = 0.25, kTurn = 0.5, kTurnRound = 5.0;
/// [m] per size of the world: overlap that dates an event of a pair that touches already.
constexpr double kOff = 1e-12;
/// Part of a stretch below which no closer look is taken at what may have happened unseen.
constexpr double kClosest = 1.0 / 64.0;

/// When the cubic through both ends of a span h [s], at heights g [m] and rates v [m/s], dips below
/// zero between them; h if it does not.
double dip(double g0, double g1, double v0, double v1, double h) {
  if (v0 >= 0.0 || v1 <= 0.0) return h;
  constexpr int kLooks = 16;
  double lowest = 0.0, when = h;
  for (int k = 1; k < kLooks; ++k) {
    const double s = static_cast<double>(k) / kLooks, r = 1.0 - s;
    const double gap =
        r * r * (1.0 + 2.0 * s) * g0 + s * s * (1.0 + 2.0 * r) * g1 + h * s * r * (r * v0 - s * v1);
    if (gap < lowest) lowest = gap, when = s * h;
  }
  return when;
}

}  // namespace

double Sustained::lookAhead() const {
  double h = std::min(kLongest, model_.def.duration - state_.t);
  for (const int i : model_.solid) {
    const RigidBody& body = trial_[i];
    if (body.fixed()) continue;
    const bool round = std::all_of(state_.exact.parts[i].begin(), state_.exact.parts[i].end(),
                                   [](const Convex& part) { return part.outline.corner == 0.0; });
    const double turn = round ? kTurnRound : kTurn;
    const double speed = body.omega.norm(), rate = (body.Iinv * body.torque).norm();
    if (!round && speed * h > turn) h = turn / speed;
    if (rate * h * h > 2.0 * turn) h = std::sqrt(2.0 * turn / rate);
  }
  // Not far beyond the end of a slip.
  for (const Contact& c : system_.contacts()) {
    if (!c.sliding || c.idle) continue;
    const RigidBody &a = trial_[c.a], &b = trial_[c.b];
    const Vec3 slip = slipVelocity(a, b, c.point);
    const double brake = -slipAcceleration(a, b, c.point).dot(slip), square = slip.squaredNorm();
    if (brake * h > 1.5 * square && square > tolerance_.stick * tolerance_.stick)
      h = 1.5 * square / brake;
  }
  return h;
}

double Sustained::speedBound(int ia, int ib, double h) const {
  constexpr double kMore = 2.0;  // times that forces may grow
  const RigidBody &a = trial_[ia], &b = trial_[ib];
  const auto turning = [&](int i) {
    const RigidBody& body = trial_[i];
    double corner = 0.0;
    for (const Convex& part : state_.exact.parts[i]) corner = std::max(corner, part.outline.corner);
    const double rate = (body.Iinv * (body.torque - body.omega.cross(body.L))).norm();
    return corner * (body.omega.norm() + kMore * rate * h);
  };
  const HalfSpace* plane = std::get_if<HalfSpace>(&model_.shapes[ib]);
  if (!plane) plane = std::get_if<HalfSpace>(&model_.shapes[ia]);
  const Vec3 relative = a.v - b.v;
  const double bend = kMore * (a.invM * a.force - b.invM * b.force).norm();
  return (plane ? std::abs(plane->n.dot(relative)) : relative.norm()) + turning(ia) + turning(ib) +
         bend * h;
}

void Sustained::findNear(double h) {
  double fastest = acceleration_;
  for (const RigidBody& body : trial_) fastest = std::max(fastest, body.invM * body.force.norm());
  std::vector<Aabb> boxes;
  sweptBoxes(model_, state_.bodies, h, fastest, tolerance_.touch, boxes);
  state_.near = nearPairs(model_, state_, boxes);
  near_.clear();
  apart_.clear();
  watched_.clear();
  touching_.clear();
  if (stopAtUnknownPair(model_, state_.near, report_)) return;
  std::vector<Contact> points;
  const auto held = [&](const Contact& c) {
    return std::any_of(state_.lasting.begin(), state_.lasting.end(), [&](const Contact& d) {
      return c.a == d.a && c.b == d.b && c.point.feature == d.point.feature;
    });
  };
  for (const auto& [b, a] : state_.near) {
    Near pair{.b = b, .a = a, .speed = speedBound(a, b, h)};
    pair.lasts = std::any_of(state_.lasting.begin(), state_.lasting.end(),
                             [&, b = b, a = a](const Contact& c) { return c.a == a && c.b == b; });
    pair.now = separation(model_.shapes[a], state_.bodies[a].pose(), model_.shapes[b],
                          state_.bodies[b].pose());
    if (!pair.lasts && pair.now > pair.speed * h) {
      apart_.push_back(pair);
      continue;
    }
    const double slack = kOff * ContactTolerance::scaleOf(model_.size);
    pair.floor = pair.now < tolerance_.touch ? std::min(-slack, pair.now - 0.1 * slack) : 0.0;
    near_.push_back(pair);
    if (!pair.lasts) continue;
    points.clear();
    findContacts(model_, state_.bodies, {b, a}, std::max(tolerance_.touch, pair.speed * h), points);
    for (Contact& c : points) {
      c.anchor = anchorOf(state_.bodies[a], state_.bodies[b], c.point);
      const bool touches = c.point.separation <= tolerance_.touch;
      if (touches) touching_.push_back(c);
      if (!touches || !held(c)) watched_.push_back(c);
    }
  }
}

// Their forces grew more than was foreseen.
bool Sustained::metUnseen() {
  const auto meets = [&](const Near& pair) {
    return separation(model_.shapes[pair.a], trial_[pair.a].pose(), model_.shapes[pair.b],
                      trial_[pair.b].pose()) < pair.floor;
  };
  const auto met = std::partition(apart_.begin(), apart_.end(), std::not_fn(meets));
  const bool any = met != apart_.end();
  near_.insert(near_.end(), met, apart_.end());
  apart_.erase(met, apart_.end());
  return any;
}

// Those that have sunk below have left the face that they would have touched.
double Sustained::lowestWatched() const {
  const double close = kOff * ContactTolerance::scaleOf(model_.size);
  double least = std::numeric_limits<double>::infinity();
  for (Contact point : watched_) {
    follow(trial_[point.a], trial_[point.b], point);
    const double height = point.point.separation - close;
    if (height > 0.0) least = std::min(least, height);
  }
  return least;
}

// What begins to slip finds its direction until it is well beyond its onset.
bool Sustained::slipTurned() const {
  constexpr double kFar = 2.0;
  for (std::size_t k = 0; k < state_.lasting.size(); ++k) {
    const Contact& c = system_.contacts()[k];
    if (!c.sliding) continue;
    const Vec3 slip = slipVelocity(trial_[c.a], trial_[c.b], c.point);
    const double told = slip_[k] <= tolerance_.stick ? kFar * onset_ : tolerance_.stick;
    if (slip.norm() > told && hasTurned(c, slip)) return true;
  }
  return false;
}

bool Sustained::slipBegan() const {
  for (std::size_t k = 0; k < state_.lasting.size(); ++k) {
    const Contact& c = system_.contacts()[k];
    if (!c.sliding || c.idle) continue;
    const Vec3 slip = slipVelocity(trial_[c.a], trial_[c.b], c.point);
    const bool turns = slip_[k] <= tolerance_.stick && hasTurned(c, slip);
    if ((c.onset > 0.0 || turns) && slip.norm() >= onset_) return true;
  }
  return false;
}

double Sustained::doubt(const Look& lo, const Look& hi) const {
  const double span = hi.s - lo.s;
  if (span <= kClosest * most_) return hi.s;
  for (std::size_t k = 0; k < near_.size(); ++k)
    if (!near_[k].lasts && lo.gaps[k] + hi.gaps[k] < near_[k].speed * span)
      return lo.s + 0.5 * span;
  double least = hi.s;
  for (std::size_t k = 0; k < watched_.size(); ++k)
    least =
        std::min(least, lo.s + dip(lo.heights[k], hi.heights[k], lo.rates[k], hi.rates[k], span));
  return least;
}

}  // namespace tumble
