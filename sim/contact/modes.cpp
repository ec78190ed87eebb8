#include "sim/contact/modes.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "sim/contact/rest.h"
#include "sim/contact/rows.h"
#include "sim/math/least_squares.h"
#include "sim/math/rotation.h"

namespace tumble {
namespace {

/// [m/s], times the scale of a contact: slower slips have no direction but the one in which they
/// began.
constexpr double kStill = 1e-10;
/// [1] A slip across the line of its start, below these parts of the slip and of the speeds, is
/// left alone: friction against it would be right, but is stiff where the slip is slow.
constexpr double kStraight = 1e-9, kNoise = 1e-10;

bool sticks(const Contact& c) {
  return c.friction > 0.0 && !c.sliding;
}

double response(const RigidBody& body, const Vec3& pull, const Vec3& turn, const Vec3& push,
                const Vec3& spin) {
  return body.invM * pull.dot(push) + turn.dot(body.Iinv * spin);
}

}  // namespace

Vec3 slipDirectionOf(const RigidBody& a, const RigidBody& b, const Contact& contact) {
  const Vec3 slip = slipVelocity(a, b, contact.point);
  if (const double part = slip.norm() / contact.onset; part < 1.0)
    return ((1.0 - part) * contact.growth + slip / contact.onset).normalized();
  Vec3 t1, t2;  // the direction of the start, in the tangent plane of now
  tangents(contact.point.n, contact.slipDirection, t1, t2);
  const double along = slip.dot(t1), across = std::abs(slip.dot(t2)), size = slip.norm();
  const double speed = pointVelocity(a, contact.point.p).norm();
  if (contact.creeping || size <= kStill * contact.scale || across <= kStraight * size ||
      across <= kNoise * (contact.scale + speed) || std::abs(along) < 0.5 * size)
    return t1;
  return along > 0.0 ? Vec3(slip / size) : Vec3(-slip / size);
}

double ModeForces::product(std::span<const RigidBody> bodies, const Row& row,
                           const Row& force) const {
  double sum = 0.0;
  if (row.a == force.a)
    sum += response(bodies[row.a], row.linear, row.angularA, force.linear, force.angularA);
  if (row.b == force.b)
    sum += response(bodies[row.b], row.linear, row.angularB, force.linear, force.angularB);
  if (row.a == force.b)
    sum += response(bodies[row.a], row.linear, row.angularA, -force.linear, force.angularB);
  if (row.b == force.a)
    sum += response(bodies[row.b], -row.linear, row.angularB, force.linear, force.angularA);
  return sum;
}

void ModeForces::addRows(std::span<const RigidBody> bodies, const Contact& c, bool tangential) {
  const RigidBody &a = bodies[c.a], &b = bodies[c.b];
  const ContactPoint& point = c.point;
  const auto along = [&](const Vec3& d, double bias) {
    return pointRow(bodies, c.a, c.b, point.p, d, bias);
  };
  rows_.push_back(along(point.n, normalAccelerationBias(a, b, point)));
  const bool slides = c.friction > 0.0 && c.sliding && tangential;
  forces_.push_back(slides ? along(point.n - c.friction * slipDirectionOf(a, b, c), 0.0)
                           : rows_.back());
  if (!tangential || !sticks(c)) return;
  Vec3 t1, t2;
  tangents(point.n, Vec3::Zero(), t1, t2);
  for (const Vec3& t : {t1, t2}) {
    rows_.push_back(along(t, slipAccelerationBias(a, b, point, t)));
    forces_.push_back(rows_.back());
  }
}

std::vector<int> ModeForces::heaps(std::span<const RigidBody> bodies) const {
  std::vector<int> of(bodies.size());
  std::iota(of.begin(), of.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Row& row : rows_) {
      if (bodies[row.a].fixed() || bodies[row.b].fixed() || of[row.a] == of[row.b]) continue;
      of[row.a] = of[row.b] = std::min(of[row.a], of[row.b]);
      changed = true;
    }
  }
  std::vector<int> heaps;
  for (const Row& row : rows_) heaps.push_back(of[bodies[row.a].fixed() ? row.b : row.a]);
  return heaps;
}

