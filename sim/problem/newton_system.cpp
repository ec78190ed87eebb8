// Reads a contact problem into movers and points, begins stages, and tells how far from solved it
// is.
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
    point.mu = point.muTrue = cone.mu;
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

/// λ becomes the forces; and mu |u_t| what it is now, if asked for.
void NewtonSystem::nextStage(bool renewSlip) {
  for (Point& point : points) {
    point.lambda = point.force;
    if (point.kind == ConeKind::Slide) point.lambda[1] = -point.mu * point.force[0];
  }
  if (renewSlip) takeSlip();
}

void NewtonSystem::narrow() {
  constexpr double kInside = 0.8;
  for (Point& point : points)
    if (point.kind == ConeKind::Friction) point.mu = kInside * point.muTrue;
}

bool NewtonSystem::widen(double slip) {
  bool any = false;
  for (Point& point : points) {
    if (point.mu == point.muTrue || std::hypot(point.u[1], point.u[2]) < slip) continue;
    point.mu = point.muTrue;
    any = true;
  }
  return any;
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
  for (Point& point : points) {
    point.lambda.setZero();
    point.mu = point.muTrue;
  }
  guess_ = true;
  look(true);
}

double NewtonSystem::residual() const {
  double worst = 0.0;
  for (const Point& point : points) {
    const double rho = point.mobility > 0.0 ? 1.0 / point.mobility : 1.0;
    const Cone cone{point.kind, 0, point.mu};
    const double own = coneResidual(cone, point.force.data(), point.u.data(), rho) / point.length;
    if (!std::isfinite(own)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, own);
  }
  return worst / scale;
}

double NewtonSystem::balance() {
  work_.resize(movers.size());
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const Mover& mover = movers[i];
    const Vec6 change = mover.v - mover.star;
    work_[i] << mover.mass * change.head<3>(), mover.inertia * change.tail<3>();
    work_[i] = work_[i].cwiseAbs();
  }
  for (const Point& point : points) {
    if (point.a >= 0) work_[point.a] += point.Ja.lazyProduct(point.force).cwiseAbs();
    if (point.b >= 0) work_[point.b] += point.Jb.lazyProduct(point.force).cwiseAbs();
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const auto part = [&](int first) {
      const double gross = work_[i].segment<3>(first).maxCoeff();
      const double open = movers[i].gradient.segment<3>(first).cwiseAbs().maxCoeff();
      return gross > 0.0 ? open / gross : 0.0;
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
