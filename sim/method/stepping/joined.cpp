// Joints in a step: velocities that they allow, how fast they swing, what they gave to the bodies.
#include <algorithm>
#include <cmath>

#include "sim/contact/rest.h"
#include "sim/joint/swing.h"
#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

/// [m] from the place where a joint holds to the farthest that it moves.
double reachOf(const Joint& joint) {
  if (joint.kind != JointKind::Distance) return joint.arm;
  return joint.arm + (std::isfinite(joint.hi) ? joint.hi : joint.length);
}

}  // namespace

void Stepping::bookOuter() {
  const OuterBonds outer = outerBonds(work_.bonds, state_.bodies);
  state_.externalImpulse += outer.force;
  report_.certificate.work_of_forces += outer.power;
}

/// A limit takes λ times the mean of the rates before and after; so does a joint of what bends,
/// which an implicit step leads along chords.
void Stepping::bookJoints(double h) {
  Certificate& books = report_.certificate;
  bookOuter();
  for (std::size_t i = 0; i < work_.bonds.rows.size(); ++i) {
    const Row& row = work_.bonds.rows[i];
    const bool limit = work_.bonds.kinds[i] == ConeKind::Push;
    if (!limit && !isBent(row.a, row.b)) continue;
    double rate = 0.0;
    for (const std::vector<Vec6>* v : {&work_.before, &work_.after})
      rate += 0.5 * rowSpeed(row, (*v)[row.a], (*v)[row.b]);
    (limit ? books.energy_lost_impact : books.energy_lost_bending) -= work_.bonds.lambda[i] * rate;
  }
  Segment& segment = state_.trail.back();
  jointForces(segment.start, model_.joints, work_.bonds, h, segment.joints);
}

/// Where a body of the island at hand stands after the step, at the velocities that were found.
void Stepping::moveAhead(Island& island, int i, double h) {
  RigidBody& body = island.ahead[i];
  body = state_.bodies[i];
  const bool fixed = body.fixed();
  const Vec6& v = fixed ? work_.before[i] : island.solution.v[island.local[i]];
  body.x += h * v.head<3>();
  if (fixed)
    body.q = rotated(body.q, h * v.tail<3>());
  else if (!body.particle)
    turn(body, body.R * (body.Ibody * (body.R.transpose() * v.tail<3>())), h);
  body.q.normalize();
  updateDerived(body);
}

bool Stepping::closeGaps(Island& island, bool crowd, double h, SolveReport& solved) {
  constexpr int kRounds = 8;
  constexpr double kFar = 1e-5;     // of an arm: what rows may miss in a part; it grows with h³
  constexpr double kLeast = 1e-3;   // of a step: shorter parts miss what they miss
  constexpr double kClosed = 1e-2;  // of the gap that is allowed to stay
  Missed missed = foretellGaps(island, h);
  const double parts = std::cbrt(missed.part / kFar);
  island.answer.parts = parts / h;
  if (parts > 2.0 && h > kLeast * model_.def.stepping.step) {
    island.answer.misses = true;
    return false;
  }
  for (int round = 0; round < kRounds && missed.way > kClosed * tolerance_.drift; ++round) {
    island.before = island.solution;
    if (!island.solution.pull.empty()) island.pull = island.solution.pull;
    island.solution.lambda.clear();
    for (std::size_t i = 0; i < island.bodies.size(); ++i)
      island.solution.v[i] = work_.before[island.bodies[i]];
    const SolveReport again = solveAsPlanned(island, false, crowd, h);
    if (!island.answer.crushed.empty()) return false;
    const Missed now = foretellGaps(island, h);
    if (!(now.way < missed.way)) {
      island.solution = island.before;
      break;
    }
    solved = again;
    missed = now;
  }
  return true;
}

/// Rows that turn alone move no centre of mass: the projection may have their gaps.
Stepping::Missed Stepping::foretellGaps(Island& island, double h) {
  Missed worst;
  int owner = -1;
  double squares = 0.0;  // [m²] of the rows of one joint: as long whichever axes they have
  island.ahead.resize(state_.bodies.size());
  std::size_t cone = 0;
  for (const Link link : island.links) {
    if (isPair(link)) {
      for (const Touch& touch : memory_.pairs[link].touches)
        cone += !flies(touch, h) && !isAside(touch);
      continue;
    }
    const int bond = link - static_cast<int>(state_.near.size());
    Row& row = island.problem.rows[island.problem.cones[cone++].row];
    if (const SpringRow* spring = springOf(link); spring && spring->isRigid()) {
      const Spring& made = *spring->spring;
      const double missed = missedStretch(island, *spring, row, h);
      row.bias += h * made.stiffness * row.compliance * missed;
      worst.way = std::max(worst.way, std::abs(missed));
      worst.part = std::max(worst.part, std::abs(missed) / made.rest);
      continue;
    }
    if (work_.bonds.owners[bond] < 0 || row.linear.isZero(0.0)) continue;
    const Joint& joint = model_.joints[work_.bonds.owners[bond]];
    if (work_.bonds.owners[bond] != owner) {
      owner = work_.bonds.owners[bond];
      squares = 0.0;
      for (const int i : {joint.a, joint.b})
        if (i < static_cast<int>(state_.bodies.size())) moveAhead(island, i, h);
      jointRows(island.ahead, joint, island.jointRows);
    }
    const JointRow& found = island.jointRows[work_.bonds.places[bond]];
    const double missed =
        found.gap -
        h * (rowSpeed(row, island.solution.v[row.a], island.solution.v[row.b]) + row.bias);
    row.bias += missed / h;
    squares += missed * missed;
    worst.way = std::max(worst.way, std::sqrt(squares));
    worst.part = std::max(worst.part, std::sqrt(squares) / reachOf(joint));
  }
  return worst;
}

