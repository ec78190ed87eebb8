#include "sim/problem/swept_cone.h"

#include <algorithm>
#include <cmath>

#include "sim/problem/cone.h"
#include "sim/problem/friction_block.h"

namespace tumble {
namespace {

constexpr double kTurn = 1e-4;  ///< [rad] of a slip direction: the next sweeps do the rest

/// A b of the first row.
double firstOf(const Mat3& A, const Vec3& b) {
  return A(0, 0) * b[0] + A(0, 1) * b[1] + A(0, 2) * b[2];
}

/// λ of a contact with friction at which it is now u fast: open, or held, or sliding.
Vec3 solveFriction(const SweptCone& cone, const Vec3& u, const Vec3& old) {
  if (u[0] - firstOf(cone.W, old) >= 0.0) return Vec3::Zero();
  const Vec3 held = old - cone.hold.lazyProduct(u);
  const double bound = cone.mu * held[0];
  const bool holds = cone.hold(0, 0) > 0.0;
  if (holds && bound >= 0.0 && held[1] * held[1] + held[2] * held[2] <= bound * bound) return held;
  return slideFrictionBlock(cone.W, u - cone.W.lazyProduct(old), cone.mu, old, held, kTurn);
}

/// λ of a cone without friction, or with that of a known direction.
Vec3 solveOther(const SweptCone& cone, const Vec3& u, const Vec3& old) {
  const Vec3 free = u - cone.W.lazyProduct(old);
  if (cone.kind == ConeKind::Equality) return {-free[0] / cone.W(0, 0), 0.0, 0.0};
  if (cone.kind == ConeKind::Push) return {std::max(-free[0] / cone.W(0, 0), 0.0), 0.0, 0.0};
  const double mobility = cone.W(0, 0) - cone.mu * cone.W(0, 1);
  const double push = mobility > 0.0 ? std::max(-free[0] / mobility, 0.0) : 0.0;
  return {push, -cone.mu * push, 0.0};
}

/// y of two bodies, two of six numbers in a Lanes.
struct PairMotion {
  Lanes3 a, b;
};

Lanes3 sixOf(const double* from) {
  return {Lanes{from[0], from[1]}, Lanes{from[2], from[3]}, Lanes{from[4], from[5]}};
}
void setSix(Vec6& to, const Lanes3& from) {
  to << from.x[0], from.x[1], from.y[0], from.y[1], from.z[0], from.z[1];
}

/// K y + c of one row.
double speed(const SweptCone& cone, int row, const PairMotion& y) {
  const Lanes3 terms = sixOf(&cone.Ka(0, row)) * y.a + sixOf(&cone.Kb(0, row)) * y.b;
  return sum(terms.x + (terms.y + terms.z)) + cone.c[row];
}

/// y += Kᵀ d
void push(PairMotion& y, const SweptCone& cone, const Vec3& d) {
  const auto along = [&](const Eigen::Matrix<double, 6, 3>& K) {
    return sixOf(&K(0, 0)) * d[0] + sixOf(&K(0, 1)) * d[1] + sixOf(&K(0, 2)) * d[2];
  };
  y.a = y.a + along(cone.Ka);
  y.b = y.b + along(cone.Kb);
}

/// Solves one cone and moves its bodies. Returns the change of λ in units of u.
double visit(const SweptCone& cone, double* lambda, PairMotion& y) {
  Vec3 change;
  if (cone.kind == ConeKind::Friction) {
    const Vec3 u(speed(cone, 0, y), speed(cone, 1, y), speed(cone, 2, y));
    const Vec3 old(lambda[0], lambda[1], lambda[2]), next = solveFriction(cone, u, old);
    for (int i = 0; i < 3; ++i) lambda[i] = next[i];
    change = next - old;
  } else {
    const bool two = cone.kind == ConeKind::Slide;
    const Vec3 u(speed(cone, 0, y), 0.0, 0.0), old(lambda[0], two ? lambda[1] : 0.0, 0.0);
    const Vec3 next = solveOther(cone, u, old);
    lambda[0] = next[0];
    if (two) lambda[1] = next[1];
    change = next - old;
  }
  push(y, cone, change);
  return change.lpNorm<Eigen::Infinity>() * cone.mobility;
}

TwinCone::Motion motionOf(const TwinBodies& at) {
  const double *a0 = at.a[0]->data(), *a1 = at.a[1]->data();
  const double *b0 = at.b[0]->data(), *b1 = at.b[1]->data();
  return {abreast(a0, a1), abreast(a0 + 3, a1 + 3), abreast(b0, b1), abreast(b0 + 3, b1 + 3)};
}

void setMotion(const TwinCone::Motion& y, const TwinBodies& at) {
  for (int lane = 0; lane < 2; ++lane) {
    setNumbers(at.a[lane]->data(), y.linearA, lane);
    setNumbers(at.a[lane]->data() + 3, y.angularA, lane);
    setNumbers(at.b[lane]->data(), y.linearB, lane);
    setNumbers(at.b[lane]->data() + 3, y.angularB, lane);
  }
}

/// K y of one row, summed in the order of speed().
Lanes along(const TwinCone::Motion& K, const TwinCone::Motion& y) {
  const Lanes3 linear = K.linearA * y.linearA + K.linearB * y.linearB;
  const Lanes3 angular = K.angularA * y.angularA + K.angularB * y.angularB;
  return (linear.x + (linear.z + angular.y)) + (linear.y + (angular.x + angular.z));
}

/// y += Kᵀ d
void push(TwinCone::Motion& y, const TwinCone& cone, const Lanes3& d) {
  const TwinCone::Motion* K = cone.K;
  y.linearA = y.linearA + (K[0].linearA * d.x + K[1].linearA * d.y + K[2].linearA * d.z);
  y.angularA = y.angularA + (K[0].angularA * d.x + K[1].angularA * d.y + K[2].angularA * d.z);
  y.linearB = y.linearB + (K[0].linearB * d.x + K[1].linearB * d.y + K[2].linearB * d.z);
  y.angularB = y.angularB + (K[0].angularB * d.x + K[1].angularB * d.y + K[2].angularB * d.z);
}

/// λ of twins of which not both stick.
[[gnu::noinline]] Lanes3 solveApart(const TwinCone& cone, const Lanes3& u, const Lanes3& old,
                                    const Lanes3& held, LaneMask sticks) {
  const Lanes3 free = u - cone.W * old;
  const LaneMask open = free.x >= Lanes{}, slides = ~(open | sticks);
  Lanes3 slid;
  const LaneMask found = slideAbreast(cone.W, free, cone.mu, old, kTurn, slides, slid);
  for (int lane = 0; lane < 2; ++lane)
    if (slides[lane] && !found[lane])
      setLane(slid, lane,
              slideFrictionBlock(laneOf(cone.W, lane), laneOf(free, lane), cone.mu[lane],
                                 laneOf(old, lane), laneOf(held, lane), kTurn));
  return chosen(open, Lanes3{}, chosen(sticks, held, slid));
}

/// Visits two contacts with friction.
Lanes visit(const TwinCone& cone, TwinCone::Motion& y, double* lambda) {
  const Lanes3 u = Lanes3{along(cone.K[0], y), along(cone.K[1], y), along(cone.K[2], y)} + cone.c;
  double* const at[] = {lambda + cone.row[0], lambda + cone.row[1]};
  const Lanes3 old = abreast(at[0], at[1]);
  const Lanes free = u.x - (cone.W * old).x;
  const Lanes3 held = old - cone.hold * u;
  const Lanes bound = cone.mu * held.x, none{};
  const LaneMask sticks = (free < none) & (cone.hold.x.x > none) & (bound >= none) &
                          (held.y * held.y + held.z * held.z <= bound * bound);
  const Lanes3 next = both(sticks) ? held : solveApart(cone, u, old, held, sticks);
  const Lanes3 change = next - old;
  for (int lane = 0; lane < 2; ++lane) setNumbers(at[lane], next, lane);
  push(y, cone, change);
  return sizeOf(change) * cone.mobility;
}

}  // namespace

void TwinCone::set(int lane, const SweptCone& cone) {
  for (int i = 0; i < 3; ++i) {
    setLane(K[i].linearA, lane, cone.Ka.col(i).head<3>());
    setLane(K[i].angularA, lane, cone.Ka.col(i).tail<3>());
    setLane(K[i].linearB, lane, cone.Kb.col(i).head<3>());
    setLane(K[i].angularB, lane, cone.Kb.col(i).tail<3>());
  }
  setLane(W, lane, cone.W);
  setLane(hold.x, lane, cone.hold.row(0).transpose());
  setLane(hold.y, lane, cone.hold.row(1).transpose());
  setLane(hold.z, lane, cone.hold.row(2).transpose());
  setLane(c, lane, cone.c);
  mu[lane] = cone.mu;
  mobility[lane] = cone.mobility;
  row[lane] = cone.row;
}

[[gnu::flatten]] void takeCones(std::span<const SweptCone> cones, const double* lambda, Vec6& ya,
                                Vec6& yb) {
  PairMotion y{sixOf(ya.data()), sixOf(yb.data())};
  for (const SweptCone& cone : cones) {
    const double* own = lambda + cone.row;
    const int rows = coneRows(cone.kind);
    push(y, cone, Vec3(own[0], rows > 1 ? own[1] : 0.0, rows > 2 ? own[2] : 0.0));
  }
  setSix(ya, y.a);
  setSix(yb, y.b);
}

[[gnu::flatten]] double sweepCones(std::span<const SweptCone> cones, bool forwards, double* lambda,
                                   Vec6& ya, Vec6& yb) {
  PairMotion y{sixOf(ya.data()), sixOf(yb.data())};
  double largest = 0.0;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const SweptCone& cone = cones[forwards ? i : cones.size() - 1 - i];
    largest = std::max(largest, visit(cone, lambda + cone.row, y));
  }
  setSix(ya, y.a);
  setSix(yb, y.b);
  return largest;
}

[[gnu::flatten]] void takeTwins(std::span<const TwinCone> cones, const double* lambda,
                                const TwinBodies& bodies) {
  TwinCone::Motion y = motionOf(bodies);
  for (const TwinCone& cone : cones)
    push(y, cone, abreast(lambda + cone.row[0], lambda + cone.row[1]));
  setMotion(y, bodies);
}

[[gnu::flatten]] double sweepTwins(std::span<const TwinCone> cones, bool forwards, double* lambda,
                                   const TwinBodies& bodies) {
  TwinCone::Motion y = motionOf(bodies);
  Lanes largest{};
  for (std::size_t i = 0; i < cones.size(); ++i)
    largest = larger(visit(cones[forwards ? i : cones.size() - 1 - i], y, lambda), largest);
  setMotion(y, bodies);
  return std::max(largest[0], largest[1]);
}

}  // namespace tumble
