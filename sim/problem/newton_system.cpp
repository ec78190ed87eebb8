// Reads a contact problem into movers and points, begins stages, and tells how far from solved it
// is.
#include "sim/problem/newton_system.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/problem/cone.h"
#include "sim/problem/row.h"

namespace tumble {

template <int N>
auto NewtonSystem<N>::Mover::momentum(const Twist& twist) const -> Twist {
  if constexpr (N == 3) return mass * twist;
  Twist result;
  result.template head<3>() = mass * twist.template head<3>();
  result.template tail<3>().noalias() = inertia * twist.template tail<3>();
  return result;
}

template <int N>
[[gnu::flatten]] void NewtonSystem<N>::addMovers(const Problem& problem) {
  movers.clear();
  moverOf_.assign(problem.invM.size(), -1);
  for (std::size_t i = 0; i < problem.invM.size(); ++i) {
    const bool moves = problem.invM[i] > 0.0, turns = N == 6 && !problem.Iinv[i].isZero(0.0);
    if (!moves && !turns) continue;
    moverOf_[i] = static_cast<int>(movers.size());
    Mover& mover = movers.emplace_back();
    mover.body = static_cast<int>(i);
    mover.mass = moves ? 1.0 / problem.invM[i] : 1.0;
    if (turns) {
      mover.inertiaInv = problem.Iinv[i];
      Mat3 factor = mover.inertiaInv;
      invertFactor(factor);
      mover.inertia.noalias() = factor.transpose().lazyProduct(factor);
    }
    mover.star = problem.vStar[i].template head<N>();
    mover.origin.setZero();
    // Stiff couplings would magnify the rounding of what is common to all velocities.
    if (!problem.couplings.empty()) std::swap(mover.star, mover.origin);
    mover.moves = moves;
    mover.turns = turns;
  }
}

/// What cannot move of a body goes from its part of a row into the bias.
/// @return the share of the body in the mobility of the row
template <int N>
double NewtonSystem<N>::split(const Problem& problem, int body, Vec6& J, double& bias) const {
  const int mover = moverOf_[body];
  const bool moves = mover >= 0 && movers[mover].moves, turns = mover >= 0 && movers[mover].turns;
  if (!moves) {
    bias += J.head<3>().dot(problem.vStar[body].template head<3>());
    J.head<3>().setZero();
  }
  if (!turns) {
    bias += J.tail<3>().dot(problem.vStar[body].template tail<3>());
    J.tail<3>().setZero();
  }
  double mobility = 0.0;
  if (moves) mobility += problem.invM[body] * J.head<3>().squaredNorm();
  if (turns) mobility += J.tail<3>().dot(problem.Iinv[body] * J.tail<3>());
  return mobility;
}

/// What the velocity that a body's own is measured from gives a row, by its part J of that row.
template <int N>
double NewtonSystem<N>::alongOrigin(int body, const Vec6& J) const {
  const int mover = moverOf_[body];
  return mover >= 0 ? J.head<N>().dot(movers[mover].origin) : 0.0;
}

/// Reads the rows of a cone into a point. @return those of body b
template <int N>
[[gnu::flatten]] auto NewtonSystem<N>::readRows(const Problem& problem, const Cone& cone,
                                                Point& point) const -> Rows {
  Rows ofB = Rows::Zero();
  for (int k = 0; k < point.rows; ++k) {
    const Row& row = problem.rows[cone.row + k];
    Vec6 Ja, Jb;
    Ja << row.linear, row.angularA;
    Jb << -row.linear, row.angularB;
    double bias = row.bias;
    const double mobility = split(problem, row.a, Ja, bias) + split(problem, row.b, Jb, bias);
    if (!problem.couplings.empty()) bias += alongOrigin(row.a, Ja) + alongOrigin(row.b, Jb);
    point.compliance = row.compliance;
    point.mobility = std::max(point.mobility, mobility);
    point.length = rowArm(problem, row);
    point.J.col(k) = point.length * Ja.head<N>();
    ofB.col(k) = point.length * Jb.head<N>();
    point.bias[k] = point.length * bias;
  }
  point.mobility += point.compliance;
  point.compliance *= point.length * point.length;
  return ofB;
}

template <int N>
void NewtonSystem<N>::addPoints(const Problem& problem) {
  points.resize(problem.cones.size());
  patches_.clear();
  others_.clear();
  rubs_ = false;
  for (std::size_t c = 0; c < points.size(); ++c) {
    const Cone& cone = problem.cones[c];
    Point& point = points[c];
    point = Point{};
    point.kind = cone.kind;
    point.mu = point.muTrue = cone.mu;
    point.rows = coneRows(cone.kind);
    rubs_ = rubs_ || cone.kind == ConeKind::Friction;
    const Rows ofB = readRows(problem, cone, point);
    const Row& first = problem.rows[cone.row];
    place(static_cast<int>(c), moverOf_[first.a], moverOf_[first.b], ofB);
  }
}

namespace {

/// The arm from b to a for which rows act on b as on a:  the turning parts of both and  arm × n
/// add up to 0. Of orthonormal n; any part of the arm that they leave open is 0.
template <class Rows>
Vec3 armOf(const Rows& ofA, const Rows& ofB) {
  const auto across = [&](int k) {
    const Vec3 n = ofA.col(k).template head<3>();
    return Vec3((ofA.col(k).template tail<3>() + ofB.col(k).template tail<3>()).cross(n));
  };
  const Vec3 n = ofA.col(0).template head<3>();
  return across(0) + n.dot(across(1)) * n;
}

template <class Rows>
bool fits(const Vec3& arm, const Rows& ofA, const Rows& ofB) {
  constexpr double kSame = 4e-15;
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = ofA.col(k).template tail<3>(), b = ofB.col(k).template tail<3>();
    const Vec3 n = ofA.col(k).template head<3>();
    const Vec3 open = a + b + arm.cross(n);
    const double size = arm.lpNorm<1>() + a.lpNorm<1>() + b.lpNorm<1>();
    if (!(open.lpNorm<1>() <= kSame * size)) return false;
  }
  return true;
}

}  // namespace

