#include "sim/problem/sweep.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/problem/cone.h"
#include "sim/problem/friction_block.h"

namespace tumble {
namespace {

/// L with A = L Lᵀ for a positive semidefinite A; a direction that A does not know gets 0.
Mat3 rootOf(const Mat3& A) {
  constexpr double kFlat = 1e-15;  // of the trace
  const double floor = kFlat * A.trace();
  Mat3 L = Mat3::Zero();
  for (int j = 0; j < 3; ++j) {
    double pivot = A(j, j);
    for (int k = 0; k < j; ++k) pivot -= L(j, k) * L(j, k);
    if (!(pivot > floor)) continue;
    L(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < 3; ++i) {
      double sum = A(i, j);
      for (int k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      L(i, j) = sum / L(j, j);
    }
  }
  return L;
}

bool moves(const Problem& problem, int body) {
  return problem.invM[body] > 0.0 || !problem.Iinv[body].isZero(0.0);
}

}  // namespace

void ConeSweeps::prepare(const Problem& problem) {
  roots_.resize(problem.invM.size());
  for (std::size_t i = 0; i < roots_.size(); ++i) roots_[i] = rootOf(problem.Iinv[i]);
  y_.resize(problem.invM.size());
  mobility_.setOnes(static_cast<Eigen::Index>(problem.rows.size()));
  cones_.resize(problem.cones.size());
  for (std::size_t k = 0; k < cones_.size(); ++k) layOut(problem, problem.cones[k], cones_[k]);
  findRuns(problem);
  pair(problem);
}

[[gnu::flatten]] void ConeSweeps::layOut(const Problem& problem, const Cone& from,
                                         SweptCone& cone) {
  cone.kind = from.kind;
  cone.mu = from.mu;
  cone.row = from.row;
  const int a = problem.rows[from.row].a, b = problem.rows[from.row].b;
  cone.K.setZero();
  cone.c.setZero();
  const double root = std::sqrt(problem.invM[a] + problem.invM[b]);
  for (int i = 0; i < coneRows(from.kind); ++i) {
    const Row& row = problem.rows[from.row + i];
    cone.K.col(i).head<3>() = root * row.linear;
    cone.K.col(i).segment<3>(3) = roots_[a].transpose().lazyProduct(row.angularA);
    cone.K.col(i).segment<3>(6) = roots_[b].transpose().lazyProduct(row.angularB);
    cone.c[i] = rowSpeed(row, problem.vStar[a], problem.vStar[b]) + row.bias;
  }
  cone.W = cone.K.transpose().lazyProduct(cone.K);
  cone.compliance = problem.rows[from.row].compliance;
  cone.W(0, 0) += cone.compliance;
  cone.mobility = cone.W.diagonal().maxCoeff();
  if (cone.kind == ConeKind::Friction) cone.hold = inverseOfBlock(cone.W);
  for (int i = 0; i < coneRows(from.kind); ++i)
    if (cone.W(i, i) > 0.0) mobility_[from.row + i] = cone.W(i, i);
}

/// Runs of the cones that move something. Each is deeper than all before it that move a body of its
/// own, so that those of one depth may go in any order, and depth after depth gives what cone after
/// cone gives.
void ConeSweeps::findRuns(const Problem& problem) {
  runs_.clear();
  depth_.assign(problem.invM.size(), 0);
  int last = -1;  // cone of the last run
  for (int k = 0; k < static_cast<int>(cones_.size()); ++k) {
    if (cones_[k].mobility <= 0.0) continue;
    const int a = problem.rows[cones_[k].row].a, b = problem.rows[cones_[k].row].b;
    const bool friction = cones_[k].kind == ConeKind::Friction;
    if (last + 1 == k && last >= 0 && runs_.back().a == a && runs_.back().b == b) {
      ++runs_.back().count;
      runs_.back().friction &= friction;
    } else {
      int depth = 0;
      for (int body : {a, b})
        if (moves(problem, body)) depth = std::max(depth, depth_[body] + 1);
      for (int body : {a, b})
        if (moves(problem, body)) depth_[body] = depth;
      runs_.push_back({a, b, k, 1, depth, friction});
    }
    last = k;
  }
  std::sort(runs_.begin(), runs_.end(), [](const Run& i, const Run& j) {
    return std::tuple(i.depth, i.friction, i.count, i.first) <
           std::tuple(j.depth, j.friction, j.count, j.first);
  });
}

/// Runs depth after depth, two side by side where two of contacts with friction are equally long.
void ConeSweeps::pair(const Problem& problem) {
  const auto put = [&](const Run& run, int lane, TwinBodies& bodies) {
    const double a = problem.invM[run.a], b = problem.invM[run.b];
    bodies.a[lane] = &y_[run.a];
    bodies.b[lane] = &y_[run.b];
    bodies.shareA[lane] = a > 0.0 ? std::sqrt(a / (a + b)) : 0.0;
    bodies.shareB[lane] = b > 0.0 ? std::sqrt(b / (a + b)) : 0.0;
  };
  places_.clear();
  twins_.clear();
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const Run& one = runs_[i];
    Place place{false, one.first, one.count, {}};
    put(one, 0, place.bodies);
    if (one.friction && i + 1 < runs_.size() && runs_[i + 1].friction &&
        runs_[i + 1].depth == one.depth && runs_[i + 1].count == one.count) {
      const Run& other = runs_[++i];
      put(other, 1, place.bodies);
      place.twins = true;
      place.first = static_cast<int>(twins_.size());
      for (int k = 0; k < one.count; ++k) {
        TwinCone& cone = twins_.emplace_back();
        cone.set(0, cones_[one.first + k]);
        cone.set(1, cones_[other.first + k]);
      }
    }
    places_.push_back(place);
  }
}

void ConeSweeps::take(const VecX& lambda) {
  for (Vec6& y : y_) y.setZero();
  for (const Place& place : places_) {
    if (place.twins)
      takeTwins(std::span(twins_).subspan(place.first, place.count), lambda.data(), place.bodies);
    else
      takeCones(std::span(cones_).subspan(place.first, place.count), lambda.data(), place.bodies);
  }
}

double ConeSweeps::pass(bool forwards, VecX& lambda) {
  double largest = 0.0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[forwards ? i : places_.size() - 1 - i];
    const double change = place.twins
                              ? sweepTwins(std::span(twins_).subspan(place.first, place.count),
                                           forwards, lambda.data(), place.bodies)
                              : sweepCones(std::span(cones_).subspan(place.first, place.count),
                                           forwards, lambda.data(), place.bodies);
    largest = std::max(largest, change);
  }
  return largest;
}

}  // namespace tumble
