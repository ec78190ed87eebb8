// Numbers on pictures.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace tumble {

/// Four significant digits, zeros at the end too, with a minus as printers have it: "9.810",
/// "98.10", "−1177", "25180".
inline std::string fourDigits(double value) {
  std::string text = fmt::format("{:#.4g}", std::abs(value));
  if (const double rounded = std::stod(text); rounded >= 1e4 && rounded < 1e7)
    text = fmt::format("{:.0f}", rounded);
  if (text.size() > 5 && text.ends_with(".0")) text.resize(text.size() - 2);
  return (value < 0.0 ? "−" : "") + text;
}

}  // namespace tumble
