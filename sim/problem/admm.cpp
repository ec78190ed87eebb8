// Chapter 6, problem: the alternating direction method of multipliers.
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/problem/anderson.h"
#include "sim/problem/cone.h"
#include "sim/problem/newton_system.h"
#include "sim/problem/solvers.h"

namespace tumble {
namespace {

constexpr double kTau = 0.01;   ///< ρ, by the weight of the system
constexpr double kRelax = 1.6;  ///< how far past u the next y lies
constexpr int kAsk = 10;        ///< iterations from one look at the residual to the next

/// The iteration of y = λ − ρ z, three numbers a cone.
class Splitting {
 public:
  SolveReport solve(const Problem& problem, const SolveSettings& settings, Solution& solution);

 private:
  using Point = NewtonSystem<6>::Point;

  void begin(const Problem& problem, const Solution& start);
  void iterate();
  double ask(const Problem& problem, Solution& solution);
  Vec3 forceAt(std::size_t cone) const;

  NewtonSystem<6> system_;
  VecX y_, next_;
  std::vector<Vec3> force_, z_;     ///< per cone: λ, and its velocity in the dual cone
  std::vector<double> compliance_;  ///< per cone
  Anderson mixer_;
};

/// Π_K(y), or what a compliant row takes of it.
Vec3 Splitting::forceAt(std::size_t cone) const {
  const Point& point = system_.points[cone];
  const Vec3 y = y_.segment<3>(3 * static_cast<Eigen::Index>(cone));
  switch (point.kind) {
    case ConeKind::Equality:
      return {y[0] / (1.0 + system_.rho * compliance_[cone]), 0.0, 0.0};
    case ConeKind::Push:
    case ConeKind::Slide:
      return {std::max(y[0], 0.0), 0.0, 0.0};
    case ConeKind::Friction:
      break;
  }
  return projectOnFrictionCone(y, point.mu);
}

/// From the λ of `start` and the velocities that it gives.
void Splitting::begin(const Problem& problem, const Solution& start) {
  system_.prepare(problem);
  system_.take(problem, start);
  system_.rho = kTau * system_.weight;
  const auto n = static_cast<Eigen::Index>(system_.points.size());
  y_.resize(3 * n);
  compliance_.resize(n);
  force_.resize(n);
  z_.resize(n);
  VecX weight(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    Point& point = system_.points[i];
    compliance_[i] = point.compliance;
    point.compliance = 0.0;  // it is in the forces, not in the factor
    Vec3 u = point.u;
    if (point.kind == ConeKind::Friction) u[0] += point.mu * std::hypot(u[1], u[2]);
    Vec3 y = point.force - system_.rho * u;
    y.tail(3 - point.rows).setZero();
    y_.segment<3>(3 * i) = y;
    weight.segment<3>(3 * i).setConstant(point.mobility > 0.0 ? point.mobility : 1.0);
  }
  next_ = y_;
  mixer_.reset(weight);
  system_.factorUncut();
}

/// Splits y into a force and a velocity of the dual cone, goes where the forces would bring that
/// velocity about, and puts what comes of it into next_.
void Splitting::iterate() {
  const double rho = system_.rho;
  for (std::size_t i = 0; i < system_.points.size(); ++i) {
    Point& point = system_.points[i];
    const Vec3 y = y_.segment<3>(3 * i), force = forceAt(i);
    Vec3 z = (force - y) / rho;
    z.tail(3 - point.rows).setZero();
    point.saxce = point.kind == ConeKind::Friction ? point.mu * std::hypot(z[1], z[2]) : 0.0;
    force_[i] = force;
    z_[i] = z;
    point.lambda = force + rho * z;
    if (point.kind == ConeKind::Slide) point.lambda[1] = -point.mu * force[0];
  }
  system_.goUncut();
  for (std::size_t i = 0; i < system_.points.size(); ++i) {
    const Point& point = system_.points[i];
    Vec3 u = point.u;
    u[0] += point.saxce;
    Vec3 next = force_[i] - rho * (kRelax * u + (1.0 - kRelax) * z_[i]);
    next.tail(3 - point.rows).setZero();
    next_.segment<3>(3 * i) = next;
  }
  mixer_.next(y_, next_);
}

/// The answer that y is, with the velocities that its λ gives. @return its residual
double Splitting::ask(const Problem& problem, Solution& solution) {
  for (std::size_t i = 0; i < system_.points.size(); ++i) {
    Point& point = system_.points[i];
    point.force = forceAt(i);
    if (point.kind == ConeKind::Slide) point.force[1] = -point.mu * point.force[0];
  }
  system_.write(problem, solution);
  velocitiesFromLambda(problem, solution.lambda, solution.v);
  return naturalResidual(problem, solution, system_.scale);
}

SolveReport Splitting::solve(const Problem& problem, const SolveSettings& settings,
                             Solution& solution) {
  if (solution.lambda.size() != problem.rows.size())
    solution.lambda.assign(problem.rows.size(), 0.0);
  solution.v.resize(problem.vStar.size());
  velocitiesFromLambda(problem, solution.lambda, solution.v);
  SolveReport report{.scale = velocityScale(problem)};
  report.residual = naturalResidual(problem, solution, report.scale);
  if (report.residual <= settings.tolerance) return report;
  begin(problem, solution);
  Solution now;
  while (report.iterations < settings.maxIterations) {
    iterate();
    ++report.iterations;
    if (report.iterations % kAsk != 0 && report.iterations < settings.maxIterations) continue;
    const double residual = ask(problem, now);
    if (!std::isfinite(residual)) break;
    if (residual < report.residual) {
      report.residual = residual;
      std::swap(solution, now);
    }
    if (report.residual <= settings.tolerance || atRounding(problem, solution, report.residual))
      return report;
  }
  report.status = SolveStatus::NotConverged;
  return report;
}

}  // namespace

SolveReport solveAdmm(const Problem& problem, const SolveSettings& settings, Solution& solution) {
  thread_local Splitting splitting;  // keeps its memory from call to call
  return splitting.solve(problem, settings, solution);
}

}  // namespace tumble
