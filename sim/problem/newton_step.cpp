// One minimisation: the gradient of Φ, its Hessian, Newton's direction and how far to go along it.
#include "sim/problem/newton_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/problem/cone.h"

namespace tumble {

/// Π_K(z), its derivative, and the piece it is on.
void NewtonSystem::project(Point& point, const Vec3& z) const {
  const double mu = point.mu;
  switch (point.kind) {
    case ConeKind::Equality:
      point.force = {z[0], 0.0, 0.0};
      point.piece = Piece::Whole;
      return;
    case ConeKind::Slide:
    case ConeKind::Push:
      point.piece = z[0] >= 0.0 ? Piece::Whole : Piece::Zero;
      point.force = {std::max(z[0], 0.0), 0.0, 0.0};
      if (point.kind == ConeKind::Slide) point.force[1] = -mu * point.lambda[0];
      return;
    case ConeKind::Friction:
      break;
  }
  const double tangential = std::sqrt(z[1] * z[1] + z[2] * z[2]);
  if (tangential <= mu * z[0]) {
    point.piece = Piece::Whole;
    point.force = z;
  } else if (mu * tangential <= -z[0]) {
    point.piece = Piece::Zero;
    point.force.setZero();
  } else {
    point.piece = Piece::Edge;
    const double along = (z[0] + mu * tangential) / (1.0 + mu * mu);
    const double part = mu * along / tangential;
    point.force = {along, part * z[1], part * z[2]};
  }
}

namespace {

/// Jᵀ v.
Vec3 speeds(const Mat63& J, const Vec6& v) {
  return {J.col(0).dot(v), J.col(1).dot(v), J.col(2).dot(v)};
}

/// What the upper triangle of A + B Cᵀ is not needed for.
template <class B, class C>
void addLower(Mat6& A, const B& b, const C& c) {
  A.leftCols<2>().noalias() += b.lazyProduct(c.template topRows<2>().transpose());
  A.block<4, 2>(2, 2).noalias() +=
      b.template bottomRows<4>().lazyProduct(c.template middleRows<2>(2).transpose());
  A.block<2, 2>(4, 4).noalias() +=
      b.template bottomRows<2>().lazyProduct(c.template bottomRows<2>().transpose());
}

}  // namespace

[[gnu::flatten]] void NewtonSystem::look(bool slipFollows) {
  for (Point& point : points) {
    point.u = point.bias;
    if (point.a >= 0) point.u += speeds(point.Ja, movers[point.a].v);
    if (point.b >= 0) point.u += speeds(point.Jb, movers[point.b].v);
  }
  if (slipFollows) takeSlip();
  evaluate();
}

/// The gradient M (v − vStar) − Jᵀ force, with the forces that `find(point, λ − ρ (u + s))` sets.
template <class Find>
void NewtonSystem::gather(const Find& find) {
  for (Mover& mover : movers) {
    const Vec6 change = mover.v - mover.star;
    mover.gradient << mover.mass * change.head<3>(), mover.inertia * change.tail<3>();
  }
  for (Point& point : points) {
    Vec3 z = point.lambda - rho * point.u;
    z[0] -= rho * point.saxce;
    find(point, z);
    if (point.piece == Piece::Zero && point.kind != ConeKind::Slide) continue;
    if (point.a >= 0) movers[point.a].gradient.noalias() -= point.Ja.lazyProduct(point.force);
    if (point.b >= 0) movers[point.b].gradient.noalias() -= point.Jb.lazyProduct(point.force);
  }
}

[[gnu::flatten]] void NewtonSystem::evaluate() {
  gather([this](Point& point, const Vec3& z) { project(point, z); });
}

/// Where no contact sits between two pieces, the problem is linear, and what is left is rounding.
bool NewtonSystem::stageMore() {
  if (factoredRho_ != rho) return false;
  nextStage(false);
  gather([this](Point& point, const Vec3& z) {
    project(point, z);
    if (point.factored == Piece::Zero) point.force.setZero();
    if (point.factored == Piece::Whole) point.force.head(point.rows) = z.head(point.rows);
    point.piece = point.factored;
  });
  direction(H_);
  for (Mover& mover : movers) mover.v += mover.step;
  for (Point& point : points) point.u += point.du;
  gather([this](Point& point, const Vec3& z) {
    project(point, z);
    if (point.factored == Piece::Zero) {
      point.force.setZero();
      point.piece = Piece::Zero;
    }
  });
  return true;
}

namespace {

/// ∂Π_K on the surface of a friction cone; z is what is projected, of which only the tangential
/// part counts.
Mat3 edgeSlope(const Point& point, const Vec3& z) {
  const double mu = point.mu, tangential = std::hypot(z[1], z[2]);
  const Vec3 along(1.0, mu * z[1] / tangential, mu * z[2] / tangential);
  const Vec3 across(0.0, -z[2] / tangential, z[1] / tangential);
  return along * along.transpose() / (1.0 + mu * mu) +
         mu * point.force[0] / tangential * across * across.transpose();
}

}  // namespace

/// A factor begins with M.
template <class Factor>
void NewtonSystem::beginMasses(Factor& factor) {
  factor.begin(*structure_);
  for (std::size_t i = 0; i < movers.size(); ++i) {
    Mat6& block = factor.diagonal(static_cast<int>(i));
    block.diagonal().template head<3>().setConstant(movers[i].mass);
    block.template bottomRightCorner<3, 3>() = movers[i].inertia;
  }
}

/// Where the unhindered motion approaches, or stays to rounding, a contact is expected to hold;
/// there rounding alone would choose a piece.
Piece NewtonSystem::guess(const Point& point) const {
  const double nearly = 1e-6 * scale;
  double u = point.bias[0];
  if (point.a >= 0) u += point.Ja.col(0).dot(movers[point.a].star);
  if (point.b >= 0) u += point.Jb.col(0).dot(movers[point.b].star);
  const bool holds = std::min(u, point.u[0]) < nearly;
  const bool slips = point.piece == Piece::Edge && std::hypot(point.u[1], point.u[2]) >= nearly;
  return holds && !slips ? Piece::Whole : point.piece;
}

/// H = M + ρ Jᵀ ∂Π J.
[[gnu::flatten]] void NewtonSystem::assemble() {
  beginMasses(H_);
  for (Point& point : points) {
    const Piece piece = guess_ ? guess(point) : point.piece;
    point.factored = piece;
    if (piece == Piece::Zero) continue;
    if (point.kind != ConeKind::Friction) {
      const Vec6 a = rho * point.Ja.col(0), b = point.Jb.col(0);
      if (point.a >= 0) H_.diagonal(point.a).noalias() += a * point.Ja.col(0).transpose();
      if (point.b >= 0) H_.diagonal(point.b).noalias() += (rho * b) * b.transpose();
      if (point.edge >= 0) H_.edge(point.edge).noalias() += a * b.transpose();
      continue;
    }
    Mat63 a, b;
    if (piece == Piece::Whole) {
      a = rho * point.Ja;
      b = rho * point.Jb;
    } else {
      const Mat3 slope = rho * edgeSlope(point, point.lambda - rho * point.u);
      a.noalias() = point.Ja * slope;
      b.noalias() = point.Jb * slope;
    }
    if (point.a >= 0) addLower(H_.diagonal(point.a), a, point.Ja);
    if (point.b >= 0) addLower(H_.diagonal(point.b), b, point.Jb);
    if (point.edge >= 0) H_.edge(point.edge).noalias() += a.lazyProduct(point.Jb.transpose());
  }
  H_.factor();
  factoredRho_ = rho;
  guess_ = false;
  ++factorizations;
}

/// Newton's direction d = −H⁻¹ g, and how much it changes the velocities of the rows.
template <class Factor>
[[gnu::flatten]] double NewtonSystem::direction(Factor& factor) {
  work_.resize(movers.size());
  for (std::size_t i = 0; i < movers.size(); ++i) work_[i] = -movers[i].gradient;
  factor.solve(work_);
  for (std::size_t i = 0; i < movers.size(); ++i) movers[i].step = work_[i];
  double largest = 0.0;
  for (Point& point : points) {
    point.du.setZero();
    if (point.a >= 0) point.du += speeds(point.Ja, movers[point.a].step);
    if (point.b >= 0) point.du += speeds(point.Jb, movers[point.b].step);
    largest = std::max(largest, point.du.lpNorm<Eigen::Infinity>());
  }
  return largest;
}

/// dΦ(v + α d)/dα.
[[gnu::flatten]] double NewtonSystem::slopeAt(double alpha) {
  double slope = 0.0;
  for (const Mover& mover : movers) {
    const Vec6 change = mover.v - mover.star + alpha * mover.step;
    slope += mover.mass * mover.step.head<3>().dot(change.head<3>()) +
             mover.step.tail<3>().dot(mover.inertia * change.tail<3>());
  }
  for (Point& point : points) {
    Vec3 z = point.lambda - rho * (point.u + alpha * point.du);
    z[0] -= rho * point.saxce;
    project(point, z);
    slope -= point.du.dot(point.force);
  }
  return slope;
}

double NewtonSystem::slopeHere() const {
  double slope = 0.0;
  for (const Mover& mover : movers) slope += mover.step.dot(mover.gradient);
  return slope;
}

void NewtonSystem::move(double alpha) {
  for (Mover& mover : movers) mover.v += alpha * mover.step;
  look();
}

/// Goes the whole step; back from there where the slope of Φ has not gone down enough.
/// @return whether it went the whole step
bool NewtonSystem::searchLine() {
  constexpr double kEnough = 0.25;
  constexpr int kMost = 12;
  double low = 0.0, slopeLow = slopeHere();
  const double enough = kEnough * std::abs(slopeLow);
  move(1.0);
  double high = 1.0, slopeHigh = slopeHere();
  if (slopeHigh <= enough) return true;
  double alpha = 1.0;
  for (int k = 0; k < kMost; ++k) {
    alpha = low + (high - low) * std::clamp(-slopeLow / (slopeHigh - slopeLow), 0.05, 0.95);
    const double slope = slopeAt(alpha - 1.0);
    if (std::abs(slope) <= enough) break;
    (slope < 0.0 ? low : high) = alpha;
    (slope < 0.0 ? slopeLow : slopeHigh) = slope;
  }
  move(alpha - 1.0);
  return false;
}

/// Whether the last factor is that of the pieces and ρ as they are.
bool NewtonSystem::factorFits() const {
  return factoredRho_ == rho && std::all_of(points.begin(), points.end(),
                                            [](const Point& p) { return p.piece == p.factored; });
}

/// Minimises Φ until a step changes no row by more than `accuracy` [m/s].
bool NewtonSystem::minimise(double accuracy, int most) {
  constexpr double kChord = 0.1;   // a factor whose edges have turned serves while steps shrink so
  constexpr double kSmall = 1e-9;  // of the scale: below it a step that does not shrink is rounding
  evaluate();
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most; ++k) {
    const bool edges = std::any_of(points.begin(), points.end(),
                                   [](const Point& p) { return p.piece == Piece::Edge; });
    const bool fits = factorFits();
    double change = fits ? direction(H_) : 0.0;
    if (!fits || (edges && !(change <= std::max(accuracy, kChord * before)))) {
      assemble();
      change = direction(H_);
    }
    if (!std::isfinite(change)) return false;
    if (change <= accuracy) {
      move(1.0);
      return true;
    }
    const bool whole = searchLine();
    // Where Φ is quadratic, its minimum is reached but for rounding.
    if (whole && accuracy > 0.0 && !edges && factorFits()) return true;
    if (fits && change > 0.5 * before && (!edges || change < kSmall * scale)) return true;
    before = change;
  }
  return false;
}

