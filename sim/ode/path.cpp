#include "sim/ode/path.h"

#include <algorithm>

namespace tumble {

void Path::begin(double t0, double first, std::span<const double> y) {
  t0_ = t0;
  size_ = first;
  attempts_ = Extrapolation::kMostAttempts;
  ends_.assign(1, 0.0);
  values_.assign(y.begin(), y.end());
}

bool Path::grow(const System& system, Extrapolation& integrator, double most) {
  const std::size_t n = values_.size() / ends_.size();
  const double from = ends_.back();
  values_.resize(values_.size() + n);
  const auto last = values_.end() - static_cast<std::ptrdiff_t>(n);
  std::copy(last - static_cast<std::ptrdiff_t>(n), last, last);
  const std::span<double> y(last, n);
  const double way = integrator.stride(system, t0_ + from, most - from, size_, attempts_, y);
  if (way == 0.0) {
    values_.resize(values_.size() - n);
    return false;
  }
  system.normalise(y);
  ends_.push_back(way == most - from ? most : from + way);
  return true;
}

void Path::cut(double s, double size) {
  const std::size_t n = values_.size() / ends_.size();
  while (ends_.size() > 1 && ends_.back() > s) ends_.pop_back();
  values_.resize(n * ends_.size());
  size_ = size;
}

void Path::at(const System& system, Extrapolation& integrator, double s,
              std::span<double> y) const {
  const std::size_t n = values_.size() / ends_.size();
  std::size_t k = ends_.size() - 1;
  while (k > 0 && ends_[k] > s) --k;
  const auto from = values_.begin() + static_cast<std::ptrdiff_t>(k * n);
  std::copy(from, from + static_cast<std::ptrdiff_t>(n), y.begin());
  if (s > ends_[k]) integrator.step(system, t0_ + ends_[k], s - ends_[k], y);
}

}  // namespace tumble
