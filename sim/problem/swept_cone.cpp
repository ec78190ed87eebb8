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

/// Change of λ of a contact with friction that is now u fast, after which it is open, or held, or
/// slides.
Vec3 solveFriction(const SweptCone& cone, const Vec3& u, const Vec3& old) {
  if (u[0] - firstOf(cone.W, old) >= 0.0) return -old;
  const Vec3 hold = cone.hold.lazyProduct(-u), held = old + hold;
  const double bound = cone.mu * held[0];
  const bool holds = cone.hold(0, 0) > 0.0;
  if (holds && bound >= 0.0 && held[1] * held[1] + held[2] * held[2] <= bound * bound) return hold;
  return slideFrictionBlock(cone.W, u - cone.W.lazyProduct(old), cone.mu, old, held, kTurn) - old;
}

/// λ of a row that pushes and pulls, or of a contact with friction of a known direction.
Vec3 solveOther(const SweptCone& cone, const Vec3& u, const Vec3& old) {
  const Vec3 free = u - cone.W.lazyProduct(old);
  if (cone.kind == ConeKind::Equality) return {-free[0] / cone.W(0, 0), 0.0, 0.0};
  const double mobility = cone.W(0, 0) - cone.mu * cone.W(0, 1);
  const double push = mobility > 0.0 ? std::max(-free[0] / mobility, 0.0) : 0.0;
  return {push, -cone.mu * push, 0.0};
}

/// y of a pair as in SweptCone, two of ten numbers in a Lanes.
struct PairMotion {
  Lanes3 six;
  Lanes seven, nine;  ///< from the seventh and the ninth on
};

PairMotion tenOf(const double* from) {
  return {{Lanes{from[0], from[1]}, Lanes{from[2], from[3]}, Lanes{from[4], from[5]}},
          Lanes{from[6], from[7]},
          Lanes{from[8], from[9]}};
}

PairMotion motionOf(const TwinBodies& at) {
  const Vec6 &a = *at.a[0], &b = *at.b[0];
  const double shareA = at.shareA[0], shareB = at.shareB[0];
  const double linear[] = {shareA * a[0] - shareB * b[0], shareA * a[1] - shareB * b[1],
                           shareA * a[2] - shareB * b[2]};
  return {{Lanes{linear[0], linear[1]}, Lanes{linear[2], a[3]}, Lanes{a[4], a[5]}},
          Lanes{b[3], b[4]},
          Lanes{b[5], 0.0}};
}

/// The pair goes from y `before` to y.
void setMotion(const PairMotion& y, const PairMotion& before, const TwinBodies& at) {
  Vec6 &a = *at.a[0], &b = *at.b[0];
  const Lanes xy = y.six.x - before.six.x, z = y.six.y - before.six.y;
  const Vec3 change(xy[0], xy[1], z[0]);
  a.head<3>() += at.shareA[0] * change;
  b.head<3>() -= at.shareB[0] * change;
  a.tail<3>() = Vec3(y.six.y[1], y.six.z[0], y.six.z[1]);
  b.tail<3>() = Vec3(y.seven[0], y.seven[1], y.nine[0]);
}

/// K y + c of one row.
double speed(const SweptCone& cone, int row, const PairMotion& y) {
  const PairMotion K = tenOf(&cone.K(0, row));
  const Lanes3 six = K.six * y.six;
  const Lanes last = K.nine * y.nine + Lanes{cone.c[row], 0.0};
  return sum(((six.x + six.y) + (six.z + K.seven * y.seven)) + last);
}

/// y += Kᵀ d
void push(PairMotion& y, const SweptCone& cone, const Vec3& d) {
  const PairMotion K[] = {tenOf(&cone.K(0, 0)), tenOf(&cone.K(0, 1)), tenOf(&cone.K(0, 2))};
  y.six = (y.six + K[0].six * d[0]) + (K[1].six * d[1] + K[2].six * d[2]);
  y.seven = (y.seven + K[0].seven * d[0]) + (K[1].seven * d[1] + K[2].seven * d[2]);
  y.nine = (y.nine + K[0].nine * d[0]) + (K[1].nine * d[1] + K[2].nine * d[2]);
}