/// Adds a point to the last patch, or to a new one.
template <int N>
void NewtonSystem<N>::place(int point, int a, int b, const Rows& ofB) {
  Rows& J = points[point].J;
  if (a < 0 && b >= 0) {
    std::swap(a, b);
    J = ofB;
  }
  if (!patches_.empty()) {
    Patch& last = patches_.back();
    bool same = last.a == a && last.b == b && last.shares;
    if constexpr (N == 6) same = same && (b < 0 || fits(last.arm, J, ofB));
    if (same) {
      last.end = point + 1;
      return;
    }
  }
  Patch patch{.a = a, .b = b, .begin = point, .end = point + 1};
  if constexpr (N == 6) {
    if (b >= 0) {
      const auto free = [&](int mover) { return movers[mover].moves && movers[mover].turns; };
      patch.arm = armOf(J, ofB);
      patch.shares = free(a) && free(b) && fits(patch.arm, J, ofB);
      patch.other = static_cast<int>(others_.size());
      if (!patch.shares) others_.push_back(ofB);
    }
  }
  patches_.push_back(patch);
}

/// Finds the pairs of moving bodies, and which of them is the row of their block.
template <int N>
void NewtonSystem<N>::linkBodies() {
  edges_.clear();
  for (const Patch& patch : patches_)
    if (patch.b >= 0) edges_.emplace_back(std::minmax(patch.a, patch.b));
  for (const Link& link : couplings_)
    if (link.i != link.j) edges_.emplace_back(std::minmax(link.i, link.j));
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  structure_ = &structures_.of(static_cast<int>(movers.size()), edges_);
  H_.begin(*structure_);
  const auto edgeOf = [this](int a, int b) {
    const BlockEdge edge = std::minmax(a, b);
    return static_cast<int>(std::lower_bound(edges_.begin(), edges_.end(), edge) - edges_.begin());
  };
  for (Patch& patch : patches_) {
    if (patch.b < 0) continue;
    patch.edge = edgeOf(patch.a, patch.b);
    patch.aIsRow = H_.edgeRow(patch.edge) == patch.a;
  }
  for (Link& link : couplings_) {
    if (link.i == link.j) continue;
    link.edge = edgeOf(link.i, link.j);
    link.iIsRow = H_.edgeRow(link.edge) == link.i;
  }
}

