#include "sim/method/exact/sustained.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collide/collide.h"
#include "sim/math/root.h"

namespace tumble {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Error of a step in each number of Y, relative to 1 + |y|.
constexpr double kTolerance = 1e-13;
/// [s], [rad] What is looked ahead at once; balls look the same from all sides.
constexpr double kLongest = 0.25, kTurn = 0.5, kTurnRound = 5.0;
/// [m] per size of the world: overlap that dates an event of a pair that touches already.
constexpr double kOff = 1e-12;
/// Part of a stretch below which no closer look is taken at what may have happened unseen.
constexpr double kClosest = 1.0 / 64.0;
/// [s] A stretch that is shorter stands still; so many in a row are too many.
constexpr double kInstant = 1e-12;
constexpr int kPatience = 40;
/// [s] The first stretch that is gone blindly after that.
constexpr double kBlind = 1e-9;

bool allFinite(std::span<const double> y) {
  return std::all_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); });
}

bool sameFeature(const Contact& c, const Contact& d) {
  return c.a == d.a && c.b == d.b && c.point.feature == d.point.feature;
}

}  // namespace

Sustained::Sustained(const Model& model, State& state, Report& report)
    : model_(model),
      state_(state),
      report_(report),
      tolerance_(ContactTolerance::forSize(model.size)),
      system_(model, state.bodies),
      integrator_(system_.size(), kTolerance),
      y0_(static_cast<std::size_t>(system_.size())),
      y_(y0_),
      trial_(state.bodies) {}

void Sustained::next() {
  chooseModes();
  system_.begin(state_.lasting);
  system_.pack(state_.bodies, y0_);
  trial_ = state_.bodies;
  system_.findForces(trial_);
  const double most = most_ = lookAhead();
  findNear(most);
  if (report_.stopped) return;
  const bool blind = state_.stalled > kPatience;
  double h = blind ? std::min(most, std::ldexp(kBlind, std::min(state_.blindness++, 16))) : most;
  const double now = allowance(0.0);
  bool event = false;
  while (!event && !blind) {
    const double end = now > 0.0 ? allowance(h) : now;
    if (now > 0.0 && reached_ < h) {  // forces change faster and faster
      h = 0.9 * reached_;
      state_.jammed = event = h < kInstant;
    } else if (end < 0.0) {
      event = true;
      if (!(now > 0.0)) {
        h = 0.0;
        break;
      }
      const double instant =
          std::max(1e-15, std::numeric_limits<double>::epsilon() * (state_.t + h));
      const Bracket bracket =
          findRoot([&](double s) { return allowance(s); }, 0.0, h, now, end, instant);
      h = bracket.hi;
      if (allowance(h) < 0.0 && cause_ == Cause::Touch) h = bracket.lo;
    } else if (const double earlier = sooner(h); earlier < h) {
      h = earlier;
    } else {
      break;
    }
  }
  if (blind)
    report_.note("more events than time can hold were seen late; max_penetration has the cost");
  if (!blind && h > kInstant)
    state_.stalled = state_.blindness = 0;
  else
    state_.stalled = blind ? kPatience - 4 : state_.stalled + 1;
  allowance(h);
  commit(h);
  if (event || blind || --state_.stretchesLeft <= 0 || state_.lasting.empty()) leave();
}

void Sustained::leave() {
  state_.sustained = false;
  state_.settled = true;
}

