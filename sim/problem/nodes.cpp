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
struct Touching {
  ConeKind kind = ConeKind::Push;
  int node = 0;
  double mu = 0.0;
  Mat3 J = Mat3::Zero();         ///< rows n, t1, t2, for the point
  Mat3 mobility = Mat3::Zero();  ///< D⁻¹ Jᵀ, with D the block of the point in A
  Mat3 W = Mat3::Zero();         ///< J D⁻¹ Jᵀ
  Vec3 bias = Vec3::Zero();      ///< with what the other body moves
  Vec3 lambda = Vec3::Zero();
};

class Nodes {
 public:
  void read(const Problem& problem, std::span<const Vec3> side, const Solution& start);
  /// One sweep there and back. @return the largest change of a velocity, in any direction
  double sweep();
  /// Goes on along the way that the sweeps before went.
  void accelerate();
  /// Moves all points together, and gives contacts what is left of the points that they push.
  /// @param least  [m/s] slower slip has no direction yet
  void settle(double least);
  /// Whether what is left of the balance of momentum does no more than its share of work.
  bool closes(double open, double still) const;
  void write(const Problem& problem, Solution& solution) const;

 private:
  void readCouplings(const Problem& problem);
  void readCones(const Problem& problem, const Solution& start);
  /// b + Jᵀ λ less what the neighbours take: what is left for the point itself.
  Vec3 restOf(int node) const;
  /// b + Jᵀ λ − A v.
  Vec3 openOf(int node) const { return restOf(node) - A_.own[node].lazyProduct(v_[node]); }
  void visit(int node);
  void correct();
  void findFree();
  void findOpen();
  Eigen::Vector2d slipOf(const Touching& touch) const {
    return touch.J.bottomRows<2>() * v_[touch.node] + touch.bias.tail<2>();
  }
  Mat3 letSlide(double least);
  Mat3 factorTogether(const Mat3& turning);
  void keepOut(int node);
  void takeOpen(int node, double least);

  std::vector<int> nodeOf_, bodyOf_;
  NodeMatrix A_;
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

/// The blocks of A, row by row.
void Nodes::readCouplings(const Problem& problem) {
  const std::size_t count = bodyOf_.size();
  std::vector<int>& begin = A_.begin;
  begin.assign(count + 1, 0);
  for (const Coupling& c : problem.couplings) {
    if (c.a == c.b) {
      A_.own[nodeOf_[c.a]] += c.block;
      continue;
    }
    ++begin[nodeOf_[c.a] + 1];
    ++begin[nodeOf_[c.b] + 1];
  }
  for (std::size_t i = 0; i < count; ++i) begin[i + 1] += begin[i];
  A_.near.resize(begin.back());
  std::vector<int> next(begin.begin(), begin.end() - 1);
  for (const Coupling& c : problem.couplings) {
    if (c.a == c.b) continue;
    const int a = nodeOf_[c.a], b = nodeOf_[c.b];
    A_.near[next[a]++] = {.node = b, .block = c.block};
    A_.near[next[b]++] = {.node = a, .block = c.block.transpose()};
  }
  inverse_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    Mat3 factor = A_.own[i];
    invertFactor(factor);
    inverse_[i].noalias() = factor.transpose().lazyProduct(factor);
  }
}

