#include "sim/ode/extrapolation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tumble {
namespace {

/// Part of the tolerance that is rounding alone: more substeps would bring nothing.
constexpr double kEnough = 1e-2;

/// Of t: shorter steps are rounding.
constexpr double kLeast = 16.0 * std::numeric_limits<double>::epsilon();

/// Factor for the next attempt: about the ninth root of 1/error, from square roots alone, so that
/// every machine gives the same bits.
double factor(double error) {
  if (!(error < 1e12)) return 0.1;
  const double root = std::sqrt(std::sqrt(std::sqrt(std::max(error, 1e-5))));
  return std::clamp(0.8 / root, 0.1, 3.0);
}

}  // namespace

Extrapolation::Extrapolation(int size, double tolerance)
    : size_(static_cast<std::size_t>(size)), tolerance_(tolerance) {
  for (Numbers* numbers : {&now_, &rate_, &first_, &last_, &stage_, &slope_})
    numbers->resize(size_);
  for (Numbers& column : table_) column.resize(size_);
}

double Extrapolation::step(const System& system, double t, double h, std::span<double> y) {
  double done = 0.0, size = h;
  for (int attempts = kMostAttempts; done != h;) {
    const double way = stride(system, t + done, h - done, size, attempts, y);
    if (way == 0.0) break;
    done = way == h - done ? h : done + way;
  }
  system.normalise(y);
  return done;
}

double Extrapolation::stride(const System& system, double t, double most, double& size,
                             int& attempts, std::span<double> y) {
  std::copy(y.begin(), y.end(), now_.begin());
  system.derivative(t, now_, rate_);
  const double least = kLeast * std::max(std::abs(t), std::abs(t + most));
  while (attempts-- > 0) {
    const double way = 1.01 * std::abs(size) >= std::abs(most) ? most : size;
    if (!(std::abs(way) > least)) break;
    const double error = attempt(system, t, way);
    if (!(error <= 1.0)) {
      size = way * std::min(0.7, factor(error));
      continue;
    }
    for (std::size_t i = 0; i < size_; ++i) y[i] = now_[i] + table_[column_][i];
    size = (std::abs(way) > std::abs(size) ? way : size) * factor(error);
    return way;
  }
  return 0.0;
}

void Extrapolation::midpoint(const System& system, double t, double h, int n, Numbers& increment) {
  const double part = h / n;
  std::fill(first_.begin(), first_.end(), 0.0);
  for (std::size_t i = 0; i < size_; ++i) last_[i] = part * rate_[i];
  for (int m = 1; m < n; ++m) {
    for (std::size_t i = 0; i < size_; ++i) stage_[i] = now_[i] + last_[i];
    system.derivative(t + m * part, stage_, slope_);
    for (std::size_t i = 0; i < size_; ++i) first_[i] += 2.0 * part * slope_[i];
    std::swap(first_, last_);
  }
  increment = last_;
}

double Extrapolation::attempt(const System& system, double t, double h) {
  double error = 0.0;
  for (column_ = 0;; ++column_) {
    midpoint(system, t, h, 2 * (column_ + 1), stage_);
    error = extend();
    const bool last = column_ + 1 == kColumns;
    if (last || !std::isfinite(error) || (column_ > 0 && error <= kEnough)) return error;
  }
}

double Extrapolation::extend() {
  // The new row of the tableau takes the place of the one before, from its end to its start.
  double worst = 0.0;
  for (std::size_t i = 0; i < size_; ++i) {
    double value = stage_[i], before = 0.0;
    for (int k = 0; k < column_; ++k) {
      const double ratio = static_cast<double>(column_ + 1) / (column_ - k);
      before = value;
      const double next = value + (value - table_[k][i]) / (ratio * ratio - 1.0);
      table_[k][i] = value;
      value = next;
    }
    table_[column_][i] = value;
    const double allowed = tolerance_ * (1.0 + std::abs(now_[i]) + std::abs(value));
    const double relative = std::abs(value - before) / allowed;
    if (!std::isfinite(relative)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, relative);
  }
  return worst;
}

}  // namespace tumble