double Sustained::lookAhead() const {
  double h = std::min(kLongest, model_.def.duration - state_.t);
  for (const int i : model_.solid) {
    const RigidBody& body = trial_[i];
    if (body.fixed()) continue;
    const bool round = std::all_of(state_.parts[i].begin(), state_.parts[i].end(),
                                   [](const Convex& part) { return part.outline.corner == 0.0; });
    const double turn = round ? kTurnRound : kTurn;
    const double speed = body.omega.norm(), rate = (body.Iinv * body.torque).norm();
    if (speed * h > turn) h = turn / speed;
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
  const RigidBody &a = trial_[ia], &b = trial_[ib];
  const auto turning = [&](int i) {
    double corner = 0.0;
    for (const Convex& part : state_.parts[i]) corner = std::max(corner, part.outline.corner);
    return trial_[i].omega.norm() * corner;
  };
  const HalfSpace* plane = std::get_if<HalfSpace>(&model_.shapes[ib]);
  if (!plane) plane = std::get_if<HalfSpace>(&model_.shapes[ia]);
  const Vec3 relative = a.v - b.v;
  const double bend = 2.0 * (a.invM * a.force - b.invM * b.force).norm();
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
  watched_.clear();
  if (stopAtUnknownPair(model_, state_.near, report_)) return;
  std::vector<Contact> points;
  for (const auto& [b, a] : state_.near) {
    Near pair{.b = b, .a = a, .speed = speedBound(a, b, h)};
    pair.lasts = std::any_of(state_.lasting.begin(), state_.lasting.end(),
                             [&, b = b, a = a](const Contact& c) { return c.a == a && c.b == b; });
    pair.now = separation(model_.shapes[a], state_.bodies[a].pose(), model_.shapes[b],
                          state_.bodies[b].pose());
    if (!pair.lasts && pair.now > pair.speed * h) continue;
    const double slack = kOff * std::max(1.0, model_.size);
    pair.floor = pair.now < tolerance_.touch ? std::min(-slack, pair.now - 0.1 * slack) : 0.0;
    near_.push_back(pair);
    if (!pair.lasts) continue;
    points.clear();
    findContacts(model_, state_.bodies, {b, a}, std::max(tolerance_.touch, pair.speed * h), points);
    for (Contact& c : points) {
      c.anchor = anchorOf(state_.bodies[a], state_.bodies[b], c.point);
      if (c.point.separation > tolerance_.touch) watched_.push_back(c);
    }
  }
}

double Sustained::allowance(double h) {
  cause_ = Cause::None;
  y_ = y0_;
  reached_ = h == 0.0 ? 0.0 : integrator_.step(system_, state_.t, h, y_);
  if (!allFinite(y_)) return 1.0;  // commit() reports it
  system_.unpack(y_, trial_);
  double least = kInfinity;
  for (const Near& pair : near_)
    least = std::min(least, separation(model_.shapes[pair.a], trial_[pair.a].pose(),
                                       model_.shapes[pair.b], trial_[pair.b].pose()) -
                                pair.floor);
  if (least < 0.0) cause_ = Cause::Touch;
  const double mode = modeAllowance();
  if (mode < least) {
    least = mode;
    cause_ = Cause::Mode;
  }
  if (h > 0.0 && least > 0.0 && featuresChanged()) {
    least = -1.0;
    cause_ = Cause::Mode;
  }
  return least;
}

// Whether a pair that touches would be found to touch in another way. Rims are followed.
bool Sustained::featuresChanged() const {
  std::vector<Contact> found;
  const double close = kOff * std::max(1.0, model_.size);
  for (const Near& pair : near_) {
    if (!pair.lasts) continue;
    const auto ofPair = [&](const Contact& c) { return c.a == pair.a && c.b == pair.b; };
    const std::vector<Contact>& held = system_.contacts();
    if (std::any_of(held.begin(), held.end(),
                    [&](const Contact& c) { return ofPair(c) && c.anchor.rim.r > 0.0; }))
      continue;
    found.clear();
    findContacts(model_, trial_, {pair.b, pair.a}, tolerance_.touch, found);
    const auto lists = [](const std::vector<Contact>& list, const Contact& c) {
      return std::any_of(list.begin(), list.end(),
                         [&](const Contact& d) { return sameFeature(c, d); });
    };
    for (const Contact& c : held)
      if (ofPair(c) && !lists(found, c)) return true;
    for (const Contact& c : found)
      if (c.point.separation < close && !lists(held, c)) return true;
  }
  return false;
}

double Sustained::sooner(double h) const {
  // The direction of a slip that turns too far would be taken for its end.
  for (std::size_t k = 0; k < state_.lasting.size(); ++k) {
    const Contact& c = system_.contacts()[k];
    if (!c.sliding || slip_[k] <= tolerance_.stick) continue;
    const Vec3 slip = slipVelocity(trial_[c.a], trial_[c.b], c.point);
    if (slip.dot(c.slipDirection) >= 0.5 * slip.norm()) continue;
    return h > kInstant ? 0.5 * h : h;
  }
  if (h <= kClosest * most_) return h;
  for (const Near& pair : near_) {
    if (pair.lasts) continue;
    const double end = separation(model_.shapes[pair.a], trial_[pair.a].pose(),
                                  model_.shapes[pair.b], trial_[pair.b].pose());
    if (pair.now + end < pair.speed * h) return 0.5 * h;
  }
  double least = h;
  for (const Contact& point : watched_) least = std::min(least, dip(point, h));
  return least;
}

// When the cubic through both ends dips below the surface between them; h if it does not.
double Sustained::dip(const Contact& point, double h) const {
  Contact end = point;
  follow(trial_[point.a], trial_[point.b], end);
  const double g0 = point.point.separation, g1 = end.point.separation;
  const double v0 = approachVelocity(state_.bodies[point.a], state_.bodies[point.b], point.point);
  const double v1 = approachVelocity(trial_[point.a], trial_[point.b], end.point);
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

void Sustained::commit(double h) {
  Certificate& books = report_.certificate;
  if (!allFinite(y_)) {
    report_.stopped = true;
    report_.reason = "the motion left the range of numbers at t = " + shortNumber(state_.t) + " s";
    return;
  }
  const double t1 = h < model_.def.duration - state_.t ? state_.t + h : model_.def.duration;
  if (t1 > state_.t)
    state_.trail.push_back(
        {.t0 = state_.t, .t1 = t1, .start = state_.bodies, .end = {}, .contacts = state_.lasting});
  state_.bodies = trial_;
  state_.lasting = system_.contacts();
  for (const Near& pair : near_)
    books.max_penetration =
        std::max(books.max_penetration, -separation(model_.shapes[pair.a], trial_[pair.a].pose(),
                                                    model_.shapes[pair.b], trial_[pair.b].pose()));
  const SustainedSystem::Books done = system_.books(y_);
  books.work_of_forces += done.work;
  books.energy_lost_friction += done.rubbed;
  state_.externalImpulse += done.impulse;
  books.evaluations += system_.evaluations() - counted_;
  counted_ = system_.evaluations();
  state_.t = t1;
  ++books.steps;
  account(model_, state_, report_);
}

void lookSustained(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
                   std::vector<Contact>& contacts) {
  const Segment* segment = nullptr;
  for (const Segment& s : state.trail)
    if (s.t0 <= t) segment = &s;
  const bool now = !segment || t >= state.t;
  bodies = now ? state.bodies : segment->start;
  SustainedSystem system(model, bodies);
  system.begin(now ? state.lasting : segment->contacts);
  if (!now && t > segment->t0) {
    std::vector<double> y(static_cast<std::size_t>(system.size()));
    system.pack(bodies, y);
    Extrapolation(system.size(), kTolerance).step(system, segment->t0, t - segment->t0, y);
    system.unpack(y, bodies);
  }
  system.findForces(bodies);
  contacts = system.contacts();
}

}  // namespace tumble
