// One minimisation: the gradient of Φ, Newton's direction and how far to go along it.
#include "sim/problem/newton_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/problem/cone.h"

namespace tumble {

/// Π_K(z), its derivative, and the piece it is on.
template <int N>
void NewtonSystem<N>::project(Point& point, const Vec3& z) const {
  const double mu = point.mu;
  if (springs_) {
    point.piece = ofSpring(point, z, point.force);
    return;
  }
  switch (point.kind) {
    case ConeKind::Equality:
      set(point.force, yielding(point) * z[0], 0.0, 0.0);
      point.piece = Piece::Whole;
      return;
    case ConeKind::Slide:
    case ConeKind::Push:
      point.piece = z[0] >= 0.0 ? Piece::Whole : Piece::Zero;
      set(point.force, std::max(z[0], 0.0),
          point.kind == ConeKind::Slide ? -mu * point.lambda[0] : 0.0, 0.0);
      return;
    case ConeKind::Friction:
      break;
  }
  const double tangential = std::sqrt(z[1] * z[1] + z[2] * z[2]);
  if (tangential <= mu * z[0]) {
    point.piece = Piece::Whole;
    set(point.force, z[0], z[1], z[2]);
  } else if (mu * tangential <= -z[0]) {
    point.piece = Piece::Zero;
    set(point.force, 0.0, 0.0, 0.0);
  } else {
    point.piece = Piece::Edge;
    const double along = (z[0] + mu * tangential) / (1.0 + mu * mu);
    const double part = mu * along / tangential;
    set(point.force, along, part * z[1], part * z[2]);
  }
}

/// u at v.
template <int N>
void NewtonSystem<N>::takeRows() {
  forRows(&Mover::v, [](Point& point, const Three& rows) {
    for (int k = 0; k < 3; ++k) point.u[k] = rows[k] + point.bias[k];
  });
}

template <int N>
[[gnu::flatten]] void NewtonSystem<N>::look(bool slipFollows) {
  takeRows();
  if (slipFollows) takeSlip(1.0);
  evaluate();
}

/// The gradient A (v − vStar) − Jᵀ force, with the forces that `find(point, λ − ρ (u + s))` sets.
template <int N>
template <class Find>
void NewtonSystem<N>::gather(const Find& find) {
  for (Mover& mover : movers) mover.gradient = mover.momentum(mover.v - mover.star);
  forCoupled([this](int j) { return Vec3((movers[j].v - movers[j].star).template head<3>()); },
             [this](int i, const Vec3& p) { movers[i].gradient.template head<3>() += p; });
  for (const Patch& patch : patches_) {
    Twist wrench = Twist::Zero(), back = Twist::Zero();
    for (int p = patch.begin; p < patch.end; ++p) {
      Point& point = points[p];
      find(point, {point.lambda[0] - rho * point.u[0] - rho * point.saxce,
                   point.lambda[1] - rho * point.u[1], point.lambda[2] - rho * point.u[2]});
      if (point.piece == Piece::Zero && point.kind != ConeKind::Slide) continue;
      wrench += timesForce(point, point.J);
      if (!patch.shares) back -= timesForce(point, others_[patch.other]);
    }
    if (patch.a >= 0) movers[patch.a].gradient -= wrench;
    if (patch.b < 0) continue;
    if (patch.shares)
      addAtCentreOfB(patch, wrench, movers[patch.b].gradient);
    else
      movers[patch.b].gradient += back;
  }
}

template <int N>
[[gnu::flatten]] void NewtonSystem<N>::evaluate() {
  gather([this](Point& point, const Vec3& z) { project(point, z); });
}

/// The gradient with forces as they are.
template <int N>
void NewtonSystem<N>::evaluateAsIs() {
  gather([](const Point&, const Vec3&) {});
}

template <int N>
void NewtonSystem<N>::obey() {
  for (Mover& mover : movers) mover.v = mover.star;
  evaluateAsIs();
  beginMasses(H_);
  H_.factor();
  factoredRho_ = 0.0;
  ++factorizations;
  direction(H_);
  for (Mover& mover : movers) mover.v += mover.step;
  takeRows();
  evaluateAsIs();
}

template <int N>
void NewtonSystem<N>::factorUncut() {
  for (Point& point : points) point.piece = Piece::Whole;
  guess_ = false;
  assemble();
}

template <int N>
[[gnu::flatten]] void NewtonSystem<N>::goUncut() {
  gather([](Point& point, const Vec3& z) {
    point.piece = Piece::Whole;
    point.force.head(point.rows) = z.head(point.rows);
    if (point.kind == ConeKind::Slide) point.force[1] = point.lambda[1];
  });
  direction(H_);
  for (Mover& mover : movers) mover.v += mover.step;
  takeRows();
}

/// Where no contact sits between two pieces, the problem is linear, and what is left is rounding.
template <int N>
[[gnu::flatten]] bool NewtonSystem<N>::stageMore() {
  if (factoredRho_ != rho) return false;
  nextStage(0.0);
  gather([this](Point& point, const Vec3& z) {
    project(point, z);
    if (point.factored == Piece::Zero) point.force.setZero();
    if (point.factored == Piece::Whole && point.kind != ConeKind::Equality)
      point.force.head(point.rows) = z.head(point.rows);
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

/// Newton's direction d = −H⁻¹ g, and how much it changes the velocities of the rows.
template <int N>
template <class Factor>
[[gnu::flatten]] double NewtonSystem<N>::direction(Factor& factor) {
  work_.resize(movers.size());
  for (std::size_t i = 0; i < movers.size(); ++i) work_[i] = -movers[i].gradient;
  factor.solve(work_);
  for (std::size_t i = 0; i < movers.size(); ++i) movers[i].step = work_[i];
  double largest = 0.0;
  forRows(&Mover::step, [&](Point& point, const Three& rows) {
    for (int k = 0; k < 3; ++k) {
      point.du[k] = rows[k];
      largest = std::max(largest, std::abs(rows[k]));
    }
  });
  return largest;
}

/// dΦ(v + α d)/dα.
template <int N>
[[gnu::flatten]] double NewtonSystem<N>::slopeAt(double alpha) {
  double slope = 0.0;
  for (const Mover& mover : movers)
    slope += mover.step.dot(mover.momentum(mover.v - mover.star + alpha * mover.step));
  forCoupled(
      [&](int j) {
        const Mover& mover = movers[j];
        return Vec3((mover.v - mover.star + alpha * mover.step).template head<3>());
      },
      [&](int i, const Vec3& p) { slope += movers[i].step.template head<3>().dot(p); });
  for (Point& point : points) {
    Vec3 z = point.lambda - rho * (point.u + alpha * point.du);
    z[0] -= rho * point.saxce;
    project(point, z);
    slope -= point.du.dot(point.force);
  }
  return slope;
}

template <int N>
double NewtonSystem<N>::slopeHere() const {
  double slope = 0.0;
  for (const Mover& mover : movers) slope += mover.step.dot(mover.gradient);
  return slope;
}

template <int N>
void NewtonSystem<N>::move(double alpha) {
  for (Mover& mover : movers) mover.v += alpha * mover.step;
  look();
}

/// Goes the whole step; back from there where the slope of Φ has not gone down enough.
/// @return whether it went the whole step
template <int N>
bool NewtonSystem<N>::searchLine() {
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
template <int N>
bool NewtonSystem<N>::factorFits() const {
  return factoredRho_ == rho && std::all_of(points.begin(), points.end(),
                                            [](const Point& p) { return p.piece == p.factored; });
}

/// Minimises Φ until a step changes no row by more than `accuracy` [m/s].
template <int N>
bool NewtonSystem<N>::minimise(double accuracy, int most) {
  constexpr double kChord = 0.1;   // a factor whose edges have turned serves while steps shrink so
  constexpr double kSmall = 1e-9;  // of the scale: below it a step that does not shrink is rounding
  // The first steps of all are whole, as those of an active set: along a line, contacts would be
  // met one by one.
  constexpr int kFree = 8;
  const bool first = factorizations == 0;
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
    const bool free = first && k < kFree;
    if (free) move(1.0);
    const bool whole = free || searchLine();
    // Where Φ is quadratic, its minimum is reached but for rounding.
    if (whole && accuracy > 0.0 && !edges && factorFits()) return true;
    // A step that a contact of what bends cut short is not rounding.
    const bool cut = !whole && couples();
    if (!free && fits && !cut && change > 0.5 * before && (!edges || change < kSmall * scale))
      return true;
    before = change;
  }
  return false;
}

/// |gradient|² in the measure of M⁻¹.
template <int N>
double NewtonSystem<N>::merit() const {
  double sum = 0.0;
  for (const Mover& mover : movers) {
    const Vec3 angular = mover.gradient.template tail<3>();
    sum += mover.gradient.template head<3>().squaredNorm() / mover.mass;
    if constexpr (N == 6) sum += angular.dot(mover.inertiaInv * angular);
  }
  return sum;
}

/// Goes as far along the step as makes the gradient smaller, by halves.
/// @return whether it went the whole step
template <int N>
bool NewtonSystem<N>::shorten() {
  constexpr int kHalves = 12;
  constexpr double kGain = 0.2;
  const double before = merit();
  for (Mover& mover : movers) mover.v += mover.step;
  double alpha = 1.0;
  for (int k = 0;; ++k) {
    look(!springs_);
    if (merit() <= (1.0 - kGain * alpha) * before || k == kHalves) return k == 0;
    alpha *= 0.5;
    for (Mover& mover : movers) mover.v -= alpha * mover.step;
  }
}

template <int N>
bool NewtonSystem<N>::followSlip(double accuracy, int most) {
  constexpr double kSmall = 1e-9;  // of the scale: below it a step that does not shrink is rounding
  if (!rubs_) return minimise(accuracy, most);
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

template class NewtonSystem<3>;
template class NewtonSystem<6>;

}  // namespace tumble
