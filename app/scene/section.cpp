#include "app/scene/section.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tumble {

namespace {

// Squares and inverses of what lies within are finite.
constexpr double kHuge = 1e30, kTiny = 1e-30;

// "a number [m] > 0", "a number in [0, 1]"
std::string expectation(const Range& range) {
  std::string text = "a number";
  if (!range.unit.empty()) text += fmt::format(" [{}]", range.unit);
  if (range.lo > -kHuge && range.hi < kHuge)
    return text + fmt::format(" in {}{:g}, {:g}]", range.above ? "(" : "[", range.lo, range.hi);
  if (range.lo > -kHuge) return text + fmt::format(" {} {:g}", range.above ? ">" : ">=", range.lo);
  return text;
}

bool contains(const Range& range, double x) {
  if (!std::isfinite(x) || x > range.hi) return false;
  return range.above ? x >= range.lo + kTiny : x >= range.lo;
}

}  // namespace

bool readNumber(const Node& node, const std::string& key, const Range& range, Findings& findings,
                double& out) {
  double x = 0.0;
  if (node.number(x) && contains(range, x)) {
    out = x;
    return true;
  }
  const bool extreme = std::isfinite(x) && (std::abs(x) > kHuge || (x > 0.0 && x < kTiny));
  findings.complain(node.spot, key,
                    fmt::format("expected {}, found {}{}", expectation(range), describe(node),
                                extreme ? ", which is beyond 1e-30 to 1e30" : ""));
  return false;
}

bool readText(const Node& node, const std::string& key, Findings& findings, std::string& out) {
  if (const std::string* text = node.as<std::string>()) {
    out = *text;
    findings.noteWording(node.spot, key, *text);
    return true;
  }
  findings.complain(node.spot, key, "expected a string in quotes, found " + describe(node));
  return false;
}

Section::Section(const Node& node, std::string key, Findings& findings,
                 std::optional<std::string> where)
    : node_(node),
      table_(node.as<Table>()),
      key_(std::move(key)),
      where_(std::move(where)),
      findings_(findings),
      complaintsBefore_(findings.count()) {
  if (!table_) findings_.complain(node.spot, key_, "expected a table, found " + describe(node));
  if (where_ && !where_->empty()) findings_.note(*where_, node.spot);
}

const Node* Section::find(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.push_back(key);
  const Entry* entry = table_ ? table_->find(key) : nullptr;
  return entry ? &entry->node : nullptr;
}

void Section::read(std::string_view key, double& out, const Range& range) {
  if (const Node* node = find(key)) readNumber(*node, path(key), range, findings_, out);
}

void Section::read(std::string_view key, double* out, std::size_t count, const Range& range) {
  const Node* node = find(key);
  if (!node) return;
  const Array* array = node->as<Array>();
  if (!array || array->size() != count) {
    findings_.complain(
        node->spot, path(key),
        fmt::format("expected a list of {} numbers{}, found {}", count,
                    range.unit.empty() ? "" : fmt::format(" [{}]", range.unit), describe(*node)));
    return;
  }
  std::vector<double> values(count);
  bool right = true;
  for (std::size_t i = 0; i < count; ++i)
    right &= readNumber((*array)[i], path(key), range, findings_, values[i]);
  if (right) std::copy(values.begin(), values.end(), out);
}

void Section::read(std::string_view key, Vec3& out, const Range& range) {
  read(key, out.data(), 3, range);
}

void Section::read(std::string_view key, std::vector<Vec3>& out, const Range& range) {
  const Node* node = find(key);
  if (!node) return;
  const Array* list = node->as<Array>();
  if (!list)
    return complain(key, "expected a list of points like [[x, y, z], …], found " + describe(*node));
  std::vector<Vec3> points;
  for (const Node& element : *list) {
    const Array* numbers = element.as<Array>();
    if (!numbers || numbers->size() != 3) {
      findings_.complain(element.spot, path(key),
                         "expected a point [x, y, z], found " + describe(element));
      continue;
    }
    Vec3 point;
    bool right = true;
    for (int k = 0; k < 3; ++k)
      right &= readNumber((*numbers)[static_cast<std::size_t>(k)], path(key), range, findings_,
                          point[k]);
    if (right) points.push_back(point);
  }
  if (points.size() == list->size()) out = std::move(points);
}

void Section::read(std::string_view key, bool& out) {
  const Node* node = find(key);
  if (!node) return;
  if (const bool* value = node->as<bool>())
    out = *value;
  else
    complain(key, "expected true or false, found " + describe(*node));
}

void Section::read(std::string_view key, int& out, int lo, int hi) {
  const Node* node = find(key);
  if (!node) return;
  const std::int64_t* value = node->as<std::int64_t>();
  if (value && *value >= lo && *value <= hi)
    out = static_cast<int>(*value);
  else
    complain(key, fmt::format("expected a whole number from {} to {}, found {}", lo, hi,
                              describe(*node)));
}

void Section::read(std::string_view key, std::string& out) {
  if (const Node* node = find(key)) readText(*node, path(key), findings_, out);
}

void Section::read(std::string_view key, std::string& out,
                   const std::vector<std::string>& choices) {
  const Node* node = find(key);
  std::string word;
  if (!node || !readText(*node, path(key), findings_, word)) return;
  if (std::find(choices.begin(), choices.end(), word) != choices.end())
    out = word;
  else
    complain(key, "unknown value " + inQuotes(word) + hint(word, choices));
}

void Section::read(std::string_view key, std::vector<std::string>& out) {
  const Node* node = find(key);
  if (!node) return;
  const Array* list = node->as<Array>();
  if (!list) return complain(key, "expected a list of strings, found " + describe(*node));
  for (const Node& element : *list) {
    std::string text;
    if (readText(element, path(key), findings_, text)) out.push_back(std::move(text));
  }
}

const Array& Section::tables(std::string_view key) {
  static const Array none;
  const Node* node = find(key);
  if (!node) return none;
  if (const Array* array = node->as<Array>()) return *array;
  complain(key, fmt::format("expected an array of tables, [[{}]], found {}", key, describe(*node)));
  return none;
}

void Section::finish(const Elsewhere& elsewhere) {
  if (!table_) return;
  const std::vector<std::string> known(asked_.begin(), asked_.end());
  for (const Entry& entry : table_->entries) {
    const auto other = elsewhere.find(entry.key);
    if (std::find(asked_.begin(), asked_.end(), entry.key) == asked_.end())
      findings_.complain(entry.spot, path(plain(entry.key)),
                         "unknown key" + (other == elsewhere.end() ? hint(entry.key, known)
                                                                   : " here; " + other->second));
    else if (where_)
      findings_.note((where_->empty() ? "" : *where_ + ".") + entry.key, entry.node.spot);
  }
}

void Section::complain(std::string_view key, const std::string& what) {
  const Entry* entry = table_ ? table_->find(key) : nullptr;
  findings_.complain(entry ? entry->node.spot : node_.spot, path(key), what);
}

std::string Section::path(std::string_view key) const {
  return (key_.empty() ? "" : key_ + ".") + std::string(key);
}

}  // namespace tumble