/// Solves one cone and moves its bodies. Returns the change of λ in units of u. What is open and
/// stays so, half of a crowd, is seen by its first row.
double visit(const SweptCone& cone, double* lambda, PairMotion& y) {
  Vec3 change;
  const double first = speed(cone, 0, y);
  if (cone.kind == ConeKind::Friction) {
    const Vec3 old(lambda[0], lambda[1], lambda[2]);
    if (first >= 0.0 && old.isZero(0.0)) return 0.0;
    const Vec3 u(first, speed(cone, 1, y), speed(cone, 2, y));
    change = solveFriction(cone, u, old);
    for (int i = 0; i < 3; ++i) lambda[i] = old[i] + change[i];
  } else if (cone.kind == ConeKind::Push) {
    const double old = lambda[0], u = first + cone.compliance * old;
    if (u >= 0.0 && old == 0.0) return 0.0;
    lambda[0] = std::max(-(u - cone.W(0, 0) * old) / cone.W(0, 0), 0.0);
    push(y, cone, Vec3(lambda[0] - old, 0.0, 0.0));
    return std::abs(lambda[0] - old) * cone.mobility;
  } else {
    const bool two = cone.kind == ConeKind::Slide;
    const Vec3 u(first + cone.compliance * lambda[0], 0.0, 0.0);
    const Vec3 old(lambda[0], two ? lambda[1] : 0.0, 0.0);
    const Vec3 next = solveOther(cone, u, old);
    lambda[0] = next[0];
    if (two) lambda[1] = next[1];
    change = next - old;
  }
  push(y, cone, change);
  return change.lpNorm<Eigen::Infinity>() * cone.mobility;
}

/// Three numbers of each of two bodies, from `first` on.
Lanes3 partOf(Vec6* const bodies[2], int first) {
  return abreast(bodies[0]->data() + first, bodies[1]->data() + first);
}
void setPart(Vec6* const bodies[2], int first, const Lanes3& part) {
  for (int lane = 0; lane < 2; ++lane) setNumbers(bodies[lane]->data() + first, part, lane);
}

TwinCone::Motion motionOfTwins(const TwinBodies& at) {
  return {partOf(at.a, 0) * at.shareA - partOf(at.b, 0) * at.shareB, partOf(at.a, 3),
          partOf(at.b, 3)};
}

void setMotion(const TwinCone::Motion& y, const TwinCone::Motion& before, const TwinBodies& at) {
  const Lanes3 change = y.linear - before.linear;
  setPart(at.a, 0, partOf(at.a, 0) + change * at.shareA);
  setPart(at.b, 0, partOf(at.b, 0) - change * at.shareB);
  setPart(at.a, 3, y.angularA);
  setPart(at.b, 3, y.angularB);
}

/// K y + c of one row, summed in the order of speed().
Lanes along(const TwinCone::Motion& K, const TwinCone::Motion& y, Lanes c) {
  const Lanes3 linear = K.linear * y.linear;
  const Lanes3 a = K.angularA * y.angularA, b = K.angularB * y.angularB;
  return (((linear.x + linear.z) + (a.y + b.x)) + (b.z + c)) + ((linear.y + a.x) + (a.z + b.y));
}

/// y += Kᵀ d
void push(TwinCone::Motion& y, const TwinCone& cone, const Lanes3& d) {
  const TwinCone::Motion* K = cone.K;
  y.linear = (y.linear + K[0].linear * d.x) + (K[1].linear * d.y + K[2].linear * d.z);
  y.angularA = (y.angularA + K[0].angularA * d.x) + (K[1].angularA * d.y + K[2].angularA * d.z);
  y.angularB = (y.angularB + K[0].angularB * d.x) + (K[1].angularB * d.y + K[2].angularB * d.z);
}

/// Change of λ of twins of which not both stick.
[[gnu::noinline]] Lanes3 solveApart(const TwinCone& cone, const Lanes3& u, const Lanes3& old,
                                    const Lanes3& hold, LaneMask sticks) {
  const Lanes3 free = u - cone.W * old;
  const LaneMask open = free.x >= Lanes{}, slides = ~(open | sticks);
  Lanes3 slid;
  const LaneMask found = slideAbreast(cone.W, free, cone.mu, old, kTurn, slides, slid);
  for (int lane = 0; lane < 2; ++lane)
    if (slides[lane] && !found[lane])
      setLane(slid, lane,
              slideFrictionBlock(laneOf(cone.W, lane), laneOf(free, lane), cone.mu[lane],
                                 laneOf(old, lane), laneOf(old + hold, lane), kTurn));
  return chosen(open, -old, chosen(sticks, hold, slid - old));
}

