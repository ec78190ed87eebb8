#include "sim/problem/endless.h"

#include <algorithm>
#include <cmath>

#include "sim/problem/row.h"

namespace tumble {
namespace {

/// Sweeps over the first row of every cone, from λ = 0 and v = 0 of what moves.
class Normals {
 public:
  explicit Normals(const Problem& problem)
      : problem_(problem), v_(problem.vStar), lambda_(problem.cones.size(), 0.0) {
    for (std::size_t i = 0; i < v_.size(); ++i)
      if (problem.invM[i] > 0.0 || !problem.Iinv[i].isZero(0.0)) v_[i].setZero();
    for (std::size_t c = 0; c < lambda_.size(); ++c) asked_.push_back(rowVelocity(row(c), v_));
  }

  /// @return the largest change, in units of u
  double sweep() {
    double largest = 0.0;
    for (std::size_t c = 0; c < lambda_.size(); ++c) {
      const double mobility = rowMobility(problem_, row(c)) - row(c).compliance;
      if (mobility <= 0.0 || row(c).compliance > 0.0) continue;
      double next = lambda_[c] - rowVelocity(row(c), v_) / mobility;
      if (problem_.cones[c].kind != ConeKind::Equality) next = std::max(0.0, next);
      push(row(c), next - lambda_[c]);
      largest = std::max(largest, std::abs(next - lambda_[c]) * mobility);
      lambda_[c] = next;
    }
    return largest;
  }

  bool endless() const {
    constexpr double kBehind = 0.01;
    double asks = 0.0, gives = 0.0;
    for (std::size_t c = 0; c < lambda_.size(); ++c) {
      asks -= asked_[c] * lambda_[c];
      gives += (rowVelocity(row(c), v_) - asked_[c]) * lambda_[c];
    }
    return asks > 0.0 && gives < kBehind * asks;
  }
  const std::vector<double>& lambda() const { return lambda_; }

 private:
  const Row& row(std::size_t cone) const { return problem_.rows[problem_.cones[cone].row]; }
  void push(const Row& row, double by) {
    v_[row.a].head<3>() += by * problem_.invM[row.a] * row.linear;
    v_[row.b].head<3>() -= by * problem_.invM[row.b] * row.linear;
    v_[row.a].tail<3>() += by * (problem_.Iinv[row.a] * row.angularA);
    v_[row.b].tail<3>() += by * (problem_.Iinv[row.b] * row.angularB);
  }

  const Problem& problem_;
  std::vector<Vec6> v_;
  std::vector<double> lambda_, asked_;
};

}  // namespace

std::vector<double> endlessPush(const Problem& problem) {
  constexpr int kSweeps = 2000;
  constexpr double kSettled = 1e-4;  // of the first change: forces that end
  Normals normals(problem);
  const double first = normals.sweep();
  for (int k = 1; k < kSweeps; ++k)
    if (normals.sweep() <= kSettled * first) return {};
  return normals.endless() ? normals.lambda() : std::vector<double>{};
}

}  // namespace tumble
