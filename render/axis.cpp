#include "render/axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

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

/// The number of fewest digits in a range on one side of 0; of several the lowest.
double roundest(double low, double high) {
  const double size = std::max(std::abs(low), std::abs(high));
  for (int power = static_cast<int>(std::floor(std::log10(size)));; --power) {
    // Multiplied or divided by a power that is whole, for the nearest number to the decimal one.
    const double unit = std::pow(10.0, std::abs(power));
    const double value = power < 0 ? std::ceil(low * unit) / unit : std::ceil(low / unit) * unit;
    if (value <= high) return value;
  }
}

/// All digits of a number > 0 of at most 15: "1234.5678", "3 × 10⁹".
std::string allDigits(double value) {
  const int power = powerOf(value, value);
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.15g", power == 0 ? value : value / std::pow(10.0, power));
  return digits + (power == 0 ? "" : " × 10" + raised(power));
}

}  // namespace

std::string raised(int power) {
  constexpr const char* kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(power)) text += c == '-' ? "⁻" : kRaised[c - '0'];
  return text;
}

int powerOf(double size, double step) {
  constexpr double kLargest = 1e7, kFinest = 0.99e-5;  // of numbers and steps: seven digits
  if (size < kLargest && step > kFinest) return 0;
  return static_cast<int>(std::floor(std::log10(size) + 1e-9));
}

std::string factorText(int power, double offset) {
  std::string text = power == 0 ? "" : "× 10" + raised(power);
  if (offset != 0.0)
    text += (text.empty() ? "" : " ") + std::string(offset < 0.0 ? "− " : "+ ") +
            allDigits(std::abs(offset));
  return text.empty() ? "" : "(" + text + ")";
}

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
  const double rounding = 1e-9 + 1e-15 * size / step_;  // of steps
  const double first = std::floor(low_ / step_ + rounding),
               last = std::ceil(high_ / step_ - rounding);
  for (double k = first; k <= last; k += 1.0) ticks_.push_back({k * step_, true});
  low_ = first * step_;
  high_ = last * step_;
  constexpr double kCommon = 1e5, kLeast = 1e-200;  // below, powers of ten overflow
  if (size >= kCommon * step_ && size > kLeast) offset_ = roundest(low_, high_);
}

bool Scale::holds(double value) const {
  constexpr double kMost = 1e300;  // steps of larger ones overflow
  return std::abs(value) <= kMost && (!logarithmic_ || value > 0.0);
}

int Scale::power() const {
  if (logarithmic_) return 0;
  return powerOf(std::max(std::abs(low_ - offset_), std::abs(high_ - offset_)), step_);
}

double Scale::told(const Tick& tick) const {
  constexpr double kParts = 1e3;  // of a step: less is rounding of what is taken off
  if (offset_ == 0.0) return tick.value;
  return std::round((tick.value - offset_) / step_ * kParts) / kParts * step_;
}

double Scale::at(double value) const {
  const double x = logarithmic_ ? std::log10(value) : value;
  return from_ + (x - low_) / (high_ - low_) * (to_ - from_);
}

}  // namespace tumble
