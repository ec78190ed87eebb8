// A ball that flies straight at a floor of springs: half a period of an oscillator; at a rigid
// floor an impulse.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "app/claim/free_body.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Flight towards a floor along its normal.
struct Approach {
  int body = 0, floor = 0;
  double mass = 1.0;    // [kg]
  double begins = 0.0;  // [s] of the touch
  double speed = 0.0;   // [m/s] then, > 0
  double pull = 0.0;    // [m/s²] acceleration towards the floor by all other forces
  double e = 0.0;
};

std::optional<Approach> approachOf(const WorldDef& world, int body, int floor) {
  const BodyDef& flyer = world.bodies[body];
  const Sphere* ball = std::get_if<Sphere>(&flyer.shape);
  const HalfSpace* plane = std::get_if<HalfSpace>(&world.bodies[floor].shape);
  const std::optional<Vec3> acceleration = freeAcceleration(world, body);
  if (!ball || !plane || !acceleration || !world.bodies[floor].velocity.isZero()) return {};
  const Surface surface = surfaceOf(world, body, floor);
  if (surface.friction > 0.0) return {};
  const double gap = plane->n.dot(flyer.position) - plane->d - ball->r;
  const double v = -plane->n.dot(flyer.velocity), pull = -plane->n.dot(*acceleration);
  // gap = v t + ½ pull t², the first time ahead.
  const double hit = v * v + 2.0 * pull * gap;
  if (gap <= 0.0 || hit <= 0.0 || (v <= 0.0 && pull <= 0.0)) return {};
  const double speed = std::sqrt(hit);
  return Approach{body,  floor, bodyMass(flyer),    2.0 * gap / (v + speed),
                  speed, pull,  surface.restitution};
}

std::vector<Approach> approachesOf(const Scene& scene) {
  std::vector<Approach> found;
  const int count = static_cast<int>(scene.world.bodies.size());
  for (int body = 0; body < count; ++body) {
    if (!moves(scene.world.bodies[body])) continue;
    std::optional<Approach> first;
    for (int floor = 0; floor < count; ++floor) {
      const std::optional<Approach> one = approachOf(scene.world, body, floor);
      if (one && (!first || one->begins < first->begins)) first = one;
    }
    if (first) found.push_back(*first);
  }
  return found;
}

// The oscillator of the time in touch:  m d″ = m a − k d − c d′,  d(0) = 0,  d′(0) = v.
struct Oscillator {
  double m, k, c, a, v;
  double decay() const { return 0.5 * c / m; }                           // [1/s]
  double omega() const { return std::sqrt(k / m - decay() * decay()); }  // [rad/s] damped
  double middle() const { return m * a / k; }                            // [m] where it would rest

  double depth(double t) const {
    return middle() + std::exp(-decay() * t) *
                          (-middle() * std::cos(omega() * t) + sineTerm() * std::sin(omega() * t));
  }
  double speed(double t) const {  // of sinking
    const double s = std::sin(omega() * t), cosine = std::cos(omega() * t);
    return std::exp(-decay() * t) * ((omega() * sineTerm() + decay() * middle()) * cosine +
                                     (omega() * middle() - decay() * sineTerm()) * s);
  }
  double force(double t) const { return k * depth(t) + c * speed(t); }
  // When the force falls to zero and lets go; infinite if it never does.
  double end() const {
    constexpr int kPerTurn = 256;
    const double step = 2.0 * EIGEN_PI / omega() / kPerTurn;
    for (int i = 1; i < 4 * kPerTurn; ++i) {
      if (force(i * step) > 0.0) continue;
      double low = (i - 1) * step, high = i * step;
      if (i == 1) low = 1e-6 * step;
      for (int k2 = 0; k2 < 80; ++k2) {
        const double mid = 0.5 * (low + high);
        (force(mid) > 0.0 ? low : high) = mid;
      }
      return high;
    }
    return kInfinity;
  }
  // Largest of a function of time in touch that rises and then falls.
  template <class Of>
  double largest(Of of, double last) const {
    double low = 0.0, high = last;
    for (int i = 0; i < 200; ++i) {
      const double left = low + (high - low) / 3.0, right = high - (high - low) / 3.0;
      (of(left) < of(right) ? low : high) = of(left) < of(right) ? left : right;
    }
    return of(0.5 * (low + high));
  }

 private:
  double sineTerm() const { return (v - decay() * middle()) / omega(); }
};

double relative(double measured, double exact) {
  return std::abs(measured - exact) / std::abs(exact);
}

struct Rows {
  const std::string name;
  std::vector<ClaimRow>& rows;
  void add(const std::string& label, double measured, double exact, double allowed) {
    rows.push_back({name + ": " + label, measured, exact, relative(measured, exact), allowed});
  }
};

