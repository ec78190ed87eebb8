#include "sim/method/exact/sustained_system.h"

#include <algorithm>
#include <limits>

namespace tumble {
namespace {

template <class Number>
std::span<Number> bodiesOf(std::span<Number> y, int books) {
  return y.first(y.size() - static_cast<std::size_t>(books));
}

/// One for lengths and quaternions, mass for P, the largest moment of inertia for L; for the books
/// the mass of all.
std::vector<double> unitsOf(std::span<const RigidBody> bodies, int books) {
  std::vector<double> unit;
  double all = 0.0;
  for (const RigidBody& body : bodies) {
    const double mass = body.fixed() ? 1.0 : body.M;
    const double inertia = body.fixed() ? 1.0 : body.Ibody.diagonal().maxCoeff();
    if (!body.fixed()) all += mass;
    unit.insert(unit.end(), body.particle ? 3 : 7, 1.0);
    unit.insert(unit.end(), 3, mass);
    if (!body.particle) unit.insert(unit.end(), 3, inertia);
  }
  unit.insert(unit.end(), static_cast<std::size_t>(books), all);
  return unit;
}

}  // namespace

SustainedSystem::SustainedSystem(const Model& model, std::span<const RigidBody> bodies)
    : model_(model),
      bodies_(model.def.gravity, model.def.forces, {bodies.begin(), bodies.end()}, model.pivots),
      unit_(unitsOf(bodies, kBooks)),
      work_(bodies.begin(), bodies.end()),
      moving_(countMoving(bodies)),
      plain_(unit_.size()) {}

void SustainedSystem::pack(std::span<const RigidBody> bodies, std::span<double> y) const {
  bodies_.toArray(bodies, bodiesOf(y, kBooks));
  std::fill(y.end() - kBooks, y.end(), 0.0);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] /= unit_[i];
}

void SustainedSystem::unpack(std::span<const double> y, std::span<RigidBody> bodies) const {
  for (std::size_t i = 0; i < y.size(); ++i) plain_[i] = y[i] * unit_[i];
  bodies_.fromArray(bodiesOf(std::span<const double>(plain_), kBooks), bodies);
  for (RigidBody& body : bodies) body.q.normalize();
}

SustainedSystem::Books SustainedSystem::books(std::span<const double> y) const {
  const std::size_t first = y.size() - kBooks;
  const auto at = [&](std::size_t k) { return y[first + k] * unit_[first + k]; };
  return {at(0), at(1), {at(2), at(3), at(4)}};
}

void SustainedSystem::findForces(std::span<RigidBody> bodies) const {
  bodies_.sumForces(bodies);
  outerForce_.setZero();
  for (const RigidBody& body : bodies)
    if (!body.fixed()) outerForce_ += body.force;
  for (Contact& c : contacts_) follow(bodies[c.a], bodies[c.b], c);
  modes_.apply(bodies, contacts_);
  effort.done += moving_;
}

SustainedSystem::Books SustainedSystem::rates() const {
  Books rates{.impulse = outerForce_};
  for (const Contact& c : contacts_) {
    const RigidBody &a = work_[c.a], &b = work_[c.b];
    if (c.friction > 0.0) rates.rubbed -= c.force.dot(slipVelocity(a, b, c.point));
    if (b.fixed()) {
      rates.work += c.force.dot(pointVelocity(b, c.point.p));
      rates.impulse += c.force;
    } else if (a.fixed()) {
      rates.work -= c.force.dot(pointVelocity(a, c.point.p));
      rates.impulse -= c.force;
    }
  }
  rates.work += powerOfForces(model_.def.forces, work_);
  return rates;
}

void SustainedSystem::derivative(double /*t*/, std::span<const double> y,
                                 std::span<double> ydot) const {
  if (effort.spent()) {
    std::fill(ydot.begin(), ydot.end(), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  unpack(y, work_);
  findForces(work_);
  bodies_.rates(work_, bodiesOf(ydot, kBooks));
  const Books rates = this->rates();
  double* last = &ydot[ydot.size() - kBooks];
  last[0] = rates.work;
  last[1] = rates.rubbed;
  std::copy(rates.impulse.begin(), rates.impulse.end(), last + 2);
  for (std::size_t i = 0; i < ydot.size(); ++i) ydot[i] /= unit_[i];
}

void SustainedSystem::normalise(std::span<double> y) const {
  unpack(y, work_);
  const Books kept = books(y);
  modes_.project(work_, contacts_);
  pack(work_, y);
  double* last = &y[y.size() - kBooks];
  const double unit = unit_.back();
  last[0] = kept.work / unit;
  last[1] = kept.rubbed / unit;
  for (int k = 0; k < 3; ++k) last[2 + k] = kept.impulse[k] / unit;
}

}  // namespace tumble
