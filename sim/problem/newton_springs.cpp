// Of the many λ that hold what is held more than once, those of springs: contact points of one
// compliance ε = 1/ρ, without a load at first,
//   λn = max(0, zn),   λt = zt cut to the length mu λn,   z = −(u + bias)/ε,
// in the limit ε → 0. There u is 0 where contacts hold, and z = −J δ with one small motion δ of all
// bodies: what Σ ρ v is over stages that each begin with the z of the one before.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/problem/newton_system.h"

namespace tumble {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kInner = 10;                       ///< steps of a stage
constexpr double kStiff = 1e4, kStiffest = 1e8;  ///< ρ of springs, by the weight of the system
constexpr double kNoSlip = 1e-10;  ///< of the scale: slower slips are those of springs

}  // namespace

template <int N>
Piece NewtonSystem<N>::ofSpring(const Point& point, const Vec3& z, Vec3& force) const {
  const double push = std::max(z[0], 0.0), limit = point.muTrue * push;
  if (point.kind == ConeKind::Equality) {
    set(force, yielding(point) * z[0], 0.0, 0.0);
    return Piece::Whole;
  }
  const Piece piece = z[0] < 0.0 ? Piece::Zero : Piece::Whole;
  if (point.kind != ConeKind::Friction) {
    set(force, push, point.kind == ConeKind::Slide ? -limit : 0.0, 0.0);
    return piece;
  }
  if (piece == Piece::Zero) {
    set(force, 0.0, 0.0, 0.0);
    return piece;
  }
  const double tangential = std::sqrt(z[1] * z[1] + z[2] * z[2]);
  if (tangential <= limit) {
    set(force, z[0], z[1], z[2]);
    return piece;
  }
  set(force, push, limit * z[1] / tangential, limit * z[2] / tangential);
  return Piece::Edge;
}

/// ∂λ/∂z of a spring that holds.
template <int N>
Mat3 NewtonSystem<N>::slopeOfSpring(const Point& point, const Vec3& z) const {
  Mat3 slope = Mat3::Zero();
  slope(0, 0) = yielding(point);
  if (point.kind == ConeKind::Slide) slope(1, 0) = -point.muTrue;
  if (point.kind != ConeKind::Friction) return slope;
  if (point.piece == Piece::Whole) return Mat3::Identity();
  const double tangential = std::sqrt(z[1] * z[1] + z[2] * z[2]);
  const Eigen::Vector2d d = z.tail<2>() / tangential;
  const double turn = point.muTrue * std::max(z[0], 0.0) / tangential;
  slope.block<2, 1>(1, 0) = point.muTrue * d;
  slope.block<2, 2>(1, 1) = turn * (Eigen::Matrix2d::Identity() - d * d.transpose());
  return slope;
}

template <int N>
bool NewtonSystem<N>::areOfSprings() const {
  constexpr double kSame = 1e-12;
  double largest = 0.0, off = 0.0;
  for (const Point& point : points) {
    if (point.kind == ConeKind::Equality) continue;
    Vec3 force;
    ofSpring(point, point.sum - rho * point.u, force);
    largest = std::max(largest, point.force.template lpNorm<Eigen::Infinity>());
    off = std::max(off, (force - point.force).template lpNorm<Eigen::Infinity>());
  }
  return off <= kSame * largest;
}

template <int N>
void NewtonSystem<N>::take(const Problem& problem, const Solution& answer) {
  constexpr double kEdge = 1.0 - 1e-9;  // of its limit: friction that has reached it
  restart(answer);
  for (std::size_t c = 0; c < points.size(); ++c) {
    Point& point = points[c];
    point.force.setZero();
    for (int k = 0; k < point.rows; ++k)
      point.force[k] = answer.lambda[problem.cones[c].row + k] / point.length;
    point.piece = Piece::Whole;
    if (point.kind == ConeKind::Equality) continue;
    const double rubs = std::hypot(point.force[1], point.force[2]);
    if (!(point.force[0] > 0.0)) {
      point.piece = Piece::Zero;
    } else if (point.kind == ConeKind::Friction && rubs >= kEdge * point.mu * point.force[0]) {
      point.piece = Piece::Edge;
    }
  }
}