bool ModeForces::anySlides(std::span<const std::size_t> own) const {
  return std::any_of(own.begin(), own.end(),
                     [&](std::size_t i) { return rows_[i].linear != forces_[i].linear; });
}

MatX ModeForces::mobility(std::span<const RigidBody> bodies,
                          std::span<const std::size_t> own) const {
  const Eigen::Index n = static_cast<Eigen::Index>(own.size());
  MatX result(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      result(i, j) = product(bodies, rows_[own[i]], rows_[own[j]]);
  return result;
}

void ModeForces::solve(std::span<const RigidBody> bodies) {
  const std::vector<int> heap = heaps(bodies);
  lambda_.resize(rhs_.size());
  std::vector<std::size_t> own;
  for (std::size_t first = 0; first < rows_.size(); ++first) {
    if (std::find(heap.begin(), heap.begin() + static_cast<std::ptrdiff_t>(first), heap[first]) !=
        heap.begin() + static_cast<std::ptrdiff_t>(first))
      continue;
    own.clear();
    for (std::size_t i = first; i < rows_.size(); ++i)
      if (heap[i] == heap[first]) own.push_back(i);
    const Eigen::Index n = static_cast<Eigen::Index>(own.size());
    cubes_ += static_cast<double>(n) * static_cast<double>(n) * static_cast<double>(n);
    matrix_.resize(n, n);
    VecX rhs(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      rhs[i] = rhs_[static_cast<Eigen::Index>(own[i])];
      for (Eigen::Index j = 0; j < n; ++j)
        matrix_(i, j) = product(bodies, rows_[own[i]], forces_[own[j]]);
    }
    const VecX lambda = anySlides(own) ? leastSquaresWithin(mobility(bodies, own), matrix_, rhs)
                                       : leastSquares(matrix_, rhs);
    for (Eigen::Index i = 0; i < n; ++i) lambda_[static_cast<Eigen::Index>(own[i])] = lambda[i];
  }
}

void ModeForces::apply(std::span<RigidBody> bodies, std::span<Contact> contacts) {
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (contacts[k].onset > 0.0 && !contacts[k].idle) findGrowth(bodies, contacts, k);
  give(bodies, contacts);
}

// Secants, as many as always, so that the answer is as smooth as the motion. Two places that are
// one but for rounding show no slope.
void ModeForces::findGrowth(std::span<const RigidBody> bodies, std::span<Contact> contacts,
                            std::size_t k) {
  constexpr int kSecants = 4;
  constexpr double kFirst = 1e-2, kSame = 1e-7;
  Contact& c = contacts[k];
  const double onset = c.onset;
  Vec3 t1, t2;
  tangents(c.point.n, c.slipDirection, t1, t2);
  const auto turn = [&](double tangent) { c.growth = (t1 + tangent * t2).normalized(); };
  const auto across = [&](double tangent) {
    turn(tangent);
    tried_.assign(bodies.begin(), bodies.end());
    give(tried_, contacts);
    const Vec3 rate = slipAcceleration(tried_[c.a], tried_[c.b], c.point);
    return rate.dot(t2) - tangent * rate.dot(t1);
  };
  c.onset = std::numeric_limits<double>::infinity();
  double last = 0.0, now = kFirst, offLast = across(last), slope = 0.0;
  for (int secant = 0; secant < kSecants; ++secant) {
    const double off = across(now);
    if (std::abs(now - last) > kSame) slope = (off - offLast) / (now - last);
    const double next = slope == 0.0 ? now : now - off / slope;
    last = now, offLast = off, now = next;
  }
  turn(now);
  c.onset = onset;
}

void ModeForces::give(std::span<RigidBody> bodies, std::span<Contact> contacts) {
  rows_.clear();
  forces_.clear();
  for (const Contact& c : contacts)
    if (!c.idle) addRows(bodies, c, true);
  if (rows_.empty()) return;
  rhs_.resize(static_cast<Eigen::Index>(rows_.size()));
  const auto acceleration = [&](int body, const Vec3& pull, const Vec3& turn) {
    const RigidBody& it = bodies[body];
    if (it.fixed()) return 0.0;
    return pull.dot(it.invM * it.force) + turn.dot(it.Iinv * (it.torque - it.omega.cross(it.L)));
  };
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    rhs_[static_cast<Eigen::Index>(i)] = -row.bias - acceleration(row.a, row.linear, row.angularA) -
                                         acceleration(row.b, -row.linear, row.angularB);
  }
  solve(bodies);
  Eigen::Index k = 0;
  for (Contact& c : contacts) {
    c.force.setZero();
    if (c.idle) continue;
    for (int r = sticks(c) ? 3 : 1; r > 0; --r, ++k)
      c.force += lambda_[k] * forces_[static_cast<std::size_t>(k)].linear;
    applyForce(bodies[c.a], c.point.p, c.force);
    applyForce(bodies[c.b], c.point.p, -c.force);
  }
}

