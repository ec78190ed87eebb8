// Sweeps over points that something bends between; one class, and so long.
#include "sim/problem/nodes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/problem/aggregates.h"
#include "sim/problem/cone.h"
#include "sim/problem/friction_block.h"

namespace tumble {
namespace {

/// A cone, and what its point gives way to it.
struct Touching : NodeRows {
  ConeKind kind = ConeKind::Push;
  double mu = 0.0;
  Mat3 mobility = Mat3::Zero();  ///< D⁻¹ Jᵀ, with D the block of the point in A
  Mat3 W = Mat3::Zero();         ///< J D⁻¹ Jᵀ
  Vec3 lambda = Vec3::Zero();
};

class NodeSweeps {
 public:
  void read(const Problem& problem, std::span<const Vec3> side, const Solution& start);
  /// One sweep there and back. @return the largest change of a velocity, in any direction
  double sweep();
  /// Goes on along the way that the sweeps before went.
  void accelerate();
  /// What is left of the balance of momentum at every point.
  void findOpen();
  /// Moves all points together, and gives contacts what was left of the points that they push.
  /// @param least  [m/s] slower slip has no direction yet
  void settle(double least);
  /// Whether what was left of the balance of momentum does no more than its share of work.
  bool closes(double open, double still) const;
  void write(const Problem& problem, Solution& solution) const;

 private:
  void invertBlocks();
  void readCones(const Problem& problem, const Solution& start);
  /// b + Jᵀ λ less what the neighbours take: what is left for the point itself.
  Vec3 restOf(int node) const;
  /// b + Jᵀ λ − A v.
  Vec3 openOf(int node) const { return restOf(node) - nodes_.A.own[node].lazyProduct(v_[node]); }
  void visit(int node);
  void correct();
  void findFree();
  void findLeft();
  Eigen::Vector2d slipOf(const Touching& touch) const {
    return touch.J.bottomRows<2>() * v_[touch.node] + touch.bias.tail<2>();
  }
  Mat3 letSlide(double least);
  Mat3 factorTogether(const Mat3& turning);
  void keepOut(int node);
  void takeOpen(int node, double least);

