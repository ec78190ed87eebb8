#include "sim/method/course/system.h"

#include <algorithm>
#include <cmath>

#include "sim/body/force.h"

namespace tumble {
namespace {

/// One body's share of Y.
template <class T>
std::span<T> share(std::span<T> y, std::size_t body) {
  return y.subspan(body * kStateSize, kStateSize);
}

constexpr int kMomenta = 7;  // where P and L begin in a body's share

}  // namespace

CourseSystem::CourseSystem(const Model& model, std::span<const RigidBody> bodies,
                           std::vector<Contact> contacts, double tau)
    : model_(model),
      bodies_(bodies.begin(), bodies.end()),
      contacts_(std::move(contacts)),
      rest_(tau),
      rate_(size()) {}

int CourseSystem::size() const {
  return static_cast<int>(bodies_.size()) * kStateSize + kLedgerSize;
}

void CourseSystem::pack(std::span<const RigidBody> bodies, std::span<double> y) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) stateToArray(bodies[i], share(y, i));
  std::fill(y.end() - kLedgerSize, y.end(), 0.0);
}

void CourseSystem::unpack(std::span<const double> y, std::span<RigidBody> bodies) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) arrayToState(share(y, i), bodies[i]);
}

Ledger CourseSystem::ledger(std::span<const double> y) const {
  const double* last = &y[y.size() - kLedgerSize];
  return {last[0], last[1], {last[2], last[3], last[4]}};
}

SolveReport CourseSystem::findForces(std::span<RigidBody> bodies) const {
  sumForces(model_.def.gravity, model_.def.forces, bodies);
  outerForce_.setZero();
  for (const RigidBody& body : bodies)
    if (!body.fixed()) outerForce_ += body.force;
  for (Contact& c : contacts_) follow(bodies[c.a], bodies[c.b], c);
  return rest_.apply(bodies, contacts_);
}

void CourseSystem::derivative(double /*t*/, std::span<const double> y,
                              std::span<double> ydot) const {
  unpack(y, bodies_);
  const SolveReport solved = findForces(bodies_);
  residual_ = std::max(residual_, solved.residual);
  unsolved_ = unsolved_ || solved.status != SolveStatus::Solved;
  for (std::size_t i = 0; i < bodies_.size(); ++i) stateDerivative(bodies_[i], share(ydot, i));

  // The ledger: power of outer forces and of moving fixed bodies, power lost to friction, outer
  // force.
  double power = powerOfForces(model_.def.forces, bodies_), lost = 0.0;
  Vec3 outer = outerForce_;
  for (const Contact& c : contacts_) {
    const RigidBody &a = bodies_[c.a], &b = bodies_[c.b];
    if (c.friction > 0.0) lost -= c.force.dot(slipVelocity(a, b, c.point));
    if (b.fixed()) {
      power += c.force.dot(pointVelocity(b, c.point.p));
      outer += c.force;
    } else if (a.fixed()) {
      power -= c.force.dot(pointVelocity(a, c.point.p));
      outer -= c.force;
    }
  }
  double* last = &ydot[ydot.size() - kLedgerSize];
  last[0] = power;
  last[1] = lost;
  for (int k = 0; k < 3; ++k) last[2 + k] = outer[k];
}

void CourseSystem::kick(double t, double h, std::span<double> y) const {
  derivative(t, y, rate_);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    for (int k = kMomenta; k < kStateSize; ++k)
      y[i * kStateSize + k] += h * rate_[i * kStateSize + k];
  for (std::size_t k = y.size() - kLedgerSize; k < y.size(); ++k) y[k] += h * rate_[k];
}

void CourseSystem::drift(double /*t*/, double h, std::span<double> y) const {
  unpack(y, bodies_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    stateDerivative(bodies_[i], share(std::span<double>(rate_), i));
    for (int k = 0; k < kMomenta; ++k) y[i * kStateSize + k] += h * rate_[i * kStateSize + k];
  }
}

void CourseSystem::normalise(std::span<double> y) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    double* q = &y[i * kStateSize + 3];
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; ++k) q[k] /= length;
  }
}

}  // namespace tumble