template <int N>
void NewtonSystem<N>::addCouplings(const Problem& problem) {
  couplings_.clear();
  for (const Coupling& coupling : problem.couplings)
    couplings_.push_back(
        {.i = moverOf_[coupling.a], .j = moverOf_[coupling.b], .block = coupling.block});
}

template <int N>
void NewtonSystem<N>::prepare(const Problem& problem) {
  addMovers(problem);
  addPoints(problem);
  addCouplings(problem);
  linkBodies();
  scale = velocityScale(problem);
  factoredRho_ = pressedRho_ = 0.0;
  factorizations = 0;
  weight = 0.0;
  for (const Mover& mover : movers)
    if (mover.moves) weight += 0.25 * mover.mass;
  if (weight == 0.0) weight = 1.0;
  for (const Link& link : couplings_)
    if (link.i == link.j) weight = std::max(weight, 0.25 * link.block.diagonal().maxCoeff());
  rho = weight;
}

/// λ becomes the forces; slip terms go a part of the way to those of now, if at all.
template <int N>
void NewtonSystem<N>::nextStage(double slipPart) {
  for (Point& point : points) {
    point.sum -= rho * point.u;
    point.lambda = point.force;
    if (point.kind == ConeKind::Slide) point.lambda[1] = -point.mu * point.force[0];
  }
  if (slipPart > 0.0) takeSlip(slipPart);
}

template <int N>
void NewtonSystem<N>::narrow() {
  constexpr double kInside = 0.8;
  for (Point& point : points)
    if (point.kind == ConeKind::Friction) point.mu = kInside * point.muTrue;
}

template <int N>
bool NewtonSystem<N>::widen(double slip) {
  bool any = false;
  for (Point& point : points) {
    if (point.mu == point.muTrue || std::hypot(point.u[1], point.u[2]) < slip) continue;
    point.mu = point.muTrue;
    any = true;
  }
  return any;
}

template <int N>
void NewtonSystem<N>::takeSlip(double part) {
  for (Point& point : points)
    if (point.kind == ConeKind::Friction)
      point.saxce += part * (point.mu * std::hypot(point.u[1], point.u[2]) - point.saxce);
}

template <int N>
void NewtonSystem<N>::goBack(const std::vector<Point>& atPoints,
                             const std::vector<Mover>& atMovers) {
  points = atPoints;
  movers = atMovers;
  factoredRho_ = 0.0;
}

template <int N>
void NewtonSystem<N>::restart(const Solution& start) {
  const bool known = static_cast<int>(start.v.size()) == static_cast<int>(moverOf_.size());
  for (Mover& mover : movers) {
    mover.v = mover.star;
    if (!known) continue;
    const Vec6& v = start.v[mover.body];
    if (mover.moves)
      mover.v.template head<3>() = v.template head<3>() - mover.origin.template head<3>();
    if (mover.turns)
      mover.v.template tail<3>() = v.template tail<3>() - mover.origin.template tail<3>();
  }
  for (Point& point : points) {
    point.lambda.setZero();
    point.sum.setZero();
    point.mu = point.muTrue;
  }
  pulled_ = false;
  guess_ = true;
  look(true);
}

