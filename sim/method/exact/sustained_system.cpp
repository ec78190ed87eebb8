#include "sim/method/exact/sustained_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collide/align.h"
#include "sim/math/rotation.h"

namespace tumble {
namespace {

template <class Number>
std::span<Number> bodiesOf(std::span<Number> y, int books) {
  return y.first(y.size() - static_cast<std::size_t>(books));
}

/// For quaternions one, for lengths too but where all is small, mass times that for P, the largest
/// moment of inertia for L; for the books the mass of all, times its square: energies.
std::vector<double> unitsOf(double size, std::span<const RigidBody> bodies, int books) {
  const double length = std::min(1.0, ContactTolerance::scaleOf(size));
  std::vector<double> unit;
  double all = 0.0;
  for (const RigidBody& body : bodies) {
    const double mass = body.fixed() ? 1.0 : body.M;
    const double inertia = body.fixed() ? 1.0 : body.Ibody.diagonal().maxCoeff();
    if (!body.fixed()) all += mass;
    unit.insert(unit.end(), 3, length);
    if (!body.particle) unit.insert(unit.end(), 4, 1.0);
    unit.insert(unit.end(), 3, length * mass);
    if (!body.particle) unit.insert(unit.end(), 3, inertia);
  }
  unit.insert(unit.end(), static_cast<std::size_t>(books), length * length * all);
  return unit;
}

/// [1] Sine of the angle up to which two axes are one.
constexpr double kOneAxis = 1e-12;

/// Whether no force depends on how the body is turned, and it turns.
bool isBall(const Shape& shape, const RigidBody& body) {
  const Vec3 inertia = body.Ibody.diagonal();
  return std::holds_alternative<Sphere>(shape) && !body.fixed() && !body.particle &&
         body.Ibody == inertia.x() * Mat3::Identity();
}

/// Whether the normal of a contact on a rim comes to the rim's axis at these poses: there it would
/// lie on a cap, and nothing says where on the rim it is.
bool liesFlat(const RigidBody& a, const RigidBody& b, Contact c) {
  constexpr double kFlat = 1e-6;  // [1] of its lean
  const ContactPoint& point = c.point;
  if (point.rimA == 0.0 && point.rimB == 0.0) return false;
  if (point.tie == NormalTie::FaceOfA || point.tie == NormalTie::FaceOfB) return false;
  follow(a, b, c);
  return !(std::min(rimOfA(point).lean, rimOfB(point).lean) > kFlat);
}

/// exp(½ θ), θ = ω₀ t + ½ α t².
Quat turned(const Vec3& spin, const Vec3& rate, double t) {
  return rotated(Quat::Identity(), t * (spin + 0.5 * t * rate));
}

}  // namespace

SustainedSystem::SustainedSystem(const Model& model, std::span<const RigidBody> bodies)
    : model_(model),
      bodies_(model.def.gravity, model.def.forces, {bodies.begin(), bodies.end()}, model.pivots),
      unit_(unitsOf(model.size, bodies, kBooks)),
      work_(bodies.begin(), bodies.end()),
      moving_(countMoving(bodies)),
      plain_(unit_.size()) {
  std::size_t slot = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool held = std::any_of(model.pivots.begin(), model.pivots.end(),
                                  [&](const Pivot& p) { return p.body == static_cast<int>(i); });
    if (isBall(model.shapes[i], bodies[i]) && !held) balls_.push_back({i, slot + 3});
    slot += static_cast<std::size_t>(stateSize(bodies[i]));
  }
}

void SustainedSystem::turnFrom(std::span<const RigidBody> bodies) {
  for (Ball& ball : balls_) {
    const RigidBody& body = bodies[ball.body];
    ball.spin = body.omega;
    ball.rate = body.Iinv * body.torque;
    const double across = ball.spin.cross(ball.rate).norm();
    if (across > kOneAxis * ball.spin.norm() * ball.rate.norm()) ball.rate.setZero();
  }
}

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

void SustainedSystem::unpack(double t, std::span<const double> y,
                             std::span<RigidBody> bodies) const {
  unpack(y, bodies);
  for (const Ball& ball : balls_) {
    RigidBody& body = bodies[ball.body];
    body.q = (turned(ball.spin, ball.rate, t) * body.q).normalized();
    updateDerived(body);
  }
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
  const double before = modes_.cubes();
  modes_.apply(bodies, contacts_);
  effort.done += moving_ + static_cast<long>(contacts_.size()) +
                 std::lround((modes_.cubes() - before) / Effort::kCubes);
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

void SustainedSystem::derivative(double t, std::span<const double> y,
                                 std::span<double> ydot) const {
  if (effort.spent()) {
    std::fill(ydot.begin(), ydot.end(), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  unpack(y, work_);
  findForces(work_);
  bodies_.rates(work_, bodiesOf(ydot, kBooks));
  for (const Ball& ball : balls_) {
    const RigidBody& body = work_[ball.body];
    const Vec3 turn =
        turned(ball.spin, ball.rate, t).conjugate() * (body.omega - ball.spin - t * ball.rate);
    const Quat rate = Quat(0.0, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z()) * body.q;
    double* r = &ydot[ball.slot];
    r[0] = rate.w();
    std::copy_n(rate.vec().data(), 3, r + 1);
  }
  const Books rates = this->rates();
  double* last = &ydot[ydot.size() - kBooks];
  last[0] = rates.work;
  last[1] = rates.rubbed;
  std::copy(rates.impulse.begin(), rates.impulse.end(), last + 2);
  for (std::size_t i = 0; i < ydot.size(); ++i) ydot[i] /= unit_[i];
}

void SustainedSystem::normalise(std::span<double> y) const {
  unpack(y, work_);
  if (std::any_of(contacts_.begin(), contacts_.end(),
                  [this](const Contact& c) { return liesFlat(work_[c.a], work_[c.b], c); }))
    return;
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
