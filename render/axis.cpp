#include "render/axis.h"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

/// The smallest of 1, 2, 5 times a power of ten that is not below x.
double niceStep(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= x * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

/// What an axis shows above values that are all alike: 1, or as much again where 1 is nothing
/// beside them or they are nothing beside 1.
double roomOf(double size) {
  return size == 0.0 || (size > 1e-6 && size < 1e6) ? 1.0 : size;
}

}  // namespace

Scale::Scale(const ChartAxis& axis, std::span<const double> values, double from, double to,
             double room)
    : logarithmic_(axis.logarithmic), from_(from), to_(to) {
  // What has to lie in the range.
  bool any = false;
  for (const double value : values) {
    if (!holds(value)) continue;
    const double x = logarithmic_ ? std::log10(value) : value;
    low_ = any ? std::min(low_, x) : x;
    high_ = any ? std::max(high_, x) : x;
    any = true;
  }
  if (!any) high_ = low_ + 1.0;
  if (axis.fromZero && !logarithmic_) {
    low_ = std::min(low_, 0.0);
    high_ = std::max(high_, 0.0);
  }

  // Whole decades, or a step of 1, 2 or 5; as many labels as find room.
  const double most = std::max(1.0, std::floor(std::abs(to - from) / room));
  if (logarithmic_) {
    low_ = std::floor(low_ + 1e-9);
    high_ = std::max(std::ceil(high_ - 1e-9), low_ + 1.0);
    const double every = std::ceil((high_ - low_) / most);
    for (double power = low_; power <= high_; power += 1.0)
      ticks_.push_back({power, std::fmod(power - low_, every) == 0.0});
    return;
  }
  const double size = std::max(std::abs(low_), std::abs(high_));
  if (high_ - low_ <= 1e-12 * size) high_ = low_ + roomOf(size);
  step_ = niceStep((high_ - low_) / most);
  const double first = std::floor(low_ / step_ + 1e-9), last = std::ceil(high_ / step_ - 1e-9);
  for (double k = first; k <= last; k += 1.0) ticks_.push_back({k * step_, true});
  low_ = first * step_;
  high_ = last * step_;
}

bool Scale::holds(double value) const {
  constexpr double kMost = 1e300;  // steps of larger ones overflow
  return std::abs(value) <= kMost && (!logarithmic_ || value > 0.0);
}

int Scale::power() const {
  constexpr double kLargest = 1e7, kFinest = 0.99e-5;  // of numbers and steps: seven digits
  const double size = std::max(std::abs(low_), std::abs(high_));
  if (logarithmic_ || (size < kLargest && step_ > kFinest)) return 0;
  return static_cast<int>(std::floor(std::log10(size)));
}

double Scale::at(double value) const {
  const double x = logarithmic_ ? std::log10(value) : value;
  return from_ + (x - low_) / (high_ - low_) * (to_ - from_);
}

}  // namespace tumble
