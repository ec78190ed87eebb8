// Joints in a step: velocities that they allow, how fast they swing, what they gave to the bodies.
#include <algorithm>
#include <cmath>

#include "sim/contact/rest.h"
#include "sim/joint/swing.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

void Stepping::bookOuter() {
  const OuterBonds outer = outerBonds(work_.bonds, state_.bodies);
  state_.externalImpulse += outer.force;
  report_.certificate.work_of_forces += outer.power;
}

void Stepping::bookJoints(double h) {
  bookOuter();
  for (std::size_t i = 0; i < work_.bonds.rows.size(); ++i) {
    const Row& row = work_.bonds.rows[i];
    if (work_.bonds.kinds[i] != ConeKind::Push) continue;
    // A limit takes λ times the mean of the rates before and after.
    double rate = 0.0;
    for (const std::vector<Vec6>* v : {&work_.before, &work_.after})
      rate += 0.5 * rowSpeed(row, (*v)[row.a], (*v)[row.b]);
    report_.certificate.energy_lost_impact -= work_.bonds.lambda[i] * rate;
  }
  Segment& segment = state_.trail.back();
  jointForces(segment.start, model_.joints, work_.bonds, h, segment.joints);
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
  addBondImpulses(work_.bonds, state_.bodies);
  for (std::size_t k = 0; k < work_.joints.size(); ++k) {
    JointForce& sum = state_.trail.back().joints[k];
    sum.force += work_.joints[k].force;
    sum.torque += work_.joints[k].torque;
  }
}

void Stepping::divideFirst(double h) {
  memory_.division = 1;
  if (model_.joints.empty()) return;
  std::vector<RigidBody> bodies = state_.bodies;
  sumForces(model_.def.gravity, model_.def.forces, bodies);
  Bonds bonds;
  restBonds(bodies, model_.joints, {}, h, bonds);
  RestForces().apply(bodies, {}, &bonds);
  std::vector<JointForce> forces;
  jointForces(state_.bodies, model_.joints, bonds, 1.0, forces);
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