void ModeForces::push(std::span<RigidBody> bodies, bool velocities) {
  const auto give = [&](RigidBody& body, const Vec3& linear, const Vec3& angular) {
    if (body.fixed()) return;
    if (velocities) {
      body.P += linear;
      if (!body.particle) body.L += angular;
    } else {
      body.x += body.invM * linear;
      if (!body.particle) body.q = rotated(body.q, body.Iinv * angular);
    }
  };
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Row& row = rows_[k];
    const double size = lambda_[static_cast<Eigen::Index>(k)];
    give(bodies[row.a], size * row.linear, size * row.angularA);
    give(bodies[row.b], -size * row.linear, size * row.angularB);
  }
  for (RigidBody& body : bodies) updateDerived(body);
}

void ModeForces::project(std::span<RigidBody> bodies, std::span<Contact> contacts) {
  for (const bool velocities : {false, true}) {
    rows_.clear();
    forces_.clear();
    std::vector<double> rhs;
    for (Contact& c : contacts) {
      follow(bodies[c.a], bodies[c.b], c);
      if (c.idle) continue;
      const std::size_t first = rows_.size();
      addRows(bodies, c, velocities);
      for (std::size_t i = first; i < rows_.size(); ++i) {
        forces_[i] = rows_[i];
        const Vec3 u =
            pointVelocity(bodies[c.a], c.point.p) - pointVelocity(bodies[c.b], c.point.p);
        rhs.push_back(velocities ? -rows_[i].linear.dot(u) : -c.point.separation - c.granted);
      }
    }
    if (rows_.empty()) return;
    rhs_ = Eigen::Map<const VecX>(rhs.data(), static_cast<Eigen::Index>(rhs.size()));
    solve(bodies);
    push(bodies, velocities);
  }
}

std::vector<Vec3> ModeForces::still(std::span<RigidBody> bodies,
                                    std::span<const Contact> contacts) {
  rows_.clear();
  std::vector<double> rhs;
  for (const Contact& c : contacts) {
    addRows(bodies, c, true);
    const Vec3 u = pointVelocity(bodies[c.a], c.point.p) - pointVelocity(bodies[c.b], c.point.p);
    while (rhs.size() < rows_.size()) rhs.push_back(-rows_[rhs.size()].linear.dot(u));
  }
  forces_ = rows_;
  rhs_ = Eigen::Map<const VecX>(rhs.data(), static_cast<Eigen::Index>(rhs.size()));
  solve(bodies);
  push(bodies, true);
  std::vector<Vec3> impulses;
  Eigen::Index row = 0;
  for (const Contact& c : contacts) {
    impulses.push_back(Vec3::Zero());
    for (int r = sticks(c) ? 3 : 1; r > 0; --r, ++row)
      impulses.back() += lambda_[row] * rows_[static_cast<std::size_t>(row)].linear;
  }
  return impulses;
}

double pushLeft(const RigidBody& a, const RigidBody& b, const Contact& c) {
  const auto mobility = [&](const Vec3& d) {
    double sum = 0.0;
    for (const RigidBody* body : {&a, &b}) {
      const Vec3 arm = c.point.p - body->x;
      sum += response(*body, c.point.n, arm.cross(c.point.n), d, arm.cross(d));
    }
    return sum;
  };
  const Vec3 d = c.point.n - c.friction * slipDirectionOf(a, b, c);
  return mobility(d) / mobility(c.point.n);
}

}  // namespace tumble
