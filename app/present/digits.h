// Numbers on pictures.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace tumble {

/// Four significant digits, zeros at the end too, with a minus as printers have it: "9.810",
/// "98.10", "−1177".
inline std::string fourDigits(double value) {
  std::string text = fmt::format("{:#.4g}", std::abs(value));
  if (text.size() > 5 && text.ends_with(".0")) text.resize(text.size() - 2);
  return (value < 0.0 ? "−" : "") + text;
}

}  // namespace tumble