const Event* find(const Recording& recording, const Approach& approach, EventKind kind) {
  for (const Event& event : recording.report.events)
    if (event.kind == kind && (event.a == approach.body || event.b == approach.body)) return &event;
  return nullptr;
}

// Depth and force that the samples in touch promise. An undamped oscillator keeps
// (d − m a/k)² + (d′/ω)², so that each sample tells the largest depth; else the closed form tells
// what each sample should show.
void addSamples(const Scene& scene, const Recording& recording, const Approach& approach,
                const Oscillator& exact, double end, Rows& rows) {
  const HalfSpace& floor = std::get<HalfSpace>(scene.world.bodies[approach.floor].shape);
  const double deepest = exact.largest([&](double t) { return exact.depth(t); }, end);
  const double strongest = exact.largest([&](double t) { return exact.force(t); }, end);
  WorstRow depth(rows.name + ": depth / m", 1e-6), force(rows.name + ": peak force / N", 1e-6);
  for (const Sample& sample : recording.samples) {
    const double t = sample.t - approach.begins;
    if (t <= 0.0 || t >= end) continue;
    double push = 0.0, sunk = 0.0;
    for (const ContactSample& contact : sample.contacts) {
      if (contact.a != approach.body && contact.b != approach.body) continue;
      push += contact.force.norm();
      sunk = std::max(sunk, -contact.separation);
    }
    const double v = floor.n.dot(sample.bodies[approach.body].v);
    if (exact.c == 0.0) {
      const double m = exact.middle();
      sunk = m + std::hypot(sunk - m, v / exact.omega());
      push = exact.k * m + std::hypot(push - exact.k * m, std::sqrt(exact.k * exact.m) * v);
    } else {
      sunk += deepest - exact.depth(t);
      push += strongest - exact.force(t);
    }
    depth.see(sunk, deepest, relative(sunk, deepest));
    force.see(push, strongest, relative(push, strongest));
  }
  if (!std::isinf(depth.row().error)) rows.rows.push_back(depth.row());
  if (!std::isinf(force.row().error)) rows.rows.push_back(force.row());
}

void addSpring(const Scene& scene, const Recording& recording, const Approach& approach,
               Rows& rows) {
  const CourseSettings& course = scene.world.course;
  const Oscillator exact{approach.mass, course.stiffness, course.damping, approach.pull,
                         approach.speed};
  const double end = exact.end();
  if (approach.begins + end > scene.world.duration) return;
  const Event* begins = find(recording, approach, EventKind::Rest);
  const Event* ends = find(recording, approach, EventKind::Separate);
  if (!begins || !ends) {
    rows.rows.push_back(emptyClaim(rows.name + ": begins and ends to touch"));
    return;
  }
  rows.add("touches at / s", begins->t, approach.begins, 1e-9);
  // Of a damped contact, the surfaces part later than the force ends.
  if (course.damping == 0.0) rows.add("contact time / s", ends->t - begins->t, end, 1e-6);
  addSamples(scene, recording, approach, exact, end, rows);
  // A damped contact flies the rest of the way out of the floor without a force.
  const double lost = 2.0 * approach.pull * exact.depth(end);
  if (const double out = exact.speed(end) * exact.speed(end) - lost; out > 0.0)
    rows.add("leaves at / (m/s)", ends->vrel, std::sqrt(out), 1e-6);
  // What the speeds say, and the weight while in touch.
  if (course.damping == 0.0)
    rows.add("impulse / N s",
             approach.mass * (ends->vrel - begins->vrel + approach.pull * (ends->t - begins->t)),
             approach.mass * (approach.speed - exact.speed(end) + approach.pull * end), 1e-6);
}

void addImpulse(const Recording& recording, const Approach& approach, Rows& rows) {
  const Event* hit = find(recording, approach, EventKind::Impact);
  rows.add("hit at / s", hit ? hit->t : kInfinity, approach.begins, 1e-9);
  rows.add("impulse / N s", hit ? hit->j : kInfinity,
           (1.0 + approach.e) * approach.mass * approach.speed, 1e-9);
}

}  // namespace

std::vector<ClaimRow> springContactRows(const Scene& scene, const Recording& recording) {
  const CourseSettings& course = scene.world.course;
  std::vector<ClaimRow> rows;
  for (const Approach& approach : approachesOf(scene)) {
    Rows named{scene.world.bodies[approach.body].name, rows};
    const double critical = 2.0 * std::sqrt(course.stiffness * approach.mass);
    if (course.contact == "constraint" && approach.begins < scene.world.duration)
      addImpulse(recording, approach, named);
    if (course.contact == "penalty" && course.damping < critical)
      addSpring(scene, recording, approach, named);
  }
  if (rows.empty() || scene.world.method != "course")
    return {emptyClaim("no ball flies at a floor and leaves it again")};
  return rows;
}

}  // namespace tumble
