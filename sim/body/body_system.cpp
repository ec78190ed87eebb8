#include "sim/body/body_system.h"

#include <utility>

#include "sim/math/rotation.h"

namespace tumble {
namespace {

/// One body's share of Y.
template <class Number>
std::span<Number> share(std::span<Number> y, std::size_t body) {
  return y.subspan(body * kStateSize, kStateSize);
}

}  // namespace

BodySystem::BodySystem(const Vec3& gravity, std::vector<Force> forces,
                       std::vector<RigidBody> bodies)
    : gravity_(gravity), forces_(std::move(forces)), bodies_(std::move(bodies)) {}

int BodySystem::size() const {
  return kStateSize * static_cast<int>(bodies_.size());
}

void BodySystem::load(std::span<const double> y) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) arrayToState(share(y, i), bodies_[i]);
}

void BodySystem::derivative(double /*t*/, std::span<const double> y, std::span<double> ydot) const {
  load(y);
  sumForces(gravity_, forces_, bodies_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) stateDerivative(bodies_[i], share(ydot, i));
}

void BodySystem::kick(double /*t*/, double h, std::span<double> y) const {
  load(y);
  sumForces(gravity_, forces_, bodies_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    RigidBody& body = bodies_[i];
    body.P += h * body.force;
    body.L += h * body.torque;
    stateToArray(body, share(y, i));
  }
}

void BodySystem::drift(double /*t*/, double h, std::span<double> y) const {
  load(y);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    RigidBody& body = bodies_[i];
    body.x += h * body.v;
    body.q = rotated(body.q, h * body.omega);
    stateToArray(body, share(y, i));
  }
}

void BodySystem::normalise(std::span<double> y) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const std::span<double> q = share(y, i).subspan(3, 4);
    const double length = Eigen::Map<const Vec4>(q.data()).norm();
    for (double& component : q) component /= length;
  }
}

void BodySystem::toArray(std::span<double> y) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) stateToArray(bodies_[i], share(y, i));
}

void BodySystem::fromArray(std::span<const double> y) {
  load(y);
}

}  // namespace tumble
