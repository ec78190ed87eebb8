// Chapter 7, contact: friction of an impact, whose normal impulses are known.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sim/contact/impact.h"
#include "sim/contact/impact_pass.h"
#include "sim/contact/impulse.h"
#include "sim/contact/rows.h"
#include "sim/math/least_squares.h"
#include "sim/problem/delassus.h"

namespace tumble {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kSettled = 1e-13;   // change of a sweep relative to the largest bound,
constexpr double kRounding = 1e-15;  // and to what stops the fastest point: its rounding
constexpr int kMostRows = 150;       // of an island, for a method of third order

/// Tangent plane of one struck contact and its Coulomb bound.
struct Tangential {
  int contact;
  double bound;  // [N·s] mu j
  double step;   // [kg] 1 / sum of the inverse effective masses in the plane
  Vec3 t1, t2;
  Vec3 sum = Vec3::Zero();
};

/// Nearest point of the disc |x| ≤ bound.
Vec2 cut(const Vec2& x, double bound) {
  const double length = x.norm();
  return length > bound ? Vec2(x * (bound / length)) : x;
}

/// The friction of an island as a whole: the least of  ½ s·A s + b·s  with |sᵢ| ≤ boundᵢ, which is
/// where
///   G(s) = s − Π(s − step (A s + b)) = 0.
/// Newton's method, whose derivative jumps where a contact begins to slide; it takes the least
/// change of s where several s do the same.
class WholeFriction {
 public:
  WholeFriction(const Impact& impact, std::span<Tangential* const> struck) : struck_(struck) {
    Problem problem;
    std::vector<int> number(impact.bodies.size(), -1);
    const auto numberOf = [&](int body) {
      if (number[body] < 0) number[body] = addToVelocityProblem(impact.bodies[body], problem);
      return number[body];
    };
    for (const Tangential* s : struck) {
      const Contact& c = impact.contacts[s->contact];
      for (const Vec3& t : {s->t1, s->t2}) {
        Row row = pointRow(impact.bodies, c.a, c.b, c.point.p, t, 0.0);
        row.a = numberOf(c.a);
        row.b = numberOf(c.b);
        problem.rows.push_back(row);
      }
    }
    system_ = delassus(problem);
    first_ = sums();
  }

  /// @return the change of every contact that leaves the smallest G, in t1 and t2
  VecX solve(long& rows) {
    constexpr int kPasses = 40, kPatience = 8;
    VecX s = first_, best = s;
    double least = residual(s);
    for (int pass = 0, since = 0; pass < kPasses && since < kPatience; ++pass, ++since) {
      rows += s.size();
      s -= step();
      if (!s.allFinite()) break;
      for (int i = 0; i < count(); ++i)
        s.segment<2>(2 * i) = cut(s.segment<2>(2 * i), struck_[i]->bound);
      const double now = residual(s);
      if (now >= least) continue;
      if (now < 0.5 * least) since = 0;
      least = now;
      best = s;
    }
    return best - first_;
  }

 private:
  int count() const { return static_cast<int>(struck_.size()); }

  VecX sums() const {
    VecX s(2 * count());
    for (int i = 0; i < count(); ++i)
      s.segment<2>(2 * i) << struck_[i]->t1.dot(struck_[i]->sum),
          struck_[i]->t2.dot(struck_[i]->sum);
    return s;
  }

  /// Of Newton's method; the shortest where many do the same.
  VecX step() {
    constexpr double kFollows = 1e-9;  // of the largest: pivot of a row that follows from others
    regular_.compute(slope_);
    const VecX pivots = regular_.matrixLU().diagonal().cwiseAbs();
    return pivots.minCoeff() > kFollows * pivots.maxCoeff() ? VecX(regular_.solve(G_))
                                                            : leastSquares(slope_, G_);
  }

  /// G and its derivative at s. @return the largest |Gᵢ| [N·s]
  double residual(const VecX& s) {
    // b is what is left at the sums of the start.
    const VecX u = system_.A * (s - first_) + system_.b;
    G_.resize(s.size());
    slope_.resize(s.size(), s.size());
    double most = 0.0;
    for (int i = 0; i < count(); ++i) {
      const int k = 2 * i;
      const double step = struck_[i]->step, bound = struck_[i]->bound;
      const Vec2 now = s.segment<2>(k), asked = now - step * u.segment<2>(k);
      const double length = asked.norm();
      slope_.middleRows<2>(k) = step * system_.A.middleRows<2>(k);
      if (length <= bound) {
        G_.segment<2>(k) = step * u.segment<2>(k);
      } else {
        const Vec2 d = asked / length;
        const Eigen::Matrix2d turn =
            (bound / length) * (Eigen::Matrix2d::Identity() - d * d.transpose());
        G_.segment<2>(k) = now - bound * d;
        slope_.middleRows<2>(k) = turn * slope_.middleRows<2>(k).eval();
        slope_.block<2, 2>(k, k) += Eigen::Matrix2d::Identity() - turn;
      }
      most = std::max(most, G_.segment<2>(k).norm());
    }
    return most;
  }

