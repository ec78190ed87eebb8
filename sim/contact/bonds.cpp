#include "sim/contact/bonds.h"

namespace tumble {
namespace {

bool isWorld(int body, std::span<const RigidBody> bodies) {
  return body >= static_cast<int>(bodies.size());
}

/// What λ of a row gives to its two bodies.
template <class Give>
void forBodies(const Bonds& bonds, std::span<RigidBody> bodies, Give give) {
  for (std::size_t i = 0; i < bonds.rows.size(); ++i) {
    const Row& row = bonds.rows[i];
    const double lambda = bonds.lambda[i];
    give(bodies[row.a], lambda * row.linear, lambda * row.angularA);
    if (!isWorld(row.b, bodies)) give(bodies[row.b], -lambda * row.linear, lambda * row.angularB);
  }
}

}  // namespace

void Bonds::clear() {
  misfit = 0.0;
  rows.clear();
  kinds.clear();
  owners.clear();
  places.clear();
  lambda.clear();
}

void Bonds::add(const Row& row, ConeKind kind, int owner, int place) {
  rows.push_back(row);
  kinds.push_back(kind);
  owners.push_back(owner);
  places.push_back(place);
  lambda.push_back(0.0);
}

void appendBonds(const Bonds& bonds, Problem& problem) {
  if (bonds.empty()) return;
  problem.invM.push_back(0.0);
  problem.Iinv.push_back(Mat3::Zero());
  problem.vStar.push_back(Vec6::Zero());
  for (std::size_t i = 0; i < bonds.rows.size(); ++i) {
    problem.cones.push_back(
        {.kind = bonds.kinds[i], .row = static_cast<int>(problem.rows.size()), .mu = 0.0});
    problem.rows.push_back(bonds.rows[i]);
  }
}

void readBonds(std::span<const double> lambda, std::size_t firstRow, Bonds& bonds) {
  for (std::size_t i = 0; i < bonds.rows.size(); ++i) bonds.lambda[i] = lambda[firstRow + i];
}

void addBondForces(const Bonds& bonds, std::span<RigidBody> bodies) {
  forBodies(bonds, bodies, [](RigidBody& body, const Vec3& force, const Vec3& torque) {
    if (body.fixed()) return;
    body.force += force;
    if (!body.particle) body.torque += torque;
  });
}

void addBondImpulses(const Bonds& bonds, std::span<RigidBody> bodies) {
  forBodies(bonds, bodies, [](RigidBody& body, const Vec3& impulse, const Vec3& turn) {
    if (body.fixed()) return;
    body.P += impulse;
    if (!body.particle) body.L += turn;
  });
  for (RigidBody& body : bodies) updateDerived(body);
}

double bondVelocity(const Row& row, std::span<const RigidBody> bodies) {
  const RigidBody& a = bodies[row.a];
  double u = row.linear.dot(a.v) + row.angularA.dot(a.omega);
  if (isWorld(row.b, bodies)) return u;
  const RigidBody& b = bodies[row.b];
  return u - row.linear.dot(b.v) + row.angularB.dot(b.omega);
}

double bondAcceleration(const Row& row, std::span<const RigidBody> bodies) {
  const auto part = [&](const RigidBody& body, const Vec3& linear, const Vec3& angular) {
    if (body.fixed()) return 0.0;
    return linear.dot(body.invM * body.force) +
           angular.dot(body.Iinv * (body.torque - body.omega.cross(body.L)));
  };
  const double a = part(bodies[row.a], row.linear, row.angularA) + row.bias;
  return isWorld(row.b, bodies) ? a : a + part(bodies[row.b], -row.linear, row.angularB);
}

OuterBonds outerBonds(const Bonds& bonds, std::span<const RigidBody> bodies) {
  OuterBonds sum;
  for (std::size_t i = 0; i < bonds.rows.size(); ++i) {
    const Row& row = bonds.rows[i];
    const double lambda = bonds.lambda[i];
    const RigidBody& a = bodies[row.a];
    if (isWorld(row.b, bodies)) {
      sum.force += lambda * row.linear;
    } else if (const RigidBody& b = bodies[row.b]; b.fixed()) {
      sum.force += lambda * row.linear;
      sum.power -= lambda * (row.angularB.dot(b.omega) - row.linear.dot(b.v));
    } else if (a.fixed()) {
      sum.force -= lambda * row.linear;
      sum.power -= lambda * (row.angularA.dot(a.omega) + row.linear.dot(a.v));
    }
  }
  return sum;
}

}  // namespace tumble
