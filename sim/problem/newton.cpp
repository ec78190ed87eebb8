// Chapter 6, problem: proximal augmented Lagrangian, minimised by semismooth Newton steps.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "sim/problem/block_cholesky.h"
#include "sim/problem/cone.h"
#include "sim/problem/solvers.h"

namespace tumble {
namespace {

using Mat63 = Eigen::Matrix<double, 6, 3>;

/// Which smooth piece of Π_K a multiplier lies on.
enum class Piece : signed char { Zero, Whole, Edge };

/// A cone between the bodies that move, with all that belongs to it.
struct Point {
  ConeKind kind = ConeKind::Push;
  int rows = 1;
  int a = -1, b = -1;  ///< of the moving bodies; −1: does not move
  int edge = -1;       ///< if both move: their block off the diagonal
  double mu = 0.0;
  double length = 1.0;  ///< what the rows of a turn are multiplied with, to be in m/s
  double mobility = 0.0;
  Mat63 Ja = Mat63::Zero(), Jb = Mat63::Zero();  ///< u = Jaᵀ va + Jbᵀ vb + bias
  Vec3 bias = Vec3::Zero();
  Vec3 lambda = Vec3::Zero();  ///< of the last stage
  double saxce = 0.0;          ///< mu |u_t| of the last stage
  Vec3 u = Vec3::Zero(), du = Vec3::Zero();
  Vec3 force = Vec3::Zero();  ///< Π_K(λ − ρ(u + s))
  Mat3 slope = Mat3::Zero();  ///< ∂Π
  Piece piece = Piece::Zero, factored = Piece::Zero;
};

/// Bodies that move.
struct Mover {
  int body = 0;
  bool moves = true, turns = true;
  double mass = 1.0;
  Mat3 inertia = Mat3::Identity();
  Vec6 star, v, gradient, step, gross;
};

class Newton {
 public:
  SolveReport solve(const Problem& problem, const SolveSettings& settings, Solution& solution);

 private:
  void prepare(const Problem& problem);
  void addMovers(const Problem& problem);
  void addPoints(const Problem& problem);
  void linkBodies();
  const BlockStructure& structureFor(int rows, std::span<const BlockEdge> edges);

  void project(Point& point, const Vec3& z) const;
  void look();
  void evaluate();
  void assemble();
  double direction();
  double slopeAt(double alpha);
  double searchLine();
  bool minimise(double accuracy, int most);
  void nextStage(bool renewSlip);
  void takeSlip();
  double residual() const;
  double balance() const;
  double accuracy(double tolerance, double residual) const;
  void restart(const Problem& problem, const Solution& start);
  void closeBalance(SolveReport& report, double tolerance);
  double solveCalm(double tolerance);
  double solveCold(double tolerance, int most);
  void write(const Problem& problem, Solution& solution) const;

