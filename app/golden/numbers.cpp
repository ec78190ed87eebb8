#include "app/golden/numbers.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

namespace tumble {

namespace {

constexpr double kRelative = 1e-9, kAbsolute = 1e-12;
constexpr double kHopeless = std::numeric_limits<double>::infinity();

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

std::optional<double> finiteNumber(const std::string& text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || !std::isfinite(value)) return {};
  return value;
}

// Deviation over what is allowed.
double deviation(const std::string& expected, const std::string& actual) {
  if (expected == actual) return 0.0;
  const std::optional<double> e = finiteNumber(expected), a = finiteNumber(actual);
  if (!e || !a) return kHopeless;
  return std::abs(*a - *e) / (kAbsolute + kRelative * std::abs(*e));
}

void note(NumberDifference& difference, double worst, const std::string& where,
          std::size_t line = 0, std::size_t column = 0) {
  if (!difference.where.empty() && worst <= difference.worst) return;
  difference.worst = worst;
  difference.where = where;
  difference.line = line;
  difference.column = column;
}

// What a row is of: " (t = 0.2, body = ball)", or "".
std::string rowOf(const std::vector<std::string>& names, const std::vector<std::string>& fields) {
  std::string keys;
  for (std::size_t i = 0; i < std::min(names.size(), fields.size()); ++i)
    if (names[i] == "t" || names[i] == "body" || names[i] == "curve")
      keys += fmt::format("{}{} = {}", keys.empty() ? " (" : ", ", names[i], fields[i]);
  return keys.empty() ? "" : keys + ")";
}

void compareLine(NumberDifference& difference, std::size_t line,
                 const std::vector<std::string>& names, const std::string& expected,
                 const std::string& actual) {
  const std::vector<std::string> e = split(expected, ','), a = split(actual, ',');
  if (e.size() != a.size()) {
    note(difference, kHopeless,
         fmt::format("line {}: {} fields, expected {}", line, a.size(), e.size()));
    return;
  }
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double worst = deviation(e[i], a[i]);
    if (worst == 0.0) continue;
    const std::string name = i < names.size() ? names[i] : std::to_string(i + 1);
    note(difference, worst,
         fmt::format("line {}{}, {}: {}, expected {}", line, rowOf(names, e), name, a[i], e[i]),
         line, i + 1);
  }
}

}  // namespace

NumberDifference compareNumbers(const std::string& expected, const std::string& actual) {
  NumberDifference difference;
  difference.exact = expected == actual;
  if (difference.exact) return difference;
  const std::vector<std::string> e = split(expected, '\n'), a = split(actual, '\n');
  if (e.size() != a.size() || e.empty() || e[0] != a[0]) {
    note(difference, kHopeless,
         e.size() != a.size() ? fmt::format("{} lines, expected {}", a.size(), e.size())
                              : "the header differs");
    return difference;
  }
  const std::vector<std::string> names = split(e[0], ',');
  for (std::size_t line = 1; line < e.size(); ++line)
    compareLine(difference, line + 1, names, e[line], a[line]);
  return difference;
}

Column columnOf(const std::string& csv, std::size_t line, std::size_t column) {
  Column curve;
  const std::vector<std::string> lines = split(csv, '\n');
  if (line < 2 || line > lines.size()) return curve;
  const std::vector<std::string> names = split(lines[0], ','), worst = split(lines[line - 1], ',');
  const bool bodies = names.size() > 1 && worst.size() > 1 && names[1] == "body";
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const std::vector<std::string> fields = split(lines[k], ',');
    if (fields.size() < column || (bodies && fields[1] != worst[1])) continue;
    const std::optional<double> x = finiteNumber(fields[0]), y = finiteNumber(fields[column - 1]);
    if (!x || !y) continue;
    curve.x.push_back(*x);
    curve.y.push_back(*y);
  }
  return curve;
}

}  // namespace tumble
