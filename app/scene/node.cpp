#include "app/scene/node.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace tumble {

namespace {

constexpr std::size_t kLongestQuote = 60;

// The shortest digits that read back as the same double.
std::string shortest(double x) {
  if (std::isnan(x)) return "nan";
  if (std::isinf(x)) return x > 0.0 ? "inf" : "-inf";
  char digits[32];
  const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, x);
  return std::string(digits, end.ptr);
}

bool isWord(const std::string& text) {
  const auto isLetter = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(), isLetter) && text != "true" && text != "false" &&
         text != "inf" && text != "nan";
}

// A TOML basic string: quotes, backslashes and control characters escaped.
std::string escaped(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const unsigned char code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (code < 0x20 || code == 0x7f) {
      constexpr char hex[] = "0123456789abcdef";
      out += std::string("\\u00") + hex[code >> 4] + hex[code & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

struct Writer {
  std::string operator()(Moment) const { return "1970-01-01"; }
  std::string operator()(bool b) const { return b ? "true" : "false"; }
  std::string operator()(std::int64_t i) const { return std::to_string(i); }
  std::string operator()(double x) const { return shortest(x); }
  std::string operator()(const std::string& text) const {
    return isWord(text) ? text : escaped(text);
  }
  std::string operator()(const Array& array) const {
    std::string out;
    for (const Node& node : array) out += (out.empty() ? "" : ", ") + inner(node);
    return "[" + out + "]";
  }
  std::string operator()(const Table& table) const {
    std::string out;
    for (const Entry& entry : table.entries)
      out += (out.empty() ? "" : ", ") + escaped(entry.key) + " = " + inner(entry.node);
    return "{" + out + "}";
  }
  // Inside a bracket every string needs its quotes.
  std::string inner(const Node& node) const {
    const std::string* text = node.as<std::string>();
    return text ? escaped(*text) : std::visit(*this, node.value);
  }
};

bool isBefore(const Entry& entry, std::string_view key) {
  return entry.key.compare(key) < 0;
}

}  // namespace

const Entry* Table::find(std::string_view key) const {
  const auto it = std::lower_bound(entries.begin(), entries.end(), key, isBefore);
  return it != entries.end() && it->key == key ? &*it : nullptr;
}

Entry* Table::find(std::string_view key) {
  const auto it = std::lower_bound(entries.begin(), entries.end(), key, isBefore);
  return it != entries.end() && it->key == key ? &*it : nullptr;
}

Entry& Table::at(std::string_view key, Spot spot) {
  const auto it = std::lower_bound(entries.begin(), entries.end(), key, isBefore);
  if (it != entries.end() && it->key == key) return *it;
  return *entries.insert(it, Entry{std::string(key), spot, {spot, {}}});
}

bool Node::number(double& out) const {
  if (const std::int64_t* i = as<std::int64_t>()) {
    out = static_cast<double>(*i);
    return true;
  }
  if (const double* x = as<double>()) {
    out = *x;
    return true;
  }
  return false;
}

std::string describe(const Node& node) {
  if (node.as<Moment>()) return "a date or time";
  if (node.as<Table>()) return "a table";
  if (const Array* array = node.as<Array>())
    return array->size() == 1 ? "a list of 1 value"
                              : "a list of " + std::to_string(array->size()) + " values";
  const std::string* text = node.as<std::string>();
  if (text) return text->empty() ? "an empty string" : "the string " + inQuotes(*text);
  return toToml(node);
}

std::string toToml(const Node& node) {
  return std::visit(Writer{}, node.value);
}

namespace {

/// The bytes of the character of UTF-8 that a text begins with; 0 if it begins with none that can
/// be printed: another byte, or what controls a terminal.
std::size_t lengthOfFirst(std::string_view text) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7f ? 1 : 0;
  const std::size_t length = lead < 0xc2   ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xc0) != 0x80) return 0;
  // Controls, what is written longer than it need be, halves of pairs, what is beyond the last.
  const unsigned second = byte(1);
  const bool none = (lead == 0xc2 && second < 0xa0) || (lead == 0xe0 && second < 0xa0) ||
                    (lead == 0xed && second >= 0xa0) || (lead == 0xf0 && second < 0x90) ||
                    (lead == 0xf4 && second >= 0x90);
  return none ? 0 : length;
}

}  // namespace

std::string inQuotes(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = lengthOfFirst(text);
    if (out.size() + std::max<std::size_t>(1, length) > kLongestQuote) return "'" + out + "…'";
    out += length == 0 ? "?" : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return "'" + out + "'";
}

bool isName(std::string_view text) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '.'; };
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), allowed);
}

std::string pathOf(std::string_view kind, const Node& node, std::size_t number) {
  const Table* table = node.as<Table>();
  const Entry* entry = table ? table->find("name") : nullptr;
  const std::string* name = entry ? entry->node.as<std::string>() : nullptr;
  return std::string(kind) + "." + (name && isName(*name) ? *name : std::to_string(number));
}

std::string plain(std::string_view key) {
  return isName(key) ? std::string(key) : inQuotes(key);
}

std::vector<std::string> partsOf(const std::string& key) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t dot; (dot = key.find('.', begin)) != std::string::npos; begin = dot + 1)
    parts.push_back(key.substr(begin, dot - begin));
  parts.push_back(key.substr(begin));
  return parts;
}

}  // namespace tumble