  std::span<Tangential* const> struck_;
  Delassus system_;
  VecX first_, G_;
  MatX slope_;
  Eigen::PartialPivLU<MatX> regular_;
};

/// What the friction of an impact did so far, and one change more of one contact.
void change(const Impact& impact, Tangential& s, const Vec3& J, ImpulseEnergy& energy) {
  s.sum += J;
  const ImpulseEnergy step = applyContactImpulse(impact, s.contact, J);
  energy.lost += step.lost;
  energy.work += step.work;
}

/// Each contact in turn pulls its slip towards zero, held inside its disc. A first pull of full
/// strength settles a lone contact whose two tangents weigh the same at once.
/// @return the largest change of an impulse [N·s]
double sweep(const Impact& impact, std::span<Tangential> struck, double strength,
             ImpulseEnergy& energy) {
  double most = 0.0;
  for (Tangential& s : struck) {
    const Contact& c = impact.contacts[s.contact];
    const RigidBody &a = impact.bodies[c.a], &b = impact.bodies[c.b];
    Vec3 wanted = s.sum - strength * s.step * slipVelocity(a, b, c.point);
    const double size = wanted.norm();
    if (size > s.bound) wanted *= s.bound / size;
    const Vec3 J = wanted - s.sum;
    change(impact, s, J, energy);
    most = std::max(most, J.norm());
  }
  energy.rows += 2 * static_cast<long>(struck.size());
  return most;
}

/// All contacts of an island at once, where it is not too large.
void finish(const Impact& impact, std::span<Tangential> struck, ImpulseEnergy& energy) {
  std::vector<int> contacts;
  for (const Tangential& s : struck) contacts.push_back(s.contact);
  const std::vector<int> island = islandsOfContacts(impact, contacts);
  std::vector<std::vector<Tangential*>> parts(*std::max_element(island.begin(), island.end()) + 1);
  for (std::size_t k = 0; k < struck.size(); ++k) parts[island[k]].push_back(&struck[k]);
  for (const std::vector<Tangential*>& part : parts) {
    if (2 * part.size() > kMostRows) continue;
    const VecX s = WholeFriction(impact, part).solve(energy.rows);
    for (std::size_t i = 0; i < part.size(); ++i)
      change(impact, *part[i], s[2 * i] * part[i]->t1 + s[2 * i + 1] * part[i]->t2, energy);
  }
}

}  // namespace

ImpulseEnergy frictionImpulses(const Impact& impact, std::span<const int> contacts,
                               std::span<const double> j) {
  constexpr int kSweeps = 200;
  constexpr int kFinish[] = {8, 32, 128};  // sweeps after which all are tried at once

  std::vector<Tangential> struck;
  double largest = 0.0, rounding = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& c = impact.contacts[contacts[i]];
    const double bound = c.friction * j[i];
    if (bound <= 0.0) continue;
    Vec3 t1, t2;
    const RigidBody &a = impact.bodies[c.a], &b = impact.bodies[c.b];
    tangents(c.point.n, slipVelocity(a, b, c.point), t1, t2);
    const double k =
        inverseEffectiveMass(a, b, c.point.p, t1) + inverseEffectiveMass(a, b, c.point.p, t2);
    struck.push_back({contacts[i], bound, 1.0 / k, t1, t2});
    largest = std::max(largest, bound);
    const double fast = pointVelocity(a, c.point.p).norm() + pointVelocity(b, c.point.p).norm();
    rounding = std::max(rounding, kRounding * struck.back().step * fast);
  }

  ImpulseEnergy energy;
  const double settled = std::max(kSettled * largest, rounding);
  for (int k = 0; k < kSweeps && !struck.empty(); ++k) {
    if (std::find(std::begin(kFinish), std::end(kFinish), k) != std::end(kFinish))
      finish(impact, struck, energy);
    if (sweep(impact, struck, k == 0 ? 2.0 : 1.0, energy) <= settled) break;
  }
  return energy;
}

}  // namespace tumble
