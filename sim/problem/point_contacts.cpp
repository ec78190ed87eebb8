#include "sim/problem/point_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "sim/problem/aggregates.h"
#include "sim/problem/block_cholesky.h"
#include "sim/problem/cone.h"
#include "sim/problem/gmres.h"
#include "sim/problem/node_matrix.h"

namespace tumble {
namespace {

using Vectors = std::vector<Vec3>;

enum class Law { Open, Sticks, Slides };

/// A contact, and the piece of the law that it is on.
struct Touching : NodeRows {
  double mu = 0.0;
  Vec3 rho = Vec3::Zero();  ///< [kg] along n, and along t1 and t2
  Vec3 lambda = Vec3::Zero(), u = Vec3::Zero();
  Law law = Law::Open, factored = Law::Open;
  Vec3 along = Vec3::Zero(), across = Vec3::Zero();  ///< friction that slides, unit vectors
  double turning = 0.0;  ///< [kg] by which friction across grows with the slip across,
  double turned = 0.0;   ///< [N s] and how much of it is missing
};

class PointContacts {
 public:
  /// False for a problem of another kind.
  bool read(const Problem& problem, const Solution& start);
  std::optional<SolveReport> solve(const Problem& problem, const SolveSettings& settings,
                                   Solution& solution);

 private:
  bool readTouches(const Problem& problem, const Solution& start);
  void findStructure();
  void choose();
  void slide(Touching& touch, const Vec3& z);
  bool step();
  void go(bool whole);
  double missing() const;
  bool factor();
  void aim();
  void applySlope(std::span<const Vec3> y, std::span<Vec3> out) const;
  void keepFree(std::span<Vec3> x) const;
  void findForces();
  void judge(const Problem& problem, SolveReport& report);
  double balance() const;
  void write(const Problem& problem, Solution& solution) const;

