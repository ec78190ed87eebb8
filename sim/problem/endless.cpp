#include "sim/problem/endless.h"

#include <algorithm>
#include <cmath>

#include "sim/problem/cone.h"
#include "sim/problem/row.h"

namespace tumble {
namespace {

/// Sweeps over the cones, from λ = 0 and v = 0 of what moves; of one that slides only its normal.
class Pushes {
 public:
  Pushes(const Problem& problem, bool rubs)
      : problem_(problem),
        rubs_(rubs),
        v_(problem.vStar),
        lambda_(problem.cones.size(), Vec3::Zero()) {
    for (std::size_t i = 0; i < v_.size(); ++i)
      if (problem.invM[i] > 0.0 || !problem.Iinv[i].isZero(0.0)) v_[i].setZero();
    for (std::size_t c = 0; c < lambda_.size(); ++c) asked_.push_back(velocity(c));
  }

  /// @return the largest change, in units of u
  double sweep() {
    double largest = 0.0;
    for (std::size_t c = 0; c < lambda_.size(); ++c) {
      double mobility = 0.0, compliance = 0.0;
      for (int k = 0; k < rows(c); ++k) {
        mobility += rowMobility(problem_, row(c, k)) - row(c, k).compliance;
        compliance += row(c, k).compliance;
      }
      if (mobility <= 0.0 || compliance > 0.0) continue;
      const Vec3 next = nearest(c, lambda_[c] - velocity(c) / mobility), by = next - lambda_[c];
      for (int k = 0; k < rows(c); ++k) push(row(c, k), by[k]);
      largest = std::max(largest, by.cwiseAbs().maxCoeff() * mobility);
      lambda_[c] = next;
    }
    return largest;
  }

  bool endless() const {
    constexpr double kBehind = 0.01;
    double asks = 0.0, gives = 0.0;
    for (std::size_t c = 0; c < lambda_.size(); ++c) {
      asks -= asked_[c].dot(lambda_[c]);
      gives += (velocity(c) - asked_[c]).dot(lambda_[c]);
    }
    return asks > 0.0 && gives < kBehind * asks;
  }
  std::vector<double> normals() const {
    std::vector<double> result;
    for (const Vec3& lambda : lambda_) result.push_back(lambda.x());
    return result;
  }

 private:
  int rows(std::size_t cone) const {
    const ConeKind kind = problem_.cones[cone].kind;
    return rubs_ && kind == ConeKind::Friction ? coneRows(kind) : 1;
  }
  const Row& row(std::size_t cone, int k) const {
    return problem_.rows[problem_.cones[cone].row + k];
  }
  /// u of the rows of a cone; 0 of those that it does not have.
  Vec3 velocity(std::size_t cone) const {
    Vec3 u = Vec3::Zero();
    for (int k = 0; k < rows(cone); ++k) u[k] = rowVelocity(row(cone, k), v_);
    return u;
  }
  Vec3 nearest(std::size_t cone, const Vec3& lambda) const {
    const Cone& of = problem_.cones[cone];
    if (of.kind == ConeKind::Equality) return lambda;
    if (rubs_ && of.kind == ConeKind::Friction) return projectOnFrictionCone(lambda, of.mu);
    return Vec3(std::max(0.0, lambda.x()), 0.0, 0.0);
  }
  void push(const Row& row, double by) {
    v_[row.a].head<3>() += by * problem_.invM[row.a] * row.linear;
    v_[row.b].head<3>() -= by * problem_.invM[row.b] * row.linear;
    v_[row.a].tail<3>() += by * (problem_.Iinv[row.a] * row.angularA);
    v_[row.b].tail<3>() += by * (problem_.Iinv[row.b] * row.angularB);
  }

  const Problem& problem_;
  bool rubs_;
  std::vector<Vec6> v_;
  std::vector<Vec3> lambda_, asked_;
};

}  // namespace

std::vector<double> endlessPush(const Problem& problem, bool rubs) {
  // Where friction is hardly more than enough, forces grow slowly.
  constexpr int kSweeps = 2000, kVisits = 400'000;  // at least; of cones, with friction
  constexpr double kSettled = 1e-4;                 // of the first change: forces that end
  const int visits = rubs ? kVisits / std::max(1, static_cast<int>(problem.cones.size())) : 0;
  Pushes pushes(problem, rubs);
  const double first = pushes.sweep();
  for (int k = 1; k < std::max(kSweeps, visits); ++k)
    if (pushes.sweep() <= kSettled * first) return {};
  return pushes.endless() ? pushes.normals() : std::vector<double>{};
}

}  // namespace tumble
