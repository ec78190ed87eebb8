// What touches and rests at the start stays if forces in the friction cones can hold it, and falls
// if none can: statics, decided without a solver of contact problems.
#include "app/claim/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/claim/free_body.h"
#include "app/claim/rows.h"
#include "sim/math/least_squares.h"

namespace tumble {

double coneDistance(const MatX& generators, const VecX& w) {
  const int most = 3 * static_cast<int>(generators.cols()) + 100;
  std::vector<int> used;
  VecX x = VecX::Zero(generators.cols()), rest = w;
  const auto solved = [&] {
    MatX G(generators.rows(), used.size());
    for (std::size_t k = 0; k < used.size(); ++k) G.col(k) = generators.col(used[k]);
    return leastSquares(G, w);
  };
  for (int round = 0; round < most; ++round) {
    // The generator that promises most comes in, unless it is there.
    VecX gain = generators.transpose() * rest;
    for (const int k : used) gain[k] = 0.0;
    int best = 0;
    if (gain.maxCoeff(&best) <= 1e-13 * w.norm()) break;
    used.push_back(best);
    // Those that would pull leave, one after the other.
    for (VecX y = solved(); !used.empty(); y = solved()) {
      double share = 1.0;
      for (std::size_t k = 0; k < used.size(); ++k)
        if (y[k] <= 0.0) share = std::min(share, x[used[k]] / (x[used[k]] - y[k]));
      if (y.minCoeff() > 0.0) share = 1.0;
      for (std::size_t k = 0; k < used.size(); ++k) x[used[k]] += share * (y[k] - x[used[k]]);
      if (y.minCoeff() > 0.0) break;
      std::erase_if(used, [&](int k) {
        const bool leaves = x[k] <= 1e-15 * w.norm();
        if (leaves) x[k] = 0.0;
        return leaves;
      });
      if (used.empty()) break;
    }
    rest = w - generators * x;
  }
  return rest.norm() / w.norm();
}

namespace {

// Edges of the pyramid that stands for a friction cone.
constexpr int kEdges = 32;
// What forces leave over of the weights: measured 2e-15 where they can hold them, 3e-4 for an arch
// a thousandth too thin.
constexpr double kHeld = 1e-10, kUnheld = 1e-8;
// Ways, in radii of a body: of what stays, measured 4e-11; of what falls at least.
constexpr double kStays = 1e-9, kFalls = 1e-2;

/// Bodies that touch one another at the start.
struct Structure {
  std::vector<int> bodies;
  bool has(int body) const { return std::find(bodies.begin(), bodies.end(), body) != bodies.end(); }
};

// Connected by contacts of the first sample, from body to body that moves.
std::vector<Structure> structuresOf(const Scene& scene, const Sample& start) {
  const int count = static_cast<int>(scene.world.bodies.size());
  std::vector<int> group(count);
  std::iota(group.begin(), group.end(), 0);
  for (const ContactSample& contact : start.contacts)
    if (moves(scene.world.bodies[contact.a]) && moves(scene.world.bodies[contact.b])) {
      const int from = group[contact.a], to = group[contact.b];
      std::replace(group.begin(), group.end(), from, to);
    }
  std::vector<Structure> structures(count);
  for (int body = 0; body < count; ++body)
    if (moves(scene.world.bodies[body])) structures[group[body]].bodies.push_back(body);
  std::erase_if(structures, [](const Structure& s) { return s.bodies.empty(); });
  return structures;
}

// At rest, with no forces on it but uniform ones and those of contacts.
bool restsFreely(const Scene& scene, const Sample& start, const Structure& structure) {
  for (const int body : structure.bodies) {
    const BodySample& seen = start.bodies[body];
    if (!seen.v.isZero() || !seen.omega.isZero() || scene.world.bodies[body].pivot_B) return false;
    if (!freeAcceleration(scene.world, body)) return false;
    for (const JointDef& joint : scene.world.joints)
      if (joint.a == body || joint.b == body) return false;
  }
  return true;
}

// Until another body that moves touches it, or strikes it between two samples [s].
double aloneUntil(const Scene& scene, const Recording& recording, const Structure& structure) {
  const auto joinsIn = [&](int a, int b) {
    return moves(scene.world.bodies[a]) && moves(scene.world.bodies[b]) &&
           structure.has(a) != structure.has(b);
  };
  double until = recording.samples.back().t;
  for (const Event& event : recording.report.events)
    if (joinsIn(event.a, event.b)) until = std::min(until, event.t);
  for (const Sample& sample : recording.samples)
    for (const ContactSample& c : sample.contacts)
      if (joinsIn(c.a, c.b)) return std::min(until, sample.t);
  return until;
}

// Forces and torques, per radius, on the bodies by a unit force along each edge of each cone.
// Outside: the pyramid holds the cone, else the cone holds it.
MatX generatorsOf(const Scene& scene, const Sample& start, const Structure& structure,
                  bool outside) {
  std::vector<const ContactSample*> contacts;
  for (const ContactSample& c : start.contacts)
    if (structure.has(c.a) || structure.has(c.b)) contacts.push_back(&c);
  MatX G =
      MatX::Zero(6 * structure.bodies.size(), std::max<std::size_t>(1, kEdges * contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactSample& c = *contacts[i];
    const double mu = surfaceOf(scene.world, c.a, c.b).friction;
    const double slope = outside ? mu / std::cos(EIGEN_PI / kEdges) : mu;
    const Vec3 t = c.n.unitOrthogonal(), s = c.n.cross(t);
    for (int edge = 0; edge < kEdges; ++edge) {
      const double angle = 2.0 * EIGEN_PI * edge / kEdges;
      const Vec3 f = c.n + slope * (std::cos(angle) * t + std::sin(angle) * s);
      for (std::size_t k = 0; k < structure.bodies.size(); ++k) {
        const int body = structure.bodies[k];
        if (body != c.a && body != c.b) continue;
        const Vec3 force = body == c.a ? f : Vec3(-f), arm = c.p - start.bodies[body].x;
        const double radius = boundingRadius(scene.world.bodies[body].shape);
        G.col(kEdges * i + edge).segment<3>(6 * k) = force;
        G.col(kEdges * i + edge).segment<3>(6 * k + 3) = arm.cross(force) / radius;
      }
    }
  }
  return G;
}

VecX loadOf(const Scene& scene, const Structure& structure) {
  VecX load = VecX::Zero(6 * structure.bodies.size());
  for (std::size_t k = 0; k < structure.bodies.size(); ++k) {
    const int body = structure.bodies[k];
    load.segment<3>(6 * k) =
        -bodyMass(scene.world.bodies[body]) * *freeAcceleration(scene.world, body);
  }
  return load;
}

// The longest way of any of its bodies, in radii of that body, until something else touches it.
double wayOf(const Scene& scene, const Recording& recording, const Structure& structure) {
  const double end = aloneUntil(scene, recording, structure);
  double way = 0.0;
  for (const Sample& sample : recording.samples) {
    if (sample.t > end) break;
    for (const int body : structure.bodies) {
      const Vec3 moved = sample.bodies[body].x - recording.samples.front().bodies[body].x;
      way = std::max(way, moved.norm() / boundingRadius(scene.world.bodies[body].shape));
    }
  }
  return way;
}

}  // namespace

std::vector<ClaimRow> equilibriumRows(const Scene& scene, const Recording& recording) {
  if (recording.samples.empty()) return {emptyClaim("the run has no samples")};
  const Sample& start = recording.samples.front();
  std::vector<ClaimRow> rows;
  for (const Structure& structure : structuresOf(scene, start)) {
    if (!restsFreely(scene, start, structure)) continue;
    const VecX load = loadOf(scene, structure);
    if (load.isZero()) continue;
    const double inside = coneDistance(generatorsOf(scene, start, structure, false), load);
    const double outside = coneDistance(generatorsOf(scene, start, structure, true), load);
    const std::string name = scene.world.bodies[structure.bodies.front()].name;
    const double way = wayOf(scene, recording, structure);
    if (inside <= kHeld)
      rows.push_back({name + ": can be held, and moves by / radii", way, 0.0, way, kStays});
    if (outside >= kUnheld)
      rows.push_back({name + ": cannot be held, and falls", way > kFalls ? 1.0 : 0.0, 1.0,
                      way > kFalls ? 0.0 : 1.0, 0.0});
  }
  if (rows.empty()) return {emptyClaim("nothing is at rest at the start")};
  return rows;
}

}  // namespace tumble
