#include "sim/contact/rest.h"

#include "sim/contact/rows.h"

namespace tumble {

Vec3 slidingDirection(std::span<const RigidBody> bodies, const Contact& contact) {
  const Vec3 slip = slipVelocity(bodies[contact.a], bodies[contact.b], contact.point);
  const double along = slip.dot(contact.slipDirection), size = slip.norm();
  if (size <= 0.0 || std::abs(along) < 0.5 * size) {  // too small or turned aside: keep the plane
    Vec3 t1, t2;
    tangents(contact.point.n, contact.slipDirection, t1, t2);
    return t1;
  }
  return along > 0.0 ? Vec3(slip / size) : Vec3(-slip / size);
}

void RestForces::addRows(std::span<const RigidBody> bodies, const Contact& contact) {
  const RigidBody &a = bodies[contact.a], &b = bodies[contact.b];
  const ContactPoint& c = contact.point;
  const double normalBias = normalAccelerationBias(a, b, c) +
                            2.0 / tau_ * approachVelocity(a, b, c) + c.separation / (tau_ * tau_);
  const auto addRow = [&](const Vec3& d, double bias) {
    problem_.rows.push_back(pointRow(bodies, contact.a, contact.b, c.p, d, bias));
  };
  Cone cone{.kind = ConeKind::Push, .row = static_cast<int>(problem_.rows.size())};
  addRow(c.n, normalBias);
  if (contact.friction > 0.0 && contact.sliding) {
    const Vec3 t = slidingDirection(bodies, contact);
    addRow(t, slipAccelerationBias(a, b, c, t));
    cone.kind = ConeKind::Slide;
    cone.mu = contact.friction;
  } else if (contact.friction > 0.0) {
    const Vec3 slip = slipVelocity(a, b, c);
    Vec3 t1, t2;
    tangents(c.n, problem_.vStar[contact.a].head<3>() - problem_.vStar[contact.b].head<3>(), t1,
             t2);
    addRow(t1, slipAccelerationBias(a, b, c, t1) + slip.dot(t1) / tau_);
    addRow(t2, slipAccelerationBias(a, b, c, t2) + slip.dot(t2) / tau_);
    cone.kind = ConeKind::Friction;
    cone.mu = contact.friction;
  }
  problem_.cones.push_back(cone);
}

SolveReport RestForces::apply(std::span<RigidBody> bodies, std::span<Contact> contacts) {
  if (contacts.empty()) return {};
  beginAccelerationProblem(bodies, problem_);
  for (const Contact& contact : contacts) addRows(bodies, contact);
  const SolveReport report = solveByIslands(*findSolver("pivoting"), problem_, {}, solution_);

  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Contact& contact = contacts[i];
    const std::size_t first = problem_.cones[i].row;
    const std::size_t end =
        i + 1 < contacts.size() ? problem_.cones[i + 1].row : problem_.rows.size();
    contact.force.setZero();
    for (std::size_t r = first; r < end; ++r)
      contact.force += solution_.lambda[r] * problem_.rows[r].linear;
    applyForce(bodies[contact.a], contact.point.p, contact.force);
    applyForce(bodies[contact.b], contact.point.p, -contact.force);
  }
  return report;
}

}  // namespace tumble