/// The Jacobian of the gradient where s = mu |u_t| follows v: M + ρ Jᵀ ∂Π (1 + n mu ûtᵀ) J, with ût
/// the direction of the slip. Not symmetric.
void NewtonSystem::assembleLive() {
  beginMasses(live_);
  for (const Point& point : points) {
    if (point.piece == Piece::Zero) continue;
    Mat3 slope = Mat3::Zero();
    if (point.piece == Piece::Edge) {
      slope = edgeSlope(point, point.lambda - rho * point.u);
    } else {
      slope.diagonal().head(point.kind == ConeKind::Friction ? 3 : 1).setOnes();
    }
    const double slip = std::hypot(point.u[1], point.u[2]);
    if (point.kind == ConeKind::Friction && slip > 0.0) {
      Mat3 follows = Mat3::Identity();
      follows.row(0).tail<2>() = point.mu / slip * point.u.tail<2>().transpose();
      slope *= follows;
    }
    slope *= rho;
    const Mat63 a = point.Ja * slope, b = point.Jb * slope;
    if (point.a >= 0) live_.diagonal(point.a).noalias() += a.lazyProduct(point.Ja.transpose());
    if (point.b >= 0) live_.diagonal(point.b).noalias() += b.lazyProduct(point.Jb.transpose());
    if (point.edge < 0) continue;
    live_.lower(point.edge).noalias() += a.lazyProduct(point.Jb.transpose());
    live_.upper(point.edge).noalias() += b.lazyProduct(point.Ja.transpose());
  }
  live_.factor();
  ++factorizations;
}