/// Visits two contacts with friction.
Lanes visit(const TwinCone& cone, TwinCone::Motion& y, double* lambda) {
  const Lanes first = along(cone.K[0], y, cone.c.x), none{};
  double* const at[] = {lambda + cone.row[0], lambda + cone.row[1]};
  const Lanes3 old = abreast(at[0], at[1]);
  if (both(first >= none) && both((old.x == none) & (old.y == none) & (old.z == none))) return none;
  const Lanes3 u{first, along(cone.K[1], y, cone.c.y), along(cone.K[2], y, cone.c.z)};
  const Lanes free = u.x - (cone.W * old).x;
  const Lanes3 hold = cone.hold * -u, held = old + hold;
  const Lanes bound = cone.mu * held.x;
  const LaneMask sticks = (free < none) & (cone.hold.xx > none) & (bound >= none) &
                          (held.y * held.y + held.z * held.z <= bound * bound);
  const Lanes3 change = both(sticks) ? hold : solveApart(cone, u, old, hold, sticks);
  for (int lane = 0; lane < 2; ++lane) setNumbers(at[lane], old + change, lane);
  push(y, cone, change);
  return sizeOf(change) * cone.mobility;
}

}  // namespace

void TwinCone::set(int lane, const SweptCone& cone) {
  for (int i = 0; i < 3; ++i) {
    setLane(K[i].linear, lane, cone.K.col(i).head<3>());
    setLane(K[i].angularA, lane, cone.K.col(i).segment<3>(3));
    setLane(K[i].angularB, lane, cone.K.col(i).segment<3>(6));
  }
  setLane(W, lane, cone.W);
  setLane(hold, lane, cone.hold);
  setLane(c, lane, cone.c);
  mu[lane] = cone.mu;
  mobility[lane] = cone.mobility;
  row[lane] = cone.row;
}

[[gnu::flatten]] void takeCones(std::span<const SweptCone> cones, const double* lambda,
                                const TwinBodies& bodies) {
  const PairMotion before = motionOf(bodies);
  PairMotion y = before;
  for (const SweptCone& cone : cones) {
    const double* own = lambda + cone.row;
    const int rows = coneRows(cone.kind);
    push(y, cone, Vec3(own[0], rows > 1 ? own[1] : 0.0, rows > 2 ? own[2] : 0.0));
  }
  setMotion(y, before, bodies);
}

[[gnu::flatten]] double sweepCones(std::span<const SweptCone> cones, bool forwards, double* lambda,
                                   const TwinBodies& bodies) {
  const PairMotion before = motionOf(bodies);
  PairMotion y = before;
  double largest = 0.0;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const SweptCone& cone = cones[forwards ? i : cones.size() - 1 - i];
    largest = std::max(largest, visit(cone, lambda + cone.row, y));
  }
  setMotion(y, before, bodies);
  return largest;
}

[[gnu::flatten]] void takeTwins(std::span<const TwinCone> cones, const double* lambda,
                                const TwinBodies& bodies) {
  const TwinCone::Motion before = motionOfTwins(bodies);
  TwinCone::Motion y = before;
  for (const TwinCone& cone : cones)
    push(y, cone, abreast(lambda + cone.row[0], lambda + cone.row[1]));
  setMotion(y, before, bodies);
}

[[gnu::flatten]] double sweepTwins(std::span<const TwinCone> cones, bool forwards, double* lambda,
                                   const TwinBodies& bodies) {
  const TwinCone::Motion before = motionOfTwins(bodies);
  TwinCone::Motion y = before;
  Lanes largest{};
  for (std::size_t i = 0; i < cones.size(); ++i)
    largest = larger(visit(cones[forwards ? i : cones.size() - 1 - i], y, lambda), largest);
  setMotion(y, before, bodies);
  return std::max(largest[0], largest[1]);
}

}  // namespace tumble
