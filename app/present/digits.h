// Numbers on pictures.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "render/axis.h"

namespace tumble {

/// "2.5 × 10⁻¹¹" of "2.5e-11", "10⁻⁹" of "1e-9"; others as they are.
inline std::string withPower(const std::string& text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  const std::string leading = text.substr(0, e);
  return (leading == "1" ? "" : leading + " × ") + "10" + raised(std::stoi(text.substr(e + 1)));
}

/// Four significant digits, zeros at the end too, with a minus as printers have it: "9.810",
/// "98.10", "−1177", "25180", "2.452 × 10⁹".
inline std::string fourDigits(double value) {
  std::string text = fmt::format("{:#.4g}", std::abs(value));
  if (const double rounded = std::stod(text); rounded >= 1e4 && rounded < 1e7)
    text = fmt::format("{:.0f}", rounded);
  if (text.size() > 5 && text.ends_with(".0")) text.resize(text.size() - 2);
  return (value < 0.0 ? "−" : "") + withPower(text);
}

/// An instant of a run: hundredths of a second, or the second digit of how long the run is, if that
/// is finer, and `more` digits: "0.50", "0.00120".
/// @param duration  [s] of the run, > 0
inline std::string instant(double t, double duration, int more = 0) {
  const int second = 1 - static_cast<int>(std::floor(std::log10(duration)));
  return fmt::format("{:.{}f}", t, std::max(2, second) + more);
}

/// So many significant digits at most, as they are printed: "0.00598", "−2.5 × 10⁻¹¹", "10⁻⁹".
inline std::string printed(double value, int digits) {
  return (value < 0.0 ? "−" : "") + withPower(fmt::format("{:.{}g}", std::abs(value), digits));
}

}  // namespace tumble