/// How much longer [m] a spring is after the step than its row has it.
double Stepping::missedStretch(Island& island, const SpringRow& spring, const Row& row, double h) {
  const Spring& made = *spring.spring;
  const auto end = [&](int i, const Vec3& anchor_B) {
    if (i == kNoBody) return anchor_B;
    moveAhead(island, i, h);
    const RigidBody& body = island.ahead[i];
    return Vec3(body.x + body.q * anchor_B);
  };
  const double after = rowSpeed(row, island.solution.v[row.a], island.solution.v[row.b]);
  const double damper =
      made.damping * (spring.theta * after + (1.0 - spring.theta) * spring.before);
  const double has = ((after + row.bias) / (row.compliance * h) - damper) / made.stiffness;
  return (end(made.a, made.anchorA_B) - end(made.b, made.anchorB_B)).norm() - made.rest - has;
}

bool Stepping::isBent(int a, int b) const {
  return model_.bends(a) || (b < model_.count() && model_.bends(b));
}

/// Half the power of λ on what bends [J], at the velocities of the bodies.
double Stepping::halfGivenToBent() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < work_.bonds.rows.size(); ++i)
    if (const Row& row = work_.bonds.rows[i]; isBent(row.a, row.b))
      sum += 0.5 * work_.bonds.lambda[i] * bondVelocity(row, state_.bodies);
  return sum;
}

void Stepping::meetJoints(double h) {
  if (joints().empty()) return;
  beginAllowedVelocities(state_.bodies, model_.joints, work_.bonds, work_.problem);
  work_.solution.lambda.clear();
  work_.solution.v.clear();
  solveByIslands(solver_, work_.problem, {.tolerance = model_.def.stepping.tolerance},
                 work_.solution);
  readBonds(work_.solution.lambda, 0, work_.bonds);
  bookOuter();
  jointForces(state_.bodies, model_.joints, work_.bonds, h, work_.joints);
  report_.certificate.energy_lost_bending -= halfGivenToBent();
  addBondImpulses(work_.bonds, state_.bodies);
  report_.certificate.energy_lost_bending -= halfGivenToBent();
  for (std::size_t k = 0; k < work_.joints.size(); ++k) {
    JointForce& sum = state_.trail.back().joints[k];
    sum.force += work_.joints[k].force;
    sum.torque += work_.joints[k].torque;
  }
}

void Stepping::divideFirst(double h) {
  memory_.division = 1;
  if (model_.joints.empty()) return;
  std::vector<Joint> rigid;  // points of what bends yield, and may be thousands
  for (const Joint& joint : model_.joints)
    if (!isBent(joint.a, joint.b)) rigid.push_back(joint);
  std::vector<RigidBody> bodies = state_.bodies;
  sumForces(model_.def.gravity, model_.def.forces, bodies);
  Bonds bonds;
  restBonds(bodies, rigid, {}, h, bonds);
  RestForces().apply(bodies, {}, &bonds);
  std::vector<JointForce> known, forces;
  jointForces(state_.bodies, rigid, bonds, 1.0, known);
  std::size_t next = 0;
  for (const Joint& joint : model_.joints)
    forces.push_back(isBent(joint.a, joint.b) ? JointForce{} : known[next++]);
  divide(h, forces);
}

void Stepping::divideNext(double h) {
  if (!model_.joints.empty()) divide(h, state_.trail.back().joints);
}

void Stepping::divide(double h, std::span<const JointForce> forces) {
  constexpr double kSwing = 1.0;  // [rad] of the fastest swing in a part; at 2 it would grow
  constexpr double kTurn = 0.1;   // [rad] by which a body in a joint may turn in a part
  constexpr int kMostParts = 1000;
  double rate = fastestSwing(state_.bodies, model_.joints, forces, solver_, kSwing / h,
                             memory_.swing, work_.swing) /
                kSwing;
  rate = std::max(rate, memory_.missed);
  for (const Joint& joint : model_.joints) {
    for (const int i : {joint.a, joint.b}) {
      const RigidBody& body = partner(state_.bodies, i);
      if (!body.fixed()) rate = std::max(rate, body.omega.norm() / kTurn);
    }
  }
  memory_.division = static_cast<int>(std::clamp(std::ceil(h * rate), 1.0, double{kMostParts}));
  if (memory_.division > 1)
    report_.note(
        "steps were divided: what joints hold swings fast under the loads that they carry");
}

}  // namespace tumble