  Nodes nodes_;
  BlockStructures structures_;
  std::vector<BlockEdge> edges_;
  const BlockStructure* structure_ = nullptr;
  BlockCholesky<3> H_;
  std::vector<Touching> touches_;
  std::vector<int> touchOf_;   ///< per node: its contact, or −1
  std::vector<Freedom> free_;  ///< per node: where its velocity is not known at once
  Vectors star_, v_;
  Vectors moved_, open_;  ///< v − v*, and A of it
  Vectors step_, right_, start_;
  std::array<double, 2> left_ = {};  ///< [N² s²] missing after the last two steps
  Gmres gmres_;
  Solution found_;
  int factors_ = 0;
};

bool PointContacts::read(const Problem& problem, const Solution& start) {
  // With fewer bodies a factor costs little, and stages of solveNewton end from any start.
  constexpr std::size_t kMany = 512;
  if (problem.invM.size() < kMany) return false;
  if (std::any_of(problem.Iinv.begin(), problem.Iinv.end(),
                  [](const Mat3& inverse) { return !inverse.isZero(0.0); }))
    return false;  // a solid moves
  nodes_.read(problem);
  if (!readTouches(problem, start)) return false;
  const bool known = start.v.size() == problem.vStar.size();
  star_.clear();
  v_.clear();
  for (const int body : nodes_.bodyOf) {
    star_.push_back(problem.vStar[body].head<3>());
    v_.push_back((known ? start.v : problem.vStar)[body].head<3>());
  }
  for (Vectors* vectors : {&moved_, &open_, &step_, &right_}) vectors->resize(v_.size());
  findStructure();
  factors_ = 0;
  return true;
}

bool PointContacts::readTouches(const Problem& problem, const Solution& start) {
  constexpr double kYields = 0.1;  // of a block of A: neighbours of a point give way with it
  const bool warm = start.lambda.size() == problem.rows.size();
  touches_.clear();
  touchOf_.assign(nodes_.bodyOf.size(), -1);
  for (const Cone& cone : problem.cones) {
    const Row& first = problem.rows[cone.row];
    const bool aMoves = nodes_.nodeOf[first.a] >= 0, bMoves = nodes_.nodeOf[first.b] >= 0;
    const bool rubs = cone.kind == ConeKind::Friction;
    if (aMoves == bMoves || !(rubs || cone.kind == ConeKind::Push)) return false;
    Touching touch{rowsOfNode(problem, cone, nodes_.nodeOf)};
    if (std::exchange(touchOf_[touch.node], static_cast<int>(touches_.size())) >= 0) return false;
    touch.mu = rubs ? cone.mu : 0.0;
    const Mat3& own = nodes_.A.own[touch.node];
    const auto n = touch.J.row(0);
    const double across = n * own * n.transpose(), along = kYields * 0.5 * (own.trace() - across);
    touch.rho = {across, along, along};
    for (int k = 0; warm && k < coneRows(cone.kind); ++k)
      touch.lambda[k] = start.lambda[cone.row + k];
    touches_.push_back(touch);
  }
  return true;
}

void PointContacts::findStructure() {
  edges_.clear();
  for (int i = 0; i < nodes_.A.count(); ++i)
    for (int k = nodes_.A.begin[i]; k < nodes_.A.begin[i + 1]; ++k)
      if (nodes_.A.near[k].node > i) edges_.emplace_back(i, nodes_.A.near[k].node);
  std::sort(edges_.begin(), edges_.end());
  structure_ = &structures_.of(nodes_.A.count(), edges_);
}

/// On which piece of the law each contact is, by λ and u.
void PointContacts::choose() {
  free_.assign(v_.size(), {});
  for (Touching& touch : touches_) {
    const auto n = touch.J.row(0);
    touch.u = touch.J * v_[touch.node] + touch.bias;
    const Vec3 z = touch.lambda - touch.rho.cwiseProduct(touch.u);
    touch.law = Law::Open;
    if (!(z[0] > 0.0)) continue;
    Freedom& free = free_[touch.node];
    if (touch.mu > 0.0 && z.tail<2>().norm() <= touch.mu * z[0]) {
      touch.law = Law::Sticks;
      free = {Freedom::Kind::None, Mat3::Zero()};
    } else {
      touch.law = Law::Slides;
      free = {Freedom::Kind::Some, Mat3::Identity() - n.transpose() * n};
      slide(touch, z);
    }
  }
}

/// Friction that slides is mu λ_n along z_t; how it turns with z_t and λ_t.
void PointContacts::slide(Touching& touch, const Vec3& z) {
  constexpr double kLeast = 1e-6;  // of |z_t|: less is all but stuck
  touch.turning = touch.turned = 0.0;
  if (touch.mu == 0.0) return;
  const double size = z.tail<2>().norm();
  const double left = std::max(1.0 - touch.mu * z[0] / size, kLeast), part = (1.0 - left) / left;
  const Eigen::Vector2d along = z.tail<2>() / size, across(-along[1], along[0]);
  touch.along = touch.J.bottomRows<2>().transpose() * along;
  touch.across = touch.J.bottomRows<2>().transpose() * across;
  touch.turning = part * touch.rho[1];
  touch.turned = part * across.dot(touch.lambda.tail<2>());
}

/// Keeps what is free of velocities.
void PointContacts::keepFree(std::span<Vec3> x) const {
  for (const Touching& touch : touches_)
    if (touch.law != Law::Open) x[touch.node] = free_[touch.node].along * x[touch.node];
}

/// The velocities that contacts have at once, and what is left of the rows for those that are free.
void PointContacts::aim() {
  std::fill(step_.begin(), step_.end(), Vec3::Zero());
  for (const Touching& touch : touches_) {
    if (touch.law == Law::Sticks) step_[touch.node] = -touch.J.transpose() * touch.u;
    if (touch.law == Law::Slides) step_[touch.node] = -touch.u[0] * touch.J.row(0).transpose();
  }
  nodes_.A.times(step_, right_);
  for (std::size_t i = 0; i < v_.size(); ++i) right_[i] = -(open_[i] + right_[i]);
  for (const Touching& touch : touches_) {
    if (touch.law != Law::Slides || touch.mu == 0.0) continue;
    Vec3& r = right_[touch.node];
    r -= touch.mu * touch.J.row(0).dot(r) * touch.along + touch.turned * touch.across;
  }
  keepFree(right_);
}

/// The derivative of the rows that are free.
void PointContacts::applySlope(std::span<const Vec3> y, std::span<Vec3> out) const {
  nodes_.A.times(y, out);
  for (const Touching& touch : touches_) {
    if (touch.law != Law::Slides || touch.mu == 0.0) continue;
    Vec3& row = out[touch.node];
    row += touch.turning * touch.across.dot(y[touch.node]) * touch.across -
           touch.mu * touch.J.row(0).dot(row) * touch.along;
  }
  keepFree(out);
}

/// The factor of its symmetric part, with rows of their own for what is not free.
bool PointContacts::factor() {
  const NodeMatrix& A = nodes_.A;
  H_.begin(*structure_);
  auto edge = edges_.begin();
  for (int i = 0; i < A.count(); ++i) {
    Mat3& own = H_.diagonal(i);
    own = freeBlock(free_[i], A.own[i], free_[i]);
    own += A.own[i].trace() * (Mat3::Identity() - free_[i].along);
    for (int k = A.begin[i]; k < A.begin[i + 1]; ++k) {
      const int j = A.near[k].node;
      if (j < i) continue;
      const BlockEdge pair(i, j);
      if (edge == edges_.end() || *edge != pair)
        edge = std::lower_bound(edges_.begin(), edges_.end(), pair);
      const int e = static_cast<int>(edge++ - edges_.begin());
      const Mat3 block = freeBlock(free_[i], A.near[k].block, free_[j]);
      H_.lower(e) = H_.edgeRow(e) == i ? block : Mat3(block.transpose());
    }
  }
  for (Touching& touch : touches_) {
    touch.factored = touch.law;
    if (touch.law == Law::Slides && touch.mu > 0.0)
      H_.diagonal(touch.node) += touch.turning * touch.across * touch.across.transpose();
  }
  ++factors_;
  return H_.factor();
}

/// The next step. @return false where the slope has no factor
bool PointContacts::step() {
  constexpr int kFew = 4;         // changes of pieces that GMRES makes up for
  constexpr double kPart = 1e-3;  // of the right side: the next step does the rest
  const auto changed = std::count_if(touches_.begin(), touches_.end(), [](const Touching& touch) {
    return touch.law != touch.factored;
  });
  if ((factors_ == 0 || changed > kFew) && !factor()) return false;
  aim();
  gmres_.solve(
      right_, kPart, [this](auto y, auto out) { applySlope(y, out); },
      [this](std::span<Vec3> x) {
        H_.solve(x);
        keepFree(x);
      });
  for (std::size_t i = 0; i < v_.size(); ++i) step_[i] += right_[i];
  return true;
}

/// Takes so much of the step that less is missing than after one of the last two: without, pieces
/// may go to and fro for ever; and less each time takes many short steps.
void PointContacts::go(bool whole) {
  constexpr double kShortest = 1.0 / 64.0, kLess = 1e-4;
  start_ = v_;
  double left = 0.0;
  const double before = std::max(left_[0], left_[1]);
  for (double part = 1.0;; part *= 0.5) {
    for (std::size_t i = 0; i < v_.size(); ++i) v_[i] = start_[i] + part * step_[i];
    findForces();
    left = missing();
    if (whole || part <= kShortest || left <= (1.0 - kLess * part) * before) break;
  }
  left_ = {left_[1], left};
}

/// The squares of what is missing of all equations [N² s²], with the λ that follow from v.
double PointContacts::missing() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < v_.size(); ++i) {
    Vec3 left = open_[i];
    if (touchOf_[i] >= 0) {
      const Touching& touch = touches_[touchOf_[i]];
      const Vec3 u = touch.J * v_[i] + touch.bias;
      Vec3 z = touch.J * open_[i] - touch.rho.cwiseProduct(u);
      z[0] = std::max(z[0], 0.0);
      const double size = z.tail<2>().norm(), most = touch.mu * z[0];
      if (size > most) z.tail<2>() *= most / size;
      left -= touch.J.transpose() * z;
    }
    sum += left.squaredNorm();
  }
  return sum;
}

