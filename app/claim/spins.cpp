// What spins on a level floor: energy, Jellett's integral, a disk that rolls round its rim, a tip
// that holds.
#include <algorithm>
#include <cmath>
#include <optional>

#include "app/claim/free_body.h"
#include "app/claim/free_rotor.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

// Allowed: of the energy; of Jellett's integral; [m] and [rad] of a steady disk; [rad] of a top.
// Measured 6e-15; 4e-13; 1e-16 m and 8e-14; 6e-12.
constexpr double kEnergy = 1e-9, kJellett = 1e-10, kPlace = 1e-9, kAngle = 1e-9, kTop = 1e-9;
constexpr double kStill = 1e-9;  // [m/s] slower than this a point does not slip

/// A body that floors alone touch.
struct Spun {
  int body = 0;
  std::string name;
  MassProperties mass;
  Vec3 up = Vec3::UnitY();
  double g = 0.0;  ///< [m/s²]

  const BodySample& at(const Sample& sample) const { return sample.bodies[body]; }
  Vec3 momentum(const Sample& s) const {  ///< [kg m²/s] about the centre of mass
    return angularMomentum(mass.inertia, at(s).q, at(s).omega);
  }
  double energy(const Sample& s) const {  ///< [J]
    return 0.5 * mass.mass * at(s).v.squaredNorm() + 0.5 * at(s).omega.dot(momentum(s)) +
           mass.mass * g * up.dot(at(s).x);
  }
  double kinetic(const Sample& s) const { return energy(s) - mass.mass * g * up.dot(at(s).x); }
};

/// The one point in which a body touches; none if there are others, or none.
std::optional<Vec3> touchOf(const Sample& sample, int body) {
  std::optional<Vec3> touch;
  for (const ContactSample& c : sample.contacts) {
    if (c.a != body && c.b != body) continue;
    if (touch) return {};
    touch = c.p;
  }
  return touch;
}

bool happens(const Recording& recording, int body, double after, double until) {
  return std::any_of(
      recording.report.events.begin(), recording.report.events.end(),
      [&](const Event& e) { return (e.a == body || e.b == body) && e.t > after && e.t <= until; });
}

bool rollsAt(const Spun& spun, const Sample& sample) {
  const std::optional<Vec3> p = touchOf(sample, spun.body);
  if (!p) return false;
  const Vec3 slip = spun.at(sample).v + spun.at(sample).omega.cross(*p - spun.at(sample).x);
  return slip.norm() < kStill;
}

// Nothing gives energy, and what does not slip loses none.
void addEnergy(const Recording& recording, const Spun& spun, std::vector<ClaimRow>& rows) {
  WorstRow gained(spun.name + ": energy gained / J, relative", kEnergy);
  WorstRow kept(spun.name + ": energy while it does not slip / J, relative", kEnergy);
  bool rolled = false;
  const double scale = spun.kinetic(recording.samples.front());
  for (std::size_t k = 1; k < recording.samples.size(); ++k) {
    const Sample &before = recording.samples[k - 1], &now = recording.samples[k];
    const double change = spun.energy(now) - spun.energy(before);
    gained.see(std::max(0.0, change), 0.0, std::max(0.0, change) / scale);
    if (!rollsAt(spun, before) || !rollsAt(spun, now) ||
        happens(recording, spun.body, before.t, now.t))
      continue;
    kept.see(spun.energy(now), spun.energy(before), std::abs(change) / scale);
    rolled = true;
  }
  rows.push_back(gained.row());
  if (rolled) rows.push_back(kept.row());
}

// L · r, with r from the centre of mass to the point of a half-ball that touches: a force there has
// no torque along r, and what r turns by leaves L · r as it is for a body round its axis.
// Jellett, A Treatise on the Theory of Friction, 1872.
void addJellett(const Scene& scene, const Recording& recording, const Spun& spun,
                std::vector<ClaimRow>& rows) {
  const Capsule* pill = std::get_if<Capsule>(&scene.world.bodies[spun.body].shape);
  if (!pill) return;
  WorstRow row(spun.name + ": Jellett's integral / (kg m³/s), relative", kJellett);
  double first = 0.0, since = -1.0, end = 0.0;
  bool any = false;
  for (const Sample& sample : recording.samples) {
    const std::optional<Vec3> p = touchOf(sample, spun.body);
    const Vec3 axis = spun.at(sample).q * Vec3::UnitY();
    const double side = p && (*p - spun.at(sample).x).dot(axis) < 0.0 ? -1.0 : 1.0;
    const Vec3 r = 0.5 * side * pill->h * axis - pill->r * spun.up;
    const double now = spun.momentum(sample).dot(r);
    const bool goesOn =
        since >= 0.0 && side == end && !happens(recording, spun.body, since, sample.t);
    if (p && goesOn) row.see(now, first, std::abs(now / first - 1.0));
    any = any || (p && goesOn);
    if (p && goesOn) continue;
    since = p ? sample.t : -1.0;
    end = side;
    first = now;
  }
  if (any) rows.push_back(row.row());
}

