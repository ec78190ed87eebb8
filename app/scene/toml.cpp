#include "app/scene/toml.h"

#include <toml++/toml.h>

#include <array>

namespace tumble {

namespace {

// Deeper than any scene, far shallower than the stack: recursion over nodes needs no other guard.
constexpr int kDeepestKey = 32;

/// Finds keys of too many parts before the library does: it walks and frees nested tables by
/// recursion without a limit on the parts of a key. Counts dots outside of strings and comments
/// since the last character that ends a key.
class KeyDepth {
 public:
  void check(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      if (c == '\n') {
        ++line_;
        lineStart_ = i + 1;
      }
      if (quote_ != 0 || comment_) {
        inQuoteOrComment(text, i);
      } else if (c == '"' || c == '\'') {
        open(text, i);
      } else if (c == '#') {
        comment_ = true;
      } else if (c == '.') {
        if (++dots_ >= kDeepestKey)
          throw TomlError({0, line_, static_cast<int>(i - lineStart_) + 1},
                          "a key of more than " + std::to_string(kDeepestKey) + " parts");
      } else if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) {
        dots_ = 0;
      }
    }
  }

 private:
  void open(std::string_view text, std::size_t& i) {
    quote_ = text[i];
    triple_ = text.substr(i, 3) == std::string(3, quote_);
    if (triple_) i += 2;
  }
  void inQuoteOrComment(std::string_view text, std::size_t& i) {
    const char c = text[i];
    if (c == '\n' && !triple_) {
      comment_ = false;
      quote_ = 0;
      dots_ = 0;
    } else if (quote_ == '"' && c == '\\') {
      if (i + 1 < text.size() && text[i + 1] != '\n') ++i;
    } else if (quote_ != 0 && c == quote_) {
      if (triple_ && text.substr(i, 3) != std::string(3, quote_)) return;
      if (triple_) i += 2;
      quote_ = 0;
      triple_ = false;
    }
  }

  int line_ = 1, dots_ = 0;
  std::size_t lineStart_ = 0;
  char quote_ = 0;
  bool triple_ = false, comment_ = false;
};

// The place that the library names, or, for what does not stand in the file, the one it has there.
Spot spotOf(const toml::source_region& region, const Spot* whole) {
  if (whole) return *whole;
  return {0, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Node convert(const toml::node& from, Spot above, const Spot* whole);

Node convertTable(const toml::table& from, Spot spot, const Spot* whole) {
  Table table;
  for (const auto& [key, value] : from) {
    const Spot place = key.source().begin ? spotOf(key.source(), whole) : spot;
    table.entries.push_back({std::string(key.str()), place, convert(value, place, whole)});
  }
  return {spot, std::move(table)};
}

// `above` is the place to name for a value that the library gives none.
Node convert(const toml::node& from, Spot above, const Spot* whole) {
  const Spot spot = from.source().begin ? spotOf(from.source(), whole) : above;
  if (const toml::table* table = from.as_table()) return convertTable(*table, spot, whole);
  if (const toml::array* list = from.as_array()) {
    Array array;
    array.reserve(list->size());
    for (const toml::node& element : *list) array.push_back(convert(element, spot, whole));
    return {spot, std::move(array)};
  }
  if (const auto* text = from.as_string()) return {spot, text->get()};
  if (const auto* integer = from.as_integer()) return {spot, std::int64_t{integer->get()}};
  if (const auto* number = from.as_floating_point()) return {spot, number->get()};
  if (const auto* boolean = from.as_boolean()) return {spot, boolean->get()};
  return {spot, Moment{}};
}

Node parse(std::string_view text, const Spot* whole) {
  try {
    KeyDepth().check(text);
    const toml::table table = toml::parse(text);
    return convertTable(table, whole ? *whole : Spot{0, 1, 1}, whole);
  } catch (const toml::parse_error& error) {
    throw TomlError(spotOf(error.source(), whole), std::string(error.description()));
  }
}

}  // namespace

Node parseToml(std::string_view text) {
  return parse(text, nullptr);
}

std::optional<Node> parseTomlValue(std::string_view text, Spot spot) {
  try {
    // A line break would let a value smuggle in further keys.
    if (text.find_first_of("\r\n") != std::string_view::npos) return {};
    Node document = parse("value = " + std::string(text), &spot);
    Table& table = *document.as<Table>();
    return std::move(table.entries.front().node);
  } catch (const TomlError&) {
    return {};
  }
}

}  // namespace tumble