/// A (v − v*), which contacts take of their points.
void PointContacts::findForces() {
  for (std::size_t i = 0; i < v_.size(); ++i) moved_[i] = v_[i] - star_[i];
  nodes_.A.times(moved_, open_);
}

void PointContacts::judge(const Problem& problem, SolveReport& report) {
  for (Touching& touch : touches_) {
    touch.lambda.setZero();
    if (touch.law != Law::Open) touch.lambda = touch.J * open_[touch.node];
  }
  write(problem, found_);
  report.residual = naturalResidual(problem, found_, report.scale);
  report.balance = balance();
  report.iterations = factors_;
}

double PointContacts::balance() const {
  const NodeMatrix& A = nodes_.A;
  double worst = 0.0;
  for (int i = 0; i < A.count(); ++i) {
    Vec3 gross = (A.own[i] * moved_[i]).cwiseAbs(), left = open_[i];
    for (int k = A.begin[i]; k < A.begin[i + 1]; ++k)
      gross += (A.near[k].block * moved_[A.near[k].node]).cwiseAbs();
    if (touchOf_[i] >= 0) {
      const Touching& touch = touches_[touchOf_[i]];
      const Vec3 force = touch.J.transpose() * touch.lambda;
      gross += force.cwiseAbs();
      left -= force;
    }
    const double size = gross.maxCoeff();
    if (size > 0.0) worst = std::max(worst, left.lpNorm<Eigen::Infinity>() / size);
  }
  return worst;
}

