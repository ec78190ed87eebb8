#include "sim/contact/rows.h"

namespace tumble {
namespace {

void beginProblem(std::span<const RigidBody> bodies, Problem& problem) {
  problem.invM.clear();
  problem.Iinv.clear();
  problem.vStar.clear();
  problem.rows.clear();
  problem.cones.clear();
  problem.couplings.clear();
  for (const RigidBody& body : bodies) {
    problem.invM.push_back(body.invM);
    problem.Iinv.push_back(body.Iinv);
  }
}

}  // namespace

void beginVelocityProblem(std::span<const RigidBody> bodies, Problem& problem) {
  beginProblem(bodies, problem);
  for (const RigidBody& body : bodies) {
    Vec6 twist;
    twist << body.v, body.omega;
    problem.vStar.push_back(twist);
  }
}

void beginAccelerationProblem(std::span<const RigidBody> bodies, Problem& problem) {
  beginProblem(bodies, problem);
  for (const RigidBody& body : bodies) {
    Vec6 acceleration = Vec6::Zero();
    if (!body.fixed())
      acceleration << body.invM * body.force, body.Iinv * (body.torque - body.omega.cross(body.L));
    problem.vStar.push_back(acceleration);
  }
}

}  // namespace tumble