  Nodes nodes_;
  std::vector<Mat3> inverse_;      ///< of the blocks of its diagonal
  std::vector<Touching> touches_;  ///< by node
  std::vector<int> touchBegin_;    ///< per node
  std::vector<int> coneOf_;        ///< per touch
  std::vector<double> mass_;
  std::vector<Vec3> side_, v_, before_, way_, open_;
  Aggregates aggregates_;
  std::vector<Freedom> free_;
  int sweeps_ = 0;
  double gradient_ = 0.0;
};

void NodeSweeps::invertBlocks() {
  inverse_.resize(nodes_.A.own.size());
  for (std::size_t i = 0; i < inverse_.size(); ++i) {
    Mat3 factor = nodes_.A.own[i];
    invertFactor(factor);
    inverse_[i].noalias() = factor.transpose().lazyProduct(factor);
  }
}

void NodeSweeps::readCones(const Problem& problem, const Solution& start) {
  touches_.clear();
  for (const Cone& cone : problem.cones) {
    Touching touch{rowsOfNode(problem, cone, nodes_.nodeOf), cone.kind, cone.mu};
    for (int k = 0; k < coneRows(cone.kind); ++k) touch.lambda[k] = start.lambda[cone.row + k];
    touch.mobility = inverse_[touch.node].lazyProduct(touch.J.transpose());
    touch.W = touch.J.lazyProduct(touch.mobility);
    touches_.push_back(touch);
  }
  coneOf_.resize(touches_.size());
  for (std::size_t c = 0; c < coneOf_.size(); ++c) coneOf_[c] = static_cast<int>(c);
  std::stable_sort(coneOf_.begin(), coneOf_.end(),
                   [&](int p, int q) { return touches_[p].node < touches_[q].node; });
  std::stable_sort(touches_.begin(), touches_.end(),
                   [](const Touching& p, const Touching& q) { return p.node < q.node; });
  touchBegin_.assign(nodes_.bodyOf.size() + 1, 0);
  for (const Touching& touch : touches_) ++touchBegin_[touch.node + 1];
  for (std::size_t i = 0; i < nodes_.bodyOf.size(); ++i) touchBegin_[i + 1] += touchBegin_[i];
}

void NodeSweeps::read(const Problem& problem, std::span<const Vec3> side, const Solution& start) {
  nodes_.read(problem);
  mass_.clear();
  side_.clear();
  v_.clear();
  for (const int body : nodes_.bodyOf) {
    mass_.push_back(1.0 / problem.invM[body]);
    side_.push_back(side[body]);
    v_.push_back(start.v[body].head<3>());
  }
  way_.assign(nodes_.bodyOf.size(), Vec3::Zero());
  gradient_ = 0.0;
  sweeps_ = 0;
  invertBlocks();
  readCones(problem, start);
}

Vec3 NodeSweeps::restOf(int node) const {
  Vec3 rest = side_[node];
  for (int k = nodes_.A.begin[node]; k < nodes_.A.begin[node + 1]; ++k)
    rest.noalias() -= nodes_.A.near[k].block.lazyProduct(v_[nodes_.A.near[k].node]);
  for (int c = touchBegin_[node]; c < touchBegin_[node + 1]; ++c)
    rest.noalias() += touches_[c].J.transpose().lazyProduct(touches_[c].lambda);
  return rest;
}

/// Moves one point to where its row and its cones hold while all others stay.
[[gnu::flatten]] void NodeSweeps::visit(int node) {
  const int first = touchBegin_[node], end = touchBegin_[node + 1];
  Vec3& v = v_[node];
  v = inverse_[node].lazyProduct(restOf(node));
  // Of two cones that share a point, each is solved again after the other.
  constexpr int kAgain = 8;
  const int rounds = end - first > 1 ? kAgain : 1;
  for (int round = 0; round < rounds; ++round) {
    for (int c = first; c < end; ++c) {
      Touching& touch = touches_[c];
      v.noalias() -= touch.mobility.lazyProduct(touch.lambda);
      const Vec3 u = touch.J.lazyProduct(v) + touch.bias;
      if (!(u[0] < 0.0))
        touch.lambda.setZero();
      else if (touch.kind == ConeKind::Friction)
        touch.lambda = solveFrictionBlock(touch.W, u, touch.mu, touch.lambda);
      else
        touch.lambda = {-u[0] / touch.W(0, 0), 0.0, 0.0};
      v.noalias() += touch.mobility.lazyProduct(touch.lambda);
    }
  }
}

/// Whether a point that is pushed has all the friction that there can be.
bool slides(const Touching& touch) {
  constexpr double kSticks = 1.0 - 1e-9;  // of its limit: friction that has not reached it
  const double limit = touch.mu * touch.lambda[0];
  return limit > 0.0 && touch.lambda.tail<2>().norm() >= kSticks * limit;
}

/// A point that is pushed slides: without friction in a plane, with it along what rubs, as across
/// that its friction turns. One that sticks, or is pushed twice, stays.
void bind(const Touching& touch, Freedom& free) {
  const Vec3 n = touch.J.row(0).normalized();
  const Vec3 rubs = touch.J.bottomRows<2>().transpose() * touch.lambda.tail<2>();
  const bool rough = touch.kind == ConeKind::Friction && touch.mu > 0.0;
  if ((rough && !slides(touch)) || free.kind != Freedom::Kind::All)
    free = {Freedom::Kind::None, Mat3::Zero()};
  else if (rough)
    free = {Freedom::Kind::Some, rubs.normalized() * rubs.normalized().transpose()};
  else
    free = {Freedom::Kind::Some, Mat3::Identity() - n * n.transpose()};
}

/// Moves neighbours together, as far as they are free.
[[gnu::flatten]] void NodeSweeps::correct() {
  constexpr int kRenewed = 10;  // sweeps in which other points come to be pushed
  if (sweeps_ == 1) aggregates_.gather(nodes_.A);
  if (sweeps_ % kRenewed == 1) {
    const std::vector<Freedom> before = free_;
    findFree();
    if (sweeps_ == 1 || free_ != before) aggregates_.factor(nodes_.A, free_);
  }
  findLeft();
  aggregates_.correct(open_, v_);
}

/// What is left where each point was visited in turn: of what those behind it moved since.
void NodeSweeps::findLeft() {
  open_.resize(v_.size());
  for (int i = 0; i < nodes_.A.count(); ++i) {
    Vec3 left = Vec3::Zero();
    for (int k = nodes_.A.begin[i]; k < nodes_.A.begin[i + 1]; ++k)
      if (const auto& [j, block] = nodes_.A.near[k]; j > i)
        left.noalias() -= block.lazyProduct(Vec3(v_[j] - before_[j]));
    open_[i] = left;
  }
}

void NodeSweeps::findFree() {
  free_.assign(v_.size(), {});
  for (const Touching& touch : touches_)
    if (touch.lambda[0] > 0.0) bind(touch, free_[touch.node]);
}

void NodeSweeps::findOpen() {
  open_.resize(v_.size());
  for (int i = 0; i < nodes_.A.count(); ++i) open_[i] = openOf(i);
}

/// What is left of single points would be momentum of the whole that nothing gave. Once all points
/// have moved together, as far as they are free, none of it is along that: what is across is what
/// contacts did not give yet. Friction follows, and so again.
void NodeSweeps::settle(double least) {
  constexpr int kRounds = 12;
  constexpr double kClosed = 1e-12;  // of the momenta of all points
  double momentum = 0.0;
  for (std::size_t i = 0; i < v_.size(); ++i) momentum += mass_[i] * v_[i].norm();
  for (int round = 0; round < kRounds; ++round) {
    Vec3 sum = Vec3::Zero(), free = Vec3::Zero();
    for (const Vec3& open : open_) sum += open;
    if (sum.norm() <= kClosed * momentum) return;
    findFree();
    const Mat3 together = factorTogether(letSlide(least));
    for (int i = 0; i < nodes_.A.count(); ++i) free += free_[i].along * open_[i];
    const Vec3 d = together.transpose() * (together * free);
    for (int i = 0; i < nodes_.A.count(); ++i) {
      v_[i] += free_[i].along * d;
      keepOut(i);
    }
    findOpen();
    for (int i = 0; i < nodes_.A.count(); ++i) takeOpen(i, least);
  }
}

/// What slips is free along its whole plane, against friction that turns with it.
/// @return Σ mu λ_n/|u_t| across what slips: the change of friction by a common velocity
Mat3 NodeSweeps::letSlide(double least) {
  Mat3 turning = Mat3::Zero();
  for (const Touching& touch : touches_) {
    if (free_[touch.node].kind != Freedom::Kind::Some || !slides(touch)) continue;
    const Eigen::Vector2d slip = slipOf(touch);
    const double size = slip.norm();
    if (!(size > least)) continue;
    const Vec3 along = touch.J.row(1) * slip[0] + touch.J.row(2) * slip[1];
    const Vec3 n = touch.J.row(0).normalized(), across = n.cross(along) / size;
    free_[touch.node].along = Mat3::Identity() - n * n.transpose();
    turning += touch.mu * touch.lambda[0] / size * across * across.transpose();
  }
  return turning;
}

/// The factor, as of invertFactor, of H in  Σ F (r − A F d) = H d  less what turns.
[[gnu::flatten]] Mat3 NodeSweeps::factorTogether(const Mat3& turning) {
  constexpr double kAcross = 1e-10;  // of the trace: along what no point is free
  Mat3 H = turning;
  for (int i = 0; i < nodes_.A.count(); ++i) {
    if (free_[i].kind == Freedom::Kind::None) continue;
    Mat3 row = Mat3::Zero();
    const auto add = [&](const Mat3& block, const Freedom& free) {
      if (free.kind == Freedom::Kind::All)
        row += block;
      else if (free.kind == Freedom::Kind::Some)
        row.noalias() += block.lazyProduct(free.along);
    };
    add(nodes_.A.own[i], free_[i]);
    for (int k = nodes_.A.begin[i]; k < nodes_.A.begin[i + 1]; ++k)
      add(nodes_.A.near[k].block, free_[nodes_.A.near[k].node]);
    H.noalias() += free_[i].along.lazyProduct(row);
  }
  H.diagonal().array() += kAcross * H.trace();
  if (!invertFactor(H)) H.setZero();
  return H;
}

/// No point goes below the skin with the others.
void NodeSweeps::keepOut(int node) {
  for (int c = touchBegin_[node]; c < touchBegin_[node + 1]; ++c) {
    const Vec3 n = touches_[c].J.row(0);
    const double u = n.dot(v_[node]) + touches_[c].bias[0];
    if (u < 0.0) v_[node] -= u / n.squaredNorm() * n;
  }
}

/// Contacts take what is open in the point that they push, within their cones: what slides goes on
/// to have all the friction that there can be.
void NodeSweeps::takeOpen(int node, double least) {
  for (int c = touchBegin_[node]; c < touchBegin_[node + 1]; ++c) {
    Touching& touch = touches_[c];
    const double u = touch.J.row(0).dot(v_[node]) + touch.bias[0];
    if (touch.lambda[0] == 0.0 && u > 0.0) continue;
    const Vec3 before = touch.lambda, more = -touch.J.lazyProduct(open_[node]);
    touch.lambda[0] = std::max(before[0] + more[0], 0.0);
    if (touch.kind == ConeKind::Friction) {
      const double limit = touch.mu * touch.lambda[0];
      const Eigen::Vector2d slip = slipOf(touch);
      Eigen::Vector2d rubs = before.tail<2>() + more.tail<2>();
      if (slip.norm() > least)
        rubs = -limit / slip.norm() * slip;
      else if (rubs.norm() > limit)
        rubs *= limit / rubs.norm();
      touch.lambda.tail<2>() = rubs;
    }
    open_[node] += touch.J.transpose() * (touch.lambda - before);
  }
}

double NodeSweeps::sweep() {
  before_ = v_;
  const int count = nodes_.A.count();
  for (int i = 0; i < count; ++i) visit(i);
  if (sweeps_ > 0) correct();
  ++sweeps_;
  for (int i = count - 1; i >= 0; --i) visit(i);
  double largest = 0.0;
  for (int i = 0; i < count; ++i)
    largest = std::max(largest, (v_[i] - before_[i]).lpNorm<Eigen::Infinity>());
  return largest;
}

void NodeSweeps::accelerate() {
  double gradient = 0.0;
  for (std::size_t i = 0; i < v_.size(); ++i) {
    const Vec3 change = v_[i] - before_[i];
    gradient += change.dot(nodes_.A.own[i].lazyProduct(change));
  }
  // Where sweeps change more than before, the way that they went is no guide.
  const bool shrinks = gradient_ > 0.0 && gradient <= gradient_;
  const double beta = shrinks ? gradient / gradient_ : 0.0;
  gradient_ = gradient;
  for (std::size_t i = 0; i < v_.size(); ++i) {
    const Vec3 change = v_[i] - before_[i], further = beta * way_[i];
    v_[i] += further;
    way_[i] = further + change;
  }
}

bool NodeSweeps::closes(double open, double still) const {
  double work = 0.0, energy = 0.0;
  for (int i = 0; i < nodes_.A.count(); ++i) {
    const double speed = std::max(v_[i].norm(), still);
    work += v_[i].dot(open_[i]);
    energy += 0.5 * mass_[i] * speed * speed;
  }
  return std::abs(work) <= open * energy;
}

void NodeSweeps::write(const Problem& problem, Solution& solution) const {
  nodes_.write(problem, v_, solution);
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const Cone& cone = problem.cones[coneOf_[k]];
    for (int r = 0; r < coneRows(cone.kind); ++r)
      solution.lambda[cone.row + r] = touches_[k].lambda[r];
  }
}

}  // namespace

SolveReport sweepNodes(const Problem& problem, std::span<const Vec3> side,
                       const SweepSettings& settings, Solution& solution) {
  thread_local NodeSweeps nodes;  // keeps its storage from call to call
  solution.lambda.resize(problem.rows.size(), 0.0);
  nodes.read(problem, side, solution);
  SolveReport report{.status = SolveStatus::NotConverged, .scale = velocityScale(problem)};
  while (report.iterations < settings.most) {
    if (report.iterations > 0) nodes.accelerate();
    const double change = nodes.sweep();
    ++report.iterations;
    report.residual = change / report.scale;
    if (!(change <= settings.enough)) continue;
    nodes.findOpen();
    if (!nodes.closes(settings.open, settings.still)) continue;
    report.status = SolveStatus::Solved;
    break;
  }
  if (report.status != SolveStatus::Solved) nodes.findOpen();
  if (settings.settles) nodes.settle(settings.enough);
  constexpr double kFar =
      1.0;  // of the energies: contacts took what stiff points hold for each other
  if (!nodes.closes(kFar, settings.still)) report.status = SolveStatus::NotConverged;
  nodes.write(problem, solution);
  return report;
}

}  // namespace tumble
