// Painlevé's paradox: friction turns a sliding body against its support so that no force, however
// large, keeps the two apart. The contact jams: an impulse without collision ends its slip.
#include <algorithm>
#include <cmath>

#include "sim/contact/impact.h"
#include "sim/contact/modes.h"
#include "sim/contact/rows.h"
#include "sim/method/exact/exact.h"

namespace tumble {
namespace {

/// What friction must leave of a push, see `pushLeft`; and where forces grow beyond all bounds.
constexpr double kPushLeft = 1e-11, kPushGone = 0.5;
/// Contact problems with a solution are solved to better than this.
constexpr double kUnsolved = 1e-8;

/// Impulses [N·s] after which the jammed contacts neither slip nor move along their normals, and
/// the others do not approach.
std::vector<Vec3> endOfSlip(std::span<const RigidBody> bodies, std::span<const Contact> contacts,
                            const std::vector<char>& jammed) {
  Problem problem;
  beginVelocityProblem(bodies, problem);
  std::vector<std::size_t> owner;
  const auto add = [&](std::size_t k, const Vec3& d, ConeKind kind) {
    const Contact& c = contacts[k];
    problem.cones.push_back({.kind = kind, .row = static_cast<int>(problem.rows.size())});
    problem.rows.push_back(pointRow(bodies, c.a, c.b, c.point.p, d, 0.0));
    owner.push_back(k);
  };
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Vec3& n = contacts[k].point.n;
    add(k, n, jammed[k] ? ConeKind::Equality : ConeKind::Push);
    if (!jammed[k]) continue;
    Vec3 t1, t2;
    tangents(n, contacts[k].slipDirection, t1, t2);
    add(k, t1, ConeKind::Equality);
    add(k, t2, ConeKind::Equality);
  }
  Solution solution;
  solveByIslands(*findSolver("pivoting"), problem, {}, solution);
  std::vector<Vec3> impulse(contacts.size(), Vec3::Zero());
  for (std::size_t r = 0; r < owner.size(); ++r)
    impulse[owner[r]] += solution.lambda[r] * problem.rows[r].linear;
  return impulse;
}

}  // namespace

// A contact alone tells by what friction leaves of its push. Those of a pair that slides on an edge
// jam together: their forces, found as if they could pull, do.
bool Exact::jams(const Contact& c, const std::vector<Contact>& resting, bool solved) const {
  if (!c.sliding) return false;
  RigidBody bodies[] = {state_.bodies[c.a], state_.bodies[c.b]};
  for (const int k : {0, 1}) {
    bodies[k].force = state_.outer[k == 0 ? c.a : c.b];
    bodies[k].torque.setZero();
  }
  if (!(normalAcceleration(bodies[0], bodies[1], c.point) < 0.0)) return false;
  std::vector<Contact> contacts;
  for (Contact d : resting) {
    if (d.a != c.a || d.b != c.b) continue;
    d.a = 0, d.b = 1;
    contacts.push_back(d);
  }
  if (contacts.size() == 1)
    return pushLeft(bodies[0], bodies[1], c) <= (state_.jammed ? kPushGone : kPushLeft);
  if (solved && !state_.jammed) return false;
  ModeForces().apply(bodies, contacts);
  double push = 0.0;
  for (const Contact& d : contacts) push += d.force.dot(d.point.n);
  return push <= 0.0;
}

// The impulse begins along the slip, with too much friction for the push, until the slip has ended;
// then the contact sticks and is pushed until it approaches no more: in sum, v = 0 at the contact.
// Stewart, Rigid-Body Dynamics with Friction and Impact, 2000, §5; Génot and Brogliato 1999.
bool Exact::endJam(double t, const Cluster& cluster, const std::vector<Contact>& resting,
                   double residual) {
  std::vector<char> jammed;
  for (const Contact& c : resting) jammed.push_back(jams(c, resting, residual < kUnsolved) ? 1 : 0);
  state_.jammed = false;
  if (std::find(jammed.begin(), jammed.end(), 1) == jammed.end()) return false;
  std::vector<RigidBody> bodies;
  std::vector<int> local(state_.bodies.size(), -1);
  for (const int i : cluster.bodies) {
    local[i] = static_cast<int>(bodies.size());
    bodies.push_back(state_.bodies[i]);
  }
  std::vector<Contact> contacts = resting;
  for (Contact& c : contacts) c.a = local[c.a], c.b = local[c.b];
  const std::vector<Vec3> impulse = endOfSlip(bodies, contacts, jammed);
  double push = 0.0;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (jammed[k]) push += impulse[k].dot(contacts[k].point.n);
  if (!(push > 0.0) || !std::isfinite(push)) return false;

  std::vector<Vec3> given(contacts.size(), Vec3::Zero());
  const std::vector<double> restitution(contacts.size(), 0.0);
  const Impact impact{bodies, contacts, restitution, given, tolerance_};
  Certificate& books = report_.certificate;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ImpulseEnergy energy = applyContactImpulse(impact, static_cast<int>(k), impulse[k]);
    books.energy_lost_friction += energy.lost;
    books.work_of_forces += energy.work;
  }
  for (const int i : cluster.bodies)
    if (!model_.fixed(i)) state_.bodies[i] = bodies[local[i]];
  recordImpacts(t, {.bodies = cluster.bodies, .contacts = resting},
                std::vector<double>(resting.size(), 0.0), given);
  report_.note("a sliding contact jammed (Painleve): an impulse without collision ended its slip");
  return true;
}

}  // namespace tumble