void PointContacts::write(const Problem& problem, Solution& solution) const {
  nodes_.write(problem, v_, solution);
  solution.lambda.resize(problem.rows.size());
  for (std::size_t c = 0; c < touches_.size(); ++c) {
    const Cone& cone = problem.cones[c];
    for (int k = 0; k < coneRows(cone.kind); ++k)
      solution.lambda[cone.row + k] = touches_[c].lambda[k];
  }
}

std::optional<SolveReport> PointContacts::solve(const Problem& problem,
                                                const SolveSettings& settings, Solution& solution) {
  constexpr int kMost = 32;        // steps: the old stages cost as much
  constexpr double kOpen = 1e-12;  // balance of momentum that is as good as closed
  SolveReport report{.scale = velocityScale(problem)};
  std::optional<SolveReport> solved;
  findForces();
  left_.fill(missing());
  for (int k = 0; k < kMost; ++k) {
    choose();
    if (!step()) break;
    go(solved.has_value());
    judge(problem, report);
    const bool good = report.residual <= settings.tolerance &&
                      report.balance <= std::max(kOpen, 0.01 * settings.tolerance);
    if (good) std::swap(solution, found_);
    // One step beyond the tolerance leaves rounding alone, for no factor.
    if (solved) return good ? report : solved;
    if (good) solved = report;
    for (Touching& touch : touches_) touch.lambda = touch.J * open_[touch.node];
  }
  return solved;
}

}  // namespace

std::optional<SolveReport> solvePointContacts(const Problem& problem, const SolveSettings& settings,
                                              Solution& solution) {
  thread_local PointContacts contacts;  // keeps its storage from call to call
  if (!contacts.read(problem, solution)) return std::nullopt;
  return contacts.solve(problem, settings, solution);
}

}  // namespace tumble
