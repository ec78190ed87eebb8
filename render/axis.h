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

/// Power of ten that numbers of such a size and difference are told in; 0 if seven digits hold
/// them.
int powerOf(double size, double step);

/// A whole number as an exponent: "⁻⁶".
std::string raised(int power);

/// How a number comes of what stands along an axis: "(× 10⁻⁶ + 1234.5)"; "" if it stands there.
std::string factorText(int power, double offset);

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
  /// What the axis' numbers are told from: 0, or where six digits or more are common to all of them
  /// a number within the range, of as few digits as there is one.
  double offset() const { return offset_; }
  /// Power of ten that what is left of the numbers is told in: 0 unless they would take too many
  /// digits.
  int power() const;
  /// What stands at a tick of a linear axis, but for the power of ten.
  double told(const Tick& tick) const;
  bool logarithmic() const { return logarithmic_; }
  bool aboveZero() const { return !logarithmic_ && low_ > 0.0; }

 private:
  bool logarithmic_;
  double low_ = 0.0, high_ = 1.0;  // of the value, or of its logarithm
  double from_, to_, step_ = 1.0, offset_ = 0.0;
  std::vector<Tick> ticks_;
};

}  // namespace tumble