/// |gradient|² in the measure of M⁻¹.
double NewtonSystem::merit() const {
  double sum = 0.0;
  for (const Mover& mover : movers) {
    const Vec3 linear = mover.gradient.head<3>(), angular = mover.gradient.tail<3>();
    sum += linear.squaredNorm() / mover.mass + angular.dot(mover.inertiaInv * angular);
  }
  return sum;
}

/// Goes as far along the step as makes the gradient smaller, by halves.
void NewtonSystem::shorten() {
  constexpr int kHalves = 12;
  constexpr double kGain = 0.2;
  const double before = merit();
  for (Mover& mover : movers) mover.v += mover.step;
  double alpha = 1.0;
  for (int k = 0;; ++k) {
    look(true);
    if (merit() <= (1.0 - kGain * alpha) * before || k == kHalves) return;
    alpha *= 0.5;
    for (Mover& mover : movers) mover.v -= alpha * mover.step;
  }
}

bool NewtonSystem::followSlip(double accuracy, int most) {
  constexpr double kSmall = 1e-9;  // of the scale: below it a step that does not shrink is rounding
  look(true);
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most; ++k) {
    assembleLive();
    const double change = direction(live_);
    if (!std::isfinite(change)) return false;
    if (change <= accuracy) {
      for (Mover& mover : movers) mover.v += mover.step;
      look(true);
      return true;
    }
    shorten();
    if (change > 0.5 * before && change < kSmall * scale) return true;
    before = change;
  }
  return false;
}

}  // namespace tumble