void Nodes::readCones(const Problem& problem, const Solution& start) {
  touches_.clear();
  for (const Cone& cone : problem.cones) {
    const Row& first = problem.rows[cone.row];
    const bool aMoves = nodeOf_[first.a] >= 0;
    Touching touch{.kind = cone.kind, .mu = cone.mu};
    touch.node = nodeOf_[aMoves ? first.a : first.b];
    for (int k = 0; k < coneRows(cone.kind); ++k) {
      const Row& row = problem.rows[cone.row + k];
      const Vec6 still = Vec6::Zero();
      touch.J.row(k) = (aMoves ? 1.0 : -1.0) * row.linear.transpose();
      touch.bias[k] = row.bias + (aMoves ? rowSpeed(row, still, problem.vStar[row.b])
                                         : rowSpeed(row, problem.vStar[row.a], still));
      touch.lambda[k] = start.lambda[cone.row + k];
    }
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
  touchBegin_.assign(bodyOf_.size() + 1, 0);
  for (const Touching& touch : touches_) ++touchBegin_[touch.node + 1];
  for (std::size_t i = 0; i < bodyOf_.size(); ++i) touchBegin_[i + 1] += touchBegin_[i];
}

void Nodes::read(const Problem& problem, std::span<const Vec3> side, const Solution& start) {
  nodeOf_.assign(problem.invM.size(), -1);
  bodyOf_.clear();
  A_.own.clear();
  mass_.clear();
  side_.clear();
  v_.clear();
  for (std::size_t i = 0; i < problem.invM.size(); ++i) {
    if (!(problem.invM[i] > 0.0)) continue;
    nodeOf_[i] = static_cast<int>(bodyOf_.size());
    bodyOf_.push_back(static_cast<int>(i));
    mass_.push_back(1.0 / problem.invM[i]);
    A_.own.push_back(Mat3(Vec3::Constant(mass_.back()).asDiagonal()));
    side_.push_back(side[i]);
    v_.push_back(start.v[i].head<3>());
  }
  way_.assign(bodyOf_.size(), Vec3::Zero());
  gradient_ = 0.0;
  sweeps_ = 0;
  readCouplings(problem);
  readCones(problem, start);
}

Vec3 Nodes::restOf(int node) const {
  Vec3 rest = side_[node];
  for (int k = A_.begin[node]; k < A_.begin[node + 1]; ++k)
    rest.noalias() -= A_.near[k].block.lazyProduct(v_[A_.near[k].node]);
  for (int c = touchBegin_[node]; c < touchBegin_[node + 1]; ++c)
    rest.noalias() += touches_[c].J.transpose().lazyProduct(touches_[c].lambda);
  return rest;
}

/// Moves one point to where its row and its cones hold while all others stay.
[[gnu::flatten]] void Nodes::visit(int node) {
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
[[gnu::flatten]] void Nodes::correct() {
  constexpr int kRenewed = 10;  // sweeps in which other points come to be pushed
  if (sweeps_ == 1) aggregates_.gather(A_);
  if (sweeps_ % kRenewed == 1) {
    findFree();
    aggregates_.factor(A_, free_);
  }
  findOpen();
  aggregates_.correct(open_, v_);
}

void Nodes::findFree() {
  free_.assign(v_.size(), {});
  for (const Touching& touch : touches_)
    if (touch.lambda[0] > 0.0) bind(touch, free_[touch.node]);
}

void Nodes::findOpen() {
  open_.resize(v_.size());
  for (int i = 0; i < A_.count(); ++i) open_[i] = openOf(i);
}

/// What is left of single points would be momentum of the whole that nothing gave. Once all points
/// have moved together, as far as they are free, none of it is along that: what is across is what
/// contacts did not give yet. Friction follows, and so again.
void Nodes::settle(double least) {
  constexpr int kRounds = 12;
  constexpr double kClosed = 1e-12;  // of the momenta of all points
  double momentum = 0.0;
  for (std::size_t i = 0; i < v_.size(); ++i) momentum += mass_[i] * v_[i].norm();
  findOpen();
  for (int round = 0; round < kRounds; ++round) {
    Vec3 sum = Vec3::Zero(), free = Vec3::Zero();
    for (const Vec3& open : open_) sum += open;
    if (sum.norm() <= kClosed * momentum) return;
    findFree();
    const Mat3 together = factorTogether(letSlide(least));
    for (int i = 0; i < A_.count(); ++i) free += free_[i].along * open_[i];
    const Vec3 d = together.transpose() * (together * free);
    for (int i = 0; i < A_.count(); ++i) {
      v_[i] += free_[i].along * d;
      keepOut(i);
    }
    findOpen();
    for (int i = 0; i < A_.count(); ++i) takeOpen(i, least);
  }
}

/// What slips is free along its whole plane, against friction that turns with it.
/// @return Σ mu λ_n/|u_t| across what slips: the change of friction by a common velocity
Mat3 Nodes::letSlide(double least) {
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
[[gnu::flatten]] Mat3 Nodes::factorTogether(const Mat3& turning) {
  constexpr double kAcross = 1e-10;  // of the trace: along what no point is free
  Mat3 H = turning;
  for (int i = 0; i < A_.count(); ++i) {
    if (free_[i].kind == Freedom::Kind::None) continue;
    Mat3 row = Mat3::Zero();
    const auto add = [&](const Mat3& block, const Freedom& free) {
      if (free.kind == Freedom::Kind::All)
        row += block;
      else if (free.kind == Freedom::Kind::Some)
        row.noalias() += block.lazyProduct(free.along);
    };
    add(A_.own[i], free_[i]);
    for (int k = A_.begin[i]; k < A_.begin[i + 1]; ++k)
      add(A_.near[k].block, free_[A_.near[k].node]);
    H.noalias() += free_[i].along.lazyProduct(row);
  }
  H.diagonal().array() += kAcross * H.trace();
  if (!invertFactor(H)) H.setZero();
  return H;
}

/// No point goes below the skin with the others.
void Nodes::keepOut(int node) {
  for (int c = touchBegin_[node]; c < touchBegin_[node + 1]; ++c) {
    const Vec3 n = touches_[c].J.row(0);
    const double u = n.dot(v_[node]) + touches_[c].bias[0];
    if (u < 0.0) v_[node] -= u / n.squaredNorm() * n;
  }
}

/// Contacts take what is open in the point that they push, within their cones: what slides goes on
/// to have all the friction that there can be.
void Nodes::takeOpen(int node, double least) {
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

double Nodes::sweep() {
  before_ = v_;
  const int count = A_.count();
  for (int i = 0; i < count; ++i) visit(i);
  if (sweeps_ > 0) correct();
  ++sweeps_;
  for (int i = count - 1; i >= 0; --i) visit(i);
  double largest = 0.0;
  for (int i = 0; i < count; ++i)
    largest = std::max(largest, (v_[i] - before_[i]).lpNorm<Eigen::Infinity>());
  return largest;
}

void Nodes::accelerate() {
  double gradient = 0.0;
  for (std::size_t i = 0; i < v_.size(); ++i) {
    const Vec3 change = v_[i] - before_[i];
    gradient += change.dot(A_.own[i].lazyProduct(change));
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

bool Nodes::closes(double open, double still) const {
  double work = 0.0, energy = 0.0;
  for (int i = 0; i < A_.count(); ++i) {
    const double speed = std::max(v_[i].norm(), still);
    work += v_[i].dot(openOf(i));
    energy += 0.5 * mass_[i] * speed * speed;
  }
  return std::abs(work) <= open * energy;
}

void Nodes::write(const Problem& problem, Solution& solution) const {
  solution.v = problem.vStar;
  solution.pull.clear();
  for (std::size_t i = 0; i < v_.size(); ++i) solution.v[bodyOf_[i]].head<3>() = v_[i];
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const Cone& cone = problem.cones[coneOf_[k]];
    for (int r = 0; r < coneRows(cone.kind); ++r)
      solution.lambda[cone.row + r] = touches_[k].lambda[r];
  }
}

}  // namespace

SolveReport sweepNodes(const Problem& problem, std::span<const Vec3> side,
                       const SweepSettings& settings, Solution& solution) {
  thread_local Nodes nodes;  // keeps its storage from call to call
  solution.lambda.resize(problem.rows.size(), 0.0);
  nodes.read(problem, side, solution);
  SolveReport report{.status = SolveStatus::NotConverged, .scale = velocityScale(problem)};
  while (report.iterations < settings.most) {
    if (report.iterations > 0) nodes.accelerate();
    const double change = nodes.sweep();
    ++report.iterations;
    report.residual = change / report.scale;
    if (!(change <= settings.enough) || !nodes.closes(settings.open, settings.still)) continue;
    report.status = SolveStatus::Solved;
    break;
  }
  nodes.settle(settings.enough);
  constexpr double kFar =
      1.0;  // of the energies: contacts took what stiff points hold for each other
  if (!nodes.closes(kFar, settings.still)) report.status = SolveStatus::NotConverged;
  nodes.write(problem, solution);
  return report;
}

}  // namespace tumble
