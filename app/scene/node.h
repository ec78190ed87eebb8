// A parsed value with the place where it was written: what a scene file is before it has a meaning.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tumble {

/// Where a value was written. Source 0 is the file, source k the k-th --set; line and column count
/// from 1, 0 = none.
struct Spot {
  int source = 0, line = 0, column = 0;
};

struct Node;
struct Entry;

/// Keys in the order of the alphabet.
struct Table {
  std::vector<Entry> entries;

  Entry* find(std::string_view key);
  const Entry* find(std::string_view key) const;
  /// The entry of that key, made at the spot if it is missing.
  Entry& at(std::string_view key, Spot spot);
};

using Array = std::vector<Node>;

/// Dates and times, which no key of a scene takes.
struct Moment {};

struct Node {
  Spot spot;
  std::variant<Moment, bool, std::int64_t, double, std::string, Array, Table> value;

  template <class T>
  const T* as() const {
    return std::get_if<T>(&value);
  }
  template <class T>
  T* as() {
    return std::get_if<T>(&value);
  }
  /// True if it is an integer or a float; then `out` is its value.
  bool number(double& out) const;
};

struct Entry {
  std::string key;
  Spot spot;  ///< of the key
  Node node;
};

/// What stands there, for complaints: `the string "abc"`, `-2`, `a table`, `3 values`.
std::string describe(const Node& node);

/// The value as one would write it behind --set.
std::string toToml(const Node& node);

/// A piece of foreign text for a message: in quotes, printable and not too long.
std::string inQuotes(std::string_view text);

/// Names of bodies, materials and arrays: 1 to 64 of A–Z a–z 0–9 _ and the dot.
bool isName(std::string_view text);

/// How a person addresses one of several tables of a kind: "body.NAME", or by its number if it has
/// none, or one that is no name.
std::string pathOf(std::string_view kind, const Node& node, std::size_t number);

/// A key for a message: as it stands if it is a name, else quoted.
std::string plain(std::string_view key);

/// What stands between the dots of a key.
std::vector<std::string> partsOf(const std::string& key);

}  // namespace tumble
