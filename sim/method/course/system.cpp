#include "sim/method/course/system.h"

#include <algorithm>
#include <limits>

namespace tumble {
namespace {

template <class Number>
std::span<Number> withoutLedger(std::span<Number> y) {
  return y.first(y.size() - CourseSystem::kLedgerSize);
}

/// Adds h · rates to the ledger at the end of y.
void addLedger(const Ledger& rates, double h, std::span<double> y) {
  double* last = &y[y.size() - CourseSystem::kLedgerSize];
  last[0] += h * rates.work;
  last[1] += h * rates.taken;
  for (int k = 0; k < 3; ++k) last[2 + k] += h * rates.impulse[k];
}

}  // namespace

CourseSystem::CourseSystem(const Model& model, std::span<const RigidBody> bodies)
    : model_(model),
      bodies_(model.def.gravity, model.def.forces, {bodies.begin(), bodies.end()}, model.pivots,
              model.def.course.attitude == "matrix" ? Attitude::Matrix : Attitude::Quaternion),
      work_(bodies.begin(), bodies.end()),
      moving_(countMoving(bodies)),
      contacts_(findContactModel(model.def.course.contact)->make(model)) {}

void CourseSystem::begin(const std::vector<Contact>& contacts, const std::vector<Limit>& limits) {
  contacts_->begin(contacts, limits);
  residual_ = 0.0;
  unsolved_ = false;
}

void CourseSystem::pack(std::span<const RigidBody> bodies, std::span<double> y) const {
  bodies_.toArray(bodies, withoutLedger(y));
  std::fill(y.end() - kLedgerSize, y.end(), 0.0);
}

void CourseSystem::unpack(std::span<const double> y, std::span<RigidBody> bodies) const {
  bodies_.fromArray(withoutLedger(y), bodies);
}

Ledger CourseSystem::ledger(std::span<const double> y) const {
  const double* last = &y[y.size() - kLedgerSize];
  return {last[0], last[1], {last[2], last[3], last[4]}};
}

SolveReport CourseSystem::findForces(std::span<RigidBody> bodies) const {
  bodies_.sumForces(bodies);
  outerForce_.setZero();
  for (const RigidBody& body : bodies)
    if (!body.fixed()) outerForce_ += body.force;
  return contacts_->apply(bodies);
}

void CourseSystem::load(std::span<const double> y) const {
  unpack(y, work_);
  const SolveReport solved = findForces(work_);
  residual_ = std::max(residual_, solved.residual);
  unsolved_ = unsolved_ || solved.status != SolveStatus::Solved;
  effort.done += moving_ * std::max(1, solved.iterations);
}

Ledger CourseSystem::contactRates() const {
  Ledger rates{.taken = contacts_->powerTaken(work_), .impulse = outerForce_};
  for (const Contact& c : contacts()) {
    const RigidBody &a = work_[c.a], &b = work_[c.b];
    if (b.fixed()) {
      rates.work += c.force.dot(pointVelocity(b, c.point.p));
      rates.impulse += c.force;
    } else if (a.fixed()) {
      rates.work -= c.force.dot(pointVelocity(a, c.point.p));
      rates.impulse -= c.force;
    }
  }
  if (const Bonds& bonds = contacts_->bonds(); !bonds.empty()) {
    const OuterBonds outer = outerBonds(bonds, work_);
    rates.work += outer.power;
    rates.impulse += outer.force;
  }
  return rates;
}

void CourseSystem::derivative(double /*t*/, std::span<const double> y,
                              std::span<double> ydot) const {
  if (effort.spent()) {
    std::fill(ydot.begin(), ydot.end(), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  load(y);
  bodies_.rates(work_, withoutLedger(ydot));
  Ledger rates = contactRates();
  rates.work += powerOfForces(model_.def.forces, work_);
  std::fill(ydot.end() - kLedgerSize, ydot.end(), 0.0);
  addLedger(rates, 1.0, ydot);
}

Offers CourseSystem::offers() const {
  return contacts_->offers(bodies_.offers());
}

Vec3 CourseSystem::heldMomentum() const {
  Vec3 sum = Vec3::Zero();
  for (const Pivot& pivot : model_.pivots) sum += work_[pivot.body].P;
  return sum;
}

// A pivot gives what the momentum of its body gains, in kicks and in drifts.
void CourseSystem::kick(double /*t*/, double h, std::span<double> y) const {
  load(y);
  Ledger rates = contactRates();
  for (const Pivot& pivot : model_.pivots) rates.impulse -= work_[pivot.body].force;
  addLedger(rates, h, y);
  const Vec3 before = heldMomentum();
  bodies_.push(h, work_, withoutLedger(y));
  addLedger({.impulse = heldMomentum() - before}, 1.0, y);
}

// The work of outer forces is done where points move: here, by Simpson's rule.
void CourseSystem::drift(double t, double h, std::span<double> y) const {
  if (model_.def.forces.empty() && model_.pivots.empty())
    return bodies_.drift(t, h, withoutLedger(y));
  const auto power = [&](std::span<const double> at) {
    unpack(at, work_);
    return powerOfForces(model_.def.forces, work_);
  };
  const double before = power(y);
  const Vec3 momentum = heldMomentum();
  half_.assign(y.begin(), y.end());
  bodies_.drift(t, 0.5 * h, withoutLedger(std::span<double>(half_)));
  const double between = power(half_);
  bodies_.drift(t, h, withoutLedger(y));
  const double after = power(y);
  addLedger(
      {.work = h / 6.0 * (before + 4.0 * between + after), .impulse = heldMomentum() - momentum},
      1.0, y);
}

void CourseSystem::jet(double t, std::span<const double> y, int order,
                       std::span<double> coefficients) const {
  bodies_.jet(t, withoutLedger(y), order, coefficients);
  std::copy(y.end() - kLedgerSize, y.end(), &coefficients[bodies_.size()]);
  for (int k = 1; k <= order; ++k) {
    const std::span<double> last = coefficients.subspan(k * y.size() + bodies_.size(), kLedgerSize);
    last[0] = bodies_.jetPower(k - 1) / k;
    last[1] = 0.0;
    // Free of contact, all that changes momentum comes from outside.
    const Vec3 impulse = bodies_.jetMomentum(k);
    std::copy(impulse.begin(), impulse.end(), &last[2]);
  }
}

void CourseSystem::algebra(double /*t*/, std::span<const double> y, std::span<double> a) const {
  load(y);
  bodies_.increments(work_, withoutLedger(a));
  Ledger rates = contactRates();
  rates.work += powerOfForces(model_.def.forces, work_);
  std::fill(a.end() - kLedgerSize, a.end(), 0.0);
  addLedger(rates, 1.0, a);
}

void CourseSystem::commutator(std::span<const double> a, std::span<const double> b,
                              std::span<double> out) const {
  bodies_.commutator(withoutLedger(a), withoutLedger(b), withoutLedger(out));
  std::fill(out.end() - kLedgerSize, out.end(), 0.0);
}

void CourseSystem::act(std::span<const double> a, std::span<double> y) const {
  bodies_.act(withoutLedger(a), withoutLedger(y));
  addLedger(ledger(a), 1.0, y);
}

void CourseSystem::normalise(std::span<double> y) const {
  bodies_.normalise(withoutLedger(y));
}

}  // namespace tumble
