#include "sim/body/body_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/math/rotation.h"

namespace tumble {
namespace {

using ConstVec3 = Eigen::Map<const Vec3>;

}  // namespace

BodySystem::BodySystem(const Vec3& gravity, std::vector<Force> forces,
                       std::vector<RigidBody> bodies, std::vector<Pivot> pivots, Attitude attitude)
    : gravity_(gravity),
      forces_(std::move(forces)),
      bodies_(std::move(bodies)),
      pivots_(std::move(pivots)),
      pivotOf_(bodies_.size(), -1),
      attitude_(attitude) {
  for (std::size_t k = 0; k < pivots_.size(); ++k) pivotOf_[pivots_[k].body] = static_cast<int>(k);
  offset_.push_back(0);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    turns_.emplace_back(pivotOf_[i] < 0 ? bodies_[i].IbodyInv : pivots_[pivotOf_[i]].IbodyInv);
    offset_.push_back(offset_.back() + stateSize(bodies_[i], attitude_));
  }
}

void BodySystem::toArray(std::span<const RigidBody> bodies, std::span<double> y) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) stateToArray(bodies[i], share(y, i), attitude_);
}

void BodySystem::fromArray(std::span<const double> y, std::span<RigidBody> bodies) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) arrayToState(share(y, i), bodies[i], attitude_);
}

void BodySystem::sumForces(std::span<RigidBody> bodies) const {
  ++evaluations_;
  tumble::sumForces(gravity_, forces_, bodies);
  for (const Pivot& pivot : pivots_) addReaction(pivot, bodies[pivot.body]);
}

void BodySystem::rates(std::span<const RigidBody> bodies, std::span<double> ydot) const {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    stateDerivative(bodies[i], share(ydot, i), attitude_);
}

void BodySystem::derivative(double /*t*/, std::span<const double> y, std::span<double> ydot) const {
  fromArray(y);
  sumForces(bodies_);
  rates(bodies_, ydot);
}

Offers BodySystem::offers() const {
  Offers offers{.lie = true};
  if (attitude_ == Attitude::Matrix) return offers;
  offers.split = Split::Exact;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (!bodies_[i].fixed() && !turns_[i].exact()) offers.split = Split::Symmetric;
  if (std::any_of(forces_.begin(), forces_.end(), dependsOnVelocity)) offers.split = Split::Rough;
  offers.jet = BodyJet::covers(forces_, bodies_, pivotOf_);
  return offers;
}

void BodySystem::push(double h, std::span<RigidBody> bodies, std::span<double> y) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    RigidBody& body = bodies[i];
    if (pivotOf_[i] < 0) {
      body.P += h * body.force;
      body.L += h * body.torque;
    } else {
      // The reaction has no torque about the pivot.
      const Pivot& pivot = pivots_[pivotOf_[i]];
      const Vec3 torque = body.torque - (body.R * pivot.c_B).cross(body.force);
      hold(pivot, momentumAbout(pivot, body) + h * torque, body);
    }
    stateToArray(body, share(y, i), attitude_);
  }
}

void BodySystem::kick(double /*t*/, double h, std::span<double> y) const {
  fromArray(y);
  sumForces(bodies_);
  push(h, bodies_, y);
}

void BodySystem::drift(double /*t*/, double h, std::span<double> y) const {
  fromArray(y);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    RigidBody& body = bodies_[i];
    if (pivotOf_[i] >= 0) {
      const Pivot& pivot = pivots_[pivotOf_[i]];
      const Vec3 H = momentumAbout(pivot, body);
      body.q = turns_[i](body.q, H, h);
      hold(pivot, H, body);
    } else {
      body.x += h * body.v;
      if (body.fixed())
        body.q = rotated(body.q, h * body.omega);
      else if (!body.particle)
        body.q = turns_[i](body.q, body.L, h);
    }
    stateToArray(body, share(y, i), attitude_);
  }
}

void BodySystem::normalise(std::span<double> y) const {
  if (attitude_ == Attitude::Matrix) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].particle) continue;
    double* q = &share(y, i)[3];
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; ++k) q[k] /= length;
  }
  for (const Pivot& pivot : pivots_) {
    RigidBody& body = bodies_[pivot.body];
    const std::span<double> held = share(y, static_cast<std::size_t>(pivot.body));
    arrayToState(held, body);
    hold(pivot, momentumAbout(pivot, body), body);
    stateToArray(body, held);
  }
}

void BodySystem::jet(double /*t*/, std::span<const double> y, int order,
                     std::span<double> coefficients) const {
  fromArray(y);
  evaluations_ += order;
  jet_.expand(gravity_, forces_, pivots_, pivotOf_, bodies_, order);
  const std::size_t stride = coefficients.size() / (static_cast<std::size_t>(order) + 1);
  std::copy(y.begin(), y.end(), coefficients.begin());
  for (int k = 1; k <= order; ++k) {
    double* to = &coefficients[k * stride];
    const auto put = [&](const auto& v) { to = std::copy(v.begin(), v.end(), to); };
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const BodySeries& s = jet_.body(i);
      put(s.x[k]);
      if (!bodies_[i].particle) put(s.q[k]);
      put(s.P[k]);
      if (!bodies_[i].particle) put(s.L[k]);
    }
  }
}

Vec3 BodySystem::jetMomentum(int k) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < bodies_.size(); ++i) sum += jet_.body(i).P[k];
  return sum;
}

// An increment has a number less than Y for each quaternion, six less for each matrix.
int BodySystem::algebraSize() const {
  int sum = 0;
  for (const RigidBody& body : bodies_) sum += body.particle ? 6 : 12;
  return sum;
}

void BodySystem::algebra(double /*t*/, std::span<const double> y, std::span<double> a) const {
  fromArray(y);
  sumForces(bodies_);
  increments(bodies_, a);
}

void BodySystem::increments(std::span<const RigidBody> bodies, std::span<double> a) const {
  double* to = a.data();
  const auto put = [&](const Vec3& v) {
    for (int k = 0; k < 3; ++k) *to++ = v[k];
  };
  for (const RigidBody& body : bodies) {
    put(body.v);
    if (!body.particle) put(body.omega);
    put(body.force);
    if (!body.particle) put(body.torque);
  }
}

void BodySystem::commutator(std::span<const double> a, std::span<const double> b,
                            std::span<double> out) const {
  std::fill(out.begin(), out.end(), 0.0);
  int at = 0;
  for (const RigidBody& body : bodies_) {
    if (!body.particle) {
      const Vec3 c = ConstVec3(&a[at + 3]).cross(ConstVec3(&b[at + 3]));
      std::copy(c.begin(), c.end(), &out[at + 3]);
    }
    at += body.particle ? 6 : 12;
  }
}

void BodySystem::act(std::span<const double> a, std::span<double> y) const {
  fromArray(y);
  int at = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    RigidBody& body = bodies_[i];
    const double* step = &a[at];
    body.x += ConstVec3(step);
    if (body.particle) {
      body.P += ConstVec3(step + 3);
    } else {
      const Vec3 w = ConstVec3(step + 3);
      if (attitude_ == Attitude::Matrix)
        body.R = rotationMatrix(rotated(Quat::Identity(), w)) * body.R;
      else
        body.q = rotated(body.q, w);
      body.P += ConstVec3(step + 6);
      body.L += ConstVec3(step + 9);
    }
    stateToArray(body, share(y, i), attitude_);
    at += body.particle ? 6 : 12;
  }
}

}  // namespace tumble