/// Springs without a load.
template <int N>
void NewtonSystem<N>::loosen() {
  springs_ = true;
  for (Point& point : points) {
    point.mu = point.muTrue;
    point.saxce = point.slip = 0.0;
    point.lambda.setZero();
  }
}

/// The first step of loose springs goes by slopes that are known: at λ = 0 and u = 0 rounding would
/// choose them. Where pulls are the right ones but for a factor, it is the last.
template <int N>
void NewtonSystem<N>::startPressed() {
  loosen();
  for (Point& point : points) point.lambda = point.pull + rho * point.u;
  assemblePressed();
  for (Point& point : points) {
    point.lambda.setZero();
    point.force = slopeOfSpring(point, point.pull) * (-rho * point.u);
  }
  evaluateAsIs();
  direction(live_);
  for (Mover& mover : movers) mover.v += mover.step;
}

template <int N>
void NewtonSystem<N>::assemblePressed() {
  assembleLive();
  for (Point& point : points) point.pressed = point.piece;
  pressedRho_ = rho;
}

/// Whether the last factor is that of springs on the pieces where they are.
template <int N>
bool NewtonSystem<N>::springsFit() const {
  return pressedRho_ == rho && std::all_of(points.begin(), points.end(),
                                           [](const Point& p) { return p.piece == p.pressed; });
}

/// Brings the gradient to 0, to rounding, by at most that many factors. @return whether it came
/// there
template <int N>
bool NewtonSystem<N>::press(int most) {
  constexpr double kChord = 0.1;   // a factor of other slips serves while steps shrink so
  constexpr double kSmall = 1e-9;  // of the scale: below it a step that does not shrink is rounding
  constexpr double kNone = 1e-15;  // of the scale: a step that changes nothing
  const int end = factorizations + most;
  double before = kInfinity;
  look();
  for (int k = 0; k < 4 * most && factorizations < end; ++k) {
    const bool bent = std::any_of(points.begin(), points.end(),
                                  [](const Point& p) { return p.piece == Piece::Edge; });
    const bool fits = springsFit();
    double change = fits ? direction(live_) : 0.0;
    if (!fits || (bent && change > kSmall * scale && change > kChord * before)) {
      assemblePressed();
      change = direction(live_);
    }
    if (!std::isfinite(change)) return false;
    if (change <= kNone * scale) {
      for (Mover& mover : movers) mover.v += mover.step;
      look();
      return true;
    }
    const bool whole = shorten();
    if (whole && !bent && springsFit()) return true;
    if (change > 0.5 * before && change < kSmall * scale) return true;
    before = change;
  }
  return false;
}

/// z goes on from stage to stage; but friction of what slips in earnest has its direction alone.
template <int N>
void NewtonSystem<N>::nextPress() {
  constexpr double kStays = 0.5;  // of a slip: that of a spring shrinks from stage to stage
  for (Point& point : points) {
    const double slip = std::hypot(point.u[1], point.u[2]);
    const bool slips = point.piece == Piece::Edge && point.slip > 0.0 &&
                       slip > std::max(kNoSlip * scale, kStays * point.slip);
    point.slip = slip;
    point.lambda -= rho * point.u;
    if (slips) point.lambda.template tail<2>().setZero();
    if (point.kind == ConeKind::Equality) point.lambda = point.force;
  }
}

/// Stages until they bring nothing, nor stiffer ones. @return the residual
template <int N>
double NewtonSystem<N>::pressOn(double tolerance) {
  constexpr int kStages = 16;
  constexpr double kStiffer = 10.0, kClosed = 1e-14;
  double before = kInfinity;
  for (int stage = 0; stage < kStages; ++stage) {
    if (stage > 0) nextPress();
    if (!press(kInner)) break;
    const double now = residual();
    const bool stays = stage > 1 && now > 0.5 * before;
    before = now;
    if (now <= kClosed || (stays && (now <= tolerance || rho >= kStiffest * weight))) break;
    if (stays) rho *= kStiffer;
  }
  return before;
}

