#include "sim/problem/newton_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/problem/cone.h"

namespace tumble {

void NewtonSystem::addMovers(const Problem& problem) {
  movers.clear();
  moverOf_.assign(problem.invM.size(), -1);
  for (std::size_t i = 0; i < problem.invM.size(); ++i) {
    const bool moves = problem.invM[i] > 0.0, turns = !problem.Iinv[i].isZero(0.0);
    if (!moves && !turns) continue;
    moverOf_[i] = static_cast<int>(movers.size());
    Mover& mover = movers.emplace_back();
    mover.body = static_cast<int>(i);
    mover.mass = moves ? 1.0 / problem.invM[i] : 1.0;
    mover.inertiaInv = turns ? problem.Iinv[i] : Mat3(Mat3::Identity());
    mover.inertia = mover.inertiaInv.llt().solve(Mat3::Identity());
    mover.star = problem.vStar[i];
    mover.moves = moves;
    mover.turns = turns;
  }
}

void NewtonSystem::addPoints(const Problem& problem) {
  points.resize(problem.cones.size());
  for (std::size_t c = 0; c < points.size(); ++c) {
    const Cone& cone = problem.cones[c];
    Point& point = points[c];
    point = Point{};
    point.kind = cone.kind;
    point.mu = cone.mu;
    point.rows = coneRows(cone.kind);
    const Row& first = problem.rows[cone.row];
    point.a = moverOf_[first.a];
    point.b = moverOf_[first.b];
    for (int k = 0; k < point.rows; ++k) {
      const Row& row = problem.rows[cone.row + k];
      Vec6 Ja, Jb;
      Ja << row.linear, row.angularA;
      Jb << -row.linear, row.angularB;
      point.bias[k] = row.bias;
      // What cannot move goes into the bias.
      const auto split = [&](int body, Vec6& J) {
        const Vec6& v = problem.vStar[body];
        if (problem.invM[body] == 0.0) {
          point.bias[k] += J.head<3>().dot(v.head<3>());
          J.head<3>().setZero();
        }
        if (problem.Iinv[body].isZero(0.0)) {
          point.bias[k] += J.tail<3>().dot(v.tail<3>());
          J.tail<3>().setZero();
        }
        return problem.invM[body] * J.head<3>().squaredNorm() +
               J.tail<3>().dot(problem.Iinv[body] * J.tail<3>());
      };
      const double mobility = split(row.a, Ja) + split(row.b, Jb);
      point.mobility = std::max(point.mobility, mobility);
      if (row.linear.isZero(0.0) && mobility > 0.0) {
        const double invM = problem.invM[row.a] + problem.invM[row.b];
        if (invM > 0.0) point.length = std::sqrt(invM / mobility);
      }
      point.Ja.col(k) = point.length * Ja;
      point.Jb.col(k) = point.length * Jb;
      point.bias[k] *= point.length;
    }
  }
}

const BlockStructure& NewtonSystem::structureFor(int rows, std::span<const BlockEdge> edges) {
  constexpr std::size_t kMost = 64;
  for (auto& structure : structures_)
    if (structure->isFor(rows, edges)) return *structure;
  if (structures_.size() == kMost) structures_.erase(structures_.begin());
  structures_.push_back(std::make_unique<BlockStructure>(rows, edges));
  return *structures_.back();
}

/// Finds the pairs of moving bodies, and puts the body of a block's row first.
void NewtonSystem::linkBodies() {
  edges_.clear();
  for (const Point& point : points)
    if (point.a >= 0 && point.b >= 0) edges_.emplace_back(std::minmax(point.a, point.b));
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  structure_ = &structureFor(static_cast<int>(movers.size()), edges_);
  H_.begin(*structure_);
  for (Point& point : points) {
    if (point.a < 0 || point.b < 0) continue;
    const BlockEdge edge = std::minmax(point.a, point.b);
    point.edge =
        static_cast<int>(std::lower_bound(edges_.begin(), edges_.end(), edge) - edges_.begin());
    if (H_.edgeRow(point.edge) == point.b) {
      std::swap(point.a, point.b);
      point.Ja.swap(point.Jb);
    }
  }
}

void NewtonSystem::prepare(const Problem& problem) {
  addMovers(problem);
  addPoints(problem);
  linkBodies();
  scale = velocityScale(problem);
  factoredRho_ = 0.0;
  factorizations = 0;
  weight = 0.0;
  for (const Mover& mover : movers)
    if (mover.moves) weight += 0.25 * mover.mass;
  if (weight == 0.0) weight = 1.0;
}

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

void NewtonSystem::look(bool slipFollows) {
  for (Point& point : points) {
    point.u = point.bias;
    if (point.a >= 0) point.u.noalias() += point.Ja.transpose() * movers[point.a].v;
    if (point.b >= 0) point.u.noalias() += point.Jb.transpose() * movers[point.b].v;
  }
  if (slipFollows) takeSlip();
  evaluate();
}

void NewtonSystem::evaluate() {
  for (Mover& mover : movers) {
    const Vec6 change = mover.v - mover.star;
    mover.gradient << mover.mass * change.head<3>(), mover.inertia * change.tail<3>();
    mover.gross = mover.gradient.cwiseAbs();
  }
  for (Point& point : points) {
    Vec3 z = point.lambda - rho * point.u;
    z[0] -= rho * point.saxce;
    project(point, z);
    if (point.piece == Piece::Zero && point.kind != ConeKind::Slide) continue;
    const auto push = [&](int mover, const Mat63& J) {
      if (mover < 0) return;
      const Vec6 force = J.leftCols(point.rows) * point.force.head(point.rows);
      movers[mover].gradient -= force;
      movers[mover].gross += force.cwiseAbs();
    };
    push(point.a, point.Ja);
    push(point.b, point.Jb);
  }
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
void NewtonSystem::assemble() {
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
    if (point.a >= 0) H_.diagonal(point.a).noalias() += a.lazyProduct(point.Ja.transpose());
    if (point.b >= 0) H_.diagonal(point.b).noalias() += b.lazyProduct(point.Jb.transpose());
    if (point.edge >= 0) H_.edge(point.edge).noalias() += a.lazyProduct(point.Jb.transpose());
  }
  H_.factor();
  factoredRho_ = rho;
  guess_ = false;
  ++factorizations;
}

/// Newton's direction d = −H⁻¹ g, and how much it changes the velocities of the rows.
template <class Factor>
double NewtonSystem::direction(Factor& factor) {
  work_.resize(movers.size());
  for (std::size_t i = 0; i < movers.size(); ++i) work_[i] = -movers[i].gradient;
  factor.solve(work_);
  for (std::size_t i = 0; i < movers.size(); ++i) movers[i].step = work_[i];
  double largest = 0.0;
  for (Point& point : points) {
    point.du.setZero();
    if (point.a >= 0) point.du.noalias() += point.Ja.transpose() * movers[point.a].step;
    if (point.b >= 0) point.du.noalias() += point.Jb.transpose() * movers[point.b].step;
    largest = std::max(largest, point.du.lpNorm<Eigen::Infinity>());
  }
  return largest;
}

/// dΦ(v + α d)/dα.
double NewtonSystem::slopeAt(double alpha) {
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

/// The part of the step that Φ asks for: 1 where its slope has gone down enough.
double NewtonSystem::searchLine() {
  constexpr double kEnough = 0.25;
  constexpr int kMost = 12;
  double low = 0.0, slopeLow = 0.0;
  for (const Mover& mover : movers) slopeLow += mover.step.dot(mover.gradient);
  const double enough = kEnough * std::abs(slopeLow);
  double high = 1.0, slopeHigh = slopeAt(high);
  if (slopeHigh <= enough) return 1.0;
  double alpha = 1.0;
  for (int k = 0; k < kMost; ++k) {
    alpha = low + (high - low) * std::clamp(-slopeLow / (slopeHigh - slopeLow), 0.05, 0.95);
    const double slope = slopeAt(alpha);
    if (std::abs(slope) <= enough) break;
    (slope < 0.0 ? low : high) = alpha;
    (slope < 0.0 ? slopeLow : slopeHigh) = slope;
  }
  return alpha;
}

/// Whether the last factor is that of the pieces and ρ as they are.
bool NewtonSystem::factorFits() const {
  return factoredRho_ == rho && std::all_of(points.begin(), points.end(),
                                            [](const Point& p) { return p.piece == p.factored; });
}

/// Minimises Φ until a step changes no row by more than `accuracy` [m/s].
bool NewtonSystem::minimise(double accuracy, int most, bool mayFactor) {
  constexpr double kChord = 0.1;   // a factor whose edges have turned serves while steps shrink so
  constexpr double kSmall = 1e-9;  // of the scale: below it a step that does not shrink is rounding
  look();
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most; ++k) {
    const bool edges = std::any_of(points.begin(), points.end(),
                                   [](const Point& p) { return p.piece == Piece::Edge; });
    const bool fits = factorFits();
    double change = fits ? direction(H_) : 0.0;
    if (!fits || (edges && !(change <= std::max(accuracy, kChord * before)))) {
      if (!mayFactor) return false;
      assemble();
      change = direction(H_);
    }
    if (!std::isfinite(change)) return false;
    const double alpha = change <= accuracy ? 1.0 : searchLine();
    for (Mover& mover : movers) mover.v += alpha * mover.step;
    look();
    if (change <= accuracy) return true;
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

/// λ becomes the forces; and mu |u_t| what it is now, if asked for.
void NewtonSystem::nextStage(bool renewSlip) {
  for (Point& point : points) {
    point.lambda = point.force;
    if (point.kind == ConeKind::Slide) point.lambda[1] = -point.mu * point.force[0];
  }
  if (renewSlip) takeSlip();
}

/// De Saxcé's term from the velocities as they are.
void NewtonSystem::takeSlip() {
  for (Point& point : points)
    if (point.kind == ConeKind::Friction)
      point.saxce = point.mu * std::hypot(point.u[1], point.u[2]);
}

void NewtonSystem::goBack(const std::vector<Point>& atPoints, const std::vector<Mover>& atMovers) {
  points = atPoints;
  movers = atMovers;
  factoredRho_ = 0.0;
}

void NewtonSystem::restart(const Solution& start) {
  const bool known = static_cast<int>(start.v.size()) == static_cast<int>(moverOf_.size());
  for (Mover& mover : movers) {
    mover.v = known ? start.v[mover.body] : mover.star;
    if (!mover.moves) mover.v.head<3>() = mover.star.head<3>();
    if (!mover.turns) mover.v.tail<3>() = mover.star.tail<3>();
  }
  for (Point& point : points) point.lambda.setZero();
  guess_ = true;
  look(true);
}

double NewtonSystem::residual() const {
  double worst = 0.0;
  for (const Point& point : points) {
    const double rho = point.mobility > 0.0 ? 1.0 / point.mobility : 1.0;
    const Cone cone{point.kind, 0, point.mu};
    worst =
        std::max(worst, coneResidual(cone, point.force.data(), point.u.data(), rho) / point.length);
  }
  return worst / scale;
}

double NewtonSystem::balance() const {
  double worst = 0.0;
  for (const Mover& mover : movers) {
    const auto part = [&](int first) {
      const double gross = mover.gross.segment<3>(first).maxCoeff();
      return gross > 0.0 ? mover.gradient.segment<3>(first).cwiseAbs().maxCoeff() / gross : 0.0;
    };
    worst = std::max({worst, part(0), part(3)});
  }
  return worst;
}

void NewtonSystem::write(const Problem& problem, Solution& solution) const {
  solution.lambda.resize(problem.rows.size());
  solution.v = problem.vStar;
  for (std::size_t c = 0; c < points.size(); ++c)
    for (int k = 0; k < points[c].rows; ++k)
      solution.lambda[problem.cones[c].row + k] = points[c].length * points[c].force[k];
  for (const Mover& mover : movers) solution.v[mover.body] = mover.v;
}

}  // namespace tumble
