#include "sim/contact/rows.h"

namespace tumble {
namespace {

void addMass(const RigidBody& body, Problem& problem) {
  problem.invM.push_back(body.invM);
  problem.Iinv.push_back(body.Iinv);
}

void addTwist(const RigidBody& body, Problem& problem) {
  Vec6& twist = problem.vStar.emplace_back();
  twist << body.v, body.omega;
}

void beginProblem(std::span<const RigidBody> bodies, Problem& problem) {
  problem.invM.clear();
  problem.Iinv.clear();
  problem.vStar.clear();
  problem.rows.clear();
  problem.cones.clear();
  problem.couplings.clear();
  for (const RigidBody& body : bodies) addMass(body, problem);
}

}  // namespace

void beginVelocityProblem(std::span<const RigidBody> bodies, Problem& problem) {
  beginProblem(bodies, problem);
  for (const RigidBody& body : bodies) addTwist(body, problem);
}

int addToVelocityProblem(const RigidBody& body, Problem& problem) {
  addMass(body, problem);
  addTwist(body, problem);
  return static_cast<int>(problem.invM.size()) - 1;
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