/// A step by the last factor alone, in which u changes as the step says: what stiff springs make of
/// the rounding of fast velocities would be no balance of momentum.
template <int N>
void NewtonSystem<N>::closePress() {
  if (!springsFit()) return;
  direction(live_);
  for (Mover& mover : movers) mover.v += mover.step;
  for (Point& point : points) point.u += point.du;
  evaluate();
}

/// From soft springs to stiff ones, each from the v of those before. @return whether it came there
template <int N>
bool NewtonSystem<N>::climb() {
  constexpr double kSoft = 0.01, kFar = 10.0, kNear = 1.3;
  constexpr int kSteps = 25, kEasy = 4, kFailures = 6, kFactors = 150;
  const int end = factorizations + kFactors;
  double tau = kSoft, factor = kFar;
  loosen();
  for (Mover& mover : movers) mover.v = mover.star;
  std::vector<Point> pointsBefore = points;
  std::vector<Mover> moversBefore = movers;
  for (int failed = 0; factorizations < end && failed < kFailures; tau *= factor) {
    const int spent = factorizations;
    rho = std::min(tau, kStiff) * weight;
    if (press(kSteps)) {
      if (tau >= kStiff) return true;
      pointsBefore = points;
      moversBefore = movers;
      if (factorizations - spent <= kEasy) factor = std::min(kFar, factor * factor);
    } else {
      goBack(pointsBefore, moversBefore);
      tau /= factor;
      factor = std::max(kNear, std::sqrt(factor));
      ++failed;
    }
  }
  return false;
}

template <int N>
void NewtonSystem<N>::expect(const Problem& problem, std::span<const double> pull) {
  expects_ = false;
  if (pull.size() != problem.rows.size()) return;
  for (std::size_t c = 0; c < points.size(); ++c) {
    Point& point = points[c];
    point.pull = -kStiff * weight * point.u;  // of a new contact
    if (std::isnan(pull[problem.cones[c].row])) continue;
    expects_ = true;
    for (int k = 0; k < point.rows; ++k)
      point.pull[k] = pull[problem.cones[c].row + k] / point.length;
  }
}

template <int N>
double NewtonSystem<N>::expectSprings(double tolerance) {
  constexpr int kAtOnce = 2;  // factors: where more are needed, the usual way costs no more
  if (!expects_) return kInfinity;
  rho = kStiff * weight;
  Vec3 force;
  for (Point& point : points) point.piece = ofSpring(point, point.pull, force);
  startPressed();
  return endSprings(press(kAtOnce), tolerance);
}

template <int N>
double NewtonSystem<N>::findSprings(double tolerance) {
  rho = kStiff * weight;
  for (Point& point : points) {
    const bool slips =
        point.piece == Piece::Edge && std::hypot(point.u[1], point.u[2]) > kNoSlip * scale;
    point.pull = point.force - rho * point.u;
    if (slips) point.pull.template tail<2>() = -rho * point.u.template tail<2>();
  }
  startPressed();
  return endSprings(press(kInner) || climb(), tolerance);
}

/// Goes on from where springs were found, if they were. @return the residual
template <int N>
double NewtonSystem<N>::endSprings(bool found, double tolerance) {
  const double residual = found ? pressOn(tolerance) : kInfinity;
  pulled_ = residual <= tolerance;
  if (pulled_) closePress();
  // As of the ρ that they begin with, which tells on what slips in earnest alone.
  for (Point& point : points) point.pull = point.lambda - kStiff * weight * point.u;
  springs_ = false;
  return residual;
}

template class NewtonSystem<3>;
template class NewtonSystem<6>;

}  // namespace tumble