// Euler's disk: with its centre at rest and ω through the point that touches, L goes round with
//   Ω up × L = torque = ρ × m g up,   Ω of its axis: ω × a = Ω up × a.
void addSteady(const Scene& scene, const Recording& recording, const Spun& spun,
               std::vector<ClaimRow>& rows) {
  const Sample& start = recording.samples.front();
  const std::optional<Vec3> p = touchOf(start, spun.body);
  if (!p || !std::holds_alternative<Cylinder>(scene.world.bodies[spun.body].shape)) return;
  const Vec3 arm = *p - spun.at(start).x, a = spun.at(start).q * Vec3::UnitY();
  const Vec3 across = spun.up.cross(a);
  if (!spun.at(start).v.isZero() || across.norm() < 1e-6) return;
  const double rate = spun.at(start).omega.cross(a).dot(across) / across.squaredNorm();
  const Vec3 torque = arm.cross(spun.mass.mass * spun.g * spun.up);
  const Vec3 needed = rate * spun.up.cross(spun.momentum(start));
  if ((needed - torque).norm() > 1e-9 * torque.norm()) return;
  WorstRow place(spun.name + " rolls round its rim: way of its centre / m", kPlace);
  WorstRow round(spun.name + " goes round: angle / rad, beside Ω t", kAngle);
  for (const Sample& sample : recording.samples) {
    const double way = (spun.at(sample).x - spun.at(start).x).norm();
    place.see(way, 0.0, way);
    const Vec3 told = Eigen::AngleAxisd(rate * sample.t, spun.up) * a;
    const double off = told.cross(spun.at(sample).q * Vec3::UnitY()).norm();
    round.see(rate * sample.t + off, rate * sample.t, off);
  }
  rows.push_back(place.row());
  rows.push_back(round.row());
}

// A corner that holds is a pivot: the same body, held there, moves so by another method.
void addTip(const Scene& scene, const Recording& recording, const Spun& spun,
            std::vector<ClaimRow>& rows) {
  const Sample& start = recording.samples.front();
  const std::optional<Vec3> p = touchOf(start, spun.body);
  if (!p || !std::holds_alternative<Hull>(scene.world.bodies[spun.body].shape)) return;
  WorldDef def = aloneOf(scene, spun.body);
  def.method = "course";
  def.course = CourseSettings{.integrator = "taylor", .order = 20};
  def.course.step = 0.5 / (1.0 + spun.at(start).omega.norm());
  def.bodies[0].pivot_B = spun.at(start).q.conjugate() * (*p - spun.at(start).x);
  World held(def);
  WorstRow row(spun.name + " on its tip: attitude / rad, beside one that is held there", kTop);
  for (const Sample& sample : recording.samples) {
    const std::optional<Vec3> touch = touchOf(sample, spun.body);
    if (!touch || (*touch - *p).norm() > 1e-6 || happens(recording, spun.body, start.t, sample.t))
      break;
    held.advance(sample.t);
    const double off = angleBetween(spun.at(sample).q, held.sample(sample.t).bodies[0].q);
    row.see(off, 0.0, off);
  }
  rows.push_back(row.row());
}

// Whether floors are all that ever touches a body, and gravity all that pulls it.
bool spinsFreely(const Scene& scene, const Recording& recording, int body) {
  const BodyDef& def = scene.world.bodies[body];
  if (!moves(def) || def.pivot_B || def.angularVelocity.isZero() ||
      freeAcceleration(scene.world, body) != scene.world.gravity)
    return false;
  bool touched = false;
  for (const Sample& sample : recording.samples)
    for (const ContactSample& c : sample.contacts) {
      if (c.a != body && c.b != body) continue;
      const BodyDef& other = scene.world.bodies[c.a == body ? c.b : c.a];
      const HalfSpace* floor = std::get_if<HalfSpace>(&other.shape);
      if (!floor || floor->n.cross(scene.world.gravity).norm() > 1e-9) return false;
      touched = true;
    }
  return touched;
}

}  // namespace

std::vector<ClaimRow> spinRows(const Scene& scene, const Recording& recording) {
  if (recording.samples.empty()) return {emptyClaim("the run has no samples")};
  std::vector<ClaimRow> rows;
  for (int body = 0; body < static_cast<int>(scene.world.bodies.size()); ++body) {
    if (!spinsFreely(scene, recording, body)) continue;
    const BodyDef& def = scene.world.bodies[body];
    const double g = scene.world.gravity.norm();
    const Spun spun{body, def.name, massOf(def), -scene.world.gravity / g, g};
    addEnergy(recording, spun, rows);
    addJellett(scene, recording, spun, rows);
    addSteady(scene, recording, spun, rows);
    addTip(scene, recording, spun, rows);
  }
  if (rows.empty()) return {emptyClaim("nothing spins on a level floor")};
  return rows;
}

}  // namespace tumble