template <int N>
bool NewtonSystem<N>::slides() const {
  constexpr double kLittle = 1e-2;  // of the scale
  return std::any_of(points.begin(), points.end(), [&](const Point& point) {
    return point.kind == ConeKind::Friction && std::hypot(point.u[1], point.u[2]) > kLittle * scale;
  });
}

template <int N>
double NewtonSystem<N>::residual() const {
  double worst = 0.0;
  for (const Point& point : points) {
    const double rho = point.mobility > 0.0 ? 1.0 / point.mobility : 1.0;
    const Cone cone{point.kind, 0, point.mu};
    const Vec3 u = point.u + point.compliance * point.force;
    const double own = coneResidual(cone, point.force.data(), u.data(), rho) / point.length;
    if (!std::isfinite(own)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, own);
  }
  return worst / scale;
}

template <int N>
[[gnu::flatten]] double NewtonSystem<N>::balance() {
  work_.resize(movers.size());
  for (std::size_t i = 0; i < movers.size(); ++i)
    work_[i] = movers[i].momentum(movers[i].v - movers[i].star).cwiseAbs();
  forCoupled([this](int j) { return Vec3((movers[j].v - movers[j].star).template head<3>()); },
             [this](int i, const Vec3& p) { work_[i].template head<3>() += p.cwiseAbs(); });
  for (const Patch& patch : patches_) {
    if (patch.a < 0) continue;
    for (int p = patch.begin; p < patch.end; ++p) {
      const Twist wrench = timesForce(points[p], points[p].J);
      work_[patch.a] += wrench.cwiseAbs();
      if (patch.b < 0) continue;
      Twist back = Twist::Zero();
      if (patch.shares)
        addAtCentreOfB(patch, wrench, back);
      else
        back = timesForce(points[p], others_[patch.other]);
      work_[patch.b] += back.cwiseAbs();
    }
  }
  // A velocity is a number: beside a small impulse on a fast body its rounding is not an error.
  constexpr double kRounding = std::numeric_limits<double>::epsilon();
  std::vector<Vec3> coupled(couplings_.empty() ? 0 : movers.size(), Vec3::Zero());
  for (Twist Mover::*twist : {&Mover::v, &Mover::star})
    forCoupled([&](int j) { return Vec3((movers[j].*twist).template head<3>()); },
               [&](int i, const Vec3& p) { coupled[i] += p.cwiseAbs(); });
  double worst = 0.0;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const Mover& mover = movers[i];
    Twist size = mover.momentum(mover.v).cwiseAbs() + mover.momentum(mover.star).cwiseAbs();
    if (!coupled.empty()) size.template head<3>() += coupled[i];
    for (int first = 0; first < N; first += 3) {
      const double gross = work_[i].template segment<3>(first).maxCoeff();
      const double open = mover.gradient.template segment<3>(first).cwiseAbs().maxCoeff() -
                          kRounding * size.template segment<3>(first).maxCoeff();
      if (gross > 0.0) worst = std::max(worst, open / gross);
    }
  }
  return worst;
}

template <int N>
void NewtonSystem<N>::write(const Problem& problem, Solution& solution) const {
  solution.lambda.resize(problem.rows.size());
  solution.pull.reserve(problem.rows.size());  // for answers to come that have them
  solution.pull.resize(pulled_ ? problem.rows.size() : 0);
  solution.v = problem.vStar;
  for (std::size_t c = 0; c < points.size(); ++c)
    for (int k = 0; k < points[c].rows; ++k) {
      const int row = problem.cones[c].row + k;
      solution.lambda[row] = points[c].length * points[c].force[k];
      if (pulled_) solution.pull[row] = points[c].length * points[c].pull[k];
    }
  for (const Mover& mover : movers) {
    auto v = solution.v[mover.body].template head<N>();
    v = mover.v;
    if (couples()) v += mover.origin;
  }
}

template class NewtonSystem<3>;
template class NewtonSystem<6>;

}  // namespace tumble