  std::vector<Mover> movers_;
  std::vector<Point> points_;
  std::vector<int> moverOf_;
  std::pair<std::vector<Mover>, std::vector<Point>> saved_;
  std::vector<BlockEdge> edges_;
  std::vector<std::unique_ptr<BlockStructure>> structures_;
  BlockCholesky H_;
  std::vector<Vec6> work_;
  double weight_ = 1.0;  ///< [kg] what ρ is measured by
  double rho_ = 1.0, factoredRho_ = 0.0;
  double scale_ = 1.0;  ///< [m/s]
  bool guess_ = false;  ///< the first step of all takes every contact that would close as closed
  int factorizations_ = 0;
};

void Newton::addMovers(const Problem& problem) {
  movers_.clear();
  moverOf_.assign(problem.invM.size(), -1);
  for (std::size_t i = 0; i < problem.invM.size(); ++i) {
    const bool moves = problem.invM[i] > 0.0, turns = !problem.Iinv[i].isZero(0.0);
    if (!moves && !turns) continue;
    moverOf_[i] = static_cast<int>(movers_.size());
    Mover& mover = movers_.emplace_back();
    mover.body = static_cast<int>(i);
    mover.mass = moves ? 1.0 / problem.invM[i] : 1.0;
    mover.inertia = turns ? Mat3(problem.Iinv[i].llt().solve(Mat3::Identity())) : Mat3::Identity();
    mover.star = problem.vStar[i];
    mover.moves = moves;
    mover.turns = turns;
  }
}

void Newton::addPoints(const Problem& problem) {
  points_.resize(problem.cones.size());
  for (std::size_t c = 0; c < points_.size(); ++c) {
    const Cone& cone = problem.cones[c];
    Point& point = points_[c];
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

const BlockStructure& Newton::structureFor(int rows, std::span<const BlockEdge> edges) {
  constexpr std::size_t kMost = 64;
  for (auto& structure : structures_)
    if (structure->isFor(rows, edges)) return *structure;
  if (structures_.size() == kMost) structures_.erase(structures_.begin());
  structures_.push_back(std::make_unique<BlockStructure>(rows, edges));
  return *structures_.back();
}

/// Finds the pairs of moving bodies, and puts the body of a block's row first.
void Newton::linkBodies() {
  edges_.clear();
  for (const Point& point : points_)
    if (point.a >= 0 && point.b >= 0) edges_.emplace_back(std::minmax(point.a, point.b));
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  H_.begin(structureFor(static_cast<int>(movers_.size()), edges_));
  for (Point& point : points_) {
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

void Newton::prepare(const Problem& problem) {
  addMovers(problem);
  addPoints(problem);
  linkBodies();
  scale_ = velocityScale(problem);
  factoredRho_ = 0.0;
  factorizations_ = 0;
  weight_ = 0.0;
  for (const Mover& mover : movers_)
    if (mover.moves) weight_ += 0.25 * mover.mass;
  if (weight_ == 0.0) weight_ = 1.0;
}

/// Π_K(z), its derivative, and the piece it is on.
void Newton::project(Point& point, const Vec3& z) const {
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

/// u, forces and gradient at v.
void Newton::look() {
  for (Point& point : points_) {
    point.u = point.bias;
    if (point.a >= 0) point.u.noalias() += point.Ja.transpose() * movers_[point.a].v;
    if (point.b >= 0) point.u.noalias() += point.Jb.transpose() * movers_[point.b].v;
  }
  evaluate();
}

void Newton::evaluate() {
  for (Mover& mover : movers_) {
    const Vec6 change = mover.v - mover.star;
    mover.gradient << mover.mass * change.head<3>(), mover.inertia * change.tail<3>();
    mover.gross = mover.gradient.cwiseAbs();
  }
  for (Point& point : points_) {
    Vec3 z = point.lambda - rho_ * point.u;
    z[0] -= rho_ * point.saxce;
    project(point, z);
    if (point.piece == Piece::Zero && point.kind != ConeKind::Slide) continue;
    const auto push = [&](int mover, const Mat63& J) {
      if (mover < 0) return;
      const Vec6 force = J.leftCols(point.rows) * point.force.head(point.rows);
      movers_[mover].gradient -= force;
      movers_[mover].gross += force.cwiseAbs();
    };
    push(point.a, point.Ja);
    push(point.b, point.Jb);
  }
}

/// H = M + ρ Jᵀ ∂Π J.
void Newton::assemble() {
  H_.begin(structureFor(static_cast<int>(movers_.size()), edges_));
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    Mat6& block = H_.diagonal(static_cast<int>(i));
    block.diagonal().head<3>().setConstant(movers_[i].mass);
    block.bottomRightCorner<3, 3>() = movers_[i].inertia;
  }
  for (Point& point : points_) {
    Piece piece = point.piece;
    if (guess_ && piece == Piece::Zero) {
      // Where the unhindered motion approaches, a contact is expected to hold.
      double u = point.bias[0];
      if (point.a >= 0) u += point.Ja.col(0).dot(movers_[point.a].star);
      if (point.b >= 0) u += point.Jb.col(0).dot(movers_[point.b].star);
      if (u < 0.0) piece = Piece::Whole;
    }
    point.factored = piece;
    if (piece == Piece::Zero) continue;
    if (point.kind != ConeKind::Friction) {
      const Vec6 a = rho_ * point.Ja.col(0), b = point.Jb.col(0);
      if (point.a >= 0) H_.diagonal(point.a).noalias() += a * point.Ja.col(0).transpose();
      if (point.b >= 0) H_.diagonal(point.b).noalias() += (rho_ * b) * b.transpose();
      if (point.edge >= 0) H_.edge(point.edge).noalias() += a * b.transpose();
      continue;
    }
    Mat63 a, b;
    if (piece == Piece::Whole) {
      a = rho_ * point.Ja;
      b = rho_ * point.Jb;
    } else {
      const double mu = point.mu, c = 1.0 / (1.0 + mu * mu);
      const Vec3 z = point.lambda - rho_ * point.u;
      const double tangential = std::sqrt(z[1] * z[1] + z[2] * z[2]);
      const Vec3 edge(1.0, mu * z[1] / tangential, mu * z[2] / tangential);
      const double ratio = mu * point.force[0] / tangential;
      Mat3 slope = c * edge * edge.transpose();
      const Vec3 across(0.0, -z[2] / tangential, z[1] / tangential);
      slope += ratio * across * across.transpose();
      slope *= rho_;
      a.noalias() = point.Ja * slope;
      b.noalias() = point.Jb * slope;
    }
    if (point.a >= 0) H_.diagonal(point.a).noalias() += a.lazyProduct(point.Ja.transpose());
    if (point.b >= 0) H_.diagonal(point.b).noalias() += b.lazyProduct(point.Jb.transpose());
    if (point.edge >= 0) H_.edge(point.edge).noalias() += a.lazyProduct(point.Jb.transpose());
  }
  H_.factor();
  factoredRho_ = rho_;
  guess_ = false;
  ++factorizations_;
}

/// Newton's direction d = −H⁻¹ g, and how much it changes the velocities of the rows.
double Newton::direction() {
  work_.resize(movers_.size());
  for (std::size_t i = 0; i < movers_.size(); ++i) work_[i] = -movers_[i].gradient;
  H_.solve(work_);
  for (std::size_t i = 0; i < movers_.size(); ++i) movers_[i].step = work_[i];
  double largest = 0.0;
  for (Point& point : points_) {
    point.du.setZero();
    if (point.a >= 0) point.du.noalias() += point.Ja.transpose() * movers_[point.a].step;
    if (point.b >= 0) point.du.noalias() += point.Jb.transpose() * movers_[point.b].step;
    largest = std::max(largest, point.du.lpNorm<Eigen::Infinity>());
  }
  return largest;
}

/// dΦ(v + α d)/dα.
double Newton::slopeAt(double alpha) {
  double slope = 0.0;
  for (const Mover& mover : movers_) {
    const Vec6 change = mover.v - mover.star + alpha * mover.step;
    slope += mover.mass * mover.step.head<3>().dot(change.head<3>()) +
             mover.step.tail<3>().dot(mover.inertia * change.tail<3>());
  }
  for (Point& point : points_) {
    Vec3 z = point.lambda - rho_ * (point.u + alpha * point.du);
    z[0] -= rho_ * point.saxce;
    project(point, z);
    slope -= point.du.dot(point.force);
  }
  return slope;
}

/// The part of the step that Φ asks for: 1 where its slope has gone down enough.
double Newton::searchLine() {
  constexpr double kEnough = 0.25;
  constexpr int kMost = 12;
  double low = 0.0, slopeLow = 0.0;
  for (const Mover& mover : movers_) slopeLow += mover.step.dot(mover.gradient);
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

/// Minimises Φ until a step changes no row by more than `accuracy` [m/s].
bool Newton::minimise(double accuracy, int most) {
  look();
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most; ++k) {
    const bool same =
        factoredRho_ == rho_ && std::all_of(points_.begin(), points_.end(), [](const Point& p) {
          return p.piece == p.factored && p.piece != Piece::Edge;
        });
    if (!same) assemble();
    const double change = direction();
    if (!std::isfinite(change)) return false;
    const double alpha = change <= accuracy ? 1.0 : searchLine();
    for (Mover& mover : movers_) mover.v += alpha * mover.step;
    look();
    if (change <= accuracy) return true;
    if (same && change > 0.5 * before) return true;  // rounding
    before = change;
  }
  return false;
}

/// λ becomes the forces; and mu |u_t| what it is now, if asked for.
void Newton::nextStage(bool renewSlip) {
  for (Point& point : points_) {
    point.lambda = point.force;
    if (point.kind == ConeKind::Slide) point.lambda[1] = -point.mu * point.force[0];
  }
  if (renewSlip) takeSlip();
}

/// De Saxcé's term from the velocities as they are.
void Newton::takeSlip() {
  for (Point& point : points_)
    if (point.kind == ConeKind::Friction)
      point.saxce = point.mu * std::hypot(point.u[1], point.u[2]);
}

double Newton::residual() const {
  double worst = 0.0;
  for (const Point& point : points_) {
    const double rho = point.mobility > 0.0 ? 1.0 / point.mobility : 1.0;
    const Cone cone{point.kind, 0, point.mu};
    worst =
        std::max(worst, coneResidual(cone, point.force.data(), point.u.data(), rho) / point.length);
  }
  return worst / scale_;
}

double Newton::balance() const {
  double worst = 0.0;
  for (const Mover& mover : movers_) {
    const auto part = [&](int first) {
      const double gross = mover.gross.segment<3>(first).maxCoeff();
      return gross > 0.0 ? mover.gradient.segment<3>(first).cwiseAbs().maxCoeff() / gross : 0.0;
    };
    worst = std::max({worst, part(0), part(3)});
  }
  return worst;
}

void Newton::write(const Problem& problem, Solution& solution) const {
  solution.lambda.resize(problem.rows.size());
  solution.v = problem.vStar;
  for (std::size_t c = 0; c < points_.size(); ++c)
    for (int k = 0; k < points_[c].rows; ++k)
      solution.lambda[problem.cones[c].row + k] = points_[c].length * points_[c].force[k];
  for (const Mover& mover : movers_) solution.v[mover.body] = mover.v;
}

/// A large ρ magnifies the rounding of fast slips. At a solution every ρ gives the same forces, so
/// a small one closes the balance of momentum.
void Newton::closeBalance(SolveReport& report, double tolerance) {
  constexpr double kRounding = 1e-14;
  constexpr int kStages = 8, kSteps = 3;
  report.balance = balance();
  if (report.balance <= kRounding) return;
  saved_ = {movers_, points_};
  rho_ = weight_;
  double left = report.residual;
  for (int stage = 0; stage < kStages; ++stage) {
    nextStage(true);
    for (int k = 0; k < kSteps && (k == 0 || balance() > kRounding); ++k) minimise(0.0, 1);
    left = residual();
    if (left <= tolerance) break;
  }
  const double closed = balance();
  if (closed < report.balance && left <= std::max(tolerance, report.residual)) {
    report.balance = closed;
    report.residual = left;
  } else {
    std::swap(movers_, saved_.first);
    std::swap(points_, saved_.second);
  }
}

/// Stages of constant slip terms with one large ρ: where little has changed, one factor will do.
double Newton::solveCalm(double tolerance) {
  constexpr double kTau = 1e3;
  constexpr int kStages = 8, kInner = 4, kMost = 12;
  rho_ = kTau * weight_;
  double before = std::numeric_limits<double>::infinity();
  for (int stage = 0; stage < kStages && factorizations_ < kMost; ++stage) {
    if (!minimise(accuracy(tolerance, before), kInner)) break;
    const double now = residual();
    if (now > tolerance && now > 0.5 * before) return now;
    nextStage(false);
    if (now <= tolerance) {  // one stage more costs no factor and leaves rounding alone
      minimise(0.0, kInner);
      return residual();
    }
    before = now;
  }
  return std::numeric_limits<double>::infinity();
}

/// Stages with slip terms that follow, and a ρ that grows while stages are easy.
double Newton::solveCold(double tolerance, int most) {
  constexpr double kFirstTau = 1.0, kGrowth = 10.0, kLastTau = 1e5;
  constexpr int kStages = 60, kInner = 60, kEasy = 6;
  constexpr double kNear = 1e-9;  // below this, stages that bring nothing are counted
  constexpr int kPatience = 4;
  rho_ = kFirstTau * weight_;
  double before = std::numeric_limits<double>::infinity(), best = before;
  int stalled = 0;
  for (int stage = 0;; ++stage) {
    const int spent = factorizations_;
    minimise(accuracy(tolerance, before), kInner);
    const double now = residual();
    stalled = now > 0.8 * best && now < kNear ? stalled + 1 : 0;
    best = std::min(best, now);
    if (now <= tolerance || stage == kStages || factorizations_ >= most || stalled == kPatience)
      return now;
    const bool slow = now > 0.01 * before && factorizations_ - spent <= kEasy;
    if (stage == 0 || slow) rho_ = std::min(kGrowth * rho_, kLastTau * weight_);
    before = now;
    nextStage(true);
  }
}

/// How little [m/s] a step must change any row to be the last of its stage.
double Newton::accuracy(double tolerance, double residual) const {
  return scale_ * std::max(0.1 * tolerance, 0.01 * std::min(1.0, residual));
}

void Newton::restart(const Problem& problem, const Solution& start) {
  const bool known = start.v.size() == problem.vStar.size();
  for (Mover& mover : movers_) {
    mover.v = known ? start.v[mover.body] : mover.star;
    if (!mover.moves) mover.v.head<3>() = mover.star.head<3>();
    if (!mover.turns) mover.v.tail<3>() = mover.star.tail<3>();
  }
  for (Point& point : points_) point.lambda.setZero();
  guess_ = true;
  look();
  takeSlip();
}

SolveReport Newton::solve(const Problem& problem, const SolveSettings& settings,
                          Solution& solution) {
  constexpr int kMost = 300;  // factorizations: what they leave is told
  prepare(problem);
  restart(problem, solution);
  SolveReport report;
  report.residual = solveCalm(settings.tolerance);
  if (!(report.residual <= settings.tolerance)) {
    if (!std::isfinite(report.residual)) restart(problem, solution);
    report.residual = solveCold(settings.tolerance, std::min(kMost, settings.maxIterations));
  }
  closeBalance(report, settings.tolerance);
  report.iterations = factorizations_;
  if (!(report.residual <= settings.tolerance)) report.status = SolveStatus::NotConverged;
  write(problem, solution);
  return report;
}

}  // namespace

SolveReport solveNewton(const Problem& problem, const SolveSettings& settings, Solution& solution) {
  thread_local Newton newton;  // keeps its memory from call to call
  return newton.solve(problem, settings, solution);
}

}  // namespace tumble
