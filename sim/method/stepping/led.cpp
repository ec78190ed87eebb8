// What moves on come what may, in a contact problem: how far it leads what goes round with it, and
// whether it asks for what no force can give.
#include <algorithm>
#include <cmath>

#include "sim/math/rotation.h"
#include "sim/method/crush.h"
#include "sim/method/stepping/stepping.h"
#include "sim/problem/endless.h"

namespace tumble {
namespace {

/// The part of the angular velocity of b that turns what it shows at a contact: spin about the axis
/// of what is round there shows the same again.
Vec3 turning(const RigidBody& b, const ContactPoint& c) {
  constexpr double kCentre = 1e-9;  // of a radius
  Vec3 axis = c.rimB > 0.0 ? c.eb : Vec3(c.pb - b.x);
  if (c.halfB.x() > 0.0) {
    if (c.halfB.minCoeff() == c.halfB.maxCoeff()) return Vec3::Zero();
    int k = 0;
    while (k < 3 && c.halfB[(k + 1) % 3] != c.halfB[(k + 2) % 3]) ++k;
    if (k == 3) return b.omega;
    axis = b.R.col(k);
  } else if (c.rb == 0.0 && c.rimB == 0.0) {
    return b.omega;
  } else if (axis.norm() <= kCentre * c.rb) {
    return Vec3::Zero();
  }
  return b.omega - axis * (b.omega.dot(axis) / axis.squaredNorm());
}

/// As Stepping::carried of bodies that go round with ω and part with v [m/s].
Vec3 carriedBy(const Vec3& omega, const Vec3& v, double h, bool atStart) {
  const double theta = h * omega.norm();
  if (theta == 0.0) return Vec3::Zero();
  double s, c, halfS, halfC;
  sinCos(theta, s, c);
  sinCos(0.5 * theta, halfS, halfC);
  const Vec3 axis = omega.normalized();
  const Vec3 across = v - axis.dot(v) * axis;
  // The velocities of the start are those of an instant, not of a chord.
  const double turned = atStart ? (1.0 - c) / theta : s - 0.5 * theta;
  const double along = atStart ? s / theta - 1.0 : c - 0.5 * theta * halfC / halfS;
  return -(turned * axis.cross(v) + along * across);
}

}  // namespace

/// What goes round with ω has moved along chords: v = (1 − exp(−hω)) d/h in the last step, and
/// (exp(hω) − 1) d/h in this one, of which ω × d is known. The rest is, across ω, with θ = h |ω|,
///   (sin θ − θ/2) ω̂ × v + (cos θ − (θ/2) cot(θ/2)) v,
/// and ½ h ω × v to second order also of what rolls: the velocity of the carrier where the body
/// will be in the middle of the step. Bodies that are both free have in common the part (p·q)(p +
/// q)/(p² + q²) of their angular velocities p, q, along the tangents alone: normals follow the gap.
/// A carrier lifts what lies on it by turning what it shows, not by its spin.
Vec3 Stepping::carried(const Contact& contact, double h) const {
  const RigidBody &a = state_.bodies[contact.a], &b = state_.bodies[contact.b];
  const Vec3 &p = b.fixed() ? b.omega : a.omega, &q = a.fixed() ? a.omega : b.omega;
  const double common = p.dot(q);
  if (!(common > 0.0)) return Vec3::Zero();
  const Vec3 omega = common / (p.squaredNorm() + q.squaredNorm()) * (p + q);
  const Vec3 v = (work_.before[contact.a] - work_.before[contact.b]).head<3>();
  const Vec3 lead = carriedBy(omega, v, h, atStart());
  if (!a.fixed() && !b.fixed()) return lead;
  ContactPoint c = contact.point;
  if (!b.fixed()) mirror(c);
  const Vec3 turn = turning(b.fixed() ? b : a, c);
  return turn == omega ? lead : lead + c.n.dot(carriedBy(turn, v, h, atStart()) - lead) * c.n;
}

bool Stepping::isLed(const Island& island) const {
  const auto driven = [&](int i) {
    return i < model_.count() && drives(model_, state_.bodies[i], i);
  };
  return std::any_of(island.links.begin(), island.links.end(), [&](Link link) {
    return driven(ends(link).first) || driven(ends(link).second);
  });
}

/// Asks only where the solver has failed and a fixed body that moves is in the island.
void Stepping::findCrushed(Island& island, const SolveReport& solved) {
  constexpr double kFailed = 1e-3;
  if (solved.status == SolveStatus::Solved || !(solved.residual > kFailed)) return;
  if (!isLed(island)) return;
  std::vector<double> push = endlessPush(island.problem, false);
  if (push.empty()) push = endlessPush(island.problem, true);
  if (push.empty()) return;
  std::vector<std::pair<int, int>> pairs;
  for (const Cone& cone : island.problem.cones) {
    const Row& row = island.problem.rows[cone.row];
    pairs.emplace_back(island.bodies[row.a], island.bodies[row.b]);
  }
  island.answer.crushed = crushWords(model_, state_.t, pairs, push);
}

}  // namespace tumble
