#include "sim/joint/joint_bonds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/contact/rows.h"
#include "sim/joint/joint_rows.h"
#include "sim/math/frames.h"

namespace tumble {
namespace {

/// Calls see(joint, row) for all rows of all joints.
template <class See>
void forRows(std::span<const RigidBody> bodies, std::span<const Joint> joints, See see) {
  thread_local std::vector<JointRow> rows;  // keeps its storage from call to call
  for (int k = 0; k < static_cast<int>(joints.size()); ++k) {
    jointRows(bodies, joints[k], rows);
    for (const JointRow& row : rows) see(k, row);
  }
}

Limit limitOf(int joint, const JointRow& row) {
  return 2 * joint + row.limit;
}

bool among(std::span<const Limit> limits, Limit limit) {
  return std::find(limits.begin(), limits.end(), limit) != limits.end();
}

/// u of a row at these velocities, without bias. Fixed bodies and the world: what they have.
double along(const Row& row, std::span<const Vec6> v) {
  double u = row.linear.dot(v[row.a].head<3>()) + row.angularA.dot(v[row.a].tail<3>());
  if (row.b < static_cast<int>(v.size()))
    u += row.angularB.dot(v[row.b].tail<3>()) - row.linear.dot(v[row.b].head<3>());
  return u;
}

/// J v̇ of a row [m/s², rad/s²] while its bodies turn freely: ω̇ = −I⁻¹ (ω × L).
double rotorRate(std::span<const RigidBody> bodies, const Row& row) {
  const auto rate = [&](int i, const Vec3& angular) {
    if (i >= static_cast<int>(bodies.size()) || bodies[i].fixed() || bodies[i].particle) return 0.0;
    const RigidBody& body = bodies[i];
    return -angular.dot(body.Iinv * body.omega.cross(body.L));
  };
  return rate(row.a, row.angularA) + rate(row.b, row.angularB);
}

void addRow(const JointRow& found, double bias, int joint, Bonds& bonds) {
  Row row = found.row;
  row.bias = bias;
  bonds.add(row, found.limit < 0 ? ConeKind::Equality : ConeKind::Push, joint, found.place);
}

}  // namespace

void restBonds(std::span<const RigidBody> bodies, std::span<const Joint> joints,
               std::span<const Limit> limits, double tau, Bonds& bonds) {
  bonds.clear();
  forRows(bodies, joints, [&](int joint, const JointRow& row) {
    if (row.limit >= 0 && !among(limits, limitOf(joint, row))) return;
    addRow(row, row.row.bias + 2.0 / tau * row.rate + row.gap / (tau * tau), joint, bonds);
    if (row.limit < 0)
      bonds.misfit = std::max(bonds.misfit, row.arm * std::abs(row.gap) / joints[joint].arm);
  });
}

void impactBonds(std::span<const RigidBody> bodies, std::span<const Joint> joints, double touch,
                 Bonds& bonds) {
  bonds.clear();
  forRows(bodies, joints, [&](int joint, const JointRow& row) {
    if (row.limit >= 0 && row.arm * row.gap > touch) return;
    addRow(row, 0.0, joint, bonds);
  });
}

void beginAllowedVelocities(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                            Bonds& bonds, Problem& problem) {
  impactBonds(bodies, joints, -std::numeric_limits<double>::infinity(), bonds);
  beginVelocityProblem(bodies, problem);
  appendBonds(bonds, problem);
}

void stepBonds(std::span<const RigidBody> bodies, std::span<const Joint> joints,
               std::span<const Vec6> vStar, double h, double touch, Bonds& bonds) {
  constexpr double kNear = 0.5;  // share of a limit's gap that a step may use up unseen
  bonds.clear();
  forRows(bodies, joints, [&](int joint, const JointRow& row) {
    const double bias = row.gap / h + 0.5 * h * (row.row.bias + rotorRate(bodies, row.row));
    // What is reached is not left out: what turns it may be the joint's own force, which no vStar
    // foresees.
    if (row.limit >= 0 && bias + along(row.row, vStar) > kNear * row.gap / h &&
        row.arm * row.gap > touch)
      return;
    addRow(row, bias, joint, bonds);
  });
}

void liftBonds(std::span<const RigidBody> bodies, std::span<const Joint> joints, Bonds& bonds) {
  constexpr double kNeighbour = 1e-4;  // [m] limits nearer than this take part
  bonds.clear();
  forRows(bodies, joints, [&](int joint, const JointRow& row) {
    if (row.limit >= 0 && row.arm * row.gap > kNeighbour) return;
    addRow(row, row.gap, joint, bonds);
  });
}

std::vector<Limit> restingLimits(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                                 double touch, double rest, double keep,
                                 std::span<const Limit> before) {
  std::vector<Limit> limits;
  forRows(bodies, joints, [&](int joint, const JointRow& row) {
    if (row.limit < 0 || row.arm * row.gap > touch) return;
    const Limit limit = limitOf(joint, row);
    if (row.arm * row.rate <= (among(before, limit) ? keep : rest)) limits.push_back(limit);
  });
  return limits;
}

double limitApproach(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                     double touch) {
  double fastest = 0.0;
  forRows(bodies, joints, [&](int, const JointRow& row) {
    if (row.limit >= 0 && row.arm * row.gap <= touch)
      fastest = std::min(fastest, row.arm * row.rate);
  });
  return fastest;
}

void jointForces(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                 const Bonds& bonds, double h, std::vector<JointForce>& forces) {
  forces.assign(joints.size(), {});
  for (std::size_t k = 0; k < joints.size(); ++k) {
    forces[k].joint = static_cast<int>(k);
    forces[k].a = joints[k].a;
    forces[k].b = joints[k].b;
    forces[k].p = toWorld(bodies[joints[k].a].pose(), joints[k].anchorA_B);
  }
  for (std::size_t i = 0; i < bonds.rows.size(); ++i) {
    if (bonds.owners[i] < 0) continue;
    const Row& row = bonds.rows[i];
    JointForce& force = forces[bonds.owners[i]];
    const Vec3 part = bonds.lambda[i] / h * row.linear;
    force.force += part;
    force.torque += bonds.lambda[i] / h * row.angularA - (force.p - bodies[row.a].x).cross(part);
  }
}

}  // namespace tumble
