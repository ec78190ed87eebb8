// Axes of a chart: which numbers stand along them, and where a value lies.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace tumble {

struct ChartAxis {
  std::string caption;  ///< "error", "time / s"
  bool logarithmic = false;
  bool fromZero = false;  ///< 0 has its place on it, so that lengths are as their values
  bool broken = false;    ///< a mark at its foot says so where it begins above 0
};

/// A number along an axis; on a logarithmic one the power of ten.
struct Tick {
  double value = 0.0;
  bool labelled = true;  ///< else only a fainter line
};

/// The range of an axis, rounded outwards to ticks, and the pixels that it covers.
class Scale {
 public:
  /// @param values  what has to lie in the range; on a logarithmic axis only numbers > 0 count
  /// @param from, to  [px] of the ends; more ticks are labelled where there is more room
  /// @param room  [px] that a labelled tick needs
  Scale(const ChartAxis& axis, std::span<const double> values, double from, double to, double room);

  /// Whether the value has a place: at most 1e300, and on a logarithmic axis > 0.
  bool holds(double value) const;
  /// [px]
  double at(double value) const;
  const std::vector<Tick>& ticks() const { return ticks_; }
  /// Difference of labelled ticks, to know how many digits they need; 1 on a logarithmic axis.
  double step() const { return step_; }
  /// Power of ten that the axis' numbers are told in: 0 unless they would take too many digits.
  int power() const;
  bool logarithmic() const { return logarithmic_; }
  bool aboveZero() const { return !logarithmic_ && low_ > 0.0; }

 private:
  bool logarithmic_;
  double low_ = 0.0, high_ = 1.0;  // of the value, or of its logarithm
  double from_, to_, step_ = 1.0;
  std::vector<Tick> ticks_;
};

}  // namespace tumble
